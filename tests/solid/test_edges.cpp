#include <catch2/catch.hpp>

#include "abut/solid/contact_view.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;

namespace {

/// A box held at its bottom, and a smaller one that its weight presses on it while it slides over the edge or the corner.
mesh::Mesh<3> two_boxes_at_the_edge(bool corner) {
    const double y = corner ? 0.35 : -0.05;
    return together(
        mesh::structured_box<3>({-1.0, -1.0, -0.8}, {1.0, 1.0, 0.0}, {6, 6, 3}, CellShape::tetrahedron, "table"),
        mesh::structured_box<3>({0.2, y, 0.002}, {0.8, y + 0.53, 0.6}, {4, 3, 3}, CellShape::tetrahedron, "slider"));
}

}  // namespace

TEST_CASE("a box that slides off the edge or the corner of another loses no energy and no contact, and nothing explodes",
          "[solid][edges]") {
    const bool corner = GENERATE(false, true);
    const double part = GENERATE(0.9, 0.3);  // of the stable step
    const double gravity = 0.03, speed = 0.25, time = 6.0;
    auto options = reconstructed_bodies<3>(2);
    options.acceleration = {Vector<3>::Zero(), {0.0, 0.0, -gravity}};
    solid::DirichletCondition<3> held;
    held.group = "table.zmin";
    options.boundary.dirichlet = {held};
    Scene<3> scene(two_boxes_at_the_edge(corner), options, {Vector<3>::Zero(), {speed, corner ? speed : 0.0, 0.0}}, -part);
    double fastest = 0.0;
    std::int64_t steps_in_contact = 0;
    while (scene.memm.time() < time) {
        scene.run(1);
        steps_in_contact += scene.solid.contact().report().active_pairs > 0;
        for (std::size_t i = 0; i < scene.solid.size(); ++i)
            raise(fastest, std::abs(scene.memm.p_after()[i] * scene.solid.inverse_mass()[i]));
    }
    const auto report = scene.solid.contact().report();
    CHECK(steps_in_contact > 30);
    CHECK(report.events > 100);
    CHECK(report.missed_contacts == 0);
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-12 * scene.ledger.largest_energy());
    // The box falls freely in the end; no cell is ever much faster than the box that falls.
    CHECK(report.active_pairs == 0);
    CHECK(fastest < 2.0 * (speed + gravity * time));
    const auto slider = solid::body_motions<3>(scene.memm, scene.solid)[1];
    CHECK(slider.velocity[0] == Approx(speed).epsilon(0.2));
    CHECK(slider.velocity[2] < 0.0);
}
