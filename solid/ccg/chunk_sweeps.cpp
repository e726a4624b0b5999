#include "abut/solid/ccg/sweeps.hpp"
#include "abut/solid/cells/simplex_elements.hpp"

// What the sweeps do with one chunk, and with one element whatever its body is.

namespace abut::solid {

// One element of any body -------------------------------------------------------------------------------------------

/// û_b - u_c of a boundary face.
template <int Dim, class Real>
Lanes<Dim, Real> CcgSweeps<Dim, Real>::any_boundary_displacement(const double* u, BoundaryFace b) const {
    const SweepElements<Vectors>& element = state_.element;
    const std::int32_t c = state_.arrays.cell_of(b);
    if (state_.arrays.simplices.condensed_face(c) != b) return element.reconstructed_row(u, b);
    const std::int32_t boundary_face = state_.arrays.face_of(b);
    const auto without = element.simplex_state(
        u, c, [&](std::int32_t f) { return f == boundary_face ? Vectors{} : element.reconstructed(u, f); });
    return element.condensed_face({c, b}, without.stress);
}

/// Traces of cells whose free faces are affine; no others.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_any_traces(std::int32_t c) {
    if (const std::int32_t i = state_.element.tables.affine_index_of(c); i >= 0)
        state_.element.set_any_affine_traces(state_.arrays.affine.cells[static_cast<std::size_t>(i)]);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_any_stress(std::int32_t c) {
    const Kind kind = kind_of(c);
    in_pool(*this, kind, [c](auto& pool) { pool.set_stress(c); });
    if (kind == Kind::finite) return;
    materials_.remove_lasting_jumps(c);
    if (const std::int32_t i = state_.element.tables.affine_index_of(c); i >= 0)
        state_.element.set_any_affine_gradients(state_.arrays.affine.cells[static_cast<std::size_t>(i)]);
    materials_.add_stress_of_state(c);
}

/// Adds what contact adds to the stress of a cell, and what its free face does.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::answer_to_corrections(std::int32_t c) {
    add_moments(c, c + 1);
    if (const BoundaryFace b = state_.arrays.simplices.condensed_face(c); b != no_face) state_.element.condense({c, b});
}

/// Adds what contact adds: of a cell with free faces a moment on F_cond, less what moves these from where affine ones are.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::add_moments(std::int32_t begin, std::int32_t end) {
    state_.moments.for_each(begin, end, [&](std::int32_t c, const CellPush<Dim>& push) {
        Matrix<Dim> added = push.affine;
        if constexpr (is_double)
            if (state_.finite.shows_condensed(c))
                added += finite_.pull_back_contact(c, push.condensed + push.of_moved_faces) - push.of_moved_faces;
        LaneTensor<Dim, Real> sum = load_tensor<Dim>(state_.work.s, c);
        const LaneTensor<Dim> packed = load_packed<Dim>(added);
        for (int j = 0; j < Dim; ++j) sum.col[j] += state_.element.units.stress(packed.col[j]);
        store_tensor(sum, state_.work.s, c);
    });
}

// One chunk ----------------------------------------------------------------------------------------------------------

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::reconstruct_chunk(std::int32_t k) {
    in_pool_of_chunk(k, [&](auto& pool) { pool.reconstruct(wanted_.reconstructed[k], wanted_.reconstructed_rows[k]); });
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::displacement_gradients_of_chunk(std::int32_t k) {
    const CellsOfChunk chunk{wanted_.displacement_gradients[k], wanted_.condensed_gradients[k]};
    in_pool_of_chunk(k, [&](auto& pool) { pool.set_gradients(chunk); });
    for (const AffineCell& cell : wanted_.affine_traces[k]) state_.element.set_any_affine_traces(cell);
    with_materials_of(k, [&](auto& materials) { materials.let_flow(chunk.cells); });
    if (!strain_bounds_.empty())
        strain_bounds_[k] =
            in_pool_of_chunk(k, [&](auto& pool) { return pool.largest_strain(chunks_[k].cell, chunks_[k + 1].cell); });
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::energies_of_chunk(std::int32_t k, std::span<double> result) const {
    for_runs(wanted_.cell_gradients[k], [&](std::int32_t c) { result[static_cast<std::size_t>(c)] = energy(c); });
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::stresses_of_chunk(std::int32_t k) {
    const CellsOfChunk chunk{wanted_.stresses[k], wanted_.condensed_stresses[k]};
    in_pool_of_chunk(k, [&](auto& pool) { pool.set_stresses(chunk); });
    with_materials_of(k, [&](auto& materials) { materials.remove_lasting_jumps(chunk.cells); });
    for (const AffineCell& cell : wanted_.affine_gradients[k]) state_.element.set_any_affine_gradients(cell);
    with_materials_of(k, [&](auto& materials) { materials.add_stresses(chunk.cells); });
    for (const Run& run : chunk.cells) add_moments(run.begin, run.end);
    for (const CondensedCell& condensed : chunk.condensed) state_.element.condense(condensed);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::face_gradients_of_chunk(std::int32_t k) {
    in_pool_of_chunk(k, [&](auto& pool) { pool.set_face_gradients(wanted_.face_gradients[k]); });
    for (const BoundaryFace b : wanted_.row_gradients[k])
        store(state_.element.boundary_gradient(b), state_.work.boundary_y, number_of(b));
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::cell_gradients_of_chunk(std::int32_t k, std::span<Vector<Dim>> result) const {
    const SweepElements<Vectors>& element = state_.element;
    for_runs(wanted_.cell_gradients[k], [&](std::int32_t c) { result[c] = unload<Dim>(element.cell_gradient(c)); });
    for_runs(wanted_.boundary_cell_gradients[k], [&](std::int32_t position) {
        result[state_.arrays.boundary_cells[position]] += unload<Dim>(element.boundary_cell_gradient(position));
    });
}

#define ABUT_INSTANTIATE(Dim, Real)                                                    \
    template void CcgSweeps<Dim, Real>::add_moments(std::int32_t, std::int32_t);       \
    template void CcgSweeps<Dim, Real>::reconstruct_chunk(std::int32_t);               \
    template void CcgSweeps<Dim, Real>::displacement_gradients_of_chunk(std::int32_t); \
    template void CcgSweeps<Dim, Real>::stresses_of_chunk(std::int32_t);               \
    template void CcgSweeps<Dim, Real>::face_gradients_of_chunk(std::int32_t);         \
    template void CcgSweeps<Dim, Real>::cell_gradients_of_chunk(std::int32_t, std::span<Vector<Dim>>) const;
ABUT_INSTANTIATE(2, double)
ABUT_INSTANTIATE(3, double)
ABUT_INSTANTIATE(2, float)
ABUT_INSTANTIATE(3, float)
#undef ABUT_INSTANTIATE

#define ABUT_INSTANTIATE(Dim)                                                                         \
    template Lanes<Dim> CcgSweeps<Dim>::any_boundary_displacement(const double*, BoundaryFace) const; \
    template void CcgSweeps<Dim>::set_any_traces(std::int32_t);                                       \
    template void CcgSweeps<Dim>::energies_of_chunk(std::int32_t, std::span<double>) const;           \
    template void CcgSweeps<Dim>::set_any_stress(std::int32_t);                                       \
    template void CcgSweeps<Dim>::answer_to_corrections(std::int32_t);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
