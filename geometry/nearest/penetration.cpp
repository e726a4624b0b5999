#include "abut/geometry/nearest/penetration.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "abut/base/index.hpp"
#include "abut/geometry/box.hpp"
#include "abut/geometry/face_tree.hpp"
#include "abut/geometry/nearest/winding_number.hpp"

namespace abut::geometry {
namespace {

using Points = std::vector<Vector<3>>;

Box<3> box_of(const FaceSoup& surface) {
    Box<3> box;
    for (const std::int32_t v : surface.face_vertices) box.extend(surface.vertices[at(v)]);
    return box;
}

bool holds(const Box<3>& box, const Vector<3>& x) { return box.overlaps({x, x}); }

/// The middle of the part of an edge that lies in the box is added to the points.
void add_middle(const Vector<3>& from, const Vector<3>& to, const Box<3>& box, Points& points) {
    double begin = 0.0, end = 1.0;
    for (int i = 0; i < 3; ++i) {
        const double length = to[i] - from[i];
        if (length == 0.0 && (from[i] < box.lower[i] || from[i] > box.upper[i])) return;
        if (length == 0.0) continue;
        const auto [enters, leaves] =
            std::minmax({(box.lower[i] - from[i]) / length, (box.upper[i] - from[i]) / length});  // values, not references
        begin = std::max(begin, enters);
        end = std::min(end, leaves);
    }
    if (begin < end) points.push_back(from + 0.5 * (begin + end) * (to - from));
}

/// Points of the first surface in the box of the second.
Points points_within(const FaceSoup& surface, const Box<3>& box) {
    Points points;
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        const auto corners = surface.vertices_of(face);
        const auto corner = [&](std::size_t i) -> const Vector<3>& {
            return surface.vertices[at(corners[i % corners.size()])];
        };
        Vector<3> middle = Vector<3>::Zero();
        for (std::size_t i = 0; i < corners.size(); ++i) {
            middle += corner(i) / static_cast<double>(corners.size());
            if (holds(box, corner(i))) points.push_back(corner(i));
            add_middle(corner(i), corner(i + 1), box, points);
        }
        if (holds(box, middle)) points.push_back(middle);
    }
    return points;
}

FaceTree<3> tree_of(const FaceSoup& surface) {
    std::vector<Points> faces;
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        faces.emplace_back();
        for (const std::int32_t v : surface.vertices_of(face)) faces.back().push_back(surface.vertices[at(v)]);
    }
    return FaceTree<3>(std::move(faces));
}

/// Largest distance of the points of `inner` in `outer` from the surface of `outer`.
double depth_of(const FaceSoup& inner, const FaceSoup& outer) {
    constexpr double rounding = 1e-12;               // over the size of `outer`
    constexpr std::size_t most_angles = 20'000'000;  // of faces of `outer`, seen from points
    const Box<3> box = box_of(outer);
    const Points points = points_within(inner, box);
    if (points.empty()) return 0.0;
    const std::size_t stride = 1 + points.size() * at(outer.size()) / most_angles;
    const FaceTree<3> tree = tree_of(outer);
    double depth = 0.0;
    for (std::size_t i = 0; i < points.size(); i += stride) {
        if (!is_inside(outer, points[i])) continue;
        const FaceTree<3> point(std::vector<Points>(1, Points(3, points[i])));
        depth = std::max(depth, nearest_faces(point, tree).points.distance);
    }
    return depth > rounding * (box.upper - box.lower).norm() ? depth : 0.0;
}

}  // namespace

double penetration_depth(const FaceSoup& surface_1, const FaceSoup& surface_2) {
    return std::max(depth_of(surface_1, surface_2), depth_of(surface_2, surface_1));
}

}  // namespace abut::geometry
