#pragma once
// Private to the sources of this layer.
#include "abut/solid/ccg/sweeps.hpp"

// What the sweeps do with one element, for the sources that need it inlined.

namespace abut::solid {

/// sigma of linear elasticity for the displacement gradient g.
template <int Dim>
[[nodiscard]] inline LaneTensor<Dim> elastic_stress(const CellGeometry<Dim>& cell, const LaneTensor<Dim>& g) {
    const LaneTensor<Dim> transposed = g.transposed();
    double trace = 0.0;
    for (int j = 0; j < Dim; ++j) trace += g.col[j][j];
    LaneTensor<Dim> sigma;
    for (int j = 0; j < Dim; ++j) {
        sigma.col[j] = cell.mu * (g.col[j] + transposed.col[j]);
        sigma.col[j].r[j] += cell.lambda * trace;
    }
    return sigma;
}

template <int Dim>
[[gnu::always_inline]] inline Lanes<Dim> CcgSweeps<Dim>::reconstructed(const std::vector<double>& u,
                                                                       std::ptrdiff_t f) const {
    const FaceStencil<Dim>& stencil = arrays_.stencils[f];
    const Lanes<Dim> origin = load_packed<Dim>(u, arrays_.face_cells[f][0]);
    Lanes<Dim> sum;
    for (int j = 0; j <= Dim; ++j) sum += stencil.weights[j] * (load_packed<Dim>(u, stencil.cells[j]) - origin);
    return sum;
}

template <int Dim>
[[gnu::always_inline]] inline LaneTensor<Dim> CcgSweeps<Dim>::gradient_of(const std::vector<double>& u,
                                                                          const std::vector<double>& relative,
                                                                          std::ptrdiff_t c) const {
    const Lanes<Dim> u_c = load_packed<Dim>(u, c);
    LaneTensor<Dim> g{};
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i) {
        const HalfFace& half_face = arrays_.half_faces[i];
        const double sign = half_face.first == c ? 1.0 : -1.0;
        g.add_outer(sign * (load_packed<Dim>(relative, half_face.face) + (load_packed<Dim>(u, half_face.first) - u_c)),
                    arrays_.faces[half_face.face].area_vector);
    }
    for (Lanes<Dim>& column : g.col) column = arrays_.cells[c].inverse_measure * column;
    return g;
}

template <int Dim>
[[gnu::always_inline]] inline void CcgSweeps<Dim>::set_traces(std::ptrdiff_t c, const LaneTensor<Dim>& g) {
    const Lanes<Dim> u_c = displacement(c);
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i)
        store(g.times(arrays_.lever_arms[i]) + (u_c - displacement(arrays_.half_faces[i].first)), trace_, i);
}

template <int Dim>
[[gnu::always_inline]] inline void CcgSweeps<Dim>::set_displacement_gradient(std::ptrdiff_t c) {
    const LaneTensor<Dim> g = gradient_of(u_, relative_, c);
    store_tensor(g, g_, c);
    set_traces(c, g);
}

/// Sets the sum of k [u], and returns that of k [u] (x) (x_f - x_c) over |c|.
template <int Dim>
[[gnu::always_inline]] inline LaneTensor<Dim> CcgSweeps<Dim>::sum_jumps(std::ptrdiff_t c) {
    LaneTensor<Dim> sum{};
    Lanes<Dim> direct;
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i) {
        const HalfFace& half_face = arrays_.half_faces[i];
        const Lanes<Dim> jump_gradient = arrays_.faces[half_face.face].jump_stiffness *
                                         (load_packed<Dim>(trace_, i) - load_packed<Dim>(trace_, half_face.twin));
        sum.add_outer(jump_gradient, arrays_.lever_arms[i]);
        direct += jump_gradient;
    }
    store(direct, direct_, c);
    for (Lanes<Dim>& column : sum.col) column = arrays_.cells[c].inverse_measure * column;
    return sum;
}

template <int Dim>
[[gnu::always_inline]] inline void CcgSweeps<Dim>::set_stress(std::ptrdiff_t c) {
    LaneTensor<Dim> sum = sum_jumps(c);
    const LaneTensor<Dim> sigma = elastic_stress(arrays_.cells[c], load_tensor<Dim>(g_, c));
    for (int j = 0; j < Dim; ++j) sum.col[j] = sigma.col[j] + sum.col[j];
    store_tensor(sum, s_, c);
}

}  // namespace abut::solid
