#pragma once
#include <functional>
#include <span>

#include "abut/dynamics/ranks.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::run {

/// Part of a scene that one of several ranks has, which run it together. The scene itself is the same on all of them.
template <int Dim>
struct Share {
    const mesh::Mesh<Dim>& part;   ///< of Scene::mesh (solid::part_of); an error may name cells by their labels
    const dynamics::Ranks& ranks;  ///< whose its points are (solid::points_of, ranks::PointRanks)
    /// Shares the cells out again, by weights of all points (n_points; solid::cell_weights), the same on all ranks,
    /// which call it together: RunOptions::rebalance asks for it. This share lives on until the next call. Empty: parts
    /// stay as they are.
    std::function<Share(std::span<const double> weights)> again{};
};

}  // namespace abut::run
