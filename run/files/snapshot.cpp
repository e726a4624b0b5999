#include "abut/run/files/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "abut/contact/surface/obstacle_side.hpp"
#include "abut/mesh/without_cells.hpp"
#include "abut/run/files/frames.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/sight.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::run {
namespace {

using Position = Snapshot::Position;

constexpr double strain_of_rounding = 1e-9;  // far above it
constexpr double highest_left_out = 0.02;    // part of the values

/// Kind of the edges of each face of the mesh.
template <int Dim>
std::vector<Edge> edges_of_faces(const mesh::Mesh<Dim>& mesh, const solid::BoundaryConditions<Dim>& conditions) {
    std::vector<Edge> edges(static_cast<std::size_t>(mesh.n_faces()), Edge::inner);
    const auto edge_of = [&](solid::BoundaryFace face) -> Edge& {
        return edges[static_cast<std::size_t>(solid::mesh_face(mesh, face))];
    };
    if (Dim == 2)
        for (const std::int32_t face : mesh.boundary_faces) edges[static_cast<std::size_t>(face)] = Edge::rim;
    const solid::FaceConditions<Dim> sorted = solid::sort_to_faces<Dim>(mesh, conditions);
    for (const auto& faces : sorted.traction)
        for (const solid::BoundaryFace face : faces) edge_of(face) = Edge::loaded;
    for (const auto& faces : sorted.dirichlet)
        for (const auto& prescribed : faces) edge_of(prescribed.face) = Edge::held;
    return edges;
}

/// Adds polygons, and numbers the vertices that they use. Those of bodies that cells may leave share none.
template <int Dim>
class PolygonMaker {
public:
    /// `faces`, `owners`: see SnapshotMaker.
    PolygonMaker(const mesh::Mesh<Dim>& mesh, const std::vector<char>& loses_cells, const std::vector<Edge>& edges,
                 BodyPolygons& polygons, std::vector<std::int32_t>& faces, std::vector<std::int32_t>& owners)
        : mesh_(mesh), loses_cells_(loses_cells), polygons_(polygons), owners_(owners), number_(mesh.vertices.size(), -1) {
        const auto edge_of = [&](std::int32_t face) { return edges[static_cast<std::size_t>(face)]; };
        if constexpr (Dim == 2)
            for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
                add(mesh.cell_vertices[cell], cell);
                for (const std::int32_t face : mesh.cell_faces[cell]) polygons_.edges.push_back(edge_of(face));
            }
        else
            for (std::int32_t face = 0; face < mesh.n_faces(); ++face) {
                const std::int32_t cell = mesh.face_cells[static_cast<std::size_t>(face)][0];
                if (!mesh.is_boundary(face) && !may_leave(cell)) continue;
                add(mesh.face_vertices[face], cell);
                polygons_.edges.resize(polygons_.corners.size(), edge_of(face));
                faces.push_back(face);
            }
    }

    /// Number of the position of a vertex of the mesh, which polygons may share.
    std::int32_t number(std::int32_t vertex) {
        std::int32_t& number = number_[static_cast<std::size_t>(vertex)];
        if (number < 0) number = added(vertex, -1);
        return number;
    }

private:
    [[nodiscard]] bool may_leave(std::int32_t cell) const {
        return loses_cells_[static_cast<std::size_t>(mesh_.cell_body[static_cast<std::size_t>(cell)])] != 0;
    }
    std::int32_t added(std::int32_t vertex, std::int32_t owner) {
        polygons_.vertex.push_back(vertex);
        owners_.push_back(owner);
        return static_cast<std::int32_t>(polygons_.vertex.size()) - 1;
    }
    void add(std::span<const std::int32_t> vertices, std::int32_t cell) {
        const auto polygon = static_cast<std::int32_t>(polygons_.cell.size());
        for (const std::int32_t vertex : vertices)
            polygons_.corners.push_back(may_leave(cell) ? added(vertex, polygon) : number(vertex));
        polygons_.offsets.push_back(polygons_.corners.size());
        polygons_.cell.push_back(cell);
        polygons_.body.push_back(mesh_.cell_body[static_cast<std::size_t>(cell)]);
    }

    const mesh::Mesh<Dim>& mesh_;
    const std::vector<char>& loses_cells_;
    BodyPolygons& polygons_;
    std::vector<std::int32_t>& owners_;
    std::vector<std::int32_t> number_;  // of the vertices of the mesh
};

/// By body.
template <int Dim>
std::vector<char> bodies_that_lose_cells(const Scene<Dim>& scene) {
    std::vector<char> loses(scene.mesh.body_names.size(), scene.leaving ? 1 : 0);
    for (std::size_t body = 0; body < scene.solid.erosion.size(); ++body)
        if (scene.solid.erosion[body].any()) loses[body] = 1;
    return loses;
}

std::vector<std::int32_t> all_numbers(std::size_t n) {
    std::vector<std::int32_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

template <int Dim>
std::vector<std::vector<Position>> faces_of_obstacles(const std::vector<contact::RigidObstacle<Dim>>& obstacles,
                                                      double time) {
    std::vector<std::vector<Position>> faces;
    for (const auto& obstacle : obstacles) {
        const contact::Placement<Dim> placement = contact::placement_at<Dim>(obstacle, time);
        for (const auto& corners : obstacle.faces) {
            auto& face = faces.emplace_back();
            for (const Vector<Dim>& corner : corners) face.push_back(in_space<Dim>(placement(corner)));
        }
    }
    return faces;
}

}  // namespace

template <int Dim>
SnapshotMaker<Dim>::SnapshotMaker(const Scene<Dim>& scene, const RunResult<Dim>& result)
    : scene_(scene),
      cell_now_(all_numbers(scene.mesh.cell_measure.size())),
      vertex_now_(all_numbers(scene.mesh.vertices.size())) {
    for (std::size_t body = 0; body < scene.mesh.body_names.size(); ++body)
        is_rigid_.push_back(!solid::properties_of(kinematics_of(scene, result, body)).deforms);
    all_rigid_ = std::ranges::all_of(is_rigid_, [](char is_rigid) { return is_rigid != 0; });
    polygons_ = {.in_space = Dim == 3,
                 .value_name = all_rigid_ ? "speed" : "von Mises stress",
                 .value_unit = all_rigid_ ? "m/s" : "Pa"};
    polygons_.body_names = scene.mesh.body_names;
    if (!all_rigid_) {
        polygons_.least_end = std::numeric_limits<double>::infinity();
        for (std::size_t body = 0; body < is_rigid_.size(); ++body)
            if (is_rigid_[body] == 0)
                polygons_.least_end =
                    std::min(polygons_.least_end, strain_of_rounding * scene.solid.materials[body].mean_young());
    }
    const std::vector<char> loses_cells = bodies_that_lose_cells(scene);
    const std::vector<Edge> edges = edges_of_faces<Dim>(scene.mesh, scene.solid.boundary);
    PolygonMaker<Dim> maker(scene.mesh, loses_cells, edges, polygons_, face_, owner_);
    polygons_.marks = marks_of<Dim>(scene, [&](std::int32_t vertex) { return maker.number(vertex); });
}

template <int Dim>
void SnapshotMaker<Dim>::take_cells(const mesh::Mesh<Dim>& left, std::span<const std::int32_t> first_cells) {
    const auto take = [](std::vector<std::int32_t>& now, std::span<const std::int32_t> first) {
        std::ranges::fill(now, -1);
        for (std::size_t i = 0; i < first.size(); ++i)
            now[static_cast<std::size_t>(first[i])] = static_cast<std::int32_t>(i);
    };
    take(cell_now_, first_cells);
    take(vertex_now_, mesh::old_vertices(scene_.mesh, left, first_cells));
}

/// Cell behind a face, where that is one of the boundary.
template <int Dim>
std::int32_t SnapshotMaker<Dim>::shown_cell(std::size_t polygon) const {
    const auto now = [&](std::int32_t cell) { return cell < 0 ? -1 : cell_now_[static_cast<std::size_t>(cell)]; };
    if constexpr (Dim == 2) return now(polygons_.cell[polygon]);
    const auto& [first, second] = scene_.mesh.face_cells[static_cast<std::size_t>(face_[polygon])];
    const std::int32_t one = now(first), other = now(second);
    if (one >= 0 && other >= 0) return -1;
    return std::max(one, other);
}

template <int Dim>
Snapshot SnapshotMaker<Dim>::taken(std::string what, const Sight<Dim>& sight) const {
    Snapshot snapshot{.what = std::move(what), .time = sight.moment.time};
    const std::vector<Vector<Dim>> displacement = sight.vertex_displacement();
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < polygons_.vertex.size(); ++i) {
        const auto v = static_cast<std::size_t>(polygons_.vertex[i]);
        const std::int32_t now = vertex_now_[v];
        if (now < 0 || (owner_[i] >= 0 && shown_cell(static_cast<std::size_t>(owner_[i])) < 0))
            snapshot.position.push_back({none, none, none});
        else
            snapshot.position.push_back(
                in_space<Dim>(scene_.mesh.vertices[v] + displacement[static_cast<std::size_t>(now)]));
    }
    snapshot.value = values(sight);
    snapshot.obstacles = faces_of_obstacles<Dim>(sight.options->obstacles, sight.moment.time);
    return snapshot;
}

template <int Dim>
std::vector<double> SnapshotMaker<Dim>::values(const Sight<Dim>& sight) const {
    std::vector<double> result;
    for (std::size_t polygon = 0; polygon < polygons_.cell.size(); ++polygon) {
        const std::int32_t cell = shown_cell(polygon);
        const auto body = static_cast<std::size_t>(polygons_.body[polygon]);
        if (cell < 0 || (!all_rigid_ && is_rigid_[body] != 0))
            result.push_back(std::numeric_limits<double>::quiet_NaN());
        else if (all_rigid_)
            result.push_back(sight.velocity[static_cast<std::size_t>(cell)].norm());
        else
            result.push_back(von_mises<Dim>(sight.stress[static_cast<std::size_t>(cell)],
                                            sight.out_of_plane_stress[static_cast<std::size_t>(cell)]));
    }
    return result;
}

double upper_end(const std::vector<double>& values) {
    std::vector<double> finite;
    for (const double value : values)
        if (std::isfinite(value)) finite.push_back(value);
    if (finite.empty()) return 0.0;
    const auto nth = finite.begin() +
                     static_cast<std::ptrdiff_t>((1.0 - highest_left_out) * static_cast<double>(finite.size() - 1) + 0.5);
    std::ranges::nth_element(finite, nth);
    return *nth;
}

template class SnapshotMaker<2>;
template class SnapshotMaker<3>;

}  // namespace abut::run
