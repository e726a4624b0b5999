#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/body/body_frame.hpp"
#include "abut/solid/material/material.hpp"
#include "abut/solid/part/solid_points.hpp"

namespace abut::solid {

template <int Dim>
class RankPart;

/// Position of a rigid body: a point that is at X' from its centre at rest is at centre + map X'. The map is a
/// rotation, up to rounding.
template <int Dim>
struct RigidPlace {
    Vector<Dim> centre = Vector<Dim>::Zero();
    Matrix<Dim> map = Matrix<Dim>::Identity();

    [[nodiscard]] Vector<Dim> operator()(const Vector<Dim>& rest_arm) const { return centre + map * rest_arm; }
};

/// Bodies that do not deform. Each is Dim + 1 points of equal mass, with the mass, the centre and the second moments of the
/// body, whose distances stay as they are: all points of the body are the same affine function of these. docs/method.md,
/// Rigid bodies.
///
/// In space the distances are held by impulses along the lines between the points, as they are in the middle of the step
/// before: these do no work in MEMM and have no moment about the mean positions, so that H~, momentum and J~ stay exact.
template <int Dim>
class RigidBodies {
public:
    static constexpr int points_per_body = points_per_rigid_body<Dim>;

    /// Bodies of the mesh, increasing; their points are numbered from `first_point` on.
    RigidBodies(const mesh::Mesh<Dim>& mesh, std::span<const std::int32_t> bodies, std::span<const Material> materials,
                std::int32_t first_point);

    [[nodiscard]] std::size_t size() const { return bodies_.size(); }
    [[nodiscard]] std::int32_t mesh_body(std::size_t body) const { return bodies_[body].mesh_body; }
    [[nodiscard]] std::int32_t first_point(std::size_t body) const { return bodies_[body].first_point; }
    [[nodiscard]] double mass(std::size_t body) const { return bodies_[body].mass; }
    [[nodiscard]] const Vector<Dim>& rest_centre(std::size_t body) const { return bodies_[body].centre; }
    /// Positions of its points at rest (points_per_body) [m].
    [[nodiscard]] std::span<const Vector<Dim>> rest_points(std::size_t body) const { return bodies_[body].rest; }

    /// For displacements q of all points of the system (n_points) [m].
    [[nodiscard]] RigidPlace<Dim> place(std::size_t body, std::span<const Vector<Dim>> q) const {
        return place_by(body, of_points(bodies_[body], q));
    }
    /// For those of its points alone (points_per_body) [m].
    [[nodiscard]] RigidPlace<Dim> place_by(std::size_t body, std::span<const Vector<Dim>> q_of_points) const;
    /// A point at X' from the centre moves with centre + map X' [m/s], for velocities of all points of the system
    /// (n_points).
    [[nodiscard]] RigidPlace<Dim> velocity(std::size_t body, std::span<const Vector<Dim>> v) const;
    /// dV/dx of its points [N], from gradients p at X' from the centre: their sum, and that of p X'^T.
    void set_gradient(std::size_t body, const Vector<Dim>& sum, const Matrix<Dim>& moment,
                      std::span<Vector<Dim>> gradient) const;
    /// Displacements of its points where the body is turned and shifted [m].
    void set_displacement(std::size_t body, const RigidPlace<Dim>& place, std::span<Vector<Dim>> q) const;
    /// Momenta of its points for a velocity of the centre [m/s] and a spin [rad/s], at rest.
    void set_momentum(std::size_t body, const Vector<Dim>& velocity, const AxialVector<Dim>& spin,
                      std::span<Vector<Dim>> p) const;

    /// These bodies, increasing, are constrained here from now on, and others, of other ranks, are left as they are.
    void constrain_only(std::span<const std::int32_t> bodies) { constrained_.assign(bodies.begin(), bodies.end()); }
    /// A step from q_0 to q_1: what constrains the next half step lies between.
    void follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1);
    /// Mean of the rotations at both ends of that step.
    [[nodiscard]] Matrix<Dim> mean_turn(std::size_t body) const {
        return 0.5 * (bodies_[body].turn_0 + bodies_[body].turn_1);
    }
    /// Adds to p (n_points) the impulses that keep all distances from q over dt (< 0: back), along the lines of the last
    /// step. Throws Diverged where there are none.
    void constrain_along(std::span<const Vector<Dim>> q, double dt, std::span<Vector<Dim>> p);
    /// As `constrain_along`, along the lines in q. Where it goes back, the step that lies there is the last one from now on.
    void constrain_at(std::span<const Vector<Dim>> q, double dt, std::span<Vector<Dim>> p);
    /// Adds to the forces on the points what holds the distances in q, at the mean of the velocities before and after.
    void add_constraint_forces(std::span<const Vector<Dim>> q, std::span<Vector<Dim>> force) const;

    /// Between two steps; `part`: of whose ranks each brings what it constrains.
    void save(StateWriter& state, const RankPart<Dim>& part) const;
    void restore(StateReader& state);
    /// Takes over the state of `before`: the same bodies, whose points may be others.
    void take_over(const RigidBodies& before);
    /// Displacements and momenta of its points from those of `before` (n_points of each).
    void take_points(std::size_t body, const RigidBodies& before, std::span<const Vector<Dim>> old_q,
                     std::span<Vector<Dim>> q) const;
    void take_momenta(std::size_t body, const RigidBodies& before, std::span<const Vector<Dim>> old_p,
                      std::span<Vector<Dim>> p) const;

private:
    struct Body {
        std::int32_t mesh_body;
        std::int32_t first_point;
        double mass;
        Vector<Dim> centre;
        Matrix<Dim> second_moment;  // J = sum m X' X'^T
        Matrix<Dim> inverse;        // of J
        std::vector<Vector<Dim>> rest;
        Matrix<Dim> turn_0 = Matrix<Dim>::Identity(), turn_1 = Matrix<Dim>::Identity();   // at both ends of the last step
        Matrix<Dim> rate_before = Matrix<Dim>::Zero(), rate_after = Matrix<Dim>::Zero();  // of the map, around the last node
    };

    [[nodiscard]] Vector<Dim> rest_arm(const Body& body, int i) const { return body.rest[i] - body.centre; }
    /// Gives the turn of the body at the other end.
    Matrix<Dim> constrain(Body& body, const Matrix<Dim>& lines, const Matrix<Dim>& guess, std::span<const Vector<Dim>> q,
                          double dt, std::span<Vector<Dim>> p) const;
    [[nodiscard]] static std::span<const Vector<Dim>> of_points(const Body& body, std::span<const Vector<Dim>> of_all) {
        return of_all.subspan(static_cast<std::size_t>(body.first_point), points_per_body);
    }
    // Values of the points of the body
    [[nodiscard]] Matrix<Dim> moment_of(const Body& body, const Matrix<Dim>& begin, std::span<const Vector<Dim>> q) const;
    [[nodiscard]] Matrix<Dim> map_of(const Body& body, std::span<const Vector<Dim>> q) const;

    std::vector<Body> bodies_;
    std::vector<std::int32_t> constrained_;  // here
};

}  // namespace abut::solid
