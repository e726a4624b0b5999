// Ledger and stable step take any system of points.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "dynamics/row.hpp"

using namespace abut;
using test::random_values;
using test::Row;

TEMPLATE_TEST_CASE_SIG("the ledger of free points has their energy, momentum and angular momentum", "[dynamics][ledger]",
                       ((int Dim), Dim), 2, 3) {
    Row<Dim> row({1.0, 2.0, 0.5}, 0.0);
    std::mt19937 random(3);
    const auto p = random_values(random, row.size());
    dynamics::Memm memm(row, std::vector<double>(row.size(), 0.0), p, 0.1, dynamics::PathMean::gauss_1);
    Vector<Dim> momentum = Vector<Dim>::Zero();
    SmallMatrix<dynamics::n_rotations<Dim>, 1> spin = SmallMatrix<dynamics::n_rotations<Dim>, 1>::Zero();
    double kinetic = 0.0;
    const auto p_i = as_vectors<Dim>(std::span<const double>(p));
    for (std::size_t i = 0; i < p_i.size(); ++i) {
        momentum += p_i[i];
        spin += test::moment<Dim>(row.rest_positions()[i], p_i[i]);
        kinetic += 0.5 * p_i[i].squaredNorm() / row.masses()[i];
    }
    dynamics::Ledger<Dim> ledger;
    for (int step = 0; step <= 20; ++step) {
        const auto entry = dynamics::measure(memm, row);
        CHECK((entry.linear_momentum - momentum).norm() < 1e-14);
        CHECK((entry.angular_momentum - spin).norm() < 1e-13);  // free flight is straight
        CHECK(entry.kinetic == Approx(kinetic).epsilon(1e-14));
        CHECK(entry.active_pairs == 0);
        CHECK(entry.work == 0.0);
        ledger.record(entry);
        memm.step();
    }
    CHECK(ledger.pseudo_energy_drift() < 1e-14);
    CHECK(ledger.parasitic() < 1e-15);
}

TEST_CASE("the stable step of a free chain is 2 over its highest frequency", "[dynamics][stable_step]") {
    const int n = 12;
    const double k = 50.0, m = 2.0;
    Row<2> row(std::vector<double>(n, m), k);
    const double omega = 2.0 * std::sqrt(k / m) * std::cos(std::numbers::pi / (2.0 * n));
    const auto stable = dynamics::stable_step(row);
    CHECK(stable.omega_max == Approx(1.02 * omega).epsilon(2e-3));
    CHECK(stable.omega_max >= omega);
    CHECK(stable.dt == Approx(2.0 / stable.omega_max).epsilon(1e-15));
}

TEMPLATE_TEST_CASE_SIG("an entry of the ledger comes back from its values", "[dynamics][ledger]", ((int Dim), Dim), 2, 3) {
    std::vector<double> values(dynamics::ledger_columns<Dim>().size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(10 + i);
    CHECK(dynamics::ledger_values(dynamics::ledger_entry<Dim>(values)) == values);
    values.pop_back();
    CHECK_THROWS_AS(dynamics::ledger_entry<Dim>(values), BadInput);
}
