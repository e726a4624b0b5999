#pragma once
// Private to the sources of this layer.
#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/solid/cells/sweep_lists.hpp"

namespace abut::solid {

/// Cells of one chunk that a sweep computes.
struct CellsOfChunk {
    std::span<const Run> cells;
    std::span<const CondensedCell> condensed;  // among them
};

/// Cells of one kind, as the sweeps visit them. All cells of a chunk are of one pool. Functions may be called at once from
/// several threads for different chunks, or for different cells.
template <class Pool>
concept CellPool = requires(Pool& pool, const Pool& fixed, const CellsOfChunk& chunk, std::span<const Run> runs,
                            std::span<const BoundaryFace> rows, void (*load_cell)(std::ptrdiff_t), std::int32_t c) {
    // The sweeps, one after the other. `load_cell(c)` sets u_c, unless the pool looks at another state.
    pool.load(runs, load_cell);
    // u_f of interior faces and of boundary faces with a row of R.
    pool.reconstruct(runs, rows);
    // G_c and the traces of cells, or of simplices their stress and d_c.
    pool.set_gradients(chunk);
    // S_c and the sum of k [u]; of simplices the latter alone. LinearMaterials adds to them, not to those of finite bodies.
    pool.set_stresses(chunk);
    // y_f of interior faces.
    pool.set_face_gradients(runs);
    // One cell, of a part of the mesh: `set_gradients`, `set_stresses`.
    pool.set_gradient(c);
    pool.set_stress(c);
    // Results. An upper bound on the strain of the cells [begin, end).
    { fixed.largest_strain(c, c) } -> std::same_as<double>;
    // Twice the elastic energy of a cell over its measure, without jumps [J/m^3].
    { fixed.twice_energy_density(c) } -> std::same_as<double>;
};

/// Cells that remember from one step to the next. Memory is written and read cell by cell, in numbers of any meaning. A step
/// that has not ended leaves no trace in it.
template <class Cells>
concept RememberingCells = requires(Cells& cells, const Cells& fixed, std::ptrdiff_t c, std::vector<double>& values,
                                    std::span<const double> given) {
    // How many numbers a cell remembers; 0 where it is of another kind.
    { fixed.memory_size(c) } -> std::same_as<std::int32_t>;
    // Writes them behind `values`.
    fixed.put_memory(c, values);
    // Takes what `put_memory` wrote, of this cell or of one that it `remembers_as`.
    cells.set_memory(c, given);
    // Whether a cell remembers the same things as one of another mesh.
    { fixed.remembers_as(c, fixed, c) } -> std::same_as<bool>;
    // The next step begins where this one ends.
    cells.end_step();
};

}  // namespace abut::solid
