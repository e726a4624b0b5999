#pragma once
// Private to the sources of this layer.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "abut/solid/ccg/arrays.hpp"
#include "abut/solid/ccg/capped_jumps.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/ccg/cell_moments.hpp"
#include "abut/solid/ccg/change_in_step.hpp"
#include "abut/solid/ccg/finite_cells.hpp"
#include "abut/solid/ccg/kept_ends.hpp"
#include "abut/solid/ccg/placed_corrections.hpp"
#include "abut/solid/ccg/plastic_cells.hpp"
#include "abut/solid/ccg/sweep_elements.hpp"
#include "abut/solid/ccg/sweep_lists.hpp"
#include "abut/solid/ccg/sweep_schedule.hpp"
#include "abut/solid/ccg/thermal_cells.hpp"
#include "abut/solid/ccg/viscous_cells.hpp"
#include "abut/solid/ccg/work_arrays.hpp"

namespace abut::solid {

/// The operators of CcgArrays applied to a displacement, element by element, in five sweeps:
///
///     faces   û_f or u_f by the stencils
///     cells   G_c, and I_c at the cell's faces
///     cells   S_c = sigma_c + (1/|c|) sum of k [u] (x) (x_f - x_c), and the sum of k [u]
///     faces   y_f = (S_1 - S_2) |f| n_f
///     cells   dV/du_c = sum of k [u] + R^T y
///
/// A sweep writes each of its elements once and reads what the sweep before has written. Bodies of simplices take less:
///
///     cells   sigma_c, and d_c = u_c less the mean of u_f: [u] = d_1 - d_2, as G_c (x_f - x_c) = u_f less that mean
///     cells   D_c = sum of k (d_c - d of the neighbour) = sum of k [u]
///     faces   y_f = (sigma_1 - sigma_2) |f| n_f - (D_1 + D_2)/(Dim + 1)
///
/// and in a condensed cell the free face follows from the others: û_b - u_c = -A_bb^-1 sigma' |b| n_b, sigma' without
/// it; with z = A_bb^-1 y_b, R^T y_b is what the stress -C:(z (x) |b| n_b)/|c| does on the faces of the cell.
///
/// Real is what the numbers of the operators and the work arrays are, all but displacements: these are double, and so are
/// their differences, before they are rounded, and the sums that cells receive. In float there are no bodies of
/// Kinematics::finite.
template <int Dim, class Real = double>
class CcgSweeps {
public:
    /// All must outlive the sweeps. Without `viscous`, `plastic`, `capped` or `thermal` no cell is.
    CcgSweeps(const CcgArrays<Dim>& arrays, const CcgCoefficients<Dim, Real>& coefficients, const FiniteCells<Dim>& finite,
              ViscousCells<Dim>* viscous = nullptr, PlasticCells<Dim>* plastic = nullptr, CappedJumps<Dim>* capped = nullptr,
              const ThermalCells<Dim>* thermal = nullptr);
    CcgSweeps(const CcgSweeps&) = delete;
    CcgSweeps& operator=(const CcgSweeps&) = delete;

    void gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                  std::span<Vector<Dim>> result);
    /// As `gradient`, of the mean of both ends.
    void mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                       std::span<Vector<Dim>> result);
    /// As `mean_gradient`, of u; the arrays of displacements are exchanged.
    void gradient_of_packed(LargeArray<double>& u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                            std::span<Vector<Dim>> result, const StepEnds<Dim>& ends = {});
    /// V by cell, without the work of the loads (n_cells) [J].
    void cell_energies(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                       const FaceCorrections<Dim>& corrections, std::span<double> result);
    void boundary_displacement(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                               std::span<Vector<Dim>> displacement);
    /// From now on the functions above, but for `boundary_displacement`, compute the values of this region alone
    /// (`region_of_cells`).
    void compute_only(const Region<Dim>& region);
    /// Sets Region::chunks, which `evaluate_cells` needs.
    void divide_into_chunks(Region<Dim>& region) const;
    void evaluate_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                        std::span<Vector<Dim>> displacement, std::span<Vector<Dim>> gradient);
    void evaluate_tilted_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                               std::span<Vector<Dim>> displacement, std::span<Matrix<Dim>> displacement_gradient,
                               StepState state);
    void evaluate_cells(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                        const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result);

    /// See Ccg.
    void begin_step(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, double dt);
    void end_step();
    [[nodiscard]] std::span<const double> memory_of(std::int32_t index) const { return kept_.here().memory->of(index); }
    [[nodiscard]] std::span<const double> memory() const { return kept_.here().memory->values(); }
    void set_memory(std::span<const double> values);
    /// F - I of a cell with a law of its own, its free faces where its energy is least.
    [[nodiscard]] Matrix<Dim> law_gradient(std::int32_t c) const;
    [[nodiscard]] dynamics::Losses step_loss(std::int32_t cell) const { return kept_.loss(cell); }
    [[nodiscard]] FiniteExtremes finite_extremes(std::span<const std::int32_t> cells) const;
    void watch_strains() { strain_bounds_.assign(chunks_.size() - 1, 0.0); }
    [[nodiscard]] std::vector<std::int32_t> strained_beyond(std::span<const double> limit_of_body) const;
    [[nodiscard]] StepDefect<Dim> step_defect(std::int32_t cell, const Vector<Dim>& arm) const {
        StepDefect<Dim> defect = kept_.defect(cell);
        defect.moment += moment<Dim>(arm, Vector<Dim>(unload(load_packed<Dim>(work_.direct, cell))));
        return defect;
    }

    // Of the last call; displacement gradients and stresses of simplices are made from face and cell displacements.
    [[nodiscard]] Vector<Dim> face_displacement(BoundaryFace b) const {
        return unload<Dim>(load_packed<Dim>(work_.of_face, arrays_.face_of(b)) +
                           load_packed<Dim>(work_.u, arrays_.cell_of(b)));
    }
    [[nodiscard]] Vector<Dim> face_gradient(BoundaryFace b) const {
        return unload<Dim>(element_.units.in_newtons(in_double(load_packed<Dim>(work_.boundary_y, number_of(b)))));
    }
    [[nodiscard]] Matrix<Dim> displacement_gradient(std::int32_t c) const { return unload(present_gradient(c)); }
    [[nodiscard]] Matrix<Dim> stress(std::int32_t c) const;
    /// Whether a cell of a finite body has free faces in all directions, and with them no energy.
    [[nodiscard]] bool bears_nothing(std::int32_t c) const {
        const std::int32_t position = finite_.free_position(c);
        return position >= 0 && finite_.free()[static_cast<std::size_t>(position)].n_tangents == 0;
    }
    /// Cauchy's stress out of the plane, of a cell of DirectedCells in the plane.
    [[nodiscard]] double directed_out_of_plane_stress(std::int32_t c) const;
    /// Part that heat takes of the stress out of the plane, of any cell in it.
    [[nodiscard]] double heat_out_of_plane(std::int32_t c) const {
        return temperature_.empty() ? 0.0 : temperature_[static_cast<std::size_t>(c)] * thermal_->out_of_plane_stress(c);
    }

    /// Tables on which they work.
    [[nodiscard]] const SweepTables<Dim, Real>& tables() const { return element_.tables; }

private:
    static constexpr bool takes_finite = std::is_same_v<Real, double>;
    using Vectors = Lanes<Dim, Real>;
    using Tensor = LaneTensor<Dim, Real>;

    using Fill = typename KeptEnds<Dim>::Fill;
    /// Effect of a step on a cell that remembers.
    enum class Fate : char {
        changes,  // it remembers something else, and dissipates nothing
        flows,    // it dissipates
        stays     // it remembers the same, and what it answers is evaluated
    };

    enum Stage { loading, reconstruction, displacement_gradients, stresses, face_gradients, cell_gradients, n_stages };
    /// Chunk of one body, with its begin among the cells, faces and boundary faces.
    struct Chunk {
        std::int32_t cell, face, boundary;
        bool simplices;   // its cells are of Simplices
        bool has_finite;  // its cells are of FiniteCells
    };

    // One element
    [[nodiscard]] Tensor present_gradient(std::ptrdiff_t c) const;
    [[nodiscard]] Tensor region_gradient(std::ptrdiff_t c) const;
    [[nodiscard]] double energy(std::ptrdiff_t c) const;
    [[nodiscard]] Vectors any_boundary_displacement(const double* u, BoundaryFace b) const;
    void set_any_displacement_gradient(std::int32_t c);
    void set_any_traces(std::int32_t c);
    void set_any_stress(std::int32_t c);
    void add_stress_of_material(std::int32_t c);
    [[nodiscard]] Matrix<Dim> stress_beside(std::int32_t c, const Matrix<Dim>& g) const;
    /// Whether a cell may have a stress beside lambda and mu of its strain.
    [[nodiscard]] bool has_stress_beside() const { return arrays_.directed.any() || !temperature_.empty(); }
    void answer_to_corrections(std::int32_t c);

    // One element of a finite body
    /// The stored energy of a cell; null: its material is St. Venant and Kirchhoff's.
    [[nodiscard]] const StoredEnergy<Dim>* law(std::ptrdiff_t cell) const {
        const std::int32_t inelastic = finite_.inelastic(cell);
        return inelastic < 0 ? finite_.elastic_law(cell) : &kept_.here().memory->law(inelastic);
    }
    void advance(std::int32_t c, std::int32_t inelastic, const Matrix<Dim>& g);
    [[nodiscard]] Tensor finite_stress(std::ptrdiff_t c, const Tensor& strain) const;
    [[nodiscard]] Response<Dim> law_response(std::int32_t c, const Matrix<Dim>& g) const;
    void keep_end(std::int32_t c, const Response<Dim>& of_law, double of_jumps, Tensor& sum);
    [[nodiscard]] CellStretch end_stretch(std::int32_t c) const;
    void set_finite_displacement_gradient(std::int32_t c);
    void set_finite_stress(std::int32_t c);
    void add_stress(std::int32_t c, const Matrix<Dim>& added);
    [[nodiscard]] Matrix<Dim> elastic_stress_of_stage(std::int32_t c) const;
    void let_flow(std::int32_t c);
    void take_stress_of_flow(std::int32_t c);
    void set_push_of_contact(std::int32_t c);
    void add_linear_stress(std::int32_t c);
    void take_ends(const StepEnds<Dim>& ends);
    [[nodiscard]] bool is_kept(const KeptEnd<Dim>& kept, std::span<const Vector<Dim>> u,
                               const BoundaryLoad<Dim>& load) const;
    void set_start(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load);
    void load_end(std::int32_t chunk);
    /// Whether its cells are where the step ends, and not in its middle.
    [[nodiscard]] bool takes_end(std::int32_t chunk) const { return kept_.fills_end() && chunks_[chunk].has_finite; }
    void add_moments(std::int32_t begin, std::int32_t end);
    [[nodiscard]] Matrix<Dim> pull_back(std::int32_t c, const Matrix<Dim>& gradient) const;
    [[nodiscard]] double poisson(std::int32_t c) const;
    [[nodiscard]] std::pair<Vector<Dim>, Matrix<Dim>> tilted_face(BoundaryFace b) const;
    [[nodiscard]] Matrix<Dim> cauchy_stress(std::int32_t c) const;

    // One jump that yields: capped_sweeps.cpp
    [[nodiscard]] Vectors jump(std::int32_t c, std::int32_t half_face) const;
    [[nodiscard]] Vectors elastic_jump(std::int32_t c, std::int32_t half_face) const;
    [[nodiscard]] Matrix<Dim> trace_change(std::int32_t c) const;
    [[nodiscard]] Vector<Dim> jump_change(std::int32_t c, std::int32_t half_face, const Matrix<Dim>& of_cell) const;
    [[nodiscard]] Vector<Dim> jump_of_flow(std::int32_t c, std::int32_t half_face) const;
    void add_lasting_jumps(std::int32_t c);
    [[nodiscard]] Matrix<Dim> trace_gradient(std::int32_t c) const;
    [[nodiscard]] Matrix<Dim> gradient_at_face(std::int32_t face) const;
    [[nodiscard]] Tensor sum_capped_jumps(std::int32_t c, double& defect);

    // All
    [[nodiscard]] PlacedCorrections<Dim, Real> placed(const FaceCorrections<Dim>& corrections);
    void set_load(const BoundaryLoad<Dim>& load);
    template <class LoadCell>
    void run_sweeps(const LoadCell& load_cell, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                    std::span<Vector<Dim>> result);

    // One chunk
    void set_chunks();
    [[nodiscard]] SweepLists lists_of(const WantedElements& wanted) const;
    void load_displacement(std::span<const Vector<Dim>> u);
    void reconstruct_chunk(std::int32_t k);
    void displacement_gradients_of_chunk(std::int32_t k);
    [[nodiscard]] double largest_strain_of_chunk(std::int32_t k) const;
    void stresses_of_chunk(std::int32_t k);
    void face_gradients_of_chunk(std::int32_t k);
    void cell_gradients_of_chunk(std::int32_t k, std::span<Vector<Dim>> result) const;

    // A part of the mesh
    void run_task(const Region<Dim>& region, int stage, std::int32_t k, std::span<Vector<Dim>> result);
    void evaluate_to_displacement_gradients(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                            const BoundaryLoad<Dim>& boundary_load);

    const CcgArrays<Dim>& arrays_;
    const CcgCoefficients<Dim, Real>& coefficients_;
    const FiniteCells<Dim>& finite_;
    WorkArrays<Dim, Real> work_;
    SweepElements<Vectors> element_;  // of these arrays
    CellMoments<Dim> moments_;        // empty except during a call
    // Finite bodies
    std::vector<FreeEnd<Dim>> free_;      // by position in FiniteCells::free
    KeptEnds<Dim> kept_;                  // where their mean force is that of both ends
    std::span<const Vector<Dim>> end_;    // of the cells, while the end of a step is filled
    SweepElements<Vectors> end_element_;  // `element_` with the load at the end
    std::vector<Fate> fates_;             // at the end, by FiniteCells::inelastic
    // Change and length of the step
    ChangeInStep<Dim, Real> change_;
    double dt_ = 0.0;  // of the last step [s]
    // Null where there are none
    ViscousCells<Dim>* viscous_;
    PlasticCells<Dim>* plastic_;
    CappedJumps<Dim>* capped_;
    const ThermalCells<Dim>* thermal_;
    std::vector<double> temperature_;    // BoundaryLoad::temperature of the last call
    std::vector<Chunk> chunks_;          // one more at the end
    std::vector<double> strain_bounds_;  // by chunk, of the last call [-]; empty: nobody asks
    SweepLists wanted_;
    SweepSchedule<n_stages> schedule_;
};

}  // namespace abut::solid
