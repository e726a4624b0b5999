#include "abut/solid/options/made_features.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/dynamics/ranks.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::solid {
namespace {

template <class Values>
bool has_entry(const Values& values, std::size_t body) {
    return body < values.size() && values[body];
}

template <int Dim>
bool varies(const SolidOptions<Dim>& options) {
    const auto has_history = [](const auto& condition) { return bool(condition.history); };
    return std::ranges::any_of(options.boundary.dirichlet, has_history) ||
           std::ranges::any_of(options.boundary.traction, has_history) ||
           std::ranges::any_of(options.temperature_rise, [](const auto& rise) { return rise.value && rise.varies; });
}

/// Whether springs, moments or obstacles do work.
template <int Dim>
bool gives_work(const SolidOptions<Dim>& options) {
    const auto damps = [](const Spring<Dim>& spring) { return spring.damping > 0.0; };
    const auto moves = [](const contact::RigidObstacle<Dim>& obstacle) { return obstacle.path || obstacle.placement; };
    return std::ranges::any_of(options.springs, damps) || !options.moments.empty() ||
           (options.contact && std::ranges::any_of(options.obstacles, moves));
}

/// Bodies of the faces of a group: calls of_body(body) for each, of neighbours in the list once.
template <int Dim, class OfBody>
void for_bodies_of(const mesh::Mesh<Dim>& mesh, const std::string& group, const OfBody& of_body) {
    std::int32_t last = -1;
    for (const std::int32_t face : mesh.group(group).faces)
        if (const std::int32_t body = mesh.cell_body[mesh.face_cells[face][0]]; body != last) of_body(last = body);
}

template <int Dim>
FeatureSet features_of(const DirichletCondition<Dim>& condition, Kinematics) {
    FeatureSet features{Feature::clamp};
    features.add(Feature::guide, condition.constraint != Constraint::full || condition.history);
    return features;
}

template <int Dim>
FeatureSet features_of(const TractionCondition<Dim>& condition, Kinematics kinematics) {
    FeatureSet features;
    features.add(Feature::outside_work, properties_of(kinematics).turns);
    features.add(Feature::following_from_outside, condition.follows && condition.from_outside);
    return features;
}

/// The features that all bodies and their groups are asked together with.
template <int Dim>
class Asking {
public:
    Asking(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, FeatureSet more, FeatureSet unknown)
        : mesh_(mesh), options_(options), of_scene_(solid::features_of(options) | more), unknown_(unknown) {}

    void require_all() const {
        for (std::int32_t body = 0; body < mesh_.n_bodies(); ++body) require(body, "", {});
        for (std::size_t i = 0; i < options_.obstacles.size(); ++i)
            if (options_.obstacles[i].placement)
                solid::require_together(mesh_.name, "obstacle " + std::to_string(i), of_scene_ | FeatureSet{Feature::turn});
        require_of(options_.boundary.dirichlet);
        require_of(options_.boundary.traction);
    }

private:
    template <class Condition>
    void require_of(const std::vector<Condition>& conditions) const {
        for (const Condition& condition : conditions)
            for_bodies_of(mesh_, condition.group, [&](std::int32_t body) {
                const Kinematics kinematics = kinematics_of(options_.kinematics, static_cast<std::size_t>(body));
                require(body, condition.group, features_of(condition, kinematics));
            });
    }
    void require(std::int32_t body, const std::string& group, FeatureSet features) const {
        const auto b = static_cast<std::size_t>(body);
        FeatureSet of_body = solid::features_of(options_, b) | features;
        of_body.remove(unknown_);
        solid::require_together(mesh_.name,
                                "body '" + mesh_.body_names[b] + "'" + (group.empty() ? "" : " (group '" + group + "')"),
                                of_scene_ | of_body);
    }

    const mesh::Mesh<Dim>& mesh_;
    const SolidOptions<Dim>& options_;
    FeatureSet of_scene_, unknown_;
};

}  // namespace

template <int Dim>
FeatureSet features_of(const SolidOptions<Dim>& options) {
    FeatureSet features;
    const bool is_moved = options.contact && options.law == ContactLaw::reconstruction;
    const bool is_from_outside = std::ranges::any_of(options.boundary.traction, &TractionCondition<Dim>::from_outside);
    features.add(Feature::reconstruction, is_moved);
    features.add(Feature::pair_potential, options.contact && !is_moved);
    features.add(Feature::bonded, !options.bonds.empty());
    features.add(Feature::reconstructed_bond, !options.bonds.empty() && is_moved);
    features.add(Feature::breaking_bond,
                 std::ranges::any_of(options.bonds, [](const Bond& bond) { return std::isfinite(bond.strength); }));
    features.add(Feature::interference, !options.interference.empty());
    features.add(Feature::friction, options.contact && options.has_friction());
    features.add(Feature::varying_load, is_from_outside || varies(options));
    features.add(Feature::outside_work, gives_work(options));
    features.add(Feature::single_precision, options.precision == Precision::single_precision);
    features.add(Feature::device, options.device != StepDevice::host);
    features.add(Feature::erosion, any_erosion(options.erosion));
    return features;
}

template <int Dim>
FeatureSet features_of(const SolidOptions<Dim>& options, std::size_t body) {
    const FiniteOptions<Dim>& laws = options.finite;
    const Kinematics kinematics = body < options.kinematics.size() ? options.kinematics[body] : Kinematics{};
    const bool is_finite = properties_of(kinematics).finite_strains;
    const bool has_own_law = has_entry(laws.stored_energy, body) || has_entry(laws.inelastic, body);
    FeatureSet features = features_of(kinematics, body < options.materials.size() ? options.materials[body] : Material{});
    features.add(Feature::large_strains, has_own_law);
    features.add(Feature::flow, has_entry(laws.inelastic, body));
    features.add(Feature::law_in_plane, Dim == 2 && is_finite && has_own_law);
    features.add(Feature::discrete_gradient, is_finite && laws.mean_force == MeanForce::discrete_gradient);
    features.add(Feature::erosion_limit, body < options.erosion.size() && options.erosion[body].any());
    features.add(Feature::temperature, body < options.temperature_rise.size() && options.temperature_rise[body].value);
    return features;
}

FeatureSet features_of(const dynamics::Ranks& ranks) { return ranks.is_one() ? FeatureSet{} : FeatureSet{Feature::ranks}; }

template <int Dim>
void require_together(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, FeatureSet more, FeatureSet unknown) {
    Asking<Dim>(mesh, options, more, unknown).require_all();
}

#define ABUT_INSTANTIATE(Dim)                                                    \
    template FeatureSet features_of<Dim>(const SolidOptions<Dim>&);              \
    template FeatureSet features_of<Dim>(const SolidOptions<Dim>&, std::size_t); \
    template void require_together<Dim>(const mesh::Mesh<Dim>&, const SolidOptions<Dim>&, FeatureSet, FeatureSet);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
