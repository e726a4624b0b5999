#pragma once
// Private to the layer; not installed.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// values[old_index[0]], values[old_index[1]], ...
template <class Value>
[[nodiscard]] std::vector<Value> permuted(const std::vector<Value>& values, std::span<const std::int32_t> old_index) {
    std::vector<Value> result;
    result.reserve(old_index.size());
    for (const std::int32_t i : old_index) result.push_back(values[static_cast<std::size_t>(i)]);
    return result;
}

/// Old index of each cell in the new order: bodies one after another, and inside a body row by row and layer by layer across
/// its longest extent if `by_layers`, else as given. Operators that sweep over the cells several times profit most from
/// layers: what one sweep has written is needed by the next at most a layer later (docs/performance.md).
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> cell_order(const CellSoup<Dim>& soup, std::span<const Vector<Dim>> centroids,
                                                   bool by_layers);

/// The soup with its cells in the order `old_cell`. Vertices come in the order of their first use if `renumber_vertices`,
/// else as given; those without a cell are dropped.
template <int Dim>
[[nodiscard]] CellSoup<Dim> renumbered(const CellSoup<Dim>& soup, std::span<const std::int32_t> old_cell,
                                       bool renumber_vertices);

}  // namespace abut::mesh
