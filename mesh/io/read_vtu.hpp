#pragma once
#include <filesystem>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Reads a VTK XML unstructured grid (.vtu). Coordinates are metres; in 2D they must lie in a plane z = constant.
///
/// A body is a value of the cell array "body" (whole numbers), in increasing order, called "ball" where the file has
/// that value as its number "body: ball", else "body_<value>"; without that array, a connected component. A boundary
/// group "top" is what the cell array "group: top" is not 0 on: cells of one dimension less (write_vtu). Without arrays
/// of these names, numbers of sets of other programs count ("gmsh:physical", "cell_tags", "medit:ref", "nastran:ref",
/// "avsucd:material", "su2:tag", "CellEntityIds", the first that is there): cells of number 7 are the body "set_7",
/// faces of number 7 the group "set_7", and 0 is no set. VTK's pixels and voxels come in as quadrangles and hexahedra,
/// quadratic cells by their corners (with a warning). Wedges are accepted in the order that VTK documents and in
/// Gmsh's, as files use both. Cells of lower dimension in no group are counted in BuildReport::n_ignored_elements.
/// Labels are VTK's cell and point numbers.
///
/// Reads ascii, binary and appended arrays of all types of numbers, in either order of bytes, compressed by zlib or
/// not. Memory is taken for what a file holds, not for what it promises.
///
/// Throws MeshError naming the path, what is wrong and what to do: no file, empty, not a .vtu file, truncated, damaged,
/// compressed by LZ4 or LZMA, a cell type that is none of ours, cells of dimension 3 in a mesh of dimension 2, fractional
/// bodies; and everything that `build_mesh` finds.
template <int Dim>
[[nodiscard]] Mesh<Dim> read_vtu(const std::filesystem::path& path, const MeshOptions& options = {});

}  // namespace abut::mesh
