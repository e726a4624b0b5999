#include "abut/contact/surface/surface.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/state_bytes.hpp"
#include "abut/contact/surface/face_name.hpp"
#include "abut/geometry/overlap/overlap.hpp"
#include "abut/geometry/polygon.hpp"

namespace abut::contact {
namespace {

[[noreturn]] void refuse_named(const std::string& face, const std::string& what, const ErrorFacts& facts = {}) {
    throw BadInput("contact surface: " + face + " " + what, facts);
}

template <int Dim>
[[noreturn]] void refuse(const SurfaceView<Dim>& surface, std::int32_t face, const std::string& what) {
    refuse_named(face_name(surface, face), what, {.face_1 = face});
}

/// The allowed deviation of measures, over the size of the face.
template <int Dim>
double tolerance(const SurfaceView<Dim>& surface, std::int32_t face) {
    return geometry::face_tolerance<Dim>(surface.centroid[face], surface.area[face]);
}

/// A segment in 2D; a polygon with a limited number of corners in 3D.
template <int Dim>
void check_n_corners(std::size_t n_corners, const std::string& face) {
    constexpr int most = Dim == 2 ? 2 : geometry::max_polygon_vertices;
    if (n_corners >= Dim && n_corners <= static_cast<std::size_t>(most)) return;
    refuse_named(face, "has " + std::to_string(n_corners) + " corners; " +
                           (Dim == 2 ? "2 are needed. Give every segment as a face."
                                     : "3 to " + std::to_string(most) + " are allowed. Cut it into triangles."));
}

template <int Dim>
void check_corners(const SurfaceView<Dim>& surface, std::int32_t face) {
    const auto corners = surface.vertices_of(face);
    check_n_corners<Dim>(corners.size(), face_name(surface, face));
    for (const std::int32_t v : corners) {
        if (v < 0 || static_cast<std::size_t>(v) >= surface.vertices.size())
            refuse(surface, face,
                   "names vertex " + std::to_string(v) + ", but there are " + std::to_string(surface.vertices.size()) +
                       ". Correct `face_vertices`.");
        if (!surface.vertices[v].allFinite())
            refuse(surface, face,
                   "has a corner (vertex " + std::to_string(v) + ") that is not finite. Correct it, or leave the face out.");
    }
}

template <int Dim>
void check_values(const SurfaceView<Dim>& surface, std::int32_t face) {
    const double area = surface.area[face];
    if (!(area > 0.0) || !std::isfinite(area))
        refuse(surface, face, "has the area " + number(area) + "; it must be finite and > 0. Leave it out.");
    if (!surface.centroid[face].allFinite())
        refuse(surface, face, "has a centroid that is not finite. Correct it, or leave the face out.");
    const double length = surface.normal[face].norm();
    if (!(std::abs(length - 1.0) < 1e-10))
        refuse(surface, face, "has a normal of length " + number(length) + "; it must be 1 within 1e-10. Normalise it.");
    if (!(surface.stiffness[face] > 0.0))
        refuse(surface, face,
               "has the stiffness " + number(surface.stiffness[face]) +
                   " Pa/m; it must be > 0. Give (lambda + 2 mu) |f|/|c|, or infinity for a rigid face.");
    if (surface.steps_to_edge(face) > far_from_sharp_edge)
        refuse(surface, face,
               "is said to be " + std::to_string(surface.steps_to_edge(face)) + " steps away from a sharp edge, at most " +
                   std::to_string(far_from_sharp_edge) + " are counted. Take contact::steps_to_sharp_edge.");
    if (!surface.shear_stiffness.empty() &&
        (!(surface.shear_stiffness[face] > 0.0) || std::isinf(surface.shear_stiffness[face]) != surface.is_rigid(face)))
        refuse(surface, face,
               "has the shear stiffness " + number(surface.shear_stiffness[face]) +
                   " Pa/m; it must be > 0, and infinity for a rigid face. Give mu |f|/|c|.");
    if (!(surface.cell_depth[face] >= 0.0) || (surface.cell_depth[face] == 0.0 && !surface.is_rigid(face)))
        refuse(surface, face,
               "has the cell depth " + number(surface.cell_depth[face]) +
                   " m; it must be > 0 (>= 0 if rigid). Give the distance from the centroid of its cell to its plane.");
}

/// The corners of a face whose number has been checked.
template <int Dim>
class Corners {
public:
    Corners(const SurfaceView<Dim>& surface, std::int32_t face) {
        for (const std::int32_t v : surface.vertices_of(face)) points_[size_++] = surface.vertices[v];
    }
    operator std::span<const Vector<Dim>>() const { return {points_.data(), size_}; }
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    std::array<Vector<Dim>, geometry::max_polygon_vertices> points_;
    std::size_t size_ = 0;
};

/// Area, centroid and normal must be those of the corners.
template <int Dim>
void check_measures(const SurfaceView<Dim>& surface, std::int32_t face) {
    const Corners corners(surface, face);
    const double area = geometry::face_measure<Dim>(corners);
    const double allowed = tolerance(surface, face);
    if (!(std::abs(surface.area[face] - area) <= allowed * area))
        refuse(surface, face,
               "has the area " + number(surface.area[face]) + ", its corners give " + number(area) +
                   ". Compute it from the corners.");
    const double off = (surface.centroid[face] - geometry::face_centroid<Dim>(corners)).norm();
    const double size = Dim == 2 ? area : std::sqrt(area);
    if (!(off <= allowed * size))
        refuse(surface, face,
               "has its centroid " + number(off) + " m away from that of its corners. Compute it from the corners.");
    const Vector<Dim> normal = geometry::face_normal<Dim>(corners);
    double turned = (surface.normal[face] - normal).norm();
    if (Dim == 2) turned = std::min(turned, (surface.normal[face] + normal).norm());  // corners come in any order
    if (!(turned <= allowed))
        refuse(surface, face,
               "has a normal that is " + number(turned) + " away from that of its corners; " + number(allowed) +
                   " is allowed, and corners run counter-clockwise seen from outside. Turn them round, or compute the "
                   "normal from them.");
}

void check_shape(const SurfaceView<3>& surface, std::int32_t face, double planarity_tolerance) {
    const Corners corners(surface, face);
    if (corners.size() == 3) return;
    const double size = std::sqrt(surface.area[face]);
    const double allowed = tolerance(surface, face);
    const double deviation = geometry::planarity_deviation<3>(corners);
    const double from_plane = std::max(allowed, planarity_tolerance);
    if (!(deviation <= from_plane * size))
        refuse(surface, face,
               "is not flat: a corner lies " + number(deviation / size) + " face sizes off its plane, " +
                   number(from_plane) + " is allowed. Cut it into triangles, or raise the tolerance of planarity.");
    if (!geometry::is_convex<3>(corners, allowed * size)) refuse(surface, face, "is not convex. Cut it into triangles.");
}

void check_shape(const SurfaceView<2>&, std::int32_t, double) {}

template <int Dim>
void check_face(const SurfaceView<Dim>& surface, std::int32_t face, double planarity_tolerance) {
    check_corners(surface, face);
    check_values(surface, face);
    check_shape(surface, face, planarity_tolerance);
    check_measures(surface, face);
}

}  // namespace

template <int Dim>
SurfaceView<Dim> Surface<Dim>::view() const {
    return {vertices,  face_offsets, face_vertices,       centroid,       normal, area, cell_depth,
            stiffness, body,         steps_to_sharp_edge, shear_stiffness};
}

template <int Dim>
void Surface<Dim>::append(std::span<const Vector<Dim>> corners, double face_cell_depth, double face_stiffness,
                          std::int32_t face_body) {
    check_n_corners<Dim>(corners.size(), "face " + std::to_string(size()));
    for (const Vector<Dim>& corner : corners) {
        face_vertices.push_back(static_cast<std::int32_t>(vertices.size()));
        vertices.push_back(corner);
    }
    face_offsets.push_back(static_cast<std::int32_t>(face_vertices.size()));
    centroid.push_back(geometry::face_centroid<Dim>(corners));
    normal.push_back(geometry::face_normal<Dim>(corners));
    area.push_back(geometry::face_measure<Dim>(corners));
    cell_depth.push_back(face_cell_depth);
    stiffness.push_back(face_stiffness);
    body.push_back(face_body);
    if (!steps_to_sharp_edge.empty()) steps_to_sharp_edge.push_back(far_from_sharp_edge);
    if (!shear_stiffness.empty()) shear_stiffness.push_back(std::numeric_limits<double>::infinity());
}

template <int Dim>
void check_sizes(const SurfaceView<Dim>& surface) {
    const std::size_t n = surface.area.size();
    const auto require_size = [&](std::size_t size, std::size_t expected, const char* array) {
        if (size != expected)
            throw BadInput(std::string("contact surface: `") + array + "` has " + std::to_string(size) + " entries, " +
                           std::to_string(expected) + " are needed: one per face" +
                           (expected == n ? "." : ", and one more."));
    };
    require_size(surface.face_offsets.size(), n + 1, "face_offsets");
    require_size(surface.centroid.size(), n, "centroid");
    require_size(surface.normal.size(), n, "normal");
    require_size(surface.cell_depth.size(), n, "cell_depth");
    require_size(surface.stiffness.size(), n, "stiffness");
    require_size(surface.body.size(), n, "body");
    if (!surface.steps_to_sharp_edge.empty()) require_size(surface.steps_to_sharp_edge.size(), n, "steps_to_sharp_edge");
    if (!surface.shear_stiffness.empty()) require_size(surface.shear_stiffness.size(), n, "shear_stiffness");
    const auto refuse_offsets = [](const std::string& what) {
        throw BadInput("contact surface: `face_offsets` " + what + "; it must rise from 0 to the size of `face_vertices`.");
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
void check(const SurfaceView<Dim>& surface, double planarity_tolerance) {
    check_sizes(surface);
    std::atomic<std::int32_t> first_bad = surface.size();  // so that the message does not depend on the threads
    parallel_ranges(surface.size(), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        for (auto face = static_cast<std::int32_t>(begin); face < end && face < first_bad; ++face) {
            try {
                check_face(surface, face, planarity_tolerance);
            } catch (const BadInput&) {
                for (std::int32_t known = first_bad; face < known && !first_bad.compare_exchange_weak(known, face);) {
                }
            }
        }
    });
    if (first_bad < surface.size()) check_face<Dim>(surface, first_bad, planarity_tolerance);
}

template <int Dim>
std::uint64_t fingerprint(const SurfaceView<Dim>& surface) {
    Checksum checksum;
    checksum.add_values(surface.face_offsets);
    checksum.add_values(surface.face_vertices);
    for (const std::int32_t v : surface.face_vertices)
        checksum.add_values(std::span<const double>(surface.vertices[v].data(), Dim));
    checksum.add_values(surface.cell_depth);
    checksum.add_values(surface.stiffness);
    checksum.add_values(surface.body);
    checksum.add_values(surface.steps_to_sharp_edge);
    checksum.add_values(surface.shear_stiffness);
    return checksum.value();
}

template struct SurfaceView<2>;
template struct SurfaceView<3>;
template struct Surface<2>;
template struct Surface<3>;
template void check_sizes<2>(const SurfaceView<2>&);
template void check_sizes<3>(const SurfaceView<3>&);
template void check<2>(const SurfaceView<2>&, double);
template void check<3>(const SurfaceView<3>&, double);
template std::uint64_t fingerprint<2>(const SurfaceView<2>&);
template std::uint64_t fingerprint<3>(const SurfaceView<3>&);

}  // namespace abut::contact
