#pragma once
#include <cstdint>

namespace abut::mesh {

/// Strong index types: a cell number can never be used as a face number.
enum class CellId : std::int32_t {};
enum class FaceId : std::int32_t {};
enum class VertexId : std::int32_t {};
enum class BodyId : std::int32_t {};

template <class Id>
[[nodiscard]] constexpr std::int32_t index(Id id) {
    return static_cast<std::int32_t>(id);
}

}  // namespace abut::mesh
