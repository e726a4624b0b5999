#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstdint>
#include <span>

#include "abut/solid/cells/cell_pool.hpp"
#include "abut/solid/cells/simplex_elements.hpp"
#include "abut/solid/cells/sweep_state.hpp"
#include "abut/solid/operator/largest_strain.hpp"

namespace abut::solid {

/// Base of LinearPool and SimplexPool: both compute the state that the sweeps are given.
template <int Dim, class Real>
class PoolOfGivenState {
public:
    explicit PoolOfGivenState(SweepState<Dim, Real>& state) : state_(state) {}

    template <class LoadCell>
    void load(std::span<const Run> cells, const LoadCell& load_cell) {
        for_runs(cells, load_cell);
    }
    void reconstruct(std::span<const Run> faces, std::span<const BoundaryFace> rows) {
        const auto& element = state_.element;
        for_runs(faces,
                 [&](std::int32_t f) { store(element.reconstructed(state_.work.u.data(), f), state_.work.of_face, f); });
        for (const BoundaryFace b : rows)
            store(element.reconstructed_row(state_.work.u.data(), b), state_.work.of_face, state_.arrays.face_of(b));
    }

protected:
    [[nodiscard]] double twice_density(std::int32_t c, const LaneTensor<Dim, Real>& g) const {
        const LaneTensor<Dim, Real> sigma = elastic_stress(state_.coefficients.cells[c], g);
        double density = 0.0;
        for (int j = 0; j < Dim; ++j) density += dot(sigma.col[j], g.col[j]);
        return density;
    }

    SweepState<Dim, Real>& state_;
};

/// Cells of any shape whose strains are linear.
template <int Dim, class Real>
class LinearPool : public PoolOfGivenState<Dim, Real> {
public:
    using PoolOfGivenState<Dim, Real>::PoolOfGivenState;

    void set_gradients(const CellsOfChunk& chunk) {
        for_runs(chunk.cells, [&](std::int32_t c) { state_.element.set_displacement_gradient(c); });
    }
    void set_stresses(const CellsOfChunk& chunk) {
        for_runs(chunk.cells, [&](std::int32_t c) { state_.element.set_stress(c); });
    }
    void set_face_gradients(std::span<const Run> faces) { set_interior_gradients(state_, faces); }
    void set_gradient(std::int32_t c) { state_.element.set_displacement_gradient(c); }
    void set_stress(std::int32_t c) { state_.element.set_stress(c); }

    /// |G|.
    [[nodiscard]] double largest_strain(std::int32_t begin, std::int32_t end) const {
        return largest_root<Dim>(state_.work.g, begin, end, [](const auto& g) { return squared_norm<Dim>(g); });
    }
    [[nodiscard]] double twice_energy_density(std::int32_t c) const {
        return this->twice_density(c, load_tensor<Dim>(state_.work.g, c));
    }

private:
    using PoolOfGivenState<Dim, Real>::state_;
};

/// Cells of Simplices.
template <int Dim, class Real>
class SimplexPool : public PoolOfGivenState<Dim, Real> {
public:
    using PoolOfGivenState<Dim, Real>::PoolOfGivenState;

    void set_gradients(const CellsOfChunk& chunk) {
        const auto& element = state_.element;
        for (const auto& [c, b] : chunk.condensed) store(Lanes<Dim, Real>{}, state_.work.of_face, state_.arrays.face_of(b));
        for_runs(chunk.cells, [&](std::int32_t c) { element.set_simplex_stress(c); });
        for (const CondensedCell& cell : chunk.condensed) element.add_condensed_face(cell);
    }
    void set_stresses(const CellsOfChunk& chunk) {
        for_runs(chunk.cells, [&](std::int32_t c) { state_.element.set_simplex_jumps(c); });
    }
    void set_face_gradients(std::span<const Run> faces) {
        for_runs(faces,
                 [&](std::int32_t f) { store(state_.element.interior_gradient_of_simplices(f), state_.work.of_face, f); });
    }
    void set_gradient(std::int32_t c) { state_.element.set_any_displacement_gradient(c); }
    void set_stress(std::int32_t c) { state_.element.set_simplex_jumps(c); }

    /// |sigma| over the least modulus.
    [[nodiscard]] double largest_strain(std::int32_t begin, std::int32_t end) const {
        const auto& [inverse_measure, lambda, mu] = state_.coefficients.cells[begin];  // all are of one material
        return largest_root<Dim>(state_.work.s, begin, end, [](const auto& s) { return squared_norm<Dim>(s); }) /
               (2.0 * mu + std::min(0.0, double{Dim} * lambda));
    }
    [[nodiscard]] double twice_energy_density(std::int32_t c) const {
        const auto relative = [&](std::int32_t f) { return load_packed<Dim>(state_.work.of_face, f); };
        return this->twice_density(c, state_.element.gradient_of(state_.work.u.data(), c, relative));
    }

private:
    using PoolOfGivenState<Dim, Real>::state_;
};

static_assert(CellPool<LinearPool<2, double>> && CellPool<LinearPool<3, float>>);
static_assert(CellPool<SimplexPool<2, double>> && CellPool<SimplexPool<3, float>>);

}  // namespace abut::solid
