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
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/ccg/cell_moments.hpp"
#include "abut/solid/ccg/finite_cells.hpp"
#include "abut/solid/ccg/sweep_lists.hpp"
#include "abut/solid/ccg/sweep_schedule.hpp"

namespace abut::solid {

/// sigma of a simplex, and the sum of u_f - u_c over its faces.
template <int Dim, class Real>
struct SimplexState {
    LaneTensor<Dim, Real> stress;
    Lanes<Dim, Real> sum;
};

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
/// and in a condensed cell the free face follows from the others: û_b - u_c = -A_bb^-1 sigma' |b| n_b, sigma' without it; with
/// z = A_bb^-1 y_b, R^T y_b is what the stress -C:(z (x) |b| n_b)/|c| does on the faces of the cell.
///
/// Real is what the numbers of the operators and the work arrays are, all but displacements: these are double, and so are
/// their differences, before they are rounded, and the sums that cells receive. In float there are no bodies of
/// Kinematics::finite.
template <int Dim, class Real = double>
class CcgSweeps {
public:
    /// All must outlive the sweeps.
    CcgSweeps(const CcgArrays<Dim>& arrays, const CcgCoefficients<Dim, Real>& coefficients, const FiniteCells<Dim>& finite);
    CcgSweeps(const CcgSweeps&) = delete;
    CcgSweeps& operator=(const CcgSweeps&) = delete;

    void gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                  std::span<Vector<Dim>> result, const StepEnds<Dim>& ends = {});
    /// The same of the mean of both ends.
    void mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                       std::span<Vector<Dim>> result);
    /// The same of u; the arrays of displacements are exchanged.
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
                               std::span<Vector<Dim>> displacement, std::span<Matrix<Dim>> displacement_gradient);
    void evaluate_cells(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                        const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result);

    /// See Ccg.
    [[nodiscard]] FiniteExtremes finite_extremes(std::span<const std::int32_t> cells) const;

    // Of the last call; displacement gradients and stresses of simplices are made from face and cell displacements.
    [[nodiscard]] Vector<Dim> face_displacement(BoundaryFace b) const {
        return unload<Dim>(load_packed<Dim>(of_face_, arrays_.face_of(b)) + load_packed<Dim>(u_, arrays_.cell_of(b)));
    }
    [[nodiscard]] Vector<Dim> face_gradient(BoundaryFace b) const {
        return unload<Dim>(units_.in_newtons(converted<double>(load_packed<Dim>(boundary_y_, number_of(b)))));
    }
    [[nodiscard]] Matrix<Dim> displacement_gradient(std::int32_t c) const { return unload(present_gradient(c)); }
    [[nodiscard]] Matrix<Dim> stress(std::int32_t c) const;

private:
    static constexpr bool takes_finite = std::is_same_v<Real, double>;

    class PlacedCorrections;
    enum Stage { loading, reconstruction, displacement_gradients, stresses, face_gradients, cell_gradients, n_stages };
    /// Of one body. Where it begins among the cells, faces and boundary faces.
    struct Chunk {
        std::int32_t cell, face, boundary;
        bool simplices;   // its cells are of Simplices
        bool has_finite;  // its cells are of FiniteCells
    };

    // One element
    [[nodiscard]] Lanes<Dim> displacement(std::ptrdiff_t c) const { return load_packed<Dim>(u_, c); }
    [[nodiscard]] Lanes<Dim, Real> reconstructed(const LargeArray<double>& u, std::ptrdiff_t f) const;
    [[nodiscard]] Lanes<Dim, Real> reconstructed_boundary(const LargeArray<double>& u, BoundaryFace b,
                                                          const BoundaryLoad<Dim>& boundary_load) const;
    template <class Relative>
    [[nodiscard]] LaneTensor<Dim, Real> gradient_of(const LargeArray<double>& u, std::ptrdiff_t c,
                                                    const Relative& relative) const;
    void set_traces(std::ptrdiff_t c, const LaneTensor<Dim, Real>& g);
    void set_displacement_gradient(std::ptrdiff_t c);
    [[nodiscard]] LaneTensor<Dim, Real> sum_jumps(std::ptrdiff_t c);
    void set_stress(std::ptrdiff_t c);
    [[nodiscard]] Lanes<Dim, Real> interior_gradient(std::ptrdiff_t f) const;
    [[nodiscard]] Lanes<Dim, Real> boundary_gradient(BoundaryFace b, const BoundaryLoad<Dim>& boundary_load) const;
    [[nodiscard]] Lanes<Dim> cell_gradient(std::ptrdiff_t c) const;
    [[nodiscard]] Lanes<Dim> boundary_cell_gradient(std::ptrdiff_t position) const;
    [[nodiscard]] LaneTensor<Dim, Real> present_gradient(std::ptrdiff_t c) const;
    [[nodiscard]] double energy(std::ptrdiff_t c) const;

    // One element of a body of simplices
    template <class Relative>
    [[nodiscard]] SimplexState<Dim, Real> simplex_state(const LargeArray<double>& u, std::int32_t c,
                                                        const Relative& relative) const;
    [[nodiscard]] Lanes<Dim, Real> condensed_face(const CondensedCell& condensed, const LaneTensor<Dim, Real>& stress,
                                                  const BoundaryLoad<Dim>& boundary_load) const;
    void add_condensed_face(const CondensedCell& condensed, const BoundaryLoad<Dim>& boundary_load);
    void set_simplex_stress(std::int32_t c);
    void set_simplex_jumps(std::int32_t c);
    [[nodiscard]] Lanes<Dim, Real> interior_gradient_of_simplices(std::ptrdiff_t f) const;
    void condense(const CondensedCell& condensed, const BoundaryLoad<Dim>& boundary_load);

    // One element of any body
    [[nodiscard]] Lanes<Dim, Real> any_boundary_displacement(const LargeArray<double>& u, BoundaryFace b,
                                                             const BoundaryLoad<Dim>& boundary_load) const;
    void set_any_displacement_gradient(std::int32_t c, const BoundaryLoad<Dim>& boundary_load);
    void set_any_stress(std::int32_t c);
    void answer_to_corrections(std::int32_t c, const BoundaryLoad<Dim>& boundary_load);
    void set_any_face_gradient(std::int32_t f);

    // One element of a finite body
    [[nodiscard]] LaneTensor<Dim, Real> finite_stress(std::ptrdiff_t c, const LaneTensor<Dim, Real>& strain) const;
    [[nodiscard]] CellStretch end_stretch(std::ptrdiff_t c) const;
    [[nodiscard]] Lanes<Dim, Real> boundary_change(BoundaryFace b) const;
    void set_finite_displacement_gradient(std::ptrdiff_t c);
    void set_finite_stress(std::ptrdiff_t c);
    void load_change(const StepEnds<Dim>& ends);
    void add_moments(std::int32_t begin, std::int32_t end);
    [[nodiscard]] std::pair<Vector<Dim>, Matrix<Dim>> tilted_face(BoundaryFace b) const;
    [[nodiscard]] Matrix<Dim> cauchy_stress(std::int32_t c) const;

    template <class LoadCell>
    void run_sweeps(const LoadCell& load_cell, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                    std::span<Vector<Dim>> result);

    // One chunk
    void set_chunks();
    [[nodiscard]] SweepLists lists_of(const WantedElements& wanted) const;
    void load_displacement(std::span<const Vector<Dim>> u);
    void reconstruct_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load);
    void displacement_gradients_of_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load);
    void stresses_of_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load);
    void face_gradients_of_chunk(std::int32_t k, const BoundaryLoad<Dim>& boundary_load);
    void cell_gradients_of_chunk(std::int32_t k, std::span<Vector<Dim>> result) const;

    // A part of the mesh
    void run_task(const Region<Dim>& region, int stage, std::int32_t k, const BoundaryLoad<Dim>& boundary_load,
                  std::span<Vector<Dim>> result);
    void evaluate_to_displacement_gradients(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                            const BoundaryLoad<Dim>& boundary_load);

    const CcgArrays<Dim>& arrays_;
    const CcgCoefficients<Dim, Real>& coefficients_;
    const FiniteCells<Dim>& finite_;
    [[no_unique_address]] SweepUnits<Dim, Real> units_;
    // Work arrays of registers.
    LargeArray<double> u_;            // displacement, by cell
    LargeArray<Real> of_face_;        // u_f - u_c of the first side, later y of interior faces, by face
    LargeArray<Real> g_;              // displacement gradient, by cell
    LargeArray<Real> trace_;          // I_c(x_f) - u_c of the first side, by half-face
    LargeArray<Real> s_;              // S_c, by cell
    LargeArray<Real> deviation_;      // d_c, by cell of simplices
    LargeArray<Real> direct_;         // sum of k [u], by cell
    LargeArray<Real> boundary_y_;     // dV/dũ_f, by boundary face
    LargeArray<Real> correction_;     // delta_f and answers, by boundary face; zero except during a call
    LargeArray<Real> pair_gradient_;  // by boundary face; zero but during a call
    CellMoments<Dim> moments_;        // empty except during a call
    // Of finite bodies, changes from the start of a step to its end; empty without any.
    LargeArray<double> u_change_;
    LargeArray<Real> relative_change_;
    LargeArray<Real> g_change_;
    std::vector<CondensedStep<Dim>> condensed_;  // by position in FiniteCells::free
    bool has_change_ = false;
    std::vector<Chunk> chunks_;  // one more at the end
    SweepLists wanted_;
    SweepSchedule<n_stages> schedule_;
};

}  // namespace abut::solid
