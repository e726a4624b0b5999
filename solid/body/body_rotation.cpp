#include "abut/solid/body/body_rotation.hpp"

#include <algorithm>

#include "abut/base/decompositions.hpp"
#include "abut/base/rotation.hpp"
#include "abut/dynamics/sum_over.hpp"
#include "abut/solid/body/body_frame.hpp"

namespace abut::solid {
namespace {

constexpr double no_extent = 1e-12;  // second moment over the largest: the cells lie in a line or a plane

}  // namespace

template <int Dim>
BodyRotation<Dim>::BodyRotation(std::span<const Vector<Dim>> rest, std::span<const double> masses,
                                std::span<const std::int32_t> begin, const dynamics::Ranks& ranks)
    : rest_(rest), masses_(masses), begin_(begin), ranks_(ranks) {
    const Vector<Dim> zero = Vector<Dim>::Zero();
    const Matrix<Dim> zeros = Matrix<Dim>::Zero();
    for (std::size_t body = 0; body + 1 < begin_.size(); ++body) {
        const double mass = sum_of(body, 0.0, [&](std::size_t c) { return masses[c]; });
        const Vector<Dim> moment = sum_of(body, zero, [&](std::size_t c) -> Vector<Dim> { return masses[c] * rest[c]; });
        const Vector<Dim> centre = moment / mass;
        const Matrix<Dim> second_moment = sum_of(body, zeros, [&](std::size_t c) -> Matrix<Dim> {
            const Vector<Dim> arm = rest[c] - centre;
            return masses[c] * (arm * arm.transpose());
        });
        bodies_.push_back({centre, pseudo_inverse(second_moment, no_extent)});
    }
}

/// In the order of the cells of the body.
template <int Dim>
template <class Value, class Term>
Value BodyRotation<Dim>::sum_of(std::size_t body, const Value& zero, const Term& term) const {
    const std::int32_t begin = begin_[body], end = begin_[body + 1];
    const auto numbers = ranks_.numbers();
    const auto first = std::ranges::lower_bound(numbers, begin) - numbers.begin();
    const auto last = std::ranges::lower_bound(numbers, end) - numbers.begin();
    return dynamics::sum_over(ranks_, {.first = begin, .last = end}, last - first, zero,
                              [&](std::ptrdiff_t i) { return term(static_cast<std::size_t>(first + i)); });
}

template <int Dim>
std::vector<double> BodyRotation<Dim>::angles(std::span<const Vector<Dim>> u) const {
    std::vector<double> angles;
    for (std::size_t body = 0; body < bodies_.size(); ++body) {
        const auto& [centre, inverse] = bodies_[body];
        // sum m u (x - centre)^T
        const Matrix<Dim> moment = sum_of(body, Matrix<Dim>::Zero(), [&, at = centre](std::size_t c) -> Matrix<Dim> {
            return (masses_[c] * u[c]) * (rest_[c] - at).transpose();
        });
        angles.push_back(rotation_angle<Dim>(nearest_rotation(Matrix<Dim>::Identity() + moment * inverse)));
    }
    return angles;
}

template class BodyRotation<2>;
template class BodyRotation<3>;

}  // namespace abut::solid
