#include "abut/input/make_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/input/names.hpp"
#include "abut/input/values.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/solid/combinations/combinations.hpp"

namespace abut::input {
namespace {

/// As a history, or as a value where nothing varies.
template <int Dim, class Condition>
void set_value(Condition& condition, const FieldSettings& field) {
    if (varies(field))
        condition.history = [field](double time, const Vector<Dim>& x) { return value_at<Dim>(field, time, in_3d<Dim>(x)); };
    else
        condition.value = value_at<Dim>(field, 0.0, Vector<3>::Zero());
}

/// Bodies of the faces of a group, with the kinematics that they are run with.
template <int Dim>
class Movers {
public:
    Movers(const run::Scene<Dim>& scene, const Settings& settings)
        : scene_(scene), of_all_(run::kinematics_of_all(settings.options.kinematics)) {}

    /// The first fault of a body of the group that does not go with a feature, in the name of what asks for it.
    [[nodiscard]] bool allow(const std::string& group, solid::Feature feature, const std::string& where,
                             const std::string& name, std::vector<Fault>& faults) const {
        const mesh::Mesh<Dim>& mesh = scene_.mesh;
        for (const std::int32_t face : mesh.group(group).faces) {
            const auto body = static_cast<std::size_t>(mesh.cell_body[mesh.face_cells[face][0]]);
            const solid::Kinematics kinematics = of_all_.value_or(scene_.solid.kinematics[body]);
            const auto conflict = solid::first_conflict({solid::feature_of(kinematics), feature}, {feature});
            if (!conflict) continue;
            faults.push_back({where, name + ": " + solid::text_of(*conflict, "body '" + mesh.body_names[body] + "'")});
            return false;
        }
        return true;
    }

private:
    const run::Scene<Dim>& scene_;
    std::optional<solid::Kinematics> of_all_;
};

template <int Dim>
void add_supports(run::Scene<Dim>& scene, const Settings& settings, const Names<Dim>& names, std::vector<Fault>& faults) {
    const Movers<Dim> movers(scene, settings);
    for (const SupportSettings& support : settings.supports) {
        if (!names.has_group(support.group, support.where, "supports." + support.name + ".group")) continue;
        const bool is_clamp = support.constraint == solid::Constraint::full && !varies(support.value);
        if (!movers.allow(support.group, is_clamp ? solid::Feature::clamp : solid::Feature::guide, support.where,
                          "supports." + support.name, faults))
            continue;
        solid::DirichletCondition<Dim> condition;
        condition.group = support.group;
        condition.constraint = support.constraint;
        std::copy_n(support.components.begin(), Dim, condition.components.begin());
        set_value<Dim>(condition, support.value);
        scene.solid.boundary.dirichlet.push_back(std::move(condition));
    }
}

/// Faces of the boundary that lie on a plane, as near as bodies lie that touch, and look away from its normal. Throws
/// BadInput for one along the plane that nearly lies on it: it would be held by nothing, and whoever cut the body there
/// means it to be.
template <int Dim>
std::vector<std::int32_t> faces_on(const mesh::Mesh<Dim>& mesh, const Vector<Dim>& point, const Vector<Dim>& normal) {
    constexpr double apart = 1e-4;  // of the size of a face
    std::vector<std::int32_t> faces;
    for (const std::int32_t face : mesh.boundary_faces) {
        double size = 0.0, height = 0.0;
        for (const std::int32_t vertex : mesh.face_vertices[face]) {
            size = std::max(size, 2.0 * (mesh.vertices[vertex] - mesh.face_centroid[face]).norm());
            height = std::max(height, std::abs(normal.dot(mesh.vertices[vertex] - point)));
        }
        if (height > apart * size || normal.dot(mesh.face_normal[face]) >= 0.0) continue;
        if (height > mesh::touching_tolerance * size)
            throw BadInput(
                fmt::format("has a face of body '{}' {:.6g} m in front of it, neither on it (up to {:.2g} m) nor apart from "
                            "it (from {:.2g} m on): "
                            "nothing would hold it there. Move the plane onto the face, or the body away from the plane.",
                            mesh.body_names[static_cast<std::size_t>(mesh.cell_body[mesh.face_cells[face][0]])], height,
                            mesh::touching_tolerance * size, apart * size));
        faces.push_back(face);
    }
    return faces;
}

/// Throws BadInput for a body that reaches behind a plane of symmetry.
template <int Dim>
void require_in_front(const mesh::Mesh<Dim>& mesh, const Vector<Dim>& point, const Vector<Dim>& normal) {
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        double lowest = 0.0, size = 0.0;
        for (const std::int32_t vertex : mesh.cell_vertices[cell]) {
            lowest = std::min(lowest, normal.dot(mesh.vertices[vertex] - point));
            size = std::max(size, 2.0 * (mesh.vertices[vertex] - mesh.cell_centroid[cell]).norm());
        }
        if (lowest < -mesh::touching_tolerance * size)
            throw BadInput(fmt::format(
                "has a cell of body '{}' {:.6g} m behind it, 0 m is allowed: a half model has bodies in front of "
                "its plane alone. Take their half, or turn the normal.",
                mesh.body_names[static_cast<std::size_t>(mesh.cell_body[cell])], -lowest));
    }
}

/// Throws BadInput for a body that a plane of symmetry cuts and that does not move as its other half does.
template <int Dim>
void require_symmetric(const run::Scene<Dim>& scene, std::int32_t body, solid::Kinematics kinematics,
                       const Vector<Dim>& normal) {
    const auto b = static_cast<std::size_t>(body);
    const std::string name = "cuts body '" + scene.mesh.body_names[b] + "', ";
    constexpr double rounding = 1e-12;
    if (const auto conflict =
            solid::first_conflict({solid::feature_of(kinematics), solid::Feature::symmetry}, {solid::Feature::symmetry}))
        throw BadInput(solid::text_of(*conflict, "meets body '" + scene.mesh.body_names[b] + "', which"));
    const Vector<Dim> velocity = scene.velocity[b];
    if (std::abs(normal.dot(velocity)) > rounding * velocity.norm())
        throw BadInput(
            fmt::format("{}whose velocity has {:.6g} m/s along the normal, 0 m/s is needed: its halves would part.", name,
                        normal.dot(velocity)));
    if (scene.spin.empty()) return;
    AxialVector<Dim> across = scene.spin[b];
    if constexpr (Dim == 3) across -= normal.dot(across) * normal;
    if (across.norm() > rounding * scene.spin[b].norm())
        throw BadInput(name +
                       "whose spin is not about the normal: its halves would turn against each other. Leave spin out.");
}

/// Bodies that a plane cuts have rollers on their faces there.
template <int Dim>
void add_symmetry(run::Scene<Dim>& scene, const Settings& settings, const SymmetrySettings& symmetry, Answers& answers) {
    const Vector<Dim> normal = head<Dim>(symmetry.normal).normalized(), gravity = head<Dim>(settings.gravity);
    if (std::abs(normal.dot(gravity)) > 1e-12 * gravity.norm())
        throw BadInput(
            fmt::format("has a normal along which gravity is {:.6g} m/s^2, 0 m/s^2 is needed: the other half would fall "
                        "to the other side. Turn one of them, or take an obstacle.",
                        normal.dot(gravity)));
    std::vector<std::int32_t> faces;
    const bool has_faces = answers.of([&] {
        require_in_front<Dim>(scene.mesh, head<Dim>(symmetry.point), normal);
        faces = faces_on<Dim>(scene.mesh, head<Dim>(symmetry.point), normal);
        return !faces.empty();
    });
    if (!has_faces && !settings.contact)
        throw BadInput("has no face of a body on it, and contact is off: it does nothing. Move it to a face.");
    if (!has_faces) return;
    const auto of_all = run::kinematics_of_all(settings.options.kinematics);
    std::int32_t last = -1;
    for (const std::int32_t face : faces) {
        const std::int32_t body = scene.mesh.cell_body[scene.mesh.face_cells[face][0]];
        if (std::exchange(last, body) == body) continue;
        require_symmetric<Dim>(scene, body, of_all.value_or(scene.solid.kinematics[static_cast<std::size_t>(body)]), normal);
    }
    scene.mesh.groups.push_back({symmetry.path, faces});
    solid::DirichletCondition<Dim> roller;
    roller.group = symmetry.path;
    roller.constraint = solid::Constraint::normal;
    scene.solid.boundary.dirichlet.push_back(std::move(roller));
}

template <int Dim>
void add_symmetries(run::Scene<Dim>& scene, const Settings& settings, Answers& answers, std::vector<Fault>& faults) {
    for (const SymmetrySettings& symmetry : settings.symmetries) try {
            add_symmetry(scene, settings, symmetry, answers);
        } catch (const BadInput& error) {
            faults.push_back({symmetry.where, symmetry.path + " " + error.what()});
        }
}

/// Cuts a group into groups of faces with one normal each.
template <int Dim>
std::vector<std::vector<std::int32_t>> cut_by_normal(const mesh::Mesh<Dim>& mesh, const std::string& group) {
    std::vector<std::int32_t> faces = mesh.group(group).faces;
    const auto normal = [&](std::int32_t face) -> const Vector<Dim>& { return mesh.face_normal[face]; };
    std::ranges::stable_sort(
        faces, [&](std::int32_t a, std::int32_t b) { return std::ranges::lexicographical_compare(normal(a), normal(b)); });
    std::vector<std::vector<std::int32_t>> parts;
    for (const std::int32_t face : faces) {
        if (parts.empty() || normal(parts.back().front()) != normal(face)) parts.emplace_back();
        parts.back().push_back(face);
    }
    for (std::vector<std::int32_t>& part : parts) std::ranges::sort(part);
    return parts;
}

/// A condition for each normal, on a group of its own.
template <int Dim>
void add_pressure(run::Scene<Dim>& scene, const TractionSettings& traction, Answers& answers) {
    std::vector<std::vector<std::int32_t>> parts;
    const std::vector<Vector<Dim>> normals = answers.of([&] {
        std::vector<Vector<Dim>> of_parts;
        parts = cut_by_normal(scene.mesh, traction.group);
        for (const auto& part : parts) of_parts.push_back(scene.mesh.face_normal[part.front()]);
        return of_parts;
    });
    parts.resize(normals.size());
    const Formula& pressure = *traction.pressure;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        scene.mesh.groups.push_back({fmt::format("tractions.{}, part {}", traction.name, i + 1), std::move(parts[i])});
        solid::TractionCondition<Dim> condition{
            .group = scene.mesh.groups.back().name, .value = Vector<Dim>::Zero(), .history = {}};
        condition.follows = true;  // nothing else is a pressure on a body that turns; of others it makes no difference
        if (pressure.varies())
            condition.history = [pressure, normal = normals[i]](double time, const Vector<Dim>& x) {
                return Vector<Dim>(-pressure(time, in_3d<Dim>(x)) * normal);
            };
        else
            condition.value = -pressure.value() * normals[i];
        scene.solid.boundary.traction.push_back(std::move(condition));
    }
}

template <int Dim>
bool can_follow(const TractionSettings& traction, const Movers<Dim>& movers, std::vector<Fault>& faults) {
    const auto allow = [&](solid::Feature feature) {
        return movers.allow(traction.group, feature, traction.where, "tractions." + traction.name, faults);
    };
    if (traction.follows.value_or(false) && traction.value && !allow(solid::Feature::following_traction)) return false;
    return traction.follows.value_or(true) || !traction.pressure || allow(solid::Feature::dead_pressure);
}

template <int Dim>
void add_tractions(run::Scene<Dim>& scene, const Settings& settings, const Names<Dim>& names, Answers& answers,
                   std::vector<Fault>& faults) {
    const Movers<Dim> movers(scene, settings);
    for (const TractionSettings& traction : settings.tractions) {
        if (!names.has_group(traction.group, traction.where, "tractions." + traction.name + ".group")) continue;
        if (!can_follow(traction, movers, faults)) continue;
        if (traction.pressure) add_pressure(scene, traction, answers);
        if (!traction.value) continue;
        solid::TractionCondition<Dim> condition;
        condition.group = traction.group;
        condition.follows = traction.follows.value_or(false);
        set_value<Dim>(condition, *traction.value);
        scene.solid.boundary.traction.push_back(std::move(condition));
    }
}

template <int Dim>
std::optional<solid::Anchor<Dim>> anchor_of(const AnchorSettings& end, const std::string& path, const Names<Dim>& names) {
    solid::Anchor<Dim> anchor{.body = solid::ground, .position = head<Dim>(end.point), .radius = end.radius};
    if (end.body.empty()) return anchor;
    const auto body = names.body(end.body, end.where, path + ".body");
    if (!body) return std::nullopt;
    anchor.body = *body;
    return anchor;
}

template <int Dim>
void add_springs(run::Scene<Dim>& scene, const Settings& settings, const Names<Dim>& names) {
    for (const SpringSettings& spring : settings.springs) {
        const auto from = anchor_of<Dim>(spring.from, "springs." + spring.name + ".from", names);
        const auto to = anchor_of<Dim>(spring.to, "springs." + spring.name + ".to", names);
        if (!from || !to) continue;
        const double length = std::isnan(spring.length) ? (to->position - from->position).norm() : spring.length;
        scene.solid.springs.push_back(
            {.first = *from, .second = *to, .stiffness = spring.stiffness, .length = length, .damping = spring.damping});
    }
}

template <int Dim>
void add_moments(run::Scene<Dim>& scene, const Settings& settings, const Names<Dim>& names) {
    for (const MomentSettings& moment : settings.moments)
        if (const auto body = names.body(moment.body, moment.where, "moments." + moment.name + ".body")) {
            FieldSettings value{};
            if (moment.value) value = *moment.value;
            const auto at = [value](double time) { return axial<Dim>(value_at<3>(value, time, Vector<3>::Zero())); };
            solid::BodyMoment<Dim>& made = scene.solid.moments.emplace_back();
            made = {.body = *body, .moment = at(0.0), .damping = moment.damping};
            if (varies(value)) made.history = at;
        }
}

}  // namespace

template <int Dim>
void add_loads(run::Scene<Dim>& scene, const Settings& settings, Answers& mesh, std::vector<Fault>& faults) {
    const Names<Dim> names(scene.mesh, settings.bodies, faults);
    add_symmetries(scene, settings, mesh, faults);
    add_supports(scene, settings, names, faults);
    add_tractions(scene, settings, names, mesh, faults);
    add_springs(scene, settings, names);
    add_moments(scene, settings, names);
}

template void add_loads<2>(run::Scene<2>&, const Settings&, Answers&, std::vector<Fault>&);
template void add_loads<3>(run::Scene<3>&, const Settings&, Answers&, std::vector<Fault>&);

}  // namespace abut::input
