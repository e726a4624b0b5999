#include "abut/solid/contact/obstacles.hpp"

#include <algorithm>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"

namespace abut::solid {
namespace {

constexpr double most_deformed = 1e-9;  // of a rotation

}  // namespace

template <int Dim>
Obstacles<Dim>::Obstacles(std::span<const contact::RigidObstacle<Dim>> obstacles)
    : obstacles_(obstacles), force_(obstacles.size(), Vector<Dim>::Zero()) {}

template <int Dim>
bool Obstacles<Dim>::move() const {
    return std::ranges::any_of(obstacles_, [](const auto& obstacle) { return obstacle.path || obstacle.placement; });
}

template <int Dim>
bool Obstacles<Dim>::turn() const {
    return std::ranges::any_of(obstacles_, [](const auto& obstacle) { return bool(obstacle.placement); });
}

template <int Dim>
contact::Placement<Dim> Obstacles<Dim>::placement(std::size_t obstacle, double time) const {
    const auto& path = obstacles_[obstacle].placement;
    if (!path) return {.offset = displacement(obstacle, time)};
    const contact::Placement<Dim> placement = path(time);
    const double off = (placement.turn.transpose() * placement.turn - Matrix<Dim>::Identity()).norm();
    if (!placement.offset.allFinite() || !(off <= most_deformed) || placement.turn.determinant() < 0.0)
        throw BadInput("obstacle " + std::to_string(obstacle) + ": its placement at t = " + number(time) +
                           " s is not finite, or its turn is no rotation: turn^T turn differs from 1 by " + number(off) +
                           ", " + number(most_deformed) + " is allowed. Correct RigidObstacle::placement.",
                       {.value = off, .allowed = most_deformed});
    return placement;
}

template <int Dim>
Vector<Dim> Obstacles<Dim>::displacement(std::size_t obstacle, double time) const {
    const auto& path = obstacles_[obstacle].path;
    if (!path) return Vector<Dim>::Zero();
    const Vector<Dim> displacement = path(time);
    if (!displacement.allFinite())
        throw BadInput("obstacle " + std::to_string(obstacle) + ": its displacement at t = " + number(time) +
                       " s is not finite. Correct RigidObstacle::path.");
    return displacement;
}

template <int Dim>
double Obstacles<Dim>::motion(double from, double to) const {
    double motion = 0.0;
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
        if (!obstacles_[i].placement) {
            motion = larger(motion, (displacement(i, to) - displacement(i, from)).norm());
            continue;
        }
        const contact::Placement<Dim> a = placement(i, from), b = placement(i, to);
        for (const auto& corners : obstacles_[i].faces)
            for (const Vector<Dim>& corner : corners) motion = larger(motion, (b(corner) - a(corner)).norm());
    }
    return motion;
}

template <int Dim>
void Obstacles<Dim>::append_to(contact::Surface<Dim>& surface, std::int32_t first_body) const {
    for (std::size_t i = 0; i < obstacles_.size(); ++i)
        append(surface, obstacles_[i], first_body + static_cast<std::int32_t>(i));
}

template <int Dim>
void Obstacles<Dim>::displace(double time, std::span<Vector<Dim>> faces) const {
    auto face = faces.begin();
    for (std::size_t i = 0; i < obstacles_.size(); ++i)
        face = std::fill_n(face, obstacles_[i].faces.size(), displacement(i, time));
}

template <int Dim>
void Obstacles<Dim>::clear_forces() {
    std::ranges::fill(force_, Vector<Dim>::Zero());
}

template <int Dim>
void Obstacles<Dim>::begin_parts(double dt) {
    step_ = dt;
    mean_force_.assign(force_.size(), Vector<Dim>::Zero());
}

template <int Dim>
void Obstacles<Dim>::add_part(double dt) {
    for (std::size_t i = 0; i < force_.size(); ++i) mean_force_[i] += (dt / step_) * force_[i];
}

template class Obstacles<2>;
template class Obstacles<3>;

}  // namespace abut::solid
