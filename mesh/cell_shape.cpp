#include "abut/mesh/cell_shape.hpp"

#include <array>

#include "abut/geometry/cell_faces.hpp"

namespace abut::mesh {
namespace {

constexpr std::array<std::string_view, n_cell_shapes> names = {"triangle",   "quadrangle", "tetrahedron",
                                                               "hexahedron", "prism",      "pyramid"};

const geometry::CellFaces& faces_of(CellShape shape) { return geometry::cell_faces[static_cast<std::size_t>(shape)]; }

}  // namespace

std::string_view name(CellShape shape) { return names[static_cast<std::size_t>(shape)]; }
int dimension(CellShape shape) { return faces_of(shape).dimension; }
int n_vertices(CellShape shape) { return faces_of(shape).n_corners; }
int n_faces(CellShape shape) { return faces_of(shape).n_faces; }

std::span<const std::int8_t> face_vertices(CellShape shape, int face) { return faces_of(shape).face(face); }

}  // namespace abut::mesh
