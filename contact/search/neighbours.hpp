#pragma once
// Private to the layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// Which faces are neighbours on their surface: those with a common corner, up to a number of steps. Corners at exactly the
/// same position are common, whatever their numbers.
class Neighbours {
public:
    /// `rings` >= 1.
    template <int Dim>
    Neighbours(const SurfaceView<Dim>& surface, int rings);

    [[nodiscard]] bool operator()(std::int32_t face_1, std::int32_t face_2) const;

private:
    [[nodiscard]] std::span<const std::int32_t> corners_of(std::int32_t face) const;
    [[nodiscard]] std::span<const std::int32_t> faces_at(std::int32_t corner) const;
    [[nodiscard]] bool share_a_corner(std::int32_t face_1, std::int32_t face_2) const;

    int rings_;
    std::vector<std::int32_t> face_offsets_;
    std::vector<std::int32_t> corners_;  // of each face, as merged vertices
    std::vector<std::int32_t> corner_offsets_;
    std::vector<std::int32_t> faces_;  // at each corner
};

}  // namespace abut::contact
