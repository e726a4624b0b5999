#pragma once
// Private to the layer; not installed.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abut::mesh {

/// char, uchar, short, ushort, int, uint, float, double; also called int8, uint8, ..., float64.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] std::size_t n_bytes_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type;                         ///< of the value, or of those in the list
    std::optional<PlyType> count_type{};  ///< of a list
};

struct PlyElement {
    std::string name;
    std::int64_t n_items;
    std::size_t line;  ///< of the header
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    enum class Format { ascii, binary_little, binary_big };
    Format format;
    std::vector<PlyElement> elements;
    std::size_t n_bytes;  ///< of the header, with the end of its last line
    std::size_t n_lines;
};

/// The header of a PLY file, whose number of items fit into the bytes behind it: a value takes 2 bytes as text and those of
/// its type in binary. Throws MeshError naming the file, the line, what is wrong and what to do.
[[nodiscard]] PlyHeader read_ply_header(const std::string& name, std::string_view contents);

}  // namespace abut::mesh
