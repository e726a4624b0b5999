#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/geometry/box.hpp"

namespace abut::solid {

/// Distance of each box from those of other bodies, along the axis that tells them apart best [m]: 0 where boxes overlap, at
/// most `most`. `body`: of each box.
template <int Dim>
[[nodiscard]] std::vector<double> distances_to_others(std::span<const geometry::Box<Dim>> boxes,
                                                      std::span<const std::int32_t> body, double most);

/// As `distances_to_others`, for boxes that are far: others are looked at by small groups, whose boxes may be a little
/// nearer than all of them are.
template <int Dim>
[[nodiscard]] std::vector<double> distances_to_groups(std::span<const geometry::Box<Dim>> boxes,
                                                      std::span<const std::int32_t> body, double most);

}  // namespace abut::solid
