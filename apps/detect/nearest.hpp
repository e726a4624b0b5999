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

/// Two bodies whose surfaces meet, or of which one is wholly inside of the other one; body_1 < body_2.
struct MeetingBodies {
    std::int32_t body_1, body_2;
    double depth;             ///< geometry::penetration_depth [m]; 0: they touch
    std::int32_t inner = -1;  ///< that which is inside; -1: neither is
};

/// More bodies than this are too many to look for the nearest of each.
inline constexpr std::size_t most_nearest_bodies = 2000;

/// How bodies lie to each other. All are empty for more than `most_nearest_bodies`.
struct Neighbours {
    /// Every body with the one that is nearest to it, each pair once, body_1 < body_2, sorted: the least distance of
    /// all is among them. Of surfaces alone: a body inside of another one is as far away as its surface.
    std::vector<NearestBodies> nearest;
    std::vector<InsideBody> inside;      ///< sorted by the inner body
    std::vector<MeetingBodies> meeting;  ///< sorted by body_1, then body_2
};
[[nodiscard]] Neighbours neighbours(const Bodies& bodies);

}  // namespace abut::apps
