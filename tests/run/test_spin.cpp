#include <catch2/catch.hpp>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/scene.hpp"

namespace {

using namespace abut;

/// Two boxes about (0.5, 0.5) and (3, 1), the second one spins.
run::Scene<2> spinning_box() {
    run::Scene<2> scene;
    scene.mesh = mesh::combine<2>(
        std::vector{mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {2, 2}, mesh::CellShape::quadrangle, "still"),
                    mesh::structured_box<2>({2.0, 0.0}, {4.0, 2.0}, {3, 3}, mesh::CellShape::quadrangle, "spinning")});
    scene.solid.materials.assign(2, {.young = 1.0, .poisson = 0.0, .density = 2.0});
    scene.solid.kinematics.assign(2, solid::Kinematics::small);
    scene.velocity = {Vector<2>(1.0, 0.0), Vector<2>(0.0, -1.0)};
    scene.spin = {AxialVector<2>(0.0), AxialVector<2>(0.3)};
    return scene;
}

}  // namespace

TEST_CASE("a body that spins has the momentum m (v + spin x r) in each of its cells, r from its centroid", "[run][spin]") {
    const run::Scene<2> scene = spinning_box();
    const solid::Solid<2> solid(scene.mesh, run::solid_options(scene, {}));
    const std::vector<double> momentum = run::momentum_at_start(scene, solid);
    for (std::size_t cell = 0; cell < scene.mesh.cell_measure.size(); ++cell) {
        const bool spins = scene.mesh.cell_body[cell] == 1;
        const Vector<2> arm = scene.mesh.cell_centroid[cell] - Vector<2>(3.0, 1.0);
        const Vector<2> velocity = spins ? Vector<2>(-0.3 * arm.y(), -1.0 + 0.3 * arm.x()) : Vector<2>(1.0, 0.0);
        const double mass = 2.0 * scene.mesh.cell_measure[cell];
        CHECK(momentum[2 * cell] == Approx(mass * velocity.x()).margin(1e-15));
        CHECK(momentum[2 * cell + 1] == Approx(mass * velocity.y()).margin(1e-15));
    }
}

TEST_CASE("spins are given for all bodies or for none", "[run][spin]") {
    run::Scene<2> scene = spinning_box();
    scene.spin.pop_back();
    const solid::Solid<2> solid(scene.mesh, run::solid_options(scene, {}));
    CHECK_THROWS_AS(run::momentum_at_start(scene, solid), BadInput);
}

TEST_CASE("a floating body that spins has its momentum, and the moment of its own inertia", "[run][spin]") {
    run::Scene<2> scene = spinning_box();
    scene.solid.kinematics.assign(2, solid::Kinematics::floating);
    const solid::Solid<2> solid(scene.mesh, run::solid_options(scene, {}));
    const std::vector<double> momentum = run::momentum_at_start(scene, solid);
    Vector<2> sum = Vector<2>::Zero();
    double moment = 0.0;
    for (std::size_t cell = 0; cell < scene.mesh.cell_measure.size(); ++cell) {
        if (scene.mesh.cell_body[cell] != 1) continue;
        const Vector<2> p(momentum[2 * cell], momentum[2 * cell + 1]);
        const Vector<2> arm = solid.rest_positions()[cell] - Vector<2>(3.0, 1.0);
        sum += p;
        moment += arm.x() * p.y() - arm.y() * p.x();
    }
    CHECK((sum - 8.0 * Vector<2>(0.0, -1.0)).norm() <= 1e-13);      // a mass of 2 * 4
    CHECK(moment == Approx(0.3 * 8.0 * 4.0 / 6.0).epsilon(1e-12));  // m L^2/6 of a square
}
