#pragma once
// Private to the layer; not installed.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace abut::mesh {

enum class ByteOrder { little, big };

/// The value whose bytes begin at `position`; they must all be there.
template <class Value>
[[nodiscard]] Value binary_value(std::string_view bytes, std::size_t position, ByteOrder order) {
    std::array<char, sizeof(Value)> raw;
    std::memcpy(raw.data(), bytes.data() + position, raw.size());
    if ((order == ByteOrder::little) != (std::endian::native == std::endian::little)) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Value>(raw);
}

}  // namespace abut::mesh
