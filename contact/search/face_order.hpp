#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// Faces of one body.
struct BodyFaces {
    std::size_t begin;  ///< in FaceOrder::faces
    std::size_t end;
    bool is_rigid;  ///< all of them are
};

/// All faces in the order of a search: body by body, those of a body in spatial order.
struct FaceOrder {
    std::vector<std::int32_t> faces;
    std::vector<BodyFaces> bodies;

    [[nodiscard]] std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(faces.size()); }
};

/// `middles` (n): where each face is.
template <int Dim>
[[nodiscard]] FaceOrder order_faces(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> middles);

/// Without the faces whose entry in `left_out` (n) is not 0, and without bodies that have no other ones.
[[nodiscard]] FaceOrder order_without(const FaceOrder& order, std::span<const char> left_out);

}  // namespace abut::contact
