#pragma once
// Private to the layer; not installed.
#include <array>
#include <cstdint>
#include <span>

#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// The vertices of one face of a cell, counter-clockwise seen from outside it.
struct LocalFace {
    std::array<std::int32_t, max_face_vertices> vertices;
    std::size_t count = 0;
    [[nodiscard]] std::span<const std::int32_t> view() const { return {vertices.data(), count}; }
};

[[nodiscard]] inline LocalFace local_face(std::span<const std::int32_t> cell_vertices, CellShape shape, int face) {
    LocalFace result{};
    for (const std::int8_t local : face_vertices(shape, face))
        result.vertices[result.count++] = cell_vertices[static_cast<std::size_t>(local)];
    return result;
}

template <int Dim>
[[nodiscard]] LocalFace local_face(const CellSoup<Dim>& soup, std::int32_t cell, int face) {
    return local_face(soup.cell_vertices[cell], soup.cell_shape[static_cast<std::size_t>(cell)], face);
}

/// Vertices of a face in increasing order, -1 behind the last: the same for both cells of the face.
using FaceKey = std::array<std::int32_t, max_face_vertices>;

[[nodiscard]] inline FaceKey face_key(std::span<const std::int32_t> vertices) {
    FaceKey key;
    key.fill(-1);
    std::size_t count = 0;
    for (const std::int32_t vertex : vertices) {
        std::size_t position = count++;
        for (; position > 0 && key[position - 1] > vertex; --position) key[position] = key[position - 1];
        key[position] = vertex;
    }
    return key;
}

}  // namespace abut::mesh
