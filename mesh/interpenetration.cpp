#include "abut/mesh/interpenetration.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "abut/base/messages.hpp"
#include "abut/geometry/convex_proximity.hpp"
#include "abut/mesh/measures.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

using geometry::Box;

/// Cells of one body and their boxes.
template <int Dim>
struct BoxedCells {
    std::vector<std::int32_t> cells;
    std::vector<Box<Dim>> boxes;
};

template <int Dim>
Box<Dim> box_of(const Mesh<Dim>& mesh, std::int32_t cell) {
    Box<Dim> box;
    for (const std::int32_t vertex : mesh.cell_vertices[cell]) box.extend(mesh.vertices[static_cast<std::size_t>(vertex)]);
    return box;
}

template <int Dim>
std::vector<Box<Dim>> boxes_of_bodies(const Mesh<Dim>& mesh) {
    std::vector<Box<Dim>> boxes(static_cast<std::size_t>(mesh.n_bodies()));
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell)
        boxes[static_cast<std::size_t>(mesh.cell_body[static_cast<std::size_t>(cell)])].extend(box_of(mesh, cell));
    return boxes;
}

/// The cells of a body that reach into a box: mostly few, where bodies meet with their sides.
template <int Dim>
BoxedCells<Dim> cells_in(const Mesh<Dim>& mesh, std::int32_t body, const Box<Dim>& region) {
    const auto of_body = std::ranges::equal_range(mesh.cell_body, body);
    BoxedCells<Dim> found;
    for (auto cell = of_body.begin() - mesh.cell_body.begin(); cell < of_body.end() - mesh.cell_body.begin(); ++cell) {
        const Box<Dim> box = box_of(mesh, static_cast<std::int32_t>(cell));
        if (!box.overlaps(region)) continue;
        found.cells.push_back(static_cast<std::int32_t>(cell));
        found.boxes.push_back(box);
    }
    return found;
}

template <int Dim>
std::vector<Vector<Dim>> corners(const Mesh<Dim>& mesh, std::int32_t cell) {
    std::vector<Vector<Dim>> points;
    for (const std::int32_t vertex : mesh.cell_vertices[cell])
        points.push_back(mesh.vertices[static_cast<std::size_t>(vertex)]);
    return points;
}

/// True if all points lie on the outer side of a face of the cell, up to `tolerance` [m]: quick, and exact for cells that
/// touch.
template <int Dim>
bool outside_of_a_face(const Mesh<Dim>& mesh, std::int32_t cell, const std::vector<Vector<Dim>>& points, double tolerance) {
    return std::ranges::any_of(mesh.cell_faces[cell], [&](std::int32_t face) {
        const auto f = static_cast<std::size_t>(face);
        const double outward = mesh.face_cells[f][0] == cell ? 1.0 : -1.0;
        return std::ranges::all_of(points, [&](const Vector<Dim>& x) {
            return outward * mesh.face_normal[f].dot(x - mesh.face_centroid[f]) >= -tolerance;
        });
    });
}

template <int Dim>
std::optional<double> overlap_depth(const Mesh<Dim>& mesh, std::int32_t cell_1, std::int32_t cell_2) {
    const double size = std::max(diameter<Dim>(mesh.vertices, mesh.cell_vertices[cell_1]),
                                 diameter<Dim>(mesh.vertices, mesh.cell_vertices[cell_2]));
    const double tolerance = touching_tolerance * size;
    const auto points_1 = corners(mesh, cell_1);
    const auto points_2 = corners(mesh, cell_2);
    if (outside_of_a_face(mesh, cell_1, points_2, tolerance) || outside_of_a_face(mesh, cell_2, points_1, tolerance))
        return std::nullopt;
    const double depth = geometry::convex_proximity<Dim>(points_1, points_2).depth;
    if (depth <= tolerance) return std::nullopt;
    return depth;
}

/// "'left' and 'right'"
template <int Dim>
std::string body_names(const Mesh<Dim>& mesh, const Interpenetration& pair) {
    return "'" + mesh.body_names[static_cast<std::size_t>(pair.bodies[0])] + "' and '" +
           mesh.body_names[static_cast<std::size_t>(pair.bodies[1])] + "'";
}

/// "17|23"
template <int Dim>
std::string cell_labels(const Mesh<Dim>& mesh, const Interpenetration& pair) {
    return std::to_string(mesh.cell_label[static_cast<std::size_t>(pair.cells[0])]) + "|" +
           std::to_string(mesh.cell_label[static_cast<std::size_t>(pair.cells[1])]);
}

}  // namespace

template <int Dim>
std::vector<Interpenetration> find_interpenetrations(const Mesh<Dim>& mesh, geometry::BroadPhase broad_phase,
                                                     IgnoredPairs ignored, InterpenetrationLimits limits) {
    const std::vector<Box<Dim>> of_bodies = boxes_of_bodies(mesh);
    std::vector<Interpenetration> found;
    for (std::int32_t body_1 = 0; body_1 < mesh.n_bodies(); ++body_1)
        for (std::int32_t body_2 = body_1 + 1; body_2 < mesh.n_bodies(); ++body_2) {
            if (std::ranges::any_of(ignored, [&](const auto& pair) {
                    return pair == std::array{body_1, body_2} || pair == std::array{body_2, body_1};
                }))
                continue;
            const Box<Dim>&box_1 = of_bodies[static_cast<std::size_t>(body_1)],
                  &box_2 = of_bodies[static_cast<std::size_t>(body_2)];
            if (!box_1.overlaps(box_2)) continue;
            const BoxedCells<Dim> part_1 = cells_in(mesh, body_1, box_2), part_2 = cells_in(mesh, body_2, box_1);
            const std::int64_t enough = std::min(limits.in_all - std::ssize(found), limits.of_two_bodies);
            const std::int64_t before = std::ssize(found);
            for (const auto& [i, k] : geometry::overlapping_pairs<Dim>({broad_phase}, part_1.boxes, part_2.boxes)) {
                if (std::ssize(found) - before >= enough) break;
                const std::array cells{part_1.cells[static_cast<std::size_t>(i)], part_2.cells[static_cast<std::size_t>(k)]};
                if (const auto depth = overlap_depth(mesh, cells[0], cells[1]))
                    found.push_back({{body_1, body_2}, cells, *depth});
            }
        }
    std::ranges::sort(found, [](const Interpenetration& a, const Interpenetration& b) {
        return std::tie(b.depth, a.cells) < std::tie(a.depth, b.cells);
    });
    return found;
}

template <int Dim>
void check_apart(const Mesh<Dim>& mesh, const std::string& remedy, geometry::BroadPhase broad_phase, IgnoredPairs ignored) {
    const auto found = find_interpenetrations(mesh, broad_phase, ignored, enough_interpenetrations);
    if (found.empty()) return;
    const Interpenetration& worst = found.front();
    const std::int64_t of_these = std::ranges::count(found, worst.bodies, &Interpenetration::bodies);
    const bool all =
        std::ssize(found) < enough_interpenetrations.in_all && of_these < enough_interpenetrations.of_two_bodies;
    throw MeshError(mesh.name + ": bodies " + body_names(mesh, worst) + " overlap at the start: cells " +
                    cell_labels(mesh, worst) + " are " + number(worst.depth) + " m inside each other, 0 m is allowed (" +
                    std::to_string(found.size()) +
                    (found.size() == 1 ? " pair of cells overlaps"
                     : all             ? " pairs of cells overlap, this one is the deepest"
                           : " pairs of cells or more overlap, this one is the deepest of those that were looked at") +
                    "). " + remedy);
}

#define ABUT_INSTANTIATE(Dim)                                                                                  \
    template std::vector<Interpenetration> find_interpenetrations<Dim>(const Mesh<Dim>&, geometry::BroadPhase, \
                                                                       IgnoredPairs, InterpenetrationLimits);  \
    template void check_apart<Dim>(const Mesh<Dim>&, const std::string&, geometry::BroadPhase, IgnoredPairs);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::mesh
