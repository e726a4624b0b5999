#include "abut/input/check.hpp"

#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/input/make_scene.hpp"
#include "abut/input/read_settings.hpp"
#include "abut/solid/solid.hpp"

namespace abut::input {
namespace {

/// Of a force in the state at the start, by the best of several [s].
template <int Dim>
double seconds_of_force(solid::Solid<Dim>& solid) {
    constexpr int least = 3, most = 50;
    constexpr double enough = 0.1;  // [s]
    const std::vector<double> q(solid.size(), 0.0);
    std::vector<double> force(solid.size());
    solid.force(q, force);  // it searches contacts and fills caches
    double best = std::numeric_limits<double>::infinity(), all = 0.0;
    for (int i = 0; i < least || (i < most && all < enough); ++i) {
        double seconds = 0.0;
        {
            const Stopwatch watch(seconds);
            solid.force(q, force);
        }
        best = std::min(best, seconds);
        all += seconds;
    }
    return best;
}

/// Of this process, at most until now [bytes].
double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    return static_cast<double>(usage.ru_maxrss);
#else
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
#endif
}

/// "12 s", "3.4 h"
std::string duration(double seconds) {
    if (seconds < 100.0) return fmt::format("{:.2g} s", seconds);
    return seconds < 6000.0 ? fmt::format("{:.2g} min", seconds / 60.0) : fmt::format("{:.2g} h", seconds / 3600.0);
}

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
    if (solid.contact()) estimate.law = "reconstruction";
    if (solid.nodal_contact()) estimate.law = "pair_potential";
    estimate.stable_dt = dynamics::stable_step(solid).dt;
    estimate.dt = run::choose_step(options, estimate.stable_dt);
    estimate.steps = std::isnan(options.time) ? options.steps : run::steps_until(options.time, estimate.dt);
    estimate.end = static_cast<double>(estimate.steps) * estimate.dt;
    const double evaluations = static_cast<double>(estimate.steps) * (1.0 + 1.0 / options.interval);
    estimate.seconds = evaluations * seconds_of_force(solid);
    estimate.bytes = peak_memory();
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
    checked.faults = in_order(std::move(checked.faults));
    return checked;
}

std::string text_of(const Estimate& estimate) {
    std::string text;
    const auto line = [&](const char* name, const std::string& value) { text += fmt::format("  {:<16}{}\n", name, value); };
    line("bodies", fmt::format("{}", estimate.bodies));
    line("cells", fmt::format("{}", estimate.cells));
    line("boundary faces", fmt::format("{}", estimate.boundary_faces));
    if (!estimate.law.empty()) line("law of contact", estimate.law);
    line("stable step", fmt::format("{:.4g} s", estimate.stable_dt));
    line("step", fmt::format("{:.4g} s", estimate.dt));
    line("steps", fmt::format("{}", estimate.steps));
    line("end", fmt::format("{:.4g} s", estimate.end));
    line("takes", fmt::format("about {}, contact and frames not counted", duration(estimate.seconds)));
    line("memory", fmt::format("about {:.2g} MB", 1e-6 * estimate.bytes));
    return text;
}

}  // namespace abut::input
