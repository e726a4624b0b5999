#include "abut/geometry/convex_proximity.hpp"

#include <ccd/ccd.h>

#include <algorithm>
#include <type_traits>
#include <vector>

#include "abut/geometry/convex_bodies.hpp"

namespace abut::geometry {
namespace {

static_assert(std::is_same_v<ccd_real_t, double>,
              "libccd must be the double build: the single one fails its checks silently");

constexpr int max_iterations = 200;
constexpr std::size_t few_points = 16;  // two hexahedra

// libccd's loops have no limit of their own everywhere. After so many calls the support point is the centre, which no
// longer enlarges anything, and they end.
struct CountedBody {
    const ConvexBody* body;
    mutable int calls_left = 10 * max_iterations;
};

void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    const auto& counted = *static_cast<const CountedBody*>(object);
    const bool give_up = counted.calls_left-- <= 0;
    const Vector<3> farthest =
        give_up ? counted.body->centre : counted.body->support({direction->v[0], direction->v[1], direction->v[2]});
    ccdVec3Set(point, farthest.x(), farthest.y(), farthest.z());
}

void ccd_centre(const void* object, ccd_vec3_t* point) {
    const Vector<3>& centre = static_cast<const CountedBody*>(object)->body->centre;
    ccdVec3Set(point, centre.x(), centre.y(), centre.z());
}

using CcdPenetration = int (*)(const void*, const void*, const ccd_t*, ccd_real_t*, ccd_vec3_t*, ccd_vec3_t*);

Vector<3> ccd_direction(const ConvexPair& bodies, CcdPenetration penetration) {
    ccd_t settings;
    CCD_INIT(&settings);
    settings.support1 = settings.support2 = ccd_support;
    settings.center1 = settings.center2 = ccd_centre;
    settings.max_iterations = max_iterations;
    settings.epa_tolerance = settings.mpr_tolerance = 1e-9;
    const CountedBody counted_1{&bodies.body_1}, counted_2{&bodies.body_2};
    ccd_real_t depth = 0.0;
    ccd_vec3_t direction = {{0.0, 0.0, 0.0}}, position = {{0.0, 0.0, 0.0}};
    penetration(&counted_1, &counted_2, &settings, &depth, &direction, &position);
    return {direction.v[0], direction.v[1], direction.v[2]};
}

// What libccd proposes; it needs bodies with volume, so plane ones become prisms too thick to be parted along z.
std::vector<Vector<3>> penetration_directions(ConvexPair bodies, bool is_plane) {
    if (is_plane) bodies.body_1.half_thickness = bodies.body_2.half_thickness = 4.0;
    return {ccd_direction(bodies, ccdGJKPenetration), ccd_direction(bodies, ccdMPRPenetration)};
}

// Every direction that can be that of the least depth of two polytopes: the normals of faces and of pairs of edges. Which
// pairs of points are edges is not known, so all are taken; one that is none does no harm.
std::vector<Vector<3>> normals_of_edges(const ConvexPair& bodies, bool is_plane) {
    std::vector<Vector<3>> edges, normals;
    for (const ConvexBody* body : {&bodies.body_1, &bodies.body_2})
        for (std::size_t i = 0; i < body->points.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) edges.push_back(body->points[i] - body->points[k]);
    if (is_plane) edges.push_back(Vector<3>::UnitZ());
    for (std::size_t i = is_plane ? edges.size() - 1 : 1; i < edges.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) normals.push_back(edges[i].cross(edges[k]));
    return normals;
}

// EPA stops a little early. Pushed apart along the best direction so far, and a little more, the bodies face each other
// with the features that meet last; GJK gives their normal.
void refine(BestDirection& best, const ConvexPair& bodies, bool is_plane) {
    constexpr int rounds = 4;
    for (int round = 0; round < rounds && best.separation < 0.0; ++round) {
        ConvexPair apart = bodies;
        for (Vector<3>& point : apart.body_2.points) point -= 1.01 * best.separation * best.direction;
        improve(best, bodies, gjk_gap(apart), is_plane);
    }
}

}  // namespace

template <int Dim>
ConvexProximity<Dim> convex_proximity(std::span<const Vector<Dim>> body_1, std::span<const Vector<Dim>> body_2) {
    constexpr bool is_plane = Dim == 2;
    const auto [bodies, unit] = unit_bodies<Dim>(body_1, body_2, "convex_proximity");
    BestDirection best = best_of_gjk(bodies, is_plane);
    if (best.separation <= 0.0)
        for (const Vector<3>& proposal : penetration_directions(bodies, is_plane)) improve(best, bodies, proposal, is_plane);
    refine(best, bodies, is_plane);
    if (best.separation < 0.0 && body_1.size() + body_2.size() <= few_points)
        for (const Vector<3>& proposal : normals_of_edges(bodies, is_plane)) improve(best, bodies, proposal, is_plane);
    const Vector<Dim> direction = best.direction.template head<Dim>();
    return {std::max(best.separation, 0.0) * unit, std::max(-best.separation, 0.0) * unit, direction};
}

template ConvexProximity<2> convex_proximity<2>(std::span<const Vector<2>>, std::span<const Vector<2>>);
template ConvexProximity<3> convex_proximity<3>(std::span<const Vector<3>>, std::span<const Vector<3>>);

}  // namespace abut::geometry
