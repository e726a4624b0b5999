#include "abut/run/files/force_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "abut/base/state_fields.hpp"
#include "abut/run/body_names.hpp"
#include "abut/run/files/column_units.hpp"
#include "abut/run/files/files.hpp"
#include "abut/run/values/moment.hpp"

namespace abut::run {

template <int Dim>
ForceFile<Dim>::ForceFile(std::filesystem::path path) : file_(std::move(path)) {}

template <int Dim>
void ForceFile<Dim>::look_up(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    names_ = scene.mesh.body_names;
    for (std::size_t i = 0; i < scene.solid.obstacles.size(); ++i) names_.push_back(name_of_obstacle(scene, i));
    for (std::string& name : names_) name = in_csv(name);
    forces_ = ContactForces<Dim>(scene, result);
}

template <int Dim>
void ForceFile<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    look_up(scene, result);
    file_.open();
    std::vector<std::string> columns{"step", "time", "body_1", "body_2"};
    const auto add_vector = [&](const char* name) {
        for (int i = 0; i < Dim; ++i) columns.push_back(fmt::format("{}_{}", name, "xyz"[i]));
    };
    add_vector("force_on_2");
    columns.emplace_back("normal_force");
    add_vector("friction_on_2");
    columns.emplace_back("rubbing_force");
    add_vector("slip_velocity_of_2");
    file_.write(fmt::format("{}\n", fmt::join(with_units<Dim>(columns), ",")));
}

template <int Dim>
void ForceFile<Dim>::note(const Moment<Dim>& moment) {
    if (!forces_.wants_look(moment.steps)) return;
    for (const ForceRow<Dim>& row : forces_.rows(moment)) {
        std::string text = fmt::format("{},{:.17g},{},{}", row.step, row.time, names_[static_cast<std::size_t>(row.body_1)],
                                       names_[static_cast<std::size_t>(row.body_2)]);
        const auto add = [&](double value) { text += fmt::format(",{:.17g}", value); };
        for (const double force : row.force) add(force);
        add(row.normal_force);
        for (const double force : row.friction) add(force);
        add(row.rubbing_force);
        for (const double speed : row.slip_velocity) add(speed);
        file_.write(text + "\n");
    }
}

template <int Dim>
void ForceFile<Dim>::save(StateWriter& state) {
    state.put(static_cast<std::uint64_t>(file_.size()));
    put_value(state, forces_);
}

template <int Dim>
void ForceFile<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) {
    look_up(scene, result);
    file_.go_on_after(state.get<std::uint64_t>());
    get_value(state, forces_);
}

template <int Dim>
void ForceFile<Dim>::finish() {
    file_.finish();
}

template class ForceFile<2>;
template class ForceFile<3>;

}  // namespace abut::run
