#pragma once
// Private to the sources of the layers.
#include <array>

#include "abut/base/option.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

inline constexpr std::array<Word<NonPlanarFaces>, 2> non_planar_words{
    {{"fail", NonPlanarFaces::fail}, {"split", NonPlanarFaces::split}}};

}  // namespace abut::mesh
