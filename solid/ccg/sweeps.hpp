#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/solid/ccg/arrays.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/ccg/cell_moments.hpp"
#include "abut/solid/ccg/finite_cells.hpp"
#include "abut/solid/ccg/sweep_schedule.hpp"

namespace abut::solid {

/// The operators of CcgArrays applied to a displacement, element by element, in five sweeps:
///
///     faces   û_f or u_f by the stencils
///     cells   G_c, and I_c at the cell's faces
///     cells   S_c = sigma_c + (1/|c|) sum of k [u] (x) (x_f - x_c), and the sum of k [u]
///     faces   y_f = (S_1 - S_2) |f| n_f
///     cells   dV/du_c = sum of k [u] + R^T y
///
/// A sweep writes each of its elements once and reads what the sweep before has written.
template <int Dim>
class CcgSweeps {
public:
    /// Both must outlive the sweeps.
    CcgSweeps(const CcgArrays<Dim>& arrays, const FiniteCells<Dim>& finite);
    CcgSweeps(const CcgSweeps&) = delete;
    CcgSweeps& operator=(const CcgSweeps&) = delete;

    void gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                  std::span<Vector<Dim>> result, const StepEnds<Dim>& ends = {});
    /// The same; the arrays of displacements are exchanged.
    void gradient_of_packed(std::vector<double>& u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                            std::span<Vector<Dim>> result, const StepEnds<Dim>& ends = {});
    /// V without the work of the loads [J].
    [[nodiscard]] double stored_energy(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                       const FaceCorrections<Dim>& corrections);
    void boundary_displacement(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                               std::span<Vector<Dim>> displacement);
    /// Sets Region::chunks, which `evaluate_cells` needs.
    void divide_into_chunks(Region<Dim>& region) const;
    void evaluate_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                        std::span<Vector<Dim>> displacement, std::span<Vector<Dim>> gradient);
    void evaluate_tilted_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                               std::span<Vector<Dim>> displacement, std::span<Matrix<Dim>> displacement_gradient);
    void evaluate_cells(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                        const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result);

    /// See Ccg.
    [[nodiscard]] FiniteExtremes finite_extremes() const;

    // Of the last call.
    [[nodiscard]] Vector<Dim> face_displacement(std::int32_t f) const {
        return unload<Dim>(load_packed<Dim>(relative_, f) + load_packed<Dim>(u_, arrays_.face_cells[f][0]));
    }
    [[nodiscard]] Vector<Dim> face_gradient(std::int32_t f) const { return unload<Dim>(load_packed<Dim>(y_, f)); }
    [[nodiscard]] Matrix<Dim> displacement_gradient(std::int32_t c) const { return unload(load_tensor<Dim>(g_, c)); }
    [[nodiscard]] Matrix<Dim> stress(std::int32_t c) const;

private:
    class PlacedCorrections;
    enum Stage { reconstruction, displacement_gradients, stresses, face_gradients, cell_gradients, n_stages };
    struct Chunk {  // where it begins among the cells, faces, boundary faces and boundary_cells
        std::int32_t cell, face;
        BoundaryFace boundary;
        std::int32_t boundary_cell;
        bool has_finite = false;  // it holds cells of FiniteCells
    };

    // One element
    [[nodiscard]] Lanes<Dim> displacement(std::ptrdiff_t c) const { return load_packed<Dim>(u_, c); }
    [[nodiscard]] Lanes<Dim> reconstructed(const std::vector<double>& u, std::ptrdiff_t f) const;
    [[nodiscard]] Lanes<Dim> reconstructed_boundary(BoundaryFace b, const BoundaryLoad<Dim>& boundary_load) const;
    [[nodiscard]] LaneTensor<Dim> gradient_of(const std::vector<double>& u, const std::vector<double>& relative,
                                              std::ptrdiff_t c) const;
    void set_traces(std::ptrdiff_t c, const LaneTensor<Dim>& g);
    void set_displacement_gradient(std::ptrdiff_t c);
    [[nodiscard]] LaneTensor<Dim> sum_jumps(std::ptrdiff_t c);
    void set_stress(std::ptrdiff_t c);
    [[nodiscard]] Lanes<Dim> interior_gradient(std::ptrdiff_t f) const;
    [[nodiscard]] Lanes<Dim> boundary_gradient(BoundaryFace b, const BoundaryLoad<Dim>& boundary_load) const;
    [[nodiscard]] Lanes<Dim> cell_gradient(std::ptrdiff_t c) const;
    [[nodiscard]] Lanes<Dim> boundary_cell_gradient(std::ptrdiff_t position) const;
    [[nodiscard]] double energy(std::ptrdiff_t c) const;

    // One element of a finite body, or of any
    [[nodiscard]] LaneTensor<Dim> finite_stress(std::ptrdiff_t c, const LaneTensor<Dim>& strain) const;
    [[nodiscard]] CellStretch end_stretch(std::ptrdiff_t c) const;
    [[nodiscard]] Lanes<Dim> boundary_change(BoundaryFace b) const;
    void set_finite_displacement_gradient(std::ptrdiff_t c);
    void set_finite_stress(std::ptrdiff_t c);
    void set_any_displacement_gradient(std::ptrdiff_t c);
    void set_any_stress(std::ptrdiff_t c);
    void load_change(const StepEnds<Dim>& ends);
    void add_moments(std::int32_t begin, std::int32_t end);
    [[nodiscard]] std::pair<Vector<Dim>, Matrix<Dim>> tilted_face(BoundaryFace b) const;
    [[nodiscard]] Matrix<Dim> cauchy_stress(std::int32_t c) const;

    void run_sweeps(const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result);

    // One chunk
    void set_chunks();
    [[nodiscard]] auto boundary_of_chunk(std::int32_t k) const {
        return id_range(chunks_[k].boundary, chunks_[k + 1].boundary);
    }
    void load_displacement(std::span<const Vector<Dim>> u);
    void reconstruct_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load);
    void displacement_gradients_of_chunk(std::int32_t k);
    void stresses_of_chunk(std::int32_t k);
    void face_gradients_of_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load);
    void cell_gradients_of_chunk(std::int32_t k, std::span<Vector<Dim>> result) const;

    // A part of the mesh
    void run_task(const Region<Dim>& region, int stage, std::int32_t k, const BoundaryLoad<Dim>& boundary_load,
                  std::span<Vector<Dim>> result);
    void evaluate_to_displacement_gradients(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                            const BoundaryLoad<Dim>& boundary_load);

    const CcgArrays<Dim>& arrays_;
    const FiniteCells<Dim>& finite_;
    // Work arrays of registers.
    std::vector<double> u_;              // displacement, by cell
    std::vector<double> relative_;       // u_f - u_c of the first side, by face
    std::vector<double> g_;              // displacement gradient, by cell
    std::vector<double> trace_;          // I_c(x_f) - u_c of the first side, by half-face
    std::vector<double> s_;              // S_c, by cell
    std::vector<double> direct_;         // sum of k [u], by cell
    std::vector<double> y_;              // dV/dũ_f, by face
    std::vector<double> correction_;     // delta_f and answers, by boundary face; zero except during a call
    std::vector<double> pair_gradient_;  // by boundary face; zero but during a call
    CellMoments<Dim> moments_;           // empty except during a call
    // Of finite bodies, changes from the start of a step to its end; empty without any.
    std::vector<double> u_change_;
    std::vector<double> relative_change_;
    std::vector<double> g_change_;
    std::vector<CondensedStep<Dim>> condensed_;  // by position in FiniteCells::free
    bool has_change_ = false;
    std::vector<Chunk> chunks_;  // one more at the end
    SweepSchedule<n_stages> schedule_;
};

}  // namespace abut::solid
