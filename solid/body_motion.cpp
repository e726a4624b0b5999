#include "abut/solid/body_motion.hpp"

#include <numeric>
#include <string>

#include "abut/base/error.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/solid/group_motions.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

template <int Dim>
std::vector<BodyMotion<Dim>> body_motions(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid) {
    std::vector<std::int32_t> itself(static_cast<std::size_t>(solid.mesh().n_bodies()));
    std::iota(itself.begin(), itself.end(), 0);
    const std::vector<double> rotations = solid.rotations(run.q);
    std::vector<BodyMotion<Dim>> motions;
    const AllPoints<Dim> points(run, solid);
    if (solid.ranks().rank() > 0) return motions;
    for (const GroupMotion<Dim>& motion : group_motions<Dim>(points, itself, itself.size()))
        motions.push_back({motion.mass, motion.velocity, rotations[motions.size()], motion.spin});
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
