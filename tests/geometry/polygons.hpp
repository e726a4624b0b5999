#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "abut/geometry/overlap/overlap.hpp"

namespace abut::test {

using Point = PlaneVector<3>;
using Polygon = std::vector<Point>;
using geometry::AreaMethod;
using geometry::OverlapArea;

inline OverlapArea<3> shared(const Polygon& face_1, const Polygon& face_2, const Point& shift = Point::Zero(),
                             AreaMethod method = AreaMethod::fast) {
    return geometry::overlap_area<3>(face_1, face_2, shift, method);
}

inline double uniform(std::mt19937& random, double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random);
}

inline Polygon rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
inline Polygon unit_square() { return rectangle(0, 0, 1, 1); }

inline Polygon rotated(const Polygon& polygon, double angle, const Point& centre) {
    Polygon result;
    for (const Point& p : polygon) {
        const Point arm = p - centre;
        result.emplace_back(centre.x() + std::cos(angle) * arm.x() - std::sin(angle) * arm.y(),
                            centre.y() + std::sin(angle) * arm.x() + std::cos(angle) * arm.y());
    }
    return result;
}

/// The polygon times `scale`, then moved by `offset`.
inline Polygon placed(const Polygon& polygon, double scale, const Point& offset) {
    Polygon result;
    for (const Point& p : polygon) result.push_back(scale * p + offset);
    return result;
}

/// A convex polygon with its corners on a circle about `centre`, counter-clockwise.
inline Polygon random_polygon(std::mt19937& random, int corners, const Point& centre, double radius) {
    std::vector<double> angles;
    for (int i = 0; i < corners; ++i) angles.push_back((i + uniform(random, 0.0, 0.8)) * 2.0 * std::numbers::pi / corners);
    Polygon polygon;
    for (const double angle : angles) polygon.push_back(centre + radius * Point(std::cos(angle), std::sin(angle)));
    return polygon;
}

inline double area_of(const Polygon& polygon) {
    double twice = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Point a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * twice;
}

inline double size_of(const Polygon& polygon) {
    double size = 0.0;
    for (const Point& p : polygon) size = std::max(size, (p - polygon[0]).norm());
    return size;
}

struct NamedPair {
    std::string name;
    Polygon face_1, face_2;
    double area;  ///< by elementary geometry
};

/// All special positions, each with the area it shares. Coordinates are small multiples of powers of two: exact.
inline std::vector<NamedPair> special_positions() {
    const Polygon square = unit_square(), triangle = {{0, 0}, {1, 0}, {0, 1}};
    return {
        {"identical squares", square, square, 1.0},
        {"identical triangles", triangle, triangle, 0.5},
        {"identical, vertices start elsewhere", square, {{1, 1}, {0, 1}, {0, 0}, {1, 0}}, 1.0},
        {"shared edge", square, rectangle(1, 0, 2, 1), 0.0},
        {"shared slanted edge", triangle, {{1, 0}, {1, 1}, {0, 1}}, 0.0},
        {"part of an edge shared", square, rectangle(1, 0.25, 2, 0.75), 0.0},
        {"shared vertex", square, rectangle(1, 1, 2, 2), 0.0},
        {"vertex on an edge", square, {{1, 0.5}, {2, 0}, {2, 1}}, 0.0},
        {"apart", square, rectangle(3, 0, 4, 1), 0.0},
        {"apart, boxes overlap", triangle, {{1, 1}, {0.75, 1}, {1, 0.75}}, 0.0},
        {"contained", rectangle(0, 0, 4, 4), rectangle(1, 1, 2, 2), 1.0},
        {"containing", rectangle(1, 1, 2, 2), rectangle(0, 0, 4, 4), 1.0},
        {"contained, one edge in common", rectangle(0, 0, 4, 4), rectangle(1, 0, 2, 1), 1.0},
        {"contained, two edges in common", rectangle(0, 0, 4, 4), rectangle(0, 0, 1, 1), 1.0},
        {"half and whole", square, {{0, 0}, {1, 0}, {1, 1}}, 0.5},
        {"two triangles of one square, other diagonal", {{0, 0}, {1, 0}, {1, 1}}, {{1, 0}, {1, 1}, {0, 1}}, 0.25},
        {"straight corner", {{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}}, rectangle(0.5, -1, 2, 0.5), 0.25},
        {"repeated vertex", {{0, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}}, rectangle(0.5, 0.5, 2, 2), 0.25},
        {"no area: a point", square, {{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}, 0.0},
        {"no area: a line", square, {{0, 0.5}, {1, 0.5}, {0.5, 0.5}}, 0.0},
        {"no area on either side", {{0, 0}, {1, 0}, {0.5, 0}}, {{0, 0}, {1, 0}, {0.5, 0}}, 0.0},
        {"no area: face 1", {{0, 0.5}, {1, 0.5}, {0.5, 0.5}}, square, 0.0},
        {"needle across a square", square, {{-1, 0.5}, {2, 0.5}, {2, 0.5 + 0x1p-40}, {-1, 0.5 + 0x1p-40}}, 0x1p-40},
        {"needle along an edge, inside", square, rectangle(0, 0, 1, 0x1p-40), 0x1p-40},
        {"needle along an edge, outside", square, rectangle(0, -0x1p-40, 1, 0), 0.0},
        {"overlap of one last digit", square, rectangle(1 - 0x1p-53, 0, 2, 1), 0x1p-53},
        {"apart by one last digit", square, rectangle(1 + 0x1p-52, 0, 2, 1), 0.0},
    };
}

/// Sizes and places at which every law must hold just as well.
struct Placement {
    double scale;
    Point offset;
};
inline std::vector<Placement> placements() {
    return {{1.0, {0, 0}},      {0x1p-30, {0, 0}}, {0x1p30, {0, 0}},
            {1e-9, {0, 0}},     {1e9, {0, 0}},     {0x1p-10, {0x1p23, -0x1p23}},
            {1.0, {1000, 2000}}};
}

}  // namespace abut::test
