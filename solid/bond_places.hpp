#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/solid/attachments.hpp"
#include "abut/solid/boundary_face.hpp"

namespace abut::solid {

/// Where two faces of a bond lie on each other at rest: the middle of their overlap, a point of both sides.
template <int Dim>
struct BondPlace {
    std::size_t bond;
    std::array<BoundaryFace, 2> faces;  ///< of the mesh of all bodies
    double area;                        ///< of the overlap [m^(Dim-1)]
    Vector<Dim> position;               ///< [m]
    Vector<Dim> normal;                 ///< from the first face into the second
};

/// Of all bonds, each in the order of its first faces, then of its second ones. Throws BadInput for sides that do not exist, are
/// the same or do not lie on each other anywhere, and for a strength that is not > 0.
template <int Dim>
[[nodiscard]] std::vector<BondPlace<Dim>> find_bond_places(const mesh::Mesh<Dim>& mesh, std::span<const Bond> bonds,
                                                           std::size_t n_obstacles);

/// A side of a bond in words: body 'name' or group 'name'.
template <int Dim>
[[nodiscard]] std::string side_in_words(const mesh::Mesh<Dim>& mesh, std::int32_t side, std::size_t n_obstacles);

}  // namespace abut::solid
