// A rigid wall that moves at constant speed runs into an elastic block at rest and throws it forward.
//
// L = 1 m, E = 100 Pa, rho = 1 kg/m^3, nu = 0, so c = 10 m/s; the wall comes at V = 0.5 m/s. Seen from the wall a block
// comes and rebounds: the wall presses with rho c V for 2L/c, the block leaves it with 2V, and the wall has done the work
// rho c V * 2L/c * V = 2 m V^2 = m (2V)^2 / 2, all of it motion. The scheme counts this work, and H~ gains just as much.
#include <cmath>
#include <cstdio>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/steps/simulation.hpp"

using namespace abut;

namespace {

constexpr double length = 1.0, height = 0.1, gap = 0.05, young = 100.0, density = 1.0, speed = 0.5;  // SI
constexpr double mass = density * length * height;                                                   // [kg/m]

run::Scene<2> block_and_wall() {
    run::Scene<2> scene;
    scene.mesh =
        mesh::structured_box<2>({gap, 0.0}, {gap + length, height}, {100, 10}, mesh::CellShape::quadrangle, "block");
    scene.solid.materials = {{.young = young, .poisson = 0.0, .density = density}};
    const auto path = [](double t) { return Vector<2>(speed * t, 0.0); };  // of the wall, from where it is at t = 0
    scene.solid.obstacles = {contact::plane_obstacle<2>(Vector<2>(0.0, 0.5 * height), Vector<2>::UnitX(), 1.0, path)};
    scene.velocity = {Vector<2>::Zero()};
    scene.energy_scale = {"W0", 2.0 * mass * speed * speed};
    scene.time = gap / speed + 2.0 * 2.0 * length / std::sqrt(young / density);  // it touches, and twice a contact [s]
    return scene;
}

}  // namespace

int main() {
    const run::Scene<2> scene = block_and_wall();
    run::RunOptions options{.filter = true};
    options.contact.compression_limit = 5.0;  // near the wall cells are pressed in deeper than they are on the mean
    const run::RunResult<2> result = run::simulate<2>(scene, options);

    const auto& first = result.ledger.entries().front();
    const auto& last = result.ledger.entries().back();
    const double gained = last.pseudo_energy - first.pseudo_energy, exact = 2.0 * mass * speed * speed;
    const double left = result.bodies.end[0].velocity.x();
    std::printf("work of the wall   %.12f J/m   %.4f\n", last.work, exact);
    std::printf("energy gained, H~  %.12f J/m   the same to round-off\n", gained);
    std::printf("speed of the block %.6f m/s        %.4f\n", left, 2.0 * speed);
    std::printf("max (H - H~) / W0  %.1e             what H~ does not see\n", result.ledger.energy_excess() / exact);
    const bool same = std::abs(last.work - gained) < 1e-12 * exact;
    return same && std::abs(last.work - exact) < 0.02 * exact && std::abs(left - 2.0 * speed) < 0.03 * speed ? 0 : 1;
}
