// The contact solid under every scheme that steps all cells together.
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/dynamics/bilbao.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/integrator_runs.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Solid;

namespace {

const auto memm = [](auto& solid, auto q, const auto& p, const auto& stable) {
    return dynamics::Memm(solid, std::move(q), p, 0.9 * stable.dt);
};

}  // namespace

TEST_CASE("leapfrog and Bilbao carry two discs through an impact like MEMM", "[solid][integrators][contact]") {
    const auto mesh = two_discs(0.8);
    std::vector<double> q_memm, q_leapfrog, q_bilbao;
    const double time = 6.0;
    const auto leapfrog = run<2>(
        mesh, disc_velocities, time,
        [](auto& solid, auto q, const auto& p, const auto& stable) {
            return dynamics::Leapfrog(solid, std::move(q), p, 0.9 * stable.dt);
        },
        &q_leapfrog);
    double gauge = 0.0;
    const auto bilbao = run<2>(
        mesh, disc_velocities, time,
        [&](auto& solid, auto q, const auto& p, const auto& stable) {
            gauge = 0.5 * dynamics::mass_product(p, solid.inverse_mass(), p);
            return dynamics::Bilbao(solid, std::move(q), p, 0.9 * stable.dt, gauge);
        },
        &q_bilbao);
    const auto plain = run<2>(mesh, disc_velocities, time, memm, &q_memm);
    const double k_0 = plain.entries().front().kinetic;
    CHECK(plain.pseudo_energy_drift() < 1e-13 * k_0);
    CHECK(bilbao.pseudo_energy_drift() < 1e-13 * k_0);
    CHECK(leapfrog.energy_drift() < 0.02 * k_0);
    CHECK(leapfrog.energy_drift() > 1e-6 * k_0);
    CHECK(leapfrog.parasitic() < 1e-14);
    for (const auto& ledger : {leapfrog, bilbao, plain}) {
        CHECK(ledger.momentum_drift() < 1e-14);
        CHECK(ledger.energy_drift() < 0.05 * k_0);
    }
    const double moved = largest(q_memm);
    for (std::size_t i = 0; i < q_memm.size(); ++i) {
        REQUIRE(std::abs(q_leapfrog[i] - q_memm[i]) < 0.02 * moved);
        REQUIRE(std::abs(q_bilbao[i] - q_memm[i]) < 0.02 * moved);
    }
}

TEST_CASE("leapfrog takes the work of conditions with a history by the trapezoidal rule: the balance closes at second order",
          "[solid][integrators][obstacle]") {
    const auto imbalance = [](double cfl) {
        const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.5}, {8, 4}, CellShape::quadrangle);
        auto options = reconstructed_bodies<2>(1);
        options.boundary.dirichlet.push_back(
            {.group = "ymin", .constraint = solid::Constraint::full, .history = [](double t, const Vector<2>&) {
                 return Vector<2>(0.0, 0.01 * std::pow(std::sin(t), 2));
             }});
        Solid<2> solid(mesh, options);
        const std::vector<double> zero(solid.size(), 0.0);
        dynamics::Leapfrog leapfrog(solid, zero, zero, cfl * dynamics::stable_step(solid).dt);
        dynamics::Ledger<2> ledger;
        while (leapfrog.time() < 3.0) {
            ledger.record(dynamics::measure(leapfrog, solid));
            leapfrog.step();
        }
        CHECK(solid.work() > 1e-6);
        return ledger.energy_drift() / ledger.largest_energy();
    };
    const double coarse = imbalance(0.4), fine = imbalance(0.2);
    CHECK(coarse < 0.05);
    CHECK(coarse / fine > 3.0);
}

TEST_CASE("leapfrog takes the work of a moving wall by the trapezoidal rule: the balance closes better with shorter steps",
          "[solid][integrators][obstacle]") {
    const auto imbalance = [](double cfl) {
        const auto result = fall(Falling(0.05), 4.0, [&](auto& solid, auto q, const auto& p, const auto& stable) {
            return dynamics::Leapfrog(solid, std::move(q), p, cfl * stable.dt);
        });
        CHECK(result.work > 1e-4);
        return result.imbalance;
    };
    const double coarse = imbalance(0.8), fine = imbalance(0.1);
    CHECK(coarse < 0.05);
    CHECK(fine < 0.25 * coarse);
}

TEST_CASE("Bilbao refuses a potential that changes with time, and a gauge that is too small",
          "[solid][integrators][errors]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.5}, {4, 2}, CellShape::quadrangle);
    auto options = reconstructed_bodies<2>(1);
    options.obstacles = {contact::plane_obstacle<2>(Vector<2>(0.0, -1.0), Vector<2>::UnitY(), 10.0)};
    options.obstacles[0].path = [](double t) { return Vector<2>(0.0, 0.1 * t); };
    Solid<2> moving(mesh, options);
    const std::vector<double> zero(moving.size(), 0.0);
    CHECK_THROWS_WITH(dynamics::Bilbao(moving, zero, zero, 0.01, 1.0), Catch::Matchers::Contains("changes with time"));
    options.obstacles[0].path = {};
    Solid<2> resting(mesh, options);
    CHECK_THROWS_WITH(dynamics::Bilbao(resting, zero, zero, 0.01, 0.0), Catch::Matchers::Contains("Raise the gauge"));
}

TEST_CASE(
    "an outer solver dictates every step through an impact: less the jumps of restarts H~ is exact, and the bodies part "
    "alike",
    "[solid][integrators][contact]") {
    const auto mesh = two_discs(0.8);
    const auto dictated = [&](dynamics::StepChange change, const std::function<double(int)>& part) {
        Solid<2> solid(mesh, reconstructed_bodies<2>(2));
        const auto p = solid::uniform_momentum<2>(solid, disc_velocities);
        const double stable = dynamics::stable_step(solid).dt;
        dynamics::Memm memm(solid, std::vector<double>(solid.size(), 0.0), p, part(0) * stable);
        dynamics::Ledger<2> ledger;
        for (int i = 1; memm.time() < 8.0; ++i) {
            memm.step(part(i) * stable, change);
            ledger.record(dynamics::measure(memm, solid));
        }
        CHECK(solid.contact().report().events > 0);
        CHECK(ledger.pseudo_energy_drift() < 1e-13 * ledger.largest_energy());
        CHECK(ledger.energy_drift() < 0.05 * ledger.entries().front().kinetic);  // H itself, of so coarse a mesh
        return solid::body_motions<2>(memm, solid)[0].velocity;
    };
    const auto even = dictated(dynamics::StepChange::keep, [](int) { return 0.5; });
    const auto slowly = dictated(dynamics::StepChange::keep, [](int i) { return 0.5 + 0.3 * std::sin(0.02 * i); });
    const auto abrupt = dictated(dynamics::StepChange::restart, [](int i) { return i % 3 == 0 ? 0.2 : 0.8; });
    CHECK((slowly - even).norm() < 0.01 * 0.05);
    CHECK((abrupt - even).norm() < 0.01 * 0.05);
}

TEST_CASE("a solid takes no quadrature but its own", "[solid][integrators][errors]") {
    const auto mesh = two_discs(0.0, 0.5);
    Solid<2> solid(mesh, reconstructed_bodies<2>(2));
    const std::vector<double> zero(solid.size(), 0.0);
    CHECK_THROWS_WITH(dynamics::Memm(solid, zero, zero, 0.01, dynamics::PathMean::gauss_2),
                      Catch::Matchers::Contains("PathMean::system"));
}
