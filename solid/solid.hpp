#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/contact.hpp"
#include "abut/contact/obstacle.hpp"
#include "abut/dynamics/system.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/contact_patches.hpp"

namespace abut::solid {

/// What a scene holds beside its mesh.
template <int Dim>
struct SolidOptions {
    std::vector<Material> materials;  ///< one a body
    BoundaryConditions<Dim> boundary;
    std::vector<Vector<Dim>> acceleration;  ///< of gravity, one a body [m/s^2]; empty: none
    std::function<Vector<Dim>(const Vector<Dim>& position)>
        body_load;                                       ///< force density [N/m^3], constant in time; empty: none
    std::optional<contact::ContactOptions> contact;      ///< empty: bodies pass through each other, at no cost
    std::vector<contact::RigidObstacle<Dim>> obstacles;  ///< with contact only
};

/// A contact of two faces, given as places in Mesh::boundary_faces; `no_face` is one of an obstacle.
template <int Dim>
struct TouchingPair {
    std::int32_t face_1;
    std::int32_t face_2;
    Vector<Dim> normal;  ///< from the body of face 1 into that of face 2
    double gap;          ///< [m]
};

/// Where the time of all steps of a Solid went [s].
struct SolidTimes {
    double bulk = 0.0;
    double contact = 0.0;
    double search = 0.0;
};

/// Deformable bodies on one mesh, in contact with each other and with rigid obstacles: a System. With contact or with loads
/// that vary it is for one run, beginning at t = 0: loads, work and contacts go on from one `mean_force` to the next.
///
/// Faces with a prescribed displacement (whole or in part) take no part in contact; `contact_faces_left_out` counts them.
///
/// `force`, `potential` and `contact_field` take any state before the first step, and later the last state or one that no
/// face has left by more than half the skin since the last search; they throw Misuse for others.
template <int Dim>
class Solid {
public:
    static constexpr int dimension = Dim;

    /// The mesh must outlive the solid. Throws BadInput with place, value, limit and
    /// remedy.
    Solid(const mesh::Mesh<Dim>& mesh, SolidOptions<Dim> options);
    Solid(const Solid&) = delete;
    Solid& operator=(const Solid&) = delete;

    [[nodiscard]] std::size_t size() const { return inverse_mass_.size(); }
    [[nodiscard]] std::span<const double> inverse_mass() const { return inverse_mass_; }
    [[nodiscard]] std::span<const double> masses() const { return cell_mass_; }  ///< of the cells (n_cells) [kg]
    [[nodiscard]] std::span<const Vector<Dim>> rest_positions() const { return mesh_.cell_centroid; }  ///< of the cells [m]
    /// The part of 2/omega_max that is stable [-]: a closed contact stiffens its cells. docs/method.md, Space.
    [[nodiscard]] double step_margin() const { return contact_ ? 0.85 : 1.0; }

    /// Displacements q are cell by cell, shape (n_cells, Dim) [m].
    void force(std::span<const double> q, std::span<double> force);
    /// The bulk is linear and taken at the midpoint; contact is integrated exactly along the way (docs/method.md, Time).
    /// Throws Misuse where the step should begin when the last one ended but does not, Diverged or TooDeep when the
    /// run has diverged or a pair is pressed in deeper than `compression_limit`. After such an error a run with loads that
    /// vary is over; another may try a shorter step.
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                    std::span<double> force);
    /// F(q_1) after the straight way from q_0: for schemes that take no mean. Loads, candidates and admission follow the
    /// step as in `mean_force`: tractions are those at its start. Contacts that open and close again inside it go unnoticed.
    /// Work from outside is taken by the trapezoidal rule. Throws as `mean_force`.
    void end_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                   std::span<double> force);
    /// Whether V depends on q alone: no condition has a history and no obstacle a path.
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
    /// Work of prescribed displacements, of changing tractions and of moving obstacles so far [J].
    [[nodiscard]] double work() const { return work_; }
    /// The linear part alone, without loads and contact: K q [N]; for the stable step.
    void stiffness_product(std::span<const double> q, std::span<double> product);

    /// Parts of the bodies that were in contact during the last step; bodies joined by a pair are in one patch.
    [[nodiscard]] std::vector<dynamics::ContactPatch> contact_patches() const;
    /// F(q) on some cells only (n, Dim) [N], q being where the last step ended. Costs as much as these cells, and the pairs
    /// of the candidate list.
    void end_force_on(std::span<const std::int32_t> cells, std::span<const double> q, std::span<Vector<Dim>> force);

    /// Contact pressure [Pa] and smallest gap [m] of each boundary face in state q, in the order of Mesh::boundary_faces;
    /// a face without an admitted partner that shares area with it has pressure 0 and gap infinity.
    struct ContactField {
        std::vector<double> pressure;
        std::vector<double> gap;
    };
    [[nodiscard]] ContactField contact_field(std::span<const double> q);

    /// Admitted pairs of state q that share area and are open by at most `gap` [m].
    [[nodiscard]] std::vector<TouchingPair<Dim>> touching_pairs(std::span<const double> q, double gap);

    /// Mean force of the last step on an obstacle, with local steps of the common one; after `end_force` that at its end
    /// [N].
    [[nodiscard]] Vector<Dim> obstacle_force(std::size_t obstacle) const;

    [[nodiscard]] const mesh::Mesh<Dim>& mesh() const { return mesh_; }
    [[nodiscard]] const SolidOptions<Dim>& options() const { return options_; }
    [[nodiscard]] Ccg<Dim>& ccg() { return ccg_; }
    [[nodiscard]] contact::ContactReport contact_report() const;
    [[nodiscard]] dynamics::ContactCounts contact_counts() const;  ///< what of it the ledger records
    [[nodiscard]] const contact::Contact<Dim>* contact() const { return contact_ ? &*contact_ : nullptr; }
    [[nodiscard]] std::int64_t contact_faces_left_out() const { return left_out_; }
    /// Places of corners that are too sharp for contact to see them coming; empty without contact. contact/blind_corners.hpp.
    [[nodiscard]] std::vector<Vector<Dim>> blind_corners() const;
    [[nodiscard]] const SolidTimes& times() const { return times_; }

private:
    void build_surface();
    void follow_loads(std::span<const Vector<Dim>> q_0, double time, double dt);
    void require_start(double time, double dt) const;
    void end_step(double time);
    void integrate_contact();
    [[nodiscard]] double take_midpoint(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1);
    void follow_faces(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double motion, double time,
                      double dt);
    void move_faces(std::span<const Vector<Dim>> q_1, double time);
    void keep_active_pairs();
    [[nodiscard]] bool surely_reaches(double motion, double time);
    [[nodiscard]] bool list_reaches(std::span<const Vector<Dim>> q, double time);
    [[nodiscard]] double motion_since_search(std::span<const Vector<Dim>> q);
    void require_list(std::span<const Vector<Dim>> q);
    void search(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt);
    /// Calls `visit(pair, gap)` for each admitted pair that shares area, as of the last `evaluate_contact`.
    template <class Visit>
    void visit_contacts(const Visit& visit) const;
    [[nodiscard]] std::int32_t boundary_place(std::int32_t surface_face) const {
        return surface_.view().is_rigid(surface_face) ? no_face : surface_boundary_[surface_face];
    }
    void fill_rigid(std::vector<Vector<Dim>>& displacement, double time) const;
    void evaluate_faces(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load, double time,
                        std::vector<Vector<Dim>>& displacement, std::vector<Vector<Dim>>& force);
    void evaluate_contact(std::span<const Vector<Dim>> q);
    [[nodiscard]] FaceCorrections<Dim> corrections() const;
    void add_bulk_impulse(std::int32_t level, const dynamics::FreeFlight& flight, double dt, std::span<Vector<Dim>> impulse);
    void add_contact_impulse(const dynamics::FreeFlight& flight, double time, double dt, std::span<Vector<Dim>> impulse);
    void follow_flight(const dynamics::FreeFlight& flight, double time, double dt);
    void add_boundary_work(double share);
    void add_obstacle_work(double share);
    [[nodiscard]] std::size_t obstacle_of(std::int32_t surface_face) const {
        return static_cast<std::size_t>(surface_.body[surface_face] - mesh_.n_bodies());
    }
    [[nodiscard]] Vector<Dim> obstacle_displacement(std::size_t obstacle, double time) const;
    void to_force(std::span<Vector<Dim>> gradient) const;
    [[nodiscard]] double obstacle_motion(double time) const;

    const mesh::Mesh<Dim>& mesh_;
    SolidOptions<Dim> options_;
    Ccg<Dim> ccg_;
    std::vector<double> cell_mass_;
    std::vector<double> inverse_mass_;
    std::vector<Vector<Dim>> body_force_;  // by cell; empty without loads
    double work_ = 0.0;
    double time_ = 0.0;  // of the state that the last step ended in
    bool has_stepped_ = false;
    bool unfinished_ = false;       // a step with loads that vary has begun and not ended
    BoundaryLoad<Dim> load_;        // at that state
    BoundaryLoad<Dim> load_start_;  // at the start of the current step

    contact::Surface<Dim> surface_;
    std::vector<std::int32_t> surface_boundary_;  // place in boundary_faces of each deformable surface face
    std::int64_t left_out_ = 0;
    std::optional<contact::Contact<Dim>> contact_;
    struct Reference {
        std::vector<Vector<Dim>> u;  // cell displacements
        BoundaryLoad<Dim> load;
    };
    Reference searched_;  // state at the last search
    double searched_time_ = 0.0;
    double known_motion_ = 0.0;           // of any face, from the last search to the state where it was bounded last [m]
    double travelled_ = 0.0;              // since then: sum over the steps of the motion of the cell that moved farthest [m]
    bool motion_is_known_ = false;        // these two are of the state that the last step ended in
    std::vector<Vector<Dim>> swept_end_;  // the list holds there, too: end of the step that it was made for
    Region<Dim> region_;                  // of the faces in the candidate list
    std::vector<std::int32_t> local_boundary_;        // their places in boundary_faces (deformable faces come first)
    std::vector<Vector<Dim>> u_0_, u_1_, y_0_, y_1_;  // path of the listed faces; between steps _0 is its end
    std::vector<Vector<Dim>> midpoint_;
    std::vector<std::int32_t> active_pairs_;  // of the last step
    std::vector<Vector<Dim>> obstacle_force_;
    Region<Dim> patch_region_;
    std::vector<Region<Dim>> level_regions_;  // cells evaluated at each level; empty: no local steps
    // Of local steps.
    Region<Dim> contact_region_;                    // cells that feel the faces in the candidate list
    std::vector<std::int32_t> surface_cells_;       // cells that some boundary face depends on
    std::vector<Vector<Dim>> start_;                // work arrays: all cells at the start of a part of a step,
    std::vector<Vector<Dim>> moved_;                // those that are looked at, at another time of it,
    std::vector<Vector<Dim>> gradient_;             // and those of a region
    std::vector<Vector<Dim>> mean_obstacle_force_;  // of the common step so far,
    double local_step_ = 0.0;                       // which is that long
    std::int64_t evaluations_ = 0;
    SolidTimes times_;
};

}  // namespace abut::solid
