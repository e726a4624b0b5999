#pragma once
#include <array>

#include "abut/base/option.hpp"

namespace abut::mesh {

/// Units that lengths of a file without units may have, each with its length [m].
inline constexpr std::array<Word<double>, 6> length_units{
    {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}}};

}  // namespace abut::mesh
