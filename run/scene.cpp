#include "abut/run/scene.hpp"

#include <span>

namespace abut::run {

template <int Dim>
solid::SolidOptions<Dim> solid_options(const Scene<Dim>& scene, const RunOptions& options) {
    solid::SolidOptions<Dim> solid = scene.solid;
    solid.boundary.free_face_rule = options.neumann;
    solid.boundary.corner_rule = options.corners;
    if (options.kinematics) solid.kinematics.assign(scene.mesh.body_names.size(), *options.kinematics);
    if (options.law != solid::ContactLaw::automatic) solid.law = options.law;
    solid.contact = scene.contact ? std::optional(options.contact) : std::nullopt;
    return solid;
}

template <int Dim>
std::vector<double> displacement_at_start(const Scene<Dim>& scene) {
    std::vector<double> q(Dim * scene.mesh.cell_centroid.size(), 0.0);
    if (!scene.displacement) return q;
    const auto u = as_vectors<Dim>(std::span<double>(q));
    for (std::size_t c = 0; c < u.size(); ++c) u[c] = scene.displacement(scene.mesh.cell_centroid[c]);
    return q;
}

template <int Dim>
std::vector<double> momentum_at_start(const Scene<Dim>& scene, const solid::Solid<Dim>& solid) {
    std::vector<double> momentum = solid::uniform_momentum<Dim>(solid, scene.velocity);
    if (!scene.added_velocity) return momentum;
    const auto p = as_vectors<Dim>(std::span<double>(momentum));
    for (std::size_t c = 0; c < p.size(); ++c) p[c] += solid.masses()[c] * scene.added_velocity(scene.mesh.cell_centroid[c]);
    return momentum;
}

#define ABUT_INSTANTIATE(Dim)                                                                   \
    template solid::SolidOptions<Dim> solid_options<Dim>(const Scene<Dim>&, const RunOptions&); \
    template std::vector<double> displacement_at_start<Dim>(const Scene<Dim>&);                 \
    template std::vector<double> momentum_at_start<Dim>(const Scene<Dim>&, const solid::Solid<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
