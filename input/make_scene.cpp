#include "abut/input/make_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/contact/obstacle.hpp"
#include "abut/input/make_body.hpp"
#include "abut/input/nearest_word.hpp"
#include "abut/mesh/interpenetration.hpp"

namespace abut::input {
namespace {

template <int Dim>
AxialVector<Dim> axial(const Vector<3>& vector) {
    if constexpr (Dim == 2)
        return AxialVector<2>(vector.z());
    else
        return vector;
}

template <int Dim>
Vector<3> in_space(const Vector<Dim>& position) {
    Vector<3> result = Vector<3>::Zero();
    result.head<Dim>() = position;
    return result;
}

bool varies(const FieldSettings& field) {
    return std::ranges::any_of(field, [](const Formula& component) { return component.varies(); });
}

template <int Dim>
Vector<Dim> value_at(const FieldSettings& field, double time, const Vector<3>& position) {
    Vector<Dim> value;
    for (int i = 0; i < Dim; ++i) value[i] = field[static_cast<std::size_t>(i)](time, position);
    return value;
}

/// Empty where nothing varies.
template <int Dim>
solid::Field<Dim> history_of(const FieldSettings& field) {
    if (!varies(field)) return {};
    return [field](double time, const Vector<Dim>& x) { return value_at<Dim>(field, time, in_space<Dim>(x)); };
}

/// Appends what belongs to the bodies of one table, of which a file may hold several.
template <int Dim>
void append_body(run::Scene<Dim>& scene, const BodySettings& body, std::int32_t n_bodies, const Vector<3>& gravity) {
    for (std::int32_t i = 0; i < n_bodies; ++i) {
        scene.solid.materials.push_back(body.material);
        scene.solid.kinematics.push_back(body.kinematics);
        scene.velocity.push_back(head<Dim>(body.velocity));
        if (!gravity.isZero(0.0)) scene.solid.acceleration.push_back(head<Dim>(gravity));
    }
}

/// Angular velocities of all bodies; none if nothing spins.
template <int Dim>
void append_spins(run::Scene<Dim>& scene, const BodySettings& body, std::int32_t n_bodies) {
    for (std::int32_t i = 0; i < n_bodies; ++i) scene.spin.push_back(axial<Dim>(body.spin));
}

template <int Dim>
void add_bodies(run::Scene<Dim>& scene, const Settings& settings, std::vector<Fault>& faults) {
    std::vector<mesh::Mesh<Dim>> meshes;
    const bool any_spins =
        std::ranges::any_of(settings.bodies, [](const BodySettings& body) { return !body.spin.isZero(0.0); });
    for (const BodySettings& body : settings.bodies) {
        if (body.shape == Shape::none) continue;
        try {
            meshes.push_back(make_body<Dim>(body, settings.file.parent_path()));
        } catch (const Error& error) {
            faults.push_back({body.where, error.what()});
            continue;
        }
        append_body(scene, body, meshes.back().n_bodies(), settings.gravity);
        if (any_spins) append_spins(scene, body, meshes.back().n_bodies());
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
void check_apart(const mesh::Mesh<Dim>& mesh, const Settings& settings, std::vector<Fault>& faults) {
    std::set<std::array<std::int32_t, 2>> seen;
    for (const mesh::Interpenetration& pair : mesh::find_interpenetrations(mesh)) {
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

/// Whether there is such a group; a fault if there is none. Those of bodies that have no mesh are not known.
template <int Dim>
bool has_group(const mesh::Mesh<Dim>& mesh, const std::string& group, const Named& table, const char* section,
               const std::vector<BodySettings>& bodies, std::vector<Fault>& faults) {
    std::vector<std::string> known;
    for (const auto& one : mesh.groups) known.push_back(one.name);
    if (std::ranges::find(known, group) != known.end()) return true;
    const bool of_broken_body = std::ranges::any_of(bodies, [&](const BodySettings& body) {
        return group.starts_with(body.name + ".") && std::ranges::find(mesh.body_names, body.name) == mesh.body_names.end();
    });
    if (!group.empty() && !of_broken_body)
        faults.push_back({table.where, fmt::format("{}.{}.group is '{}', which is no group of boundary faces.{}", section,
                                                   table.name, group, hint(group, known))});
    return false;
}

/// Its history, or its value where nothing varies.
template <int Dim, class Condition>
void set_value(Condition& condition, const FieldSettings& field) {
    condition.history = history_of<Dim>(field);
    if (!condition.history) condition.value = value_at<Dim>(field, 0.0, Vector<3>::Zero());
}

template <int Dim>
void add_conditions(run::Scene<Dim>& scene, const Settings& settings, std::vector<Fault>& faults) {
    for (const SupportSettings& support : settings.supports) {
        if (!has_group(scene.mesh, support.group, support, "supports", settings.bodies, faults)) continue;
        solid::DirichletCondition<Dim> condition;
        condition.group = support.group;
        condition.constraint = support.constraint;
        std::copy_n(support.components.begin(), Dim, condition.components.begin());
        set_value<Dim>(condition, support.value);
        scene.solid.boundary.dirichlet.push_back(std::move(condition));
    }
    for (const TractionSettings& traction : settings.tractions) {
        if (!has_group(scene.mesh, traction.group, traction, "tractions", settings.bodies, faults)) continue;
        solid::TractionCondition<Dim> condition;
        condition.group = traction.group;
        condition.follows = traction.follows;
        set_value<Dim>(condition, traction.value);
        scene.solid.boundary.traction.push_back(std::move(condition));
    }
}

/// A closed outline, counter-clockwise, as segments with the outside on the right of each.
std::vector<std::vector<Vector<2>>> faces_of_outline(std::vector<Vector<2>> corners, bool inside) {
    double area = 0.0;  // twice that of the outline, < 0 if it is clockwise
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector<2>& a = corners[i];
        const Vector<2>& b = corners[(i + 1) % corners.size()];
        area += a.x() * b.y() - a.y() * b.x();
    }
    if ((area < 0.0) != inside) std::ranges::reverse(corners);
    std::vector<std::vector<Vector<2>>> faces;
    for (std::size_t i = 0; i < corners.size(); ++i) faces.push_back({corners[i], corners[(i + 1) % corners.size()]});
    return faces;
}

std::vector<std::vector<Vector<2>>> faces_of_box(const Vector<2>& lower, const Vector<2>& upper, bool inside) {
    return faces_of_outline({lower, {upper.x(), lower.y()}, upper, {lower.x(), upper.y()}}, inside);
}

/// Two faces for each direction; corners counter-clockwise seen from outside.
std::vector<std::vector<Vector<3>>> faces_of_box(const Vector<3>& lower, const Vector<3>& upper, bool inside) {
    std::vector<std::vector<Vector<3>>> faces;
    for (int along = 0; along < 3; ++along)
        for (const bool high : {false, true}) {
            const int a = (along + 1) % 3, b = (along + 2) % 3;
            std::vector<Vector<3>> face(4, lower);
            for (Vector<3>& corner : face) corner[along] = high ? upper[along] : lower[along];
            face[1][a] = face[2][a] = upper[a];
            face[2][b] = face[3][b] = upper[b];
            if (high == inside) std::ranges::reverse(face);
            faces.push_back(std::move(face));
        }
    return faces;
}

template <int Dim>
std::function<Vector<Dim>(double)> path_of(const ObstacleSettings& obstacle) {
    if (obstacle.path) return [path = *obstacle.path](double time) { return value_at<Dim>(path, time, Vector<3>::Zero()); };
    if (obstacle.velocity.isZero(0.0)) return {};
    return [velocity = head<Dim>(obstacle.velocity)](double time) { return Vector<Dim>(velocity * time); };
}

template <int Dim>
contact::RigidObstacle<Dim> make_obstacle(const ObstacleSettings& obstacle) {
    if (obstacle.shape == ObstacleShape::plane)
        return contact::plane_obstacle<Dim>(head<Dim>(obstacle.point), head<Dim>(obstacle.normal), obstacle.half_width,
                                            path_of<Dim>(obstacle));
    if constexpr (Dim == 2)
        if (obstacle.shape == ObstacleShape::polygon) {
            std::vector<Vector<2>> corners;
            for (const Vector<3>& corner : obstacle.corners) corners.push_back(head<2>(corner));
            return {faces_of_outline(std::move(corners), obstacle.inside), path_of<2>(obstacle)};
        }
    return {faces_of_box(head<Dim>(obstacle.lower), head<Dim>(obstacle.upper), obstacle.inside), path_of<Dim>(obstacle)};
}

template <int Dim>
void add_obstacles(run::Scene<Dim>& scene, const Settings& settings, std::vector<Fault>& faults) {
    for (const ObstacleSettings& obstacle : settings.obstacles) {
        if (obstacle.shape == ObstacleShape::none) continue;
        if (obstacle.shape == ObstacleShape::box &&
            !(head<Dim>(obstacle.lower).array() < head<Dim>(obstacle.upper).array()).all()) {
            faults.push_back({obstacle.where,
                              fmt::format("obstacles.{}: lower has to be below upper in every component.", obstacle.name)});
            continue;
        }
        scene.solid.obstacles.push_back(make_obstacle<Dim>(obstacle));
    }
}

}  // namespace

template <int Dim>
run::Scene<Dim> make_scene(const Settings& settings, std::vector<Fault>& faults) {
    run::Scene<Dim> scene;
    add_bodies(scene, settings, faults);
    add_conditions(scene, settings, faults);
    add_obstacles(scene, settings, faults);
    scene.contact = settings.contact;
    if (!scene.contact) scene.solid.obstacles.clear();
    if (scene.contact) check_apart(scene.mesh, settings, faults);
    if (settings.energy_scale > 0.0) scene.energy_scale = {"H0", settings.energy_scale};
    scene.time = settings.options.time;
    scene.options = {{"scene", settings.file.string()}, {"set", settings.set}};
    return scene;
}

template run::Scene<2> make_scene<2>(const Settings&, std::vector<Fault>&);
template run::Scene<3> make_scene<3>(const Settings&, std::vector<Fault>&);

}  // namespace abut::input
