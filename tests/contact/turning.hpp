#pragma once
// Bodies that turn and deform: positions of vertices, and the surface that a host would make from them by hand.

#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "abut/base/rotation.hpp"
#include "abut/geometry/polygon.hpp"
#include "contact/surfaces.hpp"

namespace abut::test {

template <int Dim>
using Points = std::vector<Vector<Dim>>;

template <int Dim>
Matrix<Dim> turn(std::mt19937& random, double angle) {
    if constexpr (Dim == 2) {
        return rotation_in_plane(uniform(random, -angle, angle));
    } else {
        const Vector<3> axis = Vector<3>(random_vector<3>(random, 1.0)).normalized();
        return rotation_about(axis, uniform(random, -angle, angle));
    }
}

/// Every body turned, sheared and shifted; corners of faces that stay flat whatever their corners do (triangles, segments)
/// are also moved each on its own. Polygons stay flat on the straight path between two such states.
template <int Dim>
Points<Dim> turned_and_deformed(std::mt19937& random, const contact::Surface<Dim>& surface, double angle, double shift,
                                double noise) {
    Points<Dim> x = surface.vertices;
    for (std::int32_t body = 0; body < 4; ++body) {
        const Vector<Dim> by = random_vector<Dim>(random, shift);
        Matrix<Dim> map = turn<Dim>(random, angle);
        for (int i = 0; i < Dim; ++i) map.col(i) += random_vector<Dim>(random, 0.1);
        for (std::int32_t face = 0; face < surface.size(); ++face) {
            if (surface.body[face] != body) continue;
            const auto corners = surface.view().vertices_of(face);
            for (const std::int32_t v : corners) {
                x[v] = Vector<Dim>(map * surface.vertices[v]) + by;
                if (corners.size() <= 3) x[v] += random_vector<Dim>(random, noise);
            }
        }
    }
    return x;
}

template <int Dim>
Points<Dim> between(const Points<Dim>& x_0, const Points<Dim>& x_1, double t) {
    Points<Dim> x;
    for (std::size_t v = 0; v < x_0.size(); ++v) x.push_back(x_0[v] + t * (x_1[v] - x_0[v]));
    return x;
}

/// The surface with its vertices elsewhere and all measures computed again.
template <int Dim>
contact::Surface<Dim> rebuilt(const contact::Surface<Dim>& surface, const Points<Dim>& x) {
    contact::Surface<Dim> moved = surface;
    moved.vertices = x;
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        Points<Dim> corners, at_rest;
        for (const std::int32_t v : surface.view().vertices_of(face)) {
            corners.push_back(x[v]);
            at_rest.push_back(surface.vertices[v]);
        }
        moved.centroid[face] = geometry::face_centroid<Dim>(corners);
        moved.area[face] = geometry::face_measure<Dim>(corners);
        // The two ends of a segment may come in any order, but they keep it.
        const bool turned = geometry::face_normal<Dim>(at_rest).dot(surface.normal[face]) < 0.0;
        moved.normal[face] = (turned ? -1.0 : 1.0) * geometry::face_normal<Dim>(corners);
    }
    return moved;
}

/// Where the line from p along n meets the plane of a flat convex face: how far away, in units of n; NaN where it misses.
inline double height_over(const Vector<2>& p, const Vector<2>& n, std::span<const Vector<2>> face) {
    const Vector<2> along = face[1] - face[0], from = face[0] - p;
    const double across = n[0] * along[1] - n[1] * along[0];
    const double share = (n[1] * from[0] - n[0] * from[1]) / across;  // of the way from the first corner to the second
    if (!(share >= 0.0 && share <= 1.0)) return std::numeric_limits<double>::quiet_NaN();
    return (from[0] * along[1] - from[1] * along[0]) / across;
}
inline double height_over(const Vector<3>& p, const Vector<3>& n, std::span<const Vector<3>> face) {
    const Vector<3> normal = Vector<3>(face[1] - face[0]).cross(Vector<3>(face[2] - face[0]));
    const double height = (face[0] - p).dot(normal) / n.dot(normal);
    const Vector<3> hit = p + height * n;
    for (std::size_t i = 0; i < face.size(); ++i) {
        const Vector<3> edge = face[(i + 1) % face.size()] - face[i];
        if (!(edge.cross(Vector<3>(hit - face[i])).dot(normal) >= 0.0)) return std::numeric_limits<double>::quiet_NaN();
    }
    return height;
}

/// A point of a face: a mean of its corners with random weights.
template <int Dim>
Vector<Dim> random_point(std::mt19937& random, std::span<const Vector<Dim>> face) {
    Vector<Dim> sum = Vector<Dim>::Zero();
    double weights = 0.0;
    for (const Vector<Dim>& corner : face) {
        const double weight = std::pow(uniform(random, 0.0, 1.0), 3);  // often near an edge
        sum += weight * corner;
        weights += weight;
    }
    return sum / weights;
}

}  // namespace abut::test
