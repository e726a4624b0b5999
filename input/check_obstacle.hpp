#pragma once
// Private to the layer.
#include <vector>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/input/fault.hpp"
#include "abut/input/settings.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::input {

/// An obstacle as its table has it.
struct ObstacleTable {
    const ObstacleSettings& settings;
    bool closed;          ///< its faces have an inside
    bool endless;         ///< it is a plane without a half width
    std::int32_t number;  ///< as a body behind those of the mesh
};

/// A fault for each body that is not ignored and that an obstacle, where it is at the start, cuts or has wholly inside of
/// it. A surface that is not closed has no inside: a body that is wholly behind a plane does not overlap it, but where the
/// plane has no end and stands still nothing can ever bring it in front, and it gets a fault, too.
template <int Dim>
void check_outside(const mesh::Mesh<Dim>& mesh, const contact::RigidObstacle<Dim>& obstacle, const ObstacleTable& table,
                   mesh::IgnoredPairs ignored, std::vector<Fault>& faults);

}  // namespace abut::input
