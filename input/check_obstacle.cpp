#include "abut/input/check_obstacle.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "abut/contact/surface/obstacle_side.hpp"
#include "abut/geometry/box.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/geometry/convex_proximity.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/input/values.hpp"
#include "abut/mesh/interpenetration.hpp"

namespace abut::input {
namespace {

using geometry::Box;
template <int Dim>
using Points = std::vector<Vector<Dim>>;

template <int Dim>
std::vector<Points<Dim>> faces_at_start(const contact::RigidObstacle<Dim>& obstacle) {
    const contact::Placement<Dim> placement = contact::placement_at(obstacle, 0.0);
    std::vector<Points<Dim>> faces = obstacle.faces;
    for (Points<Dim>& face : faces)
        for (Vector<Dim>& corner : face) corner = placement(corner);
    return faces;
}

template <int Dim>
Box<Dim> box_of(std::span<const Vector<Dim>> points) {
    Box<Dim> box;
    for (const Vector<Dim>& point : points) box.extend(point);
    return box;
}

template <int Dim>
Points<Dim> corners_of(const mesh::Mesh<Dim>& mesh, std::int32_t cell) {
    Points<Dim> corners;
    for (const std::int32_t vertex : mesh.cell_vertices[cell]) corners.push_back(mesh.vertices[vertex]);
    return corners;
}

/// Whether a plane through one of the faces of the cell, or that of the face, has the two on different sides, up to the
/// tolerance [m].
template <int Dim>
bool parted_by_a_plane(const mesh::Mesh<Dim>& mesh, std::int32_t cell, const Points<Dim>& corners, const Points<Dim>& face,
                       double tolerance) {
    const Vector<Dim> normal = geometry::face_normal<Dim>(face);
    const auto height = [&](const Vector<Dim>& x) { return normal.dot(x - face.front()); };
    if (std::ranges::all_of(corners, [&](const auto& x) { return height(x) >= -tolerance; }) ||
        std::ranges::all_of(corners, [&](const auto& x) { return height(x) <= tolerance; }))
        return true;
    return std::ranges::any_of(mesh.cell_faces[cell], [&](std::int32_t f) {
        const double outward = mesh.face_cells[f][0] == cell ? 1.0 : -1.0;
        return std::ranges::all_of(face, [&](const Vector<Dim>& x) {
            return outward * mesh.face_normal[f].dot(x - mesh.face_centroid[f]) >= -tolerance;
        });
    });
}

/// By how much a face is inside a cell, 0 if it is not [m].
template <int Dim>
double depth_in_cell(const mesh::Mesh<Dim>& mesh, std::int32_t cell, const Points<Dim>& face) {
    const Points<Dim> corners = corners_of(mesh, cell);
    const Box<Dim> box = box_of<Dim>(corners);
    const double tolerance = mesh::touching_tolerance * (box.upper - box.lower).norm();
    if (parted_by_a_plane(mesh, cell, corners, face, tolerance)) return 0.0;
    const double depth = geometry::convex_proximity<Dim>(corners, face).depth;
    return depth > tolerance ? depth : 0.0;
}

/// The deepest that a face is inside a cell, by body (n_bodies) [m]; of the first hundred pairs of a body that overlap.
template <int Dim>
std::vector<double> depths(const mesh::Mesh<Dim>& mesh, const std::vector<Points<Dim>>& faces) {
    std::vector<Box<Dim>> of_cells, of_faces;
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) of_cells.push_back(box_of<Dim>(corners_of(mesh, cell)));
    for (const Points<Dim>& face : faces) of_faces.push_back(box_of<Dim>(face));
    std::vector<double> depths(mesh.body_names.size(), 0.0);
    std::vector<std::int64_t> found(depths.size(), 0);
    for (const auto& [cell, face] : geometry::overlapping_pairs<Dim>({}, of_cells, of_faces)) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[cell]);
        if (found[body] >= mesh::enough_interpenetrations.of_two_bodies) continue;
        const double depth = depth_in_cell(mesh, cell, faces[static_cast<std::size_t>(face)]);
        depths[body] = std::max(depths[body], depth);
        if (depth > 0.0) ++found[body];
    }
    return depths;
}

/// The angle that a face is seen under over the full one, > 0 from behind.
double share_of_sight(const Points<2>& face, const Vector<2>& from) {
    const Vector<2> a = face[0] - from, b = face[1] - from;
    return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) / (2.0 * std::numbers::pi);
}

/// Van Oosterom and Strackee (1983), for the triangles of a fan.
double share_of_sight(const Points<3>& face, const Vector<3>& from) {
    double angle = 0.0;
    const Vector<3> a = face[0] - from;
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        const Vector<3> b = face[i] - from, c = face[i + 1] - from;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        angle += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return angle / (4.0 * std::numbers::pi);
}

/// Whether a closed obstacle is around a point; of one that is turned inside out, whether it is in the solid around the
/// room.
template <int Dim>
bool is_in_solid(const std::vector<Points<Dim>>& faces, const Vector<Dim>& point, bool room) {
    double turns = 0.0;  // +1 inside of faces that look outwards
    for (const Points<Dim>& face : faces) turns += share_of_sight(face, point);
    return room ? turns > -0.5 : turns > 0.5;
}

/// From where to where a body reaches over the plane of a face [m].
struct Heights {
    double highest = -std::numeric_limits<double>::infinity();
    double lowest = 0.0;  ///< 0 where it is in front

    /// Both as far as they can be told from rounding.
    [[nodiscard]] bool are_behind() const { return highest <= -mesh::touching_tolerance * lowest && lowest < 0.0; }
    [[nodiscard]] bool are_on_both_sides() const {
        return highest > -mesh::touching_tolerance * lowest && highest > 0.0 && lowest < -mesh::touching_tolerance * highest;
    }
};

template <int Dim>
std::vector<Heights> heights_over(const mesh::Mesh<Dim>& mesh, const Points<Dim>& face) {
    const Vector<Dim> normal = geometry::face_normal<Dim>(face), foot = face.front();
    std::vector<Heights> heights(mesh.body_names.size());
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell)
        for (const std::int32_t vertex : mesh.cell_vertices[cell]) {
            Heights& of_body = heights[static_cast<std::size_t>(mesh.cell_body[cell])];
            const double height = normal.dot(mesh.vertices[vertex] - foot);
            of_body.highest = std::max(of_body.highest, height);
            of_body.lowest = std::min(of_body.lowest, height);
        }
    return heights;
}

/// The first cell of each body.
template <int Dim>
std::vector<std::int32_t> first_cells(const mesh::Mesh<Dim>& mesh) {
    std::vector<std::int32_t> first;
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell)
        if (static_cast<std::size_t>(mesh.cell_body[cell]) == first.size()) first.push_back(cell);
    return first;
}

}  // namespace

template <int Dim>
void check_outside(const mesh::Mesh<Dim>& mesh, const contact::RigidObstacle<Dim>& obstacle, const ObstacleTable& table,
                   mesh::IgnoredPairs ignored, std::vector<Fault>& faults) {
    const std::vector<Points<Dim>> faces = faces_at_start(obstacle);
    const std::vector<double> depth = depths(mesh, faces);
    const std::vector<std::int32_t> cells = first_cells(mesh);
    const auto fault = [&](std::size_t body, const std::string& what) {
        faults.push_back({table.settings.where,
                          fmt::format("obstacle '{}' and body '{}' overlap at the start: {}. Move one of them with place.",
                                      table.settings.name, mesh.body_names[body], what)});
    };
    const auto is_ignored = [&](std::size_t body) {
        const auto b = static_cast<std::int32_t>(body);
        return std::ranges::any_of(ignored, [&](const auto& pair) {
            return pair == std::array{b, table.number} || pair == std::array{table.number, b};
        });
    };
    const bool stands_still = !obstacle.path && !obstacle.placement;
    const std::vector<Heights> heights =
        table.endless ? heights_over(mesh, faces.front()) : std::vector<Heights>(depth.size());
    for (std::size_t body = 0; body < depth.size(); ++body)
        if (is_ignored(body))
            continue;
        else if (depth[body] > 0.0)
            fault(body, fmt::format("a face of the obstacle is {:.6g} m inside a cell, 0 m is allowed", depth[body]));
        else if (heights[body].are_on_both_sides())  // between its cells, none of which it cuts
            fault(body, fmt::format("the body reaches {:.6g} m behind the plane, 0 m is allowed", -heights[body].lowest));
        else if (stands_still && heights[body].are_behind())
            faults.push_back(
                {table.settings.where,
                 fmt::format(
                     "body '{}' is behind obstacle '{}', where nothing touches it: contact acts on the side that its "
                     "normal points to. Give normal = [{:g}], or let the two pass through each other "
                     "(ignored_pairs in [contact]).",
                     mesh.body_names[body], table.settings.name,
                     fmt::join(Vector<Dim>(-head<Dim>(table.settings.normal) + Vector<Dim>::Zero()), ", "))});
        else if (table.closed && is_in_solid<Dim>(faces, mesh.cell_centroid[cells[body]], table.settings.inside))
            fault(body, table.settings.inside ? "the whole body is outside of its room" : "the whole body is inside of it");
}

template void check_outside<2>(const mesh::Mesh<2>&, const contact::RigidObstacle<2>&, const ObstacleTable&,
                               mesh::IgnoredPairs, std::vector<Fault>&);
template void check_outside<3>(const mesh::Mesh<3>&, const contact::RigidObstacle<3>&, const ObstacleTable&,
                               mesh::IgnoredPairs, std::vector<Fault>&);

}  // namespace abut::input
