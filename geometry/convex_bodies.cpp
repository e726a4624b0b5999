#include "abut/geometry/convex_bodies.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/eigen.hpp"
#include "abut/base/error.hpp"
#include "abut/geometry/box.hpp"

namespace abut::geometry {
namespace {

constexpr int max_distance_iterations = 200;

template <int Dim>
Box<3> bounding_box_of(std::span<const Vector<Dim>> points, const std::string& name) {
    if (points.empty()) throw BadInput(name + ": a body has 0 points, at least 1 is needed. Leave the body out.");
    Box<3> box;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector<Dim>& point = points[i];
        for (int axis = 0; axis < Dim; ++axis)
            if (!std::isfinite(point[axis]))
                throw BadInput(name + ": point " + std::to_string(i) + " has the " + "xyz"[axis] + " coordinate " +
                               std::to_string(point[axis]) +
                               ", a finite number is needed. Has the motion behind it blown up?");
        box.extend(in_3d<Dim>(point));
    }
    return box;
}

template <int Dim>
ConvexBody unit_body(std::span<const Vector<Dim>> points, const Vector<3>& origin, double unit) {
    ConvexBody body;
    for (const Vector<Dim>& point : points) {
        const Vector<3> relative = in_3d<Dim>((point - origin.head<Dim>()) / unit);
        body.points.push_back(relative);
        body.centre += relative / static_cast<double>(points.size());
    }
    return body;
}

// Each body shrunk about its own centre: bodies that touch or interlock a little come apart, and the direction of the
// gap is that of the contact.
ConvexPair shrunk(const ConvexPair& bodies, double factor) {
    ConvexPair result = bodies;
    for (ConvexBody* body : {&result.body_1, &result.body_2})
        for (Vector<3>& point : body->points) point = body->centre + factor * (point - body->centre);
    return result;
}

// The point nearest to the origin in the flat through the corners, if it lies in their simplex.
bool nearest_inside(const std::vector<Vector<3>>& corners, Vector<3>& nearest) {
    nearest = corners[0];
    if (corners.size() == 1) return true;
    const Eigen::Index n = static_cast<Eigen::Index>(corners.size()) - 1;
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(3, n);
    for (Eigen::Index k = 0; k < n; ++k) edges.col(k) = as_eigen(corners[k + 1] - corners[0]);
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> weights =
        edges.colPivHouseholderQr().solve(as_eigen(-corners[0]));
    nearest += Vector<3>(edges * weights);
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

}  // namespace

Vector<3> ConvexBody::support(const Vector<3>& direction) const {
    const auto lower = [&](const Vector<3>& a, const Vector<3>& b) { return direction.dot(a) < direction.dot(b); };
    Vector<3> farthest = *std::max_element(points.begin(), points.end(), lower);
    farthest.z() += std::copysign(half_thickness, direction.z());
    return farthest;
}

template <int Dim>
UnitBodies unit_bodies(std::span<const Vector<Dim>> points_1, std::span<const Vector<Dim>> points_2, const char* name) {
    Box<3> box = bounding_box_of(points_1, name);
    box.extend(bounding_box_of(points_2, name));
    const Vector<3> origin = box.lower + 0.5 * (box.upper - box.lower);
    const double size = (box.upper - box.lower).maxCoeff(), unit = size > 0.0 ? size : 1.0;
    return {{unit_body(points_1, origin, unit), unit_body(points_2, origin, unit)}, unit};
}

Vector<3> gjk_gap(const ConvexPair& bodies) {
    std::vector<Vector<3>> simplex;
    Vector<3> nearest = bodies.body_2.centre - bodies.body_1.centre;
    for (int iteration = 0; iteration < max_distance_iterations && nearest.norm() > 1e-14; ++iteration) {
        const Vector<3> candidate = bodies.support(-nearest);
        if (!simplex.empty() && nearest.squaredNorm() - nearest.dot(candidate) <= 1e-14 * nearest.squaredNorm()) break;
        if (simplex.size() == 4) break;  // the origin is inside, up to rounding
        simplex.push_back(candidate);
        nearest = reduce_to_nearest(simplex);
    }
    return nearest;
}

void improve(BestDirection& best, const ConvexPair& bodies, Vector<3> proposal, bool is_plane) {
    if (is_plane) proposal.z() = 0.0;
    if (!proposal.allFinite() || proposal.isZero(0.0)) return;
    proposal.stableNormalize();
    for (const Vector<3>& direction : {proposal, Vector<3>(-proposal)})
        if (const double separation = bodies.separation(direction); separation > best.separation)
            best = {separation, direction};
}

BestDirection best_of_gjk(const ConvexPair& bodies, bool is_plane) {
    BestDirection best;
    improve(best, bodies, bodies.body_2.centre - bodies.body_1.centre, is_plane);
    for (const Vector<3>& gap : {gjk_gap(bodies), gjk_gap(shrunk(bodies, 0.99)), gjk_gap(shrunk(bodies, 0.9))})
        improve(best, bodies, gap, is_plane);
    for (int axis = 0; axis < 3; ++axis) improve(best, bodies, Vector<3>::Unit(axis), is_plane);
    return best;
}

template UnitBodies unit_bodies<2>(std::span<const Vector<2>>, std::span<const Vector<2>>, const char*);
template UnitBodies unit_bodies<3>(std::span<const Vector<3>>, std::span<const Vector<3>>, const char*);

}  // namespace abut::geometry
