#pragma once
// Private to the sources of this layer.
#include <algorithm>

#include "abut/solid/cells/sweep_elements.hpp"

// What the sweeps do with one element of a body of simplices, and with one whatever its body is, for the sources that
// need it inlined.

namespace abut::solid {

/// A_bb^-1 t/|c|: how a free face gives way to a force.
template <class V>
[[nodiscard]] ABUT_HOST_DEVICE inline V free_face_compliance(const CellGeometry<V::dim, typename V::Scalar>& cell,
                                                             const FaceGeometry<V::dim, typename V::Scalar>& face, V t) {
    typename V::Scalar along = 0, square = 0;
    V area;
    for (int j = 0; j < V::dim; ++j) {
        area.r[j] = face.area_vector[j];
        along += t[j] * area[j];
        square += area[j] * area[j];
    }
    const auto contracted = (cell.lambda + cell.mu) / (cell.lambda + 2 * cell.mu) * along / square;
    return 1 / (cell.mu * square) * (t - contracted * area);
}

/// sigma_c and the mean of u_f - u_c; relative(f): u_f less that of its first side.
template <class V>
template <class Relative>
[[gnu::always_inline]] inline SimplexState<V> SweepElements<V>::simplex_state(const double* u, std::int32_t c,
                                                                              const Relative& relative) const {
    const SimplexCell<Dim>& simplex = tables.simplices[c];
    const CellGeometry<Dim, Real>& cell = tables.cells[c];
    const Double u_c = load<Double>(u, c);
    const auto at_face = [&](std::size_t i) {
        return relative(simplex.faces[i]) + units.displacement(load<Double>(u, std::min(c, simplex.neighbours[i])) - u_c);
    };
    const auto is_second = [&](std::size_t i) { return simplex.neighbours[i] < c; };
    const V at_0 = at_face(0);  // the area vectors of the cell sum to zero: the others less this one
    const bool has_shares = tables.shares.size > 0;
    const auto weighted = [&](std::size_t i, const V& at_i) {
        return has_shares ? tables.shares[simplex.faces[i]][is_second(i) ? 1 : 0] * at_i : at_i;
    };
    Tensor g{};
    V sum = weighted(0, at_0);
    for (std::size_t i = 1; i <= Dim; ++i) {
        const V at_i = at_face(i);
        sum += weighted(i, at_i);
        g.add_outer(Real(is_second(i) ? -1 : 1) * (at_i - at_0), tables.faces[simplex.faces[i]].area_vector);
    }
    for (V& column : g.col) column = cell.inverse_measure * column;
    return {elastic_stress(cell, g), has_shares ? sum : simplex_share<Dim, Real> * sum};
}

/// sigma_c and d_c; of a condensed cell without its free face.
template <class V>
[[gnu::always_inline]] inline void SweepElements<V>::set_simplex_stress(std::int32_t c) const {
    const auto [stress, mean] =
        simplex_state(tables.u.data, c, [&](std::int32_t f) { return load<V>(tables.of_face.data, f); });
    store_tensor(stress, tables.s.data, c);
    store(Real(-1) * mean, tables.deviation.data, c);
}

/// û_b - u_c = -A_bb^-1 sigma' |b| n_b of the free face, loads and corrections beside it.
template <class V>
inline V SweepElements<V>::condensed_face(const CondensedCell& condensed, const Tensor& stress) const {
    const auto [c, b] = condensed;
    const CellGeometry<Dim, Real>& cell = tables.cells[c];
    const FaceGeometry<Dim, Real>& face = tables.faces[tables.face_of(b)];
    const V sum = load<V>(tables.correction.data, number_of(b)) -
                  (1 / cell.inverse_measure) * free_face_compliance(cell, face, stress.times(face.area_vector));
    if (tables.load_displacement.size == 0) return sum;
    return sum + units.displacement(gathered(tables.load_displacement, number_of(b)));
}

/// Puts the free face of a condensed cell where it belongs, and sigma_c and d_c with it.
template <class V>
inline void SweepElements<V>::add_condensed_face(const CondensedCell& condensed) const {
    const auto [c, b] = condensed;
    Tensor stress = load_tensor<V>(tables.s.data, c);
    const V at_face = condensed_face(condensed, stress);
    const CellGeometry<Dim, Real>& cell = tables.cells[c];
    Tensor g{};
    g.add_outer(cell.inverse_measure * at_face, tables.faces[tables.face_of(b)].area_vector);
    const Tensor added = elastic_stress(cell, g);
    for (int j = 0; j < Dim; ++j) stress.col[j] += added.col[j];
    store(at_face, tables.of_face.data, tables.face_of(b));
    store_tensor(stress, tables.s.data, c);
    store(load<V>(tables.deviation.data, c) - boundary_share(tables.face_of(b)) * at_face, tables.deviation.data, c);
}

/// Share of a boundary face in the mean over the faces of its cell.
template <class V>
inline auto SweepElements<V>::boundary_share(std::int32_t f) const -> Real {
    return tables.shares.size == 0 ? simplex_share<Dim, Real> : tables.shares[f][0];
}

/// d_c with the free faces of the cell where the cells around point; these faces have been reconstructed.
template <class V>
inline void SweepElements<V>::set_affine_deviation(const AffineCell& cell) const {
    V deviation = load<V>(tables.deviation.data, cell.cell);
    for (std::int32_t i = cell.begin; i < cell.end; ++i)
        deviation -= boundary_share(tables.face_of(tables.affine_faces[i])) * affine_motion(i);
    store(deviation, tables.deviation.data, cell.cell);
}

/// D_c.
template <class V>
[[gnu::always_inline]] inline void SweepElements<V>::set_simplex_jumps(std::int32_t c) const {
    const SimplexCell<Dim>& simplex = tables.simplices[c];
    const V d_c = load<V>(tables.deviation.data, c);
    V sum;
    for (std::size_t i = 0; i <= Dim; ++i)
        sum += tables.faces[simplex.faces[i]].jump_stiffness * (d_c - load<V>(tables.deviation.data, simplex.neighbours[i]));
    store(sum, tables.direct.data, c);
}

/// The counterpart of `set_affine_gradients`, after D_c.
template <class V>
inline void SweepElements<V>::set_affine_gradients_of_simplex(const AffineCell& cell) const {
    const V jumps = load<V>(tables.direct.data, cell.cell);
    for (std::int32_t i = cell.begin; i < cell.end; ++i) {
        const Real share = boundary_share(tables.face_of(tables.affine_faces[i]));
        store(load_tensor<V>(tables.affine_parts.data, i) * (Real(-1) * share * jumps), tables.affine_y.data, i);
    }
}

template <class V>
[[gnu::always_inline]] inline V SweepElements<V>::interior_gradient_of_simplices(std::ptrdiff_t f) const {
    const auto [a, b] = tables.face_cells[f];
    const auto i = static_cast<std::int32_t>(f);
    return interior_gradient(f) - (shared_jumps(i, a, false) + shared_jumps(i, b, true));
}

/// Sets y of the free face, and lets the stress of its cell answer.
template <class V>
inline void SweepElements<V>::condense(const CondensedCell& condensed) const {
    const auto [c, b] = condensed;
    const CellGeometry<Dim, Real>& cell = tables.cells[c];
    const FaceGeometry<Dim, Real>& face = tables.faces[tables.face_of(b)];
    const V y = boundary_gradient(b);
    store(y, tables.boundary_y.data, number_of(b));
    Tensor g{};
    g.add_outer(free_face_compliance(cell, face, y), face.area_vector);
    const Tensor answer = elastic_stress(cell, g);
    Tensor sigma = load_tensor<V>(tables.s.data, c);
    for (int j = 0; j < Dim; ++j) sigma.col[j] -= answer.col[j];
    store_tensor(sigma, tables.s.data, c);
}

template <class V>
inline void SweepElements<V>::set_any_displacement_gradient(std::int32_t c) const {
    if (!tables.of_simplices(c)) return set_displacement_gradient(c);
    const BoundaryFace b = tables.condensed_face_of(c);
    if (b != no_face) store(V{}, tables.of_face.data, tables.face_of(b));
    set_simplex_stress(c);
    if (b != no_face) add_condensed_face({c, b});
}

template <class V>
inline void SweepElements<V>::set_any_stress(std::int32_t c) const {
    if (tables.of_simplices(c))
        set_simplex_jumps(c);
    else
        set_stress(c);
    if (const std::int32_t i = tables.affine_index_of(c); i >= 0) set_any_affine_gradients(tables.affine_cells[i]);
}

template <class V>
inline void SweepElements<V>::set_any_affine_traces(const AffineCell& cell) const {
    if (tables.of_simplices(cell.cell))
        set_affine_deviation(cell);
    else
        set_affine_traces(cell);
}

template <class V>
inline void SweepElements<V>::set_any_affine_gradients(const AffineCell& cell) const {
    if (tables.of_simplices(cell.cell))
        set_affine_gradients_of_simplex(cell);
    else
        set_affine_gradients(cell);
}

/// Gradient of an interior face.
template <class V>
inline void SweepElements<V>::set_any_face_gradient(std::int32_t f) const {
    const bool simplices = tables.of_simplices(tables.face_cells[f][0]);
    store(simplices ? interior_gradient_of_simplices(f) : interior_gradient(f), tables.of_face.data, f);
}

/// G_c in a region whose face displacements are as they have been reconstructed.
template <class V>
inline TensorOf<V> SweepElements<V>::region_gradient(std::ptrdiff_t c) const {
    if (!tables.of_simplices(c)) return load_tensor<V>(tables.g.data, c);
    return gradient_of(tables.u.data, c, [&](std::int32_t f) { return load<V>(tables.of_face.data, f); });
}

/// G_c of the state that was evaluated last; what interior faces had may be overwritten.
template <class V>
inline TensorOf<V> SweepElements<V>::present_gradient(std::ptrdiff_t c) const {
    if (!tables.of_simplices(c)) return load_tensor<V>(tables.g.data, c);
    return gradient_of(tables.u.data, c, [&](std::int32_t f) {
        return tables.boundary_index[f] == no_face ? reconstructed(tables.u.data, f) : load<V>(tables.of_face.data, f);
    });
}

}  // namespace abut::solid
