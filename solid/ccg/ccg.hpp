#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "abut/base/large_array.hpp"
#include "abut/contact/step.hpp"
#include "abut/dynamics/losses.hpp"
#include "abut/solid/ccg/step_device.hpp"
#include "abut/solid/cells/finite_options.hpp"
#include "abut/solid/cells/temperature.hpp"
#include "abut/solid/operator/boundary_reconstruction.hpp"
#include "abut/solid/operator/cell_form.hpp"
#include "abut/solid/operator/corner_weights.hpp"
#include "abut/solid/operator/operator_values.hpp"
#include "abut/solid/operator/precision.hpp"

namespace abut::solid {

/// How much the cells of bodies of Kinematics::finite are deformed at most.
struct FiniteExtremes {
    double determinant = 1.0;     ///< least det F [-]; 0 where a free face has no stretch across left
    double strain = 0.0;          ///< largest |E|, Frobenius, of St. Venant and Kirchhoff's material [-]
    std::int32_t cell = -1;       ///< with the least det F; -1 where none is below 1
    double plastic_strain = 0.0;  ///< largest equivalent one [-]

    static auto fields(auto& self) { return std::tie(self.strain, self.determinant, self.plastic_strain, self.cell); }
};

/// Cell-centred Galerkin operators of a mesh, without a matrix. docs/method.md, Space.
///
///     u_f by the stencils -> G_c and its traces I_c(x_f) -> S_c with the jumps k [u]_f -> face gradients y_f -> dV/du_c
///
/// Every result is a sum in a fixed order: the bits do not depend on the number of threads. Not safe to use from two
/// threads at once: the work arrays are shared by all calls.
template <int Dim>
class Ccg {
public:
    /// One material per body. Throws BadInput for another number of them, and as `check(Material)`,
    /// `sort_to_faces` and `select_stencils` do. `kinematics`: one per body; all that are not `finite` are linear, as
    /// all are where none are given. `precision` and `device`: of `step_gradient`, `mean_gradient` and
    /// `gradient_of_packed`; all else is in double on the host. Throws BadInput for single precision or a device where
    /// a body is finite, for both at once, and where there is no such device; LimitExceeded where the device has too
    /// little memory.
    Ccg(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials, const BoundaryConditions<Dim>& conditions,
        std::span<const Kinematics> kinematics = {}, CellForm form = CellForm::automatic,
        Precision precision = Precision::double_precision, StepDevice device = StepDevice::host,
        const FiniteOptions<Dim>& finite = {}, FreeFaces free_faces = FreeFaces::stay_alone);
    ~Ccg();
    Ccg(Ccg&&) noexcept;
    Ccg& operator=(Ccg&&) noexcept;

    [[nodiscard]] std::int32_t n_cells() const;
    [[nodiscard]] std::int32_t n_boundary() const;
    [[nodiscard]] auto boundary_faces() const { return all_ids<BoundaryFace>(n_boundary()); }

    /// From now on cells are warm: one field per body. Throws BadInput where steps are made in single precision or on a
    /// device.
    void set_temperature(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                         std::span<const TemperatureRise<Dim>> temperature);
    [[nodiscard]] bool is_warm() const;
    /// u_D and t at their times, brought to the boundary faces, and temperatures at the second; empty where no
    /// condition is given.
    [[nodiscard]] BoundaryLoad<Dim> load_at(double displacement_time, double traction_time) const;
    /// Load with u_D = 0, t = 0 and without heat.
    [[nodiscard]] BoundaryLoad<Dim> load_free() const;
    [[nodiscard]] bool load_varies() const;
    /// From now on `load_at` gives these tractions on the faces of the conditions of this group that are from outside,
    /// in the order of the group (n) [Pa]; the number and the values are not looked at.
    void set_traction(const std::string& group, std::span<const Vector<Dim>> traction);
    /// û of one boundary face [m], as `boundary_displacement` gives it for all.
    [[nodiscard]] Vector<Dim> face_displacement(BoundaryFace face, std::span<const Vector<Dim>> u,
                                                const BoundaryLoad<Dim>& load) const;
    /// Projectors onto the prescribed directions (n_boundary).
    [[nodiscard]] IdSpan<BoundaryFace, const Matrix<Dim>> prescribed() const;
    /// The boundary faces of the cell whose displacement is prescribed, in some direction at least.
    [[nodiscard]] std::vector<BoundaryFace> prescribed_faces_of(std::int32_t cell) const;
    /// x_f of a boundary face [m].
    [[nodiscard]] const Vector<Dim>& centroid(BoundaryFace face) const;

    /// û on all boundary faces (n_boundary) [m] for the cell displacements u (n_cells) [m].
    void boundary_displacement(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                               std::span<Vector<Dim>> displacement);

    /// dV/du_c (n_cells) [N] for V(u, û + delta) less the work of tractions; the gradients of `corrections` are added.
    void gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                  std::span<Vector<Dim>> result);
    /// As `gradient`, with `cell_energies` of the same state (n_cells) [J]: less than both one after the other.
    void gradient_and_energies(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                               const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                               std::span<double> energies);
    /// As `gradient`, in the precision and on the device of steps.
    void step_gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                       const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result);
    /// As `step_gradient`, of the mean of both ends: the mean of the gradient along the step; of bodies of
    /// Kinematics::finite as MeanForce says.
    void mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                       std::span<Vector<Dim>> result);
    /// As `mean_gradient`, for u as the sweeps read it: packed, lane_width numbers per cell. They keep the array and
    /// give back another one of its size.
    void gradient_of_packed(LargeArray<double>& u, const BoundaryLoad<Dim>& load, const FaceCorrections<Dim>& corrections,
                            std::span<Vector<Dim>> result, const StepEnds<Dim>& ends = {});
    /// Defect of a cell of Kinematics::finite in the last step of `mean_gradient` or `gradient_of_packed`, where
    /// MeanForce is of both ends; `arm` is its mean position, from any point [m]. The sum over the cells of a body is
    /// what counts.
    [[nodiscard]] StepDefect<Dim> step_defect(std::int32_t cell, const Vector<Dim>& arm) const;

    // Cells that remember: those of inelastic materials (FiniteOptions::inelastic), and of damped ones. A step is
    // `begin_step`, any calls, `mean_gradient` or `gradient_of_packed` of both ends, `drag`, and `end_step`; one that
    // is not ended leaves no trace.

    [[nodiscard]] bool any_inelastic() const;
    /// Whether a body of small or floating strains is, on any rank.
    [[nodiscard]] bool flows_linearly() const;
    /// Whether cells or jumps may have dissipated anything by flow in the step; nothing else than 0 is booked where not.
    [[nodiscard]] bool may_have_flowed() const;
    /// Whether what flows in the step moves faces that contact may push: they go there as it ends.
    [[nodiscard]] bool any_face_moves() const;
    [[nodiscard]] bool any_damped() const;
    /// The largest Material::damping_ratio of a mode with this frequency [rad/s].
    [[nodiscard]] double damping_ratio(double omega) const;
    void begin_step(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, double dt);
    void end_step();
    /// All cells are at rest: damping and viscosity begin from rates of 0.
    void bring_to_rest();
    /// Force of Damping::mass on a cell of this mass that moves by `motion` in a step of `dt` [N].
    [[nodiscard]] Vector<Dim> drag(std::int32_t cell, double mass, const Vector<Dim>& motion, double dt);
    /// Energy that a cell has dissipated in the last step; none where its material is elastic and not damped.
    [[nodiscard]] dynamics::Losses step_loss(std::int32_t cell) const;
    /// Equivalent plastic strain of a cell [-]; 0 where its material has none.
    [[nodiscard]] double plastic_strain(std::int32_t cell) const;
    /// In the plane, of a cell of an inelastic or orthotropic material, or a warm one, as of the last call: its stress
    /// out of the plane [Pa].
    [[nodiscard]] std::optional<double> out_of_plane_stress(std::int32_t cell) const;
    /// How many numbers a cell remembers, 0 where its material is elastic and not damped (n_cells).
    [[nodiscard]] std::vector<std::int32_t> memory_sizes() const;
    /// All that cells remember, one cell after the other.
    [[nodiscard]] std::vector<double> memory() const;
    /// The other way round; states are looked at anew.
    void set_memory(std::span<const double> values);
    /// Takes over what the cells of `before` remember, by their old numbers and those of their faces (n_cells,
    /// n_faces). Throws BadInput where the materials remember other things.
    void take_memory(const Ccg& before, std::span<const std::int32_t> old_cells, std::span<const std::int32_t> old_faces);

    /// dV/dû_f of a boundary face [N], tractions and pairs included, after the last call of `gradient` or its like;
    /// `evaluate_cells` since then has set those of its region, in double precision.
    [[nodiscard]] Vector<Dim> boundary_gradient(BoundaryFace face) const;

    /// V(u, û + delta) less the work of tractions [J].
    [[nodiscard]] double potential(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                   const FaceCorrections<Dim>& corrections);
    /// Its terms: the elastic and stabilisation energy of each cell (n_cells) [J].
    [[nodiscard]] std::vector<double> cell_energies(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                                    const FaceCorrections<Dim>& corrections);
    /// And the work of the traction on a boundary face, in the state that `cell_energies` was called for last [J].
    [[nodiscard]] double traction_work(BoundaryFace face, const BoundaryLoad<Dim>& load) const;

    /// Region that `evaluate_faces` needs for these boundary faces.
    [[nodiscard]] Region<Dim> region_of_faces(std::span<const BoundaryFace> faces) const;
    /// Region that `evaluate_cells` needs for these cells, increasing.
    [[nodiscard]] Region<Dim> region_of_cells(std::span<const std::int32_t> cells) const;
    /// û [m] and dV/ddelta [N] of the region's faces (region.faces), without contact: y - |f| t, and C^T (y - |g| t) of each
    /// face g that answers.
    void evaluate_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                        std::span<Vector<Dim>> displacement, std::span<Vector<Dim>> gradient);
    /// Region that `evaluate_tilted_faces` needs for these boundary faces: less than `evaluate_faces`.
    [[nodiscard]] Region<Dim> region_of_tilted_faces(std::span<const BoundaryFace> faces) const;
    /// û [m] of the region's faces (region.faces), and the displacement gradient G_c of the cells behind them [-].
    void evaluate_tilted_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                               std::span<Vector<Dim>> displacement, std::span<Matrix<Dim>> displacement_gradient,
                               StepState state = StepState::given);
    /// dV/du_c of the region's cells, as `gradient` gives it (region.cells) [N].
    void evaluate_cells(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                        const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result);

    /// Q_ff' among these boundary faces: how the gradients of `evaluate_faces` answer to corrections. docs/method.md, Time.
    [[nodiscard]] contact::FaceCoupling<Dim> coupling(std::span<const BoundaryFace> faces) const;

    /// From now on `gradient` and its like give dV/du_c and energies of these cells alone, increasing, and boundary
    /// gradients of their faces: what no such value depends on is left out, and holds what it held. Returns the cells
    /// whose displacements these values depend on, increasing; those of others are not read.
    std::vector<std::int32_t> compute_only(std::span<const std::int32_t> cells);
    /// From now on the two below look at these boundary faces alone, not at all.
    void watch_only(std::span<const BoundaryFace> faces);
    /// How far a boundary face has moved at most from one state to another [m]; a close bound, much cheaper than the motion.
    [[nodiscard]] double motion_bound(std::span<const Vector<Dim>> u_from, const BoundaryLoad<Dim>& load_from,
                                      std::span<const Vector<Dim>> u_to, const BoundaryLoad<Dim>& load_to);
    /// Under constant loads `motion_bound` grows by at most this times the motion of the cell that moves farthest [-].
    [[nodiscard]] double motion_amplification() const;
    /// Weights of the cells that move a point of a boundary face at `arm` from its centroid, which tilts with the cell
    /// behind where no support prescribes how it moves.
    [[nodiscard]] CornerWeights corner_weights(BoundaryFace face, const Vector<Dim>& arm) const;

    /// G_c and sigma_c [-], [Pa], as of the last call of `gradient`, its like or `potential`. Where `evaluate_faces`,
    /// `evaluate_tilted_faces` or `evaluate_cells` were called since then, those of their region are of that state, and of
    /// cells beside it they are not to be used unless it was the same.
    [[nodiscard]] Matrix<Dim> displacement_gradient(std::int32_t cell) const;
    [[nodiscard]] Matrix<Dim> stress(std::int32_t cell) const;
    /// Stress of a cell with the forces of contact on its free faces, those of the last call that had corrections.
    /// sigma_c alone balances the faces as if nothing pushed them [Pa].
    [[nodiscard]] Matrix<Dim> stress_under_pushes(std::int32_t cell) const;

    /// Extremes of these cells, increasing, at the end of the step or in the state that `gradient` was called for last.
    [[nodiscard]] FiniteExtremes finite_extremes(std::span<const std::int32_t> cells) const;

    /// From now on steps keep in mind how far cells are strained, for `strained_beyond`. On the host in double precision.
    void watch_strains();
    /// Cells whose strain may be beyond the limit of their body [-] in the state that `gradient` or its like was called for
    /// last, increasing: |eps| or, of finite bodies, |E| is not below it, or contact or bonds push a face of theirs. All
    /// cells for a limit below 0, none for an infinite one. One limit per body; needs `watch_strains`.
    [[nodiscard]] std::vector<std::int32_t> strained_beyond(std::span<const double> limit_of_body) const;

    /// Report on interior faces only; `boundary` has that of the others.
    [[nodiscard]] const StencilReport& stencil_report() const;
    [[nodiscard]] const BoundaryReconstruction<Dim>& boundary() const;
    /// By face; a boundary face has weight 0 throughout, or is one of BoundaryReconstruction::affine.
    [[nodiscard]] std::span<const FaceStencil<Dim>> stencils() const;
    /// Normal stiffness of a boundary half-cell [Pa/m]: (lambda + 2 mu) |f|/|c|, less where other faces answer (CornerRule).
    [[nodiscard]] double normal_stiffness(BoundaryFace face) const;
    /// Cells on whose displacement û of this boundary face depends.
    [[nodiscard]] std::span<const std::int32_t> cells_of(BoundaryFace face) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace abut::solid
