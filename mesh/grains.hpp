#pragma once
#include <cstdint>
#include <vector>

#include "abut/base/option.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// How a body is divided into grains, the pieces that it may break into.
struct GrainOptions {
    double size = 0.0;       ///< edge of a square or cube as large as a grain should be [m], > 0
    std::uint32_t seed = 0;  ///< another one gives other grains of the same size
};

inline constexpr Limits grain_size{.unit = "m", .above = 0.0};  ///< of GrainOptions::size

/// Fewest cells of a grain: smaller ones join a neighbour, and so do those whose centroids lie in one plane. It is twice the
/// Dim + 1 cells, itself included, that the gradient of a cell needs.
template <int Dim>
inline constexpr std::int32_t least_cells_of_grain = 2 * (Dim + 1);

/// Grain of each cell of a mesh, 0 to n - 1 in the order of their first cells (n_cells). A grain is connected through faces
/// and lies within one body. Its shape is that of cells nearest to a centre, along paths through cells; a
/// cell moves to the grain that it borders on most. The grains depend on the mesh, `size` and
/// `seed` alone. Throws BadInput for a size that is not positive, or that leaves each body whole.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> grains_of(const Mesh<Dim>& mesh, const GrainOptions& options);

}  // namespace abut::mesh
