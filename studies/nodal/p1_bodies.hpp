#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/surface/nodal_faces.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/mass.hpp"
#include "studies/cases/case.hpp"

namespace abut::studies::nodal {

/// Bodies of linear finite elements with contact on their nodes: a host as most solvers are one. q holds the displacements
/// of all nodes. Its mean force is exact for energy, the bulk's and that of contact.
///
/// Of the scene it takes mesh (triangles or tetrahedra), materials, acceleration, obstacles with their placement, and
/// whether the first body is of Kinematics::finite: then all are, of St. Venant-Kirchhoff's material with F_mid S_mean,
/// so that they may turn and energy is exact; else they are of linear elasticity, and bodies that turn grow.
template <int Dim>
class P1Bodies {
public:
    static constexpr int dimension = Dim;

    explicit P1Bodies(run::Scene<Dim> scene, NodalParts<Dim> parts = {}, const geometry::FacingFade& facing = {});

    // System, FollowedSystem
    [[nodiscard]] std::size_t size() const { return inverse_mass_.size(); }
    [[nodiscard]] std::span<const double> inverse_mass() const { return inverse_mass_; }
    void force(std::span<const double> q, std::span<double> f);
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double t, double dt, std::span<double> f);
    void end_force(std::span<const double> q_0, std::span<const double> q_1, double t, double dt, std::span<double> f);
    [[nodiscard]] double potential(std::span<const double> q);
    [[nodiscard]] double work() const { return work_; }
    [[nodiscard]] bool is_autonomous() const { return scene_.solid.obstacles.empty(); }
    // PointSystem
    [[nodiscard]] std::span<const Vector<Dim>> rest_positions() const { return scene_.mesh.vertices; }
    [[nodiscard]] std::span<const double> masses() const { return mass_; }
    [[nodiscard]] dynamics::ContactCounts contact_counts() const {
        return {contact_.report().active_pairs, contact_.report().events};
    }
    // MomentSystem, BodySystem
    [[nodiscard]] dynamics::MomentArms moment_arms() const {
        return is_finite_ ? dynamics::MomentArms::mid_step : dynamics::MomentArms::rest;
    }
    [[nodiscard]] std::span<const std::int32_t> body_of_points() const { return node_body_; }
    /// Rotation of the mean displacement gradient of each body (n_bodies) [rad], 0 to pi.
    [[nodiscard]] std::vector<double> rotations(std::span<const double> q) const;
    // PatchSystem
    /// The nodes of the elements that own active faces; pairs and common nodes join them to one patch.
    [[nodiscard]] std::vector<dynamics::ContactPatch<Dim>> contact_patches() const;
    void end_force_on(std::span<const std::int32_t> points, std::span<const double> q, std::span<Vector<Dim>> force);
    // StiffnessProductSystem, StiffnessSystem: of the bulk at rest
    void stiffness_product(std::span<const double> q, std::span<double> product);
    void append_stiffness(std::span<const double> q, double factor, std::vector<dynamics::MatrixEntry>& entries) const;

    /// 0.85 * 2/omega with contact, by estimate.
    [[nodiscard]] contact::NodalStableStep stable_step();
    [[nodiscard]] const contact::NodalContact<Dim>& contact() const { return contact_; }
    [[nodiscard]] contact::NodalContact<Dim>& contact() { return contact_; }
    [[nodiscard]] const mesh::Mesh<Dim>& mesh() const { return scene_.mesh; }
    /// du/dX, mean over the volume of each body (n_bodies).
    [[nodiscard]] std::vector<Matrix<Dim>> mean_gradients(std::span<const double> q) const;
    /// Cauchy's stress of each element (n_elements) [Pa].
    [[nodiscard]] std::vector<Matrix<Dim>> stresses(std::span<const double> q) const;
    /// Sum of corrections over sum of forces, of the run.
    [[nodiscard]] double correction_share() const { return forces_ > 0.0 ? corrections_ / forces_ : 0.0; }
    [[nodiscard]] std::int64_t pair_steps() const { return pair_steps_; }
    /// Normal force over the area of each boundary face of the mesh in the last step, in the order of boundary_faces [Pa].
    [[nodiscard]] std::vector<double> contact_pressure() const;

private:
    struct Element {
        std::array<std::int32_t, Dim + 1> node;
        std::array<Vector<Dim>, Dim + 1> slope;  ///< of the shape functions
        double measure;
        double lambda;
        double mu;
    };

    static contact::NodalSurface<Dim> surface_of(const run::Scene<Dim>& scene, const NodalParts<Dim>& parts,
                                                 std::vector<Vector<Dim>>& all_nodes);
    void make_elements();
    [[nodiscard]] const Vector<Dim>& gravity(std::size_t node) const {
        return scene_.solid.acceleration[static_cast<std::size_t>(node_body_[node])];
    }
    [[nodiscard]] Matrix<Dim> gradient(const Element& element, std::span<const double> q) const;
    [[nodiscard]] Matrix<Dim> stress_between(const Element& element, const Matrix<Dim>& g_0, const Matrix<Dim>& g_1) const;
    void add_bulk(std::span<const double> q_0, std::span<const double> q_1, std::span<double> f) const;
    void add_outside(std::span<const double> q_0, std::span<const double> q_1, std::span<double> f) const;
    /// On each of its nodes, at the mean of two states [N].
    [[nodiscard]] Vector<Dim> pin_force(const Pin<Dim>& pin, std::span<const double> q_0, std::span<const double> q_1) const;
    void place(std::span<const double> q, double t, std::vector<Vector<Dim>>& x) const;
    [[nodiscard]] std::vector<std::int32_t> element_nodes(contact::Face face) const;
    [[nodiscard]] Vector<Dim> obstacle_normal(contact::Face face) const;
    void follow(std::span<const double> q_0, std::span<const double> q_1, double t, double dt, contact::TakenForce take,
                std::span<double> f);

    run::Scene<Dim> scene_;
    NodalParts<Dim> parts_;
    bool is_finite_;
    std::vector<Vector<Dim>> rest_;  // nodes of the mesh, then of the obstacles
    contact::NodalContact<Dim> contact_;
    std::vector<Element> elements_;
    std::vector<std::int32_t> node_body_;
    std::vector<std::vector<std::int32_t>> node_elements_;
    std::vector<double> mass_;
    std::vector<double> inverse_mass_;
    std::vector<Vector<Dim>> x_0_, x_1_;
    double time_ = 0.0;  // where the last step ended
    double work_ = 0.0;
    double corrections_ = 0.0;
    double forces_ = 0.0;
    std::int64_t pair_steps_ = 0;
};

}  // namespace abut::studies::nodal
