#include <optional>

#include "abut/solid/ccg/sweeps.hpp"

// What the sweeps do with jumps between cells whose stabilisation yields. docs/method.md, Metal that yields.

namespace abut::solid {

/// [u] as the cell sees it.
template <int Dim, class Real>
Lanes<Dim, Real> CcgSweeps<Dim, Real>::jump(std::int32_t c, std::int32_t half_face) const {
    const HalfFace& half = arrays_.half_faces[half_face];
    if (!arrays_.simplices.contains(c))
        return load_packed<Dim>(work_.trace, half_face) - load_packed<Dim>(work_.trace, half.twin);
    const auto [first, second] = arrays_.face_cells[half.face];
    return load_packed<Dim>(work_.deviation, c) - load_packed<Dim>(work_.deviation, c == first ? second : first);
}

// Bodies whose strains are linear --------------------------------------------------------------------------------------

/// Change in the step of the gradient that the traces of a cell have.
template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::trace_change(std::int32_t c) const {
    Matrix<Dim> change = change_.gradient(c);
    for (const BoundaryFace b : arrays_.affine_faces_of(c)) {
        const std::int32_t f = arrays_.face_of(b), i = element_.tables.affine_index_of(b);
        const Vectors moved =
            coefficients_.affine_parts[static_cast<std::size_t>(i)] * (change_.reconstructed(f) - change_.of_face(b));
        change += coefficients_.cells[c].inverse_measure * unload(moved) *
                  Vector<Dim>(arrays_.faces[f].area_vector.data()).transpose();
    }
    return change;
}

/// Change of [u] in the step, where the gradient of the traces of the cell changes by `of_cell`.
template <int Dim, class Real>
Vector<Dim> CcgSweeps<Dim, Real>::jump_change(std::int32_t c, std::int32_t half_face, const Matrix<Dim>& of_cell) const {
    const HalfFace& half = arrays_.half_faces[half_face];
    const auto [first, second] = arrays_.face_cells[half.face];
    const auto of_trace = [&](const Matrix<Dim>& change, std::int32_t half_of_cell) {
        return load_packed<Dim>(change).times(coefficients_.lever_arms[half_of_cell]);
    };
    const std::int32_t other = c == first ? second : first;
    const Matrix<Dim> of_other = trace_change(other);
    return unload(of_trace(of_cell, half_face) - of_trace(of_other, half.twin) +
                  (change_.of_cell(c) - change_.of_cell(other)));
}

/// Change of what lasts of [u] in the step as the free faces of both cells flow along: traces have them where they
/// would be without flow, except for affine ones.
template <int Dim, class Real>
Vector<Dim> CcgSweeps<Dim, Real>::jump_of_flow(std::int32_t c, std::int32_t half_face) const {
    if (!plastic_->any_flowed()) return Vector<Dim>::Zero();
    const auto of_trace = [&](std::int32_t cell, std::int32_t half_of_cell) -> Vector<Dim> {
        if (!plastic_->tilts(cell) || !arrays_.affine_faces_of(cell).empty()) return Vector<Dim>::Zero();
        return plastic_->tilt_change(cell) * Vector<Dim>(arrays_.lever_arms[half_of_cell].data());
    };
    const HalfFace& half = arrays_.half_faces[half_face];
    const auto [first, second] = arrays_.face_cells[half.face];
    return of_trace(c == first ? second : first, half.twin) - of_trace(c, half_face);
}

/// Takes what lasts of the jumps out of those that push the cell: in a step the mean of both ends.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::add_lasting_jumps(std::int32_t c) {
    if (change_.of_linear()) capped_->begin(c);
    LaneTensor<Dim, Real> sum{};
    Vectors direct{};
    bool any = false;
    std::optional<Matrix<Dim>> change;  // of the gradient of its traces, once it is asked for
    const auto mean_of_step = [&](std::int32_t i) -> Vector<Dim> {
        const Vector<Dim> of_flow = jump_of_flow(c, i);
        const bool is_still = of_flow.isZero(0.0);
        if (is_still && !capped_->has_cap(i)) return capped_->keep(i);
        const Vector<Dim> mean = unload(jump(c, i));
        if (change_.follows() && is_still && capped_->stays_elastic(i, mean)) return capped_->lasting(i);
        if (!change) change = trace_change(c);
        change_.ask(c);
        return capped_->advance(c, i, mean, jump_change(c, i, *change), of_flow);
    };
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i) {
        if (!capped_->may_last(i)) continue;
        const Vector<Dim> lasting = change_.of_linear() ? mean_of_step(i) : capped_->lasting(i);
        if (lasting.isZero(0.0)) continue;
        any = true;
        const Vectors gradient = coefficients_.faces[arrays_.half_faces[i].face].jump_stiffness * load_packed<Dim>(lasting);
        direct += gradient;
        sum.add_outer(gradient, coefficients_.lever_arms[i]);
    }
    if (!any) return;
    store(load_packed<Dim>(work_.direct, c) - direct, work_.direct, c);
    if (!arrays_.simplices.contains(c)) add_stress(c, -coefficients_.cells[c].inverse_measure * unload(sum));
}

// Bodies of Kinematics::finite -----------------------------------------------------------------------------------------

/// F - I as the traces of the cell take it.
template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::trace_gradient(std::int32_t c) const {
    return finite_.has_condensed_traces(c) ? free_[finite_.free_position(c)].gradient()
                                           : unload(load_tensor<Dim>(work_.g, c));
}

/// The mean of both cells.
template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::gradient_at_face(std::int32_t face) const {
    const auto [first, second] = arrays_.face_cells[face];
    return 0.5 * (trace_gradient(first) + trace_gradient(second));
}

/// As SweepElements::sum_jumps, where F of both cells also moves what lasts of a jump.
template <int Dim, class Real>
LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::sum_capped_jumps(std::int32_t c, double& defect) {
    const bool advances = kept_.fills_end();
    if (advances) capped_->begin(c);
    Matrix<Dim> sum = Matrix<Dim>::Zero();
    Vector<Dim> direct = Vector<Dim>::Zero();
    for (std::int32_t i = arrays_.half_face_offsets[c]; i < arrays_.half_face_offsets[c + 1]; ++i) {
        const std::int32_t face = arrays_.half_faces[i].face;
        if (arrays_.boundary_index[face] != no_face) continue;
        const Vector<Dim> jumped = unload(jump(c, i));
        const Matrix<Dim> g = gradient_at_face(face);
        const auto elastic = advances         ? capped_->advance(c, i, jumped, g, defect)
                             : kept_.filled() ? capped_->start(i, jumped, g)
                                              : capped_->at(i, jumped, g);
        const Vector<Dim> gradient = coefficients_.faces[face].jump_stiffness * elastic.jump;
        direct += gradient;
        sum += gradient * (Vector<Dim>(coefficients_.lever_arms[i].data()) - 0.5 * elastic.lasting).transpose();
    }
    store(load_packed<Dim>(direct), work_.direct, c);
    return load_packed<Dim>(Matrix<Dim>(coefficients_.cells[c].inverse_measure * sum));
}

// Energy -----------------------------------------------------------------------------------------------------------------

/// Part of [u] without what lasts.
template <int Dim, class Real>
Lanes<Dim, Real> CcgSweeps<Dim, Real>::elastic_jump(std::int32_t c, std::int32_t half_face) const {
    const Vectors all = jump(c, half_face);
    if (!capped_ || !capped_->contains(c)) return all;
    const Matrix<Dim> g = finite_.contains(c) ? gradient_at_face(arrays_.half_faces[half_face].face) : Matrix<Dim>::Zero();
    return load_packed<Dim>(capped_->at(half_face, unload(all), g).jump);
}

#define ABUT_INSTANTIATE(Dim)                                                         \
    template void CcgSweeps<Dim>::add_lasting_jumps(std::int32_t);                    \
    template LaneTensor<Dim> CcgSweeps<Dim>::sum_capped_jumps(std::int32_t, double&); \
    template Lanes<Dim> CcgSweeps<Dim>::elastic_jump(std::int32_t, std::int32_t) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
