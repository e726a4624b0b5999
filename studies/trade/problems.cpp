#include "studies/trade/problems.hpp"

#include <cmath>

#include "abut/solid/contact_view.hpp"
#include "studies/scenes/bars.hpp"
#include "studies/scenes/hertz.hpp"
#include "studies/trade/round_bodies.hpp"
#include "studies/trade/runs.hpp"

namespace abut::studies::trade {
namespace {

Outcome solve_bar(const run::RunOptions& run, int cells, const Reference&, double limit) {
    const Bar bar;
    const ExactBounce exact(0.0);
    run::Scene<2> scene = bar_strip<2>({.bar = bar,
                                        .gap = ExactBounce::height,
                                        .speed = ExactBounce::speed,
                                        .energy = 0.5 * bar.mass() * ExactBounce::speed * ExactBounce::speed,
                                        .time = exact.hit() + 2.0 * bar.contact_time()},
                                       cells);
    ContactHistory history{.time = {0.0}, .gap = {}, .speed = {}, .pressure = {}};
    scene.after_step = [&history, width = strip_width(bar, cells)](const solid::Solid<2>& solid, double dt) {
        history.time.push_back(history.time.back() + dt);
        history.pressure.push_back(-solid.contact().obstacle_force(0).y() / width);
    };
    const TimedRun<2> timed = run_for<2>(scene, run, limit);
    Outcome outcome = outcome_of<2>(scene, timed, ExactBounce::speed);
    outcome.restitution = std::abs(timed.result.bodies.end.front().velocity.y() / ExactBounce::speed - 1.0);
    outcome.pressure =
        middle_pressure(history, exact.hit(), bar.contact_time(), [&](double) { return exact.pressure(0.0); }).rms /
        exact.pressure(0.0);
    return outcome;
}

Outcome solve_cylinder_on_block(const run::RunOptions& run, int faces, const Reference&, double) {
    const auto result = solve_hertz<2>(
        {.faces = static_cast<double>(faces), .contact = run.contact, .free_faces = run.free_faces, .corners = run.corners});
    Outcome outcome{{.cells = result.n_cells,
                     .steps = static_cast<std::int64_t>(result.report.iterations.size()),
                     .seconds_of_steps = result.seconds}};
    outcome.pressure = result.pressure_error;
    return outcome;
}

}  // namespace

const std::vector<Problem>& problems() {
    static const std::vector<Problem> all = {
        slip_problem(2, {10, 20, 40}, 80), slip_problem(3, {6, 12}, 18), turn_problem({10, 20, 40}, 80),
        Problem{.name = "hertz",
                .text = "cylinder on a block at rest, faces in the contact radius; pressure against Hertz",
                .motion = Motion::at_rest,
                .levels = {3, 5, 10},
                .solve = solve_cylinder_on_block},
        Problem{.name = "bar",
                .text = "bar_impact --body strip2d, cells along it; rebound and pressure against d'Alembert",
                .base = default_bar_options({}, {}).run,
                .levels = {50, 100, 200},
                .solve = solve_bar}};
    return all;
}

}  // namespace abut::studies::trade
