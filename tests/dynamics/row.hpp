#pragma once
// A host that knows no mesh, no contact and no solid.
#include <algorithm>
#include <random>
#include <span>
#include <vector>

#include "abut/dynamics/filter.hpp"

namespace abut::test {

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
    dynamics::MomentArms arms = dynamics::MomentArms::rest;
    [[nodiscard]] dynamics::MomentArms moment_arms() const { return arms; }
    std::vector<std::int32_t> bodies;
    [[nodiscard]] std::span<const std::int32_t> body_of_points() const { return bodies; }
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

inline std::vector<double> random_values(std::mt19937& random, std::size_t n) {
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<double> values(n);
    for (double& v : values) v = value(random);
    return values;
}

template <int Dim>
using Moment = SmallMatrix<Dim*(Dim - 1) / 2, 1>;

template <int Dim>
Moment<Dim> moment(const Vector<Dim>& lever_arm, const Vector<Dim>& p) {
    Vector<3> arm = Vector<3>::Zero(), momentum = Vector<3>::Zero();
    std::ranges::copy(lever_arm, arm.begin());
    std::ranges::copy(p, momentum.begin());
    return arm.cross(momentum).template tail<Dim*(Dim - 1) / 2>();
}

/// A state of MEMM at a node.
struct NodeState {
    std::vector<double> q, before, after;  // before: p^{n-1/2}
    double dt;
};

inline NodeState random_state(std::mt19937& random, std::size_t n, double dt) {
    return {random_values(random, n), random_values(random, n), random_values(random, n), dt};
}

/// |e|^2 in M^-1 over all points.
template <int Dim>
double square_of_e(const Row<Dim>& row, const NodeState& state) {
    std::vector<double> force(row.size());
    row.force(state.q, force);
    double sum = 0.0;
    for (std::size_t j = 0; j < row.size(); ++j) {
        const double e = state.after[j] - state.before[j] - state.dt * force[j];
        sum += row.inverse_mass()[j] * e * e;
    }
    return sum;
}

/// What some points of a state have of all that MEMM conserves and that the momenta decide, by its definition.
template <int Dim>
struct Conserved {
    double kinetic = 0.0;  // of H~
    Vector<Dim> momentum = Vector<Dim>::Zero();
    Moment<Dim> rest = Moment<Dim>::Zero();    // sum X × p
    Moment<Dim> moved = Moment<Dim>::Zero();   // sum x × p
    Moment<Dim> pseudo = Moment<Dim>::Zero();  // J~

    template <class S>
    Conserved(const S& row, const NodeState& state, std::span<const std::int32_t> points) {
        const auto vectors = [](const std::vector<double>& values) { return as_vectors<Dim>(std::span(values)); };
        const auto q = vectors(state.q), before = vectors(state.before), after = vectors(state.after);
        for (const std::int32_t i : points) {
            const double m = row.masses()[i];
            const Vector<Dim> p = 0.5 * (before[i] + after[i]), x = row.rest_positions()[i] + q[i];
            kinetic += 0.5 * before[i].dot(after[i]) / m;
            momentum += p;
            rest += test::moment<Dim>(row.rest_positions()[i], p);
            moved += test::moment<Dim>(x, p);
            pseudo += test::moment<Dim>(x, p) - 0.25 * state.dt * test::moment<Dim>(before[i] / m, after[i]);
        }
    }
};

}  // namespace abut::test
