#pragma once

namespace abut::geometry {

/// Allowed distance of a corner from the plane of its polygon, over the size of the face [-]: the default. Coordinates in
/// single precision, which many programs write, leave up to 1e-7 of the size of a body, a few times 1e-7 of that of its
/// faces. Gap, area and measures of a body are wrong by no more than the like of this.
inline constexpr double planarity_tolerance = 1e-6;

}  // namespace abut::geometry
