#pragma once
// Private to the layer.
#include <limits>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// A convex body of about unit size. In 2D it lies in the plane z = 0 and `half_thickness` can make a prism of it.
struct ConvexBody {
    std::vector<Vector<3>> points;
    Vector<3> centre = Vector<3>::Zero();
    double half_thickness = 0.0;

    [[nodiscard]] Vector<3> support(const Vector<3>& direction) const;
};

struct ConvexPair {
    ConvexBody body_1, body_2;

    /// The point of the difference 2 - 1 that lies farthest along `direction`.
    [[nodiscard]] Vector<3> support(const Vector<3>& direction) const {
        return body_2.support(direction) - body_1.support(-direction);
    }
    /// Room between the bodies seen along a unit direction; negative where they interlock.
    [[nodiscard]] double separation(const Vector<3>& direction) const { return direction.dot(support(-direction)); }
};

/// Two bodies that are made of given points, in the length `unit` [m].
struct UnitBodies {
    ConvexPair bodies;
    double unit;
};

/// Throws BadInput, beginning with `name`, if a set is empty or a coordinate is not finite.
template <int Dim>
[[nodiscard]] UnitBodies unit_bodies(std::span<const Vector<Dim>> points_1, std::span<const Vector<Dim>> points_2,
                                     const char* name);

/// Gilbert-Johnson-Keerthi: the vector from body 1 to body 2 between their nearest points; about zero if they overlap.
[[nodiscard]] Vector<3> gjk_gap(const ConvexPair& bodies);

/// The direction in which two bodies are farthest apart, of those tried so far.
struct BestDirection {
    double separation = -std::numeric_limits<double>::infinity();
    Vector<3> direction = Vector<3>::Zero();
};

/// Tries a direction of any length, and its opposite. Plane bodies are seen along directions in their plane.
void improve(BestDirection& best, const ConvexPair& bodies, Vector<3> proposal, bool is_plane);

/// The best of the directions that GJK and the axes propose.
[[nodiscard]] BestDirection best_of_gjk(const ConvexPair& bodies, bool is_plane);

}  // namespace abut::geometry
