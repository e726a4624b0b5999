#pragma once
// Private to the sources of this layer.
#include <atomic>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/solid/cells/capped_jumps.hpp"
#include "abut/solid/cells/cell_pool.hpp"
#include "abut/solid/cells/finite_cells.hpp"
#include "abut/solid/cells/kept_ends.hpp"
#include "abut/solid/cells/sweep_state.hpp"
#include "abut/solid/cells/viscous_cells.hpp"

namespace abut::solid {

/// Cells of bodies of Kinematics::finite. Where the mean force is that of both ends of a step, the sweeps compute the end,
/// and this pool takes the mean with the start, which it has kept. docs/method.md, Bodies that bend.
template <int Dim>
class FinitePool {
public:
    /// All must outlive it.
    FinitePool(SweepState<Dim, double>& state, ViscousCells<Dim>& viscous, CappedJumps<Dim>& capped);
    FinitePool(const FinitePool&) = delete;
    FinitePool& operator=(const FinitePool&) = delete;

    // CellPool

    template <class LoadCell>
    void load(std::span<const Run> cells, const LoadCell& load_cell) {
        if (kept_.fills_end()) return load_end(cells);
        for_runs(cells, load_cell);
    }
    void reconstruct(std::span<const Run> faces, std::span<const BoundaryFace> rows);
    void set_gradients(const CellsOfChunk& chunk) {
        for_runs(chunk.cells, [&](std::int32_t c) { set_gradient(c); });
    }
    void set_stresses(const CellsOfChunk& chunk) {
        for_runs(chunk.cells, [&](std::int32_t c) { set_stress(c); });
    }
    void set_face_gradients(std::span<const Run> faces) { set_interior_gradients(state_, faces); }
    void set_gradient(std::int32_t c);
    void set_stress(std::int32_t c);
    /// |E|.
    [[nodiscard]] double largest_strain(std::int32_t begin, std::int32_t end) const;
    [[nodiscard]] double twice_energy_density(std::int32_t c) const;

    // A step. See StepStage

    /// Begins a step at a state. Returns true if that must be evaluated since neither kept end is this state. Then call
    /// `set_start` for all chunks, run the sweeps to stresses, and call `keep_start`. `each_chunk(task)` calls
    /// task(cells) for each chunk, on all threads.
    template <class EachChunk>
    [[nodiscard]] bool begin_step(const EachChunk& each_chunk, std::span<const Vector<Dim>> u,
                                  const BoundaryLoad<Dim>& load) {
        if (cells_.any_inelastic()) {
            kept_.begin();
        } else if (is_kept(kept_.end, each_chunk, u, load)) {
            std::swap(kept_.start, kept_.end);
            return false;
        }
        if (is_kept(kept_.start, each_chunk, u, load)) return false;
        kept_.fill(Fill::start);
        return true;
    }
    void set_start(std::span<const Run> cells, std::span<const Vector<Dim>> u);
    void keep_start(const BoundaryLoad<Dim>& load);
    /// From now on the sweeps compute the end of the step, until `leave`.
    void fill_end(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load);
    void leave();
    /// Faces are evaluated at the end of the step, until `return_to` the stage before.
    void try_end() { kept_.try_end(); }
    [[nodiscard]] StepStage stage() const { return kept_.stage(); }
    void return_to(StepStage stage) { kept_.return_to(stage); }
    [[nodiscard]] dynamics::Losses loss(std::int32_t c) const { return kept_.loss(c); }
    [[nodiscard]] StepDefect<Dim> defect(std::int32_t c) const { return kept_.defect(c); }

    // RememberingCells

    [[nodiscard]] std::int32_t memory_size(std::ptrdiff_t c) const;
    void put_memory(std::ptrdiff_t c, std::vector<double>& values) const;
    void set_memory(std::ptrdiff_t c, std::span<const double> values);
    [[nodiscard]] bool remembers_as(std::ptrdiff_t c, const FinitePool& other, std::ptrdiff_t other_cell) const;
    void end_step() { kept_.commit(); }
    /// Drops both kept ends, since other memory is set: the next step evaluates its start again.
    void forget_ends();
    /// z of a cell, by FiniteCells::inelastic.
    [[nodiscard]] std::span<const double> memory_of(std::int32_t index) const { return kept_.here().memory->of(index); }

    // Contact

    /// dV/dF over |c| [Pa] from `gradient`, dV/dF_cond over |c|, which contact adds to a cell with free faces: in a state,
    /// or along the step whose end is filled.
    [[nodiscard]] Matrix<Dim> pull_back_contact(std::int32_t c, const Matrix<Dim>& gradient);
    /// û_f and F - I of a boundary face and the cell behind it, as contact sees them. `affine` and `g` are those with affine
    /// free faces.
    [[nodiscard]] std::pair<Vector<Dim>, Matrix<Dim>> tilted_face(BoundaryFace face, const Vector<Dim>& affine,
                                                                  const Matrix<Dim>& g) const;

    // Results of the last call

    /// [u] without its lasting part [m].
    [[nodiscard]] Lanes<Dim> elastic_jump(std::int32_t c, std::int32_t half_face) const;
    /// F - I of a cell with a law of its own, its free faces where its energy is least.
    [[nodiscard]] Matrix<Dim> law_gradient(std::int32_t c) const;
    [[nodiscard]] Matrix<Dim> cauchy_stress(std::int32_t c) const;
    /// At the end of the step, or in the state.
    [[nodiscard]] CellStretch end_stretch(std::int32_t c) const;
    [[nodiscard]] double end_plastic_strain(std::int32_t c) const;
    /// Whether a cell has free faces in all directions, and with them no energy.
    [[nodiscard]] bool bears_nothing(std::int32_t c) const {
        const std::int32_t position = cells_.free_position(c);
        return position >= 0 && free_cell(position).n_tangents == 0;
    }

private:
    using Tensor = LaneTensor<Dim>;
    using Fill = typename KeptEnds<Dim>::Fill;
    /// Effect of a step on a cell that remembers.
    enum class Fate : char {
        changes,  // it remembers something else, and dissipates nothing
        flows,    // it dissipates
        stays     // it remembers the same, and what it answers is evaluated
    };

    [[nodiscard]] const FreeCell<Dim>& free_cell(std::int32_t position) const {
        return cells_.free()[static_cast<std::size_t>(position)];
    }
    [[nodiscard]] Fate& fate(std::int32_t inelastic) { return fates_[static_cast<std::size_t>(inelastic)]; }
    /// The stored energy of a cell; null: its material is St. Venant and Kirchhoff's.
    [[nodiscard]] const StoredEnergy<Dim>* law(std::ptrdiff_t cell) const {
        const std::int32_t inelastic = cells_.inelastic(cell);
        return inelastic < 0 ? cells_.elastic_law(cell) : &kept_.here().memory->law(inelastic);
    }
    void load_end(std::span<const Run> cells);
    void set_free_faces(std::int32_t c, const Matrix<Dim>& g);
    [[nodiscard]] LeastEnergy<Dim> least_energy(std::int32_t c, const StoredEnergy<Dim>& law, const Matrix<Dim>& g) const;
    void advance(std::int32_t c, std::int32_t inelastic, const Matrix<Dim>& g);
    Response<Dim> advance_to(std::int32_t inelastic, const Matrix<Dim>& g);
    void advance_inside(std::int32_t c, std::int32_t inelastic, const Matrix<Dim>& g);
    void advance_free(std::int32_t c, std::int32_t inelastic, const Matrix<Dim>& g);
    [[nodiscard]] Tensor elastic_stress_of(std::int32_t c, const Tensor& strain) const;
    [[nodiscard]] Response<Dim> law_response(std::int32_t c, const Matrix<Dim>& g) const;
    [[nodiscard]] Response<Dim> response_of_law(std::int32_t c, const Matrix<Dim>& g);
    void keep_end(std::int32_t c, const Response<Dim>& of_law, double of_jumps, Tensor& sum);
    void take_mean_of_ends(std::int32_t c, Tensor& sum);
    [[nodiscard]] bool is_kept(const KeptEnd<Dim>& kept, std::span<const Run> cells, std::span<const Vector<Dim>> u) const;
    template <class EachChunk>
    [[nodiscard]] bool is_kept(const KeptEnd<Dim>& kept, const EachChunk& each_chunk, std::span<const Vector<Dim>> u,
                               const BoundaryLoad<Dim>& load) const {
        if (!kept.is_set || kept.load_displacement != load.displacement) return false;
        if (cells_.any_warm() && kept.temperature != load.temperature) return false;
        std::atomic<bool> same = true;
        each_chunk([&](std::span<const Run> cells) {
            if (!is_kept(kept, cells, u)) same.store(false, std::memory_order_relaxed);
        });
        return same;
    }
    [[nodiscard]] Matrix<Dim> pull_back(std::int32_t c, const Matrix<Dim>& gradient) const;
    [[nodiscard]] double poisson(std::int32_t c) const;
    [[nodiscard]] Matrix<Dim> trace_gradient(std::int32_t c) const;
    [[nodiscard]] Matrix<Dim> gradient_at_face(std::int32_t face) const;
    [[nodiscard]] Tensor sum_capped_jumps(std::int32_t c, double& defect);

    SweepState<Dim, double>& state_;
    const FiniteCells<Dim>& cells_;
    ViscousCells<Dim>& viscous_;
    CappedJumps<Dim>& capped_;
    std::vector<FreeEnd<Dim>> free_;         // of the last call, by position in FiniteCells::free
    std::vector<Fate> fates_;                // at the end of the step, by FiniteCells::inelastic
    KeptEnds<Dim> kept_;                     // where the mean force is that of both ends
    std::span<const Vector<Dim>> end_;       // of the cells, while the end of a step is filled
    SweepElements<Lanes<Dim>> end_element_;  // with the load at the end
};

static_assert(CellPool<FinitePool<2>> && CellPool<FinitePool<3>>);
static_assert(RememberingCells<FinitePool<2>> && RememberingCells<FinitePool<3>>);

}  // namespace abut::solid
