#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/body/body_frames.hpp"
#include "abut/solid/body/cell_points.hpp"
#include "abut/solid/body/rigid_bodies.hpp"
#include "abut/solid/body/turning_tractions.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/options/options.hpp"

namespace abut::solid {

template <int Dim>
class RankPart;

/// The bodies of a solid, by how they move. Its points are the cells of those that deform, then the points of those that are
/// rigid; both in the order of the mesh.
template <int Dim>
class Bodies {
public:
    /// The mesh must outlive it; `holds` as `traction_holds` returns it (n_tractions). Throws BadInput for options that do
    /// not fit the mesh or each other.
    Bodies(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, std::vector<TractionHold> holds);

    /// From now on the masses of cells of floating bodies are where these have their moments of inertia (CellPoints), which
    /// `deformable` takes as their centroids; to be called before anything is made of it. `part`: of these bodies; a
    /// call of all ranks.
    void place_cell_points(const RankPart<Dim>& part);
    /// Who brings ranks together from then on, in what is said to be a call of all; to be called before any of that.
    void take_part(const RankPart<Dim>& part) { rank_part_ = &part; }
    /// Takes the places of bonds and the boundary faces of `deformable` that they join or glue; to be called before
    /// anything is made of `deformable`.
    void take_bonds(std::vector<BondPlace<Dim>> places, std::vector<BondCoverage> coverage,
                    std::span<const BoundaryFace> joined, std::span<const BoundaryFace> glued);
    /// BoundaryConditions::thick_cells of `deformable`, increasing; the same.
    void take_thick_cells(std::vector<std::int32_t> cells) { part_options_.boundary.thick_cells = std::move(cells); }

    [[nodiscard]] const mesh::Mesh<Dim>& mesh() const { return mesh_; }
    /// Mesh of the bodies that deform: `mesh` itself where all do, and none is floating.
    [[nodiscard]] const mesh::Mesh<Dim>& deformable() const { return part_ ? *part_ : mesh_; }
    [[nodiscard]] const SolidOptions<Dim>& options() const { return options_; }
    [[nodiscard]] Kinematics kinematics(std::int32_t body) const {
        return kinematics_of(options_.kinematics, static_cast<std::size_t>(body));
    }
    [[nodiscard]] const KinematicsProperties& properties(std::int32_t body) const { return properties_of(kinematics(body)); }
    [[nodiscard]] bool turns(std::int32_t body) const { return properties(body).turns; }  ///< whether it may
    [[nodiscard]] bool is_rigid(std::int32_t body) const { return !properties(body).deforms; }
    [[nodiscard]] bool is_finite(std::int32_t body) const { return properties(body).finite_strains; }
    [[nodiscard]] bool any_finite() const { return any_finite_; }
    [[nodiscard]] bool any_turns() const { return any_turns_; }
    /// Whether both bodies of a place have one frame as long as bonds hold them: floating ones, with Bond::of_grains.
    [[nodiscard]] bool have_one_frame(const BondPlace<Dim>& place) const;
    /// Whether a place joins half cells in one frame; else it is a spring in space.
    [[nodiscard]] bool is_joint(const BondPlace<Dim>& place) const {
        return have_one_frame(place) || (!turns(place.bodies[0]) && !turns(place.bodies[1]));
    }
    /// How a traction of `options` is held.
    [[nodiscard]] TractionHold traction_hold(std::size_t condition) const { return traction_holds_[condition]; }
    /// Its points are [first, second).
    [[nodiscard]] std::pair<std::int32_t, std::int32_t> points_of(std::int32_t body) const;
    /// The options of these bodies, by their numbers in `deformable`.
    [[nodiscard]] const SolidOptions<Dim>& deformable_options() const { return part_options_; }
    /// Positions of SolidOptions::bonds, once `take_bonds` was called.
    [[nodiscard]] const std::vector<BondPlace<Dim>>& bond_places() const { return bond_places_; }
    [[nodiscard]] const std::vector<BondCoverage>& bond_coverage() const { return bond_coverage_; }  ///< of each bond
    [[nodiscard]] const RigidBodies<Dim>& rigid() const { return *rigid_; }
    [[nodiscard]] RigidBodies<Dim>& rigid() { return *rigid_; }
    [[nodiscard]] bool any_rigid() const { return rigid_->size() > 0; }
    /// The boundary faces of `deformable` in `mesh` (n_boundary).
    [[nodiscard]] std::vector<BoundaryFace> boundary_in_mesh() const;
    [[nodiscard]] std::int32_t n_cells() const { return deformable().n_cells(); }  ///< that deform
    /// Points from which a RankPart is made; valid as long as these bodies are.
    [[nodiscard]] SolidPoints<Dim> points() const;

    [[nodiscard]] std::span<const Vector<Dim>> rest() const { return rest_; }                 ///< of the points [m]
    [[nodiscard]] std::span<const double> masses() const { return masses_; }                  ///< of the points [kg]
    [[nodiscard]] std::span<const double> inverse_masses() const { return inverse_masses_; }  ///< of degrees of freedom
    [[nodiscard]] std::span<const std::int32_t> body_of_points() const { return body_; }      ///< in the mesh

    /// Frames of the bodies that deform; `part` as BodyFrames takes it. Throws BadInput for one that has no width to
    /// turn about.
    [[nodiscard]] BodyFrames<Dim> frames(const RankPart<Dim>& part) const;

    // At the centroids of the cells of the whole mesh, whose points may be beside them: floating bodies are taken as moving
    // affinely from one to the other. Calls of all ranks.

    /// A displacement of the cells of the whole mesh [m], from that of the points.
    [[nodiscard]] std::vector<Vector<Dim>> of_cells(std::span<const Vector<Dim>> q) const;
    /// Displacement of the points, from that of the cells: rigid bodies take the motion that is nearest.
    [[nodiscard]] std::vector<Vector<Dim>> of_points(std::span<const Vector<Dim>> displacement) const;
    /// Momenta of the points, from velocities of the cells: rigid bodies take momentum and angular momentum of theirs.
    [[nodiscard]] std::vector<Vector<Dim>> momenta(std::span<const Vector<Dim>> velocity) const;
    /// Velocities of the cells, from momenta of the points.
    [[nodiscard]] std::vector<Vector<Dim>> velocities(std::span<const Vector<Dim>> p) const;
    /// Mean of a body's rotation at both ends of what `frames` and the rigid bodies follow; the identity of a small one.
    [[nodiscard]] Matrix<Dim> mean_turn(std::int32_t body, const BodyFrames<Dim>& frames) const;
    /// Replacement of d^2V/dq^2 on the points of rigid bodies, for the stable step [N/m]; 0 on the others.
    [[nodiscard]] std::vector<double> rigid_stiffness() const;
    /// The cell of the mesh in `deformable`, and its body there; -1 of rigid bodies.
    [[nodiscard]] std::pair<std::int32_t, std::int32_t> deformable_cell(std::int32_t cell) const;
    /// A body of the mesh in `deformable`; -1 of a rigid one.
    [[nodiscard]] std::int32_t deformable_body(std::int32_t body) const;
    /// The other way round: the cell of the mesh that is this one in `deformable`.
    [[nodiscard]] std::int32_t mesh_cell(std::int32_t deformable_cell) const;
    /// The body of the mesh where bodies that deform come first, then those that are rigid; what comes behind stays.
    [[nodiscard]] std::int32_t mesh_body(std::int32_t body) const {
        const std::size_t i = static_cast<std::size_t>(body), n = deformable_bodies_.size();
        if (i < n) return deformable_bodies_[i];
        return i < n + rigid_->size() ? rigid_->mesh_body(i - n) : body;
    }
    /// One value per body of the mesh, from those of the bodies that deform and a function of the rigid ones.
    template <class Rigid>
    [[nodiscard]] std::vector<double> of_bodies(const std::vector<double>& deformable, const Rigid& rigid) const {
        std::vector<double> values(static_cast<std::size_t>(mesh_.n_bodies()));
        for (std::size_t i = 0; i < deformable.size(); ++i) values[deformable_bodies_[i]] = deformable[i];
        for (std::size_t i = 0; i < rigid_->size(); ++i) values[rigid_->mesh_body(i)] = rigid(i);
        return values;
    }
    /// lambda + 2 mu of a rigid body's material, of which its skin is [Pa].
    /// Material of a body that deforms, or of a rigid one behind these, as contact numbers them.
    [[nodiscard]] const Material& material_of_contact_body(std::int32_t body) const {
        return options_.materials[static_cast<std::size_t>(mesh_body(body))];
    }
    [[nodiscard]] double rigid_skin(std::size_t rigid) const {
        return options_.materials[static_cast<std::size_t>(rigid_->mesh_body(rigid))].wave_modulus();
    }
    /// Constant forces on the points of rigid bodies (n_points of them), from body forces: gravity and others [N].
    [[nodiscard]] std::vector<Vector<Dim>> rigid_forces() const;

private:
    void check() const;
    void check_temperature(std::size_t body) const;
    void check_directions(std::size_t body) const;
    void check_pairs() const;
    void keep_groups();
    void join_pulled_faces();
    void set_laws();
    void check_outside(const TractionCondition<Dim>& condition) const;
    [[nodiscard]] double cell_mass(std::int32_t cell) const;
    [[nodiscard]] std::vector<Vector<Dim>> of_deformable_cells(std::span<const Vector<Dim>> of_points) const;

    void to_centroids(std::vector<Vector<Dim>>& of_mesh_cells) const;
    [[nodiscard]] std::vector<Vector<Dim>> to_points(std::span<const Vector<Dim>> of_mesh_cells) const;

    const mesh::Mesh<Dim>& mesh_;
    SolidOptions<Dim> options_;
    bool any_finite_ = any_body(options_.kinematics, &KinematicsProperties::finite_strains);
    bool any_turns_ = any_body(options_.kinematics, &KinematicsProperties::turns);
    std::vector<TractionHold> traction_holds_;
    std::optional<mesh::Mesh<Dim>> part_;  // none: all bodies deform, and no cell has its point beside its centroid
    template <class PositionOf>
    [[nodiscard]] Matrix<Dim> mean_slope(std::size_t body, std::span<const Vector<Dim>> of_mesh_cells, std::int32_t on,
                                         const PositionOf& x_of) const;
    std::vector<std::optional<CellPoints<Dim>>> cell_points_;  // by body that deforms; none: at the centroids
    const RankPart<Dim>* rank_part_ = nullptr;                 // null until `take_part`

    std::vector<BondPlace<Dim>> bond_places_;
    std::vector<BondCoverage> bond_coverage_;
    SolidOptions<Dim> part_options_;
    std::vector<std::int32_t> deformable_bodies_;
    std::optional<RigidBodies<Dim>> rigid_;
    std::vector<Vector<Dim>> rest_;
    std::vector<double> masses_;
    std::vector<double> inverse_masses_;
    std::vector<std::int32_t> body_;
};

}  // namespace abut::solid
