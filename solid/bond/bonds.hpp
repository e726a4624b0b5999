#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/body/body_frames.hpp"
#include "abut/solid/bond/bond_faces.hpp"
#include "abut/solid/bond/bond_law.hpp"
#include "abut/solid/bond/bond_springs.hpp"
#include "abut/solid/bond/fit_to_law.hpp"
#include "abut/solid/bond/merged_corrections.hpp"
#include "abut/solid/bond/pressed_sides.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/ccg/ccg.hpp"

namespace abut::solid {

/// Faces that are glued. Between bodies of Kinematics::small the massless interface of both half cells, exactly: with
/// the jump of the free faces at a place p of a bond, Delta = y_2(x_p) - y_1(x_p), both faces move to where their
/// tractions balance,
///
///     delta_f = 1/|f| sum_p A_p s_p,    s_1 = theta_1 Delta,  s_2 = -theta_2 Delta,
///     theta_1 = (K_1 + K_2)^-1 K_2 = 1 - theta_2
///
/// K_f [Pa/m] being the stiffness of the half cell, what its free faces answer taken off. V is that of the cells with
/// û + delta and what their faces, which move as a whole, do not have of it:
///
///     1/2 sum_p A_p Delta . K_12 Delta - 1/2 sum_f |f| delta_f . K_f delta_f,
///     K_12 = theta_1^T K_1 theta_1 + theta_2^T K_2 theta_2
///
/// All of it is quadratic in the displacements of the cells. Where a body may turn: BondSprings. docs/method.md, Bonds.
///
/// A place whose traction t = s K_12 Delta would exceed the strength, pressure not counted (without a fracture energy: one
/// that pulls its sides apart), gives way: its share s falls, at once to 0 or so that t falls with the opening until all of
/// the fracture energy is taken (bond_law.hpp). What V loses by that is dissipated. In a step the share lies between those
/// of both ends, so that it is what the law takes.
///
/// The sides of a place with a fracture energy press on each other as those of a whole one do (pressed_sides.hpp). A place
/// that bears nothing else is broken, and contact takes over the energy by which its sides press.
template <int Dim>
class Bonds {
public:
    /// All must outlive it; `frames` are led along each step before it. Throws BadInput for bodies that are rigid,
    /// where a support holds a bonded face, a traction is on one, or a load from outside on one that answers to it, and
    /// for a fracture energy that is less than what the half cells beside the bond hold at its strength. A call of all
    /// ranks.
    Bonds(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const BodyFrames<Dim>& frames, const RankPart<Dim>& part);

    [[nodiscard]] bool any() const { return !places_.empty(); }
    [[nodiscard]] std::span<const BondPlace<Dim>> places() const { return places_; }
    [[nodiscard]] std::span<const BondCoverage> coverage() const { return bodies_.bond_coverage(); }
    /// Whether it bears nothing any more.
    [[nodiscard]] bool is_broken(std::size_t place) const { return share_[place] == 0.0; }
    /// Energy by which its sides pressed on each other as it broke, once it is handed over to contact [J/m^2]; else 0.
    [[nodiscard]] double pressed_energy(std::size_t place) const { return pressed_energy_[place]; }
    /// Whether one has a strength.
    [[nodiscard]] bool any_breaks() const;

    // In one state, or along a step. Each rank evaluates the faces of its own cells, and brings that to all: those that
    // bring something are calls of all ranks.

    /// Evaluates the bonds for points at q [m] under these loads, where the frames stand.
    void stand_at(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load);
    /// Along the step that the frames follow: in its middle.
    void follow(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0, std::span<const Vector<Dim>> q_1,
                const BoundaryLoad<Dim>& load_1);
    /// delta of `bonded_faces` in a state of small bodies, whatever else is followed (n_bonded_faces) [m]. Valid until
    /// the next call.
    [[nodiscard]] std::span<const Vector<Dim>> displacement_at(std::span<const Vector<Dim>> u,
                                                               const BoundaryLoad<Dim>& load);
    /// Bonded faces of small bodies here, increasing.
    [[nodiscard]] std::span<const BoundaryFace> bonded_faces() const { return faces_->faces_here(); }
    /// Corrections of contact and those of the bonds. Valid until the next call and as long as those are.
    [[nodiscard]] FaceCorrections<Dim> corrections(const FaceCorrections<Dim>& of_contact);
    /// Change of delta along the step that was followed, where a material is damped. Valid until the next one.
    [[nodiscard]] FaceCorrections<Dim> change() const {
        return {change_here_.empty() ? std::span<const BoundaryFace>{} : faces_->faces_here(), change_here_, {}, {}};
    }
    /// Adds dV/du through the corrections (n_cells) [N], after the cells have taken their gradient with the last of them.
    void add_gradient(std::span<Vector<Dim>> gradient);
    /// Pushes on bodies as a whole, those of others included (n_bodies that deform).
    [[nodiscard]] std::span<const BodyPush<Dim>> pushes(std::span<const BodyPush<Dim>> others);
    /// Energy in V that is not contained in that of the cells with these corrections, in one state [J].
    [[nodiscard]] double energy() const;
    /// `energy` is that of the end of the step that was followed from now on. A call of all ranks.
    void see_end(std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1);
    /// As `energy`, with what cells remember now. A call of all ranks.
    [[nodiscard]] double energy_at_end(std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1);
    /// The part of the work of prescribed displacements and tractions in a step from `start` to `end` that is done
    /// through the corrections, with the gradient that was added last [J].
    [[nodiscard]] double work_of_loads(const BoundaryLoad<Dim>& start, const BoundaryLoad<Dim>& end) const;
    /// Adds what bonds resist tiny displacements u of the cells with to K u (n_cells), `apply(corrections)` being K u of the
    /// cells with these corrections: for the stable step [N].
    template <class Apply>
    void add_stiffness(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, const Apply& apply,
                       std::span<Vector<Dim>> product) {
        stand_linear(u, load, always_pressed);
        of_others_ = springs_->stiffness_of(u, load);
        apply(any() ? merged_.of(of_others_, own_corrections()) : FaceCorrections<Dim>{});
        add_gradient(product);
    }

    // Breaking

    /// Places that the end of the step that was followed opens further than ever before, increasing.
    [[nodiscard]] std::vector<BondChange> changes() const;
    /// A change of `changes()` with another extent and another share of the mean force; places without a fracture energy
    /// break as far as they do.
    [[nodiscard]] BondChange opened(const BondChange& change, const BondOpening& opening) const;
    /// Whether one of them takes a fracture energy.
    [[nodiscard]] bool have_law(std::span<const BondChange> changes) const;
    [[nodiscard]] double energy_by_law(std::span<const BondChange> changes) const;  ///< of all of them [J]
    /// By how much all of them lose more as their share of the mean force goes to that of the end of the step at which most
    /// is lost, and less as it goes to that of the other one, if no place knew of another [J].
    [[nodiscard]] std::array<double, 2> rise_of_loss(std::span<const BondChange> changes) const;
    /// Shares what they have lost together [J] among them, as their laws would have it.
    void share_loss(double lost, std::span<BondChange> changes) const;
    /// From the next call of `stand_at` or `follow` on these places have the share of the start of the step, of its
    /// end, or of its mean force.
    enum class When { start, middle, end };
    void set_shares(std::span<const BondChange> changes, When when);
    /// The step has ended, and these places have the share of its end from now on.
    void end_changes(std::span<const BondChange> changes);
    /// Whether a place broke in the last step that has ended so.
    [[nodiscard]] bool any_broke() const { return any_broke_; }
    /// Whether one broke under pressure: V changes in the next `leave_out_broken`.
    [[nodiscard]] bool any_broke_pressed() const { return !broke_pressed_.empty(); }
    /// Places that are broken take no part any more. A call of all ranks.
    void leave_out_broken();
    /// Hands over to contact what the sides of these places press with, less by one factor so that it is this energy [J] at
    /// most (handed_over_part). To be called behind `leave_out_broken`.
    void hand_over(double energy);
    [[nodiscard]] double share(std::size_t place) const { return share_[place]; }
    /// Energy that places with a fracture energy have lost beyond what belongs to their openings; less than 0: they have
    /// lost less [J].
    [[nodiscard]] double beyond_law() const;
    /// Number of the first body that has the same frame, of each that deforms (n_bodies): as places of Bond::of_grains
    /// hold now.
    [[nodiscard]] std::vector<std::int32_t> frame_groups() const;
    /// Bodies that deform and that bonds of grains in one frame hold which have begun to open, increasing.
    [[nodiscard]] std::vector<std::size_t> opening_bodies() const;
    /// Bonds among these whose grains have turned against each other by more than `loose_turn`, increasing. `turns`: the
    /// rotation of each body (n_bodies that deform), read of `opening_bodies`.
    [[nodiscard]] std::vector<std::size_t> loose_bonds(std::span<const Matrix<Dim>> turns) const;
    /// Springs hold what is left of these bonds from now on, so that grains may have frames of their own: in the state of
    /// the last `stand_at` they have the energy that half cells had. A call of all ranks.
    void loosen(std::span<const std::size_t> bonds);

    /// All places with a strength are broken, and nothing is booked. A call of all ranks.
    void break_all();
    void save(StateWriter& state) const;
    void restore(StateReader& state);
    /// `old_boundary`: of each boundary face of the mesh its index in that of `before`, -1: it was not there. Throws
    /// BadInput for a bond that `before` does not have.
    void take_over(const Bonds& before, std::span<const std::int32_t> old_boundary);

private:
    struct BondedFace {
        double measure;
        Matrix<Dim> stiffness;                 // K_f [Pa/m]
        std::int32_t cell;                     // where it is here; -1
        std::vector<BoundaryFace> neighbours;  // of an own one: boundary faces of the cell, itself among them
    };
    struct Joint {
        std::size_t place;
        std::array<std::size_t, 2> face;      // positions in faces_
        double area;                          // A_p
        std::array<Matrix<Dim>, 2> share;     // theta_1, -theta_2
        Matrix<Dim> stiffness;                // K_12 [Pa/m]
        Vector<Dim> normal;                   // n, from the first face into the second
        Vector<Dim> under_pressure;           // the jump where n . Delta = 1 and K_12 Delta is along n
        double normal_stiffness;              // of that: 1/(n . K_12^-1 n) [Pa/m]
        std::array<std::size_t, 2> slope_of;  // the first entry of each side in slope_; none of faces that are not here
        std::array<std::size_t, 2> slope_end;
    };
    /// State on which `of_side_1_` depends, where a step that was followed ended.
    struct End {
        bool is_known = false;
        std::vector<Vector<Dim>> q;           // of cells_ [m]
        std::vector<BodyFrame<Dim>> frames;   // empty where no body turns
        std::vector<Vector<Dim>> prescribed;  // BoundaryLoad::displacement of own faces [m]; empty: none
    };
    /// Part that a cell's displacement adds to that of a position beside the centroid of its face.
    struct Slope {
        std::int32_t cell;
        double weight;
    };

    [[nodiscard]] std::vector<std::size_t> held_joints() const;
    void make_joints(std::span<const std::size_t> of_joints);
    void make_springs();
    /// Whether it is the interface of half cells, and else a spring.
    [[nodiscard]] bool is_joint(std::size_t place) const {
        return bodies_.is_joint(places_[place]) && loosened_[place] == 0.0 && !is_broken(place);
    }
    void check_bodies() const;
    void check_metal(std::span<const std::size_t> of_joints) const;
    void check(std::span<const BoundaryFace> bonded) const;
    [[nodiscard]] std::vector<BoundaryFace> boundary_of(std::int32_t cell) const;
    [[nodiscard]] Matrix<Dim> stiffness_of(BoundaryFace face) const;
    void take_faces();
    void append_joint(std::size_t place);
    void append_slope(std::size_t face, const Vector<Dim>& arm);
    void take_cells();
    void find_opening();
    [[nodiscard]] std::span<const Vector<Dim>> of_cells(std::span<const Vector<Dim>> q,
                                                        std::span<const BodyFrame<Dim>> frames);
    void stand_linear(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                      PressedSides (*pressed)(double distance));
    [[nodiscard]] bool begins_at_end(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0) const;
    void keep_end(std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1);
    void take_own_sides(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, std::vector<Vector<Dim>>& of_sides);
    void take_jumps(std::span<const Vector<Dim>> of_sides, std::vector<Vector<Dim>>& jump) const;
    void set_corrections(std::span<const Vector<Dim>> jump, std::span<const PressedSides> pressed,
                         std::vector<Vector<Dim>>& delta, std::vector<Vector<Dim>>& here) const;
    [[nodiscard]] double share_of(const Joint& joint) const { return share_[joint.place]; }
    [[nodiscard]] static double normal_part(const Joint& joint, const Vector<Dim>& jump) { return joint.normal.dot(jump); }
    [[nodiscard]] static double pressed_energy(const Joint& joint, const Vector<Dim>& jump) {
        const double pressed = std::min(normal_part(joint, jump), 0.0);
        return 0.5 * joint.normal_stiffness * pressed * pressed;
    }
    /// The jump without what the sides are pressed.
    [[nodiscard]] static Vector<Dim> beside_pressure(const Joint& joint, const Vector<Dim>& jump) {
        const double along = normal_part(joint, jump);
        return along < 0.0 ? Vector<Dim>(jump - along * joint.under_pressure) : jump;
    }
    template <class Look>
    void look_at_sides(const Look& look, std::vector<PressedSides>& pressed) const;
    [[nodiscard]] Vector<Dim> push_of(const Joint& joint, const Vector<Dim>& jump, const PressedSides& pressed) const;
    [[nodiscard]] FaceCorrections<Dim> own_corrections() const { return {faces_->faces_here(), delta_here_, {}, {}}; }
    void check_fracture_energy() const;
    [[nodiscard]] double fracture_energy(std::size_t place) const;
    void append_change(std::size_t place, const BondPull& pull, std::vector<BondChange>& changes) const;
    [[nodiscard]] Vector<Dim> bulk_gradient(const BondedFace& of_cell, BoundaryFace face) const;
    void take_excess();
    void push_faces(std::span<Vector<Dim>> gradient);

    const Bodies<Dim>& bodies_;
    const mesh::Mesh<Dim>& mesh_;  // of the bodies that deform
    Ccg<Dim>& ccg_;
    const BodyFrames<Dim>& frames_;
    const RankPart<Dim>& part_;
    std::vector<BondPlace<Dim>> places_;
    std::vector<double> share_;             // by place, from 1, whole, to 0, broken
    std::vector<double> pressed_energy_;    // by place, handed over to contact [J/m^2]
    std::vector<double> loosened_;          // by place: its stiffness if it has become a spring [Pa/m]; 0: it has not
    std::vector<double> normal_stiffness_;  // by place, of those that are or were joints, against pressure [Pa/m]
    // By place, where it has a fracture energy: what of it was taken [J/m^2], and its opening over that of a broken place
    std::vector<double> taken_, opened_;
    bool any_broke_ = false;                 // in the last step
    std::vector<BondChange> broke_pressed_;  // in the last step, under pressure
    std::vector<std::size_t> opening_;   // first place of each bond of grains in one frame that has begun to open and holds
    std::vector<BondChange> in_middle_;  // whose share is that of the mean force of a step
    std::unique_ptr<BondSprings<Dim>> springs_;
    std::optional<BondFaces<Dim>> faces_;  // of small bodies
    std::vector<BondedFace> of_faces_;     // of each
    std::vector<Joint> joints_;
    std::vector<Slope> slope_;
    std::vector<std::int32_t> cells_;                 // that own sides of joints depend on, increasing
    std::vector<Vector<Dim>> in_frames_;              // displacements of these (n_cells) [m]; empty where no body turns
    RankItems sides_;                                 // of joints: 2 joint + side
    std::vector<Vector<Dim>> of_side_0_, of_side_1_;  // y at the place, by side: elsewhere, and at `end_` [m]
    End end_;
    std::vector<Vector<Dim>> jump_, jump_0_, jump_1_;  // Delta, by joint: as it counts, and at both ends of a step [m]
    std::vector<PressedSides> pressed_;                // of joints, as `jump_`
    std::vector<Vector<Dim>> of_face_;                 // û, by bonded face here [m]
    std::vector<Vector<Dim>> delta_, delta_here_;      // by bonded face, by those here [m]
    std::vector<Vector<Dim>> jump_at_, delta_at_, delta_here_at_;  // of `displacement_at`
    std::vector<PressedSides> pressed_at_;
    std::vector<Vector<Dim>> change_here_;  // of delta in a step; empty: nothing is damped
    std::vector<Vector<Dim>> excess_;       // of the face's traction over that of its half cell alone, by bonded face [Pa]
    std::vector<Vector<Dim>> gradient_;     // dV/dû through the corrections, by bonded face [N]
    FaceCorrections<Dim> of_others_;        // of contact and springs
    MergedCorrections<Dim> merged_;
};

}  // namespace abut::solid
