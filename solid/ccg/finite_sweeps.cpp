#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "abut/base/parallel.hpp"
#include "abut/solid/ccg/sweeps.hpp"

// What the sweeps do with the cells of bodies of Kinematics::finite. docs/method.md, Bodies that bend.

namespace abut::solid {
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::add_stress(std::int32_t c, const Matrix<Dim>& added) {
    LaneTensor<Dim, Real> sum = load_tensor<Dim>(work_.s, c);
    const LaneTensor<Dim, Real> other = load_packed<Dim>(added);
    for (int j = 0; j < Dim; ++j) sum.col[j] += other.col[j];
    store_tensor(sum, work_.s, c);
}

/// C : eps of a cell whose strains are linear, before its stress has anything beside.
template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::elastic_stress_of_stage(std::int32_t c) const {
    if (arrays_.simplices.contains(c)) return unload(load_tensor<Dim>(work_.s, c));
    return unload(elastic_stress(coefficients_.cells[c], load_tensor<Dim>(work_.g, c)));
}

/// Lets a cell flow in a step whose middle its gradient is in: jumps look at the flow of both of their cells.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::let_flow(std::int32_t c) {
    if (plastic_->moves_faces(c)) set_push_of_contact(c);
    const Matrix<Dim> elastic = elastic_stress_of_stage(c);
    if (change_.follows() && plastic_->stays_elastic(c, elastic)) return;
    change_.ask(c);
    plastic_->advance(c, elastic, change_.gradient(c), dt_);
}

/// Takes out of the stress of a cell what it lacks by flow, in a step the mean of both ends.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::take_stress_of_flow(std::int32_t c) {
    if (change_.of_linear() && plastic_->flows(c))
        add_stress(c, -plastic_->mean_stress(c));
    else if (plastic_->has_flowed(c))
        add_stress(c, -plastic_->stress(c));
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_push_of_contact(std::int32_t c) {
    Matrix<Dim> moment = Matrix<Dim>::Zero();
    moments_.for_each(c, c + 1, [&](std::int32_t, const CellPush<Dim>& push) { moment = push.affine; });
    plastic_->set_push(
        c, [&](BoundaryFace b) { return unload<Dim>(load_packed<Dim>(work_.pair_gradient, number_of(b))); }, moment);
}

/// Adds the stresses of flow and damping to that of a cell whose strains are linear.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::add_linear_stress(std::int32_t c) {
    if (change_.of_linear() && viscous_ && viscous_->contains(c))
        add_stress(c, viscous_->stress(c, Matrix<Dim>::Zero(), change_.made_gradient(c), dt_));
    if (plastic_ && plastic_->contains(c)) take_stress_of_flow(c);
}

/// S of the Green strain E, with the free faces where the energy of the cell is least.
template <int Dim, class Real>
LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::finite_stress(std::ptrdiff_t c, const LaneTensor<Dim, Real>& strain) const {
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    const std::int32_t position = finite_.free_position(c);
    if (position < 0) return svk_stress(cell, strain);
    return load_packed<Dim>(condensed_stress(finite_.free()[position], cell.lambda, cell.mu, unload(strain)));
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_finite_displacement_gradient(std::int32_t c) {
    const LaneTensor<Dim, Real> g =
        element_.gradient_of(work_.u.data(), c, [&](std::int32_t f) { return load_packed<Dim>(work_.of_face, f); });
    store_tensor(g, work_.g, c);
    change_.set_gradient_of_finite(c);
    const std::int32_t position = finite_.free_position(c), inelastic = finite_.inelastic(c);
    if (kept_.advances() && inelastic >= 0) advance(c, inelastic, unload(g));
    if (position < 0) return element_.set_traces(c, g);
    const FreeCell<Dim>& free = finite_.free()[position];
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    FreeEnd<Dim>& state = free_[position];
    if (const ThermalStretch* stretch = finite_.stretch(c)) state.swelling = std::cbrt(stretch->volume());
    if (const StoredEnergy<Dim>* law = this->law(c)) {
        state.has_law = true;
        if (inelastic < 0) {
            const double of_plane = contraction(cell.lambda, cell.mu);
            const ThermalStretch* stretch = finite_.stretch(c);
            const Matrix<Dim> shape = stretch ? LeastEnergy<Dim>::warm_shape(free, of_plane, unload(g), *stretch)
                                              : LeastEnergy<Dim>::linear_shape(free, of_plane, unload(g));
            state.least = LeastEnergy<Dim>(free, *law, unload(g), shape);
        } else if (!kept_.advances() || fates_[static_cast<std::size_t>(inelastic)] != Fate::stays) {
            state.least = LeastEnergy<Dim>(free, *law, unload(g), kept_.here().memory->shape(inelastic));
        }
    } else if (free.has_one_normal()) {
        state.condensed =
            CondensedStep<Dim>(free, contraction(cell.lambda, cell.mu), unload(g), unload(change_.gradient_of_finite(c)));
    }
    element_.set_traces(c, finite_.has_condensed_traces(c) ? load_packed<Dim>(state.gradient()) : g);
}

/// Sets what an inelastic cell remembers at the end of the step, `g` of affine faces. Its free faces are where the step
/// costs least: where they would be if the cell remembered what it did before, unless that makes it remember something
/// else. Where it does not, what has been evaluated on the way is also the state at the end.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::advance(std::int32_t c, std::int32_t inelastic, const Matrix<Dim>& g) {
    const InelasticLaw<Dim>& law = *finite_.inelastic_cell(inelastic).law;
    CellMemory<Dim>&start = *kept_.start.memory, &end = *kept_.end.memory;
    const std::span<const double> before = start.of(inelastic);
    const std::span<double> after = end.of(inelastic);
    Fate& fate = fates_[static_cast<std::size_t>(inelastic)];
    Response<Dim> reached_response;
    const auto advance_to = [&](const Matrix<Dim>& reached) {
        std::ranges::copy(before, after.begin());
        const Advance<Dim> advance = law.advance(reached, dt_, after);
        reached_response = advance.response;
        fate = advance.dissipates ? Fate::flows : Fate::changes;
    };
    const std::int32_t position = finite_.free_position(c);
    if (position < 0) {
        advance_to(g);
        if (fate == Fate::flows || !kept_.filled() || !std::ranges::equal(before, after)) return;
        fate = Fate::stays;
        kept_.end.energy[c] = reached_response.energy;
        return store_tensor(load_packed<Dim>(reached_response.stress), kept_.end.stress, c);
    }
    const FreeCell<Dim>& free = finite_.free()[position];
    const auto shape = start.shape(inelastic);
    end.set_shape(inelastic, shape);
    std::ranges::copy(before, after.begin());
    const LeastEnergy<Dim> at_first(free, end.law(inelastic), g, shape);
    advance_to(at_first.gradient());
    if (std::ranges::equal(before, after)) {
        if (fate == Fate::changes) fate = Fate::stays;
        free_[position].least = at_first;
        return;
    }
    const LeastEnergy<Dim> least(free, SteppedLaw<Dim>(law, dt_, before, after), g, shape);
    end.set_shape(inelastic, least.shape());
    advance_to(least.gradient());
}

/// F S, both means of the ends of the step, and what the jumps add.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_finite_stress(std::int32_t c) {
    double defect = 0.0;
    LaneTensor<Dim, Real> sum = capped_ && capped_->contains(c) ? sum_capped_jumps(c, defect) : element_.sum_jumps(c);
    if (finite_.has_condensed_traces(c)) {
        FreeEnd<Dim>& state = free_[finite_.free_position(c)];
        state.jumps = unload(sum);
        state.pulled_jumps = state.pull_back(state.jumps);
        sum = load_packed<Dim>(state.pulled_jumps);
    }
    const LaneTensor<Dim, Real> g = load_tensor<Dim>(work_.g, c);
    Response<Dim> of_law;
    if (law(c)) {
        const std::int32_t inelastic = finite_.inelastic(c);
        const bool is_kept = kept_.fills_end() && finite_.free_position(c) < 0 && inelastic >= 0 &&
                             fates_[static_cast<std::size_t>(inelastic)] == Fate::stays;
        of_law = is_kept ? Response<Dim>{kept_.end.energy[c], unload(load_tensor<Dim>(kept_.end.stress, c))}
                         : law_response(c, unload(g));
        for (int j = 0; j < Dim; ++j) sum.col[j] += load_packed<Dim>(Vector<Dim>(of_law.stress.col(j)));
    } else {
        const LaneTensor<Dim, Real> stress = finite_stress(c, mean_green_strain(g, change_.gradient_of_finite(c)));
        for (int j = 0; j < Dim; ++j) sum.col[j] += stress.col[j] + g * stress.col[j];
    }
    if (kept_.filled()) keep_end(c, of_law, defect, sum);
    store_tensor(sum, work_.s, c);
}

/// W and P of a cell with a StoredEnergy whose gradient was set last, `g` of affine faces.
template <int Dim, class Real>
Response<Dim> CcgSweeps<Dim, Real>::law_response(std::int32_t c, const Matrix<Dim>& g) const {
    const std::int32_t position = finite_.free_position(c);
    return position < 0 ? law(c)->at(g) : free_[position].least.response();
}

// Both ends of a step ------------------------------------------------------------------------------------------------

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::take_ends(const StepEnds<Dim>& ends) {
    dt_ = ends.dt;
    change_.begin(ends);
    if (!finite_.takes_ends() || ends.start.empty()) return;
    static const BoundaryLoad<Dim> none;
    const BoundaryLoad<Dim>& start_load = ends.start_load ? *ends.start_load : none;
    const BoundaryLoad<Dim>& end_load = ends.end_load ? *ends.end_load : none;
    begin_step(ends.start, start_load, ends.dt);
    kept_.try_end();
    end_ = ends.end;
    end_element_ = element_;
    end_element_.tables.load_displacement = plain<double>(end_load.displacement);
    kept_.end.load_displacement = end_load.displacement;
    if (finite_.any_warm()) kept_.end.temperature = end_load.temperature;
    kept_.end.is_set = true;
    kept_.clear_contact();
    kept_.fill(Fill::end);
}

/// Takes the start from where the last step ended, if that is here; what materials remember goes on wherever the step
/// begins.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::begin_step(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, double dt) {
    dt_ = dt;  // contact asks where faces end before the step is made
    if (finite_.any_inelastic()) {
        kept_.begin();
    } else if (is_kept(kept_.end, u, load)) {
        return std::swap(kept_.start, kept_.end);
    }
    if (is_kept(kept_.start, u, load)) return;
    set_start(u, load);
    kept_.fill(Fill::nothing);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::end_step() {
    kept_.commit();
    change_.keep_end();
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_memory(std::span<const double> values) {
    for (KeptEnd<Dim>* kept : {&kept_.start, &kept_.end}) {
        std::ranges::copy(values, kept->memory->values().begin());
        kept->is_set = false;
    }
    kept_.drop();
}

template <int Dim, class Real>
bool CcgSweeps<Dim, Real>::is_kept(const KeptEnd<Dim>& kept, std::span<const Vector<Dim>> u,
                                   const BoundaryLoad<Dim>& load) const {
    if (!kept.is_set || kept.load_displacement != load.displacement) return false;
    if (finite_.any_warm() && kept.temperature != load.temperature) return false;
    std::atomic<bool> same = true;
    parallel_tasks(static_cast<std::int32_t>(chunks_.size()) - 1, [&](std::int32_t k) {
        if (!chunks_[k].has_finite) return;
        for_runs(wanted_.loaded[k], [&](std::int32_t c) {
            if (unload(load_packed<Dim>(kept.u, c)) != u[c]) same.store(false, std::memory_order_relaxed);
        });
    });
    return same;
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_start(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load) {
    set_load(load);
    const auto each_chunk = [&](const auto& task) {
        parallel_tasks(static_cast<std::int32_t>(chunks_.size()) - 1, [&](std::int32_t k) {
            if (chunks_[k].has_finite) task(k);
        });
    };
    kept_.fill(Fill::start);
    each_chunk([&](std::int32_t k) {
        for_runs(wanted_.loaded[k], [&](std::int32_t c) {
            store(load_packed<Dim>(u[c]), work_.u, c);
            store(load_packed<Dim>(u[c]), kept_.start.u, c);
        });
    });
    each_chunk([&](std::int32_t k) { reconstruct_chunk(k); });
    each_chunk([&](std::int32_t k) { displacement_gradients_of_chunk(k); });
    each_chunk([&](std::int32_t k) { stresses_of_chunk(k); });
    kept_.start.load_displacement = load.displacement;
    if (finite_.any_warm()) kept_.start.temperature = load.temperature;
    kept_.start.is_set = true;
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::load_end(std::int32_t chunk) {
    for_runs(wanted_.loaded[chunk], [&](std::int32_t c) {
        store(load_packed<Dim>(end_[c]), work_.u, c);
        store(load_packed<Dim>(end_[c]), kept_.end.u, c);
    });
}

/// `sum`: S_c in this state, `of_jumps`: what capped jumps add to the defect of the step [J]. In a step the mean with
/// that at its start takes its place.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::keep_end(std::int32_t c, const Response<Dim>& of_law, double of_jumps,
                                    LaneTensor<Dim, Real>& sum) {
    KeptEnd<Dim>& kept = *kept_.filled();
    const Lanes<Dim, Real> direct = load_packed<Dim>(work_.direct, c);
    store_tensor(load_tensor<Dim>(work_.g, c), kept.g, c);
    store_tensor(sum, kept.s, c);
    store(direct, kept.direct, c);
    if (finite_.free_cell(c)) kept.free[finite_.free_position(c)] = free_[finite_.free_position(c)];
    if (finite_.has_law(c)) {
        kept.energy[c] = of_law.energy;
        store_tensor(load_packed<Dim>(of_law.stress), kept.stress, c);
    }
    if (!kept_.fills_end()) return;
    const std::int32_t inelastic = finite_.inelastic(c);
    kept_.set_defect(c, inelastic >= 0 && fates_[static_cast<std::size_t>(inelastic)] == Fate::flows, of_jumps);
    const LaneTensor<Dim, Real> start = load_tensor<Dim>(kept_.start.s, c);
    for (int j = 0; j < Dim; ++j) sum.col[j] = 0.5 * (start.col[j] + sum.col[j]);
    store(0.5 * (load_packed<Dim>(kept_.start.direct, c) + direct), work_.direct, c);
    if (!change_.of_linear() || !viscous_ || !viscous_->contains(c)) return;
    const std::int32_t position = finite_.free_position(c);
    const FreeCell<Dim>* free = position < 0 ? nullptr : &finite_.free()[static_cast<std::size_t>(position)];
    const Matrix<Dim> g_0 = unload(load_tensor<Dim>(kept_.start.g, c)), g_1 = unload(load_tensor<Dim>(work_.g, c));
    const LaneTensor<Dim, Real> added = load_packed<Dim>(viscous_->stress(c, 0.5 * (g_0 + g_1), g_1 - g_0, dt_, free));
    for (int j = 0; j < Dim; ++j) sum.col[j] += added.col[j];
}

#define ABUT_INSTANTIATE(Dim)                                                                                 \
    template void CcgSweeps<Dim>::add_stress(std::int32_t, const Matrix<Dim>&);                               \
    template void CcgSweeps<Dim>::let_flow(std::int32_t);                                                     \
    template void CcgSweeps<Dim>::add_linear_stress(std::int32_t);                                            \
    template void CcgSweeps<Dim>::take_ends(const StepEnds<Dim>&);                                            \
    template void CcgSweeps<Dim>::begin_step(std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&, double); \
    template void CcgSweeps<Dim>::end_step();                                                                 \
    template void CcgSweeps<Dim>::set_memory(std::span<const double>);                                        \
    template void CcgSweeps<Dim>::load_end(std::int32_t);                                                     \
    template Response<Dim> CcgSweeps<Dim>::law_response(std::int32_t, const Matrix<Dim>&) const;              \
    template LaneTensor<Dim> CcgSweeps<Dim>::finite_stress(std::ptrdiff_t, const LaneTensor<Dim>&) const;     \
    template void CcgSweeps<Dim>::set_finite_displacement_gradient(std::int32_t);                             \
    template void CcgSweeps<Dim>::set_finite_stress(std::int32_t);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
