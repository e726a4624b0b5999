#include <catch2/catch.hpp>

#include "abut/dynamics/energy_momentum.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/particles.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;
using dynamics::InverseMass;
using dynamics::MatrixEntry;

namespace {

using Bar = dynamics::Particles<dynamics::LineSpring, InverseMass>;

/// Linear elements of a bar of length pi held at both ends, E = rho = 1, n inner nodes, with their consistent mass.
Bar bar(int n) {
    const double h = 3.14159265358979323846 / (n + 1);
    std::vector<MatrixEntry> mass;
    std::vector<dynamics::Bond<dynamics::LineSpring>> bonds;
    for (std::int32_t i = 0; i < n; ++i) {
        mass.push_back({i, i, 4.0 * h / 6.0});
        if (i + 1 < n) mass.insert(mass.end(), {{i, i + 1, h / 6.0}, {i + 1, i, h / 6.0}});
        bonds.push_back({i - 1, i, {1.0 / h}});
    }
    bonds.push_back({n - 1, -1, {1.0 / h}});
    return Bar(InverseMass(static_cast<std::size_t>(n), mass), bonds);
}

/// (6/h^2) (1 - cos th)/(2 + cos th), th = k h: frequencies of linear elements with consistent mass.
double frequency(int n, int k) {
    const double h = 3.14159265358979323846 / (n + 1), c = std::cos(k * h);
    return std::sqrt(6.0 / (h * h) * (1.0 - c) / (2.0 + c));
}

}  // namespace

TEST_CASE("a bar with consistent mass vibrates at the frequency of linear elements, under every scheme",
          "[dynamics][mass]") {
    const int n = 9, k = 2, steps = 4000;
    Bar system = bar(n);
    const double omega = frequency(n, k), time = 6.0;
    std::vector<double> q(n), p(n, 0.0);
    for (int i = 0; i < n; ++i) q[i] = std::sin(k * 3.14159265358979323846 * (i + 1) / (n + 1));
    const auto worst_error = [&](auto integrator) {
        double worst = 0.0, drift = 0.0;
        const double start = integrator.pseudo_energy();
        for (int i = 0; i < steps; ++i) {
            integrator.step();
            for (int j = 0; j < n; ++j)
                raise(worst, std::abs(integrator.q()[j] - q[j] * std::cos(omega * integrator.time())));
            raise(drift, std::abs(integrator.pseudo_energy() / start - 1.0));
        }
        CHECK(drift < 1e-12);
        return worst;
    };
    CHECK(worst_error(dynamics::Memm(system, q, p, time / steps)) < 1e-4);
    CHECK(worst_error(dynamics::Leapfrog(system, q, p, time / steps)) < 1e-4);
    CHECK(worst_error(dynamics::EnergyMomentum(system, q, p, time / steps)) < 1e-4);
}

TEST_CASE("a sparse mass that is diagonal gives what the plain array gives", "[dynamics][mass]") {
    const std::vector<double> inverse{1.0, 0.5, 4.0}, a{0.3, -1.0, 2.0}, p{1.0, 2.0, -0.5};
    const InverseMass sparse(3, dynamics::mass_entries(inverse));
    std::vector<double> plain_sum(3), sparse_sum(3);
    dynamics::add_scaled_velocity(a, 0.7, inverse, p, plain_sum);
    dynamics::add_scaled_velocity(a, 0.7, sparse, p, sparse_sum);
    for (int i = 0; i < 3; ++i) CHECK(sparse_sum[i] == Approx(plain_sum[i]).epsilon(1e-15));
    CHECK(dynamics::mass_product(a, sparse, p) == Approx(dynamics::mass_product(a, inverse, p)).epsilon(1e-15));
}

TEST_CASE("a mass that is not symmetric, not positive or out of range is refused", "[dynamics][mass][errors]") {
    using Entries = std::vector<MatrixEntry>;
    const auto make = [](const Entries& entries) { return InverseMass(2, entries).size(); };
    CHECK(make({{0, 0, 1.0}, {1, 1, 2.0}}) == 2);
    CHECK_THROWS_WITH(make({{0, 0, 1.0}, {1, 1, 2.0}, {0, 1, 0.5}}),
                      Catch::Matchers::Contains("symmetric") && Catch::Matchers::Contains("2e-12 kg is allowed"));
    CHECK_THROWS_WITH(make({{0, 0, 1.0}, {1, 1, -2.0}}), Catch::Matchers::Contains("positive definite"));
    CHECK_THROWS_WITH(make({{0, 0, 1.0}}), Catch::Matchers::Contains("positive definite"));
    CHECK_THROWS_WITH(make({{0, 0, 1.0}, {2, 1, 1.0}}), Catch::Matchers::Contains("entry (2, 1)"));
    CHECK_THROWS_WITH(make({{0, 0, std::nan("")}, {1, 1, 1.0}}), Catch::Matchers::Contains("nan"));
}
