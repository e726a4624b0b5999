#pragma once
#include <filesystem>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Reads a VTK XML unstructured grid (.vtu). Coordinates are metres; in 2D they must lie in a plane z = constant.
///
/// A body is a value of the cell array "body" (whole numbers), called "body_<value>", in increasing order; without that
/// array, a connected component. Boundary groups do not exist in this format. VTK's pixels and voxels come in as
/// quadrangles and hexahedra, quadratic cells by their corners (with a warning). Wedges are accepted in the order that VTK documents and in Gmsh's, as files use both. Cells
/// of lower dimension are counted in BuildReport::n_ignored_elements. Labels are VTK's cell and point numbers.
///
/// What the attributes promise is weighed against the size of the file before VTK makes room for it: a value takes 2 bytes as
/// text, those of its type in binary, and compression may shrink that by 1,032 (zlib), 255 (LZ4) or 8,192 (LZMA).
///
/// Throws MeshError naming the path, what is wrong and what to do: no file, empty, not a .vtu file, truncated, VTK's own
/// errors, a cell type that is none of ours, cells of dimension 3 in a mesh of dimension 2, fractional bodies; and
/// everything that `build_mesh` finds.
template <int Dim>
[[nodiscard]] Mesh<Dim> read_vtu(const std::filesystem::path& path, const MeshOptions& options = {});

}  // namespace abut::mesh
