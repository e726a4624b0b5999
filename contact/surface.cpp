#include "abut/contact/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "abut/geometry/messages.hpp"
#include "abut/geometry/overlap.hpp"
#include "abut/geometry/polygon.hpp"

namespace abut::contact {
namespace {

inline constexpr double tolerance = 1e-10;  // of the size of a face

[[noreturn]] void refuse(std::int32_t face, const std::string& what) {
    throw std::invalid_argument("contact surface: face " + std::to_string(face) + " " + what);
}

template <int Dim>
void check_sizes(const SurfaceView<Dim>& surface) {
    const std::size_t n = surface.area.size();
    const auto require_size = [&](std::size_t size, std::size_t expected, const char* array) {
        if (size != expected)
            throw std::invalid_argument(std::string("contact surface: `") + array + "` has " + std::to_string(size) +
                                        " entries, " + std::to_string(expected) + " are needed: one a face" +
                                        (expected == n ? "." : ", and one more."));
    };
    require_size(surface.face_offsets.size(), n + 1, "face_offsets");
    require_size(surface.centroid.size(), n, "centroid");
    require_size(surface.normal.size(), n, "normal");
    require_size(surface.depth.size(), n, "depth");
    require_size(surface.stiffness.size(), n, "stiffness");
    require_size(surface.body.size(), n, "body");
    const auto refuse_offsets = [](const std::string& what) {
        throw std::invalid_argument("contact surface: `face_offsets` " + what +
                                    "; it must rise from 0 to the size of `face_vertices`.");
    };
    if (surface.face_offsets.front() != 0) refuse_offsets("begins with " + std::to_string(surface.face_offsets.front()));
    for (std::size_t face = 0; face < n; ++face)
        if (surface.face_offsets[face + 1] < surface.face_offsets[face])
            refuse_offsets("falls after face " + std::to_string(face));
    if (static_cast<std::size_t>(surface.face_offsets.back()) != surface.face_vertices.size())
        refuse_offsets("ends with " + std::to_string(surface.face_offsets.back()) + " for " +
                       std::to_string(surface.face_vertices.size()) + " entries");
}

template <int Dim>
void check_corners(const SurfaceView<Dim>& surface, std::int32_t face) {
    const auto corners = surface.vertices_of(face);
    if (corners.size() < static_cast<std::size_t>(Dim) ||
        corners.size() > static_cast<std::size_t>(geometry::max_polygon_vertices))
        refuse(face, "has " + std::to_string(corners.size()) + " corners; " + std::to_string(Dim) + " to " +
                         std::to_string(geometry::max_polygon_vertices) + " are allowed. Cut it into triangles.");
    for (const std::int32_t v : corners) {
        if (v < 0 || static_cast<std::size_t>(v) >= surface.vertices.size())
            refuse(face, "names vertex " + std::to_string(v) + ", but there are " + std::to_string(surface.vertices.size()) +
                             ". Correct `face_vertices`.");
        if (!surface.vertices[v].allFinite())
            refuse(face,
                   "has a corner (vertex " + std::to_string(v) + ") that is not finite. Correct it, or leave the face out.");
    }
}

template <int Dim>
void check_values(const SurfaceView<Dim>& surface, std::int32_t face) {
    const double area = surface.area[face];
    if (!(area > 0.0) || !std::isfinite(area))
        refuse(face, "has the area " + number(area) + "; it must be finite and > 0. Leave it out.");
    if (!surface.centroid[face].allFinite())
        refuse(face, "has a centroid that is not finite. Correct it, or leave the face out.");
    const double length = surface.normal[face].norm();
    if (!(std::abs(length - 1.0) < tolerance))
        refuse(face, "has a normal of length " + number(length) + "; it must be 1 within 1e-10. Normalise it.");
    if (!(surface.stiffness[face] > 0.0))
        refuse(face, "has the stiffness " + number(surface.stiffness[face]) +
                         " Pa/m; it must be > 0. Give (lambda + 2 mu) |f|/|c|, or infinity for a rigid face.");
    if (!(surface.depth[face] >= 0.0) || (surface.depth[face] == 0.0 && !surface.is_rigid(face)))
        refuse(face,
               "has the depth " + number(surface.depth[face]) +
                   " m; it must be > 0 (>= 0 if rigid). Give the distance from the centroid of its cell to its plane.");
}

template <int Dim>
std::vector<Vector<Dim>> corners_of(const SurfaceView<Dim>& surface, std::int32_t face) {
    std::vector<Vector<Dim>> corners;
    for (const std::int32_t v : surface.vertices_of(face)) corners.push_back(surface.vertices[v]);
    return corners;
}

/// Area, centroid and normal must be those of the corners.
template <int Dim>
void check_measures(const SurfaceView<Dim>& surface, std::int32_t face) {
    const auto corners = corners_of(surface, face);
    const double area = geometry::face_measure<Dim>(corners);
    if (!(std::abs(surface.area[face] - area) <= tolerance * area))
        refuse(face, "has the area " + number(surface.area[face]) + ", its corners give " + number(area) +
                         ". Compute it from the corners.");
    const double off = (surface.centroid[face] - geometry::face_centroid<Dim>(corners)).norm();
    const double size = Dim == 2 ? area : std::sqrt(area);
    if (!(off <= tolerance * std::max(size, surface.centroid[face].norm())))
        refuse(face, "has its centroid " + number(off) + " m away from that of its corners. Compute it from the corners.");
    const double cosine = surface.normal[face].dot(geometry::face_normal<Dim>(corners));
    if (!((Dim == 2 ? std::abs(cosine) : cosine) > 1.0 - tolerance))
        refuse(face, "has a normal whose cosine to that of its corners is " + number(cosine) +
                         "; it must be 1: corners run counter-clockwise seen from outside. Turn them round, or compute the "
                         "normal from them.");
}

void check_shape(const SurfaceView<3>& surface, std::int32_t face) {
    const auto corners = corners_of(surface, face);
    const double size = std::sqrt(surface.area[face]);
    const double deviation = geometry::planarity_deviation<3>(corners);
    if (deviation > tolerance * size)
        refuse(face, "is not flat: a corner lies " + number(deviation / size) +
                         " face sizes off its plane, 1e-10 is allowed. Cut it into triangles.");
    if (!geometry::is_convex<3>(corners, tolerance * size)) refuse(face, "is not convex. Cut it into triangles.");
}

void check_shape(const SurfaceView<2>&, std::int32_t) {}

}  // namespace

template <int Dim>
bool SurfaceView<Dim>::is_rigid(std::int32_t face) const {
    return stiffness[face] == std::numeric_limits<double>::infinity();
}

template <int Dim>
SurfaceView<Dim> Surface<Dim>::view() const {
    return {vertices, face_offsets, face_vertices, centroid, normal, area, depth, stiffness, body};
}

template <int Dim>
void Surface<Dim>::append(std::span<const Vector<Dim>> corners, double face_depth, double face_stiffness,
                          std::int32_t face_body) {
    for (const Vector<Dim>& corner : corners) {
        face_vertices.push_back(static_cast<std::int32_t>(vertices.size()));
        vertices.push_back(corner);
    }
    face_offsets.push_back(static_cast<std::int32_t>(face_vertices.size()));
    centroid.push_back(geometry::face_centroid<Dim>(corners));
    normal.push_back(geometry::face_normal<Dim>(corners));
    area.push_back(geometry::face_measure<Dim>(corners));
    depth.push_back(face_depth);
    stiffness.push_back(face_stiffness);
    body.push_back(face_body);
}

template <int Dim>
void check(const SurfaceView<Dim>& surface) {
    check_sizes(surface);
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        check_corners(surface, face);
        check_values(surface, face);
        check_shape(surface, face);
        check_measures(surface, face);
    }
}

template struct SurfaceView<2>;
template struct SurfaceView<3>;
template struct Surface<2>;
template struct Surface<3>;
template void check<2>(const SurfaceView<2>&);
template void check<3>(const SurfaceView<3>&);

}  // namespace abut::contact
