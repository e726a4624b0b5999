#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/geometry/planarity.hpp"

namespace abut::contact {

/// Index of a face of a host, as it numbers them.
enum class Face : std::int32_t {};
/// Index of a facet: the part of a face that acts, flat and convex. Faces of a SurfaceView have one each; of a NodalSurface
/// those with four corners have two.
enum class Facet : std::int32_t {};
/// Index of a face in the candidate list of a Contact: index in `Contact::faces()`.
enum class ListedFace : std::int32_t {};

/// A face that is so many steps from a sharp edge, or more, is far from it: the edge has no say in its pairs.
inline constexpr std::uint8_t far_from_sharp_edge = 3;

/// The boundary of the bodies at rest, as views of a host's own arrays: all that contact knows of a solid.
/// Faces are flat and convex; each translates with its displacement. n is the number of faces.
template <int Dim>
struct SurfaceView {
    std::span<const Vector<Dim>> vertices;        ///< [m]
    std::span<const std::int32_t> face_offsets;   ///< (n + 1), into face_vertices
    std::span<const std::int32_t> face_vertices;  ///< counter-clockwise seen from outside (3D); two, in any order (2D)
    std::span<const Vector<Dim>> centroid;        ///< x_f (n) [m]
    std::span<const Vector<Dim>> normal;          ///< n_f (n), unit, out of the body
    std::span<const double> area;                 ///< |f| (n) [m^(Dim-1)]
    /// d_f = (x_f - x_c) . n_f (n) [m]: how deep a contact may be admitted; 0 for a rigid face
    std::span<const double> cell_depth;
    /// k_f (n) [Pa/m], normal stiffness of the boundary half-cell, (lambda + 2 mu) |f|/|c| less what other free faces of the
    /// cell take off where they answer to a correction; infinity: a rigid face
    std::span<const double> stiffness;
    std::span<const std::int32_t> body;  ///< (n) faces of one body do not touch each other unless self-contact is asked for
    /// (n), or empty: steps from face to face to a sharp convex edge of the body, at most `far_from_sharp_edge` (the
    /// function of this name gives them). Two faces meet along the normal of that which is farther from an edge, or the mean
    /// of both
    std::span<const std::uint8_t> steps_to_sharp_edge = {};

    /// (n) [Pa/m], needed with friction alone, else empty: shear stiffness of the boundary half-cell, mu |f|/|c|;
    /// infinity: a rigid face
    std::span<const double> shear_stiffness = {};

    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(area.size()); }
    [[nodiscard]] std::span<const std::int32_t> vertices_of(std::int32_t face) const {
        return face_vertices.subspan(static_cast<std::size_t>(face_offsets[face]),
                                     static_cast<std::size_t>(face_offsets[face + 1] - face_offsets[face]));
    }
    [[nodiscard]] bool is_rigid(std::int32_t face) const {
        return stiffness[face] == std::numeric_limits<double>::infinity();
    }
    [[nodiscard]] std::uint8_t steps_to_edge(std::int32_t face) const {
        return steps_to_sharp_edge.empty() ? far_from_sharp_edge : steps_to_sharp_edge[face];
    }
};

/// A surface that owns its arrays.
template <int Dim>
struct Surface {
    std::vector<Vector<Dim>> vertices;
    std::vector<std::int32_t> face_offsets{0};
    std::vector<std::int32_t> face_vertices;
    std::vector<Vector<Dim>> centroid;
    std::vector<Vector<Dim>> normal;
    std::vector<double> area;
    std::vector<double> cell_depth;
    std::vector<double> stiffness;
    std::vector<std::int32_t> body;
    std::vector<std::uint8_t> steps_to_sharp_edge;  ///< empty until it is set; faces appended later are far
    std::vector<double> shear_stiffness;            ///< empty until it is set; faces appended later are rigid

    [[nodiscard]] SurfaceView<Dim> view() const;
    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(area.size()); }
    /// Appends one face from its corners: counter-clockwise seen from outside (3D), or with the outside on the right of
    /// the line from the first to the second (2D). Measures follow from the corners. Throws BadInput for
    /// other than 2 corners in 2D, 3 to geometry::max_polygon_vertices in 3D.
    void append(std::span<const Vector<Dim>> corners, double face_cell_depth, double face_stiffness, std::int32_t face_body);
};

/// The part of `check` that reads no face: throws BadInput naming an array whose size disagrees with the
/// others, and for offsets that do not rise to the size of `face_vertices`.
template <int Dim>
void check_sizes(const SurfaceView<Dim>& surface);

/// Throws BadInput naming the face, the value, the limit and the remedy: array sizes that disagree, an index
/// out of range, a number of corners that is not 2 (2D) or 3 to geometry::max_polygon_vertices (3D), NaN, zero area, a
/// normal that is not unit, a face that is not flat (within `planarity_tolerance` of its size) or not convex, area,
/// centroid or normal that are not those of the corners (within 1e-10 of the face, and what rounding adds far from the
/// origin), a cell depth that is not > 0
/// (rigid: >= 0), a stiffness that is not > 0, more steps to a sharp edge than are counted.
template <int Dim>
void check(const SurfaceView<Dim>& surface, double planarity_tolerance = geometry::planarity_tolerance);

/// A 64-bit checksum of corners, cell depths, stiffnesses, bodies and steps to sharp edges, to the last bit: tells whether a
/// saved state fits. Two different surfaces share one by accident only.
template <int Dim>
[[nodiscard]] std::uint64_t fingerprint(const SurfaceView<Dim>& surface);

}  // namespace abut::contact
