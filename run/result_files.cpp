#include "abut/run/result_files.hpp"

#include <fmt/format.h>

#include <utility>

#include "abut/base/stopwatch.hpp"
#include "abut/run/energy_picture.hpp"
#include "abut/run/files.hpp"
#include "abut/run/summary.hpp"
#include "abut/run/table_line.hpp"

namespace abut::run {
namespace {

template <int Dim>
std::string draw(const std::filesystem::path& out, const std::string& program, const Scene<Dim>& scene,
                 const RunResult<Dim>& result) {
    const std::string title = fmt::format("{}, {}D, {}, {} cells, {} steps", program, Dim,
                                          name_of(result.options.integrator), scene.mesh.n_cells(), result.steps);
    return draw_energy(out, {title, result.ledger.entries().front().pseudo_energy, result.scale.value, result.scale.name});
}

}  // namespace

template <int Dim>
ResultFiles<Dim>::ResultFiles(const RunOptions& options, std::string program, std::string series)
    : out_(options.out),
      lock_(std::in_place, out_, program),
      program_(std::move(program)),
      name_(std::move(series)),
      energies_(out_ / "energy.csv") {
    remove_earlier_results(out_, name_);
    if (options.frames > 0) frames_.emplace(out_, name_, options.frames);
}

template <int Dim>
void ResultFiles<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const Stopwatch watch(seconds_);
    energies_.begin(scene, result);
    has_begun_ = true;
    if (frames_) frames_->begin(scene, result);
}

template <int Dim>
void ResultFiles<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, const RunResult<Dim>& result) {
    const Stopwatch watch(seconds_);
    energies_.record(entry, result);
}

template <int Dim>
void ResultFiles<Dim>::look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    const Stopwatch watch(seconds_);
    if (frames_) frames_->look(run, solid);
}

template <int Dim>
void ResultFiles<Dim>::finish(const Scene<Dim>& scene, RunResult<Dim>& result) {
    double seconds = 0.0;
    {
        const Stopwatch watch(seconds);
        energies_.finish();
        without_picture_ = draw(out_, program_, scene, result);
    }
    result.seconds.output += seconds_ + seconds;
    result.seconds.total += seconds;
    write_whole(out_ / "summary.json", summary_json(program_, scene, result));
    lock_.reset();
}

template <int Dim>
std::string ResultFiles<Dim>::table() const {
    const auto path = [&](const std::string& name) { return (out_ / name).string(); };
    std::string text = "Files\n" + table_line("energies", path("energy.csv")) + table_line("summary", path("summary.json"));
    if (frames_) text += table_line("for ParaView", path(name_ + ".pvd") + ", " + path(name_ + "_surface.pvd"));
    return text + table_line("picture", without_picture_.empty() ? path("energy.png") : "none: " + without_picture_);
}

template class ResultFiles<2>;
template class ResultFiles<3>;

}  // namespace abut::run
