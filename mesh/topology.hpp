#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// The faces between cells: which vertices each has, which one or two cells it bounds.
struct Faces {
    Rows cell_faces;     ///< row = cell, in the order of `face_vertices(shape, i)` (mesh/cell_shape.hpp)
    Rows face_vertices;  ///< as the lower-numbered cell sees it from outside, starting with that cell's first local vertex
    std::vector<std::array<std::int32_t, 2>> face_cells;  ///< lower cell, higher cell or -1
};

/// Two cells share a face when it has the same vertices in both. Numbering as documented at Mesh. Sorts keys inside buckets
/// of equal smallest vertex: time and memory are linear in the number of cells.
/// Throws MeshError naming the cells when more than two share a face, or two lie on the same side of it (a cell given
/// twice).
template <int Dim>
[[nodiscard]] Faces find_faces(const CellSoup<Dim>& soup);

/// The boundary face (a face of one cell) with exactly these vertices, in any order; -1 if there is none. Answers many
/// questions about one mesh: setting up costs a sweep over the boundary.
class BoundaryFaceFinder {
public:
    BoundaryFaceFinder(const Rows& face_vertices, const std::vector<std::array<std::int32_t, 2>>& face_cells);
    [[nodiscard]] std::int32_t find(std::span<const std::int32_t> vertices) const;

private:
    using Key = std::array<std::int32_t, 4>;
    static Key key(std::span<const std::int32_t> vertices);
    std::vector<std::pair<Key, std::int32_t>> sorted_;
};

}  // namespace abut::mesh
