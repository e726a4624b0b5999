#pragma once
#include <catch2/catch.hpp>

#include <array>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/shapes.hpp"

namespace abut::mesh::test {

inline constexpr std::array<CellShape, 2> shapes_2d = {CellShape::triangle, CellShape::quadrangle};
inline constexpr std::array<CellShape, 4> shapes_3d = {CellShape::tetrahedron, CellShape::hexahedron, CellShape::prism,
                                                       CellShape::pyramid};

/// The box (0,0,0) .. (2,1,3), in 4 x 3 x 5 bricks of unequal sides.
inline Mesh<2> small_box(CellShape shape, const MeshOptions& options = {}, const Vector<2>& at = {0, 0}) {
    return structured_box<2>(at, at + Vector<2>(2, 1), {4, 3}, shape, "box", options);
}
inline Mesh<3> small_box_3d(CellShape shape, const MeshOptions& options = {}, const Vector<3>& at = {0, 0, 0}) {
    return structured_box<3>(at, at + Vector<3>(2, 1, 3), {4, 3, 5}, shape, "box", options);
}

template <int Dim>
double total_measure(const Mesh<Dim>& mesh) {
    return std::accumulate(mesh.cell_measure.begin(), mesh.cell_measure.end(), 0.0);
}

/// What the mesh was built from, in the mesh's own order.
template <int Dim>
CellSoup<Dim> soup_of(const Mesh<Dim>& mesh) {
    CellSoup<Dim> soup;
    soup.name = mesh.name;
    soup.vertices = mesh.vertices;
    soup.cell_shape = mesh.cell_shape;
    soup.cell_vertices = mesh.cell_vertices;
    soup.cell_body = mesh.cell_body;
    soup.body_names = mesh.body_names;
    for (const auto& group : mesh.groups) {
        for (const std::int32_t face : group.faces) {
            const auto vertices = mesh.face_vertices[face];
            soup.named_faces.push_back(
                {{vertices.begin(), vertices.end()}, static_cast<std::int32_t>(soup.group_names.size())});
        }
        soup.group_names.push_back(group.name);
    }
    return soup;
}

/// One cell of each 3D shape, or of each 2D shape, on the unit lattice.
inline std::vector<Vector<3>> corners_of(CellShape shape) {
    switch (shape) {
        case CellShape::tetrahedron:
            return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        case CellShape::prism:
            return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
        case CellShape::pyramid:
            return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
        default:
            return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    }
}

template <int Dim>
CellSoup<Dim> one_cell(CellShape shape, const std::vector<Vector<Dim>>& corners) {
    CellSoup<Dim> soup;
    soup.name = "one.msh";
    soup.vertices = corners;
    soup.cell_shape = {shape};
    std::vector<std::int32_t> vertices(corners.size());
    std::iota(vertices.begin(), vertices.end(), 0);
    soup.cell_vertices.append(vertices);
    soup.cell_body = {0};
    soup.body_names = {"body"};
    return soup;
}

template <class Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

template <int Dim>
bool same_bits(const Mesh<Dim>& a, const Mesh<Dim>& b) {
    return same_bits(a.vertices, b.vertices) && a.cell_vertices.values == b.cell_vertices.values &&
           a.cell_faces.values == b.cell_faces.values && a.face_vertices.values == b.face_vertices.values &&
           a.face_cells == b.face_cells && same_bits(a.cell_measure, b.cell_measure) &&
           same_bits(a.cell_centroid, b.cell_centroid) && same_bits(a.face_measure, b.face_measure) &&
           same_bits(a.face_normal, b.face_normal) && same_bits(a.face_centroid, b.face_centroid);
}

/// A folder of its own that is gone at the end of the test.
class ScratchFolder {
public:
    ScratchFolder() {
        std::random_device random;
        path_ = std::filesystem::temp_directory_path() /
                ("abut_test_mesh_" + std::to_string(random()) + std::to_string(random()));
        std::filesystem::create_directories(path_);
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace abut::mesh::test
