#pragma once
#include <filesystem>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Reads a Gmsh file, format 2.0 to 2.2 or 4.1, text or binary of either order of bytes. Coordinates are metres; in 2D they
/// must lie in a plane z = constant. Gmsh takes no part.
///
/// A body is a physical group of dimension Dim, called by its physical name ("physical_<tag>" without one). Cells outside
/// any physical group make one body for each connected component, "body_1", "body_2", ... Two bodies share no vertex.
/// Boundary groups are the physical groups of dimension Dim - 1. Error messages call cells and vertices by their tags in
/// the file. Elements that are neither cells nor in a boundary group are counted in BuildReport::n_ignored_elements.
/// Elements of order 2 come in by their corners; that, nodes that stand twice and lines outside of any section are in
/// BuildReport::warnings. Sections of other kinds ($Periodic, $NodeData, ...) are skipped. Memory is taken for what the file
/// holds, not for what it promises.
///
/// Throws MeshError naming the path, the line (of text) or the byte (of a binary file), what is wrong and what to do: no
/// file, empty, not a Gmsh file, other version, truncated, words that are no numbers, other numbers of nodes or elements
/// than its heads promise, a node that is not there, no cells of dimension Dim, a physical group without cells, cells of
/// dimension 3 in a mesh of dimension 2, elements of order 3 and above, a cell in two bodies; and everything that
/// `build_mesh` finds.
template <int Dim>
[[nodiscard]] Mesh<Dim> read_gmsh(const std::filesystem::path& path, const MeshOptions& options = {});

}  // namespace abut::mesh
