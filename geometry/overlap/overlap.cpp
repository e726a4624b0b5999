#include "abut/geometry/overlap/overlap.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/geometry/overlap/batch.hpp"
#include "abut/geometry/overlap/kernels.hpp"

namespace abut::geometry {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <int Dim>
std::string text_of(const PlaneVector<Dim>& p) {
    if constexpr (Dim == 2)
        return number(p.x()) + " m";
    else
        return "(" + number(p.x()) + ", " + number(p.y()) + ") m";
}

template <int Dim>
[[noreturn]] void refuse_not_finite(ProjectedFace<Dim> face_1, ProjectedFace<Dim> face_2, const PlaneVector<Dim>& shift) {
    for (const int face : {1, 2}) {
        const ProjectedFace<Dim> corners = face == 1 ? face_1 : face_2;
        for (std::size_t i = 0; i < corners.size(); ++i)
            if (!corners[i].allFinite())
                throw BadInput("overlap: corner " + std::to_string(i) + " of face " + std::to_string(face) + " is at " +
                               text_of<Dim>(corners[i]) + "; coordinates must be finite. Correct the face.");
    }
    throw BadInput("overlap: the shift is " + text_of<Dim>(shift) + "; it must be finite. Correct it.");
}

// Exact arithmetic knows finite numbers alone, and comparisons would let the others pass as faces that lie apart.
template <int Dim>
void check_finite(ProjectedFace<Dim> face_1, ProjectedFace<Dim> face_2, const PlaneVector<Dim>& shift) {
    PlaneVector<Dim> zero = 0.0 * shift;  // NaN where a number is not finite
    for (const PlaneVector<Dim>& corner : face_1) zero += 0.0 * corner;
    for (const PlaneVector<Dim>& corner : face_2) zero += 0.0 * corner;
    if (!(zero == PlaneVector<Dim>::Zero())) refuse_not_finite<Dim>(face_1, face_2, shift);
}

// What rounding takes off a + b: a + b = fl(a + b) + sum_error(a, b) exactly (Knuth).
double sum_error(double a, double b) {
    const double sum = a + b, of_b = sum - a;
    return (a - (sum - of_b)) + (b - of_b);
}

// Sign of a b - c d, without rounding; nothing where products may underflow. Rounding keeps the order of two numbers, so
// that only equal products leave the decision to what rounding took off them.
std::optional<int> sign_of_difference(double a, double b, double c, double d) {
    constexpr double smallest = 1e-280;  // of a product whose rounding error is still a double
    const double ab = a * b, cd = c * d;
    if ((std::abs(ab) < smallest && a != 0.0 && b != 0.0) || (std::abs(cd) < smallest && c != 0.0 && d != 0.0))
        return std::nullopt;
    const double difference = ab != cd ? ab - cd : std::fma(a, b, -ab) - std::fma(c, d, -cd);
    return (difference > 0.0) - (difference < 0.0);
}

double sum_of_components(const PlaneVector<3>& v) { return std::abs(v.x()) + std::abs(v.y()); }

// The side of the line from a to b on which c + shift lies, as `exact_side`: at once where doubles can tell, and with little
// more work where the differences of the coordinates are doubles, as on meshes that match. Seen from the nearer end: where
// corners coincide except for rounding their difference is a double, and doubles tell mostly.
int side(const PlaneVector<3>& a, const PlaneVector<3>& b, const PlaneVector<3>& c, const PlaneVector<3>& shift,
         Arithmetic& used) {
    const PlaneVector<3> along = b - a, from_a = c - a, from_b = c - b;
    const bool at_b = sum_of_components(from_b + shift) < sum_of_components(from_a + shift);
    const PlaneVector<3>&end = at_b ? b : a, &arm_before = at_b ? from_b : from_a;
    const PlaneVector<3> arm = arm_before + shift;
    const double left = along.x() * arm.y(), right = along.y() * arm.x();
    const double error =
        4 * epsilon *
            (std::abs(left) + std::abs(right) + std::abs(along.x() * shift.y()) + std::abs(along.y() * shift.x())) +
        std::numeric_limits<double>::min();
    if (std::abs(left - right) > error) return left > right ? 1 : -1;
    bool is_rounded = false;
    for (int i = 0; i < 2; ++i)
        is_rounded = is_rounded || sum_error(b[i], -a[i]) != 0.0 || sum_error(c[i], -end[i]) != 0.0 ||
                     sum_error(arm_before[i], shift[i]) != 0.0;
    if (!is_rounded)
        if (const auto sign = sign_of_difference(along.x(), arm.y(), along.y(), arm.x())) return *sign;
    used = Arithmetic::exact;
    return exact_side(a, b, c, shift);
}

// Whether the line of an edge has all of `other`, shifted, on it or on its outer side. An edge without length separates
// nothing.
bool edge_separates(ProjectedFace<3> face, std::size_t edge, ProjectedFace<3> other, const PlaneVector<3>& shift,
                    Arithmetic& used) {
    const PlaneVector<3>&a = face[edge], &b = face[edge + 1 == face.size() ? 0 : edge + 1];
    return a != b && std::all_of(other.begin(), other.end(),
                                 [&](const PlaneVector<3>& point) { return side(a, b, point, shift, used) <= 0; });
}

bool an_edge_separates(ProjectedFace<3> face, ProjectedFace<3> other, const PlaneVector<3>& shift, Arithmetic& used) {
    for (std::size_t i = 0; i < face.size(); ++i)
        if (edge_separates(face, i, other, shift, used)) return true;
    return false;
}

bool has_interior(ProjectedFace<3> face, Arithmetic& used) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
        if (side(face[0], face[i], face[i + 1], PlaneVector<3>::Zero(), used) > 0) return true;
    return false;
}

// Whether the interiors of face 1 and of face 2, shifted, meet: decided on the coordinates and the shift as given.
bool interiors_meet(ProjectedFace<3> face_1, ProjectedFace<3> face_2, const PlaneVector<3>& shift, Arithmetic& used) {
    return !an_edge_separates(face_1, face_2, shift, used) && !an_edge_separates(face_2, face_1, -shift, used) &&
           has_interior(face_1, used) && has_interior(face_2, used);
}

// An edge of the clipped polygon starts at each corner. It comes from an edge of one of the two faces.
struct Corner {
    PlaneVector<3> point;
    int edge;
    bool of_face_2;
};

// Clipping by one line adds one corner to a convex polygon. The rest is for polygons that rounding made slightly
// non-convex; should even that not do, the exact method takes over.
struct Clipped {
    std::array<Corner, 3 * max_polygon_vertices> corners;
    int size = 0;
    bool full = false;

    void add(const PlaneVector<3>& point, int edge, bool of_face_2) {
        if (size == static_cast<int>(corners.size())) {
            full = true;
            return;
        }
        corners[size++] = {point, edge, of_face_2};
    }
};

// A convex polygon in coordinates relative to the first vertex of face 1: what is large and common cancels before
// anything is multiplied.
struct Polygon {
    std::array<PlaneVector<3>, max_polygon_vertices> vertices;
    int size;

    Polygon(ProjectedFace<3> face, const PlaneVector<3>& origin, const PlaneVector<3>& shift)
        : size(static_cast<int>(face.size())) {
        if (face.size() > vertices.size())
            throw BadInput("overlap: a face has " + std::to_string(face.size()) + " corners, at most " +
                           std::to_string(max_polygon_vertices) + " are allowed. Cut it into smaller ones.");
        for (int i = 0; i < size; ++i) vertices[i] = (face[i] - origin) + shift;
    }
    const PlaneVector<3>& end(int i) const { return vertices[i + 1 == size ? 0 : i + 1]; }
    PlaneVector<3> edge(int i) const { return end(i) - vertices[i]; }
    double extent() const {
        double largest = 0.0;
        for (int i = 0; i < size; ++i) largest = std::max({largest, std::abs(vertices[i].x()), std::abs(vertices[i].y())});
        return largest;
    }
};

double size_of(const Polygon& polygon) {
    double largest = 0.0;
    for (int i = 1; i < polygon.size; ++i)
        largest = std::max(largest, (polygon.vertices[i] - polygon.vertices[0]).cwiseAbs().maxCoeff());
    return largest;
}

bool is_thin(const Polygon& polygon) {
    double twice_area = 0.0;
    for (int i = 1; i + 1 < polygon.size; ++i)
        twice_area += cross(polygon.vertices[i] - polygon.vertices[0], polygon.vertices[i + 1] - polygon.vertices[0]);
    const double size = size_of(polygon);
    return size == 0.0 || twice_area < 2.0 * thin_face * (size * size);  // a point cuts nothing off
}

// Whether all of `other` lies more than `margin` [m^2], the rounding error of a height, on the outer side of edge i.
bool lies_beyond(const Polygon& polygon, int i, const Polygon& other, double margin) {
    const PlaneVector<3> start = polygon.vertices[i], edge = polygon.edge(i);
    for (int k = 0; k < other.size; ++k)
        if (cross(edge, other.vertices[k] - start) >= -margin) return false;
    return true;
}

bool lies_beyond_an_edge(const Polygon& polygon, const Polygon& other, double margin) {
    for (int i = 0; i < polygon.size; ++i)
        if (lies_beyond(polygon, i, other, margin)) return true;
    return false;
}

// Sutherland-Hodgman: keeps what lies left of edge `line` of face 1. Returns the largest height above that line,
// in units of (length of the edge) x (distance).
double clip(const Clipped& in, const PlaneVector<3>& start, const PlaneVector<3>& direction, int line, Clipped& out) {
    out.size = 0;
    double highest = -std::numeric_limits<double>::infinity();
    double height = cross(direction, in.corners[0].point - start);
    for (int k = 0; k < in.size; ++k) {
        const Corner& corner = in.corners[k];
        const Corner& next = in.corners[k + 1 == in.size ? 0 : k + 1];
        const double next_height = cross(direction, next.point - start);
        highest = std::max(highest, height);
        if (height >= 0.0) out.add(corner.point, corner.edge, corner.of_face_2);
        if ((height >= 0.0) != (next_height >= 0.0)) {
            const PlaneVector<3> crossing = corner.point + height / (height - next_height) * (next.point - corner.point);
            if (height >= 0.0)
                out.add(crossing, line, false);
            else
                out.add(crossing, corner.edge, corner.of_face_2);
        }
        height = next_height;
    }
    return highest;
}

double area_of(const Clipped& polygon) {
    double twice = 0.0;
    for (int k = 1; k + 1 < polygon.size; ++k)
        twice += cross(polygon.corners[k].point - polygon.corners[0].point,
                       polygon.corners[k + 1].point - polygon.corners[0].point);
    return 0.5 * twice;
}

// Whether edges i of 1 and j of 2 lie on one line: both ends of either are within `distance` of the other's line.
bool coincide(const Polygon& polygon_1, int i, const Polygon& polygon_2, int j, double distance) {
    const PlaneVector<3> edge_1 = polygon_1.edge(i), edge_2 = polygon_2.edge(j);
    const double length_1 = edge_1.cwiseAbs().sum(), length_2 = edge_2.cwiseAbs().sum();
    if (std::abs(cross(edge_1, edge_2)) > 2.0 * distance * (length_1 + length_2)) return false;  // the common case
    if (length_1 <= distance || length_2 <= distance) return false;  // too short to have a direction
    const auto lies_on = [distance](const PlaneVector<3>& a, const PlaneVector<3>& b, const PlaneVector<3>& start,
                                    const PlaneVector<3>& line) {
        const double limit = distance * line.norm();
        return std::abs(cross(line, a - start)) <= limit && std::abs(cross(line, b - start)) <= limit;
    };
    return lies_on(polygon_2.vertices[j], polygon_2.end(j), polygon_1.vertices[i], edge_1) ||
           lies_on(polygon_1.vertices[i], polygon_1.end(i), polygon_2.vertices[j], edge_2);
}

// How much of a piece of the boundary of the overlap counts. Every piece is there once, labelled with one of the faces;
// where edges of both coincide rounding picks the label, so either label counts half. Coinciding edges of opposite
// direction bound faces that lie side by side: their overlap is rounding, and counts as none.
double weight_of(const Corner& corner, const Polygon& polygon_1, const Polygon& polygon_2, double distance) {
    const int n = corner.of_face_2 ? polygon_1.size : polygon_2.size;
    for (int k = 0; k < n; ++k) {
        const int i = corner.of_face_2 ? k : corner.edge, j = corner.of_face_2 ? corner.edge : k;
        if (coincide(polygon_1, i, polygon_2, j, distance))
            return polygon_1.edge(i).dot(polygon_2.edge(j)) > 0.0 ? 0.5 : 0.0;
    }
    return corner.of_face_2 ? 1.0 : 0.0;
}

PlaneVector<3> shift_derivative_of(const Clipped& overlap, const Polygon& polygon_1, const Polygon& polygon_2,
                                   double distance) {
    PlaneVector<3> along = PlaneVector<3>::Zero();
    for (int k = 0; k < overlap.size; ++k) {
        const Corner& corner = overlap.corners[k];
        const Corner& next = overlap.corners[k + 1 == overlap.size ? 0 : k + 1];
        along += weight_of(corner, polygon_1, polygon_2, distance) * (next.point - corner.point);
    }
    return {along.y(), -along.x()};
}

OverlapArea<3> clipped_overlap_area(ProjectedFace<3> face_1, ProjectedFace<3> face_2, const PlaneVector<3>& shift,
                                    Arithmetic& used) {
    const Polygon polygon_1(face_1, face_1[0], PlaneVector<3>::Zero());
    const Polygon polygon_2(face_2, face_1[0], shift);
    const double extent = std::max(polygon_1.extent(), polygon_2.extent());
    const double distance_error =
        16 * epsilon * (extent + shift.cwiseAbs().maxCoeff());  // a long shift rounds more than what is left of it
    const double area_error = distance_error * extent * (polygon_1.size + polygon_2.size);  // also of a height over an edge

    std::array<Clipped, 2> buffers;
    Clipped *overlap = &buffers[0], *clipped = &buffers[1];
    for (int j = 0; j < polygon_2.size; ++j) overlap->add(polygon_2.vertices[j], j, true);
    for (int i = 0; i < polygon_1.size && overlap->size > 0; ++i) {
        const PlaneVector<3> edge = polygon_1.edge(i);
        const double highest = clip(*overlap, polygon_1.vertices[i], edge, i, *clipped);
        const bool is_empty = highest < -distance_error * edge.cwiseAbs().sum();
        if (is_empty && lies_beyond(polygon_1, i, polygon_2, area_error)) return {};
        std::swap(overlap, clipped);
    }
    if (buffers[0].full || buffers[1].full) {
        used = Arithmetic::exact;
        return exact_overlap_area(face_1, face_2, shift);
    }

    double area = area_of(*overlap);
    if (area <= area_error &&
        (lies_beyond_an_edge(polygon_2, polygon_1, area_error) || !interiors_meet(face_1, face_2, shift, used)))
        return {};
    if (is_thin(polygon_1) || is_thin(polygon_2)) {
        used = Arithmetic::exact;
        area = exact_overlap_area(face_1, face_2, shift).area;
        if (area == 0.0) return {};  // one of them is a point or a line
    }
    const double coincidence_distance = coincidence_tolerance * std::max(size_of(polygon_1), size_of(polygon_2));
    return {std::max(area, std::numeric_limits<double>::min()),
            shift_derivative_of(*overlap, polygon_1, polygon_2, coincidence_distance)};
}

OverlapArea<3> fast_overlap_area(ProjectedFace<3> face_1, ProjectedFace<3> face_2, const PlaneVector<3>& shift) {
    Arithmetic used = Arithmetic::doubles;
    return clipped_overlap_area(face_1, face_2, shift, used);
}

// Whether a + b < c, without rounding: the rounded sum decides unless it is c itself.
bool sum_is_below(double a, double b, double c) { return a + b < c || (a + b == c && sum_error(a, b) < 0.0); }

bool interiors_meet(ProjectedFace<2> face_1, ProjectedFace<2> face_2, double shift) {
    return face_1[0].x() < face_1[1].x() && face_2[0].x() < face_2[1].x() &&
           sum_is_below(face_2[0].x(), shift, face_1[1].x()) && sum_is_below(-face_2[1].x(), -shift, -face_1[0].x());
}

// 1 where the end of segment 2 cuts segment 1, 0 where segment 1 ends first, half where both end together.
double weight_of_end(double room, double tolerance) { return std::abs(room) <= tolerance ? 0.5 : (room > 0.0 ? 1.0 : 0.0); }

OverlapArea<2> fast_overlap_area(ProjectedFace<2> face_1, ProjectedFace<2> face_2, const PlaneVector<2>& shift) {
    if (!interiors_meet(face_1, face_2, shift.x())) return {};
    const double length_1 = face_1[1].x() - face_1[0].x();
    const double lower_2 = (face_2[0].x() - face_1[0].x()) + shift.x();
    const double upper_2 = (face_2[1].x() - face_1[0].x()) + shift.x();
    const double area = std::min(length_1, upper_2) - std::max(0.0, lower_2);
    const double tolerance = coincidence_tolerance * std::max(length_1, upper_2 - lower_2);
    const double derivative = weight_of_end(length_1 - upper_2, tolerance) - weight_of_end(lower_2, tolerance);
    return {std::max(area, std::numeric_limits<double>::min()), PlaneVector<2>(derivative)};
}

}  // namespace

template <int Dim>
OverlapArea<Dim> overlap_area(ProjectedFace<Dim> face_1, ProjectedFace<Dim> face_2, const PlaneVector<Dim>& shift,
                              AreaMethod method) {
    assert(face_1.size() >= Dim && face_1.size() <= max_polygon_vertices);
    assert(face_2.size() >= Dim && face_2.size() <= max_polygon_vertices);
    check_finite<Dim>(face_1, face_2, shift);
    return method == AreaMethod::fast ? fast_overlap_area(face_1, face_2, shift) : exact_overlap_area(face_1, face_2, shift);
}

template <>
std::vector<PlaneVector<2>> overlap_polygon<2>(ProjectedFace<2> face_1, ProjectedFace<2> face_2) {
    check_finite<2>(face_1, face_2, PlaneVector<2>::Zero());
    if (!interiors_meet(face_1, face_2, 0.0)) return {};
    return {PlaneVector<2>(std::max(face_1[0].x(), face_2[0].x())), PlaneVector<2>(std::min(face_1[1].x(), face_2[1].x()))};
}

template <>
std::vector<PlaneVector<3>> overlap_polygon<3>(ProjectedFace<3> face_1, ProjectedFace<3> face_2) {
    const PlaneVector<3> no_shift = PlaneVector<3>::Zero();
    check_finite<3>(face_1, face_2, no_shift);
    if (fast_overlap_area(face_1, face_2, no_shift).area == 0.0) return {};
    const Polygon polygon_1(face_1, face_1[0], no_shift), polygon_2(face_2, face_1[0], no_shift);
    std::array<Clipped, 2> buffers;
    Clipped *overlap = &buffers[0], *clipped = &buffers[1];
    for (int j = 0; j < polygon_2.size; ++j) overlap->add(polygon_2.vertices[j], j, true);
    for (int i = 0; i < polygon_1.size && overlap->size > 0; ++i) {
        clip(*overlap, polygon_1.vertices[i], polygon_1.edge(i), i, *clipped);
        std::swap(overlap, clipped);
    }
    std::vector<PlaneVector<3>> corners;
    for (int k = 0; k < overlap->size; ++k) corners.push_back(face_1[0] + overlap->corners[k].point);
    return corners;
}

OverlapArea<3> counted_overlap_area(ProjectedFace<3> face_1, ProjectedFace<3> face_2, const PlaneVector<3>& shift,
                                    DecisionCounts& counts) {
    check_finite<3>(face_1, face_2, shift);
    Arithmetic used = Arithmetic::doubles;
    const OverlapArea<3> shared = clipped_overlap_area(face_1, face_2, shift, used);
    ++(used == Arithmetic::exact ? counts.by_exact_arithmetic : counts.by_scalar_path);
    return shared;
}

template OverlapArea<2> overlap_area<2>(ProjectedFace<2>, ProjectedFace<2>, const PlaneVector<2>&, AreaMethod);
template OverlapArea<3> overlap_area<3>(ProjectedFace<3>, ProjectedFace<3>, const PlaneVector<3>&, AreaMethod);

}  // namespace abut::geometry
