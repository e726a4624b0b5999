#include "abut/solid/body/rigid_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "abut/base/decompositions.hpp"
#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/rotation.hpp"
#include "abut/base/state_fields.hpp"
#include "abut/solid/part/body_cells.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {
namespace {

constexpr int most_projections = 50;
constexpr double settled = 1e-15;  // the last turn of Newton's method [rad]

/// Corners of a regular simplex about the origin, as columns: the sum of their outer products is the identity times their
/// number.
template <int Dim>
SmallMatrix<Dim, Dim + 1> simplex() {
    if constexpr (Dim == 2)
        return {{0.0, -std::sqrt(1.5), std::sqrt(1.5)}, {std::sqrt(2.0), -std::sqrt(0.5), -std::sqrt(0.5)}};
    else
        return {{1.0, 1.0, -1.0, -1.0}, {1.0, -1.0, 1.0, -1.0}, {1.0, -1.0, -1.0, 1.0}};
}

/// Second moment of a body with density 1 about a point: sum over simplices from there to its faces, cut into simplices.
template <int Dim>
Matrix<Dim> second_moment_of(const mesh::Mesh<Dim>& mesh, std::int32_t body, const Vector<Dim>& centre) {
    Matrix<Dim> moment = Matrix<Dim>::Zero();
    for (const std::int32_t f : mesh.boundary_faces) {
        if (mesh.cell_body[mesh.face_cells[f][0]] != body) continue;
        const auto corners = mesh.face_vertices[f];
        for (std::size_t i = 1; i + Dim - 2 < corners.size(); ++i) {
            Matrix<Dim> arms;  // from the point to the corners of a part of the face, as columns
            arms.col(0) = mesh.vertices[corners[0]] - centre;
            for (int k = 1; k < Dim; ++k) arms.col(k) = mesh.vertices[corners[i + static_cast<std::size_t>(k) - 1]] - centre;
            const Vector<Dim> sum = arms * Vector<Dim>::Ones();
            constexpr double factorial = Dim == 2 ? 24.0 : 120.0;  // (Dim + 2)!
            moment += arms.determinant() / factorial * (arms * arms.transpose() + sum * sum.transpose());
        }
    }
    return moment;
}

template <int Dim>
Matrix<Dim> inertia_of(const Matrix<Dim>& second_moment) {
    return second_moment.trace() * Matrix<Dim>::Identity() - second_moment;
}

/// exp(hat w)
template <int Dim>
Matrix<Dim> turn_by(const AxialVector<Dim>& w) {
    const double angle = w.norm();
    if (angle == 0.0) return Matrix<Dim>::Identity();
    const Matrix<Dim> h = hat<Dim>(w);
    const double half = std::sin(0.5 * angle) / angle;
    return Matrix<Dim>::Identity() + std::sin(angle) / angle * h + 2.0 * half * half * h * h;
}

}  // namespace

template <int Dim>
RigidBodies<Dim>::RigidBodies(const mesh::Mesh<Dim>& mesh, std::span<const std::int32_t> bodies,
                              std::span<const Material> materials, std::int32_t first_point) {
    for (const std::int32_t number : bodies) {
        const auto [first, last] = cells_of_body(mesh, number);
        const double density = materials[static_cast<std::size_t>(number)].density;
        Body body{.mesh_body = number, .first_point = first_point, .mass = 0.0, .centre = Vector<Dim>::Zero()};
        const Vector<Dim> origin = mesh.cell_centroid[first];
        for (std::int32_t c = first; c < last; ++c) {
            body.mass += density * mesh.cell_measure[c];
            body.centre += density * mesh.cell_measure[c] * (mesh.cell_centroid[c] - origin);
        }
        body.centre = origin + body.centre / body.mass;
        body.second_moment = density * second_moment_of(mesh, number, body.centre);
        body.inverse = body.second_moment.inverse();

        const auto root_of = [](const Vector<Dim>& squares) {
            return squares.unaryExpr([](double square) { return std::sqrt(std::max(square, 0.0)); });
        };
        const SymmetricEigen<Dim> eigen = symmetric_eigen(body.second_moment);
        const Matrix<Dim> scale = eigen.vectors * root_of(eigen.values / body.mass).asDiagonal();
        for (int i = 0; i < points_per_body; ++i)
            body.rest.push_back(body.centre + scale * Vector<Dim>(simplex<Dim>().col(i)));
        bodies_.push_back(body);
        first_point += points_per_body;
    }
    constrained_.resize(bodies_.size());
    std::iota(constrained_.begin(), constrained_.end(), 0);
}

/// `begin` and sum m q X'^T, q being differences to that of the first point.
template <int Dim>
Matrix<Dim> RigidBodies<Dim>::moment_of(const Body& body, const Matrix<Dim>& begin, std::span<const Vector<Dim>> q) const {
    const double mass = body.mass / points_per_body;
    Matrix<Dim> moment = begin;
    for (int i = 0; i < points_per_body; ++i) moment += mass * (q[i] - q[0]) * rest_arm(body, i).transpose();
    return moment;
}

template <int Dim>
Matrix<Dim> RigidBodies<Dim>::map_of(const Body& body, std::span<const Vector<Dim>> q) const {
    return moment_of(body, body.second_moment, q) * body.inverse;
}

template <int Dim>
RigidPlace<Dim> RigidBodies<Dim>::place_by(std::size_t index, std::span<const Vector<Dim>> q) const {
    const Body& body = bodies_[index];
    Vector<Dim> shift = Vector<Dim>::Zero();
    for (int i = 0; i < points_per_body; ++i) shift += q[i] - q[0];
    return {body.centre + q[0] + shift / points_per_body, map_of(body, q)};
}

template <int Dim>
RigidPlace<Dim> RigidBodies<Dim>::velocity(std::size_t index, std::span<const Vector<Dim>> of_all) const {
    const Body& body = bodies_[index];
    const auto v = of_points(body, of_all);
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (int i = 0; i < points_per_body; ++i) sum += v[i];
    return {sum / points_per_body, moment_of(body, Matrix<Dim>::Zero(), v) * body.inverse};
}

template <int Dim>
void RigidBodies<Dim>::set_gradient(std::size_t index, const Vector<Dim>& sum, const Matrix<Dim>& moment,
                                    std::span<Vector<Dim>> gradient) const {
    const Body& body = bodies_[index];
    const double mass = body.mass / points_per_body;
    const Matrix<Dim> slope = moment * body.inverse;
    for (int i = 0; i < points_per_body; ++i)
        gradient[body.first_point + i] = mass * (sum / body.mass + slope * rest_arm(body, i));
}

template <int Dim>
void RigidBodies<Dim>::set_displacement(std::size_t index, const RigidPlace<Dim>& place, std::span<Vector<Dim>> q) const {
    const Body& body = bodies_[index];
    for (int i = 0; i < points_per_body; ++i) q[body.first_point + i] = place(rest_arm(body, i)) - body.rest[i];
}

template <int Dim>
void RigidBodies<Dim>::set_momentum(std::size_t index, const Vector<Dim>& velocity, const AxialVector<Dim>& spin,
                                    std::span<Vector<Dim>> p) const {
    const Body& body = bodies_[index];
    const double mass = body.mass / points_per_body;
    for (int i = 0; i < points_per_body; ++i)
        p[body.first_point + i] = mass * (velocity + hat<Dim>(spin) * rest_arm(body, i));
}

template <int Dim>
void RigidBodies<Dim>::follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1) {
    for (Body& body : bodies_) {
        body.rate_before = body.rate_after;
        body.turn_0 = nearest_rotation(map_of(body, of_points(body, q_0)));
        body.turn_1 = nearest_rotation(map_of(body, of_points(body, q_1)));
    }
}

template <int Dim>
void RigidBodies<Dim>::constrain_along(std::span<const Vector<Dim>> q, double dt, std::span<Vector<Dim>> p) {
    parallel_each(
        std::ssize(constrained_),
        [&](std::ptrdiff_t i) {
            Body& body = bodies_[constrained_[i]];
            constrain(body, 0.5 * (body.turn_0 + body.turn_1), body.turn_1 * body.turn_0.transpose() * body.turn_1, q, dt,
                      p);
        },
        16);
}

template <int Dim>
void RigidBodies<Dim>::constrain_at(std::span<const Vector<Dim>> q, double dt, std::span<Vector<Dim>> p) {
    for (const std::int32_t i : constrained_) {
        Body& body = bodies_[i];
        const Matrix<Dim> turn = nearest_rotation(map_of(body, of_points(body, q)));
        const Matrix<Dim> other_end = constrain(body, turn, turn, q, dt, p);
        if (dt > 0.0) continue;
        body.turn_0 = other_end;
        body.turn_1 = turn;
    }
}

/// The lines are those of Fm X'; impulses along them are Fm S J^-1 m X', S symmetric, and R J, R being where the body
/// goes to, is B + dt (P - Fm S) with B = sum m x' X'^T and P = sum p X'^T: R is the rotation for which Fm^-1 (B + dt
/// P - R J) is symmetric.
template <int Dim>
Matrix<Dim> RigidBodies<Dim>::constrain(Body& body, const Matrix<Dim>& lines, const Matrix<Dim>& guess,
                                        std::span<const Vector<Dim>> q, double dt, std::span<Vector<Dim>> p) const {
    using AxialMatrix = SmallMatrix<Dim*(Dim - 1) / 2, Dim*(Dim - 1) / 2>;
    const double mass = body.mass / points_per_body;
    Matrix<Dim> momenta = Matrix<Dim>::Zero();
    for (int i = 0; i < points_per_body; ++i) momenta += p[body.first_point + i] * rest_arm(body, i).transpose();
    const Matrix<Dim> from = map_of(body, of_points(body, q)) * body.second_moment;
    const Matrix<Dim> back = lines.inverse(), target = back * (from + dt * momenta);
    Matrix<Dim> turn = guess;
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0;; ++iteration) {
        AxialMatrix slope;
        for (int j = 0; j < slope.cols(); ++j)
            slope.col(j) = axial<Dim>(back * turn * hat<Dim>(AxialVector<Dim>::Unit(j)) * body.second_moment);
        const AxialVector<Dim> rest = axial<Dim>(target - back * turn * body.second_moment);
        const AxialVector<Dim> w = slope.inverse() * rest;
        const double size = w.norm();
        if (!std::isfinite(size) || iteration == most_projections)
            throw Diverged("rigid body " + std::to_string(body.mesh_body) +
                           " turns too far in a step for its distances to be held: shorten the step to 1/10 of a turn.");
        if (size <= settled || (size <= 1e-12 && size >= last)) break;
        last = size;
        turn = turn * turn_by<Dim>(w);
    }
    const Matrix<Dim> held = target - back * turn * body.second_moment;
    const Matrix<Dim> impulse = lines * (0.5 / dt * (held + held.transpose())) * body.inverse;
    (dt > 0.0 ? body.rate_after : body.rate_before) = momenta * body.inverse - impulse;
    for (int i = 0; i < points_per_body; ++i) p[body.first_point + i] -= mass * (impulse * rest_arm(body, i));
    return turn;
}

template <int Dim>
void RigidBodies<Dim>::add_constraint_forces(std::span<const Vector<Dim>> q, std::span<Vector<Dim>> force) const {
    for (const std::int32_t constrained : constrained_) {
        const Body& body = bodies_[constrained];
        Vector<Dim> sum = Vector<Dim>::Zero();
        Matrix<Dim> moments = Matrix<Dim>::Zero();  // sum F X'^T
        for (int i = 0; i < points_per_body; ++i) {
            sum += force[body.first_point + i];
            moments += force[body.first_point + i] * rest_arm(body, i).transpose();
        }
        const Matrix<Dim> turn = nearest_rotation(map_of(body, of_points(body, q)));
        const Matrix<Dim> in_space = turn * body.second_moment * turn.transpose();
        const AxialVector<Dim> spin =
            0.5 * axial<Dim>(Matrix<Dim>(0.5 * (body.rate_before + body.rate_after) * turn.transpose()));
        AxialVector<Dim> torque = axial<Dim>(Matrix<Dim>(moments * turn.transpose()));
        if constexpr (Dim == 3) torque -= moment<3>(spin, Vector<3>(inertia_of<3>(in_space) * spin));
        const Matrix<Dim> turning = hat<Dim>(spin);
        const Matrix<Dim> acceleration = (hat<Dim>(spin_of<Dim>(in_space, torque)) + turning * turning) * turn;
        const double mass = body.mass / points_per_body;
        for (int i = 0; i < points_per_body; ++i)
            force[body.first_point + i] = mass * (sum / body.mass + acceleration * rest_arm(body, i));
    }
}

template <int Dim>
void RigidBodies<Dim>::save(StateWriter& state, const RankPart<Dim>& part) const {
    std::vector<double> values;
    for (const std::int32_t i : constrained_) {
        const Body& body = bodies_[i];
        for (const Matrix<Dim>* matrix : {&body.turn_0, &body.turn_1, &body.rate_before, &body.rate_after})
            values.insert(values.end(), matrix->data(), matrix->data() + matrix->size());
    }
    for (const double value : part.gather_rigid(values)) state.put(value);
}

template <int Dim>
void RigidBodies<Dim>::restore(StateReader& state) {
    for (Body& body : bodies_)
        for (Matrix<Dim>* matrix : {&body.turn_0, &body.turn_1, &body.rate_before, &body.rate_after})
            get_value(state, *matrix);
}

template <int Dim>
void RigidBodies<Dim>::take_over(const RigidBodies& before) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& from = before.bodies_[i];
        for (const auto of : {&Body::turn_0, &Body::turn_1, &Body::rate_before, &Body::rate_after})
            bodies_[i].*of = from.*of;
    }
}

template <int Dim>
void RigidBodies<Dim>::take_points(std::size_t index, const RigidBodies& before, std::span<const Vector<Dim>> old_q,
                                   std::span<Vector<Dim>> q) const {
    const Body &body = bodies_[index], &from = before.bodies_[index];
    const RigidPlace<Dim> place = before.place(index, old_q);
    for (std::size_t i = 0; i < body.rest.size(); ++i) {
        Vector<Dim>& of_point = q[static_cast<std::size_t>(body.first_point) + i];
        of_point = body.rest == from.rest ? of_points(from, old_q)[i]
                                          : Vector<Dim>(place(body.rest[i] - from.centre) - body.rest[i]);
    }
}

template <int Dim>
void RigidBodies<Dim>::take_momenta(std::size_t index, const RigidBodies& before, std::span<const Vector<Dim>> old_p,
                                    std::span<Vector<Dim>> p) const {
    const Body &body = bodies_[index], &from = before.bodies_[index];
    const RigidPlace<Dim> per_mass = before.velocity(index, old_p);  // momenta of the points, as an affine function
    for (std::size_t i = 0; i < body.rest.size(); ++i) {
        Vector<Dim>& of_point = p[static_cast<std::size_t>(body.first_point) + i];
        of_point = body.rest == from.rest ? of_points(from, old_p)[i] : Vector<Dim>(per_mass(body.rest[i] - from.centre));
    }
}

template class RigidBodies<2>;
template class RigidBodies<3>;

}  // namespace abut::solid
