// Ledger, stable step and filter take any system of points; this one knows no mesh, no contact and no solid.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/stable_step.hpp"

using namespace abut;

namespace {

/// A row of points, neighbours joined by springs k that act on displacements, each component by itself.
template <int Dim>
class Row {
public:
    static constexpr int dimension = Dim;

    Row(std::vector<double> mass, double stiffness) : mass_(std::move(mass)), stiffness_(stiffness) {
        for (std::size_t i = 0; i < mass_.size(); ++i) {
            rest_.push_back(Vector<Dim>::Constant(0.3) + static_cast<double>(i) * Vector<Dim>::Unit(0));
            inverse_mass_.insert(inverse_mass_.end(), Dim, 1.0 / mass_[i]);
        }
    }
    [[nodiscard]] std::size_t size() const { return inverse_mass_.size(); }
    [[nodiscard]] std::span<const double> inverse_mass() const { return inverse_mass_; }
    [[nodiscard]] std::span<const double> masses() const { return mass_; }
    [[nodiscard]] std::span<const Vector<Dim>> rest_positions() const { return rest_; }

    void force(std::span<const double> q, std::span<double> f) const {
        stiffness_product(q, f);
        for (double& value : f) value = -value;
    }
    [[nodiscard]] double potential(std::span<const double> q) const {
        std::vector<double> k_q(q.size());
        stiffness_product(q, k_q);
        return 0.5 * dynamics::dot_product(q, k_q);
    }
    void stiffness_product(std::span<const double> q, std::span<double> product) const {
        std::fill(product.begin(), product.end(), 0.0);
        for (std::size_t i = 0; i + Dim < q.size(); ++i) {
            const double pull = stiffness_ * (q[i + Dim] - q[i]);
            product[i] -= pull;
            product[i + Dim] += pull;
        }
    }
    // What only a system with contact has.
    std::vector<dynamics::ContactPatch<Dim>> patches;
    [[nodiscard]] std::vector<dynamics::ContactPatch<Dim>> contact_patches() const { return patches; }
    void end_force_on(std::span<const std::int32_t> points, std::span<const double> q,
                      std::span<Vector<Dim>> on_points) const {
        std::vector<double> all(q.size());
        force(q, all);
        for (std::size_t k = 0; k < points.size(); ++k)
            on_points[k] = as_vectors<Dim>(std::span<const double>(all))[points[k]];
    }

private:
    std::vector<double> mass_;
    std::vector<double> inverse_mass_;
    std::vector<Vector<Dim>> rest_;
    double stiffness_;
};

template <int Dim>
auto moment(const Vector<Dim>& lever_arm, const Vector<Dim>& p) {
    if constexpr (Dim == 2)
        return Vector<1>(lever_arm[0] * p[1] - lever_arm[1] * p[0]);
    else
        return Vector<3>(lever_arm[1] * p[2] - lever_arm[2] * p[1], lever_arm[2] * p[0] - lever_arm[0] * p[2],
                         lever_arm[0] * p[1] - lever_arm[1] * p[0]);
}

std::vector<double> random_values(std::mt19937& random, std::size_t n) {
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<double> values(n);
    for (double& v : values) v = value(random);
    return values;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the ledger of free points has their energy, momentum and angular momentum", "[dynamics][ledger]",
                       ((int Dim), Dim), 2, 3) {
    Row<Dim> row({1.0, 2.0, 0.5}, 0.0);
    std::mt19937 random(3);
    const auto p = random_values(random, row.size());
    dynamics::Memm memm(row, std::vector<double>(row.size(), 0.0), p, 0.1, dynamics::PathMean::gauss_1);
    Vector<Dim> momentum = Vector<Dim>::Zero();
    Eigen::Matrix<double, dynamics::n_rotations<Dim>, 1> spin = Eigen::Matrix<double, dynamics::n_rotations<Dim>, 1>::Zero();
    double kinetic = 0.0;
    const auto p_i = as_vectors<Dim>(std::span<const double>(p));
    for (std::size_t i = 0; i < p_i.size(); ++i) {
        momentum += p_i[i];
        spin += moment<Dim>(row.rest_positions()[i], p_i[i]);
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

TEMPLATE_TEST_CASE_SIG(
    "the filter of any system changes neither the pseudo-energy nor momentum and angular momentum, and takes e away",
    "[dynamics][filter]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(11);
    Row<Dim> row({1.0, 2.0, 0.5, 1.5, 0.7, 1.1, 0.9}, 3.0);
    const double dt = 0.01;
    for (int trial = 0; trial < 20; ++trial) {
        const auto q = random_values(random, row.size()), before = random_values(random, row.size());
        const auto given = random_values(random, row.size());
        row.patches = {{.points = {1, 2, 3, 5}}};
        // Held by nothing; by rollers, which stop what moves along the last axis; by a frame that stops all.
        enum Held { free, rollers, frame };
        const auto held = static_cast<Held>(trial % 3);
        const int first_held = held == rollers ? Dim - 1 : held == frame ? 0 : Dim;
        for (int place = 0; place <= Dim; ++place)
            for (int d = first_held; d < Dim; ++d)
                row.patches[0].holds.push_back(
                    {place < Dim ? Vector<Dim>(Vector<Dim>::Unit(place)) : Vector<Dim>(Vector<Dim>::Zero()),
                     Vector<Dim>::Unit(d)});
        std::vector<double> after = given;
        dynamics::NeutralFilter filter(row);
        filter(q, dt, before, after);

        std::vector<double> force(row.size());
        row.force(q, force);
        double work = 0.0, size = 0.0, e_given = 0.0, e_after = 0.0;
        Vector<Dim> momentum = Vector<Dim>::Zero();
        Eigen::Matrix<double, dynamics::n_rotations<Dim>, 1> spin =
            Eigen::Matrix<double, dynamics::n_rotations<Dim>, 1>::Zero();
        for (std::size_t i = 0; i < row.masses().size(); ++i) {
            Vector<Dim> change;
            for (int d = 0; d < Dim; ++d) {
                const std::size_t j = Dim * i + static_cast<std::size_t>(d);
                change[d] = after[j] - given[j];
                work += row.inverse_mass()[j] * before[j] * change[d];
                const auto e = [&](double p) { return p - before[j] - dt * force[j]; };
                e_given += row.inverse_mass()[j] * e(given[j]) * e(given[j]);
                e_after += row.inverse_mass()[j] * e(after[j]) * e(after[j]);
            }
            if (i == 0 || i == 4 || i == 6) CHECK(change.isZero(0.0));  // outside the patch
            momentum += change;
            spin += moment<Dim>(row.rest_positions()[i] + as_vectors<Dim>(std::span<const double>(q))[i], change);
            size += change.norm();
        }
        CHECK(size > 0.1);
        CHECK(std::abs(work) < 1e-14 * size * row.size());  // of v . change: H~ stays
        for (int d = 0; d < first_held; ++d) CHECK(std::abs(momentum[d]) < 1e-14 * size);
        for (int d = first_held; d < Dim; ++d) CHECK(std::abs(momentum[d]) > 1e-4 * size);  // it is not its own there
        if (held == free) CHECK(spin.norm() < 1e-13 * size);
        if (held == rollers && Dim == 3) CHECK(std::abs(spin[Dim - 1]) < 1e-13 * size);  // about the normal of the rollers
        CHECK(e_after < e_given);
    }
}

TEST_CASE("the filter refuses a part of the mode that is not from 0 to 1", "[dynamics][filter][errors]") {
    Row<2> row({1.0, 2.0}, 3.0);
    const auto make = [&](double kappa) { dynamics::NeutralFilter(row, kappa); };
    for (const double kappa : {0.0, 0.5, 1.0}) CHECK_NOTHROW(make(kappa));
    for (const double kappa : {-1e-9, 1.0 + 1e-9, std::nan("")}) {
        CAPTURE(kappa);
        CHECK_THROWS_WITH(make(kappa), Catch::Matchers::Contains("kappa") && Catch::Matchers::Contains("0 to 1"));
    }
}
