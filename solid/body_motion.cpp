#include "abut/solid/body_motion.hpp"

#include <string>

#include "abut/base/error.hpp"

namespace abut::solid {

template <int Dim>
std::vector<BodyMotion<Dim>> body_motions(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid) {
    std::vector<BodyMotion<Dim>> motions(static_cast<std::size_t>(solid.mesh().n_bodies()), {0.0, Vector<Dim>::Zero(), 0.0});
    for (std::size_t i = 0; i < solid.masses().size(); ++i) {
        BodyMotion<Dim>& body = motions[solid.body_of_points()[i]];
        body.mass += solid.masses()[i];
        body.velocity += run.momentum(static_cast<std::ptrdiff_t>(i));
    }
    const std::vector<double> rotations = solid.rotations(run.q);
    for (std::size_t body = 0; body < motions.size(); ++body) {
        motions[body].velocity /= motions[body].mass;
        motions[body].rotation = rotations[body];
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
