#pragma once
// Private to the layer; not installed.
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// The corners of one face, in the order that makes its area vector point outwards.
template <int Dim>
struct FaceCorners {
    std::array<Vector<Dim>, max_face_vertices> points;
    std::size_t count = 0;
    [[nodiscard]] std::span<const Vector<Dim>> view() const { return {points.data(), count}; }
};

template <int Dim>
[[nodiscard]] FaceCorners<Dim> face_corners(std::span<const Vector<Dim>> vertices, std::span<const std::int32_t> face) {
    FaceCorners<Dim> corners;
    for (const std::int32_t vertex : face) corners.points[corners.count++] = vertices[static_cast<std::size_t>(vertex)];
    return corners;
}

/// Measures |c| [m^Dim], negative for a cell inside out, and centroids x_c [m] of all cells. With o the mean of the
/// vertices, |c| = sum_f |f| n_f . (x_f - o) / Dim: exact for plane faces, convex or not.
template <int Dim>
struct CellMeasures {
    std::vector<double> measure;
    std::vector<Vector<Dim>> centroid;
};
template <int Dim>
[[nodiscard]] CellMeasures<Dim> measure_cells(const CellSoup<Dim>& soup);
/// Measure and centroid of one cell.
template <int Dim>
void measure_cell(const CellSoup<Dim>& soup, std::int32_t cell, double& measure, Vector<Dim>& centroid);

/// Fills face_measure, face_centroid and face_normal from vertices and face_vertices.
template <int Dim>
void measure_faces(Mesh<Dim>& mesh);

/// Length of the diagonal of the axis-aligned box around some vertices [m].
template <int Dim>
[[nodiscard]] double diameter(std::span<const Vector<Dim>> vertices, std::span<const std::int32_t> chosen);

/// |f|^(1/(Dim-1)) [m].
template <int Dim>
[[nodiscard]] double face_size(double measure) {
    return Dim == 3 ? std::sqrt(measure) : measure;
}

/// Largest distance of a vertex from the plane of its face over the face size [-]; 0 without measure.
template <int Dim>
[[nodiscard]] double relative_planarity(std::span<const Vector<Dim>> face);

}  // namespace abut::mesh
