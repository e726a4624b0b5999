#include "abut/geometry/pair_potential/pair_slip.hpp"

#include <algorithm>
#include <cmath>

namespace abut::geometry {
namespace {

/// A face is continued to a point that is so many of its least heights from where it presses, where that can be.
constexpr double continued_at_most = 0.25;

/// x_c between the points where both faces press: half way where neither face is continued farther than is `allowed`
/// [m], else nearer to the one that is a needle. Where both are, each is continued by as many of its heights as the
/// other one.
template <int Dim>
Vector<Dim> common_point(const std::array<Vector<Dim>, 2>& pressed, double distance, const std::array<double, 2>& allowed) {
    if (0.5 * distance <= std::min(allowed[0], allowed[1])) return 0.5 * (pressed[0] + pressed[1]);
    const double of_both = allowed[0] + allowed[1];
    const double from_first =
        distance >= of_both ? allowed[0] / of_both : std::clamp(0.5, 1.0 - allowed[1] / distance, allowed[0] / distance);
    return pressed[0] + from_first * (pressed[1] - pressed[0]);
}

}  // namespace

template <>
void PairSlip<2>::find_slopes(Side& side) {
    const Vector<2> edge = side.corner[1] - side.corner[0];
    const double squared_length = edge.squaredNorm();
    side.normal = Vector<2>(edge[1], -edge[0]) / std::sqrt(squared_length);
    side.slope[1] = edge / squared_length;
    side.slope[0] = -side.slope[1];
    side.steepest = 1.0 / squared_length;
}

template <>
void PairSlip<3>::find_slopes(Side& side) {
    const Vector<3> edge_b = side.corner[1] - side.corner[0], edge_c = side.corner[2] - side.corner[0];
    const Vector<3> area = edge_b.cross(edge_c);
    const double squared_area = area.squaredNorm();
    side.normal = area / std::sqrt(squared_area);
    side.slope[1] = edge_c.cross(area) / squared_area;
    side.slope[2] = area.cross(edge_b) / squared_area;
    side.slope[0] = -(side.slope[1] + side.slope[2]);
    side.steepest = std::max({edge_b.squaredNorm(), edge_c.squaredNorm(), (edge_c - edge_b).squaredNorm()}) / squared_area;
}

template <int Dim>
PairSlip<Dim>::PairSlip(const PairCorners<Dim>& x_0, const PairCorners<Dim>& x_1, const PairPressure<Dim>& pressure) {
    std::array<Vector<Dim>, 2> pressed;  // y_i: where each face presses
    for (std::size_t face = 0; face < 2; ++face) {
        Side& side = side_[face];
        double sum = 0.0;
        for (std::size_t i = 0; i < Dim; ++i) sum += pressure[Dim * face + i];
        pressed[face].setZero();
        for (std::size_t i = 0; i < Dim; ++i) {
            const std::size_t v = Dim * face + i;
            side.corner[i] = 0.5 * (x_0[v] + x_1[v]);
            side.motion[i] = x_1[v] - x_0[v];
            side.share[i] = pressure[v] / sum;
            pressed[face] += side.share[i] * side.corner[i];
        }
        find_slopes(side);
    }
    const double distance = (pressed[1] - pressed[0]).norm();
    const std::array<double, 2> allowed{continued_at_most / std::sqrt(side_[0].steepest),
                                        continued_at_most / std::sqrt(side_[1].steepest)};
    point_ = common_point<Dim>(pressed, distance, allowed);
    normal_ = (side_[0].normal - side_[1].normal).normalized();
    for (std::size_t face = 0; face < 2; ++face) {
        Side& side = side_[face];
        const Vector<Dim> from_pressed = point_ - pressed[face];
        side.height = side.normal.dot(from_pressed);
        for (std::size_t i = 0; i < Dim; ++i) side.share[i] += side.slope[i].dot(from_pressed);
    }
    motion_ = continued_motion();
    scale_ = distance > allowed[0] + allowed[1] ? (allowed[0] + allowed[1]) / distance : 1.0;
    scale_ *= cut_to_corners(scale_ * motion_);
    if (is_clipped()) motion_ *= scale_;
}

/// A point over a face moves with the shape functions, and turns with the normal: dn = -sum slope_j (n . dx_j).
template <int Dim>
Vector<Dim> PairSlip<Dim>::continued_motion() const {
    std::array<Vector<Dim>, 2> of_face;
    for (std::size_t face = 0; face < 2; ++face) {
        const Side& side = side_[face];
        of_face[face].setZero();
        for (std::size_t i = 0; i < Dim; ++i)
            of_face[face] +=
                side.share[i] * side.motion[i] - (side.height * side.normal.dot(side.motion[i])) * side.slope[i];
    }
    return of_face[1] - of_face[0];
}

/// Factor that cuts the slip of a motion to that of corners past each other.
template <int Dim>
double PairSlip<Dim>::cut_to_corners(const Vector<Dim>& motion) const {
    const double squared_slip = (motion - normal_ * normal_.dot(motion)).squaredNorm();
    constexpr double rounding = 1e-13;
    double farthest = rounding * rounding * side_[0].corner[0].squaredNorm();  // squared
    for (const Vector<Dim>& of_first : side_[0].motion)
        for (const Vector<Dim>& of_second : side_[1].motion) {
            farthest = std::max(farthest, (of_second - of_first).squaredNorm());
            if (squared_slip <= farthest) return 1.0;
        }
    return std::sqrt(farthest / squared_slip);
}

/// The tangent of a line stands on its normal, and is turned as it is.
template <>
Tangents<2> PairSlip<2>::tangents(int face) const {
    const double sign = face == 0 ? 1.0 : -1.0;
    return Vector<2>(-sign * normal_[1], sign * normal_[0]);
}

template <>
Tangents<3> PairSlip<3>::tangents(int face) const {
    const Side& side = side_[static_cast<std::size_t>(face)];
    Tangents<3> own;
    own.col(0) = (side.corner[1] - side.corner[0]).normalized();
    own.col(1) = side.normal.cross(Vector<3>(own.col(0)));
    return turned<3>(own, side.normal, face == 0 ? normal_ : Vector<3>(-normal_));
}

template <int Dim>
PairCorners<Dim> PairSlip<Dim>::on_corners(const Vector<Dim>& on_second) const {
    const Vector<Dim> force = scaled(on_second);
    PairCorners<Dim> on_corners;
    for (std::size_t face = 0; face < 2; ++face) {
        const Side& side = side_[face];
        const double sign = face == 0 ? -1.0 : 1.0;
        for (std::size_t i = 0; i < Dim; ++i)
            on_corners[Dim * face + i] =
                sign * (side.share[i] * force - (side.height * side.slope[i].dot(force)) * side.normal);
    }
    return on_corners;
}

template class PairSlip<2>;
template class PairSlip<3>;

}  // namespace abut::geometry
