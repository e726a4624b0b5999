#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "abut/dynamics/point_system.hpp"
#include "abut/dynamics/ranks.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/combinations/features.hpp"
#include "abut/solid/load/outside_work.hpp"
#include "abut/solid/options/options.hpp"

namespace abut {
class StateReader;
class StateWriter;
}  // namespace abut

namespace abut::dynamics {
struct ContactCounts;
struct IntegratorState;
struct StableStep;
template <int Dim>
struct ContactPatch;
}  // namespace abut::dynamics

namespace abut::solid {

template <int Dim>
class Bodies;
template <int Dim>
struct Change;
struct BondChange;
template <int Dim>
class BondView;
template <int Dim>
class Bonds;
template <int Dim>
class BodyFrames;
template <int Dim>
class BodyRotation;
template <int Dim>
class CellView;
template <int Dim>
class ContactDriver;
template <int Dim>
class ContactState;
template <int Dim>
class ContactView;
template <int Dim>
class FrameLoads;
template <int Dim>
class Loads;
template <int Dim>
class LocalLevels;
template <int Dim>
class OutsideLoads;
template <int Dim>
class OutsideView;
template <int Dim>
class PointLoads;
template <int Dim>
class RankPart;
template <int Dim>
class Solid;
template <int Dim>
class TrapezoidClosure;

template <int Dim>
[[nodiscard]] Change<Dim> change(Solid<Dim>& before, const dynamics::IntegratorState& motion, Solid<Dim>& after,
                                 std::span<const std::int32_t> old_cells);

/// Deformable bodies on one mesh, in contact with each other and with rigid obstacles: a System. With contact or with loads
/// that vary it is for one run, beginning at t = 0: loads, work and contacts go on from one `mean_force` to the next.
///
/// Its points are the cells of the bodies that deform, in their order, then Dim + 1 points of each body of
/// Kinematics::rigid, which stay at their distances (ConstrainedSystem): displacements q, forces and momenta have shape
/// (n_points, Dim).
///
/// A face whose displacement is prescribed along its normal is a rigid one to what touches it, on the path of the support.
///
/// `force`, `potential` and `contact_at` take any state before the first step, and later the last state or one that no
/// face has left by more than half the skin since the last search; they throw Misuse for others.
template <int Dim>
class Solid {
public:
    static constexpr int dimension = Dim;

    /// The mesh must outlive the solid. Throws BadInput saying where, how much, how much is allowed and what to do.
    ///
    /// On several ranks `mesh` is that of a part (part_of), and `ranks`, which must outlive the solid, tell whose its
    /// points are (points_of, ranks::PointRanks): those of the solid are the ones of this rank then, and functions that
    /// take q or p, `state` and `restore` are calls of all ranks together, except CellView::displacement_gradient. All
    /// bits are those of one rank; what is not made for several throws BadInput (docs/ranks.md).
    Solid(const mesh::Mesh<Dim>& mesh, SolidOptions<Dim> options, const dynamics::Ranks& ranks = dynamics::one_rank());
    Solid(const Solid&) = delete;
    Solid& operator=(const Solid&) = delete;
    ~Solid();

    [[nodiscard]] std::size_t size() const { return inverse_mass().size(); }
    [[nodiscard]] std::span<const double> inverse_mass() const;
    [[nodiscard]] std::span<const double> masses() const;                ///< of the points (n_points) [kg]
    [[nodiscard]] std::span<const Vector<Dim>> rest_positions() const;   ///< of the points (n_points) [m]
    [[nodiscard]] std::span<const std::int32_t> body_of_points() const;  ///< (n_points)
    /// Arms of angular momentum. Where no body turns strains are linear, and what is free keeps it about the positions
    /// at rest; bodies with a frame of their own keep J~.
    [[nodiscard]] dynamics::MomentArms moment_arms() const;
    /// The part of 2/omega_max that is stable [-]: a closed contact stiffens its cells, and noise feeds the alternating
    /// mode of bodies of Kinematics::finite. docs/method.md, Space and Bodies that bend.
    [[nodiscard]] double step_margin() const;
    /// The largest of all cells (Material::damping_ratio). A call of all ranks.
    [[nodiscard]] double damping_ratio(double omega) const;

    /// With what holds rigid bodies together, at the velocities around the last node.
    void force(std::span<const double> q, std::span<double> force);
    /// The bulk is taken at the midpoint where it is linear, else by its discrete gradient; contact exactly along the path.
    /// Throws Misuse where the step should begin when the last one ended but does not, Diverged or TooDeep when the
    /// run has diverged or a pair is pressed in deeper than `compression_limit`. After such an error a run with loads that
    /// vary is over; another may try a shorter step.
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                    std::span<double> force);
    /// F(q_1) after the straight path from q_0: for schemes that take no mean. Loads, candidates and admission follow the
    /// step as in `mean_force`: tractions are those at its start. Contacts that open and close again inside it go unnoticed.
    /// Work from outside is taken by the trapezoidal rule. Throws as `mean_force`.
    void end_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                   std::span<double> force);
    // ConstrainedSystem: rigid bodies
    [[nodiscard]] bool has_constraints() const;
    [[nodiscard]] bool is_constrained(std::int32_t point) const;
    void constrain_along(std::span<const double> q, double dt, std::span<double> p);
    void constrain_at(std::span<const double> q, double dt, std::span<double> p);
    /// RateSystem: what dashpots and brakes act on next is the mean of the rates of p in q and of those of the next
    /// step. So is what damped materials act on where p is 0 everywhere; else their rates stay those of the last step.
    void set_rates(std::span<const double> q, std::span<const double> p);
    /// Whether V depends on q alone: no condition has a history, no obstacle a path, and no material remembers.
    [[nodiscard]] bool is_autonomous() const;
    /// Local time steps: each cell on the level of its degrees of freedom, with their force evaluated as often as the finest
    /// level among the cells that it depends on. Throws BadInput if a boundary condition has a history or the
    /// components of a cell disagree.
    void set_levels(std::int32_t n_levels, std::span<const std::int32_t> level);
    /// Adds to the impulse [N s] what acts during dt on the cells whose force is evaluated at this level. Contact, with its
    /// events, belongs to the finest level, whose calls lead the run as those of `mean_force` do. Throws as `mean_force`.
    void add_impulse(std::int32_t level, const dynamics::FreeFlight& flight, double time, double dt,
                     std::span<double> impulse);
    /// Forces of cells that the steps have evaluated in the bulk so far.
    [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

    /// Elastic and stabilisation energy of the state with its contact corrections, less the work of the loads [J].
    [[nodiscard]] double potential(std::span<const double> q);
    /// `potential`, and `force` of the same state: less than both one after the other.
    [[nodiscard]] double potential_and_force(std::span<const double> q, std::span<double> force);
    /// Work of prescribed displacements, of changing tractions, of moving obstacles and of interference so far [J].
    [[nodiscard]] double work() const { return work_; }
    /// Energy that materials have dissipated so far by flow, damping and viscosity, and bonds that broke; friction is
    /// not counted [J].
    [[nodiscard]] dynamics::Losses dissipated() const { return dissipated_; }
    /// The linear part alone, without loads and contact: K q [N]; for the stable step.
    void stiffness_product(std::span<const double> q, std::span<double> product);

    /// Parts of the bodies that were in contact during the last step; bodies joined by a pair are in one patch.
    [[nodiscard]] std::vector<dynamics::ContactPatch<Dim>> contact_patches() const;
    /// F(q) on some points only (n, Dim) [N], q being where the last step ended. Costs as much as these cells, and the pairs
    /// of the candidate list. Of bodies that turn the change of their frame during a step is left out.
    void end_force_on(std::span<const std::int32_t> points, std::span<const double> q, std::span<Vector<Dim>> force);

    /// All that the next steps depend on beside q and p: loads, work, dashpots, rigid bodies, what pairs remember. Bytes,
    /// versioned, with a checksum; the same on all ranks, for any number of them.
    [[nodiscard]] std::vector<std::byte> state() const;
    /// dynamics::stable_step with all bonds broken that have a strength, which hold again afterwards. A call of all ranks.
    [[nodiscard]] dynamics::StableStep stable_step_in_parts();
    /// Goes on in q, where the last step before `state` ended, with a solid made of the same mesh with the same options: the
    /// next steps have the same bits. Contact has no force on obstacles and no patches before the next step. Throws BadInput
    /// for bytes that are damaged, of another version, mesh or options; the solid is of no use then.
    void restore(std::span<const std::byte> state, std::span<const double> q);
    /// A run begins in the present state: time, work and all counts are 0 from here on, while loads, dashpots, pairs
    /// and faces remember what they do. For loads and obstacles whose paths are the same at all times.
    void begin_run();
    /// Goes on with a solid of another mesh, which has fewer cells or other numbers. change.hpp.
    friend Change<Dim> change<Dim>(Solid<Dim>& before, const dynamics::IntegratorState& motion, Solid<Dim>& after,
                                   std::span<const std::int32_t> old_cells);

    /// Tractions on a group with a TractionCondition::from_outside, in the order of its faces, that act from the next
    /// step on until they are set again (n_faces) [Pa]; what that changes in V is booked as work. A call of all ranks, each
    /// with the faces that it has (OutsideView). Throws BadInput, and nothing has changed, for another group, another
    /// number, or one that is not finite. docs/loads.md.
    void set_traction(const std::string& group, std::span<const Vector<Dim>> traction);
    /// Work of tractions from outside so far; q is where the last step ended. A call of all ranks.
    [[nodiscard]] OutsideWork outside_work(std::span<const double> q) const;

    // Parts, each in a value of its own

    [[nodiscard]] ContactView<Dim> contact() const;  ///< contact_view.hpp
    /// Contact in state q; a call of all ranks. contact_view.hpp.
    [[nodiscard]] ContactState<Dim> contact_at(std::span<const double> q);
    [[nodiscard]] dynamics::ContactCounts contact_counts() const;  ///< what of it the ledger records
    [[nodiscard]] BondView<Dim> bonds() const;                     ///< bond_view.hpp
    [[nodiscard]] CellView<Dim> cells() const;                     ///< stresses, displacements. cell_view.hpp
    /// Faces of a group that is loaded from outside; its functions throw BadInput for another group. outside_view.hpp.
    [[nodiscard]] OutsideView<Dim> outside(const std::string& group) const;

    [[nodiscard]] const dynamics::Ranks& ranks() const;  ///< that the points are shared out to; one alone has all
    [[nodiscard]] const mesh::Mesh<Dim>& mesh() const { return mesh_; }
    [[nodiscard]] const SolidOptions<Dim>& options() const { return options_; }
    /// Operators of the bodies that deform: where some are rigid, with cells and faces numbered without theirs.
    [[nodiscard]] Ccg<Dim>& ccg() { return ccg_; }
    [[nodiscard]] const Ccg<Dim>& ccg() const { return ccg_; }
    [[nodiscard]] const SolidTimes& times() const { return times_; }
    /// How far each body has turned in q (n_bodies) [rad], 0 to pi: the angle of the nearest rotation. One of
    /// Kinematics::small grows by 1/cos of it, without a force against that. docs/limits.md.
    [[nodiscard]] std::vector<double> rotations(std::span<const double> q) const;
    /// By how much the cell of a body that turns most turns against its frame in q (n_bodies) [rad]; of a small body against
    /// space, of a rigid or finite one 0. Strains of the others are linear: beyond 0.1 a body should be split, or be finite.
    [[nodiscard]] std::vector<double> local_rotations(std::span<const double> q);

    friend class BondView<Dim>;
    friend class CellView<Dim>;
    friend class ContactState<Dim>;
    friend class ContactView<Dim>;
    friend class OutsideView<Dim>;

private:
    // By point of this system or, on several ranks, by point of the part (RankPart): all that is private takes the latter.
    struct Step {
        std::span<const Vector<Dim>> start, end;  // [m]
        double time, dt;                          // of its start, and how long it takes [s]
        contact::TakenForce take;
        /// Part of its work from outside that goes with this force; the rest goes with the one before.
        [[nodiscard]] double share() const { return take == contact::TakenForce::mean ? 1.0 : 0.5; }
    };
    [[nodiscard]] std::span<const Vector<Dim>> state_here(std::span<const double> q);
    [[nodiscard]] Step step_here(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                                 contact::TakenForce take);
    [[nodiscard]] std::span<Vector<Dim>> result_here(std::span<double> of_points);
    void take_result(std::span<double> of_points) const;
    void stand_at(std::span<const Vector<Dim>> u);
    [[nodiscard]] double potential_here(std::span<const Vector<Dim>> u);
    [[nodiscard]] double with_other_energies(std::span<const Vector<Dim>> u, double stored) const;
    [[nodiscard]] double stored_energy(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load);
    [[nodiscard]] double sum_of_stored(std::span<const double> of_cells, const BoundaryLoad<Dim>& load) const;
    void add_other_forces(std::span<const Vector<Dim>> u, std::span<Vector<Dim>> gradient);
    void unite_frames();
    void part_frames(std::span<const Vector<Dim>> q);
    void meet_other_ranks();

    [[nodiscard]] std::span<const Vector<Dim>> of_cells(std::span<const Vector<Dim>> q) const;
    void stiffness_of_cells(std::span<const Vector<Dim>> u, std::span<Vector<Dim>> result);
    void rigid_to_force(std::span<Vector<Dim>> force) const;
    template <class Constrain>
    void constrain_own(std::span<const double> q, std::span<double> p, const Constrain& constrain);
    void add_point_loads(const Step& step, std::span<Vector<Dim>> force);
    [[nodiscard]] Matrix<Dim> mean_turn(std::int32_t body) const;
    void require_start(double time, double dt) const;
    void follow_loads(const Step& step);
    [[nodiscard]] double follow_frames(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1);
    [[nodiscard]] std::span<const Vector<Dim>> in_frames(std::span<const Vector<Dim>> q,
                                                         std::span<const std::int32_t> cells);
    void to_force(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, std::span<Vector<Dim>> gradient);
    void evaluate_patch(std::span<const std::int32_t> cells, std::span<const Vector<Dim>> u,
                        std::span<Vector<Dim>> gradient);
    void require_no_collapse();
    void add_work(double share);
    void finish_step(const Step& step, std::span<Vector<Dim>> gradient, std::span<double> force);
    [[nodiscard]] std::vector<BondChange> bonds_that_give_way(const Step& step, const BoundaryLoad<Dim>& start_load);
    [[nodiscard]] double energy_lost_by(std::span<const BondChange> changes, const Step& step,
                                        const BoundaryLoad<Dim>& start_load);
    [[nodiscard]] double open(std::vector<BondChange>& changes, const Step& step, const BoundaryLoad<Dim>& start_load);
    void flow_faces(std::span<const Vector<Dim>> q_1);
    void end_step(double time);
    void book_losses();
    void save_memory(StateWriter& state) const;
    void restore_memory(StateReader& state);
    [[nodiscard]] bool any_inelastic() const { return ccg_.any_inelastic(); }
    /// Whether a material remembers and dissipates: only schemes that call `mean_force` may run it.
    [[nodiscard]] bool any_memory() const { return any_inelastic() || ccg_.any_damped(); }
    /// Throws BadInput where a use of the solid does not go with what it has (solid::require_together).
    void require(FeatureSet of_use) const;
    [[nodiscard]] dynamics::IntegratorState take_over(const Solid& before, const dynamics::IntegratorState& motion,
                                                      std::span<const std::int32_t> old_cells);
    void check_old_cells(const Solid& before, std::span<const std::int32_t> old_cells) const;
    [[nodiscard]] dynamics::IntegratorState motion_of(const Solid& before, const dynamics::IntegratorState& motion,
                                                      std::span<const std::int32_t> old_cells) const;
    [[nodiscard]] StepEnds<Dim> step_ends(const Step& step, const BoundaryLoad<Dim>& start_load);
    void add_drag(const Step& step, std::span<Vector<Dim>> force);
    void add_contact_impulse(const dynamics::FreeFlight& flight, double time, double dt, std::span<Vector<Dim>> impulse);
    [[nodiscard]] FaceCorrections<Dim> corrections();

    const mesh::Mesh<Dim>& mesh_;
    SolidOptions<Dim> options_;
    FeatureSet features_;  // of all bodies and of the whole
    std::unique_ptr<Bodies<Dim>> bodies_;
    std::unique_ptr<RankPart<Dim>> part_;  // of this rank
    Ccg<Dim> ccg_;                         // of the bodies that deform
    std::unique_ptr<BodyRotation<Dim>> rotation_;
    std::unique_ptr<BodyFrames<Dim>> frames_;
    std::unique_ptr<PointLoads<Dim>> point_loads_;
    SolidTimes times_;
    std::int64_t evaluations_ = 0;
    double work_ = 0.0;
    dynamics::Losses dissipated_;
    FiniteExtremes finite_extremes_;  // the cell in the mesh
    double time_ = 0.0;               // of the state that the last step ended in
    std::unique_ptr<Loads<Dim>> loads_;
    std::unique_ptr<FrameLoads<Dim>> frame_loads_;
    std::unique_ptr<OutsideLoads<Dim>> outside_;
    std::unique_ptr<TrapezoidClosure<Dim>> closure_;  // null where no mean force needs one
    std::unique_ptr<ContactDriver<Dim>> contact_;     // null without contact
    std::unique_ptr<LocalLevels<Dim>> levels_;        // null without local steps
    std::unique_ptr<Bonds<Dim>> bonds_;
    LargeArray<double> midpoint_;  // in the frames, packed; empty where no body turns
    std::vector<Vector<Dim>> in_frames_;
    std::vector<Vector<Dim>> ends_in_frames_[2];  // of a step; empty where no damped body turns
    std::vector<std::int32_t> all_cells_;         // that deform
    std::vector<Vector<Dim>> rigid_force_;        // on the points of rigid bodies, constant; by point
    std::vector<double> rigid_stiffness_;         // of the same, for the stable step; by point
    Region<Dim> patch_region_;                    // of the cells that `end_force_on` was asked for last
};

}  // namespace abut::solid
