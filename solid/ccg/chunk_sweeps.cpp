#include "abut/base/parallel.hpp"
#include "abut/solid/ccg/simplex_elements.hpp"
#include "abut/solid/ccg/sweeps.hpp"

// What the sweeps do with one chunk, and with one element whatever its body is.

namespace abut::solid {

// One element of any body -------------------------------------------------------------------------------------------

/// û_b - u_c of a boundary face.
template <int Dim, class Real>
Lanes<Dim, Real> CcgSweeps<Dim, Real>::any_boundary_displacement(const double* u, BoundaryFace b) const {
    const std::int32_t c = arrays_.cell_of(b);
    if (arrays_.simplices.condensed_face(c) != b) return element_.reconstructed_row(u, b);
    const std::int32_t boundary_face = arrays_.face_of(b);
    const auto without = element_.simplex_state(
        u, c, [&](std::int32_t f) { return f == boundary_face ? Vectors{} : element_.reconstructed(u, f); });
    return element_.condensed_face({c, b}, without.stress);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_any_displacement_gradient(std::int32_t c) {
    if (finite_.contains(c))
        set_finite_displacement_gradient(c);
    else
        element_.set_any_displacement_gradient(c);
}

/// Traces of cells whose free faces are affine; no others.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_any_traces(std::int32_t c) {
    if (const std::int32_t i = element_.tables.affine_index_of(c); i >= 0)
        element_.set_any_affine_traces(arrays_.affine.cells[static_cast<std::size_t>(i)]);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_any_stress(std::int32_t c) {
    if (finite_.contains(c))
        set_finite_stress(c);
    else
        element_.set_any_stress(c);
    if constexpr (takes_finite)
        if (!finite_.contains(c)) {
            if (capped_ && capped_->contains(c)) {
                add_lasting_jumps(c);
                const std::int32_t i = element_.tables.affine_index_of(c);
                if (i >= 0) element_.set_any_affine_gradients(arrays_.affine.cells[static_cast<std::size_t>(i)]);
            }
            if (has_stress_beside()) add_stress_of_material(c);
            if (plastic_ && plastic_->contains(c)) add_stress(c, -plastic_->stress(c));
        }
}

/// Stress of a cell whose strains are linear, beside lambda and mu of its strain: other moduli, less
/// thermal stress.
template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::stress_beside(std::int32_t c, const Matrix<Dim>& g) const {
    Matrix<Dim> stress = Matrix<Dim>::Zero();
    if (arrays_.directed.contains(c)) stress += arrays_.directed[c].stress(g);
    if (!temperature_.empty()) stress -= temperature_[static_cast<std::size_t>(c)] * thermal_->stress(c);
    return stress;
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::add_stress_of_material(std::int32_t c) {
    const bool is_directed = arrays_.directed.contains(c);
    add_stress(c, stress_beside(c, is_directed ? unload(load_tensor<Dim>(work_.g, c)) : Matrix<Dim>::Zero()));
}

/// Adds what contact adds to the stress of a cell, and what its free face does.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::answer_to_corrections(std::int32_t c) {
    add_moments(c, c + 1);
    if (const BoundaryFace b = arrays_.simplices.condensed_face(c); b != no_face) element_.condense({c, b});
}

template <int Dim, class Real>
LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::present_gradient(std::ptrdiff_t c) const {
    return element_.present_gradient(c);
}

template <int Dim, class Real>
LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::region_gradient(std::ptrdiff_t c) const {
    return element_.region_gradient(c);
}

/// 1/2 |c| eps:C:eps, and 1/2 k |[u]|^2 of the faces whose first side the cell is.
template <int Dim, class Real>
double CcgSweeps<Dim, Real>::energy(std::ptrdiff_t c) const {
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    const bool simplices = arrays_.simplices.contains(c);
    const auto relative = [&](std::int32_t f) { return load_packed<Dim>(work_.of_face, f); };
    const LaneTensor<Dim, Real> g =
        simplices ? element_.gradient_of(work_.u.data(), c, relative) : load_tensor<Dim>(work_.g, c);
    const bool finite = finite_.contains(c);
    const bool has_law = finite_.has_law(c);
    const LaneTensor<Dim, Real> strain = finite ? green_strain(g) : g;
    const LaneTensor<Dim, Real> sigma = finite ? finite_stress(c, strain) : elastic_stress(cell, g);
    double density = 0.0;
    for (int j = 0; j < Dim; ++j) density += dot(sigma.col[j], strain.col[j]);
    if (!finite && arrays_.directed.contains(c))
        density += arrays_.directed[c].stress(unload(g)).cwiseProduct(unload(g)).sum();
    if (!temperature_.empty()) density += thermal_->twice_energy(c, temperature_[static_cast<std::size_t>(c)], unload(g));
    if (plastic_ && plastic_->contains(c)) density += 2.0 * plastic_->energy(c, unload(g));
    if (has_law) density = 2.0 * law_response(static_cast<std::int32_t>(c), unload(g)).energy;
    double twice = density / cell.inverse_measure;
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i) {
        const HalfFace& half_face = arrays_.half_faces[i];
        if (half_face.first != c) continue;
        const Lanes<Dim, Real> jump = elastic_jump(static_cast<std::int32_t>(c), i);
        twice += coefficients_.faces[half_face.face].jump_stiffness * dot(jump, jump);
    }
    return 0.5 * twice;
}

template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::stress(std::int32_t c) const {
    if constexpr (takes_finite)
        if (finite_.contains(c)) return cauchy_stress(c);
    if constexpr (takes_finite)
        if (has_stress_beside() || plastic_) {
            const Matrix<Dim> g = displacement_gradient(c);
            Matrix<Dim> stress = unload(elastic_stress(coefficients_.cells[c], present_gradient(c))) + stress_beside(c, g);
            if (plastic_ && plastic_->contains(c)) stress -= plastic_->stress(c);
            return stress;
        }
    return element_.units.in_pascals(unload(elastic_stress(coefficients_.cells[c], present_gradient(c))));
}

// One chunk ----------------------------------------------------------------------------------------------------------

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::load_displacement(std::span<const Vector<Dim>> u) {
    parallel_each(arrays_.n_cells(), [&](std::ptrdiff_t c) { store(load_packed<Dim>(u[c]), work_.u, c); });
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::reconstruct_chunk(std::int32_t k) {
    for_runs(wanted_.reconstructed[k],
             [&](std::int32_t f) { store(element_.reconstructed(work_.u.data(), f), work_.of_face, f); });
    const SweepElements<Vectors>& of_rows = takes_end(k) ? end_element_ : element_;
    for (const BoundaryFace b : wanted_.reconstructed_rows[k])
        store(of_rows.reconstructed_row(work_.u.data(), b), work_.of_face, arrays_.face_of(b));
    if constexpr (takes_finite) {
        if (!change_.of_finite() || !chunks_[k].has_finite) return;
        for_runs(wanted_.reconstructed[k], [&](std::int32_t f) { change_.reconstruct_finite(f); });
        for (const BoundaryFace b : wanted_.reconstructed_rows[k]) change_.reconstruct_finite(b);
    }
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::displacement_gradients_of_chunk(std::int32_t k) {
    const auto cells = wanted_.displacement_gradients[k];
    if (chunks_[k].simplices) {
        const auto condensed = wanted_.condensed_gradients[k];
        for (const auto& [c, b] : condensed) store(Vectors{}, work_.of_face, arrays_.face_of(b));
        for_runs(cells, [&](std::int32_t c) { element_.set_simplex_stress(c); });
        for (const CondensedCell& cell : condensed) element_.add_condensed_face(cell);
    } else if (!chunks_[k].has_finite) {
        for_runs(cells, [&](std::int32_t c) { element_.set_displacement_gradient(c); });
    } else if constexpr (takes_finite) {
        for_runs(cells, [&](std::int32_t c) { set_finite_displacement_gradient(c); });
    }
    for (const AffineCell& cell : wanted_.affine_traces[k]) element_.set_any_affine_traces(cell);
    if constexpr (takes_finite)
        if (change_.of_linear() && plastic_ && !chunks_[k].has_finite)
            for_runs(cells, [&](std::int32_t c) {  // for its own stress, and for the jumps of its neighbours
                change_.prepare_gradient(c, !change_.follows() && capped_ && capped_->contains(c));
                if (plastic_->contains(c)) let_flow(c);
            });
    if (!strain_bounds_.empty()) strain_bounds_[k] = largest_strain_of_chunk(k);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::stresses_of_chunk(std::int32_t k) {
    const auto cells = wanted_.stresses[k];
    if (chunks_[k].simplices) {
        for_runs(cells, [&](std::int32_t c) { element_.set_simplex_jumps(c); });
    } else if (!chunks_[k].has_finite) {
        for_runs(cells, [&](std::int32_t c) { element_.set_stress(c); });
    } else if constexpr (takes_finite) {
        for_runs(cells, [&](std::int32_t c) { set_finite_stress(c); });
    }
    if constexpr (takes_finite)
        if (capped_ && !chunks_[k].has_finite)
            for_runs(cells, [&](std::int32_t c) {
                if (capped_->contains(c)) add_lasting_jumps(c);
            });
    for (const AffineCell& cell : wanted_.affine_gradients[k]) element_.set_any_affine_gradients(cell);
    if constexpr (takes_finite)
        if (!chunks_[k].has_finite) {
            if (change_.of_linear() || plastic_) for_runs(cells, [&](std::int32_t c) { add_linear_stress(c); });
            if (has_stress_beside()) for_runs(cells, [&](std::int32_t c) { add_stress_of_material(c); });
        }
    for (const Run& run : cells) add_moments(run.begin, run.end);
    for (const CondensedCell& condensed : wanted_.condensed_stresses[k]) element_.condense(condensed);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::face_gradients_of_chunk(std::int32_t k) {
    const auto faces = wanted_.face_gradients[k];
    if (chunks_[k].simplices)
        for_runs(faces, [&](std::int32_t f) { store(element_.interior_gradient_of_simplices(f), work_.of_face, f); });
    else
        for_runs(faces, [&](std::int32_t f) { store(element_.interior_gradient(f), work_.of_face, f); });
    for (const BoundaryFace b : wanted_.row_gradients[k])
        store(element_.boundary_gradient(b), work_.boundary_y, number_of(b));
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::cell_gradients_of_chunk(std::int32_t k, std::span<Vector<Dim>> result) const {
    for_runs(wanted_.cell_gradients[k], [&](std::int32_t c) { result[c] = unload<Dim>(element_.cell_gradient(c)); });
    for_runs(wanted_.boundary_cell_gradients[k], [&](std::int32_t position) {
        result[arrays_.boundary_cells[position]] += unload<Dim>(element_.boundary_cell_gradient(position));
    });
}

#define ABUT_INSTANTIATE(Dim, Real)                                                              \
    template LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::present_gradient(std::ptrdiff_t) const; \
    template LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::region_gradient(std::ptrdiff_t) const;  \
    template Matrix<Dim> CcgSweeps<Dim, Real>::stress(std::int32_t) const;                       \
    template void CcgSweeps<Dim, Real>::reconstruct_chunk(std::int32_t);                         \
    template void CcgSweeps<Dim, Real>::displacement_gradients_of_chunk(std::int32_t);           \
    template void CcgSweeps<Dim, Real>::stresses_of_chunk(std::int32_t);                         \
    template void CcgSweeps<Dim, Real>::face_gradients_of_chunk(std::int32_t);                   \
    template void CcgSweeps<Dim, Real>::cell_gradients_of_chunk(std::int32_t, std::span<Vector<Dim>>) const;
ABUT_INSTANTIATE(2, double)
ABUT_INSTANTIATE(3, double)
ABUT_INSTANTIATE(2, float)
ABUT_INSTANTIATE(3, float)
#undef ABUT_INSTANTIATE

#define ABUT_INSTANTIATE(Dim)                                                                         \
    template Lanes<Dim> CcgSweeps<Dim>::any_boundary_displacement(const double*, BoundaryFace) const; \
    template void CcgSweeps<Dim>::set_any_displacement_gradient(std::int32_t);                        \
    template void CcgSweeps<Dim>::set_any_traces(std::int32_t);                                       \
    template void CcgSweeps<Dim>::set_any_stress(std::int32_t);                                       \
    template void CcgSweeps<Dim>::add_stress_of_material(std::int32_t);                               \
    template Matrix<Dim> CcgSweeps<Dim>::stress_beside(std::int32_t, const Matrix<Dim>&) const;       \
    template void CcgSweeps<Dim>::answer_to_corrections(std::int32_t);                                \
    template double CcgSweeps<Dim>::energy(std::ptrdiff_t) const;                                     \
    template void CcgSweeps<Dim>::load_displacement(std::span<const Vector<Dim>>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
