#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "abut/base/large_array.hpp"
#include "abut/solid/cells/finite_cells.hpp"
#include "abut/solid/cells/least_energy.hpp"
#include "abut/solid/operator/coefficients.hpp"
#include "abut/solid/operator/operator_values.hpp"

namespace abut::solid {

/// A cell with one free normal in one state: F as its traces and contact take it, with the free face where the energy
/// is least.
template <int Dim>
struct FreeEnd {
    CondensedStep<Dim> condensed;  // where the material is St. Venant and Kirchhoff's
    LeastEnergy<Dim> least;        // elsewhere
    bool has_law = false;
    Matrix<Dim> jumps = Matrix<Dim>::Zero();         // dV/dF of the jumps over |c|, by this F
    Matrix<Dim> pulled_jumps = Matrix<Dim>::Zero();  // by F of the affine faces
    double swelling = 1.0;                           // EdgeStep's, where normals are several

    [[nodiscard]] const Matrix<Dim>& gradient() const { return has_law ? least.gradient() : condensed.mean(); }
    [[nodiscard]] Matrix<Dim> pull_back(const Matrix<Dim>& gradient) const {
        return has_law ? least.pull_back(gradient) : condensed.pull_back(gradient);
    }
};

/// The memory of the cells of inelastic materials in one state.
template <int Dim>
class CellMemory {
public:
    /// Makes that of cells that nothing has happened to; empty where no material remembers.
    explicit CellMemory(const FiniteCells<Dim>& finite);

    [[nodiscard]] std::span<const double> values() const { return values_; }
    [[nodiscard]] std::span<double> values() { return values_; }
    /// z of a cell, by FiniteCells::inelastic.
    [[nodiscard]] std::span<double> of(std::int32_t index) {
        const auto& cell = finite_.inelastic_cell(index);
        return std::span(values_).subspan(static_cast<std::size_t>(cell.begin), static_cast<std::size_t>(cell.size));
    }
    /// LeastEnergy::shape of a cell that has free faces.
    [[nodiscard]] Matrix<Dim> shape(std::int32_t index) const { return Matrix<Dim>(values_.data() + begin_of_shape(index)); }
    void set_shape(std::int32_t index, const Matrix<Dim>& shape) {
        std::ranges::copy(shape, values_.data() + begin_of_shape(index));
    }
    [[nodiscard]] const StoredEnergy<Dim>& law(std::int32_t index) const { return laws_[static_cast<std::size_t>(index)]; }

private:
    [[nodiscard]] std::ptrdiff_t begin_of_shape(std::int32_t index) const {
        const auto& cell = finite_.inelastic_cell(index);
        return cell.begin + cell.size;
    }

    const FiniteCells<Dim>& finite_;
    std::vector<double> values_;
    std::vector<FrozenLaw<Dim>> laws_;
};

/// One end of a step, of the cells of finite bodies: what the mean of the forces at both ends is made of.
template <int Dim>
struct KeptEnd {
    explicit KeptEnd(const FiniteCells<Dim>& finite) : memory(std::make_unique<CellMemory<Dim>>(finite)) {}

    LargeArray<double> u, g, s, direct;          // by cell, packed as the work arrays of the sweeps
    std::vector<FreeEnd<Dim>> free;              // by position in FiniteCells::free
    LargeArray<double> energy, stress;           // by cell, with a StoredEnergy: W, P; empty without any
    std::vector<Vector<Dim>> load_displacement;  // BoundaryLoad::displacement
    std::vector<double> temperature;             // BoundaryLoad::temperature; empty where no finite body is warm
    std::unique_ptr<CellMemory<Dim>> memory;
    bool is_set = false;

    void resize(std::size_t n_cells, const FiniteCells<Dim>& finite);
};

/// Stage of a step for cells that remember. Without such cells it is always `begun`.
enum class StepStage {
    begun,  ///< they remember its start
    tried,  ///< its end has been evaluated. It may be evaluated again, or dropped as another step begins
    ended,  ///< the next step begins with its end
};

/// Both ends of a step. The end of one is the start of the next, as long as displacements are the same: nothing is evaluated
/// twice. Displacements and temperatures say all of it, except what inelastic materials remember.
template <int Dim>
class KeptEnds {
public:
    /// All must outlive it.
    KeptEnds(const CcgCoefficients<Dim, double>& coefficients, const FiniteCells<Dim>& finite);

    KeptEnd<Dim> start, end;

    // Stages of cells that remember

    [[nodiscard]] StepStage stage() const { return stage_; }
    /// The end whose memory cells show.
    [[nodiscard]] const KeptEnd<Dim>& here() const { return stage_ == StepStage::begun ? start : end; }
    /// Whether evaluating a cell sets what it remembers at the end.
    [[nodiscard]] bool advances() const { return advances_; }
    void begin() {
        if (stage_ == StepStage::ended) std::swap(start, end);
        stage_ = StepStage::begun;
    }
    /// Until `stop_advancing` or `return_to` cells advance to the end.
    void try_end() {
        if (!finite_.any_inelastic()) return;
        stage_ = StepStage::tried;
        advances_ = true;
    }
    void stop_advancing() { advances_ = false; }
    void return_to(StepStage stage) {
        stage_ = stage;
        advances_ = false;
    }
    void commit() { stage_ = finite_.any_inelastic() ? StepStage::ended : StepStage::begun; }
    void drop() { stage_ = StepStage::begun; }

    // Arrays that the sweeps fill

    enum class Fill { nothing, start, end };
    void fill(Fill fill) { fill_ = fill; }
    [[nodiscard]] bool fills_end() const { return fill_ == Fill::end; }
    /// Null: they look at one state.
    [[nodiscard]] KeptEnd<Dim>* filled() { return fill_ == Fill::nothing ? nullptr : fill_ == Fill::start ? &start : &end; }

    // Results of both ends of a step

    /// Both ends of this cell are set. `flows`: its material may have dissipated energy in the step. `of_capped_jumps`:
    /// what these add [J].
    void set_defect(std::int32_t c, bool flows, double of_capped_jumps);
    /// Energy that this cell has dissipated in the step from `start` to `end` [J].
    [[nodiscard]] dynamics::Losses loss(std::int32_t c) const;
    /// Defect of the step from `start` to `end`, less the moment of `direct`.
    [[nodiscard]] StepDefect<Dim> defect(std::int32_t c) const;

    // Terms that contact adds to cells with free faces, by dV/dF_cond over |c|. It acts along the step.

    void clear_contact();
    /// Such terms by F of the affine faces.
    [[nodiscard]] Matrix<Dim> pull_back_contact(std::int32_t c, const Matrix<Dim>& gradient);

private:
    static constexpr int n_axial = Dim * (Dim - 1) / 2;
    static constexpr std::ptrdiff_t n_of_defect = 1 + n_axial;

    [[nodiscard]] bool flows(std::int32_t c) const;
    [[nodiscard]] std::pair<Matrix<Dim>, Matrix<Dim>> gradients(std::int32_t c) const;
    [[nodiscard]] CondensedStep<Dim> step_of(std::int32_t c, const Matrix<Dim>& g_0, const Matrix<Dim>& g_1) const;
    [[nodiscard]] double elastic_defect(std::int32_t c, const Matrix<Dim>& g_0, const Matrix<Dim>& g_1) const;

    const CcgCoefficients<Dim, double>& coefficients_;
    const FiniteCells<Dim>& finite_;
    StepStage stage_ = StepStage::begun;
    bool advances_ = false;
    Fill fill_ = Fill::nothing;
    LargeArray<double> defects_;               // by cell: energy, moment
    std::vector<StepDefect<Dim>> of_contact_;  // over |c|, by position in FiniteCells::free; empty without a StoredEnergy
    std::vector<dynamics::Losses> losses_;     // by FiniteCells::inelastic
    std::vector<char> flows_;                  // the same
};

}  // namespace abut::solid
