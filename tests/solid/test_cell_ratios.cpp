// A round body on cells that are larger than its own, under both laws of contact.
#include <catch2/catch.hpp>

#include "abut/solid/body_motion.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;

namespace {

/// A round body above a block of faces so many times as large as its own, off the middle of them: apart by a gap.
template <int Dim>
mesh::Mesh<Dim> round_over_block(double ratio, double gap) {
    if constexpr (Dim == 2) {
        const double radius = 0.2, size = 0.02, cell = ratio * size;
        const int half = static_cast<int>(std::ceil(1.92 / cell));
        return together(mesh::structured_box<2>({-half * cell, -half * cell}, {half * cell, 0.0}, {2 * half, half},
                                                CellShape::triangle, "block"),
                        mesh::disc({.centre = {0.3, radius + gap}, .radius = radius, .size = size, .name = "round"}));
    } else {
        const double radius = 0.5, size = 0.15, cell = ratio * size;
        return together(mesh::structured_box<3>({-2.0 * cell, -2.0 * cell, -cell}, {2.0 * cell, 2.0 * cell, 0.0}, {4, 4, 1},
                                                CellShape::tetrahedron, "block"),
                        mesh::sphere({.centre = {0.2, 0.1, radius + gap}, .radius = radius, .size = size, .name = "round"}));
    }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "a round body leaves coarser cells straight, with less than its speed, and nothing pushes before they touch, under "
    "both laws",
    "[solid][contact]", ((int Dim), Dim), 2, 3) {
    const auto law = GENERATE(solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential);
    const double ratio = GENERATE(3.0, Dim == 2 ? 12.0 : 8.0);
    const double speed = Dim == 2 ? 0.02 : 5e-4, gap = Dim == 2 ? 0.005 : 0.002, in_contact = Dim == 2 ? 3.5 : 66.0;  // [s]
    auto options = bodies<Dim>(2);
    options.law = law;
    Scene<Dim> scene(round_over_block<Dim>(ratio, gap), options, {Vector<Dim>::Zero(), -speed * Vector<Dim>::Unit(Dim - 1)});
    CHECK(scene.solid.potential(scene.memm.q()) == 0.0);
    scene.run_until(0.9 * gap / speed);
    CHECK(scene.ledger.entries().back().events == 0);
    CHECK(scene.ledger.entries().back().kinetic == Approx(scene.kinetic_start()).epsilon(1e-12));
    scene.run_until(gap / speed + in_contact, 10);
    CHECK(scene.ledger.entries().back().active_pairs == 0);
    const Vector<Dim> left = solid::body_motions<Dim>(scene.memm, scene.solid)[1].velocity / speed;
    CHECK(left[Dim - 1] > 0.0);
    CHECK(left[Dim - 1] < 1.0);
    CHECK(left.template head<Dim - 1>().norm() < 0.01);
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-12 * scene.kinetic_start());
}
