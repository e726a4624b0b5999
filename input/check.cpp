#include "abut/input/check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "abut/base/error.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/input/make_scene.hpp"
#include "abut/input/read_settings.hpp"
#include "abut/solid/solid.hpp"

namespace abut::input {
namespace {

/// Of the kinematics of the scene where a pilot run would choose them. Throws BadInput for a solid that cannot be made and a
/// step that cannot be taken.
template <int Dim>
Estimate estimate(const run::Scene<Dim>& scene, const run::RunOptions& given) {
    run::RunOptions options = run::with_defaults<Dim>(given);
    if (options.kinematics == run::BodyKinematics::automatic) options.kinematics = run::BodyKinematics::scene;
    solid::Solid<Dim> solid(scene.mesh, run::solid_options(scene, options));
    Estimate estimate{.bodies = scene.mesh.n_bodies(),
                      .cells = scene.mesh.n_cells(),
                      .boundary_faces = static_cast<std::int64_t>(scene.mesh.boundary_faces.size())};
    estimate.stable_dt = dynamics::stable_step(solid).dt;
    estimate.dt = run::choose_step(options, estimate.stable_dt);
    estimate.steps = std::isnan(options.time) ? options.steps : run::steps_until(options.time, estimate.dt);
    estimate.end = static_cast<double>(estimate.steps) * estimate.dt;
    return estimate;
}

/// What only a solid knows, where nothing else is wrong.
template <int Dim>
void check_solid(const Settings& settings, CheckedScene& checked) {
    const run::Scene<Dim> scene = make_scene<Dim>(settings, checked.faults);
    if (!checked.faults.empty()) return;
    try {
        checked.estimate = estimate(scene, settings.options);
    } catch (const Error& error) {
        checked.faults.push_back({settings.file.string(), error.what()});
    }
}

}  // namespace

CheckedScene check_scene(const std::filesystem::path& path, const Overrides& overrides) {
    CheckedScene checked;
    try {
        ReadSettings read = read_settings(path, overrides);
        checked.faults = std::move(read.faults);
        if (read.settings.dim == 2) check_solid<2>(read.settings, checked);
        if (read.settings.dim == 3) check_solid<3>(read.settings, checked);
    } catch (const SceneError& error) {
        checked.faults = error.faults();
    }
    return checked;
}

std::string text_of(const Estimate& estimate) {
    std::string text;
    const auto line = [&](const char* name, const std::string& value) { text += fmt::format("  {:<16}{}\n", name, value); };
    line("bodies", fmt::format("{}", estimate.bodies));
    line("cells", fmt::format("{}", estimate.cells));
    line("boundary faces", fmt::format("{}", estimate.boundary_faces));
    line("stable step", fmt::format("{:.4g} s", estimate.stable_dt));
    line("step", fmt::format("{:.4g} s", estimate.dt));
    line("steps", fmt::format("{}", estimate.steps));
    line("end", fmt::format("{:.4g} s", estimate.end));
    return text;
}

}  // namespace abut::input
