#pragma once
#include <array>
#include <optional>
#include <string>

#include "abut/mesh/mesh.hpp"

/// Meshes of simple parts. The unstructured ones come from Gmsh; calls from several threads wait for one another, and the
/// program must not have Gmsh open itself (gmsh::initialize) during a call, which would end that session. The same options
/// give the same bits up to about 400,000 tetrahedra per part. Larger parts are meshed by Gmsh's HXT, which is fast but
/// gives another mesh of the same size every time: save such a mesh where results must be repeatable. All throw MeshError
/// when a length or count is not positive, a coordinate not finite, or when Gmsh fails; and, before anything is made,
/// when the number of cells by its estimate is beyond MeshOptions::most_cells. Unless that is set, what Gmsh meshes may
/// have `most_meshed_cells`, which take minutes, and what is made without it `most_structured_cells`.
///
/// `variant` makes equal parts differ in their meshes, so that two of them in contact do not match node by node by accident:
/// disc, cylinder and sphere are turned by `variant` golden angles (about z; the sphere about a skew axis); the wanted edge
/// length of the unstructured box rises and falls by a tenth along its edges, in waves that are shifted by `variant` golden
/// angles (0: no waves). The number of cells stays the same to a few percent, and the refined place does not move.
namespace abut::mesh {

inline constexpr double most_meshed_cells = 1e7;
inline constexpr double most_structured_cells = 5e7;

/// Smaller cells near a point: `size` [m], no more than the part's own size, up to `uniform` [m] from it, then growing
/// linearly to the part's own size over `distance` [m].
template <int Dim>
struct Refinement {
    Vector<Dim> point;     ///< [m]
    double size;           ///< [m]
    double distance;       ///< [m]
    double uniform = 0.0;  ///< [m]
};

struct DiscOptions {
    Vector<2> centre = Vector<2>::Zero();  ///< [m]
    double radius = 1.0;                   ///< [m]
    double size = 0.1;                     ///< wanted edge length of cells [m]
    std::optional<Refinement<2>> refinement = {};
    int variant = 0;
    std::string name = "disc";  ///< of mesh and body
};
/// Triangles. Group "boundary".
[[nodiscard]] Mesh<2> disc(const DiscOptions& options, const MeshOptions& mesh_options = {});

struct CylinderOptions {
    Vector<3> centre = Vector<3>::Zero();  ///< middle of the axis, which is parallel to z [m]
    double radius = 1.0;                   ///< [m]
    double length = 1.0;                   ///< [m]
    double size = 0.1;                     ///< wanted edge length of cells [m]
    std::optional<Refinement<3>> refinement = {};
    int variant = 0;
    std::string name = "cylinder";
};
/// Tetrahedra. Groups "side", "bottom" (low z), "top".
[[nodiscard]] Mesh<3> cylinder(const CylinderOptions& options, const MeshOptions& mesh_options = {});

struct SphereOptions {
    Vector<3> centre = Vector<3>::Zero();  ///< [m]
    double radius = 1.0;                   ///< [m]
    double size = 0.1;                     ///< wanted edge length of cells [m]
    std::optional<Refinement<3>> refinement = {};
    int variant = 0;
    std::string name = "sphere";
};
/// Tetrahedra. Group "boundary".
[[nodiscard]] Mesh<3> sphere(const SphereOptions& options, const MeshOptions& mesh_options = {});

template <int Dim>
struct BoxOptions {
    Vector<Dim> lower = Vector<Dim>::Zero();  ///< [m]
    Vector<Dim> upper = Vector<Dim>::Ones();  ///< [m]
    double size = 0.1;                        ///< wanted edge length of cells [m]
    std::optional<Refinement<Dim>> refinement = {};
    int variant = 0;
    std::string name = "box";
};
/// Unstructured triangles (2D) or tetrahedra (3D). Groups "xmin", "xmax", "ymin", ...
template <int Dim>
[[nodiscard]] Mesh<Dim> box(const BoxOptions<Dim>& options, const MeshOptions& mesh_options = {});

/// A box cut into counts[0] x counts[1] (x counts[2]) equal bricks, and each brick into cells of one shape: 2 triangles or
/// 1 quadrangle; 6 tetrahedra, 1 hexahedron, 2 prisms (along z), or 6 pyramids around its centre. Groups "xmin", "xmax", ...
/// Made without Gmsh. Boxes of equal counts match: give the two of a pair different counts.
template <int Dim>
[[nodiscard]] Mesh<Dim> structured_box(const Vector<Dim>& lower, const Vector<Dim>& upper,
                                       const std::array<int, Dim>& counts, CellShape shape, const std::string& name = "box",
                                       const MeshOptions& mesh_options = {});

/// A regular polygon of n_sectors >= 3 corners on the circle, cut into equal triangles around its centre: every cell is on
/// the boundary and shares a face with the next one. The first corner is at angle `turn` [rad] from x. Group "boundary".
[[nodiscard]] Mesh<2> fan_disc(const Vector<2>& centre, double radius, int n_sectors, double turn = 0.0,
                               const std::string& name = "disc", const MeshOptions& mesh_options = {});

}  // namespace abut::mesh
