#include <catch2/catch.hpp>

#include <memory>

#include "abut/base/error.hpp"
#include "abut/contact/contact.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;

namespace {

template <int Dim>
std::unique_ptr<Scene<Dim>> impact() {
    if constexpr (Dim == 2) {
        const auto lower = mesh::structured_box<2>({-1.0, -1.0}, {1.0, 0.0}, {9, 5}, CellShape::triangle, "lower");
        const auto upper = mesh::structured_box<2>({-0.5, 0.01}, {0.7, 1.0}, {5, 4}, CellShape::triangle, "upper");
        return std::make_unique<Scene<2>>(together(lower, upper), reconstructed_bodies<2>(2),
                                          std::vector<Vector<2>>{{0.02, 0.05}, {-0.02, -0.05}});
    } else {
        return std::make_unique<Scene<3>>(two_boxes(4), reconstructed_bodies<3>(2), box_velocities);
    }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the pressures of two flat bodies on each other add up to the force between them", "[solid][contact]",
                       ((int Dim), Dim), 2, 3) {
    const auto scene = impact<Dim>();
    const mesh::Mesh<Dim>& mesh = scene->mesh;
    double largest_force = 0.0;
    for (int i = 0; i < 60; ++i) {
        scene->run(1);
        const auto q = scene->memm.q();
        const auto field = scene->solid.contact_at(q).field();
        std::array<double, 2> pressed{};
        for (std::size_t b = 0; b < field.pressure.size(); ++b) {
            const std::int32_t f = mesh.boundary_faces[b];
            pressed[static_cast<std::size_t>(mesh.cell_body[mesh.face_cells[f][0]])] +=
                field.pressure[b] * mesh.face_measure[f];
            if (field.pressure[b] != 0.0) CHECK(field.gap[b] < 0.0);
        }
        std::vector<double> force(q.size());
        scene->solid.force(q, force);
        double lift = 0.0, size = 0.0;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            raise(size, vectors<Dim>(force)[c].norm());
            if (mesh.cell_body[c] == 1) lift += vectors<Dim>(force)[c][Dim - 1];
        }
        CHECK(std::abs(pressed[0] - lift) < 1e-12 * size);
        CHECK(std::abs(pressed[1] - lift) < 1e-12 * size);
        raise(largest_force, lift);
    }
    CHECK(largest_force > 1e-3);
}

TEST_CASE("H~ is exact for steps that change slowly through an impact, with lists rebuilt on the way", "[solid][contact]") {
    Scene<2> scene(two_discs(0.8), reconstructed_bodies<2>(2), disc_velocities);
    const double dt = scene.memm.dt();
    for (int i = 0; i < 600; ++i) {
        scene.memm.step((0.8 + 0.2 * std::sin(0.05 * i)) * dt, dynamics::StepChange::keep);
        scene.record();
    }
    CHECK(scene.solid.contact().report().events > 10);
    CHECK(scene.solid.contact().report().rebuilds > 3);
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-11 * scene.kinetic_start());
    CHECK(scene.ledger.momentum_drift() < 1e-12);
}

TEST_CASE("restarts in the middle of an impact change H~ by what they report", "[solid][contact]") {
    Scene<2> scene(two_discs(0.8), reconstructed_bodies<2>(2), disc_velocities);
    const double dt = scene.memm.dt();
    for (int i = 0; i < 300; ++i) {
        scene.memm.step(i % 60 < 30 ? dt : 0.6 * dt, dynamics::StepChange::restart);
        scene.record();
    }
    CHECK(std::abs(scene.memm.restart_jumps()) > 1e-9 * scene.kinetic_start());
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-11 * scene.kinetic_start());
}

TEST_CASE("a state that is not finite is refused, never taken for one that has not moved", "[solid][errors]") {
    Scene<2> scene(two_discs(0.8), reconstructed_bodies<2>(2), disc_velocities);
    scene.run(20);
    const std::vector<double> q(scene.memm.q().begin(), scene.memm.q().end());
    std::vector<double> broken = q, force(q.size());
    const std::int32_t cell = scene.mesh.face_cells[scene.mesh.boundary_faces[3]][0];
    broken[static_cast<std::size_t>(2 * cell)] = std::nan("");
    CHECK_THROWS_WITH(scene.solid.mean_force(q, broken, scene.memm.time(), scene.memm.dt(), force),
                      Catch::Matchers::Contains("not finite"));
}

namespace {

/// Body 1 moved as a whole.
template <int Dim>
std::vector<double> upper_moved(const mesh::Mesh<Dim>& mesh, double height) {
    std::vector<double> q(static_cast<std::size_t>(mesh.n_cells() * Dim), 0.0);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (mesh.cell_body[c] == 1) vectors<Dim>(q)[c][Dim - 1] = height;
    return q;
}

template <int Dim>
mesh::Mesh<Dim> flat_bodies() {
    return impact<Dim>()->mesh;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a run starts from its own state, whatever state was looked at before", "[solid][contact]",
                       ((int Dim), Dim), 2, 3) {
    const auto mesh = flat_bodies<Dim>();
    auto options = reconstructed_bodies<Dim>(2);
    options.contact->search.skin = 0.2;
    const auto pressed = upper_moved(mesh, -0.03);
    solid::Solid<Dim> fresh(mesh, options);
    const double energy = fresh.potential(pressed);
    REQUIRE(energy > 1e-5);

    const double looked_at = GENERATE(0.0, -0.01, 5.0);  // within the skin of `pressed`, in contact, and far
    solid::Solid<Dim> solid(mesh, options);
    CHECK(solid.potential(upper_moved(mesh, looked_at)) >= 0.0);
    CHECK(solid.potential(pressed) == Approx(energy).epsilon(1e-13));
    const std::vector<double> at_rest(solid.size(), 0.0);
    dynamics::Memm<solid::Solid<Dim>> memm(solid, pressed, at_rest, 0.5 * dynamics::stable_step(solid).dt);
    dynamics::Ledger<Dim> ledger;
    for (int i = 0; i < 40; ++i) {
        ledger.record(dynamics::measure(memm, solid));
        memm.step();
    }
    CHECK(ledger.pseudo_energy_drift() < 1e-12 * ledger.largest_energy());
    CHECK(solid.contact().report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("in the middle of a run a state beyond the candidate list is refused, and so is another run",
                       "[solid][contact][errors]", ((int Dim), Dim), 2, 3) {
    const auto scene = impact<Dim>();
    scene->run(10);
    CHECK_THROWS_AS(scene->solid.potential(upper_moved(scene->mesh, 1.0)), Misuse);
    CHECK_THROWS_WITH(scene->solid.contact_at(upper_moved(scene->mesh, 1.0)).field(),
                      Catch::Matchers::Contains("half the skin") && Catch::Matchers::Contains("CandidateOptions::skin"));
    try {
        static_cast<void>(scene->solid.potential(upper_moved(scene->mesh, 1.0)));
    } catch (const Error& error) {
        CHECK(error.facts().allowed == 0.5 * scene->solid.contact().reconstruction()->skin());
        CHECK(error.facts().value > error.facts().allowed);
    }
    const std::vector<double> q(scene->memm.q().begin(), scene->memm.q().end()), zero(q.size(), 0.0);
    dynamics::Memm<solid::Solid<Dim>> again(scene->solid, q, zero, scene->memm.dt());
    CHECK_THROWS_WITH(again.step(), Catch::Matchers::Contains("make a Solid for every run"));
    scene->run(50);  // none of it has done any harm
    CHECK(scene->ledger.pseudo_energy_drift() < 1e-11 * scene->kinetic_start());
    CHECK(scene->solid.contact().report().active_pairs_max > 0);
}

TEST_CASE("a state that a long step has reached is within the list, however thin the skin", "[solid][contact]") {
    auto options = reconstructed_bodies<2>(2);
    options.contact->search.skin = 1e-6;
    Scene<2> scene(two_discs(0.8, 0.3), options, disc_velocities);
    scene.run(80);  // a record after every step asks for the potential
    CHECK(scene.solid.contact().report().rebuilds >= 80);
    CHECK(scene.solid.contact().report().events > 0);
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-11 * scene.kinetic_start());
}
