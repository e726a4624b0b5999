#include "studies/kinematics/closed_forms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "abut/base/rotation.hpp"

namespace abut::studies::kinematics {
namespace {

Matrix<3> turned(const Vector<3>& rotation) {
    const double angle = rotation.norm();
    if (angle == 0.0) return Matrix<3>::Identity();
    return rotation_about(Vector<3>(rotation / angle), angle);
}

}  // namespace

Vector<3> inertia_of_box(const Vector<3>& sides) {
    const Vector<3> squares = sides.cwiseProduct(sides);
    return sides.prod() / 12.0 * (squares.sum() * Vector<3>::Ones() - squares);
}

Matrix<3> symmetric_top(const Vector<3>& inertia, const Vector<3>& spin, double time) {
    const Vector<3> l = inertia.cwiseProduct(spin);
    return turned(time / inertia[0] * l) * turned({0.0, 0.0, time * l[2] * (1.0 / inertia[2] - 1.0 / inertia[0])});
}

double flip_period(const Vector<3>& inertia, const Vector<3>& spin) {
    const Vector<3> l = inertia.cwiseProduct(spin);
    const double square = l.squaredNorm(), twice = l.dot(spin);
    const double i1 = inertia[0], i2 = inertia[1], i3 = inertia[2];
    const double above = square - twice * i2;  // > 0: nearer to the axis of the largest moment
    const double rate = std::sqrt(above > 0.0 ? (i3 - i2) * (square - twice * i1) / (i1 * i2 * i3)
                                              : (i2 - i1) * (twice * i3 - square) / (i1 * i2 * i3));
    const double complement = above > 0.0 ? (i3 - i1) * above / ((i3 - i2) * (square - twice * i1))
                                          : (i3 - i1) * -above / ((i2 - i1) * (twice * i3 - square));  // 1 - k^2
    double a = 1.0, b = std::sqrt(complement);  // the quarter period by the arithmetic-geometric mean
    for (int i = 0; i < 20; ++i) std::tie(a, b) = std::pair(0.5 * (a + b), std::sqrt(a * b));
    return std::numbers::pi / (a * rate);
}

std::vector<double> velocities_of(const Chain& chain, double time) {
    constexpr int steps = 1'000'000;
    const auto n = static_cast<std::size_t>(chain.masses);
    std::vector<double> x(n, 0.0), v(n, 0.0), force(n);
    v[0] = chain.speed;
    const double dt = time / steps;
    const auto push = [&](double share) {
        std::ranges::fill(force, 0.0);
        for (std::size_t i = 0; i + 1 < n; ++i) {
            const double depth = x[i] - x[i + 1] - chain.gap;
            if (depth <= 0.0) continue;
            const double of_pair = chain.stiffness * depth;
            force[i] -= of_pair;
            force[i + 1] += of_pair;
        }
        for (std::size_t i = 0; i < n; ++i) v[i] += share * dt * force[i] / chain.mass;
    };
    push(0.5);
    for (int step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < n; ++i) x[i] += dt * v[i];
        push(step + 1 == steps ? 0.5 : 1.0);
    }
    for (double& of_mass : v) of_mass /= chain.speed;
    return v;
}

double elastica_tip(double alpha) {
    const auto phi = [](double p) { return std::asin(1.0 / (p * std::numbers::sqrt2)); };
    const double p = root(1.0 / std::numbers::sqrt2 + 1e-14, 1.0 - 1e-12,
                          [&](double k) { return std::comp_ellint_1(k) - std::ellint_1(k, phi(k)) - std::sqrt(alpha); });
    return 1.0 - 2.0 / std::sqrt(alpha) * (std::comp_ellint_2(p) - std::ellint_2(p, phi(p)));
}

double angle_between(const Matrix<3>& a, const Matrix<3>& b) {
    return 2.0 * std::asin(std::min(1.0, (a - b).norm() / std::sqrt(8.0)));
}

}  // namespace abut::studies::kinematics
