#include "abut/geometry/pair_potential/pair_slip.hpp"

#include <cmath>

namespace abut::geometry {

template <>
void PairSlip<2>::find_slopes(Side& side) {
    const Vector<2> edge = side.corner[1] - side.corner[0];
    const double squared_length = edge.squaredNorm();
    side.normal = Vector<2>(edge[1], -edge[0]) / std::sqrt(squared_length);
    side.slope[1] = edge / squared_length;
    side.slope[0] = -side.slope[1];
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
    point_ = 0.5 * (pressed[0] + pressed[1]);
    normal_ = (side_[0].normal - side_[1].normal).normalized();
    for (std::size_t face = 0; face < 2; ++face) {
        Side& side = side_[face];
        const Vector<Dim> from_pressed = point_ - pressed[face];
        side.height = side.normal.dot(from_pressed);
        for (std::size_t i = 0; i < Dim; ++i) side.share[i] += side.slope[i].dot(from_pressed);
    }
}

/// A point over a face moves with the shape functions, and turns with the normal: dn = -sum slope_j (n . dx_j).
template <int Dim>
Vector<Dim> PairSlip<Dim>::motion() const {
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
PairCorners<Dim> PairSlip<Dim>::on_corners(const Vector<Dim>& force) const {
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
