#pragma once
#include "abut/mesh/cell_shape.hpp"
#include "mesh/meshes.hpp"

namespace abut::mesh::test {

template <int Dim>
double outward_sign(const Mesh<Dim>& mesh, std::int32_t face, std::int32_t cell) {
    return mesh.face_cells[static_cast<std::size_t>(face)][0] == cell ? 1.0 : -1.0;
}

/// The area vectors of a closed surface sum to zero, and sum_f |f| x_f (x) n_f = |c| I (divergence theorem for x).
template <int Dim>
void check_closed_cells(const Mesh<Dim>& mesh) {
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        Vector<Dim> sum = Vector<Dim>::Zero();
        Matrix<Dim> flux = Matrix<Dim>::Zero();
        double surface = 0.0;
        const auto c = static_cast<std::size_t>(cell);
        for (const std::int32_t face : mesh.cell_faces[cell]) {
            const auto f = static_cast<std::size_t>(face);
            const Vector<Dim> area = outward_sign(mesh, face, cell) * mesh.face_measure[f] * mesh.face_normal[f];
            sum += area;
            flux += (mesh.face_centroid[f] - mesh.cell_centroid[c]) * area.transpose();
            surface += mesh.face_measure[f];
        }
        REQUIRE(sum.norm() <= 1e-14 * surface);
        REQUIRE((flux - mesh.cell_measure[c] * Matrix<Dim>::Identity()).norm() <=
                1e-13 * std::pow(surface, Dim / (Dim - 1.0)));
    }
}

/// Two sides of every face, numbering and orientation as documented at Mesh.
template <int Dim>
void check_two_sides(const Mesh<Dim>& mesh) {
    std::int32_t first_of_previous = 0;
    std::vector<int> n_sides(static_cast<std::size_t>(mesh.n_faces()), 0);
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        const CellShape shape = mesh.cell_shape[static_cast<std::size_t>(cell)];
        const auto faces = mesh.cell_faces[cell];
        REQUIRE(static_cast<int>(faces.size()) == n_faces(shape));
        for (std::size_t i = 0; i < faces.size(); ++i) {
            ++n_sides[static_cast<std::size_t>(faces[i])];
            std::vector<std::int32_t> local;
            for (const auto k : face_vertices(shape, static_cast<int>(i)))
                local.push_back(mesh.cell_vertices[cell][static_cast<std::size_t>(k)]);
            const auto stored = mesh.face_vertices[faces[i]];
            REQUIRE(std::is_permutation(local.begin(), local.end(), stored.begin(), stored.end()));
        }
    }
    std::vector<std::int32_t> boundary;
    for (std::int32_t face = 0; face < mesh.n_faces(); ++face) {
        const auto f = static_cast<std::size_t>(face);
        const auto [first, second] = mesh.face_cells[f];
        REQUIRE(n_sides[f] == (second < 0 ? 1 : 2));
        REQUIRE((second < 0 || first < second));
        REQUIRE(first >= first_of_previous);
        first_of_previous = first;
        REQUIRE(mesh.face_normal[f].norm() == Approx(1.0).epsilon(1e-14));
        REQUIRE(mesh.face_normal[f].dot(mesh.face_centroid[f] - mesh.cell_centroid[static_cast<std::size_t>(first)]) > 0.0);
        if (second >= 0)
            REQUIRE(mesh.face_normal[f].dot(mesh.cell_centroid[static_cast<std::size_t>(second)] - mesh.face_centroid[f]) >
                    0.0);
        else
            boundary.push_back(face);
    }
    REQUIRE(mesh.boundary_faces == boundary);
}

}  // namespace abut::mesh::test
