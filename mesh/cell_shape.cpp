#include "abut/mesh/cell_shape.hpp"

#include <array>

namespace abut::mesh {
namespace {

struct Description {
    std::string_view name;
    int dimension;
    int n_vertices;
    int n_faces;
    std::array<std::array<std::int8_t, max_face_vertices>, 6> faces;  // -1 fills up
};

constexpr std::array<Description, n_cell_shapes> descriptions = {{
    {"triangle", 2, 3, 3, {{{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 0, -1, -1}}}},
    {"quadrangle", 2, 4, 4, {{{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 3, -1, -1}, {3, 0, -1, -1}}}},
    {"tetrahedron", 3, 4, 4, {{{0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}, {0, 2, 1, -1}}}},
    {"hexahedron", 3, 8, 6, {{{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}}},
    {"prism", 3, 6, 5, {{{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}},
    {"pyramid", 3, 5, 5, {{{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}}},
}};

const Description& describe(CellShape shape) { return descriptions[static_cast<std::size_t>(shape)]; }

}  // namespace

std::string_view name(CellShape shape) { return describe(shape).name; }
int dimension(CellShape shape) { return describe(shape).dimension; }
int n_vertices(CellShape shape) { return describe(shape).n_vertices; }
int n_faces(CellShape shape) { return describe(shape).n_faces; }

std::span<const std::int8_t> face_vertices(CellShape shape, int face) {
    const auto& vertices = describe(shape).faces[static_cast<std::size_t>(face)];
    std::size_t count = 2;
    while (count < vertices.size() && vertices[count] >= 0) ++count;
    return {vertices.data(), count};
}

}  // namespace abut::mesh
