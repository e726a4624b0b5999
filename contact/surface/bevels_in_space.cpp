// Bevels of the edges and corners of bodies in space.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "abut/contact/surface/bevel_shape.hpp"
#include "abut/contact/surface/bevels.hpp"
#include "abut/contact/surface/ridges.hpp"
#include "abut/geometry/merged_vertices.hpp"

namespace abut::contact {
namespace {

/// n . q of the facets around a corner with the axis q, below which a flat face that comes along q is faced by none enough.
constexpr double enough_for_corners = 0.4;
constexpr double corner_stiffening = 4.0;
/// Mean of the unit vectors along the edges from a corner, from which these make a spike.
constexpr double least_spike = 0.5;
/// The bevel of an edge whose bisector is as near to the axis of its end stands for that corner: 26 degrees.
constexpr double near_axis = 0.9;

struct Edge {
    Ridge ridge;
    double half_sine;  // of the inner angle
};

std::vector<Edge> convex_edges(const SurfaceView<3>& facets) {
    std::vector<Edge> edges;
    for (const Ridge& ridge : ridges(facets)) {
        if (!is_convex(facets, ridge)) continue;
        const double cosine = facets.normal[ridge.face_1].dot(facets.normal[ridge.face_2]);
        edges.push_back({ridge, std::sqrt(std::max(0.0, 0.5 * (1.0 + cosine)))});
    }
    return edges;
}

/// The sharpest edges of all bodies, sharpest first.
class SharpestEdges {
public:
    SharpestEdges(const SurfaceView<3>& facets, std::span<const Edge> edges) : facets_(facets) {
        std::map<std::int32_t, Sharpest> by_body;
        for (const Edge& edge : edges) {
            const std::int32_t body = facets.body[edge.ridge.face_1];
            Sharpest& sharpest = by_body.try_emplace(body, Sharpest{edge.half_sine, body, true}).first->second;
            sharpest.half_sine = std::min(sharpest.half_sine, edge.half_sine);
            sharpest.is_rigid = sharpest.is_rigid && is_rigid(edge);
        }
        for (const auto& [body, sharpest] : by_body) all_.push_back(sharpest);
        std::ranges::stable_sort(all_, {}, &Sharpest::half_sine);
    }

    /// Of the bodies that an edge may meet; 1 where there is none.
    [[nodiscard]] double beside(const Edge& edge) const {
        const std::int32_t body = facets_.body[edge.ridge.face_1];
        const auto other = std::ranges::find_if(
            all_, [&](const Sharpest& of) { return of.body != body && !(of.is_rigid && is_rigid(edge)); });
        return other == all_.end() ? 1.0 : other->half_sine;
    }

private:
    struct Sharpest {
        double half_sine;
        std::int32_t body;
        bool is_rigid;
    };
    [[nodiscard]] bool is_rigid(const Edge& edge) const {
        return facets_.is_rigid(edge.ridge.face_1) && facets_.is_rigid(edge.ridge.face_2);
    }

    const SurfaceView<3>& facets_;
    std::vector<Sharpest> all_;
};

/// One facet at an edge u -> v: its corners, and the vector from the edge to the third one, across it.
struct Flank {
    std::int32_t u, v, third;  // vertices
    double along;              // of the foot of the third corner, from u to v
    Vector<3> across;          // from the foot to the third corner [m]
};

Flank flank_of(const SurfaceView<3>& facets, std::int32_t facet, const Vector<3>& u, const Vector<3>& v) {
    Flank flank{-1, -1, -1, 0.0, Vector<3>::Zero()};
    for (const std::int32_t vertex : facets.vertices_of(facet))
        (facets.vertices[vertex] == u ? flank.u : facets.vertices[vertex] == v ? flank.v : flank.third) = vertex;
    const Vector<3> edge = v - u, to_third = facets.vertices[flank.third] - u;
    flank.along = to_third.dot(edge) / edge.squaredNorm();
    flank.across = to_third - flank.along * edge;
    return flank;
}

/// Flank::across as a combination of the corners.
Combination across(const Flank& flank) {
    Combination combination;
    combination.add(flank.third, 1.0);
    combination.add(flank.u, flank.along - 1.0);
    combination.add(flank.v, -flank.along);
    return combination;
}

/// The corners in the order in which they are seen counter-clockwise from where `outward` points.
void append_triangle(const SurfaceView<3>& facets, std::array<std::int32_t, 3> corners, const Vector<3>& outward,
                     std::array<std::int32_t, 2> beside, double stiffening, const geometry::FacingFade& facing,
                     Bevels<3>& bevels) {
    std::array<Vector<3>, 3> x;
    for (std::size_t i = 0; i < 3; ++i) {
        x[i].setZero();
        for (std::int32_t j = bevels.offsets[corners[i]]; j < bevels.offsets[corners[i] + 1]; ++j)
            x[i] += bevels.weight[j] * facets.vertices[bevels.node[j]];
    }
    if ((x[1] - x[0]).cross(x[2] - x[0]).dot(outward) < 0.0) std::swap(corners[1], corners[2]);
    bevels.corners.push_back(corners);
    bevels.beside.push_back(beside);
    bevels.stiffening.push_back(stiffening);
    bevels.facing.push_back(facing);
}

Vector<3> bisector(const SurfaceView<3>& facets, const Ridge& ridge) {
    return (facets.normal[ridge.face_1] + facets.normal[ridge.face_2]).normalized();
}

/// A strip across an edge, of two triangles.
void append_edge(const SurfaceView<3>& facets, const Edge& edge, Bevels<3>& bevels) {
    const Ridge& ridge = edge.ridge;
    const Vector<3>&u = facets.vertices[ridge.vertex_1], &v = facets.vertices[ridge.vertex_2];
    const Flank flank_1 = flank_of(facets, ridge.face_1, u, v), flank_2 = flank_of(facets, ridge.face_2, u, v);
    const double length = std::min(flank_1.across.norm(), flank_2.across.norm());
    const double gamma = part_of_edge(edge.half_sine), width = 4.0 * edge.half_sine * gamma * length;
    const auto corner = [&](std::int32_t end_1, std::int32_t end_2, double side) {
        Combination y;
        y.add(end_1, 0.5);
        y.add(end_2, 0.5);
        y.add(across(flank_1), side * gamma * length / flank_1.across.norm());
        y.add(across(flank_2), -side * gamma * length / flank_2.across.norm());
        return y.append_to(bevels);
    };
    const std::int32_t u_1 = corner(flank_1.u, flank_2.u, 1.0), u_2 = corner(flank_1.u, flank_2.u, -1.0);
    const std::int32_t v_1 = corner(flank_1.v, flank_2.v, 1.0), v_2 = corner(flank_1.v, flank_2.v, -1.0);
    const std::array beside{std::min(ridge.face_1, ridge.face_2), std::max(ridge.face_1, ridge.face_2)};
    for (const std::array corners : {std::array{v_1, u_1, u_2}, std::array{v_1, u_2, v_2}})
        append_triangle(facets, corners, bisector(facets, ridge), beside, stiffening(length, width),
                        bevel_facing(edge.half_sine), bevels);
    bevels.width = std::max(bevels.width, 0.5 * width);
}

/// A corner of a body, with the facets that meet there.
struct SurfaceCorner {
    std::int32_t merged_vertex, body;
    Vector<3> position;
    std::vector<std::int32_t> facets;
    std::vector<std::int32_t> vertex;               // of each facet there
    std::vector<std::array<std::int32_t, 2>> ring;  // edges, facet by facet: the vertex there, that at the other end
    Vector<3> axis;                                 // outwards, unit; 0 where the edges make no spike
};

/// Whether the facets go all around a corner: each edge from there belongs to two of them.
bool is_closed(const SurfaceView<3>& facets, const std::vector<std::array<std::int32_t, 2>>& ring) {
    std::map<std::array<double, 3>, int> count;  // by position of the other end
    for (const auto& [vertex, other] : ring) {
        const Vector<3>& x = facets.vertices[other];
        ++count[{x[0], x[1], x[2]}];
    }
    return std::ranges::all_of(count, [](const auto& of) { return of.second == 2; });
}

std::vector<SurfaceCorner> corners_of(const SurfaceView<3>& facets) {
    const std::vector<std::int32_t> merged = geometry::merged_vertices<3>(facets.vertices);
    struct At {
        std::int32_t merged, body, facet, vertex;
    };
    std::vector<At> all;
    for (std::int32_t facet = 0; facet < facets.size(); ++facet)
        for (const std::int32_t vertex : facets.vertices_of(facet))
            all.push_back({merged[vertex], facets.body[facet], facet, vertex});
    std::ranges::sort(all, {}, [](const At& at) { return std::tie(at.merged, at.body, at.facet); });
    std::vector<SurfaceCorner> corners;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i == 0 || all[i].merged != all[i - 1].merged || all[i].body != all[i - 1].body)
            corners.push_back({all[i].merged, all[i].body, facets.vertices[all[i].merged], {}, {}, {}, Vector<3>::Zero()});
        SurfaceCorner& corner = corners.back();
        corner.facets.push_back(all[i].facet);
        corner.vertex.push_back(all[i].vertex);
        for (const std::int32_t other : facets.vertices_of(all[i].facet))
            if (other != all[i].vertex) {
                corner.ring.push_back({all[i].vertex, other});
                corner.axis += (corner.position - facets.vertices[other]).normalized();
            }
    }
    for (SurfaceCorner& corner : corners) {
        const double length = corner.axis.norm();
        corner.axis = length > least_spike * static_cast<double>(corner.ring.size()) && is_closed(facets, corner.ring)
                          ? Vector<3>(corner.axis / length)
                          : Vector<3>::Zero();
    }
    return corners;
}

bool is_sharp(const SurfaceView<3>& facets, const SurfaceCorner& corner) {
    return !corner.axis.isZero() && std::ranges::all_of(corner.facets, [&](std::int32_t facet) {
        const double facing = facets.normal[facet].dot(corner.axis);
        return facing > 0.0 && facing < enough_for_corners;
    });
}

/// A square across the axis, of two triangles: v + sum of a (w - v) over the edges around it, the sum of least norm.
void append_corner(const SurfaceView<3>& facets, const SurfaceCorner& corner, Bevels<3>& bevels) {
    const auto edge = [&](std::size_t i) { return Vector<3>(facets.vertices[corner.ring[i][1]] - corner.position); };
    Matrix<3> squares = Matrix<3>::Zero();
    double shortest = edge(0).norm(), radius = 0.0;  // of the ring, seen along the axis
    for (std::size_t i = 0; i < corner.ring.size(); ++i) {
        squares += edge(i) * edge(i).transpose();
        shortest = std::min(shortest, edge(i).norm());
        radius += corner.axis.cross(edge(i)).norm() / static_cast<double>(corner.ring.size());
    }
    const double r = std::min(0.25 * shortest, 0.5 * radius);
    const Vector<3> aside = corner.axis.unitOrthogonal(), other = corner.axis.cross(aside);
    const Matrix<3> inverse = squares.inverse();
    std::array<std::int32_t, 4> square;
    const std::array<Vector<3>, 4> directions{aside, other, -aside, -other};
    for (std::size_t k = 0; k < 4; ++k) {
        const Vector<3> factor = inverse * (r * directions[k]);
        Combination y;
        for (const std::int32_t vertex : corner.vertex) y.add(vertex, 1.0 / static_cast<double>(corner.vertex.size()));
        for (std::size_t i = 0; i < corner.ring.size(); ++i) {
            y.add(corner.ring[i][1], factor.dot(edge(i)));
            y.add(corner.ring[i][0], -factor.dot(edge(i)));
        }
        square[k] = y.append_to(bevels);
    }
    const std::array beside{corner.facets.front(), corner.facets.front()};
    for (const std::array corners :
         {std::array{square[0], square[1], square[2]}, std::array{square[0], square[2], square[3]}})
        append_triangle(facets, corners, corner.axis, beside, corner_stiffening, bevel_facing(enough_for_corners), bevels);
    bevels.width = std::max(bevels.width, r);
}

/// Ends of edges that have a bevel, and their directions out of the body.
class BevelledEnds {
public:
    void add(const SurfaceView<3>& facets, const Ridge& ridge) {
        for (const std::int32_t end : {ridge.vertex_1, ridge.vertex_2})
            outward_[{end, facets.body[ridge.face_1]}].push_back(bisector(facets, ridge));
    }
    [[nodiscard]] bool stand_for(const SurfaceCorner& corner) const {
        const auto there = outward_.find({corner.merged_vertex, corner.body});
        return there != outward_.end() && std::ranges::any_of(there->second, [&](const Vector<3>& outward) {
                   return outward.dot(corner.axis) > near_axis;
               });
    }

private:
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<Vector<3>>> outward_;  // by merged vertex and body
};

}  // namespace

template <>
Bevels<3> bevels_of(const SurfaceView<3>& facets) {
    Bevels<3> bevels;
    BevelledEnds ends;
    const std::vector<Edge> edges = convex_edges(facets);
    const SharpestEdges sharpest(facets, edges);
    for (const Edge& edge : edges) {
        if (!has_bevel_across(edge.half_sine, edge.half_sine * sharpest.beside(edge))) continue;
        append_edge(facets, edge, bevels);
        ends.add(facets, edge.ridge);
    }
    for (const SurfaceCorner& corner : corners_of(facets)) {
        if (!is_sharp(facets, corner)) continue;
        if (!ends.stand_for(corner)) append_corner(facets, corner, bevels);
        bevels.tips.push_back(corner.position);
    }
    return bevels;
}

}  // namespace abut::contact
