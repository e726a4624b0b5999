#include "abut/run/watch/obstacle_watch.hpp"
#include "abut/run/values/sightings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "abut/contact/surface/obstacle_side.hpp"
#include "abut/geometry/box.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/run/body_names.hpp"

namespace abut::run {
namespace {

template <int Dim>
bool is_flat(const contact::RigidObstacle<Dim>& obstacle) {
    return obstacle.faces.size() == 1;
}

template <int Dim>
bool is_ignored(const Scene<Dim>& scene, std::int32_t body, std::size_t obstacle) {
    const std::int32_t number = scene.mesh.n_bodies() + static_cast<std::int32_t>(obstacle);
    return std::ranges::any_of(scene.solid.ignored_pairs, [&](const auto& pair) {
        return pair == std::array{body, number} || pair == std::array{number, body};
    });
}

/// Whether a point is over a flat convex face, seen along its normal.
template <int Dim>
bool is_over(const std::vector<Vector<Dim>>& corners, const Vector<Dim>& normal, const Vector<Dim>& point) {
    if constexpr (Dim == 2) {
        const Vector<2> along = corners[1] - corners[0];
        const double at = along.dot(point - corners[0]);
        return at >= 0.0 && at <= along.squaredNorm();
    } else {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vector<3>&a = corners[i], b = corners[(i + 1) % corners.size()];
            if (normal.dot(moment<3>(b - a, point - a)) < 0.0) return false;
        }
        return true;
    }
}

/// For each body the vertices that reach farthest along the axes, and their middle, where they are at the start.
template <int Dim>
std::vector<std::vector<Vector<Dim>>> outermost_points(const Scene<Dim>& scene) {
    const mesh::Mesh<Dim>& mesh = scene.mesh;
    std::vector<std::vector<Vector<Dim>>> points(mesh.body_names.size());
    std::vector<geometry::Box<Dim>> boxes(points.size());
    const auto at_start = [&](std::int32_t vertex) -> Vector<Dim> {
        const Vector<Dim>& x = mesh.vertices[static_cast<std::size_t>(vertex)];
        return scene.displacement ? Vector<Dim>(x + scene.displacement(x)) : x;
    };
    for (const std::int32_t face : mesh.boundary_faces) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[mesh.face_cells[face][0]]);
        for (const std::int32_t v : mesh.face_vertices[face]) {
            const Vector<Dim> x = at_start(v);
            boxes[body].extend(x);
            std::vector<Vector<Dim>>& farthest = points[body];
            if (farthest.empty()) farthest.assign(2 * Dim, x);
            for (int d = 0; d < Dim; ++d) {
                if (x[d] < farthest[2 * d][d]) farthest[2 * d] = x;
                if (x[d] > farthest[2 * d + 1][d]) farthest[2 * d + 1] = x;
            }
        }
    }
    for (std::size_t body = 0; body < points.size(); ++body)
        if (!boxes[body].empty()) points[body].push_back(0.5 * (boxes[body].lower + boxes[body].upper));
    return points;
}

/// Behind one face, and over the part of the plane that it takes.
template <int Dim>
bool is_behind_face(const std::vector<Vector<Dim>>& corners, const std::vector<Vector<Dim>>& points) {
    const Vector<Dim> normal = geometry::face_normal<Dim>(corners);
    return !points.empty() && is_over<Dim>(corners, normal, points.back()) &&
           std::ranges::all_of(points, [&](const Vector<Dim>& x) { return normal.dot(x - corners[0]) < 0.0; });
}

/// For each body how far its box reaches and its centre, where it is at the start, (n_bodies, 1 + Dim) [m].
template <int Dim>
std::vector<double> sizes_and_centres(const Scene<Dim>& scene) {
    std::vector<geometry::Box<Dim>> boxes(scene.mesh.body_names.size());
    std::vector<Vector<Dim>> centres(boxes.size(), Vector<Dim>::Zero());
    std::vector<double> measures(boxes.size(), 0.0);
    for (std::int32_t c = 0; c < scene.mesh.n_cells(); ++c) {
        const auto body = static_cast<std::size_t>(scene.mesh.cell_body[c]);
        for (const std::int32_t v : scene.mesh.cell_vertices[c]) boxes[body].extend(scene.mesh.vertices[v]);
        Vector<Dim> centre = scene.mesh.cell_centroid[c];
        if (scene.displacement) centre += scene.displacement(scene.mesh.cell_centroid[c]);
        centres[body] += scene.mesh.cell_measure[c] * centre;
        measures[body] += scene.mesh.cell_measure[c];
    }
    std::vector<double> found;
    for (std::size_t body = 0; body < boxes.size(); ++body) {
        found.push_back(boxes[body].empty() ? 0.0 : (boxes[body].upper - boxes[body].lower).norm());
        const Vector<Dim> centre = centres[body] / measures[body];
        found.insert(found.end(), centre.begin(), centre.end());
    }
    return found;
}

}  // namespace

template <int Dim>
std::vector<Behind> behind_at_start(const Scene<Dim>& scene) {
    std::vector<Behind> behind;
    if (!scene.contact || scene.solid.obstacles.empty()) return behind;
    const auto points = outermost_points(scene);
    for (std::size_t i = 0; i < scene.solid.obstacles.size(); ++i) {
        std::vector<std::vector<Vector<Dim>>> faces = scene.solid.obstacles[i].faces;
        const contact::Placement<Dim> placed = contact::placement_at(scene.solid.obstacles[i], 0.0);
        for (auto& face : faces)
            for (Vector<Dim>& corner : face) corner = placed(corner);
        std::size_t n = 0, n_behind = 0;  // of bodies that it is there for
        for (std::int32_t body = 0; body < scene.mesh.n_bodies(); ++body) {
            const std::vector<Vector<Dim>>& of_body = points[static_cast<std::size_t>(body)];
            if (of_body.empty() || is_ignored(scene, body, i)) continue;
            if (faces.size() == 1) {
                if (is_behind_face<Dim>(faces[0], of_body)) behind.push_back({body, static_cast<std::int32_t>(i)});
                continue;
            }
            ++n;
            if (std::ranges::all_of(of_body, [&](const Vector<Dim>& x) { return contact::side_of<Dim>(faces, x) < 0.0; }))
                ++n_behind;
        }
        if (n > 0 && n_behind == n) behind.push_back({-1, static_cast<std::int32_t>(i)});
    }
    return behind;
}

template <int Dim>
ObstacleWatch<Dim>::ObstacleWatch(const Scene<Dim>& scene, const dynamics::Ranks& ranks) : scene_(scene) {
    if (!scene.contact) return;
    for (std::size_t i = 0; i < scene.solid.obstacles.size(); ++i)
        for (std::int32_t body = 0; body < scene.mesh.n_bodies(); ++body)
            if (is_flat(scene.solid.obstacles[i]) && !is_ignored(scene, body, i))
                pairs_.push_back({body, static_cast<std::int32_t>(i)});
    if (pairs_.empty()) return;
    std::vector<double> found;  // rank 0 has the whole mesh
    dynamics::agreed(ranks, [&] {
        if (ranks.rank() == 0) found = sizes_and_centres(scene);
    });
    found = ranks.gather(found);
    for (std::size_t first = 0; first < found.size(); first += Dim + 1) size_.push_back(found[first]);
    for (Watched& pair : pairs_) {
        const double* centre = &found[static_cast<std::size_t>(pair.body) * (Dim + 1) + 1];
        pair.at_start = place(pair, Vector<Dim>(centre), 0.0);
    }
    std::erase_if(pairs_, [](const Watched& pair) { return !(pair.at_start.height > 0.0); });
}

template <int Dim>
auto ObstacleWatch<Dim>::place(const Watched& pair, const Vector<Dim>& centre, double time) const -> Place {
    const contact::RigidObstacle<Dim>& obstacle = scene_.solid.obstacles[static_cast<std::size_t>(pair.obstacle)];
    const contact::Placement<Dim> placed = contact::placement_at(obstacle, time);
    const Vector<Dim> at_rest = placed.turn.transpose() * (centre - placed.offset);
    const std::vector<Vector<Dim>>& corners = obstacle.faces[0];
    const Vector<Dim> normal = geometry::face_normal<Dim>(corners);
    return {normal.dot(at_rest - corners[0]), is_over<Dim>(corners, normal, at_rest)};
}

template <int Dim>
std::vector<Vector<Dim>> ObstacleWatch<Dim>::centres(const solid::Solid<Dim>& solid, std::span<const double> q) const {
    const auto u = as_vectors<Dim>(q);
    std::vector<double> sums(size_.size() * (Dim + 1), 0.0);  // mass and moment of each body
    for (std::size_t i = 0; i < u.size(); ++i) {
        const auto first = static_cast<std::size_t>(solid.body_of_points()[i]) * (Dim + 1);
        sums[first] += solid.masses()[i];
        for (int d = 0; d < Dim; ++d) sums[first + 1 + d] += solid.masses()[i] * (solid.rest_positions()[i][d] + u[i][d]);
    }
    const std::vector<double> all = solid.ranks().gather(sums);
    std::ranges::fill(sums, 0.0);
    for (std::size_t k = 0; k < all.size(); ++k) sums[k % sums.size()] += all[k];
    std::vector<Vector<Dim>> centres;
    for (std::size_t first = 0; first < sums.size(); first += Dim + 1)
        centres.push_back(Vector<Dim>(sums.data() + first + 1) / sums[first]);
    return centres;
}

template <int Dim>
void ObstacleWatch<Dim>::look(const solid::Solid<Dim>& solid, std::span<const double> q, double time,
                              std::vector<PastRim>& found) {
    if (pairs_.empty()) return;
    const std::vector<Vector<Dim>> at = centres(solid, q);
    for (Watched& pair : pairs_) {
        if (pair.is_done) continue;
        const auto body = static_cast<std::size_t>(pair.body);
        const Place now = place(pair, at[body], time);
        const bool has_fallen = now.height < 0.0, has_left = pair.at_start.is_over && now.height < size_[body];
        if (now.is_over || !(has_fallen || has_left)) continue;
        pair.is_done = true;
        const PastRim past{scene_.mesh.body_names[body], name_of_obstacle(scene_, static_cast<std::size_t>(pair.obstacle)),
                           time};
        // A run that goes on knows what was found before.
        if (std::ranges::none_of(
                found, [&](const PastRim& known) { return known.body == past.body && known.obstacle == past.obstacle; }))
            found.push_back(past);
    }
}

#define ABUT_INSTANTIATE(Dim)                                                   \
    template std::vector<Behind> behind_at_start<Dim>(const Scene<Dim>& scene); \
    template class ObstacleWatch<Dim>;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
