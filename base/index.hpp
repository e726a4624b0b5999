#pragma once
#include <cstddef>
#include <cstdint>

namespace abut {

/// Where in an array of the standard library the thing of this number is.
[[nodiscard]] constexpr std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

}  // namespace abut
