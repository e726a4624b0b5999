#include "abut/mesh/edge_lengths.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace abut::mesh {
namespace {

/// Lengths of one body, while edges are added.
struct Sums {
    EdgeLengths found;
    std::int64_t count = 0;

    void add(double length) {
        found.least = count == 0 ? length : std::min(found.least, length);
        found.largest = std::max(found.largest, length);
        found.mean += (length - found.mean) / static_cast<double>(++count);
    }
};

}  // namespace

template <int Dim>
std::vector<EdgeLengths> edge_lengths(const Mesh<Dim>& mesh) {
    std::vector<Sums> sums(static_cast<std::size_t>(mesh.n_bodies()));
    for (std::int32_t face = 0; face < mesh.n_faces(); ++face) {
        const std::span<const std::int32_t> corners = mesh.face_vertices[face];
        Sums& body = sums[static_cast<std::size_t>(mesh.cell_body[mesh.face_cells[face][0]])];
        const std::size_t n_edges = Dim == 2 ? 1 : corners.size();
        for (std::size_t i = 0; i < n_edges; ++i)
            body.add((mesh.vertices[corners[(i + 1) % corners.size()]] - mesh.vertices[corners[i]]).norm());
    }
    std::vector<EdgeLengths> lengths;
    for (const Sums& of_body : sums) lengths.push_back(of_body.found);
    return lengths;
}

template std::vector<EdgeLengths> edge_lengths<2>(const Mesh<2>& mesh);
template std::vector<EdgeLengths> edge_lengths<3>(const Mesh<3>& mesh);

}  // namespace abut::mesh
