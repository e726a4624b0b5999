#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/nodal_faces.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/bodies.hpp"
#include "abut/solid/contact_driver.hpp"
#include "abut/solid/contact_patches.hpp"
#include "abut/solid/loads.hpp"

namespace abut::solid {

/// By the pair potential, on the corners of all boundary faces: for bodies that may turn. A corner at X of face f moves with
/// the face and tilts with its cell c, in the frame of its body:
///
///     x = centre + Q (X - mean of X + û_f + G_c (X - x_f))
///
/// Faces of rigid bodies move with these; they have the stiffness and depth of the cell behind them, as a skin.
template <int Dim>
class PairPotentialDriver final : public ContactDriver<Dim> {
public:
    /// All arguments must outlive the driver; `frames` are led along each step before it. Where the time goes is added to
    /// `times`. Throws as contact::NodalContact, and BadInput for a choice of ContactOptions that is of another law.
    PairPotentialDriver(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const Loads<Dim>& loads, const BodyFrames<Dim>& frames,
                        SolidTimes& times);

    void follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double cell_motion, double time,
                double dt) override;
    void follow_jump(std::span<const Vector<Dim>>, double) override {}
    void jumped(std::span<const Vector<Dim>>, double) override { has_stepped_ = false; }
    void end_step() override;

    void integrate() override;
    void take_start() override;
    void take_end() override;
    void evaluate_last_end(std::span<const Vector<Dim>> q) override;
    void evaluate(std::span<const Vector<Dim>> q, double time) override;

    [[nodiscard]] FaceCorrections<Dim> corrections() const override;
    [[nodiscard]] std::span<const BodyPush<Dim>> pushes() const override { return pushes_; }
    [[nodiscard]] std::span<const BodyPush<Dim>> rigid_pushes() const override { return rigid_pushes_; }
    [[nodiscard]] double energy() const override { return contact_->last().energy; }
    void take_obstacle_forces(double share, double& work) override;
    [[nodiscard]] const Obstacles<Dim>& obstacles() const override { return obstacles_; }
    [[nodiscard]] double compression() const override { return contact_->last().report.compression; }
    [[nodiscard]] ContactField field() const override;
    [[nodiscard]] std::vector<TouchingPair<Dim>> touching_pairs(double gap) const override;
    [[nodiscard]] std::vector<dynamics::ContactPatch<Dim>> patches() const override;

    [[nodiscard]] const contact::NodalContact<Dim>& contact() const { return *contact_; }
    [[nodiscard]] contact::ContactReport report() const override { return contact_->report(); }
    [[nodiscard]] double skin() const override { return contact_->skin(); }
    [[nodiscard]] std::int64_t faces_left_out() const override { return faces_left_out_; }
    [[nodiscard]] std::vector<Vector<Dim>> blind_corners() const override { return {}; }
    [[nodiscard]] std::optional<contact::EdgePair<Dim>> unseen_edges() const override { return contact_->unseen_edges(); }

private:
    using Points = std::vector<Vector<Dim>>;
    using Frames = std::span<const BodyFrame<Dim>>;

    /// Some faces of the surface: those whose corners are placed.
    struct Listed {
        std::vector<std::int32_t> faces;      // of bodies that deform, by their index in the surface, increasing
        std::vector<BoundaryFace> boundary;   // the same
        std::vector<std::int32_t> rigid;      // nodes of rigid bodies, increasing
        std::vector<std::int32_t> obstacles;  // nodes of obstacles, increasing
        std::vector<std::int32_t> nodes;      // all of them, increasing
        Region<Dim> region;
    };

    [[nodiscard]] contact::NodalSurface<Dim> build_surface();
    void append_deformable(contact::NodalFaceArrays<Dim>& faces, std::vector<double>& stiffness);
    void append_rigid(contact::NodalFaceArrays<Dim>& faces, std::vector<double>& stiffness);
    void append_face(const mesh::Mesh<Dim>& mesh, std::int32_t face, std::int32_t body,
                     contact::NodalFaceArrays<Dim>& faces);
    [[nodiscard]] Listed list(std::span<const std::int32_t> nodes) const;
    void place(const Listed& listed, std::span<const Vector<Dim>> q, Frames frames, const BoundaryLoad<Dim>& load,
               double time, Points& x);
    /// What bounds how far some nodes are from where they were at a search: exact in one state, a bound from there on.
    struct Watch {
        std::vector<BodyFrame<Dim>> frames;  // in that state
        std::vector<RigidPlace<Dim>> places;
        std::vector<double> radius;  // of these nodes about the centre of each body, rigid ones last [m]
        double time = 0.0;           // of that state [s]
        double moved = 0.0;          // the farthest of them from where candidates were searched [m]
        double travelled = 0.0;  // since then: sum over the steps of the motion in its frame of the cell that moved farthest
    };

    [[nodiscard]] double motion_since(const Watch& watch, double time) const;
    [[nodiscard]] bool is_surely_valid(double cell_motion, double time);
    [[nodiscard]] bool is_valid_at_near_nodes(std::span<const Vector<Dim>> q_1, double time);
    [[nodiscard]] Watch watch_from(const Listed& listed, const Points& x, double time) const;
    void search(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt);
    [[nodiscard]] std::vector<std::int32_t> near_nodes() const;
    /// The gradients of the last call of contact between these two placements of the nodes, face by face.
    void collect(const Points& x_0, const Points& x_1);
    void keep_touching_faces();
    [[nodiscard]] bool is_deformable(std::size_t face) const { return face < boundary_of_surface_.size(); }
    [[nodiscard]] bool is_obstacle(std::size_t face) const { return face >= mesh_boundary_.size(); }
    [[nodiscard]] std::size_t rigid_of(std::size_t face) const { return rigid_of_face_[face - boundary_of_surface_.size()]; }
    /// In the numbering of the whole mesh.
    [[nodiscard]] BoundaryFace mesh_boundary(contact::SurfaceFace face) const {
        return is_obstacle(static_cast<std::size_t>(face)) ? no_face : mesh_boundary_[static_cast<std::size_t>(face)];
    }
    [[nodiscard]] std::span<const std::int32_t> points_of(contact::SurfaceFace face) const;
    void place_rigid(std::span<const Vector<Dim>> q);
    [[nodiscard]] std::int32_t body_of(BoundaryFace face) const { return mesh_.cell_body[cell_of(mesh_, face)]; }
    [[nodiscard]] Vector<Dim> middle_of(contact::SurfaceFace face) const;
    [[nodiscard]] Vector<Dim> obstacle_normal(contact::SurfaceFace face) const;

    const Bodies<Dim>& bodies_;
    const mesh::Mesh<Dim>& mesh_;  // of the bodies that deform
    Ccg<Dim>& ccg_;
    const Loads<Dim>& loads_;
    const BodyFrames<Dim>& frames_;
    SolidTimes& times_;
    Obstacles<Dim> obstacles_;
    Points rest_;                                    // nodes: the corners of each face by itself, those of obstacles last
    std::vector<std::int32_t> corner_offsets_{0};    // of the faces of bodies, into the nodes
    std::vector<std::int32_t> face_of_node_;         // of a body
    std::vector<std::size_t> obstacle_of_node_;      // the others, in order
    std::vector<BoundaryFace> boundary_of_surface_;  // of each face of a body that deforms: the first ones
    std::vector<std::size_t> rigid_of_face_;         // rigid body of those that follow
    std::vector<BoundaryFace> mesh_boundary_;        // of all these, in the whole mesh
    std::vector<std::vector<std::int32_t>> rigid_points_;
    std::vector<RigidPlace<Dim>> places_;  // of the rigid bodies, where nodes were placed last
    std::int64_t faces_left_out_ = 0;
    double amplification_ = 0.0;  // how far a corner moves at most in its frame when no cell moves farther than 1
    std::optional<contact::NodalContact<Dim>> contact_;

    // All faces; those near enough to another body to touch it while no face moves farther than `far_reach_`; those listed.
    Listed all_, near_, listed_;
    std::vector<std::int32_t> listed_nodes_;  // what `listed_` is of
    Points x_0_, x_1_, x_state_;              // nodes at both ends of a step; between steps _0 is where the last one ended
    bool has_stepped_ = false;
    Watch near_watch_, far_watch_;
    double far_reach_ = 0.0;  // [m]
    double end_time_ = 0.0;   // of the last step [s]
    Points searched_at_;

    std::vector<Vector<Dim>> u_;  // work arrays, of all points and of listed faces
    std::vector<Vector<Dim>> displacement_;
    std::vector<Matrix<Dim>> tilt_;
    std::vector<Vector<Dim>> face_gradient_;  // results, in frames (n_listed)
    std::vector<Matrix<Dim>> cell_moment_;
    std::vector<BodyPush<Dim>> pushes_;
    std::vector<BodyPush<Dim>> rigid_pushes_;  // arms at rest
    std::vector<TouchingPoints<Dim>> touching_;
};

}  // namespace abut::solid
