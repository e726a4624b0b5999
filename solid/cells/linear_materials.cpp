#include "abut/solid/cells/linear_materials.hpp"

#include <optional>

#include "abut/solid/cells/simplex_elements.hpp"

// docs/method.md, Metal that yields; Damping and viscosity; Temperature.

namespace abut::solid {

// Directions and heat ------------------------------------------------------------------------------------------------

/// Other moduli, less thermal stress.
template <int Dim>
Matrix<Dim> LinearMaterials<Dim>::stress_of_material(std::int32_t c, const Matrix<Dim>& g) const {
    Matrix<Dim> stress = Matrix<Dim>::Zero();
    if (state_.arrays.directed.contains(c)) stress += state_.arrays.directed[c].stress(g);
    if (is_warm()) stress -= rise_of(c) * thermal_.stress(c);
    return stress;
}

template <int Dim>
void LinearMaterials<Dim>::add_stress_of_material(std::int32_t c) {
    const bool is_directed = state_.arrays.directed.contains(c);
    state_.add_stress(c,
                      stress_of_material(c, is_directed ? unload(load_tensor<Dim>(state_.work.g, c)) : Matrix<Dim>::Zero()));
}

// Flow and damping ---------------------------------------------------------------------------------------------------

/// C : eps, before the stress of the cell has anything beside.
template <int Dim>
Matrix<Dim> LinearMaterials<Dim>::elastic_stress_of_stage(std::int32_t c) const {
    if (state_.arrays.simplices.contains(c)) return unload(load_tensor<Dim>(state_.work.s, c));
    return unload(elastic_stress(state_.coefficients.cells[c], load_tensor<Dim>(state_.work.g, c)));
}

template <int Dim>
void LinearMaterials<Dim>::let_flow(std::span<const Run> cells) {
    ChangeInStep<Dim, double>& change = state_.change;
    if (!change.of_linear() || !plastic_.any()) return;
    for_runs(cells, [&](std::int32_t c) {  // for its own stress, and for the jumps of its neighbours
        change.prepare_gradient(c, !change.follows() && capped_.contains(c));
        if (plastic_.contains(c)) flow(c);
    });
}

/// Lets a cell flow in a step whose middle its gradient is in.
template <int Dim>
void LinearMaterials<Dim>::flow(std::int32_t c) {
    if (plastic_.moves_faces(c)) set_push_of_contact(c);
    const Matrix<Dim> elastic = elastic_stress_of_stage(c);
    if (state_.change.follows() && plastic_.stays_elastic(c, elastic)) return;
    state_.change.ask(c);
    plastic_.advance(c, elastic, state_.change.gradient(c), state_.dt);
}

template <int Dim>
void LinearMaterials<Dim>::set_push_of_contact(std::int32_t c) {
    Matrix<Dim> moment = Matrix<Dim>::Zero();
    state_.moments.for_each(c, c + 1, [&](std::int32_t, const CellPush<Dim>& push) { moment = push.affine; });
    plastic_.set_push(
        c, [&](BoundaryFace b) { return unload<Dim>(load_packed<Dim>(state_.work.pair_gradient, number_of(b))); }, moment);
}

/// Takes out of the stress of a cell what it lacks by flow, in a step the mean of both ends.
template <int Dim>
void LinearMaterials<Dim>::take_stress_of_flow(std::int32_t c) {
    if (state_.change.of_linear() && plastic_.flows(c))
        state_.add_stress(c, -plastic_.mean_stress(c));
    else if (plastic_.has_flowed(c))
        state_.add_stress(c, -plastic_.stress(c));
}

template <int Dim>
void LinearMaterials<Dim>::add_stress_of_step(std::int32_t c) {
    if (state_.change.of_linear() && viscous_.contains(c))
        state_.add_stress(c, viscous_.stress(c, Matrix<Dim>::Zero(), state_.change.made_gradient(c), state_.dt));
    if (plastic_.contains(c)) take_stress_of_flow(c);
}

template <int Dim>
void LinearMaterials<Dim>::add_stresses(std::span<const Run> cells) {
    if (state_.change.of_linear() || plastic_.any()) for_runs(cells, [&](std::int32_t c) { add_stress_of_step(c); });
    if (has_stress_of_material()) for_runs(cells, [&](std::int32_t c) { add_stress_of_material(c); });
}

// Jumps that last ----------------------------------------------------------------------------------------------------

/// Change in the step of the gradient that the traces of a cell have.
template <int Dim>
Matrix<Dim> LinearMaterials<Dim>::trace_change(std::int32_t c) const {
    const CcgCoefficients<Dim, double>& coefficients = state_.coefficients;
    Matrix<Dim> change = state_.change.gradient(c);
    for (const BoundaryFace b : state_.arrays.affine_faces_of(c)) {
        const std::int32_t f = state_.arrays.face_of(b), i = state_.element.tables.affine_index_of(b);
        const Lanes<Dim> moved = coefficients.affine_parts[static_cast<std::size_t>(i)] *
                                 (state_.change.reconstructed(f) - state_.change.of_face(b));
        change += coefficients.cells[c].inverse_measure * unload(moved) *
                  Vector<Dim>(state_.arrays.faces[f].area_vector.data()).transpose();
    }
    return change;
}

/// Change of [u] in the step, where the gradient of the traces of the cell changes by `of_cell`.
template <int Dim>
Vector<Dim> LinearMaterials<Dim>::jump_change(std::int32_t c, std::int32_t half_face, const Matrix<Dim>& of_cell) const {
    const HalfFace& half = state_.arrays.half_faces[half_face];
    const auto [first, second] = state_.arrays.face_cells[half.face];
    const auto of_trace = [&](const Matrix<Dim>& change, std::int32_t half_of_cell) {
        return load_packed<Dim>(change).times(state_.coefficients.lever_arms[half_of_cell]);
    };
    const std::int32_t other = c == first ? second : first;
    const Matrix<Dim> of_other = trace_change(other);
    return unload(of_trace(of_cell, half_face) - of_trace(of_other, half.twin) +
                  (state_.change.of_cell(c) - state_.change.of_cell(other)));
}

/// Change of what lasts of [u] in the step as the free faces of both cells flow along: traces have them where they
/// would be without flow, except for affine ones.
template <int Dim>
Vector<Dim> LinearMaterials<Dim>::jump_of_flow(std::int32_t c, std::int32_t half_face) const {
    if (!plastic_.any_flowed()) return Vector<Dim>::Zero();
    const auto of_trace = [&](std::int32_t cell, std::int32_t half_of_cell) -> Vector<Dim> {
        if (!plastic_.tilts(cell) || !state_.arrays.affine_faces_of(cell).empty()) return Vector<Dim>::Zero();
        return plastic_.tilt_change(cell) * Vector<Dim>(state_.arrays.lever_arms[half_of_cell].data());
    };
    const HalfFace& half = state_.arrays.half_faces[half_face];
    const auto [first, second] = state_.arrays.face_cells[half.face];
    return of_trace(c == first ? second : first, half.twin) - of_trace(c, half_face);
}

template <int Dim>
void LinearMaterials<Dim>::remove_lasting_jumps(std::span<const Run> cells) {
    if (!capped_.any()) return;
    for_runs(cells, [&](std::int32_t c) { remove_lasting_jumps(c); });
}

/// In a step the mean of both ends.
template <int Dim>
void LinearMaterials<Dim>::remove_jumps_of(std::int32_t c) {
    const CcgArrays<Dim>& arrays = state_.arrays;
    ChangeInStep<Dim, double>& in_step = state_.change;
    if (in_step.of_linear()) capped_.begin(c);
    LaneTensor<Dim> sum{};
    Lanes<Dim> direct{};
    bool any = false;
    std::optional<Matrix<Dim>> change;  // of the gradient of its traces, once it is asked for
    const auto mean_of_step = [&](std::int32_t i) -> Vector<Dim> {
        const Vector<Dim> of_flow = jump_of_flow(c, i);
        const bool is_still = of_flow.isZero(0.0);
        if (is_still && !capped_.has_cap(i)) return capped_.keep(i);
        const Vector<Dim> mean = unload(state_.jump(c, i));
        if (in_step.follows() && is_still && capped_.stays_elastic(i, mean)) return capped_.lasting(i);
        if (!change) change = trace_change(c);
        in_step.ask(c);
        return capped_.advance(c, i, mean, jump_change(c, i, *change), of_flow);
    };
    for (std::int32_t i = arrays.half_face_offsets[c]; i < arrays.half_face_offsets[c + 1]; ++i) {
        if (!capped_.may_last(i)) continue;
        const Vector<Dim> lasting = in_step.of_linear() ? mean_of_step(i) : capped_.lasting(i);
        if (lasting.isZero(0.0)) continue;
        any = true;
        const Lanes<Dim> gradient =
            state_.coefficients.faces[arrays.half_faces[i].face].jump_stiffness * load_packed<Dim>(lasting);
        direct += gradient;
        sum.add_outer(gradient, state_.coefficients.lever_arms[i]);
    }
    if (!any) return;
    store(load_packed<Dim>(state_.work.direct, c) - direct, state_.work.direct, c);
    if (!arrays.simplices.contains(c)) state_.add_stress(c, -state_.coefficients.cells[c].inverse_measure * unload(sum));
}

// One cell in a state ------------------------------------------------------------------------------------------------

template <int Dim>
void LinearMaterials<Dim>::add_stress_of_state(std::int32_t c) {
    if (has_stress_of_material()) add_stress_of_material(c);
    if (plastic_.contains(c)) state_.add_stress(c, -plastic_.stress(c));
}

template <int Dim>
Matrix<Dim> LinearMaterials<Dim>::stress(std::int32_t c) const {
    const LaneTensor<Dim> g = state_.element.present_gradient(c);
    Matrix<Dim> stress = unload(elastic_stress(state_.coefficients.cells[c], g));
    if (has_stress_of_material() || plastic_.any()) stress += stress_of_material(c, unload(g));
    if (plastic_.contains(c)) stress -= plastic_.stress(c);
    return stress;
}

template <int Dim>
double LinearMaterials<Dim>::twice_energy_density(std::int32_t c, double elastic) const {
    const auto relative = [&](std::int32_t f) { return load_packed<Dim>(state_.work.of_face, f); };
    const bool simplices = state_.arrays.simplices.contains(c);
    const Matrix<Dim> g = unload(simplices ? state_.element.gradient_of(state_.work.u.data(), c, relative)
                                           : load_tensor<Dim>(state_.work.g, c));
    double density = elastic;
    if (state_.arrays.directed.contains(c)) density += state_.arrays.directed[c].stress(g).cwiseProduct(g).sum();
    if (is_warm()) density += thermal_.twice_energy(c, rise_of(c), g);
    if (plastic_.contains(c)) density += 2.0 * plastic_.energy(c, g);
    return density;
}

template class LinearMaterials<2>;
template class LinearMaterials<3>;

}  // namespace abut::solid
