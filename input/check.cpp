#include "abut/input/check.hpp"

#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/input/make_scene.hpp"
#include "abut/input/read_settings.hpp"
#include "abut/mesh/cells_across.hpp"
#include "abut/mesh/edge_lengths.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/watch/slow_cell.hpp"
#include "abut/run/words/bond_text.hpp"
#include "abut/run/words/warnings.hpp"
#include "abut/solid/body_inertia.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/options/option_words.hpp"
#include "abut/solid/solid.hpp"

namespace abut::input {
namespace {

/// Time of a force evaluation in the state at the start, by the best of several [s].
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

/// Memory of this process, at most until now [bytes].
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

/// The least share of the exact inertia that a body has, and which body it is.
template <int Dim>
std::string text_of_inertia(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) {
    if (result.bodies.inertia.empty()) return "";
    const auto least = std::ranges::min_element(result.bodies.inertia, {}, &solid::BodyInertia<Dim>::least);
    if (least->least() >= run::enough_inertia) return fmt::format("{:.3g} of the exact one, or more", least->least());
    const auto body = static_cast<std::size_t>(least - result.bodies.inertia.begin());
    return fmt::format("{:.3g} of the exact one: '{}', which is {}", least->least(), scene.mesh.body_names[body],
                       run::name_of(run::kinematics_of(scene, result, body)));
}

/// "at most 4 in 'left'": cells across the body that deforms and has the fewest; empty: none deforms.
template <int Dim>
std::string text_of_across(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) {
    const std::vector<int> across = mesh::cells_across(scene.mesh);
    std::optional<std::size_t> thinnest;
    for (std::size_t body = 0; body < across.size(); ++body)
        if (solid::properties_of(run::kinematics_of(scene, result, body)).deforms &&
            (!thinnest || across[body] < across[*thinnest]))
            thinnest = body;
    return thinnest ? fmt::format("at most {} in '{}'", across[*thinnest], scene.mesh.body_names[*thinnest]) : "";
}

/// A body that deforms and rubs, and is not damped, vibrates, and its faces feel less than their limit:
/// docs/friction.md. The damping of stiffness that leaves 0.9 of the step: sqrt(1 + z^2) - z = 0.9 with z = beta
/// omega/2.
template <int Dim>
std::string damping_of_friction(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) {
    constexpr double part_of_step = 0.9, z = (1.0 - part_of_step * part_of_step) / (2.0 * part_of_step);
    const run::RunOptions& options = result.options;
    if (!scene.contact || !run::has_friction(scene, options) || !(result.run.stable.omega_max > 0.0)) return "";
    const auto of_all = run::kinematics_of_all(options.kinematics);
    bool any_deforms = false;
    for (std::size_t body = 0; body < scene.solid.materials.size(); ++body) {
        if (!solid::properties_of(of_all.value_or(scene.solid.kinematics[body])).deforms) continue;
        if (scene.solid.materials[body].damping.any()) return "";
        any_deforms = true;
    }
    if (!any_deforms) return "";
    return fmt::format("none where bodies rub: take stiffness_damping = {:.2g} for them ({:g} of this step){}",
                       2.0 * z / result.run.stable.omega_max, part_of_step,
                       options.settle ? "" : ", and settle = true in [run] if they begin at rest");
}

/// A step goes as h/c with the size h of cells and the speed c of waves, the work of one as h^-dim.
std::string ways_to_fewer_steps(const run::RunOptions& options, std::int64_t steps, int dim) {
    constexpr std::int64_t many = 100'000;
    constexpr double heavier = 100.0;
    if (steps <= many || std::isnan(options.time) || !std::isnan(options.dt)) return "";
    const auto count = static_cast<double>(steps);
    return fmt::format(
        "cells twice as large: {:.2g} steps, in 1/{} of the time; {:g} times the density, where inertia does "
        "not matter: {:.2g} steps",
        0.5 * count, 2 << dim, heavier, count / std::sqrt(heavier));
}

/// "0.02 m on average in 'left', 0.01 to 0.03 m": edges of the body whose cells are smallest.
template <int Dim>
std::string text_of_edges(const mesh::Mesh<Dim>& mesh) {
    const std::vector<mesh::EdgeLengths> lengths = mesh::edge_lengths(mesh);
    if (lengths.empty()) return "";
    const auto finest = std::ranges::min_element(lengths, {}, &mesh::EdgeLengths::mean);
    return fmt::format("{:.3g} m on average in '{}', {:.3g} to {:.3g} m", finest->mean,
                       mesh.body_names[static_cast<std::size_t>(finest - lengths.begin())], finest->least, finest->largest);
}

/// Looks at a run that ends before its first step.
template <int Dim>
class Rehearsal : public run::Observer<Dim> {
public:
    Rehearsal(const run::RunOptions& options, CheckedScene& checked) : options_(options), checked_(checked) {}

    void begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) override {
        has_begun_ = true;
        estimate_ = {.bodies = scene.mesh.n_bodies(),
                     .cells = scene.mesh.n_cells(),
                     .boundary_faces = static_cast<std::int64_t>(scene.mesh.boundary_faces.size())};
        if (result.options.law != solid::ContactLaw::automatic)
            estimate_.law = word_of(solid::law_words, result.options.law);
        estimate_.inertia = text_of_inertia(scene, result);
        estimate_.edges = text_of_edges(scene.mesh);
        estimate_.across = text_of_across(scene, result);
        estimate_.bonds = run::bonded_text<Dim>(result.bonds.coverage);
        estimate_.stable_dt = result.run.stable.dt;
        estimate_.dt = run::choose_step(options_, result.run.stable.dt);
        estimate_.steps = std::isnan(options_.time) ? options_.steps : run::steps_until(options_.time, estimate_.dt);
        estimate_.fewer_steps = ways_to_fewer_steps(options_, estimate_.steps, Dim);
        estimate_.end = static_cast<double>(estimate_.steps) * estimate_.dt;
        if (const auto slow = run::slow_cell(scene, result)) estimate_.cell_of_step = slow->text;
        estimate_.damping = damping_of_friction(scene, result);
        interval_ = result.options.interval;
        for (const run::Warning& warning : run::without_notes(run::warnings_before(scene, result)))
            checked_.warnings.push_back(warning.text);
    }
    [[nodiscard]] bool wants_look(std::int64_t) const override { return true; }
    void look(const dynamics::RunView<Dim>&, solid::Solid<Dim>& solid) override {
        const double evaluations = static_cast<double>(estimate_.steps) * (1.0 + 1.0 / interval_);
        estimate_.seconds = evaluations * seconds_of_force(solid);
    }
    /// Not while bodies come to rest: whether they do is known only then.
    [[nodiscard]] bool asks_to_stop() const override { return has_begun_; }

    [[nodiscard]] Estimate estimate() const {
        Estimate estimate = estimate_;
        estimate.bytes = peak_memory();
        return estimate;
    }

private:
    const run::RunOptions& options_;
    CheckedScene& checked_;
    Estimate estimate_;
    int interval_ = 1;
    bool has_begun_ = false;
};

/// Checks what only a run knows, where nothing else is wrong: one that ends before its first step, under the kinematics
/// of the scene where a pilot run would choose them.
template <int Dim>
void check_run(const Settings& settings, CheckedScene& checked) {
    Answers mesh;
    const run::Scene<Dim> scene = make_scene<Dim>(settings, mesh, checked.faults);
    if (!checked.faults.empty()) return;
    run::RunOptions options = run::with_defaults<Dim>(run::with_restart(settings.options, scene));
    if (options.kinematics == run::BodyKinematics::automatic) options.kinematics = run::BodyKinematics::scene;
    try {
        Rehearsal<Dim> rehearsal(options, checked);
        static_cast<void>(run::simulate<Dim>(scene, options, rehearsal));
        checked.estimate = rehearsal.estimate();
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
        if (read.settings.dim == 2) check_run<2>(read.settings, checked);
        if (read.settings.dim == 3) check_run<3>(read.settings, checked);
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
    if (!estimate.inertia.empty()) line("inertia", estimate.inertia);
    if (!estimate.edges.empty()) line("edges of cells", estimate.edges);
    if (!estimate.across.empty()) line("cells across", estimate.across);
    if (!estimate.bonds.empty()) line("bonded", estimate.bonds);
    line("stable step", fmt::format("{:.4g} s", estimate.stable_dt));
    if (!estimate.cell_of_step.empty()) line("  set by", estimate.cell_of_step);
    line("step", fmt::format("{:.4g} s", estimate.dt));
    if (!estimate.damping.empty()) line("damping", estimate.damping);
    line("steps", fmt::format("{}", estimate.steps));
    if (!estimate.fewer_steps.empty()) line("  fewer by", estimate.fewer_steps);
    line("end", fmt::format("{:.4g} s", estimate.end));
    line("takes",
         fmt::format("about {}, without frames and contacts that are not closed at the start", duration(estimate.seconds)));
    line("memory", fmt::format("about {:.2g} MB", 1e-6 * estimate.bytes));
    return text;
}

}  // namespace abut::input
