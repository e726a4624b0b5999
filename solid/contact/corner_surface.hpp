#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "abut/contact/surface/nodal_faces.hpp"
#include "abut/contact/surface/nodal_surface.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/contact/corner_motion.hpp"
#include "abut/solid/contact/obstacles.hpp"
#include "abut/solid/contact/rank_faces.hpp"

namespace abut::solid {

/// The corners of all faces that may touch, each belonging to its face alone: nodes for contact. A corner at X of face
/// f moves with the face and tilts with its cell c, in the frame of its body:
///
///     x = centre + Q (X - mean of X + û_f + (I - P_f) G_c (X - x_f))
///
/// where P_f projects onto the directions that a support prescribes: in these it moves as the support says.
/// Faces of rigid bodies move with these; they have the stiffness and depth of the cell behind them, as a skin. Faces, and
/// with them nodes, come in the order: bodies that deform, rigid bodies, obstacles.
template <int Dim>
class CornerSurface {
public:
    using Points = std::vector<Vector<Dim>>;

    /// Some faces, with all of their corners.
    struct Listed {
        std::vector<std::int32_t> faces;      // of bodies that deform, increasing
        std::vector<std::int32_t> own;        // those that are placed here: all of them, unless there are ranks
        std::vector<std::int32_t> here;       // those with a boundary face here: the same
        std::vector<BoundaryFace> boundary;   // of `here`
        std::vector<std::int32_t> gathered;   // nodes of `faces` as ranks bring them, rank after rank; empty on one rank
        std::vector<std::int32_t> rigid;      // nodes of rigid bodies, increasing
        std::vector<std::int32_t> obstacles;  // nodes of obstacles, increasing
        std::vector<std::int32_t> nodes;      // all of them, increasing
        Region<Dim> region;
    };

    /// All must outlive it. Each rank has all faces, and `place` is a call of all.
    CornerSurface(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const BodyFrames<Dim>& frames, const Obstacles<Dim>& obstacles,
                  const RankPart<Dim>& part);

    [[nodiscard]] contact::NodalSurface<Dim> for_contact() const;
    /// Who shares the work of contact; null: nobody does.
    [[nodiscard]] contact::Sharing* sharing() { return shared_->sharing(); }
    /// Body of each face, by its number in the mesh; obstacles count behind.
    [[nodiscard]] std::vector<std::int32_t> bodies_of_faces() const;
    /// Tells for each face whether it is in a group of the mesh of all bodies. A call of all ranks.
    [[nodiscard]] std::vector<bool> faces_in_group(std::size_t group) const;

    // Nodes and faces, by their number

    [[nodiscard]] const Points& rest() const { return rest_; }  ///< of the nodes [m]
    [[nodiscard]] bool is_of_obstacle(std::int32_t node) const { return static_cast<std::size_t>(node) >= face_of_.size(); }
    [[nodiscard]] std::size_t obstacle_of(std::int32_t node) const {
        return obstacle_of_[static_cast<std::size_t>(node) - face_of_.size()];
    }
    /// The first node of an obstacle.
    [[nodiscard]] std::int32_t n_body_nodes() const { return static_cast<std::int32_t>(face_of_.size()); }
    [[nodiscard]] std::size_t face_of(std::int32_t node) const { return static_cast<std::size_t>(face_of_[node]); }
    [[nodiscard]] bool is_deformable(std::size_t face) const { return face < boundary_.size(); }
    [[nodiscard]] bool is_obstacle(std::size_t face) const { return face >= mesh_boundary_.size(); }
    [[nodiscard]] std::size_t rigid_of(std::size_t face) const { return rigid_of_[face - boundary_.size()]; }
    /// Boundary face of a body that deforms; `no_face`: it is on other ranks.
    [[nodiscard]] BoundaryFace boundary(std::size_t face) const { return boundary_[face]; }
    [[nodiscard]] std::size_t body_of(std::size_t face) const { return static_cast<std::size_t>(faces_.body[face]); }
    /// In the numbering of the mesh; `no_face` of an obstacle, and of a face on other ranks.
    [[nodiscard]] BoundaryFace mesh_boundary(contact::Face face) const {
        return is_obstacle(static_cast<std::size_t>(face)) ? no_face : mesh_boundary_[static_cast<std::size_t>(face)];
    }
    /// Points of the system that move a face; none of an obstacle or of a face that a support holds. On several ranks,
    /// by their numbers among those of all.
    [[nodiscard]] std::span<const std::int32_t> points_of(contact::Face face) const;
    /// The part of a displacement or a force of a corner, in the frame, that its cell has a say in.
    [[nodiscard]] Vector<Dim> free_part(BoundaryFace face, const Vector<Dim>& of_corner) const {
        return of_corner - ccg_.prescribed()[face] * of_corner;
    }
    /// Holds of such a point; nothing holds one of a rigid body.
    [[nodiscard]] std::vector<dynamics::Hold<Dim>> holds_of(std::int32_t point) const;
    /// Centroid at rest of a face of a body that deforms [m].
    [[nodiscard]] Vector<Dim> rest_centroid(contact::Face face) const;
    /// Mean of its corners, of a body.
    [[nodiscard]] Vector<Dim> middle(contact::Face face, const Points& x) const;

    // Where they are

    [[nodiscard]] Listed list(std::span<const std::int32_t> nodes) const;
    [[nodiscard]] Listed list_all() const;
    /// Sets x of the nodes listed, in q; the others stay. The frames are those of q.
    void place(const Listed& listed, std::span<const Vector<Dim>> q, std::span<const BodyFrame<Dim>> frames,
               const BoundaryLoad<Dim>& load, double time, Points& x, StepState state = StepState::given);
    /// Sets x of the nodes of rigid bodies and obstacles alone, where `place_rigid` has been called for the state.
    void place_given(const Listed& listed, double time, Points& x) const;
    /// Sets x of the corners of some faces that are placed here, increasing; no call of all ranks.
    void place_own(std::span<const std::int32_t> faces, std::span<const Vector<Dim>> q,
                   std::span<const BodyFrame<Dim>> frames, const BoundaryLoad<Dim>& load, Points& x, StepState state);
    /// Bounds of motions, of no face yet.
    [[nodiscard]] CornerMotion<Dim> motion() const { return {rows_, bodies_.rest()}; }
    /// Begins to bound the motion of the listed faces that are placed here, from where x has them: in q, with these frames.
    void begin(CornerMotion<Dim>& motion, const Listed& listed, std::span<const Vector<Dim>> q,
               std::span<const BodyFrame<Dim>> frames, const Points& x) const;
    /// How far the corner of a face is from where it was that moved farthest [m].
    [[nodiscard]] double motion(std::int32_t face, const Points& from, const Points& to) const;
    /// Places the rigid bodies alone; `place` sets them, too.
    void place_rigid(std::span<const Vector<Dim>> q);
    [[nodiscard]] const std::vector<RigidPlace<Dim>>& rigid_places() const { return places_; }

private:
    void append_deformable();
    void add_face(std::span<const Vector<Dim>> corners, double depth, std::int32_t body, double stiffness);
    void append_row(BoundaryFace face, std::size_t body);
    void place_deformable(std::span<const std::int32_t> faces, const Region<Dim>& region, std::span<const Vector<Dim>> q,
                          std::span<const BodyFrame<Dim>> frames, const BoundaryLoad<Dim>& load, Points& x, StepState state);
    void gather_nodes(const Listed& listed, Points& x);
    void append_rigid();
    void append_obstacles();
    void append_face(const mesh::Mesh<Dim>& mesh, std::int32_t face, double depth, std::int32_t body, double stiffness);

    const Bodies<Dim>& bodies_;
    const mesh::Mesh<Dim>& mesh_;  // of the bodies that deform
    Ccg<Dim>& ccg_;
    const BodyFrames<Dim>& frames_;
    const Obstacles<Dim>& obstacles_;
    const RankPart<Dim>& part_;
    std::unique_ptr<SharedFaces<Dim>> shared_;  // those of bodies that deform
    contact::NodalFaceArrays<Dim> faces_;
    std::vector<double> stiffness_;  // of each face
    Points rest_;
    std::vector<std::int32_t> corner_offsets_{0};  // of the faces of bodies, into the nodes
    std::vector<std::int32_t> face_of_;            // of each node of a body
    std::vector<std::size_t> obstacle_of_;         // of the others, in order
    std::vector<BoundaryFace> boundary_;           // of each face of a body that deforms
    std::vector<std::size_t> rigid_of_;            // rigid body of each face that follows
    std::vector<BoundaryFace> mesh_boundary_;      // of all these, in the whole mesh
    std::vector<std::vector<std::int32_t>> rigid_points_;
    CornerRows rows_;                   // of the faces that are placed here
    std::vector<std::int32_t> row_of_;  // of each face of a body that deforms; -1: it is placed elsewhere
    std::vector<RigidPlace<Dim>> places_;
    std::vector<Vector<Dim>> u_;  // work arrays: of all cells, and of listed faces
    std::vector<Vector<Dim>> displacement_;
    std::vector<Matrix<Dim>> tilt_;
    std::vector<double> own_nodes_;  // and what is gathered of them
};

}  // namespace abut::solid
