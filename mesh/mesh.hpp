#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/geometry/planarity.hpp"

namespace abut::mesh {

/// Shape of a cell; the order of its vertices is Gmsh's. VTK's is the same except for prisms, of which VTK documents the two
/// triangles in the opposite order.
enum class CellShape : std::uint8_t { triangle, quadrangle, tetrahedron, hexahedron, prism, pyramid };

/// Compressed rows: row i is values[offsets[i] .. offsets[i+1]).
struct Rows {
    std::vector<std::int32_t> offsets{0};
    std::vector<std::int32_t> values;

    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
    [[nodiscard]] std::span<const std::int32_t> operator[](std::int32_t row) const {
        return {values.data() + offsets[row], static_cast<std::size_t>(offsets[row + 1] - offsets[row])};
    }
    /// Throws std::length_error rather than count beyond 32 bits.
    void append(std::span<const std::int32_t> row) {
        if (row.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) - values.size())
            throw std::length_error("Rows: " + std::to_string(values.size()) + " values and " + std::to_string(row.size()) +
                                    " more, at most 2147483647 are allowed. Coarsen the mesh.");
        values.insert(values.end(), row.begin(), row.end());
        offsets.push_back(static_cast<std::int32_t>(values.size()));
    }
};

/// A named set of boundary faces (a Gmsh physical name of dimension Dim - 1, prefixed by nothing).
struct BoundaryGroup {
    std::string name;
    std::vector<std::int32_t> faces;  ///< face indices, increasing
};

/// Changes that `build_mesh` made to its input besides numbering it. Nothing happens to a mesh that is not counted here.
struct BuildReport {
    std::int32_t n_unused_vertices = 0;   ///< vertices of the input that no cell uses, dropped
    std::int32_t n_ignored_elements = 0;  ///< elements of a file that are neither cells nor named boundary faces
    std::vector<std::string> warnings;    ///< what the reader of the file warned of
    /// Boundary vertices at the place of a vertex of another body, up to 1e-6 of the smallest boundary face. More than a
    /// few are bodies whose meshes match node by node: legal, but such contact is a special case, and often an accident
    /// (see `variant` in mesh/shapes/shapes.hpp).
    std::int32_t n_coincident_vertices = 0;
    std::int32_t n_non_planar_faces = 0;  ///< faces beyond MeshOptions::planarity_tolerance (NonPlanarFaces::split only)
    std::int32_t n_cut_cells = 0;         ///< cells of the input that were cut into tetrahedra because of them
    std::int32_t n_turned_cells = 0;      ///< cells given inside out, whose vertices were put in the order of their shape
    /// Bodies with a face in common in the input, which is one of each here (SharedVertices::separate): pairs,
    /// increasing. They touch, and are not glued unless somebody bonds them
    std::vector<std::array<std::int32_t, 2>> joined_bodies;
    double worst_planarity = 0.0;  ///< largest distance of a vertex from its face's plane / face size, before cutting [-]
    std::int64_t worst_face_cell = -1;  ///< number in its input of a cell with that face; -1 if every face has Dim vertices
};

/// Conforming mesh of one or several bodies that share no vertex, cell or face: polygons in 2D, polyhedra in 3D, with both
/// sides of every face and all measures. Built by `build_mesh`; immutable by convention afterwards.
///
/// Faces are numbered by their first cell (then by their position in it), so that a sweep over faces is a sweep over cells.
/// `face_cells[f][0]` is the lower-numbered cell; `face_cells[f][1]` is -1 on the boundary. The normal of a face points out
/// of `face_cells[f][0]`, and its vertices run counter-clockwise seen against the normal (3D).
template <int Dim>
struct Mesh {
    std::string name;                   ///< what error messages call it (a file name, for example)
    std::vector<Vector<Dim>> vertices;  ///< [m]

    std::vector<CellShape> cell_shape;
    Rows cell_vertices;
    Rows cell_faces;
    std::vector<std::int32_t> cell_body;     ///< body of a cell, 0 .. n_bodies-1, increasing with the cell
    std::vector<double> cell_measure;        ///< |c| [m^Dim]
    std::vector<Vector<Dim>> cell_centroid;  ///< x_c [m]

    Rows face_vertices;
    std::vector<std::array<std::int32_t, 2>> face_cells;
    std::vector<double> face_measure;        ///< |f| [m^(Dim-1)]
    std::vector<Vector<Dim>> face_centroid;  ///< x_f [m]
    std::vector<Vector<Dim>> face_normal;    ///< n_f, unit, out of face_cells[f][0]

    std::vector<std::int32_t> boundary_faces;  ///< faces with one cell, increasing
    std::vector<std::string> body_names;
    std::vector<BoundaryGroup> groups;

    std::vector<std::int64_t> cell_label;    ///< number of a cell in the input; what error messages call it
    std::vector<std::int64_t> vertex_label;  ///< the same for a vertex
    BuildReport report;
    bool has_lost_cells = false;  ///< cells have been taken out (`without_cells`): what they joined hangs together no more

    [[nodiscard]] std::int32_t n_cells() const { return static_cast<std::int32_t>(cell_measure.size()); }
    [[nodiscard]] std::int32_t n_faces() const { return static_cast<std::int32_t>(face_measure.size()); }
    [[nodiscard]] std::int32_t n_bodies() const { return static_cast<std::int32_t>(body_names.size()); }
    [[nodiscard]] bool is_boundary(std::int32_t face) const { return face_cells[face][1] < 0; }
    /// The group of that name; throws BadInput listing the names that exist.
    [[nodiscard]] const BoundaryGroup& group(const std::string& group_name) const;
};

/// Input of `build_mesh`: the data that every mesh file holds.
template <int Dim>
struct CellSoup {
    std::string name;
    std::vector<Vector<Dim>> vertices;
    std::vector<CellShape> cell_shape;
    Rows cell_vertices;  ///< in Gmsh's order (see CellShape); a cell inside out is turned, and counted
    std::vector<std::int32_t> cell_body;
    std::vector<std::string> body_names;
    struct NamedFace {
        std::vector<std::int32_t> vertices;  ///< any order
        std::int32_t group;                  ///< index into group_names
    };
    std::vector<NamedFace> named_faces;
    std::vector<std::string> group_names;

    std::vector<std::int64_t> cell_label;    ///< number of a cell in its file, for messages; empty: its index
    std::vector<std::int64_t> vertex_label;  ///< the same for a vertex
    std::int32_t n_ignored_elements = 0;     ///< goes into the report
    std::vector<std::string> warnings;       ///< goes into the report
};

/// Treatment of a face of four vertices that do not lie in a plane (hexahedra, prisms, pyramids).
enum class NonPlanarFaces : std::uint8_t {
    fail,   ///< throw MeshError
    split,  ///< cut its cells, and every cell they share a quadrangle with, into tetrahedra (see mesh/split.hpp)
};

/// Treatment of vertices that cells of several bodies share.
enum class SharedVertices : std::uint8_t {
    fail,      ///< throw MeshError
    separate,  ///< each body gets its own; BuildReport::joined_bodies says which had faces in common
};

struct MeshOptions {
    bool reorder = true;  ///< renumber cells (within each body) and vertices row by row and layer by layer
    /// Largest distance of a face's vertex from its plane, in units of the face size
    double planarity_tolerance = geometry::planarity_tolerance;
    NonPlanarFaces non_planar = NonPlanarFaces::fail;
    SharedVertices shared_vertices = SharedVertices::fail;
    std::optional<double> most_cells{};  ///< that a shape may get by its estimate; unset: see mesh/shapes/shapes.hpp
};

/// Finds the faces, computes all measures, checks, renumbers. Throws MeshError (mesh/quality.hpp) naming mesh, cell or
/// face, value, limit and remedy: index out of range, NaN coordinate, zero measure, degenerate
/// face, face of more than two cells, non-planar face, non-convex face, empty mesh, body without cells, two bodies or two
/// groups of one name, named face that is no boundary face.
/// Vertices used by no cell are dropped and cells inside out (of negative measure) are turned: both are counted in the
/// report.
template <int Dim>
[[nodiscard]] Mesh<Dim> build_mesh(CellSoup<Dim> soup, const MeshOptions& options = {});

/// One mesh of several bodies out of meshes of one or more bodies each. Body and group names get "<name>." in front where
/// two would clash otherwise. Nothing is merged: vertices of different bodies at one place stay two, and are counted in
/// BuildReport::n_coincident_vertices.
template <int Dim>
[[nodiscard]] Mesh<Dim> combine(std::span<const Mesh<Dim>> meshes);

}  // namespace abut::mesh
