#pragma once
// Private to the sources of this layer.
#include <optional>
#include <string>

#include "abut/solid/solid.hpp"

namespace abut::solid {

/// A rigid motion that nothing stops, in words ("body 1 ('ball') is free to move along (0, 1)"); none: every body is held by
/// prescribed displacements, by bonds and by contacts that are closed in state q, or would be at once.
template <int Dim>
[[nodiscard]] std::optional<std::string> free_rigid_motion(Solid<Dim>& solid, std::span<const double> q);

}  // namespace abut::solid
