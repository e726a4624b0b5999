#include "abut/geometry/pair_potential/pair_approach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "abut/geometry/pair_potential/lane_pair.hpp"

namespace abut::geometry {
namespace {

constexpr double tie = 1e-9;  // of the lengths: points this near to each other are one

using PlanePair = std::array<Vector<2>, 6>;  // corners 0 to 2 counter-clockwise, 3 to 5 clockwise

/// From direction a to b, counter-clockwise, in [0, 2 pi).
double turned(const Vector<2>& a, const Vector<2>& b) {
    const double angle = std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

/// A corner of one triangle and the point of an edge of the other one that are nearest to each other.
struct Nearest {
    double squared_distance = std::numeric_limits<double>::infinity();
    int corner = 0;
    int start = 0, end = 0;  ///< of the edge
    double along = 0.0;      ///< of the edge, from 0 to 1
};

Nearest nearest_of(const PlanePair& plane) {
    Nearest nearest;
    for (int corner = 0; corner < 6; ++corner)
        for (int edge = 0; edge < 3; ++edge) {
            const int other = corner < 3 ? 3 : 0, start = other + edge, end = other + (edge + 1) % 3;
            const Vector<2> across = plane[end] - plane[start], from = plane[corner] - plane[start];
            const double along = std::clamp(across.dot(from) / across.squaredNorm(), 0.0, 1.0);
            const double squared_distance = (from - along * across).squaredNorm();
            if (squared_distance < nearest.squared_distance) nearest = {squared_distance, corner, start, end, along};
        }
    return nearest;
}

OutlinePart at_corner(const PlanePair& plane, int corner, const Vector<2>& to) {
    const int face = corner / 3, local = corner % 3, first = 3 * face;
    const Vector<2> at = plane[corner];
    Vector<2> next = plane[first + (local + 1) % 3] - at, previous = plane[first + (local + 2) % 3] - at,
              direction = to - at;
    if (direction.norm() <= tie * (next.norm() + previous.norm())) {
        const int other = 3 - first;
        direction = (plane[other] + plane[other + 1] + plane[other + 2]) / 3.0 - at;
    }
    if (face == 1)  // clockwise: seen from the other side
        for (Vector<2>* v : {&next, &previous, &direction}) (*v)[1] = -(*v)[1];
    const double inside = turned(next, previous), angle = turned(next, direction);
    OutlinePart part{.corner = local};
    if (angle <= inside) return part;
    part.past_next = 2.0 * std::numbers::pi - angle;
    part.past_previous = angle - inside;
    return part;
}

}  // namespace

template <>
std::array<OutlinePart, 2> pair_approach(const PairCorners<2>& corners, const PairLaw<2>& law) {
    const lanes::LaneFrame<double, 2> frame(lanes::corners_of<2>(corners), lanes::law_of<2>(law));
    // xi falls along face 1 and rises along face 2
    const int end = frame.z.at[0].c[0] <= frame.z.at[2].c[0] ? 0 : 1;
    return {OutlinePart{.corner = end}, OutlinePart{.corner = end}};
}

template <>
std::array<OutlinePart, 2> pair_approach(const PairCorners<3>& corners, const PairLaw<3>& law) {
    const lanes::LaneFrame<double, 3> frame(lanes::corners_of<3>(corners), lanes::law_of<3>(law));
    const lanes::SeenPair<double> seen(frame.z, law.offset);
    PlanePair plane;
    for (std::size_t v = 0; v < plane.size(); ++v) plane[v] = lanes::vector_of(seen.plane[v]);

    const Nearest nearest = nearest_of(plane);
    const Vector<2> on_edge = plane[nearest.start] + nearest.along * (plane[nearest.end] - plane[nearest.start]);
    std::array<OutlinePart, 2> parts;
    parts[nearest.corner / 3] = at_corner(plane, nearest.corner, on_edge);
    OutlinePart& other = parts[nearest.start / 3];
    if (nearest.along <= tie)
        other = at_corner(plane, nearest.start, plane[nearest.corner]);
    else if (nearest.along >= 1.0 - tie)
        other = at_corner(plane, nearest.end, plane[nearest.corner]);
    else
        other = {.edge = nearest.start % 3};
    return parts;
}

}  // namespace abut::geometry
