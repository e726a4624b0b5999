#include "abut/solid/cells/finite_pool.hpp"

#include <algorithm>
#include <cmath>

// The sweeps of finite bodies. docs/method.md, Bodies that bend.

namespace abut::solid {

template <int Dim>
FinitePool<Dim>::FinitePool(SweepState<Dim, double>& state, ViscousCells<Dim>& viscous, CappedJumps<Dim>& capped)
    : state_(state),
      cells_(state.finite),
      viscous_(viscous),
      capped_(capped),
      free_(cells_.free().size()),
      fates_(cells_.n_inelastic()),
      kept_(state.arrays, cells_) {}

// Faces --------------------------------------------------------------------------------------------------------------

template <int Dim>
void FinitePool<Dim>::reconstruct(std::span<const Run> faces, std::span<const BoundaryFace> rows) {
    const double* u = state_.work.u.data();
    const SweepElements<Lanes<Dim>>& of_rows = kept_.fills_end() ? end_element_ : state_.element;
    for_runs(faces, [&](std::int32_t f) { store(state_.element.reconstructed(u, f), state_.work.of_face, f); });
    for (const BoundaryFace b : rows) store(of_rows.reconstructed_row(u, b), state_.work.of_face, state_.arrays.face_of(b));
    if (!state_.change.of_finite()) return;
    for_runs(faces, [&](std::int32_t f) { state_.change.reconstruct_finite(f); });
    for (const BoundaryFace b : rows) state_.change.reconstruct_finite(b);
}

// Gradients ----------------------------------------------------------------------------------------------------------

template <int Dim>
void FinitePool<Dim>::set_gradient(std::int32_t c) {
    const Tensor g = state_.element.gradient_of(state_.work.u.data(), c,
                                                [&](std::int32_t f) { return load_packed<Dim>(state_.work.of_face, f); });
    store_tensor(g, state_.work.g, c);
    state_.change.set_gradient_of_finite(c);
    const std::int32_t inelastic = cells_.inelastic(c);
    if (kept_.advances() && inelastic >= 0) advance(c, inelastic, unload(g));
    if (cells_.free_position(c) < 0) return state_.element.set_traces(c, g);
    set_free_faces(c, unload(g));
    const bool condensed = cells_.has_condensed_traces(c);
    state_.element.set_traces(c, condensed ? load_packed<Dim>(trace_gradient(c)) : g);
}

/// Puts the free faces of a cell where its energy is least, `g` of affine faces.
template <int Dim>
void FinitePool<Dim>::set_free_faces(std::int32_t c, const Matrix<Dim>& g) {
    const std::int32_t position = cells_.free_position(c), inelastic = cells_.inelastic(c);
    const FreeCell<Dim>& free = free_cell(position);
    FreeEnd<Dim>& state = free_[static_cast<std::size_t>(position)];
    if (const ThermalStretch* stretch = cells_.stretch(c)) state.swelling = std::cbrt(stretch->volume());
    if (const StoredEnergy<Dim>* law = this->law(c)) {
        state.has_law = true;
        if (inelastic < 0)
            state.least = least_energy(c, *law, g);
        else if (!kept_.advances() || fate(inelastic) != Fate::stays)
            state.least = LeastEnergy<Dim>(free, *law, g, kept_.here().memory->shape(inelastic));
    } else if (free.has_one_normal()) {
        const CellGeometry<Dim>& cell = state_.coefficients.cells[c];
        state.condensed =
            CondensedStep<Dim>(free, contraction(cell.lambda, cell.mu), g, unload(state_.change.gradient_of_finite(c)));
    }
}

/// State of least energy under an elastic law, `g` of affine faces.
template <int Dim>
LeastEnergy<Dim> FinitePool<Dim>::least_energy(std::int32_t c, const StoredEnergy<Dim>& law, const Matrix<Dim>& g) const {
    const FreeCell<Dim>& free = *cells_.free_cell(c);
    const CellGeometry<Dim>& cell = state_.coefficients.cells[c];
    const double of_plane = contraction(cell.lambda, cell.mu);
    const ThermalStretch* stretch = cells_.stretch(c);
    const Matrix<Dim> shape = stretch ? LeastEnergy<Dim>::warm_shape(free, of_plane, g, *stretch)
                                      : LeastEnergy<Dim>::linear_shape(free, of_plane, g);
    return LeastEnergy<Dim>(free, law, g, shape);
}

/// Sets what an inelastic cell remembers at the end of the step, `g` of affine faces. Where it remembers the same, what has
/// been evaluated on the way is also the state at the end.
template <int Dim>
void FinitePool<Dim>::advance(std::int32_t c, std::int32_t inelastic, const Matrix<Dim>& g) {
    if (cells_.free_position(c) < 0)
        advance_inside(c, inelastic, g);
    else
        advance_free(c, inelastic, g);
}

/// From what the cell remembers at the start to F - I = `g`.
template <int Dim>
Response<Dim> FinitePool<Dim>::advance_to(std::int32_t inelastic, const Matrix<Dim>& g) {
    const std::span<double> after = kept_.end.memory->of(inelastic);
    std::ranges::copy(kept_.start.memory->of(inelastic), after.begin());
    const Advance<Dim> advance = cells_.inelastic_cell(inelastic).law->advance(g, state_.dt, after);
    fate(inelastic) = advance.dissipates ? Fate::flows : Fate::changes;
    return advance.response;
}

template <int Dim>
void FinitePool<Dim>::advance_inside(std::int32_t c, std::int32_t inelastic, const Matrix<Dim>& g) {
    const Response<Dim> response = advance_to(inelastic, g);
    const bool remembers_the_same = std::ranges::equal(kept_.start.memory->of(inelastic), kept_.end.memory->of(inelastic));
    if (fate(inelastic) == Fate::flows || !kept_.filled() || !remembers_the_same) return;
    fate(inelastic) = Fate::stays;
    kept_.end.energy[c] = response.energy;
    store_tensor(load_packed<Dim>(response.stress), kept_.end.stress, c);
}

/// The free faces are where the step costs least: where they would be if the cell remembered what it did before, unless
/// that makes it remember something else.
template <int Dim>
void FinitePool<Dim>::advance_free(std::int32_t c, std::int32_t inelastic, const Matrix<Dim>& g) {
    const InelasticLaw<Dim>& law = *cells_.inelastic_cell(inelastic).law;
    CellMemory<Dim>&start = *kept_.start.memory, &end = *kept_.end.memory;
    const std::span<const double> before = start.of(inelastic);
    const std::span<double> after = end.of(inelastic);
    const FreeCell<Dim>& free = *cells_.free_cell(c);
    const auto shape = start.shape(inelastic);
    end.set_shape(inelastic, shape);
    std::ranges::copy(before, after.begin());
    const LeastEnergy<Dim> at_first(free, end.law(inelastic), g, shape);
    advance_to(inelastic, at_first.gradient());
    if (std::ranges::equal(before, after)) {
        if (fate(inelastic) == Fate::changes) fate(inelastic) = Fate::stays;
        free_[static_cast<std::size_t>(cells_.free_position(c))].least = at_first;
        return;
    }
    const LeastEnergy<Dim> least(free, SteppedLaw<Dim>(law, state_.dt, before, after), g, shape);
    end.set_shape(inelastic, least.shape());
    advance_to(inelastic, least.gradient());
}

// Stresses -----------------------------------------------------------------------------------------------------------

/// S of the Green strain E, with the free faces where the energy of the cell is least.
template <int Dim>
LaneTensor<Dim> FinitePool<Dim>::elastic_stress_of(std::int32_t c, const Tensor& strain) const {
    const CellGeometry<Dim>& cell = state_.coefficients.cells[c];
    const std::int32_t position = cells_.free_position(c);
    if (position < 0) return svk_stress(cell, strain);
    return load_packed<Dim>(condensed_stress(free_cell(position), cell.lambda, cell.mu, unload(strain)));
}

/// F S, both means of the ends of the step, and what the jumps add.
template <int Dim>
void FinitePool<Dim>::set_stress(std::int32_t c) {
    double defect = 0.0;
    Tensor sum = capped_.contains(c) ? sum_capped_jumps(c, defect) : state_.element.sum_jumps(c);
    if (cells_.has_condensed_traces(c)) {
        FreeEnd<Dim>& state = free_[static_cast<std::size_t>(cells_.free_position(c))];
        state.jumps = unload(sum);
        state.pulled_jumps = state.pull_back(state.jumps);
        sum = load_packed<Dim>(state.pulled_jumps);
    }
    const Tensor g = load_tensor<Dim>(state_.work.g, c);
    Response<Dim> of_law;
    if (law(c)) {
        of_law = response_of_law(c, unload(g));
        for (int j = 0; j < Dim; ++j) sum.col[j] += load_packed<Dim>(Vector<Dim>(of_law.stress.col(j)));
    } else {
        const Tensor stress = elastic_stress_of(c, mean_green_strain(g, state_.change.gradient_of_finite(c)));
        for (int j = 0; j < Dim; ++j) sum.col[j] += stress.col[j] + g * stress.col[j];
    }
    if (kept_.filled()) keep_end(c, of_law, defect, sum);
    store_tensor(sum, state_.work.s, c);
}

/// As `law_response`, or what `advance_inside` has evaluated.
template <int Dim>
Response<Dim> FinitePool<Dim>::response_of_law(std::int32_t c, const Matrix<Dim>& g) {
    const std::int32_t inelastic = cells_.inelastic(c);
    const bool is_evaluated =
        kept_.fills_end() && cells_.free_position(c) < 0 && inelastic >= 0 && fate(inelastic) == Fate::stays;
    if (!is_evaluated) return law_response(c, g);
    return {kept_.end.energy[c], unload(load_tensor<Dim>(kept_.end.stress, c))};
}

/// W and P of a cell with a StoredEnergy whose gradient was set last, `g` of affine faces.
template <int Dim>
Response<Dim> FinitePool<Dim>::law_response(std::int32_t c, const Matrix<Dim>& g) const {
    const std::int32_t position = cells_.free_position(c);
    return position < 0 ? law(c)->at(g) : free_[static_cast<std::size_t>(position)].least.response();
}

/// `sum`: S_c in this state, `of_jumps`: what capped jumps add to the defect of the step [J]. At the end of a step the mean
/// with that at its start takes its place.
template <int Dim>
void FinitePool<Dim>::keep_end(std::int32_t c, const Response<Dim>& of_law, double of_jumps, Tensor& sum) {
    KeptEnd<Dim>& kept = *kept_.filled();
    store_tensor(load_tensor<Dim>(state_.work.g, c), kept.g, c);
    store_tensor(sum, kept.s, c);
    store(load_packed<Dim>(state_.work.direct, c), kept.direct, c);
    if (cells_.free_cell(c)) {
        const auto position = static_cast<std::size_t>(cells_.free_position(c));
        kept.free[position] = free_[position];
    }
    if (cells_.has_law(c)) {
        kept.energy[c] = of_law.energy;
        store_tensor(load_packed<Dim>(of_law.stress), kept.stress, c);
    }
    if (!kept_.fills_end()) return;
    const std::int32_t inelastic = cells_.inelastic(c);
    kept_.set_defect(c, inelastic >= 0 && fate(inelastic) == Fate::flows, of_jumps);
    take_mean_of_ends(c, sum);
}

template <int Dim>
void FinitePool<Dim>::take_mean_of_ends(std::int32_t c, Tensor& sum) {
    LargeArray<double>& direct = state_.work.direct;
    const Tensor start = load_tensor<Dim>(kept_.start.s, c);
    for (int j = 0; j < Dim; ++j) sum.col[j] = 0.5 * (start.col[j] + sum.col[j]);
    store(0.5 * (load_packed<Dim>(kept_.start.direct, c) + load_packed<Dim>(direct, c)), direct, c);
    if (!state_.change.of_linear() || !viscous_.contains(c)) return;
    const std::int32_t position = cells_.free_position(c);
    const FreeCell<Dim>* free = position < 0 ? nullptr : &free_cell(position);
    const Matrix<Dim> g_0 = unload(load_tensor<Dim>(kept_.start.g, c)), g_1 = unload(load_tensor<Dim>(state_.work.g, c));
    const Tensor added = load_packed<Dim>(viscous_.stress(c, 0.5 * (g_0 + g_1), g_1 - g_0, state_.dt, free));
    for (int j = 0; j < Dim; ++j) sum.col[j] += added.col[j];
}

// Jumps that yield ---------------------------------------------------------------------------------------------------

/// F - I as the traces of the cell take it.
template <int Dim>
Matrix<Dim> FinitePool<Dim>::trace_gradient(std::int32_t c) const {
    return cells_.has_condensed_traces(c) ? free_[static_cast<std::size_t>(cells_.free_position(c))].gradient()
                                          : unload(load_tensor<Dim>(state_.work.g, c));
}

/// The mean of both cells.
template <int Dim>
Matrix<Dim> FinitePool<Dim>::gradient_at_face(std::int32_t face) const {
    const auto [first, second] = state_.arrays.face_cells[face];
    return 0.5 * (trace_gradient(first) + trace_gradient(second));
}

/// As SweepElements::sum_jumps, where F of both cells also moves what lasts of a jump.
template <int Dim>
LaneTensor<Dim> FinitePool<Dim>::sum_capped_jumps(std::int32_t c, double& defect) {
    const CcgArrays<Dim>& arrays = state_.arrays;
    const bool advances = kept_.fills_end();
    if (advances) capped_.begin(c);
    Matrix<Dim> sum = Matrix<Dim>::Zero();
    Vector<Dim> direct = Vector<Dim>::Zero();
    for (std::int32_t i = arrays.half_face_offsets[c]; i < arrays.half_face_offsets[c + 1]; ++i) {
        const std::int32_t face = arrays.half_faces[i].face;
        if (arrays.boundary_index[face] != no_face) continue;
        const Vector<Dim> jumped = unload(state_.jump(c, i));
        const Matrix<Dim> g = gradient_at_face(face);
        const auto elastic = advances         ? capped_.advance(c, i, jumped, g, defect)
                             : kept_.filled() ? capped_.start(i, jumped, g)
                                              : capped_.at(i, jumped, g);
        const Vector<Dim> gradient = state_.coefficients.faces[face].jump_stiffness * elastic.jump;
        direct += gradient;
        sum += gradient * (Vector<Dim>(state_.coefficients.lever_arms[i].data()) - 0.5 * elastic.lasting).transpose();
    }
    store(load_packed<Dim>(direct), state_.work.direct, c);
    return load_packed<Dim>(Matrix<Dim>(state_.coefficients.cells[c].inverse_measure * sum));
}

template <int Dim>
Lanes<Dim> FinitePool<Dim>::elastic_jump(std::int32_t c, std::int32_t half_face) const {
    const Lanes<Dim> all = state_.jump(c, half_face);
    if (!capped_.contains(c)) return all;
    const Matrix<Dim> g = gradient_at_face(state_.arrays.half_faces[half_face].face);
    return load_packed<Dim>(capped_.at(half_face, unload(all), g).jump);
}

// Both ends of a step ------------------------------------------------------------------------------------------------

template <int Dim>
bool FinitePool<Dim>::is_kept(const KeptEnd<Dim>& kept, std::span<const Run> cells, std::span<const Vector<Dim>> u) const {
    bool same = true;
    for_runs(cells, [&](std::int32_t c) { same = same && unload(load_packed<Dim>(kept.u, c)) == u[c]; });
    return same;
}

template <int Dim>
void FinitePool<Dim>::set_start(std::span<const Run> cells, std::span<const Vector<Dim>> u) {
    for_runs(cells, [&](std::int32_t c) {
        store(load_packed<Dim>(u[c]), state_.work.u, c);
        store(load_packed<Dim>(u[c]), kept_.start.u, c);
    });
}

template <int Dim>
void FinitePool<Dim>::keep_start(const BoundaryLoad<Dim>& load) {
    kept_.start.load_displacement = load.displacement;
    if (cells_.any_warm()) kept_.start.temperature = load.temperature;
    kept_.start.is_set = true;
    kept_.fill(Fill::nothing);
}

template <int Dim>
void FinitePool<Dim>::fill_end(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load) {
    kept_.try_end();
    end_ = u;
    end_element_ = state_.element;
    end_element_.tables.load_displacement = plain<double>(load.displacement);
    kept_.end.load_displacement = load.displacement;
    if (cells_.any_warm()) kept_.end.temperature = load.temperature;
    kept_.end.is_set = true;
    kept_.clear_contact();
    kept_.fill(Fill::end);
}

template <int Dim>
void FinitePool<Dim>::load_end(std::span<const Run> cells) {
    for_runs(cells, [&](std::int32_t c) {
        store(load_packed<Dim>(end_[c]), state_.work.u, c);
        store(load_packed<Dim>(end_[c]), kept_.end.u, c);
    });
}

template <int Dim>
void FinitePool<Dim>::leave() {
    kept_.fill(Fill::nothing);
    kept_.stop_advancing();
    end_ = {};
}

template class FinitePool<2>;
template class FinitePool<3>;

}  // namespace abut::solid
