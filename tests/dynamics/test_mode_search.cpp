// The search for highest modes against dense eigenvalues.
#include <oneapi/tbb/global_control.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/dynamics/highest_mode.hpp"
#include "abut/dynamics/mode_search.hpp"

using namespace abut;
using dynamics::ModeSearch;

namespace {

/// A chain of springs of random stiffness between walls.
struct EvenChain {
    std::vector<double> stiffness;  ///< of spring i before mass i; one more than masses
    std::vector<double> weights;    ///< 1/m

    explicit EvenChain(std::size_t n, unsigned seed = 1) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> value(0.5, 2.0);
        for (std::size_t i = 0; i <= n; ++i) stiffness.push_back(value(random));
        for (std::size_t i = 0; i < n; ++i) weights.push_back(value(random));
    }
    [[nodiscard]] std::size_t size() const { return weights.size(); }
    [[nodiscard]] ModeSearch::Product product() const {
        return [this](std::span<const double> x, std::span<double> k_x) {
            const auto at = [&](std::size_t i) { return i < size() ? x[i] : 0.0; };  // the wall on the left is at size_t(-1)
            for (std::size_t i = 0; i < size(); ++i)
                k_x[i] = stiffness[i] * (x[i] - at(i - 1)) + stiffness[i + 1] * (x[i] - at(i + 1));
        };
    }
    /// The largest eigenvalue of W K on what has a weight.
    [[nodiscard]] double highest() const {
        const auto n = static_cast<Eigen::Index>(size());
        Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
        for (Eigen::Index i = 0; i < n; ++i) {
            a(i, i) = weights[i] * (stiffness[i] + stiffness[i + 1]);
            if (i + 1 < n) a(i, i + 1) = a(i + 1, i) = -stiffness[i + 1] * std::sqrt(weights[i] * weights[i + 1]);
        }
        return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    }
};

void iterate(ModeSearch& search, int iterations) {
    for (int i = 0; i < iterations; ++i) search.iterate();
}

/// The numbers that both searches begin from: ModeSearch as x, highest_mode as M^1/2 x.
std::vector<double> random_field(std::size_t n) {
    std::minstd_rand random(1);
    std::vector<double> field(n);
    for (double& value : field) value = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5;
    return field;
}

/// Rayleigh quotient before the last of so many products with W K.
double quotient_of_power_iteration(const EvenChain& chain, std::vector<double> x, int products) {
    std::vector<double> k_x(chain.size());
    double quotient = 0.0;
    for (int i = 0; i < products; ++i) {
        chain.product()(x, k_x);
        double stiffness = 0.0, mass = 0.0;
        for (std::size_t k = 0; k < x.size(); ++k) stiffness += x[k] * k_x[k], mass += x[k] * x[k] / chain.weights[k];
        quotient = stiffness / mass;
        for (std::size_t k = 0; k < x.size(); ++k) x[k] = chain.weights[k] * k_x[k] / quotient;
    }
    return quotient;
}

}  // namespace

TEST_CASE("mode search: the quotient rises to the highest eigenvalue and never above it", "[dynamics][mode-search]") {
    const EvenChain chain(300, GENERATE(1u, 2u, 3u));
    ModeSearch search(chain.size(), chain.product());
    search.set_weights(chain.weights);
    const double highest = chain.highest();
    double before = search.quotient();
    for (int i = 0; i < 200; ++i) {
        search.iterate();
        CHECK(search.quotient() >= before * (1.0 - 1e-13));
        CHECK(search.quotient() <= highest * (1.0 + 1e-13));
        before = search.quotient();
    }
    CHECK(search.quotient() == Approx(highest).epsilon(1e-12));
    CHECK(search.iterations() == 200);
    double norm = 0.0, residual = 0.0;
    for (std::size_t i = 0; i < chain.size(); ++i) {
        norm += search.x()[i] * search.x()[i] / chain.weights[i];
        residual = std::max(residual, std::abs(search.image(i) - search.quotient() * search.x()[i]));
    }
    CHECK(norm == Approx(1.0).epsilon(1e-10));
    CHECK(residual < 1e-5);
}

TEST_CASE("mode search: a third of the products of a power iteration gives more", "[dynamics][mode-search]") {
    const EvenChain chain(3000, GENERATE(1u, 2u, 3u));
    const double power = quotient_of_power_iteration(chain, random_field(chain.size()), 75);
    ModeSearch search(chain.size(), chain.product());
    search.set_weights(chain.weights);
    iterate(search, 25);
    CHECK(search.quotient() > power);
}

TEST_CASE("highest mode: below the highest eigenvalue by less than its margin, and above a power iteration from its start",
          "[dynamics][mode-search]") {
    const EvenChain chain(GENERATE(30u, 300u, 1000u), GENERATE(1u, 2u, 3u));
    const auto mode = dynamics::highest_mode(chain.weights, chain.product());
    CHECK(mode.change <= dynamics::settled_change);
    CHECK(mode.quotient <= chain.highest() * (1.0 + 1e-13));
    CHECK(dynamics::bound_of(mode) > std::sqrt(chain.highest()));
    CHECK(mode.iterations < 60);
    // The largest quotient of all that so many products span: in that is the iterate of the power iteration.
    std::vector<double> start = random_field(chain.size());
    for (std::size_t i = 0; i < start.size(); ++i) start[i] *= std::sqrt(chain.weights[i]);
    CHECK(mode.quotient > quotient_of_power_iteration(chain, start, mode.iterations) * (1.0 - 1e-13));
}

TEST_CASE("highest mode: exact where it has seen all, and 0 where nothing resists or nothing is free",
          "[dynamics][mode-search]") {
    EvenChain chain(5);
    const auto mode = dynamics::highest_mode(chain.weights, chain.product());
    CHECK(mode.quotient == Approx(chain.highest()).epsilon(1e-13));
    CHECK(mode.change == 0.0);
    const auto nothing = [](std::span<const double>, std::span<double> k_x) { std::ranges::fill(k_x, 0.0); };
    CHECK(dynamics::highest_mode(chain.weights, nothing).quotient == 0.0);
    CHECK(dynamics::highest_mode(std::vector<double>(5, 0.0), chain.product()).quotient == 0.0);
}

TEST_CASE("highest mode: not settled where a product is not a number", "[dynamics][mode-search][errors]") {
    const EvenChain chain(30);
    const int spoilt_call = GENERATE(1, 5, 14);
    const auto spoilt = [&, calls = 0](std::span<const double> x, std::span<double> k_x) mutable {
        chain.product()(x, k_x);
        if (++calls == spoilt_call) k_x[7] = std::numeric_limits<double>::quiet_NaN();
    };
    const auto mode = dynamics::highest_mode(chain.weights, spoilt);
    CHECK_FALSE(mode.change <= dynamics::settled_change);
}

TEST_CASE("highest mode: one light mass in an even chain of a million is not overlooked", "[dynamics][mode-search]") {
    const double lighter = GENERATE(0.2, 0.25, 0.3, 0.5);  // of the mass of the others
    EvenChain chain(1'000'000);
    std::ranges::fill(chain.stiffness, 1.0);
    std::ranges::fill(chain.weights, 1.0);
    chain.weights[GENERATE(345'678u, 777'777u)] = 1.0 / (1.0 - lighter);
    // Its mode dies away on both sides, at omega^2 = 4/(1 - lighter^2): A. A. Maradudin et al., Theory of Lattice Dynamics.
    const double omega = 2.0 / std::sqrt(1.0 - lighter * lighter);
    CHECK(dynamics::bound_of(dynamics::highest_mode(chain.weights, chain.product())) > omega);
}

TEST_CASE("highest mode: units that are powers of two change no bit", "[dynamics][mode-search]") {
    const EvenChain chain(300);
    const int of_mass = GENERATE(3, -61, 90), of_stiffness = GENERATE(5, -80, 33);
    EvenChain other = chain;
    for (double& weight : other.weights) weight = std::ldexp(weight, -of_mass);
    for (double& stiffness : other.stiffness) stiffness = std::ldexp(stiffness, of_stiffness);
    CHECK(dynamics::highest_mode(other.weights, other.product()).quotient ==
          std::ldexp(dynamics::highest_mode(chain.weights, chain.product()).quotient, of_stiffness - of_mass));
}

TEST_CASE("highest mode: what has no inverse mass is held", "[dynamics][mode-search]") {
    EvenChain chain(300);
    for (std::size_t i = 0; i < chain.size(); ++i)
        if (i % 7 < 2) chain.weights[i] = 0.0;
    const auto mode = dynamics::highest_mode(chain.weights, chain.product());
    CHECK(mode.quotient <= chain.highest() * (1.0 + 1e-13));
    CHECK(dynamics::bound_of(mode) > std::sqrt(chain.highest()));
}

TEST_CASE("highest mode: the same bits on any number of threads", "[dynamics][mode-search][reproducible]") {
    const EvenChain chain(20'000);
    std::vector<double> quotients;
    for (const std::size_t threads : {1u, 2u, 3u}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        quotients.push_back(dynamics::highest_mode(chain.weights, chain.product()).quotient);
    }
    CHECK(quotients[1] == quotients[0]);
    CHECK(quotients[2] == quotients[0]);
}

TEST_CASE("mode search: what has no weight is held, and other weights are gone on with", "[dynamics][mode-search]") {
    EvenChain chain(300);
    ModeSearch search(chain.size(), chain.product());
    search.set_weights(chain.weights);
    iterate(search, 20);
    for (std::size_t i = 0; i < chain.size(); ++i)
        if (i % 7 < 2 || i > 200) chain.weights[i] = 0.0;
    for (std::size_t i = 100; i < 120; ++i) chain.weights[i] *= 3.0;
    search.set_weights(chain.weights);
    CHECK(search.iterations() == 0);
    iterate(search, 150);
    CHECK(search.quotient() == Approx(chain.highest()).epsilon(1e-12));
    for (std::size_t i = 0; i < chain.size(); ++i)
        if (chain.weights[i] == 0.0) REQUIRE(search.x()[i] == 0.0);
}

TEST_CASE("mode search: at a mode it stays, and with nothing free it is refused", "[dynamics][mode-search]") {
    EvenChain chain(1);
    ModeSearch search(1, chain.product());
    search.set_weights(chain.weights);
    iterate(search, 3);
    CHECK(search.quotient() == Approx(chain.highest()).epsilon(1e-14));
    CHECK(search.change() < 1e-14);
    CHECK_THROWS_AS(search.set_weights(std::vector<double>{0.0}), BadInput);
}

TEST_CASE("mode search: the same bits on any number of threads", "[dynamics][mode-search][reproducible]") {
    const EvenChain chain(20'000);
    std::vector<double> quotients;
    for (const std::size_t threads : {1u, 2u, 3u}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        ModeSearch search(chain.size(), chain.product());
        search.set_weights(chain.weights);
        iterate(search, 10);
        quotients.push_back(search.quotient());
    }
    CHECK(quotients[1] == quotients[0]);
    CHECK(quotients[2] == quotients[0]);
}

TEST_CASE("mode search: begun again, it finds what it had forgotten of a part that nothing couples with the rest",
          "[dynamics][mode-search]") {
    const EvenChain left(200, 5), right(200, 6);
    const std::size_t n = left.size() + right.size();
    ModeSearch search(n, [&](std::span<const double> x, std::span<double> product) {
        left.product()(x.first(left.size()), product.first(left.size()));
        right.product()(x.subspan(left.size()), product.subspan(left.size()));
    });
    const auto weights = [&](double of_left) {
        std::vector<double> w;
        for (const double value : left.weights) w.push_back(of_left * value);
        w.insert(w.end(), right.weights.begin(), right.weights.end());
        return w;
    };
    search.set_weights(weights(1e4));
    iterate(search, 500);
    CHECK(search.quotient() == Approx(1e4 * left.highest()).epsilon(1e-6));
    search.restart();
    search.set_weights(weights(0.1));
    iterate(search, 500);
    CHECK(search.quotient() == Approx(right.highest()).epsilon(1e-6));
}
