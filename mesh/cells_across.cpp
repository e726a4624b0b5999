#include "abut/mesh/cells_across.hpp"

#include <algorithm>
#include <cstddef>

namespace abut::mesh {

template <int Dim>
std::vector<int> cells_across(const Mesh<Dim>& mesh) {
    std::vector<int> across(static_cast<std::size_t>(mesh.n_bodies()), 0);
    std::vector<char> is_reached(mesh.vertices.size(), 0);
    const auto reach = [&](const auto& vertices) {
        for (const std::int32_t vertex : vertices) is_reached[static_cast<std::size_t>(vertex)] = 1;
    };
    for (const std::int32_t face : mesh.boundary_faces) reach(mesh.face_vertices[face]);
    std::vector<std::int32_t> left(static_cast<std::size_t>(mesh.n_cells()));
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) left[static_cast<std::size_t>(cell)] = cell;
    for (int layer = 1; !left.empty(); ++layer) {
        const auto touches = [&](std::int32_t cell) {
            return std::ranges::any_of(mesh.cell_vertices[cell], [&](std::int32_t vertex) {
                return is_reached[static_cast<std::size_t>(vertex)] != 0;
            });
        };
        const auto inside = std::stable_partition(left.begin(), left.end(), touches);
        if (inside == left.begin()) break;
        for (auto cell = left.begin(); cell != inside; ++cell)
            across[static_cast<std::size_t>(mesh.cell_body[*cell])] = 2 * layer;
        for (auto cell = left.begin(); cell != inside; ++cell) reach(mesh.cell_vertices[*cell]);
        left.erase(left.begin(), inside);
    }
    return across;
}

template std::vector<int> cells_across<2>(const Mesh<2>& mesh);
template std::vector<int> cells_across<3>(const Mesh<3>& mesh);

}  // namespace abut::mesh
