#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <vector>

#include "abut/base/large_array.hpp"
#include "abut/solid/cells/sweep_elements.hpp"
#include "abut/solid/operator/arrays.hpp"
#include "abut/solid/operator/operator_values.hpp"

namespace abut::solid {

/// Change of displacements and of their gradients from the start of a step to its end. Damped cells and metal whose strains
/// are linear ask for it in each step, finite bodies where their strain is the mean of both ends.
template <int Dim, class Real>
class ChangeInStep {
public:
    struct Readers {
        bool finite;  ///< bodies whose strain is the mean of both ends
        bool damped;
        bool metal;            ///< its strains are linear
        bool shows_gradients;  ///< `gradient_of_finite` is read, at least as 0
    };

    /// All must outlive it.
    ChangeInStep(const CcgArrays<Dim>& arrays, const CcgCoefficients<Dim, Real>& coefficients,
                 const SweepElements<Lanes<Dim, Real>>& element, const Readers& readers);

    // A step: `begin` and `leave` around the sweeps that make it, `keep_end` once it has ended.

    void begin(const StepEnds<Dim>& ends);
    void leave() { of_finite_ = of_linear_ = follows_ = false; }
    void keep_end() { last_ended_ = readers_.metal; }

    /// Whether cells whose strains are linear, or finite bodies, make a step whose change is known.
    [[nodiscard]] bool of_linear() const { return of_linear_; }
    [[nodiscard]] bool of_finite() const { return of_finite_; }
    /// Whether the step begins where the last one ended, and prescribed displacements do not change. Known to metal.
    [[nodiscard]] bool follows() const { return follows_; }

    /// Change of u_c.
    [[nodiscard]] Lanes<Dim, Real> of_cell(std::int32_t c) const { return load_packed<Dim>(u_, c); }
    /// Change of u_f less u_c of the first cell.
    [[nodiscard]] Lanes<Dim, Real> reconstructed(std::int32_t f) const { return element_.reconstructed(u_.data(), f); }
    /// Change of û_f less u_c, with that of prescribed displacements.
    [[nodiscard]] Lanes<Dim, Real> of_face(BoundaryFace b) const;

    // Gradients of cells whose strains are linear. Few bodies ask, each for some of its cells.

    /// Change of the gradient, made for this call.
    [[nodiscard]] Matrix<Dim> made_gradient(std::int32_t c) const;
    /// Makes it before stresses ask: where it `is_needed`, and where `ask` named the cell in the last step, as what flows
    /// mostly goes on.
    void prepare_gradient(std::int32_t c, bool is_needed);
    void ask(std::int32_t c) { asks_[static_cast<std::size_t>(c)] = 1; }
    /// Change of the gradient as it was prepared, or made for this call: bitwise identical.
    [[nodiscard]] Matrix<Dim> gradient(std::int32_t c) const;

    // Finite bodies; prescribed displacements are in their ends.

    void reconstruct_finite(std::int32_t f) { store(reconstructed(f), relative_, f); }
    void reconstruct_finite(BoundaryFace b) { store(of_cells_behind(b), relative_, arrays_.face_of(b)); }
    /// Sets `gradient_of_finite` of a cell: 0 where no step is made.
    void set_gradient_of_finite(std::int32_t c);
    [[nodiscard]] LaneTensor<Dim, Real> gradient_of_finite(std::int32_t c) const { return load_tensor<Dim>(gradient_, c); }

private:
    void take_loads(const StepEnds<Dim>& ends);
    void add_corrections(const FaceCorrections<Dim>& change);
    [[nodiscard]] bool follows_last_load(const StepEnds<Dim>& ends);
    [[nodiscard]] Lanes<Dim, Real> of_cells_behind(BoundaryFace b) const;

    // Fixed
    const CcgArrays<Dim>& arrays_;
    const CcgCoefficients<Dim, Real>& coefficients_;
    const SweepElements<Lanes<Dim, Real>>& element_;
    Readers readers_;
    // Step that is made
    bool of_finite_ = false, of_linear_ = false, follows_ = false;
    LargeArray<double> u_;           // by cell
    LargeArray<Real> relative_;      // of u_f, by face; of finite bodies
    LargeArray<Real> gradient_;      // by cell
    std::vector<Vector<Dim>> load_;  // of û beside that by cells, by boundary face; empty: none
    std::vector<char> is_made_;      // by cell: `gradient_` is of this step
    // Remembered of the last step
    std::vector<char> asks_;              // by cell
    bool last_ended_ = false;             // it ended at `last_u_` and `last_load_`
    LargeArray<double> last_u_;           // empty without metal
    std::vector<Vector<Dim>> last_load_;  // BoundaryLoad::displacement
};

}  // namespace abut::solid
