#pragma once
// Private to the layer; not installed.
#include <cstddef>
#include <string>
#include <string_view>

namespace abut::mesh {

/// How many bytes can come out of one at most: deflate writes 258 bytes for 2 bits.
inline constexpr std::size_t largest_zlib_ratio = 1032;

/// Bytes as an array of a VTK file holds them: the number of blocks, their size before compression and that of the last
/// one if it is not full, the size of each block as it is stored (each a UInt32 in this machine's order of bytes), then
/// the blocks, compressed by zlib. Blocks are compressed concurrently; the result does not depend on the number of
/// threads.
[[nodiscard]] std::string zlib_blocks(std::string_view bytes);

/// Appends the `n` bytes that a block of zlib's holds; false if it holds anything else.
[[nodiscard]] bool append_inflated(std::string& bytes, std::string_view block, std::size_t n);

/// The first n bytes of what is written in base64; fewer where it ends.
[[nodiscard]] std::string from_base64(std::string_view text, std::size_t n);

}  // namespace abut::mesh
