#include "studies/trade/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/run/simulation.hpp"
#include "apps/two_cylinders.hpp"
#include "studies/scenes/bars.hpp"
#include "studies/scenes/hertz.hpp"

namespace abut::studies::trade {
namespace {

/// Ends a run that takes too long.
template <int Dim>
class Impatience : public run::Observer<Dim> {
public:
    explicit Impatience(double limit) : limit_(limit) {}

    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>&) override {
        const std::chrono::duration<double> waited = Clock::now() - begin_;
        if (waited.count() > limit_)
            throw std::runtime_error(fmt::format("stopped at step {}, t = {:.4g} s: --limit of {:g} s per run is over",
                                                 run.steps, run.time, limit_));
    }

private:
    using Clock = std::chrono::steady_clock;
    double limit_;
    Clock::time_point begin_ = Clock::now();
};

/// Energies every tenth step: measuring them costs two evaluations of the force.
constexpr int interval = 10;

template <int Dim>
run::RunResult<Dim> run_for(const run::Scene<Dim>& scene, run::RunOptions run, double limit, double& seconds) {
    run.interval = interval;
    Impatience<Dim> impatience(limit);
    double all = 0.0;
    auto result = [&] {
        const Stopwatch watch(all);
        return run::simulate<Dim>(scene, run, impatience);
    }();
    seconds = all - result.seconds.setup - result.seconds.ledger;
    return result;
}

/// All except the errors of what the problem is about.
template <int Dim>
Outcome outcome_of(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result, double speed, double seconds) {
    const auto& entries = result.ledger.entries();
    double energy = 0.0;
    for (const auto& entry : entries)
        energy = std::max(energy, std::abs(entry.energy - entry.work - entries.front().energy));
    const double scale = result.scale.value;
    return {.errors = {.drift = result.ledger.pseudo_energy_drift() / scale, .energy = energy / scale},
            .excess = result.ledger.energy_excess() / scale,
            .parasitic = result.ledger.parasitic() / speed,
            .events = result.contact.events,
            .lost_contacts = result.contact.missed_contacts,
            .cells = scene.mesh.n_cells(),
            .steps = result.steps,
            .seconds = seconds};
}

/// Two cylinders of `cells` cells in the radius that slip over each other.
apps::CylinderOptions slip(int dim, int cells) {
    apps::CylinderOptions options{.dim = dim};
    options.size = {options.radius[0] / cells, options.radius[1] / cells};
    apps::fill_defaults(options, apps::slipping_offset);
    return options;
}

template <int Dim>
double restitution_of(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) {
    for (const run::Finding& finding : scene.findings(result))
        if (finding.key == "restitution") return std::get<double>(finding.value);
    throw Misuse("two_cylinders has no restitution");
}

template <int Dim>
Outcome solve_slip(const run::RunOptions& run, int cells, double reference, double limit) {
    const apps::CylinderOptions options = slip(Dim, cells);
    const run::Scene<Dim> scene = apps::two_cylinders<Dim>(options);
    double seconds = 0.0;
    const auto result = run_for<Dim>(scene, run, limit, seconds);
    Outcome outcome = outcome_of<Dim>(scene, result, options.speed[0], seconds);
    outcome.errors.restitution = std::abs(restitution_of(scene, result) - reference);
    return outcome;
}

template <int Dim>
Outcome solve_slip_on_nodes(const nodal::ImpactOptions& run, int cells, double reference, double limit) {
    const apps::CylinderOptions options = slip(Dim, cells);
    const run::Scene<Dim> scene = apps::two_cylinders<Dim>(options);
    std::vector<Vector<Dim>> velocity;
    Outcome outcome = solve_on_nodes<Dim>(scene, run, options.speed[0], limit, velocity);
    run::RunResult<Dim> motion;  // what restitution is made of
    for (std::size_t body = 0; body < velocity.size(); ++body) {
        motion.start.push_back({.mass = 0.0, .velocity = scene.velocity[body], .rotation = 0.0});
        motion.end.push_back({.mass = 0.0, .velocity = velocity[body], .rotation = 0.0});
    }
    outcome.errors.restitution = std::abs(restitution_of(scene, motion) - reference);
    return outcome;
}

template <int Dim>
double slip_restitution(const run::RunOptions& run, int cells) {
    const run::Scene<Dim> scene = apps::two_cylinders<Dim>(slip(Dim, cells));
    return restitution_of<Dim>(scene, run::simulate<Dim>(scene, run));
}

Problem slip_problem(int dim, std::vector<int> levels, int reference_level) {
    return {.name = dim == 2 ? "slip2d" : "slip3d",
            .text = fmt::format("slipping_cylinders --dim {}, cells in the radius; restitution against {} cells", dim,
                                reference_level),
            .levels = std::move(levels),
            .reference_level = reference_level,
            .solve = dim == 2 ? solve_slip<2> : solve_slip<3>,
            .solve_on_nodes = dim == 2 ? solve_slip_on_nodes<2> : solve_slip_on_nodes<3>,
            .restitution = dim == 2 ? slip_restitution<2> : slip_restitution<3>};
}

Outcome solve_bar(const run::RunOptions& run, int cells, double, double limit) {
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
        history.pressure.push_back(-solid.obstacle_force(0).y() / width);
    };
    double seconds = 0.0;
    const auto result = run_for<2>(scene, run, limit, seconds);
    Outcome outcome = outcome_of<2>(scene, result, ExactBounce::speed, seconds);
    outcome.errors.restitution = std::abs(result.end.front().velocity.y() / ExactBounce::speed - 1.0);
    outcome.errors.pressure =
        middle_pressure(history, exact.hit(), bar.contact_time(), [&](double) { return exact.pressure(0.0); }).rms /
        exact.pressure(0.0);
    return outcome;
}

Outcome solve_cylinder_on_block(const run::RunOptions& run, int faces, double, double) {
    const auto result = solve_hertz<2>(
        {.faces = static_cast<double>(faces), .contact = run.contact, .neumann = run.neumann, .corners = run.corners});
    return {.errors = {.pressure = result.pressure_error},
            .cells = result.n_cells,
            .steps = static_cast<std::int64_t>(result.report.iterations.size()),
            .seconds = result.seconds};
}

}  // namespace

const std::vector<Problem>& problems() {
    static const std::vector<Problem> all = {
        slip_problem(2, {10, 20, 40}, 80), slip_problem(3, {6, 12}, 18),
        Problem{.name = "hertz",
                .text = "cylinder on a block at rest, faces in the contact radius; pressure against Hertz",
                .at_rest = true,
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
