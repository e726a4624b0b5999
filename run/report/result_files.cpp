#include "abut/run/report/result_files.hpp"

#include <fmt/format.h>

#include <exception>
#include <string>
#include <utility>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/base/state_fields.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/run/files/failure_files.hpp"
#include "abut/run/files/files.hpp"
#include "abut/run/files/paraview_script.hpp"
#include "abut/run/report/energy_picture.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/frame_piece.hpp"
#include "abut/run/values/sight.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/run/words/table_line.hpp"

namespace abut::run {
namespace {

const std::vector<std::string> texts_beside{"scene.toml", "restart.json"};

template <int Dim>
std::string title_of(const std::string& program, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    return fmt::format("{}, {}D, {}, {}, {}", program, Dim, name_of(result.options.integrator),
                       counted(scene.mesh.n_cells(), "cell"), counted(result.run.steps, "step"));
}

}  // namespace

template <int Dim>
ResultFiles<Dim>::ResultFiles(const RunOptions& options, std::string program, std::string series)
    : out_(options.out),
      lock_(std::in_place, out_, program),
      program_(std::move(program)),
      name_(std::move(series)),
      energies_(out_ / "energy.csv"),
      checkpoints_(out_ / "checkpoints"),
      minutes_(options.checkpoint),
      steps_(options.checkpoint_steps),
      keep_last_(options.keep_last_checkpoint),
      last_kept_(std::chrono::steady_clock::now()) {
    if (!options.resume) {
        remove_earlier_results(out_, name_);  // refuses a folder that holds files of the user under these names
        checkpoints_.remove(texts_beside);
    }
    frames_.emplace(out_, name_, options.frames, options.format, options.pieces);
    if (options.animation > 0) animation_.emplace(out_ / animation_name, program_, options.animation);
}

template <int Dim>
void ResultFiles<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const Stopwatch watch(seconds_);
    energies_.begin(scene, result);
    n_steps_ = result.run.steps;
    has_begun_ = true;
    if (!scene.outputs.probes.empty()) probes_.emplace(out_ / "probes.csv").begin(scene, result);
    if (scene.outputs.forces) forces_.emplace(out_ / "forces.csv").begin(scene, result);
    if (result.options.frames == 0 && result.options.times.empty()) frames_.reset();
    if (frames_) frames_->begin(scene, result);
    if (animation_) animation_->begin(scene, result);
    snapshots_.begin(scene, result);
}

template <int Dim>
void ResultFiles<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, const RunResult<Dim>& result) {
    const Stopwatch watch(seconds_);
    energies_.record(entry, result);
    snapshots_.record(entry);
}

template <int Dim>
void ResultFiles<Dim>::note(const Moment<Dim>& moment) {
    const Stopwatch watch(seconds_);
    if (forces_) forces_->note(moment);
    snapshots_.note(moment);
}

template <int Dim>
void ResultFiles<Dim>::see(const Sight<Dim>& sight) {
    const Stopwatch watch(seconds_);
    const std::int64_t step = sight.moment.steps;
    if (probes_ && probes_->wants_sight(step)) probes_->see(sight);
    if (frames_ && frames_->wants_sight(step)) frames_->see(sight);
    if (animation_ && animation_->wants_sight(step)) animation_->see(sight);
    if (snapshots_.wants_sight(step)) snapshots_.see(sight);
}

template <int Dim>
void ResultFiles<Dim>::see_at_time(const Sight<Dim>& sight) {
    const Stopwatch watch(seconds_);
    if (frames_) frames_->see_at_time(sight);
}

template <int Dim>
void ResultFiles<Dim>::cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) {
    const Stopwatch watch(seconds_);
    if (probes_) probes_->cells_left(solid, first_cells);
    if (frames_) frames_->cells_left(solid, first_cells);
    if (animation_) animation_->cells_left(solid, first_cells);
    snapshots_.cells_left(solid, first_cells);
}

template <int Dim>
void ResultFiles<Dim>::end(const Sight<Dim>& sight) {
    const Stopwatch watch(seconds_);
    snapshots_.end(sight);
}

template <int Dim>
bool ResultFiles<Dim>::wants_sight(std::int64_t step) const {
    return (probes_ && probes_->wants_sight(step)) || (frames_ && frames_->wants_sight(step)) ||
           (animation_ && animation_->wants_sight(step)) || snapshots_.wants_sight(step);
}

template <int Dim>
std::int64_t ResultFiles<Dim>::wants_piece(std::int64_t step) const {
    return frames_ ? frames_->wants_piece(step) : -1;
}

template <int Dim>
void ResultFiles<Dim>::piece(const FramePiece<Dim>& piece) {
    const Stopwatch watch(seconds_);
    if (frames_) frames_->piece(piece);
}

template <int Dim>
void ResultFiles<Dim>::all_pieces(const FramePiece<Dim>& piece) {
    const Stopwatch watch(seconds_);
    if (frames_) frames_->all_pieces(piece);
}

template <int Dim>
void ResultFiles<Dim>::fail(const Failure& failure, const Sight<Dim>& sound) {
    try {
        failed_ = " In the same folder " + write_failure(out_, name_, failure, sound);
        if (failure.not_evaluated.empty())
            draw_failure(sound);
        else
            failed_ += fmt::format(" {} is left out, since the stresses of that state could not be evaluated: {}",
                                   failure_page, failure.not_evaluated);
    } catch (const std::exception& error) {
        failed_ += std::string(" Where it failed could not be written: ") + error.what();
    }
}

template <int Dim>
void ResultFiles<Dim>::draw_failure(const Sight<Dim>& sound) {
    snapshots_.fail(sound);
    write_whole(out_ / failure_page, failure_html(program_, snapshots_.pictures()));
    failed_ += fmt::format(" {} shows the bodies until then.", failure_page);
}

template <int Dim>
std::string ResultFiles<Dim>::left_behind() const {
    if (!has_begun_) return "";
    const std::string film = fmt::format(" {0}.partial, renamed to {0}, shows the run so far.", animation_name);
    return " energy.csv.partial holds the records so far." + (animation_ ? film : "") + failed_;
}

template <int Dim>
bool ResultFiles<Dim>::wants_checkpoint(std::int64_t step, bool stops) const {
    if (keep_last_ && step == n_steps_) return true;
    if (minutes_ == 0.0 && steps_ == 0) return false;
    if (stops || (steps_ > 0 && step % steps_ == 0)) return true;
    return minutes_ > 0.0 && std::chrono::steady_clock::now() - last_kept_ >= std::chrono::duration<double>(60.0 * minutes_);
}

template <int Dim>
void ResultFiles<Dim>::keep(const Checkpoint& checkpoint) {
    const Stopwatch watch(seconds_);
    if (!has_kept_)
        for (const auto& [name, text] : beside_) checkpoints_.add_text(name, text);
    has_kept_ = true;
    checkpoints_.add(checkpoint);
    last_kept_ = std::chrono::steady_clock::now();
}

template <int Dim>
void ResultFiles<Dim>::keep_beside_checkpoints(std::string name, std::string text) {
    beside_.emplace_back(std::move(name), std::move(text));
}

template <int Dim>
void ResultFiles<Dim>::save(StateWriter& state) {
    if (probes_) probes_->save(state);
    if (forces_) forces_->save(state);
    if (frames_) frames_->save(state);
    if (animation_) animation_->save(state);
    put_value(state, snapshots_);
}

/// Results of the run that was stopped are written over; what it left at its stop goes.
template <int Dim>
void ResultFiles<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) {
    const Stopwatch watch(seconds_);
    remove_files(out_, {"summary.json", "report.html", "energy.csv", "energy.svg"});
    remove_failure(out_, name_);
    energies_.resume(scene, result, state);
    n_steps_ = result.run.steps;
    has_begun_ = true;
    if (!scene.outputs.probes.empty()) probes_.emplace(out_ / "probes.csv").resume(scene, result, state);
    if (scene.outputs.forces) forces_.emplace(out_ / "forces.csv").resume(scene, result, state);
    if (result.options.frames == 0 && result.options.times.empty()) frames_.reset();
    if (frames_) frames_->resume(scene, result, state);
    if (animation_) animation_->resume(scene, result, state);
    snapshots_.begin(scene, result);
    get_value(state, snapshots_);
}

template <int Dim>
void ResultFiles<Dim>::finish(const Scene<Dim>& scene, RunResult<Dim>& result) {
    double seconds = 0.0;
    {
        const Stopwatch watch(seconds);
        energies_.finish();
        if (probes_) probes_->finish();
        if (forces_) forces_->finish();
        if (animation_) animation_->finish();
        write_energy_picture<Dim>(out_, title_of(program_, scene, result), result.ledger.entries(), result.energy.scale);
    }
    result.seconds.output += seconds_ + seconds;
    result.seconds.total += seconds;
    if (frames_) write_whole(out_ / paraview_script_name, paraview_script(name_, frames_->list_extension()));
    const BodyPictures pictures = snapshots_.pictures();
    const ReportSources sources{.pictures = &pictures,
                                .forces = forces_ ? out_ / "forces.csv" : std::filesystem::path(),
                                .probes = probes_ ? out_ / "probes.csv" : std::filesystem::path()};
    write_whole(out_ / "report.html", report_html(program_, scene, result, files_of_report(), sources));
    write_whole(out_ / "summary.json", summary_json(program_, scene, result));
    if (result.run.complete && !keep_last_) checkpoints_.remove(texts_beside);
    lock_.reset();
}

template <int Dim>
std::vector<ReportFile> ResultFiles<Dim>::files_of_report() const {
    std::vector<ReportFile> files = {{"summary.json", "all figures of this page and more, for programs"},
                                     {"energy.csv", "energies and momenta, a row per record"},
                                     {"energy.svg", "the picture of the energies"}};
    if (forces_) files.push_back({"forces.csv", "forces between bodies over time"});
    if (probes_) files.push_back({"probes.csv", "what probes see over time"});
    if (animation_) files.push_back({animation_name, "the run as a film, in this browser"});
    if (frames_) {
        files.push_back({name_ + frames_->list_extension(), "cells over time, for ParaView"});
        files.push_back({name_ + "_surface" + frames_->list_extension(), "boundary faces over time, for ParaView"});
        if (frames_->has_pairs())
            files.push_back({pairs_series(name_) + ".pvd", "pairs of faces in contact over time, for ParaView"});
        if (frames_->has_obstacles())
            files.push_back({obstacles_series(name_) + ".pvd", "obstacles over time, for ParaView"});
        files.push_back({paraview_script_name, "opens them: paraview --script=" + std::string(paraview_script_name)});
    }
    return files;
}

template <int Dim>
std::string ResultFiles<Dim>::table() const {
    const auto path = [&](const std::string& name) { return (out_ / name).string(); };
    std::string text = "Files\n" + table_line("report", path("report.html")) + table_line("energies", path("energy.csv")) +
                       table_line("summary", path("summary.json"));
    if (probes_) text += table_line("probes", path("probes.csv"));
    if (forces_) text += table_line("forces", path("forces.csv"));
    if (animation_) text += table_line("animation", path(animation_name));
    if (frames_) {
        const std::string extension = frames_->list_extension();
        text += table_line("for ParaView", path(name_ + extension) + ", " + path(name_ + "_surface" + extension));
    }
    if (frames_ && frames_->has_pairs()) text += table_line("", path(pairs_series(name_) + ".pvd"));
    if (frames_ && frames_->has_obstacles()) text += table_line("", path(obstacles_series(name_) + ".pvd"));
    return text + table_line("picture", path("energy.svg"));
}

template class ResultFiles<2>;
template class ResultFiles<3>;

}  // namespace abut::run
