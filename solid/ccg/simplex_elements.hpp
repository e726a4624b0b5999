#pragma once
// Private to the sources of this layer.
#include <algorithm>

#include "abut/solid/ccg/sweep_elements.hpp"

// What the sweeps do with one element of a body of simplices, for the sources that need it inlined.

namespace abut::solid {

/// A_bb^-1 t/|c|: how a free face gives way to a force.
template <int Dim, class Real>
[[nodiscard]] inline Lanes<Dim, Real> free_face_compliance(const CellGeometry<Dim, Real>& cell,
                                                           const FaceGeometry<Dim, Real>& face, Lanes<Dim, Real> t) {
    Real along = 0, square = 0;
    Lanes<Dim, Real> area;
    for (int j = 0; j < Dim; ++j) {
        area.r[j] = face.area_vector[j];
        along += t[j] * area[j];
        square += area[j] * area[j];
    }
    const Real contracted = (cell.lambda + cell.mu) / (cell.lambda + 2 * cell.mu) * along / square;
    return 1 / (cell.mu * square) * (t - contracted * area);
}

/// sigma_c and the sum of u_f - u_c; relative(f): u_f less that of its first side.
template <int Dim, class Real>
template <class Relative>
[[gnu::always_inline]] inline SimplexState<Dim, Real> CcgSweeps<Dim, Real>::simplex_state(const LargeArray<double>& u,
                                                                                          std::int32_t c,
                                                                                          const Relative& relative) const {
    const SimplexCell<Dim>& simplex = arrays_.simplices[c];
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    const Lanes<Dim> u_c = load_packed<Dim>(u, c);
    const auto at_face = [&](std::size_t i) {
        return relative(simplex.faces[i]) +
               units_.displacement(load_packed<Dim>(u, std::min(c, simplex.neighbours[i])) - u_c);
    };
    const Lanes<Dim, Real> at_0 = at_face(0);  // the area vectors of the cell sum to zero: the others less this one
    LaneTensor<Dim, Real> g{};
    Lanes<Dim, Real> sum = at_0;
    for (std::size_t i = 1; i <= Dim; ++i) {
        const Lanes<Dim, Real> at_i = at_face(i);
        sum += at_i;
        g.add_outer(Real(simplex.neighbours[i] < c ? -1 : 1) * (at_i - at_0),
                    coefficients_.faces[simplex.faces[i]].area_vector);
    }
    for (Lanes<Dim, Real>& column : g.col) column = cell.inverse_measure * column;
    return {elastic_stress(cell, g), sum};
}

/// sigma_c and d_c; of a condensed cell without its free face.
template <int Dim, class Real>
[[gnu::always_inline]] inline void CcgSweeps<Dim, Real>::set_simplex_stress(std::int32_t c) {
    const auto [stress, sum] = simplex_state(u_, c, [&](std::int32_t f) { return load_packed<Dim>(of_face_, f); });
    store_tensor(stress, s_, c);
    store(-simplex_share<Dim, Real> * sum, deviation_, c);
}

/// û_b - u_c = -A_bb^-1 sigma' |b| n_b of the free face, loads and corrections beside it.
template <int Dim, class Real>
inline Lanes<Dim, Real> CcgSweeps<Dim, Real>::condensed_face(const CondensedCell& condensed,
                                                             const LaneTensor<Dim, Real>& stress,
                                                             const BoundaryLoad<Dim>& boundary_load) const {
    const auto [c, b] = condensed;
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    const FaceGeometry<Dim, Real>& face = coefficients_.faces[arrays_.face_of(b)];
    const Lanes<Dim, Real> sum =
        load_packed<Dim>(correction_, number_of(b)) -
        (1 / cell.inverse_measure) * free_face_compliance(cell, face, stress.times(face.area_vector));
    if (boundary_load.displacement.empty()) return sum;
    return sum + units_.displacement(load_packed<Dim>(boundary_load.displacement[number_of(b)]));
}

/// Puts the free face of a condensed cell where it belongs, and sigma_c and d_c with it.
template <int Dim, class Real>
inline void CcgSweeps<Dim, Real>::add_condensed_face(const CondensedCell& condensed,
                                                     const BoundaryLoad<Dim>& boundary_load) {
    const auto [c, b] = condensed;
    LaneTensor<Dim, Real> stress = load_tensor<Dim>(s_, c);
    const Lanes<Dim, Real> at_face = condensed_face(condensed, stress, boundary_load);
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    LaneTensor<Dim, Real> g{};
    g.add_outer(cell.inverse_measure * at_face, coefficients_.faces[arrays_.face_of(b)].area_vector);
    const LaneTensor<Dim, Real> added = elastic_stress(cell, g);
    for (int j = 0; j < Dim; ++j) stress.col[j] += added.col[j];
    store(at_face, of_face_, arrays_.face_of(b));
    store_tensor(stress, s_, c);
    store(load_packed<Dim>(deviation_, c) - simplex_share<Dim, Real> * at_face, deviation_, c);
}

/// D_c.
template <int Dim, class Real>
[[gnu::always_inline]] inline void CcgSweeps<Dim, Real>::set_simplex_jumps(std::int32_t c) {
    const SimplexCell<Dim>& simplex = arrays_.simplices[c];
    const Lanes<Dim, Real> d_c = load_packed<Dim>(deviation_, c);
    Lanes<Dim, Real> sum;
    for (std::size_t i = 0; i <= Dim; ++i)
        sum += coefficients_.faces[simplex.faces[i]].jump_stiffness *
               (d_c - load_packed<Dim>(deviation_, simplex.neighbours[i]));
    store(sum, direct_, c);
}

template <int Dim, class Real>
[[gnu::always_inline]] inline Lanes<Dim, Real> CcgSweeps<Dim, Real>::interior_gradient_of_simplices(std::ptrdiff_t f) const {
    const auto [a, b] = arrays_.face_cells[f];
    return interior_gradient(f) - simplex_share<Dim, Real> * (load_packed<Dim>(direct_, a) + load_packed<Dim>(direct_, b));
}

/// Sets y of the free face, and lets the stress of its cell answer.
template <int Dim, class Real>
inline void CcgSweeps<Dim, Real>::condense(const CondensedCell& condensed, const BoundaryLoad<Dim>& boundary_load) {
    const auto [c, b] = condensed;
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    const FaceGeometry<Dim, Real>& face = coefficients_.faces[arrays_.face_of(b)];
    const Lanes<Dim, Real> y = boundary_gradient(b, boundary_load);
    store(y, boundary_y_, number_of(b));
    LaneTensor<Dim, Real> g{};
    g.add_outer(free_face_compliance(cell, face, y), face.area_vector);
    const LaneTensor<Dim, Real> answer = elastic_stress(cell, g);
    LaneTensor<Dim, Real> sigma = load_tensor<Dim>(s_, c);
    for (int j = 0; j < Dim; ++j) sigma.col[j] -= answer.col[j];
    store_tensor(sigma, s_, c);
}

}  // namespace abut::solid
