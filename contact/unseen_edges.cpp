#include "abut/contact/unseen_edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "abut/geometry/merged_vertices.hpp"

namespace abut::contact {
namespace {

constexpr double rounding = 1e-9;  // of cosines: edges of just the limiting angle are unseen

/// One side of an edge: the face that has it.
struct HalfEdge {
    std::int32_t lower, upper;  // merged vertices of its ends
    std::int32_t body;
    std::int32_t face;

    [[nodiscard]] auto edge() const { return std::tie(lower, upper, body); }
};

std::vector<HalfEdge> half_edges(const SurfaceView<3>& surface) {
    const std::vector<std::int32_t> merged = geometry::merged_vertices<3>(surface.vertices);
    std::vector<HalfEdge> all;
    all.reserve(surface.face_vertices.size());
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        const auto corners = surface.vertices_of(face);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::int32_t a = merged[static_cast<std::size_t>(corners[i])];
            const std::int32_t b = merged[static_cast<std::size_t>(corners[(i + 1) % corners.size()])];
            all.push_back({std::min(a, b), std::max(a, b), surface.body[face], face});
        }
    }
    std::ranges::sort(all, {}, [](const HalfEdge& half) { return std::tie(half.lower, half.upper, half.body, half.face); });
    return all;
}

struct Body {
    SharpEdge<3> sharpest;
    bool is_rigid;
};

/// By body; those without a convex edge are left out.
std::map<std::int32_t, Body> sharpest_edges(const SurfaceView<3>& surface) {
    const std::vector<HalfEdge> all = half_edges(surface);
    std::map<std::int32_t, Body> bodies;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
        while (end < all.size() && all[end].edge() == all[begin].edge()) ++end;
        if (end - begin != 2) continue;
        const std::int32_t face_1 = all[begin].face, face_2 = all[begin + 1].face, body = all[begin].body;
        const Vector<3>&n_1 = surface.normal[face_1], &n_2 = surface.normal[face_2];
        if ((surface.centroid[face_2] - surface.centroid[face_1]).dot(n_1 - n_2) >= 0.0) continue;  // not convex
        const SharpEdge<3> edge{body, std::sqrt(std::max(0.0, 0.5 * (1.0 + n_1.dot(n_2)))),
                                0.5 * (surface.vertices[all[begin].lower] + surface.vertices[all[begin].upper])};
        const auto [known, is_new] = bodies.try_emplace(body, Body{edge, surface.is_rigid(face_1)});
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
    if (worst && worst->facing() > -facing_cosine + rounding) return std::nullopt;
    return worst;
}

}  // namespace abut::contact
