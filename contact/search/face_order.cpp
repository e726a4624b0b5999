#include "abut/contact/search/face_order.hpp"

#include <algorithm>

#include "abut/geometry/broad_phase/spatial_order.hpp"

namespace abut::contact {

template <int Dim>
FaceOrder order_faces(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> middles) {
    FaceOrder order{geometry::spatial_order<Dim>(middles), {}};
    std::ranges::stable_sort(order.faces, {}, [&](std::int32_t face) { return surface.body[face]; });
    for (std::size_t i = 0; i < order.faces.size(); ++i) {
        const std::int32_t face = order.faces[i];
        const bool rigid = surface.is_rigid(face);
        if (i == 0 || surface.body[face] != surface.body[order.faces[i - 1]]) order.bodies.push_back({i, i, rigid});
        order.bodies.back().end = i + 1;
        order.bodies.back().is_rigid = order.bodies.back().is_rigid && rigid;
    }
    return order;
}

FaceOrder order_without(const FaceOrder& order, std::span<const char> left_out) {
    FaceOrder rest;
    for (const BodyFaces& body : order.bodies) {
        const std::size_t begin = rest.faces.size();
        for (std::size_t i = body.begin; i < body.end; ++i)
            if (left_out[static_cast<std::size_t>(order.faces[i])] == 0) rest.faces.push_back(order.faces[i]);
        if (rest.faces.size() > begin) rest.bodies.push_back({begin, rest.faces.size(), body.is_rigid});
    }
    return rest;
}

template FaceOrder order_faces<2>(const SurfaceView<2>&, std::span<const Vector<2>>);
template FaceOrder order_faces<3>(const SurfaceView<3>&, std::span<const Vector<3>>);

}  // namespace abut::contact
