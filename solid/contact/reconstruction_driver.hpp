#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/contact.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/bond/bonds.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/contact/contact_driver.hpp"
#include "abut/solid/contact/contact_patches.hpp"
#include "abut/solid/contact/list_watch.hpp"
#include "abut/solid/contact/rank_faces.hpp"
#include "abut/solid/load/loads.hpp"
#include "abut/solid/options/options.hpp"

namespace abut::solid {

/// By the modified reconstruction: the faces of bodies that do not turn, each moved as a whole. The points are the cells.
template <int Dim>
class ReconstructionDriver final : public ContactDriver<Dim> {
public:
    /// All arguments must outlive the driver; where the time goes is added to `times`. On several ranks
    /// faces are evaluated where their cells are, and each does its share of the pairs. Bodies that are bonded to each
    /// other do not touch each other. Throws as contact::Contact.
    ReconstructionDriver(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, Ccg<Dim>& ccg,
                         const Loads<Dim>& loads, SolidTimes& times, const RankPart<Dim>& part, Bonds<Dim>& bonds);

    // The path of the listed faces in one step

    void follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double cell_motion, double time,
                double dt) override;
    void follow_jump(std::span<const Vector<Dim>> q, double time) override;
    void jumped(std::span<const Vector<Dim>> q, double time) override { set_start(q, time); }
    /// Nothing flows under this law.
    [[nodiscard]] double energy_at_end(std::span<const Vector<Dim>>) override { return energy(); }
    void end_step() override;
    [[nodiscard]] std::vector<std::byte> state() const override;
    void restore(std::span<const std::byte> state, std::span<const Vector<Dim>> q, double time) override;
    void take_over(const ContactDriver<Dim>& before, std::span<const std::int32_t> old_boundary) override;

    // Contact on that path

    void integrate(double dt) override;
    void take_start() override;
    void take_end(double dt) override;
    void evaluate_last_end(std::span<const Vector<Dim>> q) override;
    void evaluate(std::span<const Vector<Dim>> q, double time) override;

    [[nodiscard]] bool makes_parts() const override { return !options_.friction.any(); }
    void begin_parts(double dt) override { obstacles_.begin_parts(dt); }
    bool integrate_part(PartOfStep<Dim>& part, double time, double dt, double& work) override;
    [[nodiscard]] std::span<const std::int32_t> input_cells() const override { return region_.input_cells; }

    // Results

    [[nodiscard]] FaceCorrections<Dim> corrections() const override;
    [[nodiscard]] double energy() const override { return contact_->last().report.friction.energy; }
    [[nodiscard]] const contact::FrictionFigures& friction() const override { return contact_->last().report.friction; }
    void take_obstacle_forces(double share, double& work) override;
    void add_impulses(double dt) override;
    [[nodiscard]] const Obstacles<Dim>& obstacles() const override { return obstacles_; }
    [[nodiscard]] double compression() const override;
    [[nodiscard]] ContactField field() const override;
    [[nodiscard]] std::vector<TouchingPair<Dim>> touching_pairs(double gap) const override;
    [[nodiscard]] std::span<const contact::PairStep<Dim>> pairs() const override { return contact_->last().pairs; }
    [[nodiscard]] std::vector<dynamics::ContactPatch<Dim>> patches() const override;

    [[nodiscard]] typename ContactDriver<Dim>::ByLaw contact() const override { return std::cref(*contact_); }
    [[nodiscard]] contact::ContactReport report() const override;
    void clear_report() override { contact_->clear_report(); }
    [[nodiscard]] BoundaryFace mesh_boundary(contact::Face face) const override {
        const auto i = static_cast<std::size_t>(face);
        return i < boundary_of_surface_.size() ? boundary_of_surface_[i] : no_face;
    }
    [[nodiscard]] double skin() const override { return contact_->skin(); }
    [[nodiscard]] std::vector<contact::BlindCorner<Dim>> blind_corners() const override;
    [[nodiscard]] std::optional<contact::EdgePair<Dim>> unseen_edges() const override;

private:
    /// Whether the candidate list is valid in q, where the current step ends, at that time.
    [[nodiscard]] bool is_valid_at(std::span<const Vector<Dim>> q, double time);
    /// Rebuilds the candidate list for the current step, and sets the start of the path.
    void search(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt);
    void set_start(std::span<const Vector<Dim>> q_0, double time);
    void set_end(std::span<const Vector<Dim>> q_1, double time);
    void build_surface(const SolidOptions<Dim>& options);
    void make_contact() { contact_.emplace(surface_.view(), options_, faces_->sharing()); }
    [[nodiscard]] contact::FaceCoupling<Dim> list_faces(std::span<const contact::Face> faces);
    [[nodiscard]] bool is_of_obstacle(contact::Face face) const {
        return static_cast<std::size_t>(face) >= boundary_of_surface_.size();
    }
    /// Whether it is one of an obstacle or held by a support: nothing that touches it moves it.
    [[nodiscard]] bool is_rigid(contact::Face face) const {
        return surface_.view().is_rigid(static_cast<std::int32_t>(face));
    }
    [[nodiscard]] std::span<const Vector<Dim>> values_here(std::span<const Vector<Dim>> of_listed,
                                                           std::vector<Vector<Dim>>& work) const;
    [[nodiscard]] bool is_surely_valid(double cell_motion, double time);
    void require_valid_at(std::span<const Vector<Dim>> q, double time);
    void keep_touching_faces(const contact::ContactStep<Dim>& step);
    [[nodiscard]] std::vector<Vector<Dim>> surface_displacement(std::span<const Vector<Dim>> q,
                                                                const BoundaryLoad<Dim>& load, double time);
    void evaluate_faces(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load, double time,
                        std::vector<Vector<Dim>>& displacement, std::vector<Vector<Dim>>& gradient);
    void couple_to_bonds();
    void answer_to_bonds(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load, std::span<Vector<Dim>> gradient);
    [[nodiscard]] std::size_t obstacle_of(contact::Face face) const {
        return static_cast<std::size_t>(surface_.body[static_cast<std::size_t>(face)] - mesh_.n_bodies());
    }

    const mesh::Mesh<Dim>& mesh_;
    contact::ContactOptions options_;
    Ccg<Dim>& ccg_;
    const Loads<Dim>& loads_;
    SolidTimes& times_;
    Obstacles<Dim> obstacles_;
    contact::Surface<Dim> surface_;                  // deformable faces, then those of the obstacles
    std::vector<BoundaryFace> boundary_of_surface_;  // of each deformable surface face; `no_face`: it is on other ranks
    std::unique_ptr<SharedFaces<Dim>> faces_;        // the deformable ones
    std::optional<contact::Contact<Dim>> contact_;
    ListWatch<Dim> watch_;
    bool has_stepped_ = false;                      // the start of the path is known: it is where the last step ended
    Region<Dim> region_;                            // of the deformable listed faces, of those that are evaluated here
    std::size_t n_listed_deformable_ = 0;           // they come first in the list
    std::vector<BoundaryFace> boundary_of_listed_;  // of those that are here: all on one rank
    std::vector<std::size_t> listed_here_;          // their indices in the list
    mutable std::vector<Vector<Dim>> correction_here_, gradient_here_;  // work arrays of `corrections`
    std::vector<Vector<Dim>> u_0_, u_1_, y_0_,
        y_1_;  // path of the listed faces; between steps _0 is where the last one ended
    Bonds<Dim>& bonds_;
    /// How the gradient of a listed face answers to the displacement of a bonded one.
    struct BondAnswer {
        std::size_t listed, bonded;
        Matrix<Dim> block;
    };
    std::vector<BondAnswer> bond_answers_;
    std::vector<TouchingPoints<Dim>> touching_;  // faces of the pairs that were active in the last step
};

}  // namespace abut::solid
