#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/vector.hpp"
#include "abut/dynamics/system.hpp"

namespace abut::dynamics {

/// A spring on a line of elongation x: V = k/2 x^2 + a/3 x^3 + b/4 x^4, of a one-sided spring only where x < 0 (a contact).
struct LineSpring {
    static constexpr int dim = 1;
    static constexpr bool mean_is_exact = true;  ///< see `mean_is_exact` of a system
    double stiffness = 0.0;                      ///< k [N/m]
    double cubic = 0.0;                          ///< a [N/m^2]
    double quartic = 0.0;                        ///< b [N/m^3]
    bool one_sided = false;

    [[nodiscard]] double energy(const Vector<1>& r) const {
        const double x = acting(r[0]), square = x * x;
        return square * (0.5 * stiffness + cubic / 3.0 * x + 0.25 * quartic * square);
    }
    /// dV/dr
    [[nodiscard]] Vector<1> tension(const Vector<1>& r) const {
        const double x = acting(r[0]);
        return Vector<1>(x * (stiffness + cubic * x + quartic * x * x));
    }
    /// Mean of the tension along the straight path; exact, cut where a one-sided spring begins or ends to act.
    [[nodiscard]] Vector<1> mean_tension(const Vector<1>& r_0, const Vector<1>& r_1) const {
        const double a = acting(r_0[0]), b = acting(r_1[0]);
        const double whole =
            0.5 * (a + b) * (stiffness + 0.5 * quartic * (a * a + b * b)) + cubic / 3.0 * (a * a + a * b + b * b);
        return Vector<1>(begins_or_ends(r_0, r_1) ? whole * std::abs((b - a) / (r_1[0] - r_0[0])) : whole);
    }
    [[nodiscard]] Matrix<1> stiffness_at(const Vector<1>& r) const {
        if (one_sided && r[0] >= 0.0) return Matrix<1>::Zero();
        return Matrix<1>(stiffness + 2.0 * cubic * r[0] + 3.0 * quartic * r[0] * r[0]);
    }

private:
    /// Whether the formula of the tension changes along the path.
    [[nodiscard]] bool begins_or_ends(const Vector<1>& r_0, const Vector<1>& r_1) const {
        return one_sided && (r_0[0] < 0.0) != (r_1[0] < 0.0);
    }
    [[nodiscard]] double acting(double x) const { return one_sided ? std::min(x, 0.0) : x; }
};

/// An elastic string between two points of the plane, geometrically exact: V = k/2 (|r| - L)^2.
struct StringSegment {
    static constexpr int dim = 2;
    static constexpr bool mean_is_exact = false;
    double stiffness = 0.0;  ///< k [N/m]
    double length = 0.0;     ///< L, without tension [m]

    [[nodiscard]] double energy(const Vector<2>& r) const {
        const double x = r.norm() - length;
        return 0.5 * stiffness * x * x;
    }
    /// Not a number where both ends coincide: a string of no length has no direction.
    [[nodiscard]] Vector<2> tension(const Vector<2>& r) const { return stiffness * (1.0 - length / r.norm()) * r; }
    /// The discrete gradient of Simo, Tarnow and Wong: its product with r_1 - r_0 is V(r_1) - V(r_0), and it has no moment
    /// about the mean position.
    [[nodiscard]] Vector<2> mean_tension(const Vector<2>& r_0, const Vector<2>& r_1) const {
        const double mean_length = 0.5 * (r_0.norm() + r_1.norm());
        return (0.5 * stiffness * (1.0 - length / mean_length)) * (r_0 + r_1);
    }
    [[nodiscard]] Matrix<2> stiffness_at(const Vector<2>& r) const {
        const double distance = r.norm();
        const Vector<2> n = r / distance;
        return stiffness * ((1.0 - length / distance) * Matrix<2>::Identity() + (length / distance) * n * n.transpose());
    }
};

/// Attraction in the plane by the inverse square of the distance, as of Kepler's planets: V = -k/|r|. Not a number where the
/// two ends coincide, or a straight path leads from one side of the other end to the opposite one.
struct Attraction {
    static constexpr int dim = 2;
    static constexpr bool mean_is_exact = true;
    double strength = 1.0;  ///< k [N m^2]

    [[nodiscard]] double energy(const Vector<2>& r) const { return -strength / r.norm(); }
    [[nodiscard]] Vector<2> tension(const Vector<2>& r) const { return strength / (r.squaredNorm() * r.norm()) * r; }
    /// Exact: the integrals of 1/|r|^3 and s/|r|^3 along a segment are 1/(|r_0| |r_1| + r_0 . r_1) times sums of 1/|r_i|.
    [[nodiscard]] Vector<2> mean_tension(const Vector<2>& r_0, const Vector<2>& r_1) const {
        const double at_0 = r_0.norm(), at_1 = r_1.norm();
        return strength / (at_0 * at_1 + r_0.dot(r_1)) * (r_0 / at_0 + r_1 / at_1);
    }
    [[nodiscard]] Matrix<2> stiffness_at(const Vector<2>& r) const {
        const double distance = r.norm();
        const Vector<2> n = r / distance;
        return strength / (distance * distance * distance) * (Matrix<2>::Identity() - 3.0 * n * n.transpose());
    }
};

/// Two particles and what acts between them; a bond to `fixed` holds a particle to where it began.
template <class Law>
struct Bond {
    static constexpr std::int32_t fixed = -1;
    std::int32_t first;
    std::int32_t second;
    Law law;
    Vector<Law::dim> offset{};  ///< r = q_second - q_first + offset [m]; 0 by default
};

/// Particles and bonds: the small systems on which schemes are compared. A LocalSystem and a StiffnessSystem; unlike the
/// bulk of a solid it may be as nonlinear as its Law. Mass is a std::vector<double> of 1/m, or InverseMass.
template <class Law, class Mass = std::vector<double>>
class Particles {
public:
    static constexpr int dim = Law::dim;
    using V = Vector<dim>;

    /// `load`: a constant force per degree of freedom [N]; empty: none. Throws BadInput if a bond has an end that
    /// is no particle, two ends that are the same, or if sizes disagree.
    Particles(Mass inverse_mass, std::vector<Bond<Law>> bonds, std::vector<double> load = {})
        : inverse_mass_(std::move(inverse_mass)), bonds_(std::move(bonds)), load_(std::move(load)) {
        const auto refuse = [](const std::string& what) { throw BadInput("particles: " + what); };
        if (size() % dim != 0 || (!load_.empty() && load_.size() != size()))
            refuse(std::to_string(size()) + " masses and " + std::to_string(load_.size()) + " loads are given; give " +
                   std::to_string(dim) + " masses per particle, and as many loads or none.");
        const auto n = static_cast<std::int32_t>(size() / dim);
        for (const Bond<Law>& bond : bonds_)
            if (bond.first < Bond<Law>::fixed || bond.second < Bond<Law>::fixed || bond.first >= n || bond.second >= n ||
                bond.first == bond.second)
                refuse("a bond joins " + std::to_string(bond.first) + " and " + std::to_string(bond.second) + "; two of " +
                       std::to_string(n) + " particles are allowed, or one and Bond::fixed.");
        level_.assign(size(), 0);
        by_level_.assign(1, all_bonds());
    }

    [[nodiscard]] std::size_t size() const { return inverse_mass_.size(); }
    [[nodiscard]] const Mass& inverse_mass() const { return inverse_mass_; }
    [[nodiscard]] static constexpr bool mean_is_exact() { return Law::mean_is_exact; }  ///< that of its bonds

    void force(std::span<const double> q, std::span<double> force) {
        evaluate(force, [&](const Bond<Law>& bond) { return bond.law.tension(separation(bond, q)); });
    }
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double, double, std::span<double> force) {
        evaluate(force,
                 [&](const Bond<Law>& bond) { return bond.law.mean_tension(separation(bond, q_0), separation(bond, q_1)); });
    }
    [[nodiscard]] double potential(std::span<const double> q) const {
        double energy = 0.0;
        for (const Bond<Law>& bond : bonds_) energy += bond.law.energy(separation(bond, q));
        for (std::size_t i = 0; i < load_.size(); ++i) energy -= load_[i] * q[i];
        return energy;
    }
    void append_stiffness(std::span<const double> q, double factor, std::vector<MatrixEntry>& entries) const {
        for (const Bond<Law>& bond : bonds_) {
            const Matrix<dim> block = factor * bond.law.stiffness_at(separation(bond, q));
            for (const std::int32_t row : {bond.first, bond.second})
                for (const std::int32_t column : {bond.first, bond.second}) {
                    if (row == Bond<Law>::fixed || column == Bond<Law>::fixed) continue;
                    for (int i = 0; i < dim; ++i)
                        for (int j = 0; j < dim; ++j)
                            entries.push_back({row * dim + i, column * dim + j, (row == column ? 1.0 : -1.0) * block(i, j)});
                }
        }
    }

    /// A bond goes with the higher level of its two particles; before the first call all are on level 0. Levels of degrees
    /// of freedom: throws BadInput if those of a particle disagree.
    void set_levels(std::int32_t n_levels, std::span<const std::int32_t> level) {
        const auto level_of = [&](std::int32_t particle) {
            return particle == Bond<Law>::fixed ? 0 : level[particle * dim];
        };
        for (std::size_t i = 0; i < level.size(); ++i)
            if (level[i] != level[i - i % dim])
                throw BadInput("particles: the components of particle " + std::to_string(i / dim) +
                               " are on different levels. A particle takes its steps as a whole.");
        by_level_.assign(static_cast<std::size_t>(n_levels), {});
        for (std::int32_t b = 0; b < static_cast<std::int32_t>(bonds_.size()); ++b)
            by_level_[std::max(level_of(bonds_[b].first), level_of(bonds_[b].second))].push_back(b);
        level_.assign(level.begin(), level.end());
    }
    void add_impulse(std::int32_t level, const FreeFlight& flight, double, double dt, std::span<double> impulse) {
        for (const std::int32_t b : by_level_[level]) {
            const Bond<Law>& bond = bonds_[b];
            const V r_0 = difference(bond, [&](std::size_t i) { return flight.at(i, 0.0); }) + bond.offset;
            const V r_1 = r_0 + dt * difference(bond, [&](std::size_t i) { return flight.v[i]; });
            add(bond, dt * bond.law.mean_tension(r_0, r_1), impulse);
        }
        evaluations_ += static_cast<std::int64_t>(by_level_[level].size());
        for (std::size_t i = 0; i < load_.size(); ++i)
            if (level_[i] == level) impulse[i] += dt * load_[i];
    }

    /// Bonds evaluated so far, for forces and means.
    [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

private:
    /// q_second - q_first, q being a function of the degree of freedom.
    template <class Position>
    [[nodiscard]] static V difference(const Bond<Law>& bond, const Position& q) {
        V r = V::Zero();
        for (int i = 0; i < dim; ++i) {
            if (bond.second != Bond<Law>::fixed) r[i] += q(static_cast<std::size_t>(bond.second * dim + i));
            if (bond.first != Bond<Law>::fixed) r[i] -= q(static_cast<std::size_t>(bond.first * dim + i));
        }
        return r;
    }
    [[nodiscard]] static V separation(const Bond<Law>& bond, std::span<const double> q) {
        return difference(bond, [&](std::size_t i) { return q[i]; }) + bond.offset;
    }
    /// A tension pulls the first particle towards the second.
    static void add(const Bond<Law>& bond, const V& tension, std::span<double> force) {
        for (int i = 0; i < dim; ++i) {
            if (bond.first != Bond<Law>::fixed) force[bond.first * dim + i] += tension[i];
            if (bond.second != Bond<Law>::fixed) force[bond.second * dim + i] -= tension[i];
        }
    }
    template <class Tension>
    void evaluate(std::span<double> force, const Tension& tension) {
        if (load_.empty())
            std::fill(force.begin(), force.end(), 0.0);
        else
            std::copy(load_.begin(), load_.end(), force.begin());
        for (const Bond<Law>& bond : bonds_) add(bond, tension(bond), force);
        evaluations_ += static_cast<std::int64_t>(bonds_.size());
    }
    [[nodiscard]] std::vector<std::int32_t> all_bonds() const {
        std::vector<std::int32_t> all;
        for (std::size_t b = 0; b < bonds_.size(); ++b) all.push_back(static_cast<std::int32_t>(b));
        return all;
    }

    Mass inverse_mass_;
    std::vector<Bond<Law>> bonds_;
    std::vector<double> load_;
    std::vector<std::int32_t> level_;
    std::vector<std::vector<std::int32_t>> by_level_;
    std::int64_t evaluations_ = 0;
};

}  // namespace abut::dynamics
