#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/nodal/rows.hpp"
#include "studies/nodal/scenes.hpp"

namespace abut::studies::turning {
namespace {

std::string name_of(Kinematics strain) { return strain == Kinematics::small ? ", small strain" : ", finite strain"; }

/// Velocity of the left body at the end; the table of five hosts of other makers, with faces that translate.
constexpr double velocity_allowed = 0.01;
const Vector<2> disc_velocity(-0.0280, -0.0399), cylinder_velocity(-0.0276, -0.0403);

template <int Dim>
void slip(const Case<Dim>& impact, const run::RunOptions& run, const std::string& setting, const Vector<2>& velocity,
          const Options& options, const Sink& sink) {
    CaseResult<Dim> result;
    Row row = row_of<Dim>(impact, run, setting, options, &result);
    const Vector<2> left = result.velocity[0].template head<2>();
    // The hosts of the table had small strain; at a twentieth of the wave speed finite strain is another solid.
    double allowed = options.quick ? 5.0 * velocity_allowed : velocity_allowed;
    if (impact.scene.solid.kinematics.front() == Kinematics::finite) allowed = no_target;
    row.quantities.at_most("velocity of the left body, off from the table of hosts",
                           (left - velocity).norm() / velocity.norm(), allowed);
    for (int d = 0; d < 2; ++d)
        row.quantities.near(d == 0 ? "velocity x" : "velocity y", left[d], velocity[d], no_target, "m/s");
    sink(row);
}

/// The angle by which a body has turned [rad], -pi to pi.
double turned_angle(const dynamics::RunView<2>& run, const P1Bodies<2>& bodies, std::size_t body) {
    const Matrix<2> stretch = Matrix<2>::Identity() + bodies.mean_gradients(run.q)[body];
    return std::atan2(stretch(1, 0) - stretch(0, 1), stretch.trace());
}

void turn_gears(int cells_around_tooth, double turns, const std::string& setting, const Options& options, const Sink& sink) {
    constexpr double whole = 2.0 * std::numbers::pi;
    double turned = 0.0, before = 0.0;
    const Watch<2> watch = [&](const auto& run, const auto& bodies) {
        const double angle = turned_angle(run, bodies, 0);
        turned += std::remainder(angle - before, whole);
        before = angle;
    };
    Row row = row_of<2>(gears(cells_around_tooth, turns), options.run, setting, options, nullptr, watch);
    row.quantities.at_most("turns short of those asked for", std::max(0.0, turns - turned / whole), 0.0);
    row.quantities.near("turns of the first gear", turned / whole, turns);
    sink(row);
}

}  // namespace

void run_slipping(const Options& options, const Sink& sink) {
    const double size_2 = options.quick ? 0.2 : 0.03, size_3 = options.quick ? 0.5 : 0.13;
    for (const Scheme scheme : {Scheme::memm, Scheme::leapfrog})
        for (const Kinematics strain : {Kinematics::small, Kinematics::finite}) {
            run::RunOptions run = options.run;
            run.integrator = scheme;
            if (scheme == Scheme::leapfrog) run.filter = false, run.restart = 0;
            const std::string setting = turning::name_of(run) + name_of(strain);
            slip<2>(slipping_discs(strain, size_2), run, setting, disc_velocity, options, sink);
            slip<3>(slipping_cylinders(strain, size_3), run, setting, cylinder_velocity, options, sink);
        }
}

void run_turning(const Options& options, const Sink& sink) {
    const std::string setting = name_of(options.run);
    const bool quick = options.quick;
    sink(row_of<2>(spinning_discs(quick ? 0.25 : 0.08), options.run, setting, options));
    sink(row_of<2>(tumbling_block(quick ? 4 : 10), options.run, setting, options));
    turn_gears(quick ? 6 : 10, quick ? 0.1 : 3.0, setting, options, sink);
    sink(row_of<2>(rotor(quick ? 0.25 : 0.08), options.run, setting, options));
    sink(row_of<3>(spinning_cubes(quick ? 3 : 10), options.run, setting, options));
    sink(row_of<3>(cube_on_corner(quick ? 3 : 6), options.run, setting, options));
}

void run_long(const Options& options, const Sink& sink) {
    run::RunOptions run = options.run;
    run.frames = 0;
    run.steps = options.quick ? std::min<std::int64_t>(options.long_steps, 20'000) : options.long_steps;
    for (const Kinematics strain : {Kinematics::small, Kinematics::finite})
        for (const bool filter : run.integrator == Scheme::memm ? std::vector{false, true} : std::vector{false}) {
            run.filter = filter;
            sink(row_of<2>(disc_between_walls(strain, 0.4), run, turning::name_of(run) + name_of(strain), options));
        }
}

}  // namespace abut::studies::turning
