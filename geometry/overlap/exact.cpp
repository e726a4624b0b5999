// Only the LGPL parts of CGAL: number types, kernels and their intersections.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Mpzf.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "abut/geometry/overlap/kernels.hpp"

namespace abut::geometry {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Exact::FT;
using Point = Exact::Point_2;
using Triangle = Exact::Triangle_2;
using ExactVector = Exact::Vector_2;

// to_double of a lazy number alone promises only five digits.
double rounded(const Number& number) { return CGAL::to_double(CGAL::exact(number)); }

// Of an area > 0: to no less than the smallest normal number, so that it stays one.
double rounded_up(const Number& area) { return std::max(rounded(area), std::numeric_limits<double>::min()); }

std::vector<Point> exact_points(ProjectedFace<3> face, const PlaneVector<3>& shift) {
    const ExactVector exact_shift(shift.x(), shift.y());
    std::vector<Point> points;
    for (const PlaneVector<3>& vertex : face) points.push_back(Point(vertex.x(), vertex.y()) + exact_shift);
    return points;
}

std::vector<Triangle> fan(const std::vector<Point>& polygon) {
    std::vector<Triangle> triangles;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Triangle triangle(polygon[0], polygon[i], polygon[i + 1]);
        if (!triangle.is_degenerate()) triangles.push_back(triangle);
    }
    return triangles;
}

Number area_of(const Triangle& triangle) { return CGAL::abs(triangle.area()); }

Number area_of(const std::vector<Point>& polygon) {
    Number area = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) area += Triangle(polygon[0], polygon[i], polygon[i + 1]).area();
    return CGAL::abs(area);
}

Number overlap_area_of(const Triangle& triangle_1, const Triangle& triangle_2) {
    const auto shared = CGAL::intersection(triangle_1, triangle_2);
    if (!shared) return 0;
    if (const auto* triangle = boost::get<Triangle>(&*shared)) return area_of(*triangle);
    if (const auto* polygon = boost::get<std::vector<Point>>(&*shared)) return area_of(*polygon);
    return 0;  // a segment or a point
}

// The part of the edge (a, b) of face 2 inside face 1, as a fraction of it; half of it where it lies on an edge of face 1.
// Half-plane by half-plane: the triangles of a fan would count a piece on one of their diagonals twice.
Number fraction_inside(const Point& a, const Point& b, const std::vector<Point>& polygon) {
    Number from = 0, to = 1, weight = 1;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point& start = polygon[i];
        const ExactVector line = polygon[(i + 1) % polygon.size()] - start;
        if (line == CGAL::NULL_VECTOR) continue;
        const Number height_a = CGAL::determinant(line, a - start), height_b = CGAL::determinant(line, b - start);
        if (CGAL::is_zero(height_a) && CGAL::is_zero(height_b)) weight = Number(1) / 2;
        if (height_a < 0 && height_b <= 0) return 0;
        if (height_a <= 0 && height_b < 0) return 0;
        if (height_a < 0) from = (std::max)(from, Number(height_a / (height_a - height_b)));
        if (height_b < 0) to = (std::min)(to, Number(height_a / (height_a - height_b)));
    }
    return from < to ? Number(weight * (to - from)) : Number(0);
}

PlaneVector<3> shift_derivative_of(const std::vector<Point>& polygon_1, const std::vector<Point>& polygon_2) {
    ExactVector along = CGAL::NULL_VECTOR;
    for (std::size_t j = 0; j < polygon_2.size(); ++j) {
        const Point &a = polygon_2[j], &b = polygon_2[(j + 1) % polygon_2.size()];
        if (a != b) along = along + fraction_inside(a, b, polygon_1) * (b - a);
    }
    return {rounded(along.y()), -rounded(along.x())};
}

}  // namespace

OverlapArea<2> exact_overlap_area(ProjectedFace<2> face_1, ProjectedFace<2> face_2, const PlaneVector<2>& shift) {
    const Number lower_1 = face_1[0].x(), upper_1 = face_1[1].x();
    const Number lower_2 = Number(face_2[0].x()) + shift.x(), upper_2 = Number(face_2[1].x()) + shift.x();
    const Number area = (std::min)(upper_1, upper_2) - (std::max)(lower_1, lower_2);
    if (area <= 0) return {};
    const auto weight_of_end = [](CGAL::Sign room) { return 0.5 * (1 + static_cast<int>(room)); };
    const double derivative = weight_of_end(CGAL::sign(upper_1 - upper_2)) - weight_of_end(CGAL::sign(lower_2 - lower_1));
    return {rounded_up(area), PlaneVector<2>(derivative)};
}

OverlapArea<3> exact_overlap_area(ProjectedFace<3> face_1, ProjectedFace<3> face_2, const PlaneVector<3>& shift) {
    const std::vector<Point> polygon_1 = exact_points(face_1, PlaneVector<3>::Zero()),
                             polygon_2 = exact_points(face_2, shift);
    const std::vector<Triangle> fan_1 = fan(polygon_1), fan_2 = fan(polygon_2);
    Number area = 0;
    for (const Triangle& triangle_1 : fan_1)
        for (const Triangle& triangle_2 : fan_2) area += overlap_area_of(triangle_1, triangle_2);
    if (CGAL::is_zero(area)) return {};
    return {rounded_up(area), shift_derivative_of(polygon_1, polygon_2)};
}

int exact_side(const PlaneVector<3>& a, const PlaneVector<3>& b, const PlaneVector<3>& c, const PlaneVector<3>& shift) {
    using Sum = CGAL::Mpzf;  // sums and products of doubles, without rounding
    const Sum along_x = Sum(b.x()) - Sum(a.x()), along_y = Sum(b.y()) - Sum(a.y());
    const Sum arm_x = Sum(c.x()) - Sum(a.x()) + Sum(shift.x()), arm_y = Sum(c.y()) - Sum(a.y()) + Sum(shift.y());
    return CGAL::sign(along_x * arm_y - along_y * arm_x);
}

}  // namespace abut::geometry
