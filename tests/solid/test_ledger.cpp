#include <catch2/catch.hpp>

#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;

TEMPLATE_TEST_CASE_SIG("a ledger entry has a name for each of its numbers", "[solid][ledger]", ((int Dim), Dim), 2, 3) {
    dynamics::LedgerEntry<Dim> entry{};
    entry.step = 7;
    entry.events = 9;
    entry.linear_momentum = Vector<Dim>::Constant(3.0);
    const auto names = dynamics::ledger_columns<Dim>();
    const auto values = dynamics::ledger_values(entry);
    REQUIRE(names.size() == values.size());
    const auto at = [&](const std::string& name) {
        return values[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
    };
    CHECK(at("step") == 7.0);
    CHECK(at("events") == 9.0);
    CHECK(at("linear_momentum_y") == 3.0);
}

TEMPLATE_TEST_CASE_SIG("the ledger measures the energies and momenta of a uniform motion exactly", "[solid][ledger]",
                       ((int Dim), Dim), 2, 3) {
    const Vector<Dim> velocity = 0.5 * Vector<Dim>::Ones();
    Vector<Dim> lower = Vector<Dim>::Zero();
    lower[0] = 2.0;
    const Vector<Dim> upper = lower + Vector<Dim>::Ones();
    auto options = reconstructed_bodies<Dim>(1);
    options.materials[0].density = 3.0;
    Scene<Dim> scene(mesh::box<Dim>({.lower = lower, .upper = upper, .size = 0.5}), options, {velocity}, 0.01);
    scene.run(10);
    const auto& entry = scene.ledger.entries().back();
    CHECK(entry.kinetic == Approx(0.5 * 3.0 * velocity.squaredNorm()).epsilon(1e-13));
    CHECK(entry.energy == Approx(entry.pseudo_energy).epsilon(1e-13));
    CHECK(std::abs(entry.potential) < 1e-13);
    CHECK((entry.linear_momentum - 3.0 * velocity).norm() < 1e-13);
    // Mass 3 with its centre at (2.5, 0.5): L_z = m (x v_y - y v_x).
    CHECK(entry.angular_momentum[Dim == 2 ? 0 : 2] == Approx(3.0 * (2.5 - 0.5) * 0.5).epsilon(1e-12));
    CHECK(entry.parasitic < 1e-12);
    CHECK(entry.time == Approx(0.1).epsilon(1e-14));
    CHECK(entry.step == 10);
    const auto motion = solid::body_motions<Dim>(scene.memm, scene.solid)[0];
    CHECK(motion.mass == Approx(3.0).epsilon(1e-13));
    CHECK((motion.velocity - velocity).norm() < 1e-13);
}

TEST_CASE("what cells took along that left is no deviation of a ledger", "[solid][ledger]") {
    dynamics::Ledger<2> ledger;
    dynamics::LedgerEntry<2> entry{};
    entry.pseudo_energy = entry.energy = 10.0;
    entry.linear_momentum = {3.0, 4.0};
    entry.rest_angular_momentum[0] = entry.angular_momentum[0] = entry.pseudo_angular_momentum[0] = 2.0;
    ledger.record(entry);
    entry.pseudo_energy = entry.energy = 8.0;
    entry.eroded = {.cells = 2, .mass = 1.0, .momentum = {1.0, 0.5}, .kinetic = 2.5, .potential = -0.5};
    entry.eroded.rest_angular_momentum[0] = entry.eroded.pseudo_angular_momentum[0] = -1.0;
    entry.linear_momentum = {2.0, 3.5};
    entry.rest_angular_momentum[0] = entry.angular_momentum[0] = entry.pseudo_angular_momentum[0] = 3.0;
    ledger.record(entry);
    for (const double drift :
         {ledger.pseudo_energy_drift(), ledger.energy_drift(), ledger.momentum_drift(), ledger.angular_momentum_drift(),
          ledger.rest_angular_momentum_drift(), ledger.pseudo_angular_momentum_drift()})
        CHECK(drift == 0.0);
    const auto again = dynamics::ledger_entry<2>(dynamics::ledger_values(entry));
    CHECK(again.eroded.cells == 2);
    CHECK(again.eroded.energy() == 2.0);
    CHECK(again.eroded.momentum == entry.eroded.momentum);
}

TEST_CASE("a ledger keeps the largest deviations from its first entry", "[solid][ledger]") {
    dynamics::Ledger<2> ledger;
    dynamics::LedgerEntry<2> entry{};
    entry.pseudo_energy = 10.0;
    entry.energy = 10.0;
    ledger.record(entry);
    entry.pseudo_energy = 12.5;
    entry.work = 2.0;  // of the gain, 2 came from outside
    entry.energy = 13.0;
    entry.linear_momentum = {3.0, 4.0};
    entry.angular_momentum[0] = -6.0;
    entry.parasitic = 0.1;
    ledger.record(entry);
    entry = ledger.entries().front();
    ledger.record(entry);
    CHECK(ledger.pseudo_energy_drift() == Approx(0.5));
    CHECK(ledger.energy_excess() == Approx(0.5));
    CHECK(ledger.momentum_drift() == Approx(5.0));
    CHECK(ledger.angular_momentum_drift() == Approx(6.0));
    CHECK(ledger.parasitic() == Approx(0.1));
    CHECK(ledger.largest_energy() == Approx(13.0));
    CHECK(ledger.entries().size() == 3);
    entry.pseudo_energy = std::nan("");
    ledger.record(entry);
    CHECK(std::isnan(ledger.pseudo_energy_drift()));  // never hidden by a maximum
}
