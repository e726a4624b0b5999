#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/ccg/placed_corrections.hpp"
#include "abut/solid/ccg/sweep_schedule.hpp"
#include "abut/solid/cells/finite_pool.hpp"
#include "abut/solid/cells/linear_materials.hpp"
#include "abut/solid/cells/linear_pool.hpp"
#include "abut/solid/cells/sweep_lists.hpp"
#include "abut/solid/cells/sweep_state.hpp"
#include "abut/solid/operator/arrays.hpp"

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
/// Cells are in three pools (CellPool). All cells of a chunk of the mesh are in the same one.
///
/// Real is what the numbers of the operators and the work arrays are, all but displacements: these are double, and so are
/// their differences, before they are rounded, and the sums that cells receive. In float there are no bodies of
/// Kinematics::finite, and nothing of LinearMaterials.
template <int Dim, class Real = double>
class CcgSweeps {
public:
    /// For single precision: all bodies are of linear elasticity. All must outlive the sweeps.
    CcgSweeps(const CcgArrays<Dim>& arrays, const CcgCoefficients<Dim, Real>& coefficients,
              const FiniteCells<Dim>& finite) requires std::is_same_v<Real, float>;
    /// All must outlive the sweeps.
    CcgSweeps(const CcgArrays<Dim>& arrays, const FiniteCells<Dim>& finite, ViscousCells<Dim>& viscous,
              PlasticCells<Dim>& plastic, CappedJumps<Dim>& capped,
              const ThermalCells<Dim>& thermal) requires std::is_same_v<Real, double>;
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
    /// As `gradient`, with `cell_energies` of the same state.
    void gradient_and_energies(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                               const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                               std::span<double> energies);
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
    /// Keeps where the step ended. Cells that remember end it by RememberingCells::end_step.
    void end_step() { state_.change.keep_end(); }
    [[nodiscard]] FiniteExtremes finite_extremes(std::span<const std::int32_t> cells) const;
    void watch_strains() { strain_bounds_.assign(chunks_.size() - 1, 0.0); }
    [[nodiscard]] std::vector<std::int32_t> strained_beyond(std::span<const double> limit_of_body) const;
    [[nodiscard]] StepDefect<Dim> step_defect(std::int32_t cell, const Vector<Dim>& arm) const {
        StepDefect<Dim> defect = finite_.defect(cell);
        defect.moment += moment<Dim>(arm, Vector<Dim>(unload(load_packed<Dim>(state_.work.direct, cell))));
        return defect;
    }

    // Of the last call; displacement gradients and stresses of simplices are made from face and cell displacements.
    [[nodiscard]] Vector<Dim> face_displacement(BoundaryFace b) const { return state_.face_displacement(b); }
    [[nodiscard]] Vector<Dim> face_gradient(BoundaryFace b) const {
        const SweepElements<Vectors>& element = state_.element;
        return unload<Dim>(element.units.in_newtons(in_double(load_packed<Dim>(state_.work.boundary_y, number_of(b)))));
    }
    [[nodiscard]] Matrix<Dim> displacement_gradient(std::int32_t c) const {
        return unload(state_.element.present_gradient(c));
    }
    [[nodiscard]] Matrix<Dim> stress(std::int32_t c) const;
    /// Cauchy's stress out of the plane, of a cell of DirectedCells in the plane.
    [[nodiscard]] double directed_out_of_plane_stress(std::int32_t c) const;
    [[nodiscard]] const LinearMaterials<Dim>& materials() const { return materials_; }
    [[nodiscard]] const FinitePool<Dim>& finite() const { return finite_; }
    [[nodiscard]] FinitePool<Dim>& finite() { return finite_; }

    /// Tables on which they work.
    [[nodiscard]] const SweepTables<Dim, Real>& tables() const { return state_.element.tables; }

private:
    static constexpr bool is_double = std::is_same_v<Real, double>;
    using Vectors = Lanes<Dim, Real>;
    /// Member that single precision does not have.
    struct Absent {};

    enum Stage { loading, reconstruction, displacement_gradients, stresses, face_gradients, cell_gradients, n_stages };
    enum class Kind : char { linear, simplices, finite };
    /// Chunk of one body, with its begin among the cells, faces and boundary faces.
    struct Chunk {
        std::int32_t cell, face, boundary;
        Kind kind;  // of its cells
    };

    [[nodiscard]] Kind kind_of(std::int32_t c) const {
        if (state_.arrays.simplices.contains(c)) return Kind::simplices;
        return state_.finite.contains(c) ? Kind::finite : Kind::linear;
    }
    /// visit(pool) with the pool of this kind.
    template <class Sweeps, class Visit>
    static decltype(auto) in_pool(Sweeps& sweeps, Kind kind, const Visit& visit) {
        if (kind == Kind::simplices) return visit(sweeps.simplices_);
        if constexpr (is_double)
            if (kind == Kind::finite) return visit(sweeps.finite_);
        return visit(sweeps.linear_);
    }
    template <class Visit>
    decltype(auto) in_pool_of_chunk(std::int32_t k, const Visit& visit) {
        return in_pool(*this, chunks_[static_cast<std::size_t>(k)].kind, visit);
    }
    /// visit(materials) if the strains of the chunk are linear.
    template <class Visit>
    void with_materials_of(std::int32_t k, const Visit& visit) {
        if constexpr (is_double)
            if (chunks_[static_cast<std::size_t>(k)].kind != Kind::finite) visit(materials_);
    }

    // One element
    [[nodiscard]] double energy(std::int32_t c) const;
    [[nodiscard]] Vectors elastic_jump(std::int32_t c, std::int32_t half_face) const;
    [[nodiscard]] Vectors any_boundary_displacement(const double* u, BoundaryFace b) const;
    void set_any_traces(std::int32_t c);
    void set_any_stress(std::int32_t c);
    void answer_to_corrections(std::int32_t c);
    void add_moments(std::int32_t begin, std::int32_t end);
    [[nodiscard]] std::pair<Vector<Dim>, Matrix<Dim>> tilted_face(BoundaryFace b) const;

    // All
    void take_ends(const StepEnds<Dim>& ends);
    [[nodiscard]] PlacedCorrections<Dim, Real> placed(const FaceCorrections<Dim>& corrections);
    template <class LoadCell>
    void run_sweeps(const LoadCell& load_cell, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                    std::span<Vector<Dim>> result, std::span<double> energies = {});

    // One chunk
    void set_chunks();
    [[nodiscard]] SweepLists lists_of(const WantedElements& wanted) const;
    void reconstruct_chunk(std::int32_t k);
    void displacement_gradients_of_chunk(std::int32_t k);
    void energies_of_chunk(std::int32_t k, std::span<double> result) const;
    void stresses_of_chunk(std::int32_t k);
    void face_gradients_of_chunk(std::int32_t k);
    void cell_gradients_of_chunk(std::int32_t k, std::span<Vector<Dim>> result) const;

    // A part of the mesh
    void run_task(const Region<Dim>& region, int stage, std::int32_t k, std::span<Vector<Dim>> result);
    void evaluate_to_displacement_gradients(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                            const BoundaryLoad<Dim>& boundary_load);

    SweepState<Dim, Real> state_;
    LinearPool<Dim, Real> linear_{state_};
    SimplexPool<Dim, Real> simplices_{state_};
    std::conditional_t<is_double, FinitePool<Dim>, Absent> finite_;
    std::conditional_t<is_double, LinearMaterials<Dim>, Absent> materials_;
    std::vector<Chunk> chunks_;          // one more at the end
    std::vector<double> strain_bounds_;  // by chunk, of the last call [-]; empty: nobody asks
    SweepLists wanted_;
    SweepSchedule<n_stages> schedule_;
};

}  // namespace abut::solid
