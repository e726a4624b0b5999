#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/contact.hpp"
#include "abut/contact/unseen_edges.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/contact_patches.hpp"
#include "abut/solid/contact_results.hpp"
#include "abut/solid/list_watch.hpp"
#include "abut/solid/loads.hpp"
#include "abut/solid/obstacles.hpp"
#include "abut/solid/options.hpp"

namespace abut::solid {

/// Leads contact along the steps of a solid: it gives the surface, searches where the candidate list is no longer valid, gives
/// the path of the listed faces, and takes what comes back to the boundary faces. All that asks contact for something is here.
///
/// Displacements q are those of all cells (n_cells) [m]. A step is `follow`, or its parts `is_valid_at`, `search`, `set_start`
/// and `set_end`; then `integrate`, or `take_start` and `take_end`; then `end_step`.
template <int Dim>
class ContactDriver {
public:
    /// All arguments must outlive the driver; where the time goes is added to `times`. Throws as contact::Contact.
    ContactDriver(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, Ccg<Dim>& ccg, const Loads<Dim>& loads,
                  SolidTimes& times);
    ContactDriver(const ContactDriver&) = delete;
    ContactDriver& operator=(const ContactDriver&) = delete;

    // The path of the listed faces in one step

    /// From q_0 at `time` to q_1; no cell moves farther than `cell_motion` [m], infinity: not known.
    void follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double cell_motion, double time,
                double dt);
    /// Faces jump where they are, in q at `time`: from the loads at the start of the step to those at its end.
    void follow_jump(std::span<const Vector<Dim>> q, double time);
    /// Whether the candidate list is valid in q, where the current step ends, at that time.
    [[nodiscard]] bool is_valid_at(std::span<const Vector<Dim>> q, double time);
    /// Rebuilds the candidate list for the current step, and sets the start of the path.
    void search(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt);
    void set_start(std::span<const Vector<Dim>> q_0, double time);
    void set_end(std::span<const Vector<Dim>> q_1, double time);
    /// The start of the path is known: it is where the last step ended.
    [[nodiscard]] bool has_stepped() const { return has_stepped_; }
    /// The cells that `set_start` and `set_end` read, increasing.
    [[nodiscard]] std::span<const std::int32_t> input_cells() const { return region_.input_cells; }
    /// The next step begins where this one ends.
    void end_step();

    // Contact on that path. Each replaces the results below.

    /// The mean over the step.
    void integrate();
    /// At the start of the step.
    void take_start();
    /// At its end, with the pairs that may touch as they are at its start.
    void take_end();
    /// Where the last step ended.
    void evaluate_last_end();
    /// In one state with the loads at the end of the step, `time` being when the last step ended. Throws Misuse for a state
    /// too far from where candidates were searched.
    void evaluate(std::span<const Vector<Dim>> q, double time);

    // Results

    [[nodiscard]] FaceCorrections<Dim> corrections() const;
    /// Whether some pair was active in the last step.
    [[nodiscard]] bool is_active() const { return !touching_.empty(); }
    /// Sets the forces on the obstacles, and adds the work of these in the step: `share` of it [J].
    void take_obstacle_forces(double share, double& work);
    [[nodiscard]] Obstacles<Dim>& obstacles() { return obstacles_; }
    [[nodiscard]] const Obstacles<Dim>& obstacles() const { return obstacles_; }
    /// Largest |g|/D [-].
    [[nodiscard]] double compression() const;
    /// Of the state that was evaluated last.
    [[nodiscard]] ContactField field() const;
    /// Admitted pairs that share area in the state that was evaluated last and are open by at most `gap` [m].
    [[nodiscard]] std::vector<TouchingPair<Dim>> touching_pairs(double gap) const;
    /// Of the last step.
    [[nodiscard]] std::vector<dynamics::ContactPatch<Dim>> patches() const;

    [[nodiscard]] const contact::Contact<Dim>& contact() const { return *contact_; }
    [[nodiscard]] contact::ContactReport report() const;
    [[nodiscard]] std::int64_t faces_left_out() const { return faces_left_out_; }
    [[nodiscard]] std::vector<Vector<Dim>> blind_corners() const;
    [[nodiscard]] std::optional<contact::EdgePair<Dim>> unseen_edges() const;

private:
    void build_surface();
    [[nodiscard]] bool is_surely_valid(double cell_motion, double time);
    void require_valid_at(std::span<const Vector<Dim>> q, double time);
    void keep_touching_faces(const contact::ContactStep<Dim>& step);
    [[nodiscard]] std::vector<Vector<Dim>> surface_displacement(std::span<const Vector<Dim>> q,
                                                                const BoundaryLoad<Dim>& load, double time);
    void evaluate_faces(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load, double time,
                        std::vector<Vector<Dim>>& displacement, std::vector<Vector<Dim>>& gradient);
    [[nodiscard]] BoundaryFace boundary_face(contact::SurfaceFace face) const {
        return surface_.view().is_rigid(number_of(face)) ? no_face : boundary_of_surface_[static_cast<std::size_t>(face)];
    }
    [[nodiscard]] std::size_t obstacle_of(contact::SurfaceFace face) const {
        return static_cast<std::size_t>(surface_.body[static_cast<std::size_t>(face)] - mesh_.n_bodies());
    }

    const mesh::Mesh<Dim>& mesh_;
    const contact::ContactOptions& options_;
    Ccg<Dim>& ccg_;
    const Loads<Dim>& loads_;
    SolidTimes& times_;
    Obstacles<Dim> obstacles_;
    contact::Surface<Dim> surface_;                  // deformable faces, then those of the obstacles
    std::vector<BoundaryFace> boundary_of_surface_;  // boundary face of each deformable surface face
    std::int64_t faces_left_out_ = 0;
    std::optional<contact::Contact<Dim>> contact_;
    ListWatch<Dim> watch_;
    bool has_stepped_ = false;
    Region<Dim> region_;                            // of the deformable listed faces
    std::vector<BoundaryFace> boundary_of_listed_;  // their boundary faces; they come first in the list
    std::vector<Vector<Dim>> u_0_, u_1_, y_0_,
        y_1_;                                   // path of the listed faces; between steps _0 is where the last one ended
    std::vector<TouchingFaces<Dim>> touching_;  // boundary faces of the pairs that were active in the last step
};

}  // namespace abut::solid
