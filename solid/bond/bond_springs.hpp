#pragma once
// Private to the sources of this layer.
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/body/body_frames.hpp"
#include "abut/solid/bond/bond_faces.hpp"
#include "abut/solid/bond/bond_law.hpp"
#include "abut/solid/bond/merged_corrections.hpp"
#include "abut/solid/bond/pressed_sides.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/ccg/ccg.hpp"

namespace abut::solid {

/// A place of a bond at least one of whose bodies may turn: a spring of no length between the points of both faces that are
/// there at rest, as stiff in all directions as both half cells in series are along the normal,
///
///     V = k_12 A/2 |x_2 - x_1|^2,     x = centre + Q (X - mean of X + û_f + G_c (X - x_f))
///
/// so that its mean force over a step is k_12 A times the mean of x_2 - x_1, without a moment. Sides of a place that has
/// opened press on each other besides, along the normal, which turns with the first body (pressed_sides.hpp): that has a
/// moment. docs/method.md, Bonds.
template <int Dim>
class BondSprings {
public:
    /// All but `of_springs` and `stiffness` must outlive it; `frames` are led along each step before it. Of all places
    /// (n_places) those that are springs, whose faces nothing holds, the share of the pull that a place has, its
    /// stiffness and that against pressure [Pa/m], 0: that of both half cells along the normal. A call of all ranks.
    BondSprings(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const BodyFrames<Dim>& frames, const RankPart<Dim>& part,
                std::span<const BondPlace<Dim>> places, std::span<const std::size_t> of_springs,
                const std::vector<double>& share, std::span<const double> stiffness,
                std::span<const double> normal_stiffness);

    [[nodiscard]] bool any() const { return !springs_.empty(); }
    [[nodiscard]] const BondFaces<Dim>& faces() const { return faces_; }

    // Each rank evaluates the faces of its own cells; what brings them to all is a call of all ranks.

    /// Evaluates the springs for points at q [m], where the frames stand.
    void stand_at(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load);
    /// Along the step that the frames follow.
    void follow(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0, std::span<const Vector<Dim>> q_1,
                const BoundaryLoad<Dim>& load_1);
    /// Stiffness for tiny displacements u of the cells [m], no body being turned: for the stable step. Valid until the
    /// next call of any.
    [[nodiscard]] FaceCorrections<Dim> stiffness_of(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load);
    /// The corrections of contact and these. Valid until the next call and as long as those are.
    [[nodiscard]] FaceCorrections<Dim> corrections(const FaceCorrections<Dim>& of_contact);
    /// Pushes of the springs on each body, added to those of others (n_bodies that deform).
    [[nodiscard]] std::span<const BodyPush<Dim>> pushes(std::span<const BodyPush<Dim>> others);
    [[nodiscard]] double energy() const;  ///< at the end of the step [J]
    /// The end alone: `energy` is that of it. What springs pull with stays.
    void see_end(std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1, StepState state);
    /// Calls visit(place, pull) with what the end of the step pulls each with, without its pressure where
    /// leaves_pressure(place).
    template <class LeavesPressure, class Visit>
    void for_each_pull(const LeavesPressure& leaves_pressure, const Visit& visit) const {
        for (std::size_t i = 0; i < springs_.size(); ++i) {
            const std::size_t place = springs_[i].place;
            const double stiffness = springs_[i].stiffness / places_[place].area;
            const Sides start = sides_at(i, x_0_, frames_.start()), end = sides_at(i, x_1_, frames_.end());
            const bool leaves = leaves_pressure(place);
            const Vector<Dim> slip = leaves ? end.beside_pressure() : end.jump;
            const double pressed = std::min(end.distance(), 0.0);
            visit(place, BondPull{.traction = stiffness * slip.norm(),
                                  .stiffness = stiffness,
                                  .held_0 = 0.5 * stiffness * (leaves ? start.beside_pressure() : start.jump).squaredNorm(),
                                  .pulls_apart = end.jump.dot(tilted_normal(i)) > 0.0,
                                  .pressed = 0.5 * springs_[i].normal_stiffness * pressed * pressed / places_[place].area});
        }
    }
    /// Calls visit(place, k_12) [Pa/m].
    template <class Visit>
    void for_each_stiffness(const Visit& visit) const {
        for (const BondSpring& spring : springs_) visit(spring.place, spring.stiffness / places_[spring.place].area);
    }

private:
    struct End {
        std::size_t face;  // position in faces_
        Vector<Dim> arm;   // from the centroid of the face
        Vector<Dim> rest;  // X
        std::size_t body;  // of those that deform
    };
    struct BondSpring {
        std::array<End, 2> ends;
        double stiffness;         // k_12 A [N/m]
        double normal_stiffness;  // of sides that press on each other [N/m]
        std::size_t place;
        bool keeps_pressure;  // while its share falls: it has a fracture energy
    };
    using Positions = std::vector<std::array<Vector<Dim>, 2>>;
    /// Both sides of a place in one state, in space.
    struct Sides {
        Vector<Dim> jump;    // x_2 - x_1 [m]
        Vector<Dim> normal;  // out of the first face, as it turns with its body
        [[nodiscard]] double distance() const { return jump.dot(normal); }
        /// The jump without what they are pressed.
        [[nodiscard]] Vector<Dim> beside_pressure() const {
            const double along = distance();
            return along < 0.0 ? Vector<Dim>(jump - along * normal) : jump;
        }
    };
    /// Displacement and tilt of faces_, in their frames.
    struct Tilted {
        std::vector<Vector<Dim>> displacement;
        std::vector<Matrix<Dim>> tilt;
    };

    void begin_collecting();
    void collect();
    void add(const End& end, const Vector<Dim>& in_frame);
    [[nodiscard]] Sides sides_at(std::size_t spring, const Positions& x, std::span<const BodyFrame<Dim>> frames) const {
        const BondSpring& of = springs_[spring];
        return {x[spring][1] - x[spring][0], frames[of.ends[0].body].turn * places_[of.place].normal};
    }
    [[nodiscard]] double pressure_energy(std::size_t spring) const;
    [[nodiscard]] Vector<Dim> tilted_normal(std::size_t spring) const;
    void push_sides(std::size_t spring, const Vector<Dim>& pull);
    /// Stiffness against pressure beyond that of the pull [N/m]; 0 without a fracture energy, and of whole places that never
    /// were joints.
    [[nodiscard]] double pressure_stiffness(const BondSpring& spring) const {
        return spring.keeps_pressure ? spring.normal_stiffness - share_[spring.place] * spring.stiffness : 0.0;
    }
    [[nodiscard]] Vector<Dim> pressure(std::size_t spring);
    void evaluate_own(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, StepState state, Tilted& faces);
    void bring(std::initializer_list<Tilted*> states);
    void place(std::span<const BodyFrame<Dim>> frames, const Tilted& faces, Positions& x) const;
    [[nodiscard]] FaceCorrections<Dim> own_corrections() const {
        return {faces_.faces_here(), {}, face_gradient_, cell_moment_};
    }

    Ccg<Dim>& ccg_;
    const BodyFrames<Dim>& frames_;
    std::span<const BondPlace<Dim>> places_;
    const std::vector<double>& share_;
    BondFaces<Dim> faces_;
    std::vector<std::size_t> here_;  // of each face its position among those here; `nowhere`: it is not
    std::vector<BondSpring> springs_;
    Region<Dim> region_;  // of own faces
    Positions x_0_, x_1_;
    std::vector<Vector<Dim>> u_;
    std::vector<Vector<Dim>> own_displacement_;
    std::vector<Matrix<Dim>> own_tilt_;
    Tilted start_, end_;
    std::vector<Vector<Dim>> face_gradient_;  // of faces here [N]
    std::vector<Matrix<Dim>> cell_moment_;    // of faces here [N m]
    std::vector<BodyPush<Dim>> pushes_, all_pushes_;
    MergedCorrections<Dim> merged_;
};

}  // namespace abut::solid
