#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/solid/cells/cell_moments.hpp"
#include "abut/solid/cells/change_in_step.hpp"
#include "abut/solid/cells/finite_cells.hpp"
#include "abut/solid/cells/sweep_elements.hpp"
#include "abut/solid/cells/sweep_lists.hpp"
#include "abut/solid/cells/work_arrays.hpp"
#include "abut/solid/operator/arrays.hpp"
#include "abut/solid/operator/operator_values.hpp"

namespace abut::solid {

/// State that the pools of cells share in the sweeps: operators, the arrays that one sweep leaves for the next, and what the
/// last call was given.
template <int Dim, class Real>
struct SweepState {
    using Vectors = Lanes<Dim, Real>;
    using Readers = typename ChangeInStep<Dim, Real>::Readers;

    /// All must outlive it.
    SweepState(const CcgArrays<Dim>& of_arrays, const CcgCoefficients<Dim, Real>& of_coefficients,
               const FiniteCells<Dim>& of_finite, const Readers& readers)
        : arrays(of_arrays),
          coefficients(of_coefficients),
          finite(of_finite),
          work(of_arrays),
          element{tables_of(of_arrays, of_coefficients), of_coefficients.units},
          change(of_arrays, of_coefficients, element, readers) {
        work.set(element.tables);
    }
    SweepState(const SweepState&) = delete;
    SweepState& operator=(const SweepState&) = delete;

    void set_load(const BoundaryLoad<Dim>& load) {
        element.tables.load_displacement = plain<double>(load.displacement);
        element.tables.traction = plain<double>(load.traction);
        temperature = load.temperature;
        if (finite.any_warm()) finite.set_temperature(temperature);
    }

    /// û_b of the last call [m].
    [[nodiscard]] Vector<Dim> face_displacement(BoundaryFace b) const {
        return unload<Dim>(load_packed<Dim>(work.of_face, arrays.face_of(b)) + load_packed<Dim>(work.u, arrays.cell_of(b)));
    }
    /// [u] as the cell sees it.
    [[nodiscard]] Vectors jump(std::int32_t c, std::int32_t half_face) const {
        const HalfFace& half = arrays.half_faces[half_face];
        if (!arrays.simplices.contains(c))
            return load_packed<Dim>(work.trace, half_face) - load_packed<Dim>(work.trace, half.twin);
        const auto [first, second] = arrays.face_cells[half.face];
        return load_packed<Dim>(work.deviation, c) - load_packed<Dim>(work.deviation, c == first ? second : first);
    }
    void add_stress(std::int32_t c, const Matrix<Dim>& added) {
        LaneTensor<Dim, Real> sum = load_tensor<Dim>(work.s, c);
        const LaneTensor<Dim, Real> other = load_packed<Dim>(added);
        for (int j = 0; j < Dim; ++j) sum.col[j] += other.col[j];
        store_tensor(sum, work.s, c);
    }

    // Fixed
    const CcgArrays<Dim>& arrays;
    const CcgCoefficients<Dim, Real>& coefficients;
    const FiniteCells<Dim>& finite;
    // Of the last call
    WorkArrays<Dim, Real> work;
    SweepElements<Vectors> element;   // of these arrays
    CellMoments<Dim> moments;         // empty except during a call
    ChangeInStep<Dim, Real> change;   // of displacements in the step
    double dt = 0.0;                  // of the last step [s]
    std::vector<double> temperature;  // BoundaryLoad::temperature
};

/// y_f of interior faces between cells of any shape.
template <int Dim, class Real>
void set_interior_gradients(SweepState<Dim, Real>& state, std::span<const Run> faces) {
    for_runs(faces, [&](std::int32_t f) { store(state.element.interior_gradient(f), state.work.of_face, f); });
}

}  // namespace abut::solid
