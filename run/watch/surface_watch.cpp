#include "abut/run/watch/surface_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "abut/contact/surface/obstacle_side.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/geometry/convex_proximity.hpp"
#include "abut/geometry/face_tree.hpp"
#include "abut/geometry/points.hpp"
#include "abut/run/body_names.hpp"
#include "abut/solid/body_interference.hpp"

namespace abut::run {
namespace {

using geometry::Box;
using geometry::box_of;
using geometry::mean_of;

// What a look costs, in times that a step takes for a cell, and a step beside its cells: measured on the scenes of
// `scenes/`.
constexpr std::int64_t cost_of_part = 8, cost_of_pair = 25, cost_of_acting_pair = 100, cost_of_step = 200;
constexpr std::int64_t steps_per_cost = 100;  // a look takes a hundredth of the steps until the next one

/// Cells inside each other by this part of the smaller one touch, and so do bodies as near to each other:
/// mesh::touching_tolerance.
constexpr double touching_cells = 1e-6;
/// Bodies slide along each other where their speed along the faces is more than this part of the largest speed.
constexpr double sliding_share = 0.1;

/// Perpendicular to a face with these corners, of any length and sense.
template <int Dim>
Vector<Dim> perpendicular(std::span<const Vector<Dim>> face) {
    const Vector<Dim> along = face[1] - face[0];
    if constexpr (Dim == 2) return {along.y(), -along.x()};
    if constexpr (Dim == 3) {
        const Vector<Dim> across = face[2] - face[0];
        return {along.y() * across.z() - along.z() * across.y(), along.z() * across.x() - along.x() * across.z(),
                along.x() * across.y() - along.y() * across.x()};
    }
}

/// Distance of all of 2 from all of 1 along an axis of unit length [m], < 0 where they overlap: their distance is no less.
template <int Dim>
double separation(std::span<const Vector<Dim>> of_1, std::span<const Vector<Dim>> of_2, const Vector<Dim>& axis) {
    const auto range = [&](std::span<const Vector<Dim>> points) {
        std::pair<double, double> low_high{axis.dot(points[0]), axis.dot(points[0])};
        for (const Vector<Dim>& x : points) {
            low_high.first = std::min(low_high.first, axis.dot(x));
            low_high.second = std::max(low_high.second, axis.dot(x));
        }
        return low_high;
    };
    const auto [low_1, high_1] = range(of_1);
    const auto [low_2, high_2] = range(of_2);
    return std::max(low_2 - high_1, low_1 - high_2);
}

/// A lower bound of the distance of two faces [m]: along their normals, edges, and the line between their middles.
template <int Dim>
double gap_between(std::span<const Vector<Dim>> face_1, std::span<const Vector<Dim>> face_2) {
    double gap = 0.0;
    const auto along = [&](const Vector<Dim>& axis) {
        if (const double length = axis.norm(); length > 0.0)
            gap = std::max(gap, separation<Dim>(face_1, face_2, Vector<Dim>(axis / length)));
    };
    along(mean_of<Dim>(face_2) - mean_of<Dim>(face_1));
    for (const auto& face : {face_1, face_2}) {
        along(perpendicular<Dim>(face));
        for (std::size_t i = 1; i < face.size(); ++i) along(face[i] - face[i - 1]);
    }
    return gap;
}

}  // namespace

template <int Dim>
SurfaceWatch<Dim>::SurfaceWatch(const Scene<Dim>& scene) : scene_(scene) {
    const mesh::Mesh<Dim>& mesh = scene.mesh;
    if (!scene.contact || mesh.body_names.size() + scene.solid.obstacles.size() < 2) return;
    of_vertex_.assign(mesh.vertices.size(), -1);
    const auto position_of = [&](std::int32_t vertex) {
        std::int32_t& position = of_vertex_[static_cast<std::size_t>(vertex)];
        if (position < 0) {
            position = static_cast<std::int32_t>(vertex_.size());
            vertex_.push_back(vertex);
        }
        return position;
    };
    const auto positions_of = [&](std::span<const std::int32_t> vertices) {
        std::vector<std::int32_t> positions;
        for (const std::int32_t vertex : vertices) positions.push_back(position_of(vertex));
        return positions;
    };
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body) bodies_.push_back({body, {}});
    std::vector<std::int32_t> part_of(mesh.cell_body.size(), -1);
    for (const std::int32_t face : mesh.boundary_faces) {
        const std::int32_t cell = mesh.face_cells[static_cast<std::size_t>(face)][0];
        auto& parts = bodies_[static_cast<std::size_t>(mesh.cell_body[static_cast<std::size_t>(cell)])].parts;
        std::int32_t& part = part_of[static_cast<std::size_t>(cell)];
        if (part < 0) {
            part = static_cast<std::int32_t>(parts.size());
            parts.push_back({positions_of(mesh.cell_vertices[cell]), {}, {}, cell});
            for (const std::int32_t side : mesh.cell_faces[cell])
                parts.back().sides.push_back(positions_of(mesh.face_vertices[side]));
        }
        parts[static_cast<std::size_t>(part)].faces.push_back(positions_of(mesh.face_vertices[face]));
    }
    const std::size_t n_of_mesh = vertex_.size();
    for (std::size_t i = 0; i < scene.solid.obstacles.size(); ++i) {
        bodies_.push_back({mesh.n_bodies() + static_cast<std::int32_t>(i), {}});
        for (const auto& corners : scene.solid.obstacles[i].faces) {
            std::vector<std::int32_t> face(corners.size());
            std::iota(face.begin(), face.end(), static_cast<std::int32_t>(n_of_mesh + at_rest_.size()));
            at_rest_.insert(at_rest_.end(), corners.begin(), corners.end());
            obstacle_.resize(at_rest_.size(), static_cast<std::int32_t>(i));
            bodies_.back().parts.push_back({face, {face}, {face}, -1});
        }
    }
    position_.resize(n_of_mesh + at_rest_.size());
    for (const Body& body : bodies_) n_parts_ += static_cast<std::int64_t>(body.parts.size());
    next_ = steps_per_cost * cost_of_part * n_parts_ / (scene.mesh.n_cells() + cost_of_step) + 1;
}

template <int Dim>
auto SurfaceWatch<Dim>::passing_pairs(double time) const -> Pairs {
    Pairs pairs =
        solid::overlapping_bodies<Dim>(scene_.mesh, scene_.solid.interference, scene_.solid.obstacles.size(), time);
    pairs.insert(pairs.end(), scene_.solid.ignored_pairs.begin(), scene_.solid.ignored_pairs.end());
    return pairs;
}

template <int Dim>
bool SurfaceWatch<Dim>::may_meet(const Body& body_1, const Body& body_2, const Pairs& passing) const {
    if (is_obstacle(body_1.number) && is_obstacle(body_2.number)) return false;
    const auto is_this = [&](const std::array<std::int32_t, 2>& pair) {
        return pair == std::array{body_1.number, body_2.number} || pair == std::array{body_2.number, body_1.number};
    };
    return std::ranges::none_of(passing, is_this);
}

template <int Dim>
auto SurfaceWatch<Dim>::points(std::span<const std::int32_t> corners) const -> Points {
    Points points;
    for (const std::int32_t corner : corners) points.push_back(position_[static_cast<std::size_t>(corner)]);
    return points;
}

/// Vertices go with the mean of the cells at the surface around them.
template <int Dim>
void SurfaceWatch<Dim>::move(const Sight<Dim>& sight) {
    const mesh::Mesh<Dim>& mesh = scene_.mesh;
    const std::size_t n_of_mesh = vertex_.size();
    std::vector<int> n_cells(n_of_mesh, 0);
    std::fill_n(position_.begin(), n_of_mesh, Vector<Dim>::Zero());
    for (const Body& body : bodies_)
        for (const Part& part : body.parts) {
            if (part.cell < 0) continue;
            const auto c = static_cast<std::size_t>(part.cell);
            const Matrix<Dim>& gradient = sight.displacement_gradient[c];
            for (const std::int32_t corner : part.corners) {
                const auto v = static_cast<std::size_t>(corner);
                const Vector<Dim>& x = mesh.vertices[static_cast<std::size_t>(vertex_[v])];
                position_[v] += x + sight.displacement[c] + gradient * (x - mesh.cell_centroid[c]);
                ++n_cells[v];
            }
        }
    for (std::size_t v = 0; v < n_of_mesh; ++v) position_[v] /= n_cells[v];
    for (std::size_t i = 0; i < at_rest_.size(); ++i) {
        const contact::RigidObstacle<Dim>& obstacle = scene_.solid.obstacles[static_cast<std::size_t>(obstacle_[i])];
        Vector<Dim>& x = position_[n_of_mesh + i];
        x = contact::placement_at(obstacle, sight.moment.time)(at_rest_[i]);
    }
}

template <int Dim>
void SurfaceWatch<Dim>::look(const Sight<Dim>& sight, double speed, bool touch) {
    if (!is_on() || last_ == sight.moment.steps) return;
    move(sight);
    std::int64_t cost = cost_of_part * n_parts_ + look_at_depths(sight.moment.time);
    if (touch) cost += look_at_pairs(sight, speed);
    last_ = sight.moment.steps;
    next_ = last_ + steps_per_cost * cost / (scene_.mesh.n_cells() + cost_of_step) + 1;
    ++looks_.looks;
}

template <int Dim>
void SurfaceWatch<Dim>::end(const Sight<Dim>& sight, double speed, bool touch, bool has_touched) {
    if (!is_on()) return;
    if (last_ == sight.moment.steps)
        move(sight);
    else
        look(sight, speed, touch);
    if (!has_touched) look_for_nearest(sight.moment.time);
}

/// The size of a cell in space, or the way across a face of an obstacle [m].
template <int Dim>
double SurfaceWatch<Dim>::size(const Part& part) const {
    if (part.cell >= 0) return std::pow(scene_.mesh.cell_measure[static_cast<std::size_t>(part.cell)], 1.0 / Dim);
    return std::numeric_limits<double>::infinity();
}

/// Depth of two parts inside each other [m]; 0: they are not. Bodies with flat sides that are apart can be parted along a
/// normal of a side, in 3D along one of two edges as well.
template <int Dim>
double SurfaceWatch<Dim>::depth(const Part& part_1, const Part& part_2, double at_least) const {
    const Points of_1 = points(part_1.corners), of_2 = points(part_2.corners);
    const double tolerance = touching_cells * std::min(size(part_1), size(part_2));
    double depth = std::numeric_limits<double>::infinity();
    for (const Part* part : {&part_1, &part_2})
        for (const auto& side : part->sides) {
            const Vector<Dim> axis = perpendicular<Dim>(points(side)).normalized();
            depth = std::min(depth, -separation<Dim>(of_1, of_2, axis));
            if (!(depth > tolerance) || depth <= at_least) return 0.0;
        }
    if (Dim == 2) return depth;
    const geometry::ConvexProximity<Dim> lie = geometry::convex_proximity<Dim>(of_1, of_2);
    if (part_2.cell < 0) return lie.distance > 0.0 ? 0.0 : depth;
    depth = std::min(depth, lie.depth);
    return depth > tolerance ? depth : 0.0;
}

/// Measures how deep cells are inside each other. Returns what it has cost.
template <int Dim>
std::int64_t SurfaceWatch<Dim>::look_at_depths(double time) {
    std::int64_t cost = 0;
    std::vector<std::vector<Box<Dim>>> boxes;
    std::vector<Box<Dim>> around;
    for (const Body& body : bodies_) {
        auto& of_body = boxes.emplace_back();
        for (const Part& part : body.parts) of_body.push_back(box_of<Dim>(points(part.corners)));
        around.push_back(geometry::bounding_box<Dim>(of_body));
    }
    const auto inside = [&](std::size_t body, const Box<Dim>& other) {
        std::vector<std::int32_t> parts;
        for (std::size_t i = 0; i < boxes[body].size(); ++i)
            if (boxes[body][i].overlaps(other)) parts.push_back(static_cast<std::int32_t>(i));
        return parts;
    };
    const auto chosen = [](const std::vector<Box<Dim>>& of, const std::vector<std::int32_t>& which) {
        std::vector<Box<Dim>> some;
        for (const std::int32_t i : which) some.push_back(of[static_cast<std::size_t>(i)]);
        return some;
    };
    const Pairs passing = passing_pairs(time);
    for (std::size_t a = 0; a < bodies_.size(); ++a)
        for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
            if (!around[a].overlaps(around[b]) || !may_meet(bodies_[a], bodies_[b], passing)) continue;
            const auto near_a = inside(a, around[b]), near_b = inside(b, around[a]);
            const auto boxes_a = chosen(boxes[a], near_a), boxes_b = chosen(boxes[b], near_b);
            for (const auto& [i, k] : geometry::overlapping_pairs<Dim>(geometry::SearchOptions{}, boxes_a, boxes_b)) {
                const Part& part_1 = bodies_[a].parts[static_cast<std::size_t>(near_a[static_cast<std::size_t>(i)])];
                const Part& part_2 = bodies_[b].parts[static_cast<std::size_t>(near_b[static_cast<std::size_t>(k)])];
                const double smaller = std::min(size(part_1), size(part_2));
                const double deep = depth(part_1, part_2, looks_.deepest.ratio * smaller), ratio = deep / smaller;
                cost += cost_of_pair;
                if (ratio > looks_.deepest.ratio)
                    looks_.deepest = {quoted_name(scene_, bodies_[a].number), quoted_name(scene_, bodies_[b].number), deep,
                                      ratio, time};
            }
        }
    return cost;
}

/// The pairs that push each other: how far apart they are. Returns what it has cost.
template <int Dim>
std::int64_t SurfaceWatch<Dim>::look_at_pairs(const Sight<Dim>& sight, double speed) {
    const mesh::Mesh<Dim>& mesh = scene_.mesh;
    const auto of_face = [&](std::int32_t face) {
        Points corners;
        for (const std::int32_t vertex : mesh.face_vertices[face])
            corners.push_back(position_[static_cast<std::size_t>(of_vertex_[static_cast<std::size_t>(vertex)])]);
        return corners;
    };
    for (const solid::ActingPair<Dim>& pair : sight.pairs) {
        if (pair.face_1 == solid::no_face || pair.face_2 == solid::no_face) continue;
        const std::int32_t face_1 = mesh_face(mesh, pair.face_1), face_2 = mesh_face(mesh, pair.face_2);
        const double size = std::pow(std::min(mesh.face_measure[static_cast<std::size_t>(face_1)],
                                              mesh.face_measure[static_cast<std::size_t>(face_2)]),
                                     1.0 / (Dim - 1));
        const Points of_1 = of_face(face_1), of_2 = of_face(face_2);
        const double apart = gap_between<Dim>(of_1, of_2);
        if (apart / size <= looks_.remote.ratio) continue;
        looks_.remote = {quoted_name(scene_, mesh.cell_body[static_cast<std::size_t>(cell_of(mesh, pair.face_1))]),
                         quoted_name(scene_, mesh.cell_body[static_cast<std::size_t>(cell_of(mesh, pair.face_2))]), apart,
                         apart / size, sight.moment.time};
    }
    look_at_pressure(sight, speed);
    return cost_of_acting_pair * std::ssize(sight.pairs);
}

/// By pairs of bodies: their mean pressure, and their speed along each other.
template <int Dim>
void SurfaceWatch<Dim>::look_at_pressure(const Sight<Dim>& sight, double speed) {
    struct Sum {
        std::array<std::int32_t, 2> bodies;
        double force, area, slip;
    };
    const mesh::Mesh<Dim>& mesh = scene_.mesh;
    const auto cell = [&](solid::BoundaryFace face) { return face == solid::no_face ? -1 : cell_of(mesh, face); };
    const auto body = [&](std::int32_t of) { return of < 0 ? -1 : mesh.cell_body[static_cast<std::size_t>(of)]; };
    const std::vector<Vector<Dim>>& velocity = sight.velocity;
    std::vector<Sum> sums;
    for (const solid::ActingPair<Dim>& pair : sight.pairs) {
        const std::int32_t cell_1 = cell(pair.face_1), cell_2 = cell(pair.face_2);
        if (cell_1 < 0 || cell_2 < 0) continue;  // how fast an obstacle moves is not known
        const std::array bodies{body(cell_1), body(cell_2)};
        auto sum = std::ranges::find(sums, bodies, &Sum::bodies);
        if (sum == sums.end()) sum = sums.insert(sums.end(), {bodies, 0.0, 0.0, 0.0});
        const Vector<Dim> relative = velocity[static_cast<std::size_t>(cell_2)] - velocity[static_cast<std::size_t>(cell_1)];
        sum->force += pair.normal_force;
        sum->area += pair.area;
        sum->slip += pair.area * (relative - relative.dot(pair.normal) * pair.normal).norm();
    }
    for (const Sum& sum : sums) {
        const auto young = [&](std::int32_t i) { return scene_.solid.materials[static_cast<std::size_t>(i)].mean_young(); };
        const double ratio = sum.force / sum.area / std::min(young(sum.bodies[0]), young(sum.bodies[1]));
        if (ratio > looks_.pressed.ratio && sum.slip / sum.area > sliding_share * speed)
            looks_.pressed = {quoted_name(scene_, sum.bodies[0]), quoted_name(scene_, sum.bodies[1]), 0.0, ratio,
                              sight.moment.time};
    }
}

template <int Dim>
void SurfaceWatch<Dim>::look_for_nearest(double time) {
    std::vector<geometry::FaceTree<Dim>> trees;
    for (const Body& body : bodies_) {
        std::vector<Points> faces;
        for (const Part& part : body.parts)
            for (const auto& face : part.faces) faces.push_back(points(face));
        trees.emplace_back(std::move(faces));
    }
    const auto size_of = [&](std::size_t body) {
        geometry::Box<Dim> box;
        for (const Part& part : bodies_[body].parts)
            for (const auto& face : part.faces)
                for (const std::int32_t corner : face) box.extend(position_[static_cast<std::size_t>(corner)]);
        return (box.upper - box.lower).norm();
    };
    double best = std::numeric_limits<double>::infinity();
    const Pairs passing = passing_pairs(time);
    for (std::size_t a = 0; a < bodies_.size(); ++a)
        for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
            if (!may_meet(bodies_[a], bodies_[b], passing)) continue;
            const double distance = geometry::distance_below(trees[a], trees[b], best);
            if (distance <= touching_cells * std::min(size_of(a), size_of(b))) {  // at rest on each other, without a force
                looks_.nearest = {};
                return;
            }
            if (distance < best)
                looks_.nearest = {quoted_name(scene_, bodies_[a].number), quoted_name(scene_, bodies_[b].number), distance,
                                  0.0, time};
            best = std::min(best, distance);
        }
}

template class SurfaceWatch<2>;
template class SurfaceWatch<3>;

}  // namespace abut::run
