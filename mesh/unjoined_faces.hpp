#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Boundary faces that lie on a boundary face of another cell of their body, back to back: sides of a crack, or cells
/// that do not match along an inner surface, which does not hold together then.
struct UnjoinedFaces {
    std::int32_t n_faces = 0;
    std::string body;               ///< of the first of them; empty without any
    std::array<double, 3> place{};  ///< its centroid; in 2D the third is 0 [m]
};

/// Faces count as lying on each other up to 1e-6 of the smaller one: in the distance and the angle of their planes, and
/// in the area that they share. Cells that do not match along a curved surface have faces in other planes, and are not
/// found. `bonded`: pairs of faces of the mesh, in either order, that something else holds together.
template <int Dim>
[[nodiscard]] UnjoinedFaces find_unjoined_faces(const Mesh<Dim>& mesh,
                                                std::span<const std::array<std::int32_t, 2>> bonded = {});

}  // namespace abut::mesh
