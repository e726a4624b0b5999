#include "abut/input/make_obstacle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/geometry/box.hpp"
#include "abut/geometry/health/surface_health.hpp"
#include "abut/geometry/points.hpp"
#include "abut/input/check_obstacle.hpp"
#include "abut/input/values.hpp"
#include "abut/mesh/io/read_surface.hpp"

namespace abut::input {
namespace {

/// How far planes without a half width reach, in sizes of what all bodies are in at the start. Within that nothing is
/// lost by the size of their one face: docs/limits.md.
constexpr double reach_of_planes = 2000.0;

template <int Dim>
using Faces = std::vector<std::vector<Vector<Dim>>>;

/// A closed outline, counter-clockwise, as segments with the outside on the right of each.
Faces<2> faces_of_outline(std::vector<Vector<2>> corners) {
    double area = 0.0;  // twice that of the outline, < 0 if it is clockwise
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector<2>& a = corners[i];
        const Vector<2>& b = corners[(i + 1) % corners.size()];
        area += a.x() * b.y() - a.y() * b.x();
    }
    if (area < 0.0) std::ranges::reverse(corners);
    Faces<2> faces;
    for (std::size_t i = 0; i < corners.size(); ++i) faces.push_back({corners[i], corners[(i + 1) % corners.size()]});
    return faces;
}

Faces<2> faces_of_box(const Vector<2>& lower, const Vector<2>& upper) {
    return faces_of_outline({lower, {upper.x(), lower.y()}, upper, {lower.x(), upper.y()}});
}

/// Two faces for each direction; corners counter-clockwise seen from outside.
Faces<3> faces_of_box(const Vector<3>& lower, const Vector<3>& upper) {
    Faces<3> faces;
    for (int along = 0; along < 3; ++along)
        for (const bool high : {false, true}) {
            const int a = (along + 1) % 3, b = (along + 2) % 3;
            std::vector<Vector<3>> face(4, lower);
            for (Vector<3>& corner : face) corner[along] = high ? upper[along] : lower[along];
            face[1][a] = face[2][a] = upper[a];
            face[2][b] = face[3][b] = upper[b];
            if (!high) std::ranges::reverse(face);
            faces.push_back(std::move(face));
        }
    return faces;
}

bool is_endless(const ObstacleSettings& obstacle) {
    return obstacle.shape == ObstacleShape::plane && std::isinf(obstacle.half_width);
}

template <int Dim>
void turn_inside_out(Faces<Dim>& faces) {
    for (auto& face : faces) std::ranges::reverse(face);
}

/// The faces of an obstacle about its own origin, facing outwards, and whether they close.
template <int Dim>
struct Shell {
    Faces<Dim> faces;
    bool closed = true;
};

/// Throws BadInput for a surface that looks to both sides: faces of one part that disagree, and parts that are turned
/// against the others and are no cavities of them.
void require_one_side(const mesh::SurfaceMesh& surface, const geometry::SurfaceReport& health, double volume) {
    if (!health.inconsistent_edges.empty())
        throw BadInput(fmt::format(
            "{}: {} faces that look to different sides of the surface, the first one beside face {}, so that bodies would "
            "meet some of them from behind. Turn these faces around.",
            surface.name, counted(std::ssize(health.inconsistent_edges), "edge has", "edges have"),
            surface.label(health.inconsistent_edges.front().face)));
    const std::vector<bool> cavities = mesh::cavities_of(surface, health);
    for (std::size_t part = 0; part < cavities.size(); ++part) {
        if (!(health.components[part].volume * volume < 0.0) || cavities[part]) continue;
        throw BadInput(
            fmt::format("{}: its part with face {} looks inwards, other than the rest, and lies in no other part whose "
                        "cavity it could be. Turn its {} faces around.",
                        surface.name, surface.label(health.components[part].first_face), health.components[part].n_faces));
    }
}

/// Shell of a closed surface in either sense.
Shell<3> shell_of_file(const ObstacleSettings& obstacle, const std::filesystem::path& folder) {
    const mesh::SurfaceMesh read = mesh::read_surface(folder / obstacle.surface);
    const auto health = geometry::check_surface(read.soup());
    const mesh::SurfaceMesh surface = mesh::clean(read, health, mesh::UnusableFaces::fail).mesh;
    Shell<3> shell{.faces = {}, .closed = health.closed()};
    for (std::int32_t face = 0; face < surface.faces.size(); ++face) {
        std::vector<Vector<3>> corners;
        for (const std::int32_t v : surface.faces[face])
            corners.push_back(obstacle.unit * obstacle.scale * surface.vertices[v]);
        shell.faces.push_back(std::move(corners));
    }
    const auto add = [](double sum, const geometry::SurfaceComponent& part) { return sum + part.volume; };
    const double volume = std::accumulate(health.components.begin(), health.components.end(), 0.0, add);
    require_one_side(read, health, volume);
    if (volume < 0.0) turn_inside_out(shell.faces);
    return shell;
}

/// Plane that has no end in the table, as far as the bodies in this box can be expected to get; where it is already.
template <int Dim>
Shell<Dim> endless_plane(const ObstacleSettings& obstacle, geometry::Box<Dim> box) {
    const Matrix<Dim> turn = rotation<Dim>(obstacle.turn);
    const Vector<Dim> point = turn * head<Dim>(obstacle.point) + head<Dim>(obstacle.place);
    if (box.empty()) box.extend(point);  // a fault has left no body
    const double size = std::max((box.upper - box.lower).norm(), std::numeric_limits<double>::min());
    return {contact::endless_plane_obstacle<Dim>(point, turn * head<Dim>(obstacle.normal), 0.5 * (box.lower + box.upper),
                                                 reach_of_planes * size)
                .faces,
            false};
}

template <int Dim>
Shell<Dim> shell_of(const ObstacleSettings& obstacle, const std::filesystem::path& folder) {
    if (obstacle.shape == ObstacleShape::plane)
        return {
            contact::plane_obstacle<Dim>(head<Dim>(obstacle.point), head<Dim>(obstacle.normal), obstacle.half_width).faces,
            false};
    if constexpr (Dim == 2)
        if (obstacle.shape == ObstacleShape::polygon) {
            std::vector<Vector<2>> corners;
            for (const Vector<3>& corner : obstacle.corners) corners.push_back(head<2>(corner));
            return {faces_of_outline(std::move(corners))};
        }
    if constexpr (Dim == 3)
        if (obstacle.shape == ObstacleShape::surface) return shell_of_file(obstacle, folder);
    return {faces_of_box(head<Dim>(obstacle.lower), head<Dim>(obstacle.upper))};
}

template <int Dim>
void place(Faces<Dim>& faces, const ObstacleSettings& obstacle) {
    const Matrix<Dim> turn = rotation<Dim>(obstacle.turn);
    for (auto& face : faces)
        for (Vector<Dim>& corner : face) corner = turn * corner + head<Dim>(obstacle.place);
}

// How it moves -------------------------------------------------------------------------------------------------------

template <int Dim>
std::function<Vector<Dim>(double)> path_of(const ObstacleSettings& obstacle) {
    if (obstacle.path) return [path = *obstacle.path](double time) { return value_at<Dim>(path, time, Vector<3>::Zero()); };
    if (obstacle.velocity.isZero(0.0)) return {};
    return [velocity = head<Dim>(obstacle.velocity)](double time) { return Vector<Dim>(velocity * time); };
}

/// Axis times angle at a time [rad]; empty: it does not turn.
std::function<Vector<3>(double)> rotation_of(const ObstacleSettings& obstacle) {
    if (obstacle.rotation)
        return [rotation = *obstacle.rotation](double time) { return value_at<3>(rotation, time, Vector<3>::Zero()); };
    if (obstacle.spin.isZero(0.0)) return {};
    return [spin = obstacle.spin](double time) { return Vector<3>(spin * time); };
}

/// Middle of the box around it; of a plane its point.
template <int Dim>
Vector<Dim> middle_of(const Faces<Dim>& faces, const ObstacleSettings& settings) {
    if (is_endless(settings)) return rotation<Dim>(settings.turn) * head<Dim>(settings.point) + head<Dim>(settings.place);
    geometry::Box<Dim> box;
    for (const auto& face : faces)
        for (const Vector<Dim>& corner : face) box.extend(corner);
    return 0.5 * (box.lower + box.upper);
}

/// A translation where it does not turn, which is all that the modified reconstruction knows.
template <int Dim>
void set_in_motion(contact::RigidObstacle<Dim>& obstacle, const ObstacleSettings& settings) {
    auto path = path_of<Dim>(settings);
    auto angle = rotation_of(settings);
    if (!angle) {
        obstacle.path = std::move(path);
        return;
    }
    const Vector<Dim> pivot = settings.pivot ? head<Dim>(*settings.pivot) : middle_of<Dim>(obstacle.faces, settings);
    obstacle.placement = [path = std::move(path), angle = std::move(angle), pivot](double time) {
        contact::Placement<Dim> placement{.turn = rotation<Dim>(angle(time))};
        placement.offset = pivot - placement.turn * pivot;
        if (path) placement.offset += path(time);
        return placement;
    };
}

/// Box around all bodies of a scene.
template <int Dim>
geometry::Box<Dim> box_of_bodies(const run::Scene<Dim>& scene, Answers& answers) {
    const auto [lower, upper] = answers.of([&] {
        const geometry::Box<Dim> box = geometry::box_of<Dim>(scene.mesh.vertices);
        return std::pair(box.lower, box.upper);
    });
    return {lower, upper};
}

template <int Dim>
void add_obstacle(run::Scene<Dim>& scene, const ObstacleSettings& settings, const Settings& all, Answers& answers,
                  mesh::IgnoredPairs may_overlap, std::vector<Fault>& faults) {
    Shell<Dim> shell = is_endless(settings) ? endless_plane<Dim>(settings, box_of_bodies(scene, answers))
                                            : shell_of<Dim>(settings, all.file.parent_path());
    if (!is_endless(settings)) place<Dim>(shell.faces, settings);
    if (settings.inside) turn_inside_out<Dim>(shell.faces);
    contact::RigidObstacle<Dim> obstacle{.faces = std::move(shell.faces), .path = {}};
    set_in_motion(obstacle, settings);
    const auto number = static_cast<std::int32_t>(scene.mesh.n_bodies() + (&settings - all.obstacles.data()));
    answers.check([&] {
        if (!all.contact || settings.is_symmetry) return;  // which says so itself
        check_outside<Dim>(scene.mesh, obstacle,
                           {.settings = settings, .closed = shell.closed, .endless = is_endless(settings), .number = number},
                           may_overlap, faults);
    });
    scene.solid.obstacles.push_back(std::move(obstacle));
    scene.outputs.obstacles.push_back(settings.name);
}

}  // namespace

template <int Dim>
void add_obstacles(run::Scene<Dim>& scene, const Settings& settings, Answers& mesh, mesh::IgnoredPairs may_overlap,
                   std::vector<Fault>& faults) {
    for (const ObstacleSettings& obstacle : settings.obstacles) {
        if (obstacle.shape == ObstacleShape::none) continue;
        if (obstacle.shape == ObstacleShape::box && !all_less(head<Dim>(obstacle.lower), head<Dim>(obstacle.upper))) {
            faults.push_back({obstacle.where,
                              fmt::format("obstacles.{}: lower has to be below upper in every component.", obstacle.name)});
            continue;
        }
        try {
            add_obstacle(scene, obstacle, settings, mesh, may_overlap, faults);
        } catch (const Error& error) {
            faults.push_back({obstacle.where, fmt::format("obstacles.{}: {}", obstacle.name, error.what())});
        }
    }
}

template void add_obstacles<2>(run::Scene<2>&, const Settings&, Answers&, mesh::IgnoredPairs, std::vector<Fault>&);
template void add_obstacles<3>(run::Scene<3>&, const Settings&, Answers&, mesh::IgnoredPairs, std::vector<Fault>&);

}  // namespace abut::input
