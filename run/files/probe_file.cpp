#include "abut/run/files/probe_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>

#include "abut/base/state_fields.hpp"
#include "abut/run/files/column_units.hpp"
#include "abut/run/files/files.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/sight.hpp"

namespace abut::run {

template <int Dim>
ProbeFile<Dim>::ProbeFile(std::filesystem::path path) : file_(std::move(path)) {}

template <int Dim>
void ProbeFile<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    probes_ = Probes<Dim>(scene, result);
    std::vector<std::string> columns{"step", "time"};
    for (const Probe<Dim>& probe : scene.outputs.probes)
        for (const std::string& column : Probes<Dim>::columns(probe)) columns.push_back(in_csv(probe.name) + "." + column);
    file_.open();
    file_.write(fmt::format("{}\n", fmt::join(with_units<Dim>(columns), ",")));
}

template <int Dim>
bool ProbeFile<Dim>::wants_sight(std::int64_t step) const {
    return probes_.wants_look(step);
}

template <int Dim>
void ProbeFile<Dim>::see(const Sight<Dim>& sight) {
    std::string row = fmt::format("{},{:.17g}", sight.moment.steps, sight.moment.time);
    for (const std::vector<double>& values : probes_.values(sight))
        for (const double value : values) row += fmt::format(",{:.17g}", value);
    file_.write(row + "\n");
}

template <int Dim>
void ProbeFile<Dim>::cells_left(const solid::Solid<Dim>&, std::span<const std::int32_t> first_cells) {
    probes_.take_cells(first_cells);
}

template <int Dim>
void ProbeFile<Dim>::save(StateWriter& state) {
    state.put(static_cast<std::uint64_t>(file_.size()));
    put_value(state, probes_);
}

template <int Dim>
void ProbeFile<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) {
    probes_ = Probes<Dim>(scene, result);
    file_.go_on_after(state.get<std::uint64_t>());
    get_value(state, probes_);
}

template <int Dim>
void ProbeFile<Dim>::finish() {
    file_.finish();
}

template class ProbeFile<2>;
template class ProbeFile<3>;

}  // namespace abut::run
