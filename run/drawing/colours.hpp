#pragma once
// Private to the sources of run.
#include <array>
#include <cstdint>

namespace abut::run {

/// Colours of values from the least to the highest, each lighter than the one before and told apart by all eyes: viridis
/// without its darkest end, which nobody sees on a dark page. Red, green, blue.
inline constexpr std::array<std::array<std::uint8_t, 3>, 9> value_colours{{{69, 55, 129},
                                                                           {57, 86, 140},
                                                                           {45, 112, 142},
                                                                           {35, 138, 141},
                                                                           {31, 163, 134},
                                                                           {61, 188, 116},
                                                                           {122, 209, 81},
                                                                           {189, 223, 38},
                                                                           {253, 231, 37}}};

}  // namespace abut::run
