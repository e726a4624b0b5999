#pragma once
// Private to the sources of run.
#include <cstddef>
#include <cstdint>
#include <string>

#include "abut/run/scene.hpp"

namespace abut::run {

/// The name of an obstacle of the scene; "obstacle_0" where it has none.
template <int Dim>
[[nodiscard]] std::string name_of_obstacle(const Scene<Dim>& scene, std::size_t obstacle);

/// A body or, counted behind the bodies, an obstacle as messages call it: "'left'", "obstacle 'floor'".
template <int Dim>
[[nodiscard]] std::string quoted_name(const Scene<Dim>& scene, std::int32_t body);

/// A side that a law of friction acts on (solid::BodyFriction): a body or an obstacle as above, or a group of faces,
/// "'left.xmin'".
template <int Dim>
[[nodiscard]] std::string quoted_side(const Scene<Dim>& scene, std::int32_t side);

}  // namespace abut::run
