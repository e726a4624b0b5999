#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::solid {

/// A rigid body is as many points.
template <int Dim>
inline constexpr int points_per_rigid_body = Dim + 1;

/// The points of a solid: cells of the bodies that deform, then the points of rigid bodies.
template <int Dim>
struct SolidPoints {
    const std::string& name;                 ///< of the mesh, for messages
    const mesh::Mesh<Dim>& deformable;       ///< whose cells they are
    std::span<const Vector<Dim>> rest;       ///< [m]
    std::span<const double> masses;          ///< [kg]
    std::span<const double> inverse_masses;  ///< of degrees of freedom
    std::span<const std::int32_t> body;      ///< in the mesh of all bodies
    std::vector<std::int32_t> rigid;         ///< the first point of each rigid body
};

}  // namespace abut::solid
