#include "abut/run/scene.hpp"

#include <span>

#include "abut/base/error.hpp"

namespace abut::run {

template <int Dim>
solid::SolidOptions<Dim> solid_options(const Scene<Dim>& scene, const RunOptions& options) {
    if (options.kinematics == BodyKinematics::automatic)
        throw BadInput(
            "--kinematics automatic: a pilot run decides. Whoever takes the steps of a scene asks choose_kinematics, puts "
            "what it picks into Scene::solid, and takes BodyKinematics::scene.");
    solid::SolidOptions<Dim> solid = scene.solid;
    solid.boundary.free_face_rule = options.neumann;
    solid.boundary.corner_rule = options.corners;
    if (const auto kinematics = kinematics_of_all(options.kinematics))
        solid.kinematics.assign(scene.mesh.body_names.size(), *kinematics);
    if (options.law != solid::ContactLaw::automatic) solid.law = options.law;
    solid.contact = scene.contact ? std::optional(options.contact) : std::nullopt;
    return solid;
}

template <int Dim>
std::vector<double> displacement_at_start(const Scene<Dim>& scene, const solid::Solid<Dim>& solid) {
    if (!scene.displacement) return std::vector<double>(solid.size(), 0.0);
    std::vector<Vector<Dim>> of_cells;
    for (const Vector<Dim>& x : scene.mesh.cell_centroid) of_cells.push_back(scene.displacement(x));
    return solid.displacement_of_points(of_cells);
}

template <int Dim>
std::vector<double> momentum_at_start(const Scene<Dim>& scene, const solid::Solid<Dim>& solid) {
    std::vector<double> momentum = solid::uniform_momentum<Dim>(solid, scene.velocity);
    if (!scene.added_velocity) return momentum;
    if (scene.displacement && solid.has_constraints())
        throw BadInput(
            "Scene::added_velocity: a rigid body takes its spin from velocities of its cells at rest, and "
            "Scene::displacement moves it from there. Turn its mesh instead, and leave the displacement out.");
    std::vector<Vector<Dim>> of_cells;
    for (const Vector<Dim>& x : scene.mesh.cell_centroid) of_cells.push_back(scene.added_velocity(x));
    const std::vector<double> added = solid.momentum_of_points(of_cells);
    for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] += added[i];
    return momentum;
}

#define ABUT_INSTANTIATE(Dim)                                                                             \
    template solid::SolidOptions<Dim> solid_options<Dim>(const Scene<Dim>&, const RunOptions&);           \
    template std::vector<double> displacement_at_start<Dim>(const Scene<Dim>&, const solid::Solid<Dim>&); \
    template std::vector<double> momentum_at_start<Dim>(const Scene<Dim>&, const solid::Solid<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
