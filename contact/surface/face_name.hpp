#pragma once
// Private to the layer.
#include <cstdint>
#include <string>

#include "abut/base/messages.hpp"
#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// "face 61 (body 0, at (0.98, 0.21) m)": a host knows its faces by their position rather than by their number.
/// `shown` is the number that the host knows it by.
template <int Dim>
[[nodiscard]] std::string face_name(const SurfaceView<Dim>& surface, std::int32_t face, std::int32_t shown) {
    std::string name = "face " + std::to_string(shown) + " (body " + std::to_string(surface.body[face]) + ", at (";
    for (int i = 0; i < Dim; ++i) name += (i > 0 ? ", " : "") + number(surface.centroid[face][i]);
    return name + ") m)";
}
template <int Dim>
[[nodiscard]] std::string face_name(const SurfaceView<Dim>& surface, std::int32_t face) {
    return face_name(surface, face, face);
}

}  // namespace abut::contact
