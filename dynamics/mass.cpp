#include "abut/dynamics/mass.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/dynamics/sparse.hpp"
#include "abut/dynamics/sum_over.hpp"

namespace abut::dynamics {
namespace {

inline constexpr double symmetry_tolerance = 1e-12;  // of the largest entry

void check(std::size_t n, std::span<const MatrixEntry> mass) {
    const auto inside = [&](std::int32_t i) { return i >= 0 && static_cast<std::size_t>(i) < n; };
    for (const auto& [row, column, value] : mass)
        if (!inside(row) || !inside(column) || !std::isfinite(value))
            throw BadInput("mass: entry (" + std::to_string(row) + ", " + std::to_string(column) + ") is " + number(value) +
                           "; a finite number within " + std::to_string(n) + " rows and columns is allowed.");
}

double largest_entry(const Sparse& matrix) { return matrix.nonZeros() == 0 ? 0.0 : matrix.coeffs().abs().maxCoeff(); }

}  // namespace

struct InverseMass::Impl {
    Sparse matrix;
    Eigen::SimplicialLLT<Sparse> factors;
};

InverseMass::InverseMass(std::size_t n, std::span<const MatrixEntry> mass) : impl_(std::make_unique<Impl>()) {
    check(n, mass);
    impl_->matrix = assembled(n, mass);
    const double asymmetry = largest_entry(Sparse(impl_->matrix - Sparse(impl_->matrix.transpose())));
    const double allowed = symmetry_tolerance * largest_entry(impl_->matrix);
    if (asymmetry > allowed)
        throw BadInput("mass: the matrix differs from its transpose by up to " + number(asymmetry) + " kg, " +
                           number(allowed) + " kg is allowed; it must be symmetric. Give both of its triangles.",
                       {.value = asymmetry, .allowed = allowed});
    impl_->factors.compute(impl_->matrix);
    if (impl_->factors.info() != Eigen::Success)
        throw BadInput("mass: the matrix is not positive definite. Every degree of freedom needs a mass above 0 kg.");
}

InverseMass::~InverseMass() = default;
InverseMass::InverseMass(InverseMass&&) noexcept = default;
InverseMass& InverseMass::operator=(InverseMass&&) noexcept = default;

std::size_t InverseMass::size() const { return static_cast<std::size_t>(impl_->matrix.rows()); }

void InverseMass::apply(std::span<const double> p, std::span<double> v) const { dense(v) = impl_->factors.solve(dense(p)); }

std::vector<MatrixEntry> InverseMass::mass() const {
    std::vector<MatrixEntry> entries;
    for (Eigen::Index column = 0; column < impl_->matrix.outerSize(); ++column)
        for (Sparse::InnerIterator it(impl_->matrix, column); it; ++it)
            entries.push_back({static_cast<std::int32_t>(it.row()), static_cast<std::int32_t>(column), it.value()});
    return entries;
}

void add_scaled_velocity(std::span<const double> a, double s, std::span<const double> inverse_mass,
                         std::span<const double> p, std::span<double> result) {
    parallel_each(static_cast<std::ptrdiff_t>(a.size()),
                  [&](std::ptrdiff_t i) { result[i] = a[i] + s * (inverse_mass[i] * p[i]); });
}

void add_scaled_velocity(std::span<const double> a, double s, const InverseMass& inverse_mass, std::span<const double> p,
                         std::span<double> result) {
    std::vector<double> v(p.size());
    inverse_mass.apply(p, v);
    add_scaled(a, s, v, result);
}

double mass_product(std::span<const double> a, std::span<const double> inverse_mass, std::span<const double> b) {
    return ordered_sum(static_cast<std::ptrdiff_t>(a.size()), 0.0,
                       [&](std::ptrdiff_t i) { return a[i] * inverse_mass[i] * b[i]; });
}

double mass_product(std::span<const double> a, const InverseMass& inverse_mass, std::span<const double> b) {
    std::vector<double> v(b.size());
    inverse_mass.apply(b, v);
    return dot_product(a, v);
}

std::vector<MatrixEntry> mass_entries(std::span<const double> inverse_mass) {
    std::vector<MatrixEntry> entries;
    for (std::size_t i = 0; i < inverse_mass.size(); ++i) {
        const auto index = static_cast<std::int32_t>(i);
        entries.push_back({index, index, 1.0 / inverse_mass[i]});
    }
    return entries;
}

std::vector<MatrixEntry> mass_entries(const InverseMass& inverse_mass) { return inverse_mass.mass(); }

void add_scaled(std::span<const double> a, double s, std::span<const double> v, std::span<double> result) {
    parallel_each(static_cast<std::ptrdiff_t>(a.size()), [&](std::ptrdiff_t i) { result[i] = a[i] + s * v[i]; });
}

double dot_product(std::span<const double> a, std::span<const double> b) {
    return ordered_sum(static_cast<std::ptrdiff_t>(a.size()), 0.0, [&](std::ptrdiff_t i) { return a[i] * b[i]; });
}

namespace {

/// Sum of term(i) over the values of the points of all ranks.
template <class Term>
double sum_of_values(const Ranks& ranks, std::size_t n, const Term& term) {
    return sum_over(ranks, {.per_point = ranks.dimension()}, static_cast<std::ptrdiff_t>(n), 0.0, term);
}

}  // namespace

double mass_product_over(const Ranks& ranks, std::span<const double> a, std::span<const double> inverse_mass,
                         std::span<const double> b) {
    return sum_of_values(ranks, a.size(), [&](std::ptrdiff_t i) { return a[i] * inverse_mass[i] * b[i]; });
}

double dot_product_over(const Ranks& ranks, std::span<const double> a, std::span<const double> b) {
    return sum_of_values(ranks, a.size(), [&](std::ptrdiff_t i) { return a[i] * b[i]; });
}

}  // namespace abut::dynamics
