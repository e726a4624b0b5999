#include <cmath>
#include <cstdint>

#include "abut/geometry/pair_potential/kernel.hpp"
#include "abut/geometry/pair_potential/plane_overlap.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::geometry {
namespace {

/// Both triangles seen along their common normal: corners in the plane, and the heights over it.
struct Seen {
    Seen(const PairNormals<3>& normals, const PairCorners<3>& z) {
        for (int v = 0; v < 6; ++v) {
            plane[v] = Vector<2>(normals.tangent[0].dot(z[v]), normals.tangent[1].dot(z[v]));
            height[v] = normals.common.dot(z[v]);
        }
    }
    [[nodiscard]] bool is_apart(double offset) const {
        return std::min({height[3], height[4], height[5]}) + offset >= std::max({height[0], height[1], height[2]});
    }
    [[nodiscard]] double gap(const PairNormals<3>& normals, const Vector<2>& q) const {
        return height[3] - height[0] + normals.slope[1].dot(q - plane[3]) - normals.slope[0].dot(q - plane[0]);
    }

    std::array<Vector<2>, 6> plane;
    std::array<double, 6> height;
};

/// Integrals over the part of the overlap where g < 0, of g and of g (q - origin).
struct Moments {
    Vector<2> origin;
    double area = 0.0;
    double gap = 0.0;
    Vector<2> first = Vector<2>::Zero();
    double gap_at_origin = 0.0;
    Vector<2> gap_slope;

    [[nodiscard]] double gap_squared() const { return gap_at_origin * gap + gap_slope.dot(first); }
};

double cross(const Vector<2>& a, const Vector<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

/// By the triangles between the first corner and each edge; g is linear.
Moments moments_of(const PlanePolygon& polygon, const Vector<2>& gap_slope) {
    Moments m{.origin = polygon.corner[0].at, .gap_at_origin = polygon.corner[0].gap, .gap_slope = gap_slope};
    for (int i = 1; i + 1 < polygon.size; ++i) {
        const Vector<2> r_1 = polygon.corner[i].at - m.origin, r_2 = polygon.corner[i + 1].at - m.origin;
        const double area = 0.5 * cross(r_1, r_2);
        const double g_0 = m.gap_at_origin, g_1 = polygon.corner[i].gap, g_2 = polygon.corner[i + 1].gap;
        const double sum = g_0 + g_1 + g_2;
        m.area += area;
        m.gap += area / 3.0 * sum;
        m.first += area / 12.0 * ((sum + g_1) * r_1 + (sum + g_2) * r_2);
    }
    return m;
}

/// dW0/d of heights and of places in the plane, of each corner.
struct PlaneGradient {
    std::array<double, 6> height{};
    std::array<Vector<2>, 6> plane;
    PairPressure<3> pressure{};  ///< int k |g| N_v
};

/// Adds the gradient of g over the inside: I_v = k int g N_v.
void add_inside(const PairNormals<3>& normals, const Seen& seen, const Moments& moments, double stiffness,
                PlaneGradient& gradient) {
    for (int face = 0; face < 2; ++face) {
        const int a = 3 * face, b = a + 1, c = a + 2;
        const Vector<2> ab = seen.plane[b] - seen.plane[a], ac = seen.plane[c] - seen.plane[a];
        const double twice_area = cross(ab, ac);
        const Vector<2> slope_b = Vector<2>(ac[1], -ac[0]) / twice_area, slope_c = Vector<2>(-ab[1], ab[0]) / twice_area;
        const Vector<2> from_a = moments.origin - seen.plane[a];
        const double of_b = stiffness * (slope_b.dot(from_a) * moments.gap + slope_b.dot(moments.first));
        const double of_c = stiffness * (slope_c.dot(from_a) * moments.gap + slope_c.dot(moments.first));
        const std::array<double, 3> integral{stiffness * moments.gap - of_b - of_c, of_b, of_c};
        const double sign = face == 0 ? -1.0 : 1.0;
        for (int i = 0; i < 3; ++i) {
            gradient.pressure[a + i] = -integral[i];
            gradient.height[a + i] = sign * integral[i];
            gradient.plane[a + i] = -sign * integral[i] * normals.slope[face];
        }
    }
}

/// Adds the gradient of the motion of an edge of the overlap, that of the edge of a face from corner `start` to `end`.
void add_edge(const PlaneCorner& from, const PlaneCorner& to, int start, int end, double factor, const Seen& seen,
              PlaneGradient& gradient) {
    constexpr double gauss = 0.21132486540518711775;  // (1 - 1/sqrt(3))/2
    const Vector<2> along = to.at - from.at, outward(along[1], -along[0]);
    const Vector<2> parent = seen.plane[end] - seen.plane[start];
    const double squared_length = parent.squaredNorm();
    for (const double at : {gauss, 1.0 - gauss}) {
        const double gap = from.gap + at * (to.gap - from.gap);
        const double on_parent = parent.dot(from.at + at * along - seen.plane[start]) / squared_length;
        const Vector<2> pull = factor * 0.25 * gap * gap * outward;
        gradient.plane[start] += (1.0 - on_parent) * pull;
        gradient.plane[end] += on_parent * pull;
    }
}

void add_edges(const PlanePolygon& polygon, double stiffness, const Seen& seen, PlaneGradient& gradient) {
    for (int i = 0; i < polygon.size; ++i) {
        const PlaneCorner &from = polygon.corner[i], &to = polygon.corner[i + 1 < polygon.size ? i + 1 : 0];
        const int line_1 = first_line(from.lines & to.lines & lines_of_face_1);
        const int line_2 = first_line(from.lines & to.lines & lines_of_face_2);
        const double factor = line_1 >= 0 && line_2 >= 0 ? 0.5 * stiffness : stiffness;  // an edge of both faces: half each
        if (line_1 >= 0) add_edge(from, to, line_1, (line_1 + 1) % 3, factor, seen, gradient);
        if (line_2 >= 0) add_edge(from, to, line_2, 3 + (line_2 - 2) % 3, factor, seen, gradient);
    }
}

/// dW/dz from dW0 in the plane: along n and in the plane, what turns n, and what turns the faces against each other.
PairCorners<3> in_space(const PairNormals<3>& normals, const Seen& seen, const PlaneGradient& plane, double energy,
                        const FacingWeight& weight) {
    PairCorners<3> gradient;
    Vector<2> turn = Vector<2>::Zero();
    for (int v = 0; v < 6; ++v) {
        gradient[v] = weight.chi * (plane.plane[v][0] * normals.tangent[0] + plane.plane[v][1] * normals.tangent[1] +
                                    plane.height[v] * normals.common);
        turn += plane.height[v] * seen.plane[v] - seen.height[v] * plane.plane[v];
    }
    const Vector<3> of_common =
        weight.chi / normals.difference * (turn[0] * normals.tangent[0] + turn[1] * normals.tangent[1]);
    for (int face = 0; face < 2; ++face) {
        const double sign = face == 0 ? 1.0 : -1.0;
        const Vector<3>& normal = normals.normal[face];
        const Vector<3> of_normal = sign * of_common + energy * weight.slope * normals.normal[1 - face];
        const Vector<3> of_area = (of_normal - normal * normal.dot(of_normal)) / normals.twice_area[face];
        const Vector<3> of_b = normals.edge_c[face].cross(of_area), of_c = of_area.cross(normals.edge_b[face]);
        gradient[3 * face] -= of_b + of_c;
        gradient[3 * face + 1] += of_b;
        gradient[3 * face + 2] += of_c;
    }
    return gradient;
}

}  // namespace

template <>
double facing_cosine(const PairCorners<3>& corners) {
    const Vector<3> area_1 = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const Vector<3> area_2 = (corners[4] - corners[3]).cross(corners[5] - corners[3]);
    return area_1.dot(area_2) / (area_1.norm() * area_2.norm());
}

PairNormals<3>::PairNormals(const PairCorners<3>& z) : edge_b{z[1] - z[0], z[4] - z[3]}, edge_c{z[2] - z[0], z[5] - z[3]} {
    for (int face = 0; face < 2; ++face) {
        normal[face] = edge_b[face].cross(edge_c[face]);
        twice_area[face] = normal[face].norm();
        normal[face] /= twice_area[face];
    }
    facing = normal[0].dot(normal[1]);
    if (facing > no_normal_cosine) return;
    common = normal[0] - normal[1];
    difference = common.norm();
    common /= difference;
    const PlaneFrame<3> frame(common);
    tangent = {frame.tangents().col(0), frame.tangents().col(1)};
    for (int face = 0; face < 2; ++face)
        slope[face] = -Vector<2>(tangent[0].dot(normal[face]), tangent[1].dot(normal[face])) / common.dot(normal[face]);
}

template <>
PairEnergy<3> pair_energy(const PairNormals<3>& normals, const PairCorners<3>& z, const PairLaw<3>& law,
                          bool with_gradient) {
    PairEnergy<3> result;
    if (normals.facing >= law.facing.none) return result;
    const Seen seen(normals, z);
    if (seen.is_apart(law.offset)) return result;
    PlanePolygon polygon = overlap_in_plane(seen.plane);
    for (int i = 0; i < polygon.size; ++i) polygon.corner[i].gap = seen.gap(normals, polygon.corner[i].at) + law.offset;
    keep_negative_gap(polygon);
    if (!has_area(polygon, seen.plane)) return result;

    const Moments moments = moments_of(polygon, normals.slope[1] - normals.slope[0]);
    const double energy = std::max(0.5 * law.stiffness * moments.gap_squared(), 0.0);  // rounding may take it below
    const FacingWeight weight = facing_weight(normals.facing, law.facing);
    result.energy = weight.chi * energy;
    result.area = moments.area;
    for (int i = 0; i < polygon.size; ++i) result.gap = std::min(result.gap, polygon.corner[i].gap);
    if (!with_gradient) return result;
    PlaneGradient plane;
    add_inside(normals, seen, moments, law.stiffness, plane);
    add_edges(polygon, law.stiffness, seen, plane);
    result.gradient = in_space(normals, seen, plane, energy, weight);
    for (std::size_t v = 0; v < plane.pressure.size(); ++v) result.pressure[v] = weight.chi * plane.pressure[v];
    return result;
}

template <>
PairView pair_view(const PairNormals<3>& normals, const PairCorners<3>& z, double offset) {
    const Seen seen(normals, z);
    const PlanePolygon polygon = overlap_in_plane(seen.plane);
    if (!has_area(polygon, seen.plane)) return {0.0, seen.gap(normals, halfway_between(seen.plane)) + offset};
    PairView view;
    for (int i = 0; i < polygon.size; ++i) view.gap = std::min(view.gap, seen.gap(normals, polygon.corner[i].at) + offset);
    for (int i = 1; i + 1 < polygon.size; ++i)
        view.overlap +=
            0.5 * cross(polygon.corner[i].at - polygon.corner[0].at, polygon.corner[i + 1].at - polygon.corner[0].at);
    return view;
}

}  // namespace abut::geometry
