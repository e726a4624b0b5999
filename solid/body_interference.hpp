#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/options/options.hpp"

namespace abut::solid {

/// Pairs of bodies and obstacles, as in SolidOptions::ignored_pairs, of which faces overlap on purpose and not all of
/// the overlap acts at `time` [s] yet; by default all that overlap at the start. `n_obstacles` of the scene. On several
/// ranks `mesh` must be the whole one.
template <int Dim>
[[nodiscard]] std::vector<std::array<std::int32_t, 2>> overlapping_bodies(
    const mesh::Mesh<Dim>& mesh, std::span<const BodyInterference> interference, std::size_t n_obstacles,
    double time = -std::numeric_limits<double>::infinity());

}  // namespace abut::solid
