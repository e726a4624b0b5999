#include "abut/run/scene.hpp"
#include "abut/run/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/dynamics/ranks.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/options/made_features.hpp"
#include "abut/solid/run_remedies.hpp"

namespace abut::run {
namespace {

template <int Dim>
Vector<Dim> cross(const AxialVector<Dim>& spin, const Vector<Dim>& arm) {
    if constexpr (Dim == 2)
        return {-spin[0] * arm.y(), spin[0] * arm.x()};
    else
        return {spin.y() * arm.z() - spin.z() * arm.y(), spin.z() * arm.x() - spin.x() * arm.z(),
                spin.x() * arm.y() - spin.y() * arm.x()};
}

/// Centroids of the bodies, (n_bodies, Dim) [m].
template <int Dim>
std::vector<double> centroids(const mesh::Mesh<Dim>& mesh) {
    std::vector<Vector<Dim>> sums(mesh.body_names.size(), Vector<Dim>::Zero());
    std::vector<double> measures(mesh.body_names.size(), 0.0);
    for (std::size_t cell = 0; cell < mesh.cell_measure.size(); ++cell) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[cell]);
        sums[body] += mesh.cell_measure[cell] * mesh.cell_centroid[cell];
        measures[body] += mesh.cell_measure[cell];
    }
    std::vector<double> middles;
    for (std::size_t body = 0; body < sums.size(); ++body) {
        const Vector<Dim> middle = sums[body] / measures[body];
        middles.insert(middles.end(), middle.begin(), middle.end());
    }
    return middles;
}

/// Velocities of the cells of `mesh`, the scene's or a part of it, beside that of their body [m/s]. `middles`: of bodies
/// that may spin.
template <int Dim>
std::vector<Vector<Dim>> added_velocities(const Scene<Dim>& scene, const mesh::Mesh<Dim>& mesh,
                                          std::span<const Vector<Dim>> middles) {
    std::vector<Vector<Dim>> added(mesh.cell_centroid.size(), Vector<Dim>::Zero());
    for (std::size_t cell = 0; cell < added.size(); ++cell) {
        const Vector<Dim>& x = mesh.cell_centroid[cell];
        const auto body = static_cast<std::size_t>(mesh.cell_body[cell]);
        if (!scene.spin.empty()) added[cell] += cross<Dim>(scene.spin[body], x - middles[body]);
        if (scene.added_velocity) added[cell] += scene.added_velocity(x);
    }
    return added;
}

/// True if a body or an obstacle may.
template <int Dim>
bool turns(const solid::SolidOptions<Dim>& solid) {
    return solid::any_body(solid.kinematics, &solid::KinematicsProperties::turns) ||
           std::ranges::any_of(solid.obstacles, [](const auto& obstacle) { return bool(obstacle.placement); });
}

}  // namespace

template <int Dim>
solid::SolidOptions<Dim> solid_options(const Scene<Dim>& scene, const RunOptions& options) {
    if (options.kinematics == BodyKinematics::automatic)
        throw BadInput(
            "--kinematics automatic: a pilot run decides. Whoever takes the steps of a scene asks choose_kinematics, puts "
            "what it picks into Scene::solid, and takes BodyKinematics::scene.");
    solid::SolidOptions<Dim> solid = scene.solid;
    solid.boundary.free_face_rule = options.free_faces;
    solid.boundary.corner_rule = options.corners;
    solid.finite.mean_force = options.mean_force;
    solid.precision = options.precision;
    solid.device = options.device;
    if (const auto kinematics = kinematics_of_all(options.kinematics))
        solid.kinematics.assign(scene.mesh.body_names.size(), *kinematics);
    // What a scene prefers yields to kinematics that are chosen for all of its bodies.
    if (options.law != solid::ContactLaw::automatic)
        solid.law = options.law;
    else if (kinematics_of_all(options.kinematics) && turns(solid))
        solid.law = solid::ContactLaw::automatic;
    constexpr geometry::FacingFade plain;
    if (options.facing.full != plain.full || options.facing.none != plain.none) solid.facing = options.facing;
    solid.gauss = solid.gauss || options.gauss;
    solid.contact = scene.contact ? std::optional(options.contact) : std::nullopt;
    solid.friction = options.friction;
    return solid;
}

template <int Dim>
bool has_friction(const Scene<Dim>& scene, const RunOptions& options) {
    solid::SolidOptions<Dim> solid;
    solid.friction = options.friction;
    solid.body_friction = scene.solid.body_friction;
    return scene.contact && solid.has_friction();
}

template <int Dim>
bool may_lose_cells(const Scene<Dim>& scene) {
    return solid::any_erosion(scene.solid.erosion) || scene.leaving;
}

template <int Dim>
solid::FeatureSet features_of(const Scene<Dim>& scene, const RunOptions& options, const solid::SolidOptions<Dim>& solid,
                              const dynamics::Ranks& ranks) {
    using solid::Feature;
    const auto spins = [](const AxialVector<Dim>& spin) { return !spin.isZero(0.0); };
    const bool any_rigid = !solid::all_bodies(solid.kinematics, &solid::KinematicsProperties::deforms);
    solid::FeatureSet features = features_of(options) | solid::features_of(ranks);
    features.add(Feature::step_watcher, bool(scene.after_step));
    features.add(Feature::erosion, bool(scene.leaving));
    features.add(Feature::displaced_start, bool(scene.displacement));
    features.add(Feature::spin_of_rigid, any_rigid && (scene.added_velocity || std::ranges::any_of(scene.spin, spins)));
    return features;
}

template <int Dim>
void check_features(const Scene<Dim>& scene, const RunOptions& options, const dynamics::Ranks& ranks) {
    using solid::Feature;
    const bool by_pilot = options.kinematics == BodyKinematics::automatic;
    RunOptions of_scene = options;
    if (by_pilot) of_scene.kinematics = BodyKinematics::scene;
    const solid::SolidOptions<Dim> solid = solid_options(scene, of_scene);
    solid::FeatureSet features = features_of(scene, options, solid, ranks), unknown;
    if (by_pilot) {
        features.remove({Feature::spin_of_rigid});
        unknown = {Feature::small, Feature::floating, Feature::finite, Feature::rigid, Feature::turn};
    }
    solid::require_together(scene.mesh, solid, features, unknown);
}

template <int Dim>
RunOptions with_restart(RunOptions options, const Scene<Dim>& scene) {
    if (options.restart != restart_not_given) return options;
    options.restart = 0;
    if (options.integrator != SolidIntegrator::memm) return options;
    std::vector<solid::Kinematics> kinematics;
    if (const auto of_all = kinematics_of_all(options.kinematics))
        kinematics = {*of_all};
    else if (options.kinematics == BodyKinematics::scene)
        kinematics = scene.solid.kinematics;
    const auto [filter, restart] = solid::default_remedies(kinematics, has_friction(scene, options));
    options.filter = options.filter || filter;
    options.restart = restart;
    return options;
}

template <int Dim>
solid::Kinematics kinematics_of(const Scene<Dim>& scene, const RunResult<Dim>& result, std::size_t body) {
    if (result.run.pilot) return result.run.pilot->bodies[body].picked;
    const auto own = solid::kinematics_of(scene.solid.kinematics, body);
    return kinematics_of_all(result.options.kinematics).value_or(own);
}

template <int Dim>
std::vector<double> displacement_at_start(const Scene<Dim>& scene, const solid::Solid<Dim>& solid) {
    if (!scene.displacement) return std::vector<double>(solid.size(), 0.0);
    std::vector<Vector<Dim>> of_cells;
    dynamics::agreed(solid.ranks(), [&] {
        for (const Vector<Dim>& x : solid.mesh().cell_centroid) of_cells.push_back(scene.displacement(x));
    });
    return solid.cells().to_q(of_cells);
}

template <int Dim>
std::vector<double> momentum_at_start(const Scene<Dim>& scene, const solid::Solid<Dim>& solid) {
    std::vector<double> momentum = solid::uniform_momentum<Dim>(solid, scene.velocity);
    if (!scene.added_velocity && scene.spin.empty()) return momentum;
    if (!scene.spin.empty() && scene.spin.size() != scene.mesh.body_names.size())
        throw BadInput(fmt::format("Scene::spin: {} are given, the scene has {} bodies. Give one for each, or none.",
                                   scene.spin.size(), scene.mesh.n_bodies()));
    solid::require_together(scene.mesh.name, "", features_of(scene, {}, solid.options(), solid.ranks()));
    std::vector<double> middles;  // rank 0 has the whole mesh
    if (!scene.spin.empty() && solid.ranks().rank() == 0) middles = centroids(scene.mesh);
    middles = solid.ranks().gather(middles);
    std::vector<Vector<Dim>> added_to_cells;
    dynamics::agreed(solid.ranks(), [&] {
        added_to_cells = added_velocities(scene, solid.mesh(), as_vectors<Dim>(std::span<const double>(middles)));
    });
    const std::vector<double> added = solid.cells().to_p(added_to_cells);
    for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] += added[i];
    return momentum;
}

#define ABUT_INSTANTIATE(Dim)                                                                                          \
    template solid::SolidOptions<Dim> solid_options<Dim>(const Scene<Dim>&, const RunOptions&);                        \
    template bool may_lose_cells<Dim>(const Scene<Dim>&);                                                              \
    template bool has_friction<Dim>(const Scene<Dim>&, const RunOptions&);                                             \
    template solid::FeatureSet features_of<Dim>(const Scene<Dim>&, const RunOptions&, const solid::SolidOptions<Dim>&, \
                                                const dynamics::Ranks&);                                               \
    template void check_features<Dim>(const Scene<Dim>&, const RunOptions&, const dynamics::Ranks&);                   \
    template RunOptions with_restart<Dim>(RunOptions, const Scene<Dim>&);                                              \
    template solid::Kinematics kinematics_of<Dim>(const Scene<Dim>&, const RunResult<Dim>&, std::size_t);              \
    template std::vector<double> displacement_at_start<Dim>(const Scene<Dim>&, const solid::Solid<Dim>&);              \
    template std::vector<double> momentum_at_start<Dim>(const Scene<Dim>&, const solid::Solid<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
