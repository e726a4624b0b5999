#pragma once
// Private to the layer; not installed.
#include <cstddef>
#include <filesystem>
#include <string>

namespace abut::mesh {

/// "the extension '.med' ..." for messages about a file whose extension no reader has: whose format it is, where that is
/// known, and the command that makes `wanted` of it, ".msh"; else that it is none of
/// `known`, "a mesh file, .msh and .vtu".
[[nodiscard]] std::string about_extension(const std::filesystem::path& path, const std::string& wanted,
                                          const std::string& known);

/// Warning of a reader that takes elements of order 2 by their corners.
[[nodiscard]] std::string about_order_2(std::size_t n_elements);

/// In small letters.
[[nodiscard]] std::string small_extension(const std::filesystem::path& path);

}  // namespace abut::mesh
