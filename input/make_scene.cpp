#include "abut/input/make_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/geometry/box.hpp"
#include "abut/input/joined_parts.hpp"
#include "abut/input/make_body.hpp"
#include "abut/input/make_loads.hpp"
#include "abut/input/make_obstacle.hpp"
#include "abut/input/names.hpp"
#include "abut/input/values.hpp"
#include "abut/mesh/combine.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/mesh/mesh_bytes.hpp"
#include "abut/mesh/outline.hpp"
#include "abut/run/files/probes.hpp"
#include "abut/solid/body_interference.hpp"

namespace abut::input {
namespace {

template <int Dim>
void append_body(run::Scene<Dim>& scene, const BodySettings& body, const Vector<3>& gravity) {
    scene.solid.materials.push_back(body.material);
    scene.solid.kinematics.push_back(body.kinematics);
    scene.velocity.push_back(head<Dim>(body.velocity));
    if (!gravity.isZero(0.0)) scene.solid.acceleration.push_back(head<Dim>(gravity));
}

bool is_warm(const BodySettings& body) { return body.temperature_rise || std::ranges::any_of(body.parts, is_warm); }

template <int Dim>
solid::TemperatureRise<Dim> temperature_of(const BodySettings& body) {
    if (!body.temperature_rise) return {};
    return {
        .value = [rise = *body.temperature_rise](double time, const Vector<Dim>& x) { return rise(time, in_3d<Dim>(x)); },
        .varies = body.temperature_rise->varies()};
}

bool erodes(const BodySettings& body) { return body.erosion.any() || std::ranges::any_of(body.parts, erodes); }

/// Limits of what the material has.
void check_erosion(const BodySettings& body, const std::string& name, std::vector<Fault>& faults) {
    if (body.erosion.plastic_strain < solid::ErosionLimits::none && body.material.law != solid::MaterialLaw::j2)
        faults.push_back({body.where, fmt::format("body '{0}': erosion.plastic_strain limits the flow of metal, and its law "
                                                  "is not \"j2\". Give strain or stress, or law = \"j2\" in [bodies.{0}].",
                                                  name)});
}

bool spins(const BodySettings& body) { return !body.spin.isZero(0.0) || std::ranges::any_of(body.parts, spins); }

/// Appends what belongs to the bodies of one table, of which a file may hold several, some with tables of their own.
template <int Dim>
void append_bodies(run::Scene<Dim>& scene, const BodySettings& body, const std::vector<std::string>& names,
                   const Settings& settings, std::vector<Fault>& faults) {
    const bool any_spins = std::ranges::any_of(settings.bodies, spins),
               any_warm = std::ranges::any_of(settings.bodies, is_warm),
               any_erodes = std::ranges::any_of(settings.bodies, erodes);
    for (const std::string& name : names) {
        const BodySettings& own = settings_of(body, name);
        if (!own.has_material)
            faults.push_back({own.where, fmt::format("body '{}' has no material. Give young and density, or material, in "
                                                     "[bodies.{}].",
                                                     name, name)});
        if (settings.options.contact.search.self_contact && !own.self.value_or(settings.self)) {
            const auto number = static_cast<std::int32_t>(scene.solid.materials.size());
            scene.solid.ignored_pairs.push_back({number, number});
        }
        append_body(scene, own, settings.gravity);
        if (any_spins) scene.spin.push_back(axial<Dim>(own.spin));
        if (any_warm) scene.solid.temperature_rise.push_back(temperature_of<Dim>(own));
        if (any_erodes) scene.solid.erosion.push_back(own.erosion);
        check_erosion(own, name, faults);
    }
}

/// Message about a body that a pattern makes with others.
std::string of_pattern(const BodySettings& body, const std::string& message) {
    return fmt::format("{} ({} makes {:g} of it, which share the cells that may be made)", message, body.pattern,
                       body.n_copies);
}

template <int Dim>
void add_bodies(run::Scene<Dim>& scene, const Settings& settings, Answers& answers, std::vector<Fault>& faults) {
    std::vector<mesh::Mesh<Dim>> meshes;
    std::set<std::string> failed;  // patterns: the first of their copies says what is wrong with all
    for (const BodySettings& body : settings.bodies) {
        if (body.shape == Shape::none || failed.contains(body.pattern)) continue;
        std::vector<std::string> names;
        try {
            names = answers.of([&] {
                meshes.push_back(make_body<Dim>(body, settings.file.parent_path(), settings.meshes.get()));
                return meshes.back().body_names;
            });
        } catch (const Error& error) {
            faults.push_back({body.where, body.pattern.empty() ? error.what() : of_pattern(body, error.what())});
            if (!body.pattern.empty()) failed.insert(body.pattern);
            continue;
        }
        append_bodies(scene, body, names, settings, faults);
    }
    const std::vector<std::byte> outline = answers.of([&] {
        if (!meshes.empty()) scene.mesh = mesh::combine<Dim>(std::move(meshes));
        return mesh::bytes_of(mesh::outline_of(scene.mesh));
    });
    if (answers.are_given()) scene.mesh = mesh::mesh_in<Dim>(outline);
}

/// Words behind the depth of two bodies where the search for cells that overlap ended early.
std::string more_cells(std::span<const mesh::Interpenetration> found, const std::array<std::int32_t, 2>& bodies) {
    const std::int64_t n = std::ranges::count(found, bodies, &mesh::Interpenetration::bodies);
    if (n >= mesh::enough_interpenetrations.of_two_bodies)
        return fmt::format(" ({} looked at, more may overlap, and deeper)",
                           counted(n, "pair of cells was", "pairs of cells were"));
    return std::ssize(found) >= mesh::enough_interpenetrations.in_all
               ? fmt::format(" (the search ended at {} pairs of cells: more bodies may overlap)", found.size())
               : "";
}

/// One fault for each pair of bodies, with the deepest pair of their cells that were looked at.
template <int Dim>
void check_apart(const mesh::Mesh<Dim>& mesh, const Settings& settings, mesh::IgnoredPairs ignored,
                 std::vector<Fault>& faults) {
    std::set<std::array<std::int32_t, 2>> seen;
    std::map<std::string, std::int64_t> more;  // pairs of a pattern behind the first one
    const auto found = mesh::find_interpenetrations(mesh, settings.options.contact.search.broad_phase, ignored,
                                                    mesh::enough_interpenetrations);
    for (const mesh::Interpenetration& pair : found) {
        if (!seen.insert(pair.bodies).second) continue;
        const std::string& first = mesh.body_names[static_cast<std::size_t>(pair.bodies[0])];
        const std::string& second = mesh.body_names[static_cast<std::size_t>(pair.bodies[1])];
        const BodySettings* table = table_of(second, settings.bodies);
        const bool is_copy = table && !table->pattern.empty();
        if (is_copy && more.try_emplace(table->pattern, -1).first->second++ >= 0) continue;
        faults.push_back(
            {is_copy ? table->pattern_where
             : table ? table->where
                     : settings.file.string(),
             fmt::format("bodies '{}' and '{}' overlap at the start: two of their cells are {:.6g} m inside each "
                         "other, 0 m is allowed{}. Move one of them with {}.",
                         first, second, pair.depth, more_cells(found, pair.bodies), is_copy ? table->pattern : "place")});
    }
    for (const auto& [pattern, n] : more)
        if (n > 0)
            for (Fault& fault : faults)
                if (fault.text.ends_with("Move one of them with " + pattern + "."))
                    fault.text += " " + counted(n, "more pair of its bodies overlaps.", "more pairs of its bodies overlap.");
}

/// Names of the sides of pairs in a scene, by their number: bodies, obstacles behind them, and then groups of boundary
/// faces. Nothing, and a fault, for a name that is none.
template <int Dim>
class PairSides {
public:
    using Numbers = std::array<std::int32_t, 2>;

    PairSides(const run::Scene<Dim>& scene, const Settings& settings, std::vector<Fault>& faults)
        : mesh_(scene.mesh), settings_(settings), names_(scene.mesh, settings.bodies, faults) {}

    [[nodiscard]] std::optional<std::int32_t> body_or_obstacle(const std::string& name, const std::string& where,
                                                               const std::string& key) const {
        const auto found = std::ranges::find(settings_.obstacles, name, &ObstacleSettings::name);
        if (names_.has_body(name) || found == settings_.obstacles.end()) return names_.body(name, where, key);
        return mesh_.n_bodies() + static_cast<std::int32_t>(found - settings_.obstacles.begin());
    }
    [[nodiscard]] std::optional<std::int32_t> group(const std::string& name, const std::string& where,
                                                    const std::string& key) const {
        if (!names_.has_group(name, where, key)) return std::nullopt;
        const auto found = std::ranges::find(mesh_.groups, name, &mesh::BoundaryGroup::name);
        return n_bodies_and_obstacles() + static_cast<std::int32_t>(found - mesh_.groups.begin());
    }
    /// Whether faces of both may be listed as a pair.
    [[nodiscard]] bool may_touch(const Numbers& sides, const std::vector<Numbers>& ignored) const {
        for (const std::int32_t a : bodies_of(sides[0]))
            for (const std::int32_t b : bodies_of(sides[1])) {
                const bool are_obstacles = std::min(a, b) >= mesh_.n_bodies();
                const bool are_one = a == b && !settings_.options.contact.search.self_contact;
                const bool are_ignored = std::ranges::any_of(ignored, [&](const Numbers& pair) {
                    return pair == Numbers{a, b} || pair == Numbers{b, a};
                });
                if (!are_obstacles && !are_one && !are_ignored) return true;
            }
        return false;
    }

private:
    [[nodiscard]] std::int32_t n_bodies_and_obstacles() const {
        return mesh_.n_bodies() + static_cast<std::int32_t>(settings_.obstacles.size());
    }
    [[nodiscard]] std::set<std::int32_t> bodies_of(std::int32_t side) const {
        if (side < n_bodies_and_obstacles()) return {side};
        std::set<std::int32_t> bodies;
        for (const std::int32_t face : mesh_.groups[static_cast<std::size_t>(side - n_bodies_and_obstacles())].faces)
            bodies.insert(mesh_.cell_body[mesh_.face_cells[face][0]]);
        return bodies;
    }

    const mesh::Mesh<Dim>& mesh_;
    const Settings& settings_;
    Names<Dim> names_;
};

void check_interference(const PairSettings& pair, std::vector<Fault>& faults) {
    const bool resolves = pair.interference == Interference::resolve;
    if (resolves && pair.interference_time == 0.0)
        faults.push_back(
            {pair.where,
             "contact.pairs: interference = \"resolve\" needs interference_time, over which contact comes to act. "
             "Some ten times that in which a wave crosses the bodies keeps them from swinging."});
}

/// Pairs of bodies and obstacles that may overlap at the start.
template <int Dim>
std::vector<std::array<std::int32_t, 2>> may_overlap(const run::Scene<Dim>& scene, const Settings& settings) {
    auto pairs = solid::overlapping_bodies<Dim>(scene.mesh, scene.solid.interference, settings.obstacles.size());
    pairs.insert(pairs.end(), scene.solid.ignored_pairs.begin(), scene.solid.ignored_pairs.end());
    return pairs;
}

/// Pairs by their numbers (PairSides). Those that are not there because of a fault are left out.
template <int Dim>
void add_pairs(run::Scene<Dim>& scene, const Settings& settings, const Answers& answers, std::vector<Fault>& faults) {
    using Numbers = typename PairSides<Dim>::Numbers;
    const PairSides<Dim> sides(scene, settings, faults);
    for (const IgnoredPair& pair : settings.ignored_pairs) {
        const auto first = sides.body_or_obstacle(pair.names[0], pair.where, "contact.ignored_pairs");
        const auto second = sides.body_or_obstacle(pair.names[1], pair.where, "contact.ignored_pairs");
        if (first && second) scene.solid.ignored_pairs.push_back({*first, *second});
    }
    for (const PairSettings& pair : settings.pairs) {
        check_interference(pair, faults);
        std::vector<std::int32_t> numbers;
        std::vector<std::string> names = pair.bodies;
        names.insert(names.end(), pair.groups.begin(), pair.groups.end());
        for (const std::string& name : pair.bodies)
            if (const auto number = sides.body_or_obstacle(name, pair.where, "contact.pairs.bodies"))
                numbers.push_back(*number);
        for (const std::string& name : pair.groups)
            if (const auto number = sides.group(name, pair.where, "contact.pairs.groups")) numbers.push_back(*number);
        if (numbers.size() != 2) continue;
        const Numbers both{numbers[0], numbers[1]};
        const auto is_same_pair = [&](const solid::BodyFriction& other) {
            return other.bodies == both || other.bodies == Numbers{both[1], both[0]};
        };
        const bool resolves = pair.interference == Interference::resolve;
        const auto has_one = [&](const auto& other) {
            return other.bodies == both || other.bodies == Numbers{both[1], both[0]};
        };
        if (resolves && std::ranges::any_of(scene.solid.interference, has_one))
            faults.push_back({pair.where, fmt::format("contact.pairs: '{}' and '{}' have two interferences; give one.",
                                                      names[0], names[1])});
        else if (resolves)
            scene.solid.interference.push_back({both, pair.interference_time});
        const bool has_friction = pair.has_friction || !resolves;
        if (has_friction && std::ranges::any_of(scene.solid.body_friction, is_same_pair))
            faults.push_back({pair.where, fmt::format("contact.pairs: '{}' and '{}' have two laws of friction; give one.",
                                                      names[0], names[1])});
        else
            answers.check([&] {
                if (sides.may_touch(both, scene.solid.ignored_pairs)) return;
                faults.push_back(
                    {pair.where, fmt::format("contact.pairs: '{}' and '{}' have {} and never touch: they "
                                             "are of bodies in ignored_pairs, of one body without self = true, or "
                                             "obstacles. Leave {} out, or let them touch.",
                                             names[0], names[1], has_friction ? "a law of friction" : "an interference",
                                             has_friction ? "the law" : "it")});
            });
        if (has_friction) scene.solid.body_friction.push_back({both, pair.friction});
    }
}

/// What touches its other half slides along with it.
template <int Dim>
void take_friction_from_mirrors(run::Scene<Dim>& scene, const Settings& settings) {
    if (!settings.options.friction.acts()) return;
    for (std::size_t i = 0; i < settings.obstacles.size(); ++i)
        for (std::int32_t body = 0; settings.obstacles[i].is_symmetry && body < scene.mesh.n_bodies(); ++body)
            scene.solid.body_friction.push_back({{body, scene.mesh.n_bodies() + static_cast<std::int32_t>(i)}, {}});
}

/// Boxes around the sides of bonds between copies, of which a pattern names more pairs than lie beside each other.
template <int Dim>
class BoxesOfSides {
public:
    BoxesOfSides(const mesh::Mesh<Dim>& mesh, std::size_t n_obstacles)
        : mesh_(mesh), n_bodies_and_obstacles_(mesh.n_bodies() + static_cast<std::int32_t>(n_obstacles)) {}

    /// Whether the boxes touch with more than an edge: along at most one axis they are apart, or in each other, by no more
    /// than a tenth of the smallest face, and along all others they overlap by more.
    [[nodiscard]] bool are_side_by_side(std::int32_t first, std::int32_t second) {
        const Side &a = of(first), &b = of(second);
        const double near = largest_gap * std::min(a.face_size, b.face_size);
        int n_apart = 0;
        for (int d = 0; d < Dim; ++d) {
            const double common = std::min(a.box.upper[d], b.box.upper[d]) - std::max(a.box.lower[d], b.box.lower[d]);
            if (common < -near) return false;
            if (common <= near) ++n_apart;
        }
        return n_apart <= 1;
    }

private:
    static constexpr double largest_gap = 0.1;  // of bonded faces, of the size of the smaller one
    struct Side {
        geometry::Box<Dim> box{};
        double face_size = std::numeric_limits<double>::infinity();
    };
    const Side& of(std::int32_t number) {
        const auto [entry, is_new] = sides_.try_emplace(number);
        Side& side = entry->second;
        for (const std::int32_t face : is_new ? faces_of(number) : std::vector<std::int32_t>()) {
            for (const std::int32_t vertex : mesh_.face_vertices[face]) side.box.extend(mesh_.vertices[vertex]);
            side.face_size = std::min(side.face_size, std::pow(mesh_.face_measure[face], 1.0 / (Dim - 1)));
        }
        return side;
    }
    [[nodiscard]] std::vector<std::int32_t> faces_of(std::int32_t number) const {
        if (number >= mesh_.n_bodies())
            return mesh_.groups[static_cast<std::size_t>(number - n_bodies_and_obstacles_)].faces;
        std::vector<std::int32_t> faces;
        for (const std::int32_t face : mesh_.boundary_faces)
            if (mesh_.cell_body[mesh_.face_cells[face][0]] == number) faces.push_back(face);
        return faces;
    }

    const mesh::Mesh<Dim>& mesh_;
    std::int32_t n_bodies_and_obstacles_;
    std::map<std::int32_t, Side> sides_;
};

/// Sides by their numbers, as pairs have them.
template <int Dim>
void add_bonds(run::Scene<Dim>& scene, const Settings& settings, Answers& answers, std::vector<Fault>& faults) {
    const Names<Dim> names(scene.mesh, settings.bodies, faults);
    const PairSides<Dim> sides(scene, settings, faults);
    BoxesOfSides<Dim> boxes(scene.mesh, settings.obstacles.size());
    std::map<std::string, bool> holds;  // per table whose sides have copies
    for (const BondSettings& bond : settings.bonds) {
        std::vector<std::int32_t> numbers;
        for (const std::string& name : bond.bodies)
            if (const auto number = names.body(name, bond.where, "bonds.bodies")) numbers.push_back(*number);
        for (const std::string& name : bond.groups)
            if (const auto number = sides.group(name, bond.where, "bonds.groups")) numbers.push_back(*number);
        if (numbers.size() != 2) continue;
        if (bond.is_of_copies) {
            bool& one_holds = holds[bond.where];
            if (!answers.of([&] { return boxes.are_side_by_side(numbers[0], numbers[1]); })) continue;
            one_holds = true;
        }
        scene.solid.bonds.push_back(
            {.sides = {numbers[0], numbers[1]}, .strength = bond.strength, .fracture_energy = bond.fracture_energy});
    }
    for (const auto& [where, one_holds] : holds)
        if (!one_holds)
            faults.push_back({where,
                              "bonds: no two of the copies lie side by side, with a gap of at most a tenth of their "
                              "faces. Move them together with the pattern, or leave the bond out."});
}

template <int Dim>
void add_outputs(run::Scene<Dim>& scene, const Settings& settings, const Answers& answers, std::vector<Fault>& faults) {
    const Names<Dim> names(scene.mesh, settings.bodies, faults);
    for (const ProbeSettings& probe : settings.probes) {
        const std::string path = "output.probes." + probe.name;
        const auto body = names.body(probe.body, probe.where, path + ".body");
        if (!body) continue;
        run::Probe<Dim> made{.name = probe.name, .body = *body, .contact = probe.contact};
        if (probe.point) made.position = head<Dim>(*probe.point);
        if (made.position && probe.in_body)
            made.position = placed<Dim>(*table_of(probe.body, settings.bodies), *made.position);
        if (probe.point && probe.contact)
            faults.push_back(
                {probe.where, path + ".contact is of a body as a whole, and 'point' is given, too. Leave one of them out."});
        try {
            answers.check([&] {
                if (made.position) static_cast<void>(run::cell_at<Dim>(scene.mesh, *body, *made.position));
            });
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
run::Scene<Dim> make_scene(const Settings& settings, Answers& mesh, std::vector<Fault>& faults) {
    run::Scene<Dim> scene;
    add_bodies(scene, settings, mesh, faults);
    add_pairs(scene, settings, mesh, faults);
    take_friction_from_mirrors(scene, settings);
    add_bonds(scene, settings, mesh, faults);
    join_parts(scene, settings, mesh, faults);
    add_loads(scene, settings, mesh, faults);
    add_obstacles<Dim>(scene, settings, mesh, may_overlap(scene, settings), faults);
    add_outputs(scene, settings, mesh, faults);
    scene.contact = settings.contact;
    if (!scene.contact) {
        for (solid::Bond& bond : scene.solid.bonds)  // groups are counted behind obstacles
            for (std::int32_t& side : bond.sides)
                if (side >= scene.mesh.n_bodies()) side -= static_cast<std::int32_t>(scene.solid.obstacles.size());
        scene.solid.obstacles.clear();
        scene.solid.ignored_pairs.clear();
        scene.solid.body_friction.clear();
        scene.solid.interference.clear();
    }
    mesh.check([&] {
        if (scene.contact) check_apart<Dim>(scene.mesh, settings, may_overlap(scene, settings), faults);
    });
    if (settings.energy_scale > 0.0) scene.energy_scale = {"H0", settings.energy_scale};
    scene.title = settings.title;
    scene.comment = settings.comment;
    scene.time = settings.options.time;
    scene.options = {{"scene", settings.file.string()}, {"set", settings.set}};
    return scene;
}

template run::Scene<2> make_scene<2>(const Settings&, Answers&, std::vector<Fault>&);
template run::Scene<3> make_scene<3>(const Settings&, Answers&, std::vector<Fault>&);

}  // namespace abut::input
