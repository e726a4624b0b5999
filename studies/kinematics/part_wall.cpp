#include <cmath>

#include "abut/solid/contact_view.hpp"
#include "studies/kinematics/closed_forms.hpp"
#include "studies/kinematics/rows.hpp"
#include "studies/kinematics/shapes.hpp"

namespace abut::studies::kinematics {
namespace wall_part {
namespace {

// A square of side 1 whose centre flies towards a wall at x = distance.
constexpr double half = 0.5, distance = 1.25, speed = 0.01, spin = 0.02;

/// When its leading corner reaches the wall [s].
double time_of_rigid_square() {
    return root(0.0, distance / speed, [](double t) {
        return distance - speed * t - half * (std::abs(std::cos(spin * t)) + std::abs(std::sin(spin * t)));
    });
}
/// The same where each point flies straight on: the corner that began at (half, -half) gains spin half t.
double time_of_growing_square() { return (distance - half) / (speed + spin * half); }

/// After the impact of a rigid square without friction: velocity along x and spin.
struct Rebound {
    double velocity, spin;
};
Rebound rebound_at(double time) {
    const double angle = spin * time;
    // The corner that leads is the one at (half, -half) at rest; what it is beside the centre along the wall:
    const double aside = half * (std::sin(angle) - std::cos(angle));
    const double inertia = 1.0 / 6.0;  // of mass 1
    const double approach = speed - spin * aside;
    const double impulse = 2.0 * approach / (1.0 + aside * aside / inertia);
    return {speed - impulse, spin + aside * impulse / inertia};
}

/// Under the reconstruction the faces of `small` bodies translate, and the corner is where its two cells take it.
void meet(Kinematics kinematics, solid::ContactLaw law, const Options& options, const Sink& sink) {
    const int cells = options.quick ? 4 : 8;
    Case<2> one = case_of<2>("square at a wall", {turned_box<2>({.cells = {cells, cells}})}, kinematics);
    one.motion[0] = {.velocity = {speed, 0.0}, .spin = AxialVector<2>(spin)};
    one.is_free = false;
    one.scene.solid.law = law;
    if (kinematics == Kinematics::rigid) one.scene.solid.materials[0].young = 100.0;  // a short impact
    one.scene.solid.obstacles = {contact::plane_obstacle<2>({distance, 0.0}, {-1.0, 0.0}, 5.0)};
    const double exact = time_of_rigid_square(), growing = time_of_growing_square();
    one.scene.time = exact + 15.0;
    one.run.filter = true;
    double met = 0.0;
    solid::BodyMotion<2> end{};
    const Watch<2> watch = [&](const auto& run, const auto& solid) {
        if (met == 0.0 && solid.contact().report().active_pairs_max > 0) met = run.time;
        end = solid::body_motions<2>(run, solid).front();
    };
    const bool tilts = law != solid::ContactLaw::reconstruction;
    Row row = row_of<2>(one, run::name_of(kinematics) + (tilts ? "" : ", reconstruction"), options, nullptr, watch);
    if (kinematics == Kinematics::small)
        row.quantities.near("meets the wall at, of a square that grows [s]", met, growing, tilts ? 5e-3 : no_target);
    row.quantities.near("meets the wall at, of one that does not [s]", met, exact,
                        kinematics == Kinematics::small ? no_target : 5e-3);
    const Rebound rebound = rebound_at(exact);
    const double allowed = kinematics == Kinematics::rigid ? 0.1 : no_target;
    row.quantities.push_back({.name = "velocity along x after it, of an impulse at the corner",
                              .unit = "",
                              .value = end.velocity.x(),
                              .reference = rebound.velocity,
                              .scale = speed,
                              .allowed = allowed});
    row.quantities.push_back({.name = "spin after it, of an impulse at the corner",
                              .unit = "",
                              .value = end.spin[0],
                              .reference = rebound.spin,
                              .scale = spin,
                              .allowed = allowed});
    sink(row);
}

}  // namespace
}  // namespace wall_part

void run_wall(const Options& options, const Sink& sink) {
    using namespace wall_part;
    meet(Kinematics::small, solid::ContactLaw::reconstruction, options, sink);
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating, Kinematics::rigid})
        meet(kinematics, solid::ContactLaw::pair_potential, options, sink);
}

}  // namespace abut::studies::kinematics
