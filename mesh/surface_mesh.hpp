#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/geometry/health/face_soup.hpp"
#include "abut/geometry/health/surface_health.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Faces in space without cells behind them, of one or several bodies: what a surface file holds, however bad. Whether it
/// can be used, geometry::check_surface(mesh.soup()) says; `clean` leaves what can be.
struct SurfaceMesh {
    std::string name;                      ///< what error messages call it (a file name, for example)
    std::vector<Vector<3>> vertices;       ///< [m]
    Rows faces;                            ///< corners counter-clockwise seen from outside
    std::vector<std::int64_t> face_label;  ///< (n) number of a face in its file, for messages; empty: its index
    std::vector<std::int32_t> face_body;   ///< (n) index into body_names
    std::vector<std::string> body_names;
    std::vector<Vector<3>> displacement;  ///< (n_vertices) [m], or empty: at rest
    std::int32_t n_ignored_elements = 0;  ///< of the file: points, lines and whatever else is no face
    std::vector<std::string> warnings;    ///< what the reader of the file warned of

    [[nodiscard]] geometry::FaceSoup soup() const { return {vertices, faces.offsets, faces.values}; }
    /// Label of a face in messages.
    [[nodiscard]] std::int64_t label(std::int32_t face) const {
        return face_label.empty() ? face : face_label[static_cast<std::size_t>(face)];
    }
};

/// Makes the first of the vertices at exactly one place stand for all of them, if they have the same displacement, and
/// drops the others; returns how many. Vertices with NaN stay. The order of the vertices that stay is kept.
std::int32_t weld(SurfaceMesh& mesh);

/// Makes every part that hangs together through vertices at exactly one place a body of its own: "body_1", "body_2", ... in
/// the order of their first faces. Faces all of whose vertices are out of range hang together, too.
void name_connected_bodies(SurfaceMesh& mesh);

/// All faces of several surfaces; vertices stay apart. Bodies get "<name>." in front where two would clash otherwise, and a
/// number behind where that does not help. Displacements are zero where a surface has none and another has. Face labels are
/// dropped.
[[nodiscard]] SurfaceMesh combine(std::span<const SurfaceMesh> meshes);

/// The boundary faces of a mesh with their vertices, bodies and the labels of their cells. `displacement` is that of the
/// vertices of the mesh (n_vertices), or empty.
[[nodiscard]] SurfaceMesh boundary_of(const Mesh<3>& mesh, std::span<const Vector<3>> displacement = {});

/// Treatment of faces that cannot be used (geometry::FaceFault).
enum class UnusableFaces : std::uint8_t {
    fail,  ///< throw MeshError
    skip,  ///< leave them out
};

struct CleanSurface {
    SurfaceMesh mesh;                      ///< with the vertices of the input, and its labels
    std::vector<std::int32_t> input_face;  ///< (n faces of `mesh`) the face of the input that each comes from, increasing
    std::int32_t n_skipped_faces = 0;
    std::int32_t n_cut_faces = 0;    ///< polygons that were not flat, cut into triangles
    std::int32_t n_flat_pieces = 0;  ///< of those triangles: such without area, left out
};

/// The faces that can be used: flat and convex polygons of 3 to geometry::max_polygon_vertices corners at different places.
/// `health` is check_surface(mesh.soup()). A polygon that is not flat is cut into triangles (geometry/triangulate.hpp); a
/// corner that repeats the one before it is left out. Flipped duplicates, holes, slivers and all else stay as they are.
/// Throws MeshError under `fail`, naming the first faces, their faults, how many there are and the remedy; under both if
/// nothing is left; BadInput if `health` is that of another surface.
[[nodiscard]] CleanSurface clean(const SurfaceMesh& mesh, const geometry::SurfaceReport& health, UnusableFaces policy);

/// Whether each part of a surface is a cavity: it looks the other way than another part, in whose box it lies (n_parts).
/// `health` is check_surface(mesh.soup()).
[[nodiscard]] std::vector<bool> cavities_of(const SurfaceMesh& mesh, const geometry::SurfaceReport& health);

}  // namespace abut::mesh
