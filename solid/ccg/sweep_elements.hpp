#pragma once
// Private to the sources of this layer.
#include "abut/solid/ccg/sweeps.hpp"

// What the sweeps do with one element, for the sources that need it inlined.

namespace abut::solid {

/// sigma of linear elasticity for the displacement gradient g.
template <int Dim, class Real>
[[nodiscard]] inline LaneTensor<Dim, Real> elastic_stress(const CellGeometry<Dim, Real>& cell,
                                                          const LaneTensor<Dim, Real>& g) {
    const LaneTensor<Dim, Real> transposed = g.transposed();
    Real trace = 0;
    for (int j = 0; j < Dim; ++j) trace += g.col[j][j];
    LaneTensor<Dim, Real> sigma;
    for (int j = 0; j < Dim; ++j) {
        Lanes<Dim, Real> unit;
        unit.r[j] = 1;
        sigma.col[j] = cell.mu * (g.col[j] + transposed.col[j]) + (cell.lambda * trace) * unit;
    }
    return sigma;
}

// Displacements enter by their differences to that of a cell nearby, which are taken in double whatever Real is: a translation
// of the body costs no accuracy.

/// Of a face of a simplex in the mean of all of them.
template <int Dim, class Real>
inline constexpr Real simplex_share = Real{1} / (Dim + 1);

template <int Dim, class Real>
[[gnu::always_inline]] inline Lanes<Dim, Real> CcgSweeps<Dim, Real>::reconstructed(const LargeArray<double>& u,
                                                                                   std::ptrdiff_t f) const {
    const FaceStencil<Dim, Real>& stencil = coefficients_.stencils[f];
    const Lanes<Dim> u_0 = load_packed<Dim>(u, stencil.cells[0]);
    Lanes<Dim, Real> sum = units_.displacement(u_0 - load_packed<Dim>(u, arrays_.face_cells[f][0]));
    for (int j = 1; j <= Dim; ++j)
        sum += stencil.weights[j] * units_.displacement(load_packed<Dim>(u, stencil.cells[j]) - u_0);
    return sum;
}

/// relative(f): u_f less that of its first side.
template <int Dim, class Real>
template <class Relative>
[[gnu::always_inline]] inline LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::gradient_of(const LargeArray<double>& u,
                                                                                      std::ptrdiff_t c,
                                                                                      const Relative& relative) const {
    const Lanes<Dim> u_c = load_packed<Dim>(u, c);
    LaneTensor<Dim, Real> g{};
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i) {
        const HalfFace& half_face = arrays_.half_faces[i];
        const Real sign = half_face.first == c ? 1 : -1;
        g.add_outer(sign * (relative(half_face.face) + units_.displacement(load_packed<Dim>(u, half_face.first) - u_c)),
                    coefficients_.faces[half_face.face].area_vector);
    }
    for (Lanes<Dim, Real>& column : g.col) column = coefficients_.cells[c].inverse_measure * column;
    return g;
}

template <int Dim, class Real>
[[gnu::always_inline]] inline void CcgSweeps<Dim, Real>::set_traces(std::ptrdiff_t c, const LaneTensor<Dim, Real>& g) {
    const Lanes<Dim> u_c = displacement(c);
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i)
        store(g.times(coefficients_.lever_arms[i]) + units_.displacement(u_c - displacement(arrays_.half_faces[i].first)),
              trace_, i);
}

template <int Dim, class Real>
[[gnu::always_inline]] inline void CcgSweeps<Dim, Real>::set_displacement_gradient(std::ptrdiff_t c) {
    const LaneTensor<Dim, Real> g = gradient_of(u_, c, [&](std::int32_t f) { return load_packed<Dim>(of_face_, f); });
    store_tensor(g, g_, c);
    set_traces(c, g);
}

/// Sets the sum of k [u], and returns that of k [u] (x) (x_f - x_c) over |c|.
template <int Dim, class Real>
[[gnu::always_inline]] inline LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::sum_jumps(std::ptrdiff_t c) {
    LaneTensor<Dim, Real> sum{};
    Lanes<Dim, Real> direct;
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i) {
        const HalfFace& half_face = arrays_.half_faces[i];
        const Lanes<Dim, Real> jump_gradient = coefficients_.faces[half_face.face].jump_stiffness *
                                               (load_packed<Dim>(trace_, i) - load_packed<Dim>(trace_, half_face.twin));
        sum.add_outer(jump_gradient, coefficients_.lever_arms[i]);
        direct += jump_gradient;
    }
    store(direct, direct_, c);
    for (Lanes<Dim, Real>& column : sum.col) column = coefficients_.cells[c].inverse_measure * column;
    return sum;
}

template <int Dim, class Real>
[[gnu::always_inline]] inline void CcgSweeps<Dim, Real>::set_stress(std::ptrdiff_t c) {
    LaneTensor<Dim, Real> sum = sum_jumps(c);
    const LaneTensor<Dim, Real> sigma = elastic_stress(coefficients_.cells[c], load_tensor<Dim>(g_, c));
    for (int j = 0; j < Dim; ++j) sum.col[j] = sigma.col[j] + sum.col[j];
    store_tensor(sum, s_, c);
}

template <int Dim, class Real>
inline Lanes<Dim, Real> CcgSweeps<Dim, Real>::reconstructed_boundary(const LargeArray<double>& u, BoundaryFace face,
                                                                     const BoundaryLoad<Dim>& boundary_load) const {
    const BoundaryReconstruction<Dim>& boundary = arrays_.boundary;
    const Lanes<Dim> origin = load_packed<Dim>(u, arrays_.cell_of(face));
    const std::int32_t b = number_of(face);
    Lanes<Dim, Real> sum;
    for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
        sum += coefficients_.boundary_weights[i] * units_.displacement(load_packed<Dim>(u, boundary.cells[i]) - origin);
    sum += load_packed<Dim>(correction_, b);
    if (boundary_load.displacement.empty()) return sum;
    return sum + units_.displacement(load_packed<Dim>(
                     Vector<Dim>(boundary_load.displacement[b] - boundary.deficit[b] * unload<Dim>(origin))));
}

template <int Dim, class Real>
[[gnu::always_inline]] inline Lanes<Dim, Real> CcgSweeps<Dim, Real>::interior_gradient(std::ptrdiff_t f) const {
    const auto [a, b] = arrays_.face_cells[f];
    LaneTensor<Dim, Real> difference = load_tensor<Dim>(s_, a);
    const LaneTensor<Dim, Real> other = load_tensor<Dim>(s_, b);
    for (int j = 0; j < Dim; ++j) difference.col[j] -= other.col[j];
    return difference.times(coefficients_.faces[f].area_vector);
}

template <int Dim, class Real>
inline Lanes<Dim, Real> CcgSweeps<Dim, Real>::boundary_gradient(BoundaryFace face,
                                                                const BoundaryLoad<Dim>& boundary_load) const {
    const std::int32_t f = arrays_.face_of(face), b = number_of(face), c = arrays_.face_cells[f][0];
    Lanes<Dim, Real> gradient =
        load_tensor<Dim>(s_, c).times(coefficients_.faces[f].area_vector) + load_packed<Dim>(pair_gradient_, b);
    if (arrays_.simplices.contains(c)) gradient -= simplex_share<Dim, Real> * load_packed<Dim>(direct_, c);
    return boundary_load.traction.empty() ? gradient : gradient - units_.force(load_packed<Dim>(boundary_load.traction[b]));
}

// What cells receive is summed in double.

template <int Dim, class Real>
[[gnu::always_inline]] inline Lanes<Dim> CcgSweeps<Dim, Real>::cell_gradient(std::ptrdiff_t c) const {
    const auto& [offsets, rows] = arrays_.of_cell;
    const auto& weights = coefficients_.of_cell_weights;
    Lanes<Dim> sum = converted<double>(load_packed<Dim>(direct_, c));
    for (std::int32_t i = offsets[c]; i < offsets[c + 1]; ++i)
        sum += weights[i] * converted<double>(load_packed<Dim>(of_face_, rows[i]));
    return units_.in_newtons(sum);
}

template <int Dim, class Real>
inline Lanes<Dim> CcgSweeps<Dim, Real>::boundary_cell_gradient(std::ptrdiff_t position) const {
    const auto& [offsets, rows] = arrays_.of_boundary_cell;
    const auto& weights = coefficients_.boundary_cell_weights;
    Lanes<Dim> sum;
    for (std::int32_t i = offsets[position]; i < offsets[position + 1]; ++i)
        sum += converted<double>(weights[i] * load_packed<Dim>(boundary_y_, number_of(rows[i])));
    return units_.in_newtons(sum);
}

}  // namespace abut::solid
