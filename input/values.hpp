#pragma once
// Private to the layer.
#include <algorithm>

#include "abut/base/rotation.hpp"
#include "abut/input/settings.hpp"

/// Values of a scene in one dimension.
namespace abut::input {

/// About z in the plane.
template <int Dim>
[[nodiscard]] AxialVector<Dim> axial(const Vector<3>& vector) {
    if constexpr (Dim == 2)
        return AxialVector<2>(vector.z());
    else
        return vector;
}

/// By an angle about z, or by axis times angle [rad].
template <int Dim>
[[nodiscard]] Matrix<Dim> rotation(const Vector<3>& turn) {
    if constexpr (Dim == 2)
        return rotation_in_plane(turn.z());
    else
        return rotation_about(Vector<3>(turn.normalized()), turn.norm());
}

[[nodiscard]] inline bool varies(const FieldSettings& field) {
    return std::ranges::any_of(field, [](const Formula& component) { return component.varies(); });
}

template <int Dim>
[[nodiscard]] Vector<Dim> value_at(const FieldSettings& field, double time, const Vector<3>& position) {
    Vector<Dim> value;
    for (int i = 0; i < Dim; ++i) value[i] = field[static_cast<std::size_t>(i)](time, position);
    return value;
}

}  // namespace abut::input
