#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// Faces that share vertices, as views of a host's own arrays. Nothing is promised about them: indices may lie out of range,
/// coordinates be no numbers, faces be degenerate. Only the offsets must rise from 0 to the size of `face_vertices`.
struct FaceSoup {
    std::span<const Vector<3>> vertices;          ///< [m]
    std::span<const std::int32_t> face_offsets;   ///< (n + 1), into face_vertices; or empty: no face
    std::span<const std::int32_t> face_vertices;  ///< counter-clockwise seen from outside

    [[nodiscard]] std::int32_t size() const {
        return face_offsets.empty() ? 0 : static_cast<std::int32_t>(face_offsets.size()) - 1;
    }
    [[nodiscard]] std::span<const std::int32_t> vertices_of(std::int32_t face) const {
        const std::int32_t first = face_offsets[static_cast<std::size_t>(face)];
        return face_vertices.subspan(static_cast<std::size_t>(first),
                                     static_cast<std::size_t>(face_offsets[static_cast<std::size_t>(face) + 1] - first));
    }
};

/// Throws BadInput if `face_offsets` does not rise from 0 to the size of `face_vertices`, or if there are more
/// than 2^31 - 1 vertices.
void check_offsets(const FaceSoup& soup);

}  // namespace abut::geometry
