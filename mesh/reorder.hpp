#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/geometry/vector.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Old index of each cell in the new order: bodies one after another, and inside a body along a Hilbert curve through the
/// centroids if `along_curve`, else as given.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> cell_order(const CellSoup<Dim>& soup, std::span<const Vector<Dim>> centroids, bool along_curve);

/// The soup with its cells in the order `old_cell`. Vertices come in the order of their first use if `renumber_vertices`,
/// else as given; those without a cell are dropped.
template <int Dim>
[[nodiscard]] CellSoup<Dim> renumbered(const CellSoup<Dim>& soup, std::span<const std::int32_t> old_cell, bool renumber_vertices);

}  // namespace abut::mesh
