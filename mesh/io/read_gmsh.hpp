#pragma once
#include <filesystem>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Reads a Gmsh file, format 2.0 to 2.2 or 4.1, text or binary, with elements of order 1. Coordinates are metres; in 2D they must
/// lie in a plane z = constant.
///
/// A body is a physical group of dimension Dim, called by its physical name ("physical_<tag>" without one). Cells outside
/// any physical group make one body for each connected component, "body_1", "body_2", ... Two bodies share no vertex.
/// Boundary groups are the physical groups of dimension Dim - 1. Error messages call cells and vertices by their tags in
/// the file. Elements that are neither cells nor in a boundary group are counted in BuildReport::n_ignored_elements; what
/// Gmsh warns of is in BuildReport::warnings.
///
/// Gmsh has one state per process: the program must not have it open itself (gmsh::initialize) during the call, which would
/// end that session. Calls from several threads wait for one another.
///
/// It is Gmsh's library that reads, in this process: where Gmsh itself crashes over a file, the program ends, and there is no
/// error to catch. Files of which that is known are refused before Gmsh sees them: binary ones in the other order of bytes
/// or with sections that are not whole, and all whose heads promise more nodes or elements than the file can hold. A program
/// that must outlive any file reads it in a process of its own.
///
/// Throws MeshError naming the path, what is wrong and what to do: no file, empty, not a Gmsh file, other version,
/// truncated, fewer elements than its header promises, Gmsh's own errors, no cells of dimension Dim, a physical group
/// without cells, cells of dimension 3 in a mesh of dimension 2, curved elements, a cell in two bodies; and everything
/// that `build_mesh` finds.
template <int Dim>
[[nodiscard]] Mesh<Dim> read_gmsh(const std::filesystem::path& path, const MeshOptions& options = {});

}  // namespace abut::mesh
