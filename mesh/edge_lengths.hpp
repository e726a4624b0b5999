#pragma once
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Lengths of the edges of a body [m]; the mean has each edge as often as a face has it.
struct EdgeLengths {
    double least = 0.0, mean = 0.0, largest = 0.0;
};
/// Edges of the cells of each body (n_bodies); in the plane these are the faces.
template <int Dim>
[[nodiscard]] std::vector<EdgeLengths> edge_lengths(const Mesh<Dim>& mesh);

}  // namespace abut::mesh
