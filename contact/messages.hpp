#pragma once
// Private to the layer.
#include <cstdint>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/contact/step.hpp"
#include "abut/contact/surface.hpp"

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

/// Error for a pair that is pressed in deeper than a host allows.
template <int Dim>
[[nodiscard]] TooDeep too_deep(const std::string& face_1, const std::string& face_2, const PairStep<Dim>& pair,
                               double limit) {
    return TooDeep(
        "contact: " + face_1 + " and " + face_2 + " are pressed " + number(pair.compression) +
            " times the depth of their cells into each other, " + number(limit) +
            " is allowed (compression_limit). Refine the mesh at the contact, or lower the speed or the load.",
        {.face_1 = number_of(pair.face_1), .face_2 = number_of(pair.face_2), .value = pair.compression, .allowed = limit});
}

}  // namespace abut::contact
