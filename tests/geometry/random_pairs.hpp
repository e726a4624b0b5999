#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "abut/base/rotation.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"
#include "geometry/polygons.hpp"

namespace abut::test {

using geometry::PairCorners;
using geometry::PairLaw;

template <int Dim>
Vector<Dim> random_vector(std::mt19937& random, double size) {
    Vector<Dim> vector;
    for (int d = 0; d < Dim; ++d) vector[d] = uniform(random, -size, size);
    return vector;
}

template <int Dim>
Matrix<Dim> random_turn(std::mt19937& random, double largest_angle) {
    const double angle = uniform(random, -largest_angle, largest_angle);
    if constexpr (Dim == 2)
        return rotation_in_plane(angle);
    else
        return rotation_about(random_vector<3>(random, 1.0).normalized(), angle);
}

/// Two faces of size about 1 that look at each other more or less, pressed into each other more or less.
inline PairCorners<2> facing_pair(std::mt19937& random) {
    const auto some = [&] { return random_vector<2>(random, 0.3); };
    const double shift = uniform(random, -0.8, 0.8);
    return {some() + Vector<2>(0.8, 0.0), some() + Vector<2>(-0.8, 0.0), some() + Vector<2>(shift - 0.8, 0.0),
            some() + Vector<2>(shift + 0.8, 0.0)};
}
inline PairCorners<3> facing_pair_3d(std::mt19937& random) {
    PairCorners<3> corners;
    const Vector<3> shift(uniform(random, -0.6, 0.6), uniform(random, -0.6, 0.6), 0.0);
    const double turn = uniform(random, 0.0, 6.0);
    for (int v = 0; v < 3; ++v) {
        const double angle = 2.0 * M_PI * v / 3.0;
        corners[v] = Vector<3>(std::cos(angle), std::sin(angle), 0.0) + random_vector<3>(random, 0.3);
        corners[3 + v] =
            shift + Vector<3>(std::cos(turn - angle), std::sin(turn - angle), 0.0) + random_vector<3>(random, 0.3);
    }
    return corners;
}

/// The same anywhere in space.
template <int Dim>
PairCorners<Dim> random_pair(std::mt19937& random) {
    PairCorners<Dim> corners;
    if constexpr (Dim == 2)
        corners = facing_pair(random);
    else
        corners = facing_pair_3d(random);
    const Matrix<Dim> turn = random_turn<Dim>(random, 3.0);
    const Vector<Dim> by = random_vector<Dim>(random, 2.0);
    for (Vector<Dim>& corner : corners) corner = turn * corner + by;
    return corners;
}

/// Turned and moved as a whole, and every corner by some more.
template <int Dim>
PairCorners<Dim> moved_on(const PairCorners<Dim>& corners, std::mt19937& random, double turn, double motion) {
    PairCorners<Dim> moved;
    const Matrix<Dim> by = random_turn<Dim>(random, turn);
    const Vector<Dim> along = random_vector<Dim>(random, motion);
    for (std::size_t v = 0; v < corners.size(); ++v) moved[v] = by * corners[v] + along + random_vector<Dim>(random, motion);
    return moved;
}

template <int Dim>
PairLaw<Dim> law_of(const PairCorners<Dim>& corners, double stiffness = 1.0) {
    PairLaw<Dim> law{.stiffness = stiffness};
    if constexpr (Dim == 2) law.length = {(corners[1] - corners[0]).norm(), (corners[3] - corners[2]).norm()};
    return law;
}

template <int Dim>
Vector<Dim> sum_of(const PairCorners<Dim>& vectors) {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const Vector<Dim>& vector : vectors) sum += vector;
    return sum;
}

template <int Dim>
double norm_of(const PairCorners<Dim>& vectors) {
    double sum = 0.0;
    for (const Vector<Dim>& vector : vectors) sum += vector.squaredNorm();
    return std::sqrt(sum);
}

template <int Dim>
PairCorners<Dim> difference(const PairCorners<Dim>& a, const PairCorners<Dim>& b) {
    PairCorners<Dim> result;
    for (std::size_t v = 0; v < a.size(); ++v) result[v] = a[v] - b[v];
    return result;
}

template <int Dim>
double product(const PairCorners<Dim>& a, const PairCorners<Dim>& b) {
    double sum = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
    return sum;
}

/// |sum (a + b)/2 x force|, the arms from the mean of all corners.
template <int Dim>
double moment(const PairCorners<Dim>& a, const PairCorners<Dim>& b, const PairCorners<Dim>& force) {
    PairCorners<Dim> arm;
    for (std::size_t v = 0; v < a.size(); ++v) arm[v] = 0.5 * (a[v] + b[v]);
    const Vector<Dim> mean = sum_of<Dim>(arm) / (2.0 * Dim);
    if constexpr (Dim == 2) {
        double sum = 0.0;
        for (std::size_t v = 0; v < a.size(); ++v)
            sum += (arm[v] - mean)[0] * force[v][1] - (arm[v] - mean)[1] * force[v][0];
        return std::abs(sum);
    } else {
        Vector<3> sum = Vector<3>::Zero();
        for (std::size_t v = 0; v < a.size(); ++v) sum += (arm[v] - mean).cross(force[v]);
        return sum.norm();
    }
}

/// Faces 1 and 2 for each other.
template <int Dim>
PairCorners<Dim> exchanged(const PairCorners<Dim>& corners) {
    PairCorners<Dim> result;
    for (int v = 0; v < Dim; ++v) {
        result[v] = corners[Dim + v];
        result[Dim + v] = corners[v];
    }
    return result;
}

}  // namespace abut::test
