// An elastic bar falls on a rigid wall and bounces: rho u'' = E u_xx - rho g, no tension at the wall.
//
// L = 10 m, E = 900 Pa, rho = 1 kg/m^3, nu = 0, so waves run at c = sqrt(E/rho) = 30 m/s. From rest 5 m above the wall under
// g = 10 m/s^2 it hits at t = 1 s with v = 10 m/s. A wave runs up and back in 2L/c; so long the wall presses with
// rho c (v + g t), from 300 to 500 Pa: the impulse is 2 rho L (v + g L/c) = 266.667 N s/m^2. Here the bar is a strip of
// 100 x 2 squares on rollers, so that its waves are those of one dimension. It takes the impulse to 1 %.
#include <cmath>
#include <cstdio>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/solid/contact_view.hpp"

using namespace abut;

namespace {

constexpr double length = 10.0, width = 0.2, height = 5.0, gravity = 10.0, young = 900.0, density = 1.0;  // SI
constexpr int cells = 100;                                                                                // along the bar

run::Scene<2> bar_above_wall() {
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({0.0, height}, {width, height + length}, {2, cells}, mesh::CellShape::quadrangle);
    scene.solid.materials = {{.young = young, .poisson = 0.0, .density = density}};
    scene.solid.acceleration = {Vector<2>(0.0, -gravity)};
    for (const char* side : {"xmin", "xmax"})
        scene.solid.boundary.dirichlet.push_back({.group = side, .constraint = solid::Constraint::normal});
    scene.solid.obstacles = {contact::plane_obstacle<2>(Vector<2>::Zero(), Vector<2>::UnitY(), 1.0)};
    scene.velocity = {Vector<2>::Zero()};
    scene.energy_scale = {"H0", density * length * width * gravity * height};  // all is at rest at the start
    scene.time = 2.0;                                                          // the first impact is over
    return scene;
}

}  // namespace

int main() {
    double impulse = 0.0, begin = 0.0, time = 0.0;  // per area of the bar [N s/m^2]; first contact [s]
    run::Scene<2> scene = bar_above_wall();
    scene.after_step = [&](const solid::Solid<2>& solid, double dt) {
        const double pressure = -solid.contact().obstacle_force(0).y() / width;  // mean of the step [Pa]
        if (pressure > 0.0 && begin == 0.0) begin = time;
        impulse += pressure * dt;
        time += dt;
    };
    run::RunOptions options{.filter = true};   // takes out the vibration from step to step that contact leaves behind
    options.contact.compression_limit = 10.0;  // at a third of the wave speed the foot gives way by more than its cell
    const run::RunResult<2> result = run::simulate<2>(scene, options);

    const double speed = std::sqrt(2.0 * gravity * height), wave_speed = std::sqrt(young / density);
    const double exact = 2.0 * density * length * (speed + gravity * length / wave_speed);
    const double drift = result.ledger.pseudo_energy_drift() / result.energy.scale.value;
    std::printf("first contact    %8.4f s         %8.4f\n", begin, speed / gravity);
    std::printf("impulse          %8.3f N s/m^2   %8.3f\n", impulse, exact);
    std::printf("drift of H~ / H0 %8.1e           round-off\n", drift);
    const bool good = std::abs(begin - speed / gravity) < 2.0 * result.run.dt && std::abs(impulse - exact) < 0.01 * exact;
    return good && drift < 1e-11 ? 0 : 1;
}
