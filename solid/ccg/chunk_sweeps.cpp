#include "abut/base/parallel.hpp"
#include "abut/solid/ccg/simplex_elements.hpp"

// What the sweeps do with one chunk, and with one element whatever its body is.

namespace abut::solid {

// One element of any body -------------------------------------------------------------------------------------------

/// û_b - u_c of a boundary face.
template <int Dim, class Real>
Lanes<Dim, Real> CcgSweeps<Dim, Real>::any_boundary_displacement(const LargeArray<double>& u, BoundaryFace b,
                                                                 const BoundaryLoad<Dim>& boundary_load) const {
    const std::int32_t c = arrays_.cell_of(b);
    if (arrays_.simplices.condensed_face(c) != b) return reconstructed_boundary(u, b, boundary_load);
    const std::int32_t boundary_face = arrays_.face_of(b);
    const auto without =
        simplex_state(u, c, [&](std::int32_t f) { return f == boundary_face ? Lanes<Dim, Real>{} : reconstructed(u, f); });
    return condensed_face({c, b}, without.stress, boundary_load);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_any_displacement_gradient(std::int32_t c, const BoundaryLoad<Dim>& boundary_load) {
    if (arrays_.simplices.contains(c)) {
        const BoundaryFace b = arrays_.simplices.condensed_face(c);
        if (b != no_face) store(Lanes<Dim, Real>{}, of_face_, arrays_.face_of(b));
        set_simplex_stress(c);
        if (b != no_face) add_condensed_face({c, b}, boundary_load);
    } else if (finite_.contains(c)) {
        set_finite_displacement_gradient(c);
    } else {
        set_displacement_gradient(c);
    }
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_any_stress(std::int32_t c) {
    if (arrays_.simplices.contains(c))
        set_simplex_jumps(c);
    else if (finite_.contains(c))
        set_finite_stress(c);
    else
        set_stress(c);
}

/// What contact adds to the stress of a cell, and what its free face does.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::answer_to_corrections(std::int32_t c, const BoundaryLoad<Dim>& boundary_load) {
    add_moments(c, c + 1);
    if (const BoundaryFace b = arrays_.simplices.condensed_face(c); b != no_face) condense({c, b}, boundary_load);
}

/// Of an interior face.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_any_face_gradient(std::int32_t f) {
    const bool simplices = arrays_.simplices.contains(arrays_.face_cells[f][0]);
    store(simplices ? interior_gradient_of_simplices(f) : interior_gradient(f), of_face_, f);
}

/// G_c of the state that was evaluated last; what interior faces had may be overwritten.
template <int Dim, class Real>
LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::present_gradient(std::ptrdiff_t c) const {
    if (!arrays_.simplices.contains(c)) return load_tensor<Dim>(g_, c);
    return gradient_of(u_, c, [&](std::int32_t f) {
        return arrays_.boundary_index[f] == no_face ? reconstructed(u_, f) : load_packed<Dim>(of_face_, f);
    });
}

/// 1/2 |c| eps:C:eps, and 1/2 k |[u]|^2 of the faces whose first side the cell is.
template <int Dim, class Real>
double CcgSweeps<Dim, Real>::energy(std::ptrdiff_t c) const {
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    const bool simplices = arrays_.simplices.contains(c);
    const auto relative = [&](std::int32_t f) { return load_packed<Dim>(of_face_, f); };
    const LaneTensor<Dim, Real> g = simplices ? gradient_of(u_, c, relative) : load_tensor<Dim>(g_, c);
    const bool finite = finite_.contains(c);
    const LaneTensor<Dim, Real> strain = finite ? green_strain(g) : g;
    const LaneTensor<Dim, Real> sigma = finite ? finite_stress(c, strain) : elastic_stress(cell, g);
    double density = 0.0;
    for (int j = 0; j < Dim; ++j) density += dot(sigma.col[j], strain.col[j]);
    double twice = density / cell.inverse_measure;
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i) {
        const HalfFace& half_face = arrays_.half_faces[i];
        if (half_face.first != c) continue;
        const Lanes<Dim, Real> jump =
            simplices ? load_packed<Dim>(deviation_, c) - load_packed<Dim>(deviation_, arrays_.face_cells[half_face.face][1])
                      : load_packed<Dim>(trace_, i) - load_packed<Dim>(trace_, half_face.twin);
        twice += coefficients_.faces[half_face.face].jump_stiffness * dot(jump, jump);
    }
    return 0.5 * twice;
}

template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::stress(std::int32_t c) const {
    if constexpr (takes_finite)
        if (finite_.contains(c)) return cauchy_stress(c);
    return units_.in_pascals(unload(elastic_stress(coefficients_.cells[c], present_gradient(c))));
}

// One chunk ----------------------------------------------------------------------------------------------------------

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::load_displacement(std::span<const Vector<Dim>> u) {
    parallel_each(arrays_.n_cells(), [&](std::ptrdiff_t c) { store(load_packed<Dim>(u[c]), u_, c); });
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::reconstruct_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load) {
    for_runs(wanted_.reconstructed[k], [&](std::int32_t f) { store(reconstructed(u_, f), of_face_, f); });
    for (const BoundaryFace b : wanted_.reconstructed_rows[k])
        store(reconstructed_boundary(u_, b, boundary_load), of_face_, arrays_.face_of(b));
    if constexpr (takes_finite) {
        if (!has_change_ || !chunks_[k].has_finite) return;
        for_runs(wanted_.reconstructed[k], [&](std::int32_t f) { store(reconstructed(u_change_, f), relative_change_, f); });
        for (const BoundaryFace b : wanted_.reconstructed_rows[k])
            store(boundary_change(b), relative_change_, arrays_.face_of(b));
    }
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::displacement_gradients_of_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load) {
    const auto cells = wanted_.displacement_gradients[k];
    if (chunks_[k].simplices) {
        const auto condensed = wanted_.condensed_gradients[k];
        for (const auto& [c, b] : condensed) store(Lanes<Dim, Real>{}, of_face_, arrays_.face_of(b));
        for_runs(cells, [&](std::int32_t c) { set_simplex_stress(c); });
        for (const CondensedCell& cell : condensed) add_condensed_face(cell, boundary_load);
    } else if (!chunks_[k].has_finite) {
        for_runs(cells, [&](std::int32_t c) { set_displacement_gradient(c); });
    } else if constexpr (takes_finite) {
        for_runs(cells, [&](std::int32_t c) { set_finite_displacement_gradient(c); });
    }
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::stresses_of_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load) {
    const auto cells = wanted_.stresses[k];
    if (chunks_[k].simplices) {
        for_runs(cells, [&](std::int32_t c) { set_simplex_jumps(c); });
    } else if (!chunks_[k].has_finite) {
        for_runs(cells, [&](std::int32_t c) { set_stress(c); });
    } else if constexpr (takes_finite) {
        for_runs(cells, [&](std::int32_t c) { set_finite_stress(c); });
    }
    for (const Run& run : cells) add_moments(run.begin, run.end);
    for (const CondensedCell& condensed : wanted_.condensed_stresses[k]) condense(condensed, boundary_load);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::face_gradients_of_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load) {
    const auto faces = wanted_.face_gradients[k];
    if (chunks_[k].simplices)
        for_runs(faces, [&](std::int32_t f) { store(interior_gradient_of_simplices(f), of_face_, f); });
    else
        for_runs(faces, [&](std::int32_t f) { store(interior_gradient(f), of_face_, f); });
    for (const BoundaryFace b : wanted_.row_gradients[k])
        store(boundary_gradient(b, boundary_load), boundary_y_, number_of(b));
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::cell_gradients_of_chunk(std::int32_t k, std::span<Vector<Dim>> result) const {
    for_runs(wanted_.cell_gradients[k], [&](std::int32_t c) { result[c] = unload<Dim>(cell_gradient(c)); });
    for_runs(wanted_.boundary_cell_gradients[k], [&](std::int32_t position) {
        result[arrays_.boundary_cells[position]] += unload<Dim>(boundary_cell_gradient(position));
    });
}

#define ABUT_INSTANTIATE(Dim, Real)                                                                              \
    template LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::present_gradient(std::ptrdiff_t) const;                 \
    template Matrix<Dim> CcgSweeps<Dim, Real>::stress(std::int32_t) const;                                       \
    template void CcgSweeps<Dim, Real>::reconstruct_chunk(std::int32_t, const BoundaryLoad<Dim>&);               \
    template void CcgSweeps<Dim, Real>::displacement_gradients_of_chunk(std::int32_t, const BoundaryLoad<Dim>&); \
    template void CcgSweeps<Dim, Real>::stresses_of_chunk(std::int32_t, const BoundaryLoad<Dim>&);               \
    template void CcgSweeps<Dim, Real>::face_gradients_of_chunk(std::int32_t, const BoundaryLoad<Dim>&);         \
    template void CcgSweeps<Dim, Real>::cell_gradients_of_chunk(std::int32_t, std::span<Vector<Dim>>) const;
ABUT_INSTANTIATE(2, double)
ABUT_INSTANTIATE(3, double)
ABUT_INSTANTIATE(2, float)
ABUT_INSTANTIATE(3, float)
#undef ABUT_INSTANTIATE

#define ABUT_INSTANTIATE(Dim)                                                                              \
    template Lanes<Dim> CcgSweeps<Dim>::any_boundary_displacement(const LargeArray<double>&, BoundaryFace, \
                                                                  const BoundaryLoad<Dim>&) const;         \
    template void CcgSweeps<Dim>::set_any_displacement_gradient(std::int32_t, const BoundaryLoad<Dim>&);   \
    template void CcgSweeps<Dim>::set_any_stress(std::int32_t);                                            \
    template void CcgSweeps<Dim>::answer_to_corrections(std::int32_t, const BoundaryLoad<Dim>&);           \
    template void CcgSweeps<Dim>::set_any_face_gradient(std::int32_t);                                     \
    template double CcgSweeps<Dim>::energy(std::ptrdiff_t) const;                                          \
    template void CcgSweeps<Dim>::load_displacement(std::span<const Vector<Dim>>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
