#include "abut/contact/surface/unseen_edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "abut/contact/surface/ridges.hpp"

namespace abut::contact {
namespace {

struct Body {
    SharpestEdge<3> sharpest;
    bool is_rigid;
};

/// By body; those without a convex edge are left out.
std::map<std::int32_t, Body> sharpest_edges(const SurfaceView<3>& surface) {
    std::map<std::int32_t, Body> bodies;
    for (const Ridge& ridge : ridges(surface)) {
        if (!is_convex(surface, ridge)) continue;
        const std::int32_t face_1 = ridge.face_1, body = surface.body[face_1];
        const double cosine = surface.normal[face_1].dot(surface.normal[ridge.face_2]);
        const SharpestEdge<3> edge{body, std::sqrt(std::max(0.0, 0.5 * (1.0 + cosine))),
                                   0.5 * (surface.vertices[ridge.vertex_1] + surface.vertices[ridge.vertex_2])};
        const bool is_rigid = surface.is_rigid(face_1) && surface.is_rigid(ridge.face_2);
        const auto [known, is_new] = bodies.try_emplace(body, Body{edge, is_rigid});
        known->second.is_rigid = known->second.is_rigid && is_rigid;  // a body may be held at some of its faces
        if (!is_new && edge.half_angle_sine < known->second.sharpest.half_angle_sine) known->second.sharpest = edge;
    }
    return bodies;
}

}  // namespace

template <>
std::optional<EdgePair<2>> unseen_edges(const SurfaceView<2>& surface, double) {
    check_sizes(surface);
    return std::nullopt;
}

template <>
std::optional<EdgePair<3>> unseen_edges(const SurfaceView<3>& surface, double facing_cosine) {
    check_sizes(surface);
    const std::map<std::int32_t, Body> bodies = sharpest_edges(surface);
    std::optional<EdgePair<3>> worst;
    // The sharpest edge of all deformable bodies, with that of each other body.
    const auto deformable = std::ranges::min_element(bodies, {}, [](const auto& entry) {
        return std::pair(entry.second.is_rigid, entry.second.sharpest.half_angle_sine);
    });
    if (deformable == bodies.end() || deformable->second.is_rigid) return std::nullopt;
    for (const auto& [body, other] : bodies) {
        if (body == deformable->first) continue;
        const EdgePair<3> pair{deformable->second.sharpest, other.sharpest};
        if (!worst || pair.facing() < worst->facing()) worst = pair;
    }
    if (worst && worst->facing() > -facing_cosine + cosine_rounding) return std::nullopt;
    return worst;
}

}  // namespace abut::contact
