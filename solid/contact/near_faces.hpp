#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/geometry/box.hpp"

namespace abut::solid {

/// Numbers of boxes that reach another body when those of that body grow by `margin` [m], increasing; and a few more, for
/// boxes of a body are looked at by small groups of them. `body`: of each box.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> near_others(std::span<const geometry::Box<Dim>> boxes,
                                                    std::span<const std::int32_t> body, double margin);

/// Distance of each box from those of other bodies, along the axis that tells them apart best [m]: 0 where boxes overlap, at
/// most `most`. `body`: of each box.
template <int Dim>
[[nodiscard]] std::vector<double> distances_to_others(std::span<const geometry::Box<Dim>> boxes,
                                                      std::span<const std::int32_t> body, double most);

}  // namespace abut::solid
