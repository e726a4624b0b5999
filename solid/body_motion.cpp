#include "abut/solid/body_motion.hpp"

#include <string>

#include "abut/base/error.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/solid/body/body_frame.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

/// From masses and momenta of the bodies; velocities are not divided yet.
template <int Dim>
std::vector<AxialVector<Dim>> spins_of(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid,
                                       const std::vector<BodyMotion<Dim>>& motions) {
    const auto q = as_vectors<Dim>(run.q);
    const auto at = [&](std::size_t i) -> Vector<Dim> { return solid.rest_positions()[i] + q[i]; };
    const std::size_t n = motions.size();
    std::vector<Vector<Dim>> centre(n, Vector<Dim>::Zero());
    std::vector<Matrix<Dim>> second_moment(n, Matrix<Dim>::Zero());
    std::vector<AxialVector<Dim>> angular(n, AxialVector<Dim>::Zero()), spins;
    const auto body_of = [&](std::size_t i) { return static_cast<std::size_t>(solid.body_of_points()[i]); };
    for (std::size_t i = 0; i < q.size(); ++i) centre[body_of(i)] += solid.masses()[i] / motions[body_of(i)].mass * at(i);
    for (std::size_t i = 0; i < q.size(); ++i) {
        const Vector<Dim> arm = at(i) - centre[body_of(i)];
        second_moment[body_of(i)] += solid.masses()[i] * arm * arm.transpose();
        angular[body_of(i)] += moment<Dim>(arm, run.momentum(static_cast<std::ptrdiff_t>(i)));
    }
    for (std::size_t body = 0; body < n; ++body) spins.push_back(spin_of<Dim>(second_moment[body], angular[body]));
    return spins;
}

}  // namespace

template <int Dim>
std::vector<BodyMotion<Dim>> body_motions(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid) {
    std::vector<BodyMotion<Dim>> motions(static_cast<std::size_t>(solid.mesh().n_bodies()),
                                         {0.0, Vector<Dim>::Zero(), 0.0, AxialVector<Dim>::Zero()});
    for (std::size_t i = 0; i < solid.masses().size(); ++i) {
        BodyMotion<Dim>& body = motions[solid.body_of_points()[i]];
        body.mass += solid.masses()[i];
        body.velocity += run.momentum(static_cast<std::ptrdiff_t>(i));
    }
    const std::vector<AxialVector<Dim>> spins = spins_of<Dim>(run, solid, motions);
    const std::vector<double> rotations = solid.rotations(run.q);
    for (std::size_t body = 0; body < motions.size(); ++body) {
        motions[body].velocity /= motions[body].mass;
        motions[body].rotation = rotations[body];
        motions[body].spin = spins[body];
    }
    return motions;
}

template <int Dim>
std::vector<double> uniform_momentum(const Solid<Dim>& solid, std::span<const Vector<Dim>> body_velocity) {
    const auto n_bodies = static_cast<std::size_t>(solid.mesh().n_bodies());
    if (body_velocity.size() != n_bodies)
        throw BadInput(std::to_string(body_velocity.size()) + " velocities are given for " + std::to_string(n_bodies) +
                           " bodies. Give one per body.",
                       {.value = static_cast<double>(body_velocity.size()), .allowed = static_cast<double>(n_bodies)});
    std::vector<double> momentum(solid.size());
    const auto p = as_vectors<Dim>(std::span<double>(momentum));
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = solid.masses()[i] * body_velocity[solid.body_of_points()[i]];
    return momentum;
}

#define ABUT_INSTANTIATE(Dim)                                                                                  \
    template std::vector<BodyMotion<Dim>> body_motions<Dim>(const dynamics::RunView<Dim>&, const Solid<Dim>&); \
    template std::vector<double> uniform_momentum<Dim>(const Solid<Dim>&, std::span<const Vector<Dim>>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
