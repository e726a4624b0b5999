#include "abut/input/make_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/input/make_body.hpp"
#include "abut/input/make_loads.hpp"
#include "abut/input/make_obstacle.hpp"
#include "abut/input/names.hpp"
#include "abut/input/values.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/run/probes.hpp"

namespace abut::input {
namespace {

template <int Dim>
void append_body(run::Scene<Dim>& scene, const BodySettings& body, const Vector<3>& gravity) {
    scene.solid.materials.push_back(body.material);
    scene.solid.kinematics.push_back(body.kinematics);
    scene.velocity.push_back(head<Dim>(body.velocity));
    if (!gravity.isZero(0.0)) scene.solid.acceleration.push_back(head<Dim>(gravity));
}

bool spins(const BodySettings& body) { return !body.spin.isZero(0.0) || std::ranges::any_of(body.parts, spins); }

/// Appends what belongs to the bodies of one table, of which a file may hold several, some with tables of their own.
template <int Dim>
void append_bodies(run::Scene<Dim>& scene, const BodySettings& body, const std::vector<std::string>& names,
                   const Settings& settings, std::vector<Fault>& faults) {
    const bool any_spins = std::ranges::any_of(settings.bodies, spins);
    for (const std::string& name : names) {
        const BodySettings& own = settings_of(body, name);
        if (!own.has_material)
            faults.push_back({own.where, fmt::format("body '{}' has no material. Give young and density, or material, in "
                                                     "[bodies.{}].",
                                                     name, name)});
        append_body(scene, own, settings.gravity);
        if (any_spins) scene.spin.push_back(axial<Dim>(own.spin));
    }
}

template <int Dim>
void add_bodies(run::Scene<Dim>& scene, const Settings& settings, std::vector<Fault>& faults) {
    std::vector<mesh::Mesh<Dim>> meshes;
    for (const BodySettings& body : settings.bodies) {
        if (body.shape == Shape::none) continue;
        try {
            meshes.push_back(make_body<Dim>(body, settings.file.parent_path(), settings.meshes.get()));
        } catch (const Error& error) {
            faults.push_back({body.where, error.what()});
            continue;
        }
        append_bodies(scene, body, meshes.back().body_names, settings, faults);
    }
    if (!meshes.empty()) scene.mesh = mesh::combine<Dim>(meshes);
}

/// The table that a body of the mesh comes from.
const Named* table_of(const std::string& body, const std::vector<BodySettings>& tables) {
    const auto found = std::ranges::find_if(
        tables, [&](const BodySettings& table) { return body == table.name || body.starts_with(table.name + "."); });
    return found == tables.end() ? nullptr : &*found;
}

/// One fault for each pair of bodies, with the deepest pair of their cells.
template <int Dim>
void check_apart(const mesh::Mesh<Dim>& mesh, const Settings& settings, mesh::IgnoredPairs ignored,
                 std::vector<Fault>& faults) {
    std::set<std::array<std::int32_t, 2>> seen;
    for (const mesh::Interpenetration& pair :
         mesh::find_interpenetrations(mesh, settings.options.contact.search.broad_phase, ignored)) {
        if (!seen.insert(pair.bodies).second) continue;
        const std::string& first = mesh.body_names[static_cast<std::size_t>(pair.bodies[0])];
        const std::string& second = mesh.body_names[static_cast<std::size_t>(pair.bodies[1])];
        const Named* table = table_of(second, settings.bodies);
        faults.push_back(
            {table ? table->where : settings.file.string(),
             fmt::format("bodies '{}' and '{}' overlap at the start: two of their cells are {:.6g} m inside each "
                         "other, 0 m is allowed. Move one of them with place.",
                         first, second, pair.depth)});
    }
}

/// Pairs of bodies by their number, and obstacles behind them. Those that are not there because of a fault are left out.
template <int Dim>
void add_pairs(run::Scene<Dim>& scene, const Settings& settings, std::vector<Fault>& faults) {
    const Names<Dim> names(scene.mesh, settings.bodies, faults);
    const auto obstacle = [&](const std::string& name) -> std::optional<std::int32_t> {
        const auto found = std::ranges::find(settings.obstacles, name, &ObstacleSettings::name);
        if (found == settings.obstacles.end()) return std::nullopt;
        return scene.mesh.n_bodies() + static_cast<std::int32_t>(found - settings.obstacles.begin());
    };
    const auto numbers_of = [&](const std::array<std::string, 2>& of, const std::string& where,
                                const std::string& key) -> std::optional<std::array<std::int32_t, 2>> {
        std::array<std::optional<std::int32_t>, 2> numbers;
        for (std::size_t i = 0; i < 2; ++i) {
            numbers[i] = names.has_body(of[i]) ? std::nullopt : obstacle(of[i]);
            if (!numbers[i]) numbers[i] = names.body(of[i], where, key);
        }
        if (!numbers[0] || !numbers[1]) return std::nullopt;
        return std::array{*numbers[0], *numbers[1]};
    };
    for (const IgnoredPair& pair : settings.ignored_pairs)
        if (const auto numbers = numbers_of(pair.names, pair.where, "contact.ignored_pairs"))
            scene.solid.ignored_pairs.push_back(*numbers);
    for (const PairSettings& pair : settings.pairs) {
        const auto numbers = numbers_of(pair.names, pair.where, "contact.pairs.bodies");
        if (!numbers) continue;
        const auto is_same_pair = [&](const solid::BodyFriction& other) {
            return other.bodies == *numbers || other.bodies == std::array{(*numbers)[1], (*numbers)[0]};
        };
        if (std::ranges::any_of(scene.solid.body_friction, is_same_pair))
            faults.push_back({pair.where, fmt::format("contact.pairs: '{}' and '{}' have two laws of friction; give one.",
                                                      pair.names[0], pair.names[1])});
        scene.solid.body_friction.push_back({*numbers, pair.friction});
    }
}

template <int Dim>
void add_outputs(run::Scene<Dim>& scene, const Settings& settings, std::vector<Fault>& faults) {
    const Names<Dim> names(scene.mesh, settings.bodies, faults);
    for (const ProbeSettings& probe : settings.probes) {
        const std::string path = "output.probes." + probe.name;
        const auto body = names.body(probe.body, probe.where, path + ".body");
        if (!body) continue;
        run::Probe<Dim> made{.name = probe.name, .body = *body};
        if (probe.point) made.position = head<Dim>(*probe.point);
        try {
            if (made.position) static_cast<void>(run::cell_at<Dim>(scene.mesh, *body, *made.position));
        } catch (const BadInput& error) {
            faults.push_back({probe.where, fmt::format("{}.point: {}", path, error.what())});
        }
        scene.outputs.probes.push_back(std::move(made));
    }
    scene.outputs.forces = settings.forces;
    scene.outputs.interval = settings.sample_interval;
    scene.outputs.fields = settings.fields;
}

}  // namespace

template <int Dim>
run::Scene<Dim> make_scene(const Settings& settings, std::vector<Fault>& faults) {
    run::Scene<Dim> scene;
    add_bodies(scene, settings, faults);
    add_pairs(scene, settings, faults);
    add_loads(scene, settings, faults);
    add_obstacles(scene, settings, faults);
    add_outputs(scene, settings, faults);
    scene.contact = settings.contact;
    if (!scene.contact) {
        scene.solid.obstacles.clear();
        scene.solid.ignored_pairs.clear();
        scene.solid.body_friction.clear();
    }
    if (scene.contact) check_apart<Dim>(scene.mesh, settings, scene.solid.ignored_pairs, faults);
    if (settings.energy_scale > 0.0) scene.energy_scale = {"H0", settings.energy_scale};
    scene.title = settings.title;
    scene.comment = settings.comment;
    scene.time = settings.options.time;
    scene.options = {{"scene", settings.file.string()}, {"set", settings.set}};
    return scene;
}

template run::Scene<2> make_scene<2>(const Settings&, std::vector<Fault>&);
template run::Scene<3> make_scene<3>(const Settings&, std::vector<Fault>&);

}  // namespace abut::input
