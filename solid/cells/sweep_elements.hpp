#pragma once
// Private to the sources of this layer.
#include <algorithm>

#include "abut/solid/cells/sweep_tables.hpp"
#include "abut/solid/operator/tensor_of.hpp"

// What the sweeps do with one element, for the sources that need it inlined: with registers (Lanes) on the host, by
// components on devices (Components). Sums are the same, so that the bits are.

namespace abut::solid {

/// sigma of linear elasticity for the displacement gradient g.
template <class V>
[[nodiscard]] ABUT_HOST_DEVICE inline TensorOf<V> elastic_stress(const CellGeometry<V::dim, typename V::Scalar>& cell,
                                                                 const TensorOf<V>& g) {
    const TensorOf<V> transposed = g.transposed();
    typename V::Scalar trace = 0;
    for (int j = 0; j < V::dim; ++j) trace += g.col[j][j];
    TensorOf<V> sigma;
    for (int j = 0; j < V::dim; ++j) {
        V unit;
        unit.r[j] = 1;
        sigma.col[j] = cell.mu * (g.col[j] + transposed.col[j]) + (cell.lambda * trace) * unit;
    }
    return sigma;
}

/// sigma of a simplex, and the mean of u_f - u_c over its faces by their shares.
template <class V>
struct SimplexState {
    TensorOf<V> stress;
    V mean;
};

/// V: the vectors that are computed with.
template <class V>
class SweepElements {
public:
    static constexpr int Dim = V::dim;
    using Real = typename V::Scalar;
    using Double = typename V::Double;
    using Tensor = TensorOf<V>;

    SweepElements() = default;
    SweepElements(const SweepTables<Dim, Real>& of, const SweepUnits<Dim, Real>& in) : tables(of), units(in) {}

    // Of the first sweep
    [[nodiscard]] ABUT_HOST_DEVICE V reconstructed(const double* u, std::ptrdiff_t f) const;
    [[nodiscard]] ABUT_HOST_DEVICE V reconstructed_row(const double* u, BoundaryFace b) const;

    // Of cells of any shape
    template <class Relative>
    [[nodiscard]] ABUT_HOST_DEVICE Tensor gradient_of(const double* u, std::ptrdiff_t c, const Relative& relative) const;
    ABUT_HOST_DEVICE void set_traces(std::ptrdiff_t c, const Tensor& g) const;
    ABUT_HOST_DEVICE void set_displacement_gradient(std::ptrdiff_t c) const;
    [[nodiscard]] ABUT_HOST_DEVICE Tensor sum_jumps(std::ptrdiff_t c) const;
    ABUT_HOST_DEVICE void set_stress(std::ptrdiff_t c) const;
    [[nodiscard]] ABUT_HOST_DEVICE V interior_gradient(std::ptrdiff_t f) const;
    [[nodiscard]] ABUT_HOST_DEVICE V boundary_gradient(BoundaryFace b) const;
    [[nodiscard]] ABUT_HOST_DEVICE Double cell_gradient(std::ptrdiff_t c) const;
    [[nodiscard]] ABUT_HOST_DEVICE Double boundary_cell_gradient(std::ptrdiff_t position) const;

    // Of cells that contact pushes
    [[nodiscard]] ABUT_HOST_DEVICE V affine_motion(std::int32_t i) const;
    ABUT_HOST_DEVICE void set_affine_traces(const AffineCell& cell) const;
    ABUT_HOST_DEVICE void set_affine_gradients(const AffineCell& cell) const;

    // Of simplices: simplex_elements.hpp
    template <class Relative>
    [[nodiscard]] ABUT_HOST_DEVICE SimplexState<V> simplex_state(const double* u, std::int32_t c,
                                                                 const Relative& relative) const;
    [[nodiscard]] ABUT_HOST_DEVICE V condensed_face(const CondensedCell& condensed, const Tensor& stress) const;
    ABUT_HOST_DEVICE void add_condensed_face(const CondensedCell& condensed) const;
    ABUT_HOST_DEVICE void set_simplex_stress(std::int32_t c) const;
    ABUT_HOST_DEVICE void set_simplex_jumps(std::int32_t c) const;
    [[nodiscard]] ABUT_HOST_DEVICE V shared_jumps(std::int32_t f, std::int32_t c, bool second) const;
    [[nodiscard]] ABUT_HOST_DEVICE V interior_gradient_of_simplices(std::ptrdiff_t f) const;
    [[nodiscard]] ABUT_HOST_DEVICE Real boundary_share(std::int32_t f) const;
    ABUT_HOST_DEVICE void set_affine_deviation(const AffineCell& cell) const;
    ABUT_HOST_DEVICE void set_affine_gradients_of_simplex(const AffineCell& cell) const;
    ABUT_HOST_DEVICE void condense(const CondensedCell& condensed) const;

    // Whatever the cell is, except of a finite body: simplex_elements.hpp
    ABUT_HOST_DEVICE void set_any_displacement_gradient(std::int32_t c) const;
    ABUT_HOST_DEVICE void set_any_stress(std::int32_t c) const;
    ABUT_HOST_DEVICE void set_any_affine_traces(const AffineCell& cell) const;
    ABUT_HOST_DEVICE void set_any_affine_gradients(const AffineCell& cell) const;
    ABUT_HOST_DEVICE void set_any_face_gradient(std::int32_t f) const;
    [[nodiscard]] Tensor present_gradient(std::ptrdiff_t c) const;
    [[nodiscard]] Tensor region_gradient(std::ptrdiff_t c) const;

    SweepTables<Dim, Real> tables;
    SweepUnits<Dim, Real> units;  // of a size of its own even if empty: compilers of devices do not agree otherwise

private:
    /// Vector of a table that is not packed.
    [[nodiscard]] static ABUT_HOST_DEVICE Double gathered(const Table<const double>& table, std::ptrdiff_t i) {
        Double a;
        for (int j = 0; j < Dim; ++j) a.r[j] = table[Dim * i + j];
        return a;
    }
};

// Displacements enter by their differences to that of a cell nearby, which are taken in double whatever Real is: a
// translation of the body costs no accuracy.

/// Share of a face in the mean over all faces of a simplex whose point is its centroid.
template <int Dim, class Real>
inline constexpr Real simplex_share = Real{1} / (Dim + 1);

/// D_c by the share that a face has in the mean of its first or second side.
template <class V>
[[gnu::always_inline]] inline V SweepElements<V>::shared_jumps(std::int32_t f, std::int32_t c, bool second) const {
    const V direct = load<V>(tables.direct.data, c);
    return (tables.shares.size == 0 ? simplex_share<Dim, Real> : tables.shares[f][second ? 1 : 0]) * direct;
}

template <class V>
[[gnu::always_inline]] inline V SweepElements<V>::reconstructed(const double* u, std::ptrdiff_t f) const {
    const FaceStencil<Dim, Real>& stencil = tables.stencils[f];
    const Double u_0 = load<Double>(u, stencil.cells[0]);
    V sum = units.displacement(u_0 - load<Double>(u, tables.face_cells[f][0]));
    for (int j = 1; j <= Dim; ++j) sum += stencil.weights[j] * units.displacement(load<Double>(u, stencil.cells[j]) - u_0);
    return sum;
}

/// relative(f): u_f less that of its first side.
template <class V>
template <class Relative>
[[gnu::always_inline]] inline TensorOf<V> SweepElements<V>::gradient_of(const double* u, std::ptrdiff_t c,
                                                                        const Relative& relative) const {
    const Double u_c = load<Double>(u, c);
    Tensor g{};
    for (std::int32_t i = tables.half_face_offsets[c]; i < tables.half_face_offsets[c + 1]; ++i) {
        const HalfFace& half_face = tables.half_faces[i];
        const Real sign = half_face.first == c ? 1 : -1;
        g.add_outer(sign * (relative(half_face.face) + units.displacement(load<Double>(u, half_face.first) - u_c)),
                    tables.faces[half_face.face].area_vector);
    }
    for (V& column : g.col) column = tables.cells[c].inverse_measure * column;
    return g;
}

template <class V>
[[gnu::always_inline]] inline void SweepElements<V>::set_traces(std::ptrdiff_t c, const Tensor& g) const {
    const Double u_c = load<Double>(tables.u.data, c);
    for (std::int32_t i = tables.half_face_offsets[c]; i < tables.half_face_offsets[c + 1]; ++i)
        store(g.times(tables.lever_arms[i]) +
                  units.displacement(u_c - load<Double>(tables.u.data, tables.half_faces[i].first)),
              tables.trace.data, i);
}

template <class V>
[[gnu::always_inline]] inline void SweepElements<V>::set_displacement_gradient(std::ptrdiff_t c) const {
    const Tensor g = gradient_of(tables.u.data, c, [&](std::int32_t f) { return load<V>(tables.of_face.data, f); });
    store_tensor(g, tables.g.data, c);
    set_traces(c, g);
}

/// Sets the sum of k [u], and returns that of k [u] (x) (x_f - x_c) over |c|.
template <class V>
[[gnu::always_inline]] inline TensorOf<V> SweepElements<V>::sum_jumps(std::ptrdiff_t c) const {
    Tensor sum{};
    V direct;
    for (std::int32_t i = tables.half_face_offsets[c]; i < tables.half_face_offsets[c + 1]; ++i) {
        const HalfFace& half_face = tables.half_faces[i];
        const V jump_gradient = tables.faces[half_face.face].jump_stiffness *
                                (load<V>(tables.trace.data, i) - load<V>(tables.trace.data, half_face.twin));
        sum.add_outer(jump_gradient, tables.lever_arms[i]);
        direct += jump_gradient;
    }
    store(direct, tables.direct.data, c);
    for (V& column : sum.col) column = tables.cells[c].inverse_measure * column;
    return sum;
}

template <class V>
[[gnu::always_inline]] inline void SweepElements<V>::set_stress(std::ptrdiff_t c) const {
    Tensor sum = sum_jumps(c);
    const Tensor sigma = elastic_stress(tables.cells[c], load_tensor<V>(tables.g.data, c));
    for (int j = 0; j < Dim; ++j) sum.col[j] = sigma.col[j] + sum.col[j];
    store_tensor(sum, tables.s.data, c);
}

/// û_b - u_c by the row of R.
template <class V>
inline V SweepElements<V>::reconstructed_row(const double* u, BoundaryFace face) const {
    const Double origin = load<Double>(u, tables.cell_of(face));
    const std::int32_t b = number_of(face);
    V sum;
    for (std::int32_t i = tables.row_offsets[b]; i < tables.row_offsets[b + 1]; ++i)
        sum +=
            load_tensor<V>(tables.row_weights.data, i) * units.displacement(load<Double>(u, tables.row_cells[i]) - origin);
    sum += load<V>(tables.correction.data, b);
    if (tables.load_displacement.size == 0) return sum;
    Double missing;
    for (int j = 0; j < Dim; ++j) missing += origin[j] * gathered(tables.deficit, std::ptrdiff_t{Dim} * b + j);
    return sum + units.displacement(gathered(tables.load_displacement, b) - missing);
}

/// Motion of a face of AffineTraces, by its index, from where it is reconstructed to where the cells around point.
template <class V>
inline V SweepElements<V>::affine_motion(std::int32_t i) const {
    const std::int32_t f = tables.face_of(tables.affine_faces[i]);
    return load_tensor<V>(tables.affine_parts.data, i) * (reconstructed(tables.u.data, f) - load<V>(tables.of_face.data, f));
}

/// The traces of the cell with its free faces where the cells around point; these faces have been reconstructed.
template <class V>
inline void SweepElements<V>::set_affine_traces(const AffineCell& cell) const {
    const std::int32_t c = cell.cell;
    Tensor g = load_tensor<V>(tables.g.data, c);
    for (std::int32_t i = cell.begin; i < cell.end; ++i)
        g.add_outer(tables.cells[c].inverse_measure * affine_motion(i),
                    tables.faces[tables.face_of(tables.affine_faces[i])].area_vector);
    set_traces(c, g);
}

/// Adds the gradients of jumps at affine faces in place of those at reconstructed ones; to be called before other terms
/// of the stress.
template <class V>
inline void SweepElements<V>::set_affine_gradients(const AffineCell& cell) const {
    const std::int32_t c = cell.cell;
    Tensor of_jumps = load_tensor<V>(tables.s.data, c);
    const Tensor sigma = elastic_stress(tables.cells[c], load_tensor<V>(tables.g.data, c));
    for (int j = 0; j < Dim; ++j) of_jumps.col[j] -= sigma.col[j];
    for (std::int32_t i = cell.begin; i < cell.end; ++i) {
        const V y = of_jumps.times(tables.faces[tables.face_of(tables.affine_faces[i])].area_vector);
        store(load_tensor<V>(tables.affine_parts.data, i) * y, tables.affine_y.data, i);
    }
}

template <class V>
[[gnu::always_inline]] inline V SweepElements<V>::interior_gradient(std::ptrdiff_t f) const {
    const auto [a, b] = tables.face_cells[f];
    Tensor difference = load_tensor<V>(tables.s.data, a);
    const Tensor other = load_tensor<V>(tables.s.data, b);
    for (int j = 0; j < Dim; ++j) difference.col[j] -= other.col[j];
    return difference.times(tables.faces[f].area_vector);
}

template <class V>
inline V SweepElements<V>::boundary_gradient(BoundaryFace face) const {
    const std::int32_t f = tables.face_of(face), b = number_of(face), c = tables.face_cells[f][0];
    V gradient = load_tensor<V>(tables.s.data, c).times(tables.faces[f].area_vector) + load<V>(tables.pair_gradient.data, b);
    if (tables.of_simplices(c)) gradient -= shared_jumps(f, c, false);
    if (const std::int32_t i = tables.affine_index_of(face); i >= 0) gradient -= load<V>(tables.affine_y.data, i);
    return tables.traction.size == 0 ? gradient : gradient - units.force(gathered(tables.traction, b));
}

// What cells receive is summed in double.

template <class V>
[[gnu::always_inline]] inline auto SweepElements<V>::cell_gradient(std::ptrdiff_t c) const -> Double {
    Double sum = in_double(load<V>(tables.direct.data, c));
    for (std::int32_t i = tables.of_cell_offsets[c]; i < tables.of_cell_offsets[c + 1]; ++i)
        sum += tables.of_cell_weights[i] * in_double(load<V>(tables.of_face.data, tables.of_cell_rows[i]));
    return units.in_newtons(sum);
}

template <class V>
inline auto SweepElements<V>::boundary_cell_gradient(std::ptrdiff_t position) const -> Double {
    Double sum;
    for (std::int32_t i = tables.of_boundary_cell_offsets[position]; i < tables.of_boundary_cell_offsets[position + 1]; ++i)
        sum += in_double(load_tensor<V>(tables.of_boundary_cell_weights.data, i) *
                         load<V>(tables.boundary_y.data, number_of(tables.of_boundary_cell_rows[i])));
    if (tables.of_affine_offsets.size > 0)
        for (std::int32_t i = tables.of_affine_offsets[position]; i < tables.of_affine_offsets[position + 1]; ++i)
            sum += tables.of_affine_weights[i] * in_double(load<V>(tables.affine_y.data, tables.of_affine_rows[i]));
    return units.in_newtons(sum);
}

}  // namespace abut::solid
