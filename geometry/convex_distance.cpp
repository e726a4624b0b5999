#include "abut/geometry/convex_distance.hpp"

#include <ccd/ccd.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/geometry/box.hpp"

namespace abut::geometry {
namespace {

static_assert(std::is_same_v<ccd_real_t, double>,
              "libccd must be the double build: the single one fails its checks silently");

constexpr int max_iterations = 200;
constexpr std::size_t few_points = 16;  // two hexahedra

// A convex body of about unit size. In 2D it lies in the plane z = 0 and `half_thickness` can make a prism of it.
struct Body {
    std::vector<Vector<3>> points;
    Vector<3> centre = Vector<3>::Zero();
    double half_thickness = 0.0;

    Vector<3> support(const Vector<3>& direction) const {
        const auto lower = [&](const Vector<3>& a, const Vector<3>& b) { return direction.dot(a) < direction.dot(b); };
        Vector<3> farthest = *std::max_element(points.begin(), points.end(), lower);
        farthest.z() += std::copysign(half_thickness, direction.z());
        return farthest;
    }
};

struct Bodies {
    Body body_1, body_2;

    // The point of the difference 2 - 1 that lies farthest along `direction`.
    Vector<3> support(const Vector<3>& direction) const { return body_2.support(direction) - body_1.support(-direction); }
    // Room between the bodies seen along a unit direction; negative where they interlock.
    double separation(const Vector<3>& direction) const { return direction.dot(support(-direction)); }
};

template <int Dim>
Box<3> bounding_box_of(std::span<const Vector<Dim>> points) {
    if (points.empty()) throw BadInput("convex_proximity: a body has 0 points, at least 1 is needed. Leave the body out.");
    Box<3> box;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector<Dim>& point = points[i];
        for (int axis = 0; axis < Dim; ++axis)
            if (!std::isfinite(point[axis]))
                throw BadInput("convex_proximity: point " + std::to_string(i) + " has the " + "xyz"[axis] + " coordinate " +
                               std::to_string(point[axis]) +
                               ", a finite number is needed. Has the motion behind it blown up?");
        Vector<3> lifted = Vector<3>::Zero();
        lifted.template head<Dim>() = point;
        box.extend(lifted);
    }
    return box;
}

template <int Dim>
Body unit_body(std::span<const Vector<Dim>> points, const Vector<3>& origin, double unit) {
    Body body;
    for (const Vector<Dim>& point : points) {
        Vector<3> relative = Vector<3>::Zero();
        relative.template head<Dim>() = (point - origin.head<Dim>()) / unit;
        body.points.push_back(relative);
        body.centre += relative / static_cast<double>(points.size());
    }
    return body;
}

// Each body shrunk about its own centre: bodies that touch or interlock a little come apart, and the direction of the
// gap is that of the contact.
Bodies shrunk(const Bodies& bodies, double factor) {
    Bodies result = bodies;
    for (Body* body : {&result.body_1, &result.body_2})
        for (Vector<3>& point : body->points) point = body->centre + factor * (point - body->centre);
    return result;
}

// The point nearest to the origin in the flat through the corners, if it lies in their simplex.
bool nearest_inside(const std::vector<Vector<3>>& corners, Vector<3>& nearest) {
    nearest = corners[0];
    if (corners.size() == 1) return true;
    const Eigen::Index n = static_cast<Eigen::Index>(corners.size()) - 1;
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(3, n);
    for (Eigen::Index k = 0; k < n; ++k) edges.col(k) = corners[k + 1] - corners[0];
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> weights = edges.colPivHouseholderQr().solve(-corners[0]);
    nearest += edges * weights;
    return weights.minCoeff() >= 0.0 && weights.sum() <= 1.0;
}

// Reduces the simplex to the part that holds the point nearest to the origin, and returns that point. All parts are tried,
// 15 at most: slower than a case distinction, without its degenerate cases.
Vector<3> reduce_to_nearest(std::vector<Vector<3>>& simplex) {
    Vector<3> best = simplex[0];
    std::vector<Vector<3>> best_part;
    for (unsigned part = 1; part < (1u << simplex.size()); ++part) {
        std::vector<Vector<3>> corners;
        for (unsigned k = 0; k < simplex.size(); ++k)
            if (part & (1u << k)) corners.push_back(simplex[k]);
        Vector<3> nearest;
        if (nearest_inside(corners, nearest) && (best_part.empty() || nearest.squaredNorm() < best.squaredNorm())) {
            best = nearest;
            best_part = corners;
        }
    }
    simplex = best_part;
    return best;
}

// Gilbert-Johnson-Keerthi: the vector from body 1 to body 2 between their nearest points; about zero if they overlap.
Vector<3> gjk_gap(const Bodies& bodies) {
    std::vector<Vector<3>> simplex;
    Vector<3> nearest = bodies.body_2.centre - bodies.body_1.centre;
    for (int iteration = 0; iteration < max_iterations && nearest.norm() > 1e-14; ++iteration) {
        const Vector<3> candidate = bodies.support(-nearest);
        if (!simplex.empty() && nearest.squaredNorm() - nearest.dot(candidate) <= 1e-14 * nearest.squaredNorm()) break;
        if (simplex.size() == 4) break;  // the origin is inside, up to rounding
        simplex.push_back(candidate);
        nearest = reduce_to_nearest(simplex);
    }
    return nearest;
}

// libccd's loops have no limit of their own everywhere. After so many calls the support point is the centre, which no
// longer enlarges anything, and they end.
struct CountedBody {
    const Body* body;
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

Vector<3> ccd_direction(const Bodies& bodies, CcdPenetration penetration) {
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

std::vector<Vector<3>> proposed_directions(const Bodies& bodies) {
    std::vector<Vector<3>> directions = {bodies.body_2.centre - bodies.body_1.centre, gjk_gap(bodies),
                                         gjk_gap(shrunk(bodies, 0.99)), gjk_gap(shrunk(bodies, 0.9))};
    for (int axis = 0; axis < 3; ++axis) directions.push_back(Vector<3>::Unit(axis));
    return directions;
}

// What libccd proposes; it needs bodies with volume, so plane ones become prisms too thick to be parted along z.
std::vector<Vector<3>> penetration_directions(Bodies bodies, bool is_plane) {
    if (is_plane) bodies.body_1.half_thickness = bodies.body_2.half_thickness = 4.0;
    return {ccd_direction(bodies, ccdGJKPenetration), ccd_direction(bodies, ccdMPRPenetration)};
}

// Every direction that can be that of the least depth of two polytopes: the normals of faces and of pairs of edges. Which
// pairs of points are edges is not known, so all are taken; one that is none does no harm.
std::vector<Vector<3>> normals_of_edges(const Bodies& bodies, bool is_plane) {
    std::vector<Vector<3>> edges, normals;
    for (const Body* body : {&bodies.body_1, &bodies.body_2})
        for (std::size_t i = 0; i < body->points.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) edges.push_back(body->points[i] - body->points[k]);
    if (is_plane) edges.push_back(Vector<3>::UnitZ());
    for (std::size_t i = is_plane ? edges.size() - 1 : 1; i < edges.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) normals.push_back(edges[i].cross(edges[k]));
    return normals;
}

struct Best {
    double separation = -std::numeric_limits<double>::infinity();
    Vector<3> direction = Vector<3>::Zero();
};

void improve(Best& best, const Bodies& bodies, Vector<3> proposal, bool is_plane) {
    if (is_plane) proposal.z() = 0.0;
    if (!proposal.allFinite() || proposal.isZero(0.0)) return;
    proposal.stableNormalize();
    for (const Vector<3>& direction : {proposal, Vector<3>(-proposal)})
        if (const double separation = bodies.separation(direction); separation > best.separation)
            best = {separation, direction};
}

// EPA stops a little early. Pushed apart along the best direction so far, and a little more, the bodies face each other
// with the features that meet last; GJK gives their normal.
void refine(Best& best, const Bodies& bodies, bool is_plane) {
    constexpr int rounds = 4;
    for (int round = 0; round < rounds && best.separation < 0.0; ++round) {
        Bodies apart = bodies;
        for (Vector<3>& point : apart.body_2.points) point -= 1.01 * best.separation * best.direction;
        improve(best, bodies, gjk_gap(apart), is_plane);
    }
}

}  // namespace

template <int Dim>
ConvexProximity<Dim> convex_proximity(std::span<const Vector<Dim>> body_1, std::span<const Vector<Dim>> body_2) {
    constexpr bool is_plane = Dim == 2;
    Box<3> box = bounding_box_of(body_1);
    box.extend(bounding_box_of(body_2));
    const Vector<3> origin = box.lower + 0.5 * (box.upper - box.lower);
    const double size = (box.upper - box.lower).maxCoeff(), unit = size > 0.0 ? size : 1.0;
    const Bodies bodies{unit_body(body_1, origin, unit), unit_body(body_2, origin, unit)};

    Best best;
    for (const Vector<3>& proposal : proposed_directions(bodies)) improve(best, bodies, proposal, is_plane);
    if (best.separation <= 0.0)
        for (const Vector<3>& proposal : penetration_directions(bodies, is_plane)) improve(best, bodies, proposal, is_plane);
    refine(best, bodies, is_plane);
    if (best.separation < 0.0 && body_1.size() + body_2.size() <= few_points)
        for (const Vector<3>& proposal : normals_of_edges(bodies, is_plane)) improve(best, bodies, proposal, is_plane);
    const Vector<Dim> direction = best.direction.head<Dim>();
    return {std::max(best.separation, 0.0) * unit, std::max(-best.separation, 0.0) * unit, direction};
}

template ConvexProximity<2> convex_proximity<2>(std::span<const Vector<2>>, std::span<const Vector<2>>);
template ConvexProximity<3> convex_proximity<3>(std::span<const Vector<3>>, std::span<const Vector<3>>);

}  // namespace abut::geometry
