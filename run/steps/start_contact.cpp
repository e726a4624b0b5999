#include "abut/run/steps/start_contact.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/contact/contact.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/surface/obstacle_side.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/geometry/convex_proximity.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/run/body_names.hpp"
#include "abut/run/steps/of_all_ranks.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::run {
namespace {

constexpr double allowed_energy = 1e-6;  // of the scale
constexpr double touching_faces = 1e-9;  // of the size of a face: nearer faces touch
constexpr double as_near = 1e-6;         // of the size of a face: so accurate is a distance

/// The surface of a body or an obstacle at the start.
template <int Dim>
struct PlacedSurface {
    std::vector<std::vector<Vector<Dim>>> faces;  // corners
    std::vector<Vector<Dim>> normals;
    std::vector<geometry::Box<Dim>> boxes;

    void append(std::vector<Vector<Dim>> corners, const Vector<Dim>& normal) {
        boxes.emplace_back();
        for (const Vector<Dim>& corner : corners) boxes.back().extend(corner);
        faces.push_back(std::move(corners));
        normals.push_back(normal);
    }
};

template <int Dim>
PlacedSurface<Dim> placed_body(const Scene<Dim>& scene, std::int32_t body) {
    const mesh::Mesh<Dim>& mesh = scene.mesh;
    PlacedSurface<Dim> placed;
    for (const std::int32_t face : mesh.boundary_faces) {
        if (mesh.cell_body[mesh.face_cells[face][0]] != body) continue;
        std::vector<Vector<Dim>> corners;
        for (const std::int32_t v : mesh.face_vertices[face]) {
            const Vector<Dim>& x = mesh.vertices[v];
            corners.push_back(scene.displacement ? Vector<Dim>(x + scene.displacement(x)) : x);
        }
        placed.append(std::move(corners), mesh.face_normal[face]);
    }
    return placed;
}

template <int Dim>
PlacedSurface<Dim> placed_obstacle(const contact::RigidObstacle<Dim>& obstacle) {
    const contact::Placement<Dim> placement = contact::placement_at(obstacle, 0.0);
    PlacedSurface<Dim> placed;
    for (std::vector<Vector<Dim>> corners : obstacle.faces) {
        for (Vector<Dim>& corner : corners) corner = placement(corner);
        const Vector<Dim> normal = geometry::face_normal<Dim>(corners);
        placed.append(std::move(corners), normal);
    }
    return placed;
}

/// Obstacles are counted behind the bodies of the mesh.
template <int Dim>
PlacedSurface<Dim> placed(const Scene<Dim>& scene, std::int32_t body) {
    const std::int32_t n = scene.mesh.n_bodies();
    return body < n ? placed_body(scene, body) : placed_obstacle(scene.solid.obstacles[static_cast<std::size_t>(body - n)]);
}

/// The bodies that push each other in the state that was evaluated last, the lower number first.
template <int Dim>
std::set<std::array<std::int32_t, 2>> pushing_bodies(const solid::Solid<Dim>& solid) {
    std::set<std::array<std::int32_t, 2>> pushing;
    const auto add = [&](std::int32_t a, std::int32_t b) { pushing.insert({std::min(a, b), std::max(a, b)}); };
    if (const contact::Contact<Dim>* by_faces = solid.contact().reconstruction()) {
        const auto body_of = [&](contact::Face face) { return by_faces->surface().body[static_cast<std::size_t>(face)]; };
        for (const auto& pair : by_faces->last().pairs) add(body_of(pair.face_1), body_of(pair.face_2));
    }
    if (const contact::NodalContact<Dim>* by_nodes = solid.contact().pair_potential()) {
        // There bodies that deform come first, then those that are rigid.
        const auto& kinematics = solid.options().kinematics;
        std::vector<std::int32_t> mesh_body;
        for (const bool rigid : {false, true})
            for (std::int32_t body = 0; body < solid.mesh().n_bodies(); ++body)
                if (solid::properties_of(kinematics, static_cast<std::size_t>(body)).deforms != rigid)
                    mesh_body.push_back(body);
        const auto body_of = [&](std::int32_t body) {
            return body < solid.mesh().n_bodies() ? mesh_body[static_cast<std::size_t>(body)] : body;
        };
        for (const auto& pair : by_nodes->last().body_pairs)
            if (pair.active_pairs > 0) add(body_of(pair.body_1), body_of(pair.body_2));
    }
    return pushing;
}

template <int Dim>
struct Nearest {
    double distance;    // [m]
    Vector<Dim> place;  // [m]
    bool apart;         // neither is behind a face of the other
};

template <int Dim>
double size_of(const std::vector<Vector<Dim>>& corners) {
    double size = 0.0;
    for (const Vector<Dim>& corner : corners) size = std::max(size, (corner - corners.front()).norm());
    return size;
}

/// Nearest points of two surfaces no farther apart than `bound`.
template <int Dim>
Nearest<Dim> nearest(const PlacedSurface<Dim>& a, const PlacedSurface<Dim>& b, double bound,
                     const geometry::SearchOptions& search) {
    std::vector<geometry::Box<Dim>> grown;
    for (const geometry::Box<Dim>& box : a.boxes) grown.push_back(box.grown(bound));
    Nearest<Dim> best{std::numeric_limits<double>::infinity(), Vector<Dim>::Zero(), true};
    double out_of_a = -1.0, out_of_b = -1.0;  // of the nearest faces, cosines
    for (const auto& [i, k] : geometry::overlapping_pairs<Dim>(search, grown, b.boxes)) {
        const auto &face_a = a.faces[static_cast<std::size_t>(i)], &face_b = b.faces[static_cast<std::size_t>(k)];
        const auto [distance, depth, direction] = geometry::convex_proximity<Dim>(face_a, face_b);
        const double same = as_near * std::max(size_of<Dim>(face_a), size_of<Dim>(face_b));
        if (distance > best.distance + same) continue;
        const double from_a = direction.dot(a.normals[static_cast<std::size_t>(i)]);
        const double from_b = -direction.dot(b.normals[static_cast<std::size_t>(k)]);
        if (distance < best.distance - same) out_of_a = out_of_b = -1.0;
        out_of_a = std::max(out_of_a, from_a);
        out_of_b = std::max(out_of_b, from_b);
        if (distance < best.distance)
            best = {distance, 0.5 * (geometry::face_centroid<Dim>(face_a) + geometry::face_centroid<Dim>(face_b)), true};
    }
    best.apart = out_of_a > 0.0 && out_of_b > 0.0;
    return best;
}

/// How far two surfaces are apart; nothing where they touch, cross, or one is inside the other.
template <int Dim>
std::optional<Nearest<Dim>> how_far_apart(const PlacedSurface<Dim>& a, const PlacedSurface<Dim>& b,
                                          const geometry::SearchOptions& search) {
    const geometry::Box<Dim> all_a = geometry::bounding_box<Dim>(a.boxes), all_b = geometry::bounding_box<Dim>(b.boxes);
    double size = 0.0;
    for (const auto* surface : {&a, &b})
        for (const auto& face : surface->faces) size = std::max(size, size_of<Dim>(face));
    // Faces push that are a few sizes apart at most: from a small bound on, until something is found.
    const double most = (all_a.upper - all_a.lower).norm() + (all_b.upper - all_b.lower).norm();
    for (double bound = 1e-3 * size; bound < 4.0 * most; bound *= 4.0) {
        const Nearest<Dim> found = nearest(a, b, bound, search);
        if (found.distance > bound) continue;
        if (found.distance <= touching_faces * size || !found.apart) return {};
        return found;
    }
    return {};
}

/// Throws BadInput where two bodies or obstacles that push each other are apart.
template <int Dim>
void require_touch(const Scene<Dim>& scene, const solid::Solid<Dim>& solid, double energy, double allowed) {
    const bool by_nodes = solid.contact().pair_potential() != nullptr;
    const geometry::SearchOptions search{.method = solid.options().contact->search.broad_phase};
    for (const auto& [a, b] : pushing_bodies(solid)) {
        const auto apart = how_far_apart(placed(scene, a), placed(scene, b), search);
        if (!apart) continue;
        std::vector<std::string> place;
        for (const double x : apart->place) place.push_back(fmt::format("{:.6g}", x));
        throw BadInput(
            fmt::format(
                "{} and {} are {:.4g} m apart at the start, nearest at ({}) m, and contact stores {:.4g} J; {:.4g} J is "
                "allowed, {:g} of the energy that the run begins with. {}",
                quoted_name(scene, a), quoted_name(scene, b), apart->distance, fmt::join(place, ", "), energy, allowed,
                allowed_energy,
                by_nodes ? "A face of one looks at one of the other from behind, nearer than cells are deep: make "
                           "cells smaller there, or move the bodies farther apart."
                         : "Faces that are tilted against each other count as nearer than they are: take law = "
                           "\"pair_potential\" (contact.law), make cells smaller there, or move the bodies farther "
                           "apart."),
            {.value = energy, .allowed = allowed});
    }
}

}  // namespace

template <int Dim>
void check_start_contact(const Scene<Dim>& scene, solid::Solid<Dim>& solid, std::span<const double> q, double scale,
                         double rest_energy) {
    if (solid.contact_at(q).acting_pairs().empty()) return;
    const auto* by_nodes = solid.contact().pair_potential();
    const double energy = by_nodes ? by_nodes->last().energy : solid.contact().reconstruction()->last().energy;
    if (!(std::abs(energy) > std::max(allowed_energy * scale, rest_energy))) return;
    on_first(solid.ranks(), [&] { require_touch(scene, solid, energy, allowed_energy * scale); });
}

template void check_start_contact<2>(const Scene<2>&, solid::Solid<2>&, std::span<const double>, double, double);
template void check_start_contact<3>(const Scene<3>&, solid::Solid<3>&, std::span<const double>, double, double);

}  // namespace abut::run
