#include "abut/geometry/health/face_faults.hpp"

// Only the LGPL parts of CGAL: kernels and their intersections.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_2/Segment_2_Segment_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/geometry/merged_vertices.hpp"
#include "abut/geometry/overlap/overlap.hpp"
#include "abut/geometry/polygon.hpp"

namespace abut::geometry {
namespace {

using Predicates = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::vector<Vector<3>>;

Predicates::Point_3 point_of(const Vector<3>& x) { return {x.x(), x.y(), x.z()}; }

bool is_vertex(const FaceSoup& soup, std::int32_t index) {
    return index >= 0 && static_cast<std::size_t>(index) < soup.vertices.size();
}

Corners corners_at(const FaceSoup& soup, std::span<const std::int32_t> vertices) {
    Corners corners;
    corners.reserve(vertices.size());
    for (const std::int32_t v : vertices) corners.push_back(soup.vertices[static_cast<std::size_t>(v)]);
    return corners;
}

double longest_edge(const Corners& corners) {
    double longest = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i)
        longest = std::max(longest, (corners[(i + 1) % corners.size()] - corners[i]).stableNorm());
    return longest;
}

/// Exact. The first two differ.
bool all_on_one_line(const Corners& corners) {
    const auto first = point_of(corners[0]), second = point_of(corners[1]);
    return std::all_of(corners.begin() + 2, corners.end(),
                       [&](const Vector<3>& x) { return CGAL::collinear(first, second, point_of(x)); });
}

/// The axis along which the polygon is looked at: that of the largest component of the normal of its largest triangle from
/// corner 0. The Newell normal would do for a convex polygon; that of a bow-tie may vanish.
int viewing_axis(const Corners& corners) {
    Vector<3> largest = Vector<3>::Zero();
    for (std::size_t i = 1; i < corners.size(); ++i)
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            const Vector<3> normal = (corners[i] - corners[0]).cross(corners[j] - corners[0]);
            if (normal.stableNorm() > largest.stableNorm()) largest = normal;
        }
    int axis = 0;
    largest.cwiseAbs().maxCoeff(&axis);
    return axis;
}

/// True if two edges that are no neighbours have a point in common, seen along a coordinate axis. Exact, and for a flat
/// polygon the same as in its plane.
bool touches_itself(const Corners& corners) {
    const int axis = viewing_axis(corners), u = (axis + 1) % 3, v = (axis + 2) % 3;
    const std::size_t n = corners.size();
    const auto edge = [&](std::size_t i) {
        const Vector<3>&a = corners[i], &b = corners[(i + 1) % n];
        return Predicates::Segment_2({a[u], a[v]}, {b[u], b[v]});
    };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j)
            if ((j + 1) % n != i && CGAL::do_intersect(edge(i), edge(j))) return true;
    return false;
}

FaceFault fault_of_vertices(const FaceSoup& soup, std::span<const std::int32_t> vertices) {
    if (std::any_of(vertices.begin(), vertices.end(), [&](std::int32_t v) { return !is_vertex(soup, v); }))
        return FaceFault::index_out_of_range;
    if (vertices.size() < 3) return FaceFault::too_few_corners;
    if (vertices.size() > static_cast<std::size_t>(max_polygon_vertices)) return FaceFault::too_many_corners;
    double largest = 0.0;
    for (const std::int32_t v : vertices) {
        const Vector<3>& x = soup.vertices[static_cast<std::size_t>(v)];
        if (!x.allFinite()) return FaceFault::not_finite;
        largest = std::max(largest, x.cwiseAbs().maxCoeff());
    }
    return largest > max_coordinate ? FaceFault::too_large : FaceFault::none;
}

/// True if the polygon is convex within what contact allows; only where its area is one to speak of.
bool has_convex_shape(const Corners& corners, double area) {
    return corners.size() == 3 || is_convex<3>(corners, shape_tolerance(corners) * std::sqrt(area));
}

/// A polygon whose edges are all on its hull goes around it once, unless it comes back to a corner.
FaceFault fault_of_shape(const Corners& corners, bool comes_back_to_a_corner) {
    if (all_on_one_line(corners)) return FaceFault::zero_area;
    const double length = longest_edge(corners), area = face_measure<3>(corners);
    const bool is_measurable = length >= min_length && area >= min_length * length;
    if (is_measurable && !comes_back_to_a_corner && has_convex_shape(corners, area)) return FaceFault::none;
    if (corners.size() > 3 && touches_itself(corners)) return FaceFault::crossing;
    return is_measurable ? FaceFault::non_convex : FaceFault::too_small;
}

FaceFault fault_without_others(const FaceSoup& soup, std::span<const std::int32_t> merged_vertices, std::int32_t face) {
    const FaceFault fault = fault_of_vertices(soup, soup.vertices_of(face));
    if (fault != FaceFault::none) return fault;
    const std::vector<std::int32_t> loop = distinct_corners(soup, merged_vertices, face);
    std::vector<std::int32_t> different = loop;
    sort_unique(different);
    if (different.size() < 3) return FaceFault::repeated_corner;
    return fault_of_shape(corners_at(soup, loop), different.size() < loop.size());
}

/// Faces with their corners from the smallest on, in order of these, then of the face: a face that repeats another comes
/// behind it.
struct Loop {
    std::array<std::int32_t, max_polygon_vertices> corners;
    std::int32_t size, face;

    Loop(std::span<const std::int32_t> distinct, std::int32_t of_face)
        : corners{}, size(static_cast<std::int32_t>(distinct.size())), face(of_face) {
        const auto smallest = std::min_element(distinct.begin(), distinct.end());
        std::rotate_copy(distinct.begin(), smallest, distinct.end(), corners.begin());
    }
    [[nodiscard]] bool repeats(const Loop& other) const { return size == other.size && corners == other.corners; }
    friend bool operator<(const Loop& a, const Loop& b) {
        if (a.corners != b.corners) return a.corners < b.corners;
        return a.size != b.size ? a.size < b.size : a.face < b.face;
    }
};

void mark_duplicates(const FaceSoup& soup, std::span<const std::int32_t> merged_vertices, std::vector<FaceFault>& faults) {
    std::vector<Loop> loops;
    for (std::int32_t face = 0; face < soup.size(); ++face)
        if (faults[static_cast<std::size_t>(face)] == FaceFault::none)
            loops.emplace_back(distinct_corners(soup, merged_vertices, face), face);
    std::sort(loops.begin(), loops.end());
    for (std::size_t i = 1; i < loops.size(); ++i)
        if (loops[i].repeats(loops[i - 1])) faults[static_cast<std::size_t>(loops[i].face)] = FaceFault::duplicate;
}

std::string describe_index(const FaceSoup& soup, std::span<const std::int32_t> vertices) {
    const auto bad = std::find_if(vertices.begin(), vertices.end(), [&](std::int32_t v) { return !is_vertex(soup, v); });
    return "names vertex " + (bad == vertices.end() ? std::string("?") : std::to_string(*bad)) + ", but there are " +
           std::to_string(soup.vertices.size());
}

/// Coordinates of the first vertex that `is_bad`.
template <class Predicate>
std::string position_of_bad(const FaceSoup& soup, std::span<const std::int32_t> vertices, Predicate is_bad) {
    for (const std::int32_t v : vertices) {
        const Vector<3>& x = soup.vertices[static_cast<std::size_t>(v)];
        if (is_bad(x))
            return "has vertex " + std::to_string(v) + " at (" + number(x.x()) + ", " + number(x.y()) + ", " +
                   number(x.z()) + ") m";
    }
    return "has a vertex";
}

}  // namespace

void check_offsets(const FaceSoup& soup) {
    const auto refuse = [](const std::string& what) {
        throw BadInput("faces: `face_offsets` " + what + "; it must rise from 0 to the size of `face_vertices`.");
    };
    if (soup.vertices.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw BadInput("faces: there are " + std::to_string(soup.vertices.size()) +
                       " vertices, at most 2147483647 are allowed. Coarsen the surface.");
    if (soup.face_offsets.empty()) {
        if (!soup.face_vertices.empty()) refuse("is empty for " + std::to_string(soup.face_vertices.size()) + " entries");
        return;
    }
    if (soup.face_offsets.front() != 0) refuse("begins with " + std::to_string(soup.face_offsets.front()));
    for (std::size_t face = 0; face + 1 < soup.face_offsets.size(); ++face)
        if (soup.face_offsets[face + 1] < soup.face_offsets[face]) refuse("falls after face " + std::to_string(face));
    if (static_cast<std::size_t>(soup.face_offsets.back()) != soup.face_vertices.size())
        refuse("ends with " + std::to_string(soup.face_offsets.back()) + " for " +
               std::to_string(soup.face_vertices.size()) + " entries");
}

std::vector<std::int32_t> distinct_corners(const FaceSoup& soup, std::span<const std::int32_t> merged_vertices,
                                           std::int32_t face) {
    std::vector<std::int32_t> loop;
    for (const std::int32_t v : soup.vertices_of(face)) {
        const std::int32_t merged_vertex = merged_vertices[static_cast<std::size_t>(v)];
        if (loop.empty() || loop.back() != merged_vertex) loop.push_back(merged_vertex);
    }
    while (loop.size() > 1 && loop.back() == loop.front()) loop.pop_back();
    return loop;
}

double shape_tolerance(std::span<const Vector<3>> corners) {
    return face_tolerance<3>(face_centroid<3>(corners), face_measure<3>(corners));
}

std::vector<FaceFault> face_faults(const FaceSoup& soup) {
    check_offsets(soup);
    return face_faults(soup, merged_vertices<3>(soup.vertices));
}

std::vector<FaceFault> face_faults(const FaceSoup& soup, std::span<const std::int32_t> merged_vertices) {
    check_offsets(soup);
    std::vector<FaceFault> faults(static_cast<std::size_t>(soup.size()), FaceFault::none);
    for (std::int32_t face = 0; face < soup.size(); ++face)
        faults[static_cast<std::size_t>(face)] = fault_without_others(soup, merged_vertices, face);
    mark_duplicates(soup, merged_vertices, faults);
    return faults;
}

std::string_view name(FaceFault fault) {
    switch (fault) {
        case FaceFault::none:
            return "none";
        case FaceFault::index_out_of_range:
            return "index_out_of_range";
        case FaceFault::too_few_corners:
            return "too_few_corners";
        case FaceFault::too_many_corners:
            return "too_many_corners";
        case FaceFault::not_finite:
            return "not_finite";
        case FaceFault::too_large:
            return "too_large";
        case FaceFault::repeated_corner:
            return "repeated_corner";
        case FaceFault::zero_area:
            return "zero_area";
        case FaceFault::too_small:
            return "too_small";
        case FaceFault::crossing:
            return "crossing";
        case FaceFault::non_convex:
            return "non_convex";
        case FaceFault::duplicate:
            return "duplicate";
    }
    return "unknown";
}

std::string describe(const FaceSoup& soup, std::int32_t face, FaceFault fault) {
    const auto vertices = soup.vertices_of(face);
    switch (fault) {
        case FaceFault::none:
            return "can be used";
        case FaceFault::index_out_of_range:
            return describe_index(soup, vertices);
        case FaceFault::too_few_corners:
            return "has " + std::to_string(vertices.size()) + " corners, at least 3 are needed";
        case FaceFault::too_many_corners:
            return "has " + std::to_string(vertices.size()) + " corners, at most " + std::to_string(max_polygon_vertices) +
                   " are allowed";
        case FaceFault::not_finite:
            return position_of_bad(soup, vertices, [](const Vector<3>& x) { return !x.allFinite(); }) +
                   ", finite numbers are needed";
        case FaceFault::too_large:
            return position_of_bad(soup, vertices,
                                   [](const Vector<3>& x) { return !(x.cwiseAbs().maxCoeff() <= max_coordinate); }) +
                   ", coordinates up to " + number(max_coordinate) + " m are allowed";
        case FaceFault::repeated_corner:
            return "has fewer than 3 corners at different places";
        case FaceFault::zero_area:
            return "has all its corners on one line";
        case FaceFault::too_small:
            return "has a longest edge of " + number(longest_edge(corners_at(soup, vertices))) + " m and an area of " +
                   number(face_measure<3>(corners_at(soup, vertices))) + " m^2, lengths above " + number(min_length) +
                   " m are needed";
        case FaceFault::crossing:
            return "touches or crosses itself";
        case FaceFault::non_convex:
            return "is not convex";
        case FaceFault::duplicate:
            return "repeats an earlier face";
    }
    return "is unusable";
}

}  // namespace abut::geometry
