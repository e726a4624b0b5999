#pragma once

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// Orthonormal tangents of a plane (3D) or a line (2D), one per column.
template <int Dim>
using Tangents = SmallMatrix<Dim, Dim - 1>;

/// `vector` turned by the shortest rotation that takes the unit vector `from` to `to`, also unit. They must not be opposite:
/// there is no shortest rotation then.
template <int Dim>
[[nodiscard]] Vector<Dim> turned(const Vector<Dim>& vector, const Vector<Dim>& from, const Vector<Dim>& to) {
    const double cosine = from.dot(to);
    if constexpr (Dim == 2) {
        const double sine = from[0] * to[1] - from[1] * to[0];
        return {cosine * vector[0] - sine * vector[1], sine * vector[0] + cosine * vector[1]};
    } else {
        const Vector<3> axis = from.cross(to);
        return vector + axis.cross(vector) + axis.cross(Vector<3>(axis.cross(vector))) / (1.0 + cosine);
    }
}

/// Tangents turned likewise.
template <int Dim>
[[nodiscard]] Tangents<Dim> turned(const Tangents<Dim>& tangents, const Vector<Dim>& from, const Vector<Dim>& to) {
    Tangents<Dim> result;
    for (int i = 0; i < Dim - 1; ++i) result.col(i) = turned<Dim>(Vector<Dim>(tangents.col(i)), from, to);
    return result;
}

/// Components of a vector along tangents. Products are rounded before they are added, as in PlaneFrame::lift.
template <int Dim>
[[nodiscard]] PlaneVector<Dim> components(const Tangents<Dim>& tangents, const Vector<Dim>& vector) {
    PlaneVector<Dim> result;
    for (int i = 0; i < Dim - 1; ++i) result[i] = tangents.col(i).dot(vector);
    return result;
}

/// The vector of space with these components.
template <int Dim>
[[nodiscard]] Vector<Dim> in_space(const Tangents<Dim>& tangents, const PlaneVector<Dim>& components) {
    Vector<Dim> result = components[0] * tangents.col(0);
    if constexpr (Dim == 3) result += components[1] * tangents.col(1);
    return result;
}

}  // namespace abut::geometry
