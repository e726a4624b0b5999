#pragma once
#include "abut/dynamics/ranks.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::run {

/// What one of several ranks has of a scene that they run together. The scene itself is the same on all of them.
template <int Dim>
struct Share {
    const mesh::Mesh<Dim>& part;   ///< mesh::MeshPart::mesh of Scene::mesh; an error may name cells by their labels
    const dynamics::Ranks& ranks;  ///< whose its cells are, ranks::PointRanks
};

}  // namespace abut::run
