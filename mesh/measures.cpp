#include "abut/mesh/measures.hpp"

#include "abut/geometry/box.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/mesh/local_faces.hpp"

namespace abut::mesh {
namespace {

template <int Dim>
Vector<Dim> mean_vertex(const CellSoup<Dim>& soup, std::int32_t cell) {
    const auto vertices = soup.cell_vertices[cell];
    const Vector<Dim>& first = soup.vertices[static_cast<std::size_t>(vertices[0])];
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const std::int32_t vertex : vertices) sum += soup.vertices[static_cast<std::size_t>(vertex)] - first;
    return first + sum / static_cast<double>(vertices.size());
}

}  // namespace

template <int Dim>
void measure_cell(const CellSoup<Dim>& soup, std::int32_t cell, double& measure, Vector<Dim>& centroid) {
    const Vector<Dim> origin = mean_vertex(soup, cell);
    measure = 0.0;
    Vector<Dim> moment = Vector<Dim>::Zero();
    for (int i = 0; i < n_faces(soup.cell_shape[static_cast<std::size_t>(cell)]); ++i) {
        const auto face = face_corners<Dim>(soup.vertices, local_face(soup, cell, i).view());
        const Vector<Dim> arm = geometry::face_centroid<Dim>(face.view()) - origin;
        const double cone =
            geometry::face_measure<Dim>(face.view()) * geometry::face_normal<Dim>(face.view()).dot(arm) / Dim;
        measure += cone;
        moment += cone * Dim / (Dim + 1.0) * arm;  // centroid of a cone: Dim/(Dim+1) of the way from its apex
    }
    centroid = measure != 0.0 ? Vector<Dim>(origin + moment / measure) : origin;
}

template <int Dim>
CellMeasures<Dim> measure_cells(const CellSoup<Dim>& soup) {
    const std::size_t n_cells = soup.cell_shape.size();
    CellMeasures<Dim> cells{std::vector<double>(n_cells), std::vector<Vector<Dim>>(n_cells)};
    for (std::size_t cell = 0; cell < n_cells; ++cell)
        measure_cell(soup, static_cast<std::int32_t>(cell), cells.measure[cell], cells.centroid[cell]);
    return cells;
}

template <int Dim>
void measure_faces(Mesh<Dim>& mesh) {
    const auto n_faces = static_cast<std::size_t>(mesh.face_vertices.size());
    mesh.face_measure.resize(n_faces);
    mesh.face_centroid.resize(n_faces);
    mesh.face_normal.resize(n_faces);
    for (std::size_t face = 0; face < n_faces; ++face) {
        const auto corners = face_corners<Dim>(mesh.vertices, mesh.face_vertices[static_cast<std::int32_t>(face)]);
        mesh.face_measure[face] = geometry::face_measure<Dim>(corners.view());
        mesh.face_centroid[face] = geometry::face_centroid<Dim>(corners.view());
        mesh.face_normal[face] = geometry::face_normal<Dim>(corners.view());
    }
}

template <int Dim>
double diameter(std::span<const Vector<Dim>> vertices, std::span<const std::int32_t> chosen) {
    geometry::Box<Dim> box;
    for (const std::int32_t vertex : chosen) box.extend(vertices[static_cast<std::size_t>(vertex)]);
    return (box.upper - box.lower).norm();
}

template <int Dim>
double relative_planarity(std::span<const Vector<Dim>> face) {
    if (face.size() <= Dim) return 0.0;
    const double size = face_size<Dim>(geometry::face_measure<Dim>(face));
    return size > 0.0 ? geometry::planarity_deviation<Dim>(face) / size : 0.0;
}

template void measure_cell<2>(const CellSoup<2>&, std::int32_t, double&, Vector<2>&);
template void measure_cell<3>(const CellSoup<3>&, std::int32_t, double&, Vector<3>&);
template CellMeasures<2> measure_cells<2>(const CellSoup<2>&);
template CellMeasures<3> measure_cells<3>(const CellSoup<3>&);
template void measure_faces<2>(Mesh<2>&);
template void measure_faces<3>(Mesh<3>&);
template double diameter<2>(std::span<const Vector<2>>, std::span<const std::int32_t>);
template double diameter<3>(std::span<const Vector<3>>, std::span<const std::int32_t>);
template double relative_planarity<2>(std::span<const Vector<2>>);
template double relative_planarity<3>(std::span<const Vector<3>>);

}  // namespace abut::mesh
