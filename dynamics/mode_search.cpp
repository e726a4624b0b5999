#include "abut/dynamics/mode_search.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "abut/base/decompositions.hpp"
#include "abut/base/eigen.hpp"
#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"

namespace abut::dynamics {
namespace {

// Of the last direction, of unit length, from the span of the other two: nearer it is no direction of its own.
inline constexpr double independent = 1e-6;
// Of a mode, over the quotient, which is right to the square of this: what is below is not orthogonal to x, but rounding.
inline constexpr double mode_residual = 1e-8;

/// Products of the residual r and the last direction p.
struct ResidualProducts {
    double mass = 0.0, mass_last = 0.0, stiffness_last = 0.0;  ///< r . W^-1 r, r . W^-1 p, r . K p

    ResidualProducts& operator+=(const ResidualProducts& other) {
        mass += other.mass;
        mass_last += other.mass_last;
        stiffness_last += other.stiffness_last;
        return *this;
    }
};

/// Vector that maximises the Rayleigh quotient in the span of the first N of three vectors, with u . W^-1 u = 1.
template <int N>
Vector<3> largest_in_span(const Matrix<3>& stiffness, const Matrix<3>& mass) {
    const Eigen::LLT<Eigen::Matrix<double, N, N>> factor(as_eigen(mass.topLeftCorner<N, N>()));
    const Matrix<N> half = factor.matrixL().solve(as_eigen(stiffness.topLeftCorner<N, N>()));
    const Matrix<N> reduced = factor.matrixL().solve(as_eigen(half.transpose()));
    const Vector<N> of_span = factor.matrixU().solve(as_eigen(symmetric_eigen(reduced).vectors.col(N - 1)));
    Vector<3> coefficients = Vector<3>::Zero();
    std::ranges::copy(of_span, coefficients.begin());
    return coefficients;
}

bool are_independent(const Matrix<3>& mass) {
    const Eigen::LLT<Eigen::Matrix3d> factor(as_eigen(mass));
    return factor.info() == Eigen::Success && factor.matrixLLT().diagonal().minCoeff() > independent;
}

}  // namespace

ModeSearch::ModeSearch(std::size_t n, Product stiffness) : stiffness_(std::move(stiffness)) {
    for (Direction* direction : {&x_, &residual_, &last_}) {
        direction->vector.assign(n, 0.0);
        direction->product.assign(n, 0.0);
    }
    restart();
}

void ModeSearch::restart() {
    for (double& value : x_.vector)
        value = static_cast<double>(random_()) / static_cast<double>(std::minstd_rand::max()) - 0.5;
}

void ModeSearch::set_weights(std::span<const double> weights) {
    weights_.assign(weights.begin(), weights.end());
    masses_.clear();
    for (const double weight : weights) masses_.push_back(weight > 0.0 ? 1.0 / weight : 0.0);
    const auto n = static_cast<std::ptrdiff_t>(weights_.size());
    parallel_each(n, [&](std::ptrdiff_t i) { x_.vector[i] = weights_[i] > 0.0 ? x_.vector[i] : 0.0; });
    const double length =
        std::sqrt(ordered_sum<double>(n, 0.0, [&](std::ptrdiff_t i) { return masses_[i] * x_.vector[i] * x_.vector[i]; }));
    if (!(length > 0.0)) throw BadInput("mode search: no degree of freedom is free. Give weights above 0.");
    stiffness_(x_.vector, x_.product);
    parallel_each(n, [&](std::ptrdiff_t i) {
        x_.vector[i] /= length;
        x_.product[i] /= length;
    });
    quotient_ = ordered_sum<double>(n, 0.0, [&](std::ptrdiff_t i) { return x_.vector[i] * x_.product[i]; });
    change_ = std::numeric_limits<double>::infinity();
    iterations_ = 0;
    has_last_ = false;
}

/// r = W K x - lambda x, and what is known of x, r and the last direction without another product: x and r are orthogonal,
/// and r . K x is r . W^-1 r.
void ModeSearch::set_residual() {
    const auto n = static_cast<std::ptrdiff_t>(weights_.size());
    const ResidualProducts products = ordered_sum<ResidualProducts>(n, {}, [&](std::ptrdiff_t i) {
        const double r = weights_[i] * x_.product[i] - quotient_ * x_.vector[i], m_r = masses_[i] * r;
        residual_.vector[i] = r;
        return ResidualProducts{m_r * r, m_r * last_.vector[i], r * last_.product[i]};
    });
    stiffness_of_(0, 0) = quotient_;
    stiffness_of_(0, 1) = stiffness_of_(1, 0) = products.mass;
    stiffness_of_(1, 2) = stiffness_of_(2, 1) = products.stiffness_last;
    mass_of_(0, 0) = 1.0;
    mass_of_(0, 1) = mass_of_(1, 0) = 0.0;
    mass_of_(1, 1) = products.mass;
    mass_of_(1, 2) = mass_of_(2, 1) = products.mass_last;
}

void ModeSearch::iterate() {
    const double before = quotient_;
    set_residual();
    if (std::sqrt(mass_of_(1, 1)) > mode_residual * quotient_) step_to_largest();  // else x is a mode
    ++iterations_;
    change_ = quotient_ > 0.0 ? std::abs(quotient_ - before) / quotient_ : 0.0;
}

void ModeSearch::step_to_largest() {
    const auto n = static_cast<std::ptrdiff_t>(weights_.size());
    stiffness_(residual_.vector, residual_.product);
    stiffness_of_(1, 1) =
        ordered_sum<double>(n, 0.0, [&](std::ptrdiff_t i) { return residual_.vector[i] * residual_.product[i]; });
    // Of unit length, so that what is nearly dependent can be told.
    const Vector<3> unit(1.0, 1.0 / std::sqrt(mass_of_(1, 1)), 1.0);
    const Matrix<3> stiffness = unit.asDiagonal() * stiffness_of_ * unit.asDiagonal(),
                    mass = unit.asDiagonal() * mass_of_ * unit.asDiagonal();
    has_last_ = has_last_ && are_independent(mass);
    const Vector<3> c = has_last_ ? largest_in_span<3>(stiffness, mass) : largest_in_span<2>(stiffness, mass);
    Vector<3> d(0.0, c[1], c[2]);
    const double length = std::sqrt(d.dot(mass * d));
    if (!(length > 0.0)) return;  // x is the highest of the three
    d /= length;
    combine(unit.cwiseProduct(c), unit.cwiseProduct(d));
    quotient_ = c.dot(stiffness * c);
    stiffness_of_(0, 2) = stiffness_of_(2, 0) = c.dot(stiffness * d);
    stiffness_of_(2, 2) = d.dot(stiffness * d);
    mass_of_(0, 2) = mass_of_(2, 0) = c.dot(mass * d);
    mass_of_(2, 2) = 1.0;
    has_last_ = true;
}

/// x = c_0 x + c_1 r + c_2 p and p = d_1 r + d_2 p.
void ModeSearch::combine(const Vector<3>& c, const Vector<3>& d) {
    const auto update = [&](std::vector<double>& x, const std::vector<double>& r, std::vector<double>& p, std::ptrdiff_t i) {
        x[i] = c[0] * x[i] + (c[1] * r[i] + c[2] * p[i]);
        p[i] = d[1] * r[i] + d[2] * p[i];
    };
    parallel_each(static_cast<std::ptrdiff_t>(weights_.size()), [&](std::ptrdiff_t i) {
        update(x_.vector, residual_.vector, last_.vector, i);
        update(x_.product, residual_.product, last_.product, i);
    });
}

}  // namespace abut::dynamics
