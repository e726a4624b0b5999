// Rigid bodies under steps that change, and where restarts of other bodies are on.
#include <catch2/catch.hpp>
#include <cmath>

#include "abut/base/rotation.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/neutral_restart.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using dynamics::StepChange;
using solid::Kinematics;

namespace {

mesh::Mesh<3> uneven_box() {
    return mesh::structured_box<3>({-0.5, -0.35, -0.2}, {0.5, 0.35, 0.2}, {2, 2, 2}, CellShape::hexahedron);
}

solid::SolidOptions<3> one_rigid() {
    auto options = bodies<3>(1);
    options.contact.reset();
    options.kinematics = {Kinematics::rigid};
    return options;
}

/// Largest change of a distance between the points of rigid bodies, over what it is at rest; these are the last points.
template <int Dim>
double change_of_distances(const solid::Solid<Dim>& solid, std::span<const double> q, std::size_t n_rigid = 1) {
    const auto rest = solid.rest_positions();
    const auto u = as_vectors<Dim>(q);
    double change = 0.0;
    for (std::size_t first = rest.size() - n_rigid * (Dim + 1); first < rest.size(); first += Dim + 1)
        for (std::size_t a = first; a < first + Dim + 1; ++a)
            for (std::size_t b = first; b < a; ++b) {
                const Vector<Dim> line = rest[a] - rest[b];
                raise(change, std::abs((line + u[a] - u[b]).norm() / line.norm() - 1.0));
            }
    return change;
}

/// The box after a turn by this, and its momenta there.
struct TurnedStart {
    std::vector<double> q, p;

    TurnedStart(const solid::Solid<3>& solid, double angle)
        : q(solid.size()), p(momentum_of<3>(solid, {{.spin = {0.3, 1.0, 0.2}}})) {
        const Matrix<3> turn = rotation_about(Vector<3>(1.0, 2.0, 3.0).normalized(), angle);
        for (std::size_t i = 0; i < solid.masses().size(); ++i) {
            vectors<3>(q)[i] = turn * solid.rest_positions()[i] - solid.rest_positions()[i];
            const Vector<3> momentum = turn * vectors<3>(p)[i];
            vectors<3>(p)[i] = momentum;
        }
    }
};

}  // namespace

TEST_CASE("a rigid body keeps H~ where steps change from the first on, and its distances", "[solid][kinematics]") {
    const double angle = GENERATE(0.0, 1.0);
    const auto change = GENERATE(StepChange::keep, StepChange::restart);
    const auto mesh = uneven_box();
    solid::Solid<3> solid(mesh, one_rigid());
    const TurnedStart start(solid, angle);
    dynamics::Memm memm(solid, start.q, start.p, 0.1);
    const double energy = memm.pseudo_energy();
    double drift = 0.0, distances = 0.0;
    for (int i = 0; i < 300; ++i) {
        memm.step(0.07 + 0.002 * (i % 3), change);
        raise(drift, std::abs(memm.pseudo_energy() - memm.restart_jumps() - energy));
        raise(distances, change_of_distances<3>(solid, memm.q()));
    }
    CAPTURE(angle, int(change));
    CHECK(drift <= 1e-13 * energy);
    CHECK(distances <= 1e-13);
}

TEST_CASE("a step kept after a restart keeps H~ of a rigid body", "[solid][kinematics]") {
    const auto mesh = uneven_box();
    solid::Solid<3> solid(mesh, one_rigid());
    const TurnedStart start(solid, 0.5);
    dynamics::Memm memm(solid, start.q, start.p, 0.1);
    for (int i = 0; i < 7; ++i) memm.step();
    memm.step(0.08, StepChange::restart);
    const double energy = memm.pseudo_energy();
    memm.step(0.09, StepChange::keep);
    CHECK(std::abs(memm.pseudo_energy() - energy) <= 1e-13 * energy);
    CHECK(change_of_distances<3>(solid, memm.q()) <= 1e-13);
}

TEST_CASE("the restart leaves rigid bodies as they are", "[solid][kinematics]") {
    const int period = GENERATE(1, 7);
    const auto mesh = uneven_box();
    solid::Solid<3> solid(mesh, one_rigid());
    const TurnedStart start(solid, 0.0);
    dynamics::Memm memm(solid, start.q, start.p, 0.2);
    dynamics::NeutralRestart restart(solid, {.period = period});
    memm.set_node_restart([&](auto q, double dt, auto before, auto after) { restart(q, dt, before, after); });
    const double energy = memm.pseudo_energy();
    double drift = 0.0, distances = 0.0;
    for (int i = 0; i < 1000; ++i) {
        memm.step();
        raise(drift, std::abs(memm.pseudo_energy() - energy));
        raise(distances, change_of_distances<3>(solid, memm.q()));
    }
    CHECK(drift <= 1e-12 * energy);
    CHECK(distances <= 1e-12);
}

TEST_CASE("a run that is turned round goes back to where a rigid body began", "[solid][kinematics]") {
    const auto mesh = uneven_box();
    solid::Solid<3> solid(mesh, one_rigid());
    const TurnedStart start(solid, 0.0);
    dynamics::Memm memm(solid, start.q, start.p, 0.1);
    for (int i = 0; i < 100; ++i) memm.step();
    memm.reverse();
    for (int i = 0; i < 100; ++i) memm.step();
    CHECK(largest(memm.q()) <= 1e-12);
}

TEMPLATE_TEST_CASE_SIG("filter and restart on rigid and floating bodies keep H~, momentum and J~", "[solid][kinematics]",
                       ((int Dim), Dim), 2, 3) {
    const bool filtered = GENERATE(false, true);
    mesh::Mesh<Dim> mesh;
    std::vector<Motion<Dim>> motion;
    if constexpr (Dim == 2) {
        mesh = two_discs(0.8);
        motion = {{{0.05, 0.0}, some_spin<2>(0.1)}, {{-0.05, 0.0}, some_spin<2>(0.05)}};
    } else {
        mesh = two_boxes(4);
        motion = {{{0.02, 0.01, 0.05}, some_spin<3>(0.05)}, {{-0.02, 0.0, -0.05}, some_spin<3>(0.1)}};
    }
    TurningScene<Dim> scene(mesh, bodies<Dim>(2), motion, 0.6, std::vector{Kinematics::floating, Kinematics::rigid});
    dynamics::NeutralFilter filter(scene.solid);
    if (filtered)
        scene.memm.set_after_step([&](auto q, double dt, auto before, auto after) { filter(q, dt, before, after); });
    dynamics::NeutralRestart restart(scene.solid, {.period = 10});
    scene.memm.set_node_restart([&](auto q, double dt, auto before, auto after) { restart(q, dt, before, after); });
    scene.run_until(30.0);
    const Drifts drifts = scene.drifts();
    CHECK(scene.solid.contact().report().active_pairs_max > 0);
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.pseudo_moment <= 1e-13);
    CHECK(drifts.momentum <= 1e-13);
    CHECK(change_of_distances<Dim>(scene.solid, scene.memm.q()) <= 1e-12);
}

TEMPLATE_TEST_CASE_SIG("steps of any size kept through a contact of rigid and floating bodies keep H~",
                       "[solid][kinematics]", ((int Dim), Dim), 2, 3) {
    const Kinematics other = GENERATE(Kinematics::rigid, Kinematics::floating);
    mesh::Mesh<Dim> mesh;
    std::vector<Motion<Dim>> motion;
    if constexpr (Dim == 2) {
        mesh = two_discs(0.8);
        motion = {{{0.05, 0.0}, some_spin<2>(0.1)}, {{-0.05, 0.0}, some_spin<2>(0.05)}};
    } else {
        mesh = two_boxes(4);
        motion = {{{0.02, 0.01, 0.05}, some_spin<3>(0.05)}, {{-0.02, 0.0, -0.05}, some_spin<3>(0.1)}};
    }
    TurningScene<Dim> scene(mesh, bodies<Dim>(2), motion, 0.3, std::vector{Kinematics::rigid, other});
    const double dt = scene.memm.dt();
    for (int i = 0; scene.memm.time() < 20.0; ++i) {
        scene.memm.step(dt * (1.0 + 0.3 * std::sin(0.02 * i)), StepChange::keep);
        if (i % 5 == 0) scene.ledger.record(dynamics::measure(scene.memm, scene.solid));
    }
    CHECK(scene.solid.contact().report().active_pairs_max > 0);
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
    CHECK(scene.drifts().momentum <= 1e-13);
    CHECK(change_of_distances<Dim>(scene.solid, scene.memm.q(), other == Kinematics::rigid ? 2 : 1) <= 1e-12);
}
