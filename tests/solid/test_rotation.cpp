// How far bodies have turned, and what linear strains make of that.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "abut/solid/cell_view.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;

TEMPLATE_TEST_CASE_SIG("the rotation of each body is that of its positions, whatever its shape, place and stretch",
                       "[solid][rotation]", ((int Dim), Dim), 2, 3) {
    const auto mesh = together(mesh::box<Dim>({.size = 0.3, .name = "box"}), round_body<Dim>(0.5));
    solid::Solid<Dim> solid(mesh, bodies<Dim>(2));
    for (const double angle : {0.0, 1e-9, 1e-3, 0.1, 1.0, 3.0}) {
        const Matrix<Dim> rotation = turned_by<Dim>(angle), stretch = 1.3 * Matrix<Dim>::Identity();
        std::vector<double> q;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            const Vector<Dim>& x = mesh.cell_centroid[c];
            const Vector<Dim> moved = mesh.cell_body[c] == 0 ? Vector<Dim>(rotation * x + Vector<Dim>::Constant(5.0))
                                                             : Vector<Dim>(rotation.transpose() * stretch * x);
            const Vector<Dim> u = moved - x;
            q.insert(q.end(), u.begin(), u.end());
        }
        const auto angles = solid.rotations(q);
        REQUIRE(angles.size() == 2);
        for (const double found : angles) CHECK(std::abs(found - angle) < 1e-11);
    }
}

TEMPLATE_TEST_CASE_SIG("a body that spins freely grows by 1/cos of its angle, and only its rotation shows it",
                       "[solid][rotation]", ((int Dim), Dim), 2, 3) {
    const auto mesh = mesh::structured_box<Dim>(
        Vector<Dim>::Constant(-0.5), Vector<Dim>::Constant(0.5),
        [] {
            std::array<int, Dim> cells;
            cells.fill(4);
            return cells;
        }(),
        Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron);
    auto options = bodies<Dim>(1);
    options.contact.reset();
    solid::Solid<Dim> solid(mesh, options);
    const double omega = 0.05;
    std::vector<double> p;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const Vector<Dim>& x = mesh.cell_centroid[c];
        Vector<Dim> v = Vector<Dim>::Zero();
        v[0] = -omega * x[1];
        v[1] = omega * x[0];
        v *= solid.masses()[c];
        p.insert(p.end(), v.begin(), v.end());
    }
    const double dt = 0.5 * dynamics::stable_step(solid).dt;
    dynamics::Memm<solid::Solid<Dim>> memm(solid, std::vector<double>(p.size(), 0.0), p, dt);
    dynamics::Ledger<Dim> ledger;
    ledger.record(dynamics::measure(memm, solid));
    while (omega * memm.time() < 0.5) {
        memm.step();
        ledger.record(dynamics::measure(memm, solid));
    }
    const double angle = std::atan(omega * memm.time());  // of I + omega t x
    CHECK(ledger.rotation() == Approx(angle).epsilon(1e-9));
    const double spin = ledger.entries().front().rest_angular_momentum.norm();
    CHECK(ledger.rest_angular_momentum_drift() < 1e-13 * spin);
    CHECK(ledger.angular_momentum_drift() < 1e-12 * spin);  // free flight is straight: about the origin it stays, too
    CHECK(ledger.pseudo_energy_drift() < 1e-13 * ledger.largest_energy());
    // The corner cell is farther from the middle than it was, and no number but the rotation says so.
    const Vector<Dim> x = mesh.cell_centroid[0], u = as_vectors<Dim>(memm.q())[0];
    CHECK((x + u).template head<2>().norm() / x.template head<2>().norm() == Approx(1.0 / std::cos(angle)).epsilon(1e-9));
}

TEMPLATE_TEST_CASE_SIG(
    "vertices of a body that has turned are where it is, though they lie far from the centres of their cells",
    "[solid][rotation][kinematics]", ((int Dim), Dim), 2, 3) {
    using solid::Kinematics;
    const auto mesh = mesh::box<Dim>({.size = 0.5, .name = "box"});
    const Matrix<Dim> rotation = turned_by<Dim>(2.0);
    const std::vector<double> q = sampled<Dim>(
        mesh, [&](const Vector<Dim>& x) -> Vector<Dim> { return rotation * x - x + Vector<Dim>::Constant(0.3); });
    for (const Kinematics kinematics : {Kinematics::floating, Kinematics::finite, Kinematics::rigid}) {
        auto options = bodies<Dim>(1);
        options.contact.reset();
        options.kinematics = {kinematics};
        solid::Solid<Dim> solid(mesh, options);
        const std::vector<double> state = solid.cells().to_q(vectors<Dim>(q));
        static_cast<void>(solid.potential(state));
        const std::vector<Vector<Dim>> displacement = solid.cells().vertex_displacement(state);
        REQUIRE(displacement.size() == mesh.vertices.size());
        double worst = 0.0;
        for (std::size_t v = 0; v < displacement.size(); ++v) {
            const Vector<Dim>& x = mesh.vertices[v];
            raise(worst, (displacement[v] - (rotation * x - x + Vector<Dim>::Constant(0.3))).norm());
        }
        CAPTURE(static_cast<int>(kinematics));
        CHECK(worst < 1e-12);
    }
}
