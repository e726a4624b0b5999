#pragma once
#include <cstddef>
#include <cstdint>

namespace abut {

/// A number of ours as an index into an array of the standard library; not below 0.
[[nodiscard]] constexpr std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

}  // namespace abut
