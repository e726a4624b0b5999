#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/geometry/box.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/geometry/health/face_faults.hpp"
#include "abut/geometry/health/face_soup.hpp"
#include "abut/geometry/planarity.hpp"

namespace abut::geometry {

struct HealthOptions {
    double sliver_aspect = 100.0;            ///< faces beyond this aspect ratio are listed as slivers [-]
    bool self_intersections = false;         ///< look for them: the only part that costs more than sorting
    std::int32_t max_listed_pairs = 100000;  ///< of faces that intersect; their count is complete
    double planarity_tolerance = geometry::planarity_tolerance;  ///< of polygons that count as flat [-], >= 0
};

/// An edge by its ends (SurfaceReport::merged_vertices), first < second.
struct SurfaceEdge {
    std::int32_t first, second;
    std::int32_t face;     ///< the first face along it
    std::int32_t n_faces;  ///< along it
};

/// A face and an earlier one of the same corners that runs around the other way.
struct FlippedFace {
    std::int32_t face, earlier;
};

/// Usable faces that hang together through edges.
struct SurfaceComponent {
    std::int32_t first_face = -1;
    std::int32_t n_faces = 0;
    bool closed = true;       ///< every edge has an even number of faces
    bool oriented = true;     ///< along every edge that is no boundary as many faces run one way as the other
    double volume = 0.0;      ///< enclosed [m^3], < 0 if inside out; 0 unless closed and oriented
    bool inside_out = false;  ///< volume < 0: turned round, or the wall of a cavity
};

/// Report on a surface before it is used. Vectors list faults, counts are complete. "Usable" faces are those
/// without a fault; except for the first block, all figures are theirs. Vertices at exactly one position are one, except for
/// `n_unwelded_vertices`.
struct SurfaceReport {
    std::int32_t n_faces = 0, n_vertices = 0;

    std::vector<FaceFault> faults;                       ///< (n_faces)
    std::array<std::int32_t, n_face_faults> n_faults{};  ///< by FaceFault; of `none` the usable faces
    std::vector<std::int32_t> unusable_faces;            ///< increasing
    std::vector<std::int32_t> unreferenced_vertices;     ///< that no face names, usable or not; increasing
    std::vector<std::int32_t> merged_vertices;           ///< (n_vertices) merged_vertices(vertices)
    std::int32_t n_unwelded_vertices = 0;                ///< at the position of an earlier vertex
    std::int32_t n_bad_vertices = 0;                     ///< with a coordinate that is NaN or infinite

    Box<3> box;                  ///< of the usable faces; empty without any
    double area = 0.0;           ///< [m^2]
    double shortest_edge = 0.0;  ///< [m], 0 without a usable face
    double longest_edge = 0.0;   ///< [m]

    std::vector<FlippedFace> flipped_duplicates;      ///< usable; in the order of the faces
    std::vector<std::int32_t> repeated_corner_faces;  ///< usable, but name a vertex twice in a row; increasing
    std::vector<std::int32_t> non_planar_faces;       ///< beyond the tolerance: to be cut into triangles; increasing
    double worst_planarity = 0.0;                     ///< distance of a corner from the plane of its face / sqrt(area)
    std::int32_t worst_planarity_face = -1;

    double worst_aspect = 0.0;  ///< longest edge / smallest height: 1.15 for an equilateral triangle [-]
    std::int32_t worst_aspect_face = -1;
    std::vector<std::int32_t> slivers;              ///< beyond HealthOptions::sliver_aspect; increasing
    std::array<std::int32_t, 17> aspect_decades{};  ///< entry k: from 10^k on, below 10^(k+1); the last: and all beyond

    std::int32_t n_edges = 0;
    std::vector<SurfaceEdge> boundary_edges;      ///< of one face
    std::int32_t n_holes = 0;                     ///< rims: boundary edges that hang together
    std::vector<SurfaceEdge> non_manifold_edges;  ///< of three faces or more
    std::vector<SurfaceEdge> inconsistent_edges;  ///< of two faces that run along it the same way

    std::vector<SurfaceComponent> components;  ///< in the order of their first faces
    std::vector<std::int32_t> face_component;  ///< (n_faces), -1 for an unusable face

    bool looked_for_self_intersections = false;
    std::int64_t n_self_intersections = 0;
    std::vector<IndexPair> self_intersections;  ///< the first of them, sorted (geometry/health/self_intersections.hpp)

    [[nodiscard]] std::int32_t n_usable() const { return n_faults[static_cast<std::size_t>(FaceFault::none)]; }
    /// True if every component is closed, and there is one.
    [[nodiscard]] bool closed() const;
    /// True if nothing at all is wrong: every face usable and flat, every component closed, oriented and not inside out, no
    /// flipped duplicate, no edge of more than two faces, no known self-intersection. Slivers and vertices that are not
    /// referenced or not welded do no harm.
    [[nodiscard]] bool sound() const;
};

/// Throws BadInput for bad offsets and, if self-intersections are asked for, SearchLimitError for more than
/// SearchLimits::pairs pairs of boxes; nothing for bad faces. The same bits for any number of threads.
/// n log n, and in proportion to the pairs of faces whose boxes overlap if self-intersections are asked for.
[[nodiscard]] SurfaceReport check_surface(const FaceSoup& soup, const HealthOptions& options = {});

/// `report`, made by check_surface(soup), in plain words: one line per finding, with counts and the first faces, without
/// line ends. `labels` (n_faces) names the faces; empty: their indices are used. Throws BadInput if the sizes disagree.
[[nodiscard]] std::vector<std::string> describe(const FaceSoup& soup, const SurfaceReport& report,
                                                std::span<const std::int64_t> labels = {});

/// Longest edge over smallest height (the smallest extent orthogonal to an edge) of a face with area; >= 2/sqrt(3) for a
/// triangle, >= 1 for others.
[[nodiscard]] double aspect_ratio(std::span<const Vector<3>> corners);

}  // namespace abut::geometry
