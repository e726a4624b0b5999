#pragma once
#include <cstdint>
#include <vector>

#include "abut/geometry/face_tree.hpp"
#include "apps/detect/bodies.hpp"

namespace abut::apps {

/// Two bodies, and their nearest faces among all.
struct NearestBodies {
    std::int32_t body_1, body_2;
    geometry::NearestFaces faces;
};

/// A body that is wholly inside of another one, whose surface is closed with normals outwards, and their faces that are
/// nearest.
struct InsideBody {
    std::int32_t inner, outer;
    double distance;  ///< of their surfaces [m]
};

/// More bodies than this are too many to look for the nearest of each.
inline constexpr std::size_t most_nearest_bodies = 2000;

/// How bodies lie to each other. Both are empty for more than `most_nearest_bodies`.
struct Neighbours {
    /// Every body with the one that is nearest to it, each pair once, body_1 < body_2, sorted: the least distance of
    /// all is among them. Of surfaces alone: a body inside of another one is as far away as its surface.
    std::vector<NearestBodies> nearest;
    std::vector<InsideBody> inside;  ///< sorted by the inner body
};
[[nodiscard]] Neighbours neighbours(const Bodies& bodies);

}  // namespace abut::apps
