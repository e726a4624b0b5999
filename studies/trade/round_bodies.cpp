#include "studies/trade/round_bodies.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "abut/base/error.hpp"
#include "apps/support/preset.hpp"
#include "studies/scenes/two_cylinders.hpp"
#include "studies/trade/runs.hpp"

namespace abut::studies::trade {
namespace {

/// Two round bodies that fly towards each other, and may spin.
struct Impact {
    TwoCylinders bodies;
    std::array<double, 2> spin{};  ///< of the discs [rad/s]
    Kinematics strain = Kinematics::small;
};

Impact sized(Impact impact, int cells) {
    impact.bodies.size = 1.0 / cells;
    return impact;
}

Impact slip(int cells) { return sized({}, cells); }

/// Slow beside the waves, so that linear strains in frames of the bodies and finite strains are nearly the same solid.
Impact turn(int cells) {
    Impact impact{.spin = {0.1, 0.03}, .strain = Kinematics::finite};
    impact.bodies.speed = 0.02;
    impact.bodies.gap = 0.37;
    return sized(impact, cells);
}

template <int Dim>
run::Scene<Dim> scene_of(const Impact& impact) {
    run::Scene<Dim> scene = two_cylinders<Dim>(impact.bodies);
    if constexpr (Dim == 2) {
        Case<2> one = case_of<2>("discs", {scene.mesh}, impact.strain);
        for (std::size_t body = 0; body < 2; ++body) one.motion[body].spin[0] = impact.spin[body];
        scene.added_velocity = [motion = motion_of(one)](const Vector<2>& x) { return motion[x.x() < 0.0 ? 0 : 1].at(x); };
    }
    return scene;
}

template <int Dim>
double restitution_of(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) {
    for (const run::Finding& finding : scene.findings(result))
        if (finding.key == "restitution") return std::get<double>(finding.value);
    throw Misuse("two_cylinders has no restitution");
}

/// Adds what is asked of velocities at the end.
template <int Dim>
void add_errors(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result, const Reference& reference, double speed,
                Outcome& outcome) {
    if (!std::isnan(reference.restitution))
        outcome.restitution = std::abs(restitution_of(scene, result) - reference.restitution);
    const Vector<Dim> velocity(reference.velocity.data());
    outcome.velocity = (result.bodies.end.front().velocity - velocity).norm() / speed;
}

template <int Dim>
Outcome solve(const Impact& impact, const run::RunOptions& run, const Reference& reference, double limit) {
    const run::Scene<Dim> scene = scene_of<Dim>(impact);
    const double speed = impact.bodies.speed;
    const TimedRun<Dim> timed = run_for<Dim>(scene, run, limit);
    Outcome outcome = outcome_of<Dim>(scene, timed, speed);
    add_errors<Dim>(scene, timed.result, reference, speed, outcome);
    return outcome;
}

template <int Dim>
NodalOutcome<Dim> run_on_nodes(const Impact& impact, const run::Scene<Dim>& scene, const NodalRun& run, double limit) {
    std::vector<AxialVector<Dim>> spin(2, AxialVector<Dim>::Zero());
    if constexpr (Dim == 2)
        for (std::size_t body = 0; body < 2; ++body) spin[body] = AxialVector<2>(impact.spin[body]);
    return solve_on_nodes<Dim>(scene, spin, run, impact.bodies.speed, limit);
}

template <int Dim>
Outcome solve_on_nodes(const Impact& impact, const NodalRun& run, const Reference& reference, double limit) {
    const run::Scene<Dim> scene = scene_of<Dim>(impact);
    auto [outcome, velocity] = run_on_nodes<Dim>(impact, scene, run, limit);
    run::RunResult<Dim> motion;  // what restitution is made of
    for (std::size_t body = 0; body < velocity.size(); ++body) {
        motion.bodies.start.push_back({.mass = 0.0, .velocity = scene.velocity[body], .rotation = 0.0});
        motion.bodies.end.push_back({.mass = 0.0, .velocity = velocity[body], .rotation = 0.0});
    }
    add_errors<Dim>(scene, motion, reference, impact.bodies.speed, outcome);
    return outcome;
}

/// Velocity of the left body at the end, by linear finite elements with contact on their nodes.
template <int Dim>
std::vector<double> reference_velocity(const Impact& impact) {
    const auto velocity = run_on_nodes<Dim>(impact, scene_of<Dim>(impact),
                                            {.strain = impact.strain, .options = {.cfl = 1.0, .filter = true}}, no_limit)
                              .velocity.front();
    return {velocity.begin(), velocity.end()};
}

/// Restitution of the cell-centred solid.
template <int Dim>
double reference_restitution(const Impact& impact) {
    const run::Scene<Dim> scene = scene_of<Dim>(impact);
    run::RunOptions run;
    apps::apply_words(apps::words_of(apps::Preset::exact), run);
    return restitution_of<Dim>(scene, run::simulate<Dim>(scene, run));
}

template <int Dim>
Problem slip_problem(std::vector<int> cells, int reference) {
    return {.name = fmt::format("slip{}d", Dim),
            .text = fmt::format(
                "scenes/slipping_cylinders in {0}D, cells in the radius; restitution against {1} cells, velocity "
                "against small strain on nodes with {1}",
                Dim, reference),
            .levels = std::move(cells),
            .reference = [reference]() -> Reference {
                return {reference_restitution<Dim>(slip(reference)), reference_velocity<Dim>(slip(reference))};
            },
            .solve = [](const run::RunOptions& run, int level, const Reference& against,
                        double limit) { return solve<Dim>(slip(level), run, against, limit); },
            .solve_on_nodes = [](const NodalRun& run, int level, const Reference& against,
                                 double limit) { return solve_on_nodes<Dim>(slip(level), run, against, limit); }};
}

}  // namespace

Problem slip_problem(int dim, std::vector<int> cells, int reference) {
    return dim == 2 ? slip_problem<2>(std::move(cells), reference) : slip_problem<3>(std::move(cells), reference);
}

Problem turn_problem(std::vector<int> cells, int reference) {
    return {.name = "turn2d",
            .text = fmt::format("discs that spin, turn by 1 rad and slip, cells in the radius; velocity against finite "
                                "strain on nodes with {} cells",
                                reference),
            .motion = Motion::turning,
            .base = {.kinematics = run::BodyKinematics::floating},
            .levels = std::move(cells),
            .reference = [reference]() -> Reference { return {.velocity = reference_velocity<2>(turn(reference))}; },
            .solve = [](const run::RunOptions& run, int level, const Reference& against,
                        double limit) { return solve<2>(turn(level), run, against, limit); },
            .solve_on_nodes = [](const NodalRun& run, int level, const Reference& against,
                                 double limit) { return solve_on_nodes<2>(turn(level), run, against, limit); }};
}

}  // namespace abut::studies::trade
