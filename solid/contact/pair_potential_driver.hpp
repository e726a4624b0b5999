#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/geometry/box.hpp"
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
    void end_list() override { contact_.end_list(); }
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
    void evaluate_listed(std::span<const Vector<Dim>> q, double time) override;

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

    /// Bound of how far some nodes are from where they were at a search.
    struct Watch {
        CornerMotion<Dim> corners;  // of faces of bodies that deform
        // Of nodes of rigid bodies and obstacles
        Points from;                          // where they were at the search, in the order of the list
        std::vector<double> radius;           // about the centre of each rigid body [m]
        double moved = 0.0;                   // until they were placed last [m]
        std::vector<RigidPlace<Dim>> places;  // in that state
        double time = 0.0;                    // of it [s]
    };

    /// A face that is placed at the end of each step.
    struct PlacedFace {
        std::int32_t face;
        std::int32_t near;  ///< its index in `near_.own`
    };

    /// Whether faces may move farther than the motion of cells bounds: by loads that vary, by the stretch of free
    /// faces, and as cells flow.
    [[nodiscard]] bool faces_leave_cells() const { return loads_.vary() || bodies_.any_finite() || ccg_.flows_linearly(); }
    /// How far near and far faces may move.
    [[nodiscard]] FarthestMotion near_allowed() const;
    [[nodiscard]] FarthestMotion far_allowed() const;
    void begin(Watch& watch, const Listed& listed, std::span<const Vector<Dim>> q_0, double cell_motion, double time);
    void place_given(Watch& watch, const Listed& listed, double time, Points& x) const;
    [[nodiscard]] double given_distance(const Watch& watch, const Listed& listed, double time, Points& x) const;
    [[nodiscard]] double given_motion(const Watch& watch, double time) const;
    [[nodiscard]] bool is_within(Watch& watch, const FarthestMotion& allowed, double time) const;
    [[nodiscard]] bool agree(bool here) const { return ranks_.largest(here ? 0.0 : 1.0) == 0.0; }
    [[nodiscard]] bool is_valid_until(std::span<const Vector<Dim>> q_1, double cell_motion, double time);
    [[nodiscard]] bool is_surely_valid(double cell_motion, double time);
    [[nodiscard]] bool is_valid_by_cells(std::span<const Vector<Dim>> q_1, double time);
    void look(Watch& watch, const Listed& listed, const FarthestMotion& allowed, std::span<const Vector<Dim>> q_1,
              double time);
    void place_beyond(std::span<const Vector<Dim>> q_1);
    [[nodiscard]] bool is_valid_at_all_nodes(std::span<const Vector<Dim>> q_1, double time);
    [[nodiscard]] bool is_valid_in(std::span<const Vector<Dim>> q, double time);
    [[nodiscard]] bool may_search_near() const;
    void keep_end(std::span<const Vector<Dim>> q_1);
    [[nodiscard]] bool is_last_end(std::span<const Vector<Dim>> q, double time) const;
    void search(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double cell_motion, double time,
                double dt);
    void search_placed(const Listed& placed, std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time,
                       double dt);
    [[nodiscard]] std::vector<std::int32_t> nodes_of(std::span<const std::int32_t> facets) const;
    [[nodiscard]] std::vector<geometry::Box<Dim>> swept_boxes(std::span<const std::int32_t> facets) const;
    void begin_far(std::span<const Vector<Dim>> q_0, double cell_motion, double time);
    void begin_near(std::span<const Vector<Dim>> q_0, double cell_motion, double time);
    [[nodiscard]] std::vector<double> slack_of(const Listed& listed, std::span<const std::int32_t> facets,
                                               std::span<const double> distances, double beyond) const;
    [[nodiscard]] std::vector<double> distances_of_near(double most) const;
    void find_placed();
    void set_placed_motion();
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
    double deepest_ = 0.0;  // cell behind a facet [m]

    // All faces; those near enough to another body to touch it while no face moves farther than `far_reach_`; those listed.
    Listed all_, near_, listed_;
    std::vector<std::int32_t> near_facets_;   // what `near_` is of
    std::vector<PlacedFace> placed_;          // those of `listed_.own`
    std::vector<std::int32_t> listed_nodes_;  // what `listed_` is of
    Points x_0_, x_1_, x_state_;              // nodes at both ends of a step; between steps _0 is where the last one ended
    bool has_stepped_ = false;
    Watch near_watch_, far_watch_;
    bool far_holds_ = false;  // where the step ends
    double far_reach_ = 0.0;  // [m]
    double end_time_ = 0.0;   // of the last step [s]
    Points searched_at_;
    Points end_;                              // q there, of cells that move faces and of rigid bodies
    std::vector<BodyFrame<Dim>> end_frames_;  // and the frames

    std::vector<Vector<Dim>> face_gradient_;  // results, in frames (n_listed)
    std::vector<Matrix<Dim>> cell_moment_;
    std::vector<BodyPush<Dim>> pushes_;
    std::vector<BodyPush<Dim>> rigid_pushes_;  // arms at rest
    std::vector<TouchingPoints<Dim>> touching_;
};

}  // namespace abut::solid
