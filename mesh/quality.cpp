#include "abut/mesh/quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "abut/mesh/measures.hpp"

namespace abut::mesh {
namespace {

template <int Dim>
double longest_edge(const Mesh<Dim>& mesh, std::int32_t cell) {
    double longest = 0.0;
    for (const std::int32_t face : mesh.cell_faces[cell]) {
        const auto corners = face_corners<Dim>(mesh.vertices, mesh.face_vertices[face]);
        for (std::size_t i = 0; i < corners.count; ++i)
            longest = std::max(longest, (corners.points[(i + 1) % corners.count] - corners.points[i]).norm());
    }
    return longest;
}

/// Longest edge over Dim |c| / sum |f| when all edges are equal (and all angles, where the shape allows it).
double ideal_aspect_ratio(CellShape shape) {
    switch (shape) {
        case CellShape::triangle:
            return 2.0 * std::sqrt(3.0);
        case CellShape::quadrangle:
            return 2.0;
        case CellShape::tetrahedron:
            return 2.0 * std::sqrt(6.0);
        case CellShape::hexahedron:
            return 2.0;
        case CellShape::prism:
            return 2.0 / 3.0 + 4.0 / std::sqrt(3.0);
        case CellShape::pyramid:
            break;
    }
    return std::sqrt(2.0) * (1.0 + std::sqrt(3.0));
}

template <int Dim>
double inradius(const Mesh<Dim>& mesh, std::int32_t cell) {
    double surface = 0.0;
    for (const std::int32_t face : mesh.cell_faces[cell]) surface += mesh.face_measure[static_cast<std::size_t>(face)];
    return Dim * mesh.cell_measure[static_cast<std::size_t>(cell)] / surface;
}

}  // namespace

template <int Dim>
MeshQuality quality(const Mesh<Dim>& mesh) {
    const double infinity = std::numeric_limits<double>::infinity();
    MeshQuality result{infinity, 0.0, -1, 0.0, -1, infinity, {}, mesh.report};
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        const auto c = static_cast<std::size_t>(cell);
        const double radius = inradius(mesh, cell);
        const double aspect = longest_edge(mesh, cell) / (radius * ideal_aspect_ratio(mesh.cell_shape[c]));
        if (mesh.cell_measure[c] < result.smallest_measure) {
            result.smallest_measure = mesh.cell_measure[c];
            result.smallest_cell = cell;
        }
        if (aspect > result.worst_aspect_ratio) {
            result.worst_aspect_ratio = aspect;
            result.worst_cell = cell;
        }
        result.largest_measure = std::max(result.largest_measure, mesh.cell_measure[c]);
        result.smallest_inradius = std::min(result.smallest_inradius, radius);
        ++result.n_cells_of[static_cast<std::size_t>(mesh.cell_shape[c])];
    }
    return result;
}

template MeshQuality quality<2>(const Mesh<2>&);
template MeshQuality quality<3>(const Mesh<3>&);

}  // namespace abut::mesh
