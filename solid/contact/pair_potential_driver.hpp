#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/bond/bonds.hpp"
#include "abut/solid/contact/contact_driver.hpp"
#include "abut/solid/contact/contact_patches.hpp"
#include "abut/solid/contact/corner_surface.hpp"
#include "abut/solid/load/loads.hpp"

namespace abut::solid {

/// By the pair potential, on the corners of all boundary faces: for bodies that may turn.
template <int Dim>
class PairPotentialDriver final : public ContactDriver<Dim> {
public:
    /// All arguments must outlive the driver; `frames` are led along each step before it. Where the time goes is added to
    /// `times`. On several ranks each does its share of the pairs, and all that places nodes is a call of all. Faces
    /// that are bonded do not touch the bodies that they are bonded to, until all of it is broken. Throws as
    /// contact::NodalContact, and BadInput for a choice of ContactOptions that is of another law.
    PairPotentialDriver(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const Loads<Dim>& loads, const BodyFrames<Dim>& frames,
                        SolidTimes& times, const RankPart<Dim>& part, const Bonds<Dim>& bonds);

    void follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double cell_motion, double time,
                double dt) override;
    void follow_jump(std::span<const Vector<Dim>>, double) override {}
    void jumped(std::span<const Vector<Dim>>, double) override { has_stepped_ = false; }
    [[nodiscard]] double energy_at_end(std::span<const Vector<Dim>> q) override;
    void end_step() override;
    [[nodiscard]] std::vector<std::byte> state() const override;
    void restore(std::span<const std::byte> state, std::span<const Vector<Dim>> q, double time) override;
    void take_over(const ContactDriver<Dim>& before, std::span<const std::int32_t> old_boundary) override;

    void integrate(double dt) override;
    void take_start() override;
    void take_end(double dt) override;
    void evaluate_last_end(std::span<const Vector<Dim>> q) override;
    void evaluate(std::span<const Vector<Dim>> q, double time) override;

    [[nodiscard]] FaceCorrections<Dim> corrections() const override;
    [[nodiscard]] std::span<const BodyPush<Dim>> pushes() const override { return pushes_; }
    [[nodiscard]] std::span<const BodyPush<Dim>> rigid_pushes() const override { return rigid_pushes_; }
    [[nodiscard]] double energy() const override { return contact_.last().energy + contact_.last().report.friction.energy; }
    [[nodiscard]] const contact::FrictionFigures& friction() const override { return contact_.last().report.friction; }
    void take_obstacle_forces(double share, double& work) override;
    [[nodiscard]] double interference_work() const override { return contact_.last().interference_work; }
    void add_impulses(double dt) override;
    [[nodiscard]] const Obstacles<Dim>& obstacles() const override { return obstacles_; }
    [[nodiscard]] double compression() const override { return contact_.last().report.compression; }
    [[nodiscard]] ContactField field() const override;
    [[nodiscard]] std::vector<TouchingPair<Dim>> touching_pairs(double gap) const override;
    [[nodiscard]] std::span<const contact::PairStep<Dim>> pairs() const override { return contact_.last().pairs; }
    [[nodiscard]] std::vector<dynamics::ContactPatch<Dim>> patches() const override;

    [[nodiscard]] typename ContactDriver<Dim>::ByLaw contact() const override { return std::cref(contact_); }
    [[nodiscard]] contact::ContactReport report() const override { return contact_.report(); }
    void clear_report() override { contact_.clear_report(); }
    [[nodiscard]] double skin() const override { return contact_.skin(); }
    [[nodiscard]] BoundaryFace mesh_boundary(contact::Face face) const override { return corners_.mesh_boundary(face); }
    [[nodiscard]] std::vector<contact::BlindCorner<Dim>> blind_corners() const override;
    [[nodiscard]] std::optional<contact::EdgePair<Dim>> unseen_edges() const override;

private:
    using Points = std::vector<Vector<Dim>>;

    using Listed = typename CornerSurface<Dim>::Listed;

    /// Bound of the distance of some nodes from where they were at a search: exact in one state, a bound from there on.
    struct Watch {
        std::vector<BodyFrame<Dim>> frames;  // in that state
        std::vector<RigidPlace<Dim>> places;
        std::vector<double> radius;  // of these nodes about the centre of each body, rigid ones last [m]
        double time = 0.0;           // of that state [s]
        double moved = 0.0;          // the farthest of them from where candidates were searched [m]
        std::vector<Vector<Dim>> u;  // in that state and in the frames, of the cells that move these nodes
        double travelled = 0.0;      // at most since then: motion in its frame of the cell that moved farthest
        double amplification = 0.0;  // how far one of these nodes moves when no cell moves by more than 1
        double moved_in_frame =
            0.0;  // as `moved`, seen from the frames: a body that flies and turns does not come to itself
    };

    /// Whether faces may move farther than the motion of cells bounds: by loads that vary, by the stretch of free
    /// faces, and as cells flow.
    [[nodiscard]] bool faces_leave_cells() const { return loads_.vary() || bodies_.any_finite() || ccg_.flows_linearly(); }
    [[nodiscard]] double motion_since(const Watch& watch, double in_frame, double time) const;
    [[nodiscard]] bool is_valid(double near_in_frame, double far_in_frame, double time) const;
    [[nodiscard]] bool is_valid_within(double far_in_frame) const;
    [[nodiscard]] bool is_surely_valid(double cell_motion, double time);
    [[nodiscard]] bool is_valid_by_cells(std::span<const Vector<Dim>> q_1, double time);
    [[nodiscard]] bool is_valid_at_near_nodes(std::span<const Vector<Dim>> q_1, double time);
    [[nodiscard]] double distance_in_frame(const Listed& listed, std::span<const Vector<Dim>> q, const Watch& watch);
    [[nodiscard]] Watch watch_from(const Listed& listed, std::span<const Vector<Dim>> q_1, const Points& x, double time);
    void search(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt);
    [[nodiscard]] double moved_in_frame() const;
    [[nodiscard]] std::vector<std::int32_t> near_nodes() const;
    /// The gradients of the last call of contact between these two placements of the nodes, face by face.
    void collect(const Points& x_0, const Points& x_1);
    void keep_touching_faces();
    [[nodiscard]] Vector<Dim> middle_of(contact::Face face) const;
    [[nodiscard]] Vector<Dim> obstacle_normal(contact::Face face) const;

    const Bodies<Dim>& bodies_;
    Ccg<Dim>& ccg_;
    const Loads<Dim>& loads_;
    const BodyFrames<Dim>& frames_;
    SolidTimes& times_;
    const dynamics::Ranks& ranks_;
    Obstacles<Dim> obstacles_;
    CornerSurface<Dim> corners_;
    contact::NodalContact<Dim> contact_;
    bool touches_itself_;

    // All faces; those near enough to another body to touch it while no face moves farther than `far_reach_`; those listed.
    Listed all_, near_, listed_;
    std::vector<std::int32_t> listed_nodes_;  // what `listed_` is of
    Points x_0_, x_1_, x_state_;              // nodes at both ends of a step; between steps _0 is where the last one ended
    bool has_stepped_ = false;
    Watch near_watch_, far_watch_;
    double far_reach_ = 0.0;  // [m]
    double end_time_ = 0.0;   // of the last step [s]
    Points searched_at_;
    std::vector<Vector<Dim>> u_;  // work array, of all cells

    std::vector<Vector<Dim>> face_gradient_;  // results, in frames (n_listed)
    std::vector<Matrix<Dim>> cell_moment_;
    std::vector<BodyPush<Dim>> pushes_;
    std::vector<BodyPush<Dim>> rigid_pushes_;  // arms at rest
    std::vector<TouchingPoints<Dim>> touching_;
};

}  // namespace abut::solid
