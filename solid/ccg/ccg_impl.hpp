#pragma once
// Private to the sources of Ccg.
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/ccg/step_sweeps.hpp"
#include "abut/solid/ccg/sweeps.hpp"
#include "abut/solid/cells/capped_jumps.hpp"
#include "abut/solid/cells/finite_cells.hpp"
#include "abut/solid/cells/plastic_cells.hpp"
#include "abut/solid/cells/thermal_cells.hpp"
#include "abut/solid/cells/viscous_cells.hpp"
#include "abut/solid/operator/arrays.hpp"
#include "abut/solid/operator/free_face_answers.hpp"
#include "abut/solid/operator/motion_bound.hpp"

namespace abut::solid {

template <int Dim>
struct Ccg<Dim>::Impl {
    BoundaryConditions<Dim> conditions;
    FaceConditions<Dim> face_conditions;
    CcgArrays<Dim> arrays;
    FiniteCells<Dim> finite;
    ViscousCells<Dim> viscous;
    PlasticCells<Dim> plastic;
    CappedJumps<Dim> capped;
    ThermalCells<Dim> thermal;
    CcgSweeps<Dim> sweeps;
    std::unique_ptr<StepSweeps<Dim>> steps;  // null: `sweeps` make them
    bool steps_were_last = false;            // to compute gradients
    bool steps_have_state = false;           // were the last to be given a state
    std::optional<MotionBound<Dim>> motion_bound;
    IdVector<BoundaryFace, Vector<Dim>> boundary_centroid;
    IdVector<BoundaryFace, double> boundary_measure;
    std::vector<std::vector<Vector<Dim>>> outside;  // tractions by face, of each traction condition; empty: not from outside
    bool varies = false;
    bool are_moved;  // free faces, FreeFaces: what acts on them is in the stress of their cells
    // Of the last call that had corrections: which faces were pushed, increasing, and dV/dû [N]
    std::vector<BoundaryFace> pushed;
    std::vector<Vector<Dim>> pushes;

    Impl(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
         const BoundaryConditions<Dim>& boundary_conditions, std::span<const Kinematics> kinematics, CellForm form,
         Precision precision, StepDevice device, const FiniteOptions<Dim>& finite_options, FreeFaces free_faces);

    /// Free faces bear the thermal stress of their cell as if it were a traction.
    [[nodiscard]] Vector<Dim> moved_by_heat(BoundaryFace b, std::span<const double> temperature) const {
        const std::int32_t cell = arrays.cell_of(b);
        const Matrix<Dim> stress = temperature[static_cast<std::size_t>(cell)] * thermal.stress(cell);
        Vector<Dim> sum = Vector<Dim>::Zero();
        for (std::int32_t i = arrays.boundary.load_offsets[number_of(b)]; i < arrays.boundary.load_offsets[number_of(b) + 1];
             ++i)
            sum += arrays.boundary.from_traction[i] * (stress * arrays.normal_of(arrays.boundary.load_faces[i]));
        return sum;
    }

    void keep_pushes(const FaceCorrections<Dim>& corrections) {
        if (are_moved) return;
        pushes.assign(corrections.energy_gradient.begin(), corrections.energy_gradient.end());
        pushed.assign(corrections.faces.begin(), corrections.faces.begin() + std::ssize(pushes));
    }
    /// By which the traction on a face moves it and the other free faces of its cell; 0 where nothing pushes it [Pa].
    [[nodiscard]] Vector<Dim> push_on(BoundaryFace face) const {
        const auto at = std::ranges::lower_bound(pushed, face);
        if (at == pushed.end() || *at != face) return Vector<Dim>::Zero();
        return -pushes[static_cast<std::size_t>(at - pushed.begin())] / boundary_measure[face];
    }

    /// visit(cells) for all RememberingCells, in the order of saved states.
    template <class Visit>
    void for_memories(const Visit& visit) {
        visit(sweeps.finite());
        visit(viscous);
        visit(plastic);
        visit(capped);
    }
    template <class Visit>
    void for_memories(const Visit& visit) const {
        visit(sweeps.finite());
        visit(viscous);
        visit(plastic);
        visit(capped);
    }
    void take_jumps(const Impl& from, std::span<const std::int32_t> old_cells, std::span<const std::int32_t> old_faces);
    void give_way_at_corners(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials);
    [[nodiscard]] FreeFaceAnswers<Dim> answers_of(std::int32_t cell, std::vector<Vector<Dim>> normals) const;
    [[nodiscard]] std::vector<BoundaryFace> free_faces_of(std::int32_t cell) const;
    /// Stress out of the plane with nothing that pushes.
    [[nodiscard]] std::optional<double> out_of_plane_stress(std::int32_t cell,
                                                            const Matrix<Dim>& displacement_gradient) const;
    [[nodiscard]] const DirectedStiffness<Dim>* directed_of(std::int32_t cell) const {
        return arrays.directed.contains(cell) ? &arrays.directed[cell] : nullptr;
    }
    [[nodiscard]] std::optional<StressOfPushes<Dim>> stress_of_pushes(std::int32_t cell,
                                                                      const Matrix<Dim>& displacement_gradient) const;
    [[nodiscard]] std::optional<StressOfPushes<Dim>> stress_of_pushes_on_linear(std::int32_t cell) const;
    [[nodiscard]] std::optional<StressOfPushes<Dim>> stress_of_pushes_on_finite(
        std::int32_t cell, const Matrix<Dim>& displacement_gradient) const;

    /// evaluate(sweeps) of those that make steps.
    template <class Evaluate>
    void take_step(const Evaluate& evaluate) {
        if (!steps) return evaluate(sweeps);
        evaluate(*steps);
        steps_were_last = steps_have_state = true;
    }
};

}  // namespace abut::solid
