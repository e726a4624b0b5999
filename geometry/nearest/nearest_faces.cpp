#include "abut/geometry/nearest/nearest_faces.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "abut/base/index.hpp"

namespace abut::geometry {
namespace {

using Faces = std::vector<std::int32_t>;

double distance(const Box<3>& a, const Box<3>& b) {
    return (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(0.0).norm();
}

Box<3> box_of(const FaceSoup& surface, std::int32_t face) {
    Box<3> box;
    for (const std::int32_t v : surface.vertices_of(face)) box.extend(surface.vertices[at(v)]);
    return box;
}

Box<3> box_of(const FaceSoup& surface, const Faces& faces) {
    Box<3> box;
    for (const std::int32_t face : faces) box.extend(box_of(surface, face));
    return box;
}

Faces all_of(const FaceSoup& surface) {
    Faces all(at(surface.size()));
    std::iota(all.begin(), all.end(), 0);
    return all;
}

Faces faces_near(const FaceSoup& surface, const Box<3>& box, double bound) {
    Faces near;
    for (std::int32_t face = 0; face < surface.size(); ++face)
        if (distance(box_of(surface, face), box) <= bound) near.push_back(face);
    return near;
}

/// Distance of two vertices that are near each other: the nearest one to a vertex of the other surface, in turn.
double distance_of_vertices(const FaceSoup& surface_1, const FaceSoup& surface_2, const Box<3>& box_2) {
    constexpr int turns = 4;
    Vector<3> x = 0.5 * (box_2.lower + box_2.upper);
    double least = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < turns; ++turn) {
        const FaceSoup& surface = turn % 2 == 0 ? surface_1 : surface_2;
        const Vector<3> from = x;
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::int32_t v : surface.face_vertices)
            if (const double away = (surface.vertices[at(v)] - from).norm(); away < nearest)
                std::tie(nearest, x) = std::pair(away, surface.vertices[at(v)]);
        if (turn > 0) least = std::min(least, nearest);  // the first was from a point of no surface
    }
    return least;
}

FaceTree<3> tree_of(const FaceSoup& surface, const Faces& faces) {
    std::vector<std::vector<Vector<3>>> all;
    for (const std::int32_t face : faces) {
        auto& corners = all.emplace_back();
        for (const std::int32_t v : surface.vertices_of(face)) corners.push_back(surface.vertices[at(v)]);
    }
    return FaceTree<3>(std::move(all));
}

}  // namespace

NearestFaces nearest_faces(const FaceSoup& surface_1, const FaceSoup& surface_2) {
    if (surface_1.size() == 0 || surface_2.size() == 0) return {};
    const Box<3> box_2 = box_of(surface_2, all_of(surface_2));
    const double bound = (1.0 + 1e-9) * distance_of_vertices(surface_1, surface_2, box_2);
    const Faces faces_1 = faces_near(surface_1, box_2, bound);
    const Faces faces_2 = faces_near(surface_2, box_of(surface_1, faces_1), bound);
    NearestFaces nearest = nearest_faces(tree_of(surface_1, faces_1), tree_of(surface_2, faces_2));
    nearest.face_1 = faces_1[at(nearest.face_1)];
    nearest.face_2 = faces_2[at(nearest.face_2)];
    return nearest;
}

}  // namespace abut::geometry
