#pragma once
// Private to the overlap sources; not installed.
#include <array>
#include <limits>

#include "abut/base/simd.hpp"
#include "abut/geometry/overlap/batch.hpp"

namespace abut::geometry {

/// Vectors in the plane, one per lane.
struct PlaneLanes {
    Lanes x, y;
    friend PlaneLanes operator+(PlaneLanes a, PlaneLanes b) { return {a.x + b.x, a.y + b.y}; }
    friend PlaneLanes operator-(PlaneLanes a, PlaneLanes b) { return {a.x - b.x, a.y - b.y}; }
    friend PlaneLanes operator*(Lanes s, PlaneLanes a) { return {s * a.x, s * a.y}; }
};

inline Lanes cross(PlaneLanes a, PlaneLanes b) { return a.x * b.y - a.y * b.x; }
inline PlaneLanes choose(LaneMask mask, PlaneLanes a, PlaneLanes b) { return {mask ? a.x : b.x, mask ? a.y : b.y}; }
inline Lanes dot(PlaneLanes a, PlaneLanes b) { return a.x * b.x + a.y * b.y; }

constexpr int next(int i) { return i == 2 ? 0 : i + 1; }
constexpr int previous(int i) { return i == 0 ? 2 : i - 1; }

/// Triangles, one per lane; edge i goes from corner i to the next.
struct TriangleLanes {
    std::array<PlaneLanes, 3> corner, edge;

    TriangleLanes(const std::array<TriangleBatch::Row, 3>& x, const std::array<TriangleBatch::Row, 3>& y, int first) {
        for (int i = 0; i < 3; ++i) corner[i] = {load_lanes(&x[i][first]), load_lanes(&y[i][first])};
        for (int i = 0; i < 3; ++i) edge[i] = corner[next(i)] - corner[i];
    }
};

/// A height over the line of an edge, times the length of the edge [m^2]. Where its sign is not sure, it means nothing.
struct SignedHeight {
    Lanes value;
    LaneMask is_sure;
};

/// An edge and a point, seen from the end that is nearer to the point. The difference of two corners that coincide except
/// for rounding is exact, and its products with the edge are as good as those of given numbers: doubles tell on which side
/// of the line the point is.
struct EdgeAndPoint {
    PlaneLanes start, end, nearer, point;
    PlaneLanes edge, arm;  ///< end - start, point - nearer: rounded
};

/// Distance between the ends of an arm, in the sum of components.
inline Lanes length_of(PlaneLanes arm) { return absolute(arm.x) + absolute(arm.y); }

inline EdgeAndPoint seen_from_nearer_end(PlaneLanes start, PlaneLanes end, PlaneLanes edge, PlaneLanes point) {
    const PlaneLanes from_start = point - start, from_end = point - end;
    const LaneMask at_end = length_of(from_end) < length_of(from_start);
    return {start, end, choose(at_end, end, start), point, edge, choose(at_end, from_end, from_start)};
}

/// Lanes in which the point lies on the line of an edge exactly, for coordinates as given.
inline LaneMask is_on_line(PlaneLanes edge, PlaneLanes arm) {
    const LaneMask at_x = arm.x == 0.0, at_y = arm.y == 0.0;
    return (at_x & (at_y | (edge.x == 0.0))) | (at_y & (edge.y == 0.0));
}

/// The height as doubles have it. Edge and arm are rounded once, so are the products and their difference: 2^-51 of the
/// products at most, and half of what is allowed here.
struct HeightInDoubles {
    SignedHeight operator()(const EdgeAndPoint& at) const {
        const Lanes left = at.edge.x * at.arm.y, right = at.edge.y * at.arm.x, height = left - right;
        const Lanes error = 4 * std::numeric_limits<double>::epsilon() * (absolute(left) + absolute(right)) +
                            std::numeric_limits<double>::min();
        return {height, absolute(height) > error};
    }
};

/// Height with twice the digits where doubles are not sure: left and right are then equal except for the last digits, and
/// their difference is exact. What rounding took off the products and off the differences of the coordinates is added. Of
/// six terms of 2^-53 of the products at most each is rounded a few times: together by less than 2^-102 of them, and half of
/// what is allowed here.
struct HeightInTwiceTheDigits {
    SignedHeight operator()(const EdgeAndPoint& at) const {
        const SignedHeight in_doubles = HeightInDoubles{}(at);
        const PlaneLanes off_edge = difference_error(at.end, at.start), off_arm = difference_error(at.point, at.nearer);
        const Lanes left = at.edge.x * at.arm.y, right = at.edge.y * at.arm.x;
        const Lanes off_products = product_error(at.edge.x, at.arm.y) - product_error(at.edge.y, at.arm.x);
        const Lanes height = (left - right) + (off_products + (cross(at.edge, off_arm) + cross(off_edge, at.arm)));
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        const Lanes error = 8 * epsilon * epsilon * (absolute(left) + absolute(right)) + std::numeric_limits<double>::min();
        return {in_doubles.is_sure ? in_doubles.value : height, in_doubles.is_sure | (absolute(height) > error)};
    }
    static PlaneLanes difference_error(PlaneLanes a, PlaneLanes b) {
        return {abut::difference_error(a.x, b.x), abut::difference_error(a.y, b.y)};
    }
};

/// From every corner of one triangle to every corner of another.
struct CornerArms {
    PlaneLanes arm[3][3];  // [corner of line][corner of point]
    Lanes length[3][3];

    CornerArms(const TriangleLanes& line, const TriangleLanes& point) {
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 3; ++i) {
                arm[k][i] = point.corner[i] - line.corner[k];
                length[k][i] = length_of(arm[k][i]);
            }
    }
    /// Edge j and corner i.
    [[nodiscard]] EdgeAndPoint at(const TriangleLanes& line, int j, const TriangleLanes& point, int i) const {
        const int k = next(j);
        const LaneMask at_end = length[k][i] < length[j][i];
        return {line.corner[j],  line.corner[k], choose(at_end, line.corner[k], line.corner[j]),
                point.corner[i], line.edge[j],   choose(at_end, arm[k][i], arm[j][i])};
    }
};

/// Heights of the corners of one triangle over the lines of the other's edges, times the length of the edge; > 0 inside.
struct Heights {
    Lanes of[3][3];  // [edge][corner]

    Heights(const TriangleLanes& line, const TriangleLanes& point) {
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) of[j][i] = cross(line.edge[j], point.corner[i] - line.corner[j]);
    }
    [[nodiscard]] LaneMask beyond(int j, Lanes limit) const { return larger(larger(of[j][0], of[j][1]), of[j][2]) < -limit; }
    [[nodiscard]] LaneMask separate(Lanes limit) const { return beyond(0, limit) | beyond(1, limit) | beyond(2, limit); }
    [[nodiscard]] Lanes least() const {
        Lanes smallest = absolute(of[0][0]);
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                const Lanes height = absolute(of[j][i]);
                smallest = height < smallest ? height : smallest;
            }
        return smallest;
    }
};

/// Conclusions from the heights of two triangles.
struct Certainty {
    LaneMask is_separated;  ///< a line has all of the other triangle on it or beyond
    LaneMask is_known;      ///< all signs are those of the given coordinates
};

/// A height within `limit` gets the sign that the coordinates have, as far as `height_of` tells. `is_given`: the coordinates
/// are those to decide on.
template <class HeightOf>
SignedHeight sharpened(Lanes height, const EdgeAndPoint& at, Lanes limit, LaneMask is_given, HeightOf height_of) {
    const LaneMask is_clear = absolute(height) > limit, is_zero = is_on_line(at.edge, at.arm);
    const SignedHeight sharp = height_of(at);
    return {is_clear ? height : (is_zero ? Lanes{} : sharp.value), is_clear | (is_given & (is_zero | sharp.is_sure))};
}

/// Sharpened heights of one triangle over all lines of another.
template <class HeightOf>
Certainty sharpen(const TriangleLanes& line, const TriangleLanes& point, Lanes limit, LaneMask is_given, HeightOf height_of,
                  Heights& heights) {
    const CornerArms arms(line, point);
    Certainty result{LaneMask{}, ~LaneMask{}};
    for (int j = 0; j < 3; ++j) {
        LaneMask is_beyond = ~LaneMask{};
        for (int i = 0; i < 3; ++i) {
            const SignedHeight height = sharpened(heights.of[j][i], arms.at(line, j, point, i), limit, is_given, height_of);
            heights.of[j][i] = height.value;
            is_beyond &= height.is_sure & (height.value <= 0.0);
            result.is_known &= height.is_sure;
        }
        result.is_separated |= is_beyond;
    }
    return result;
}

/// Among the lines of the edges of two triangles, the one that the other triangle is above the least: where one of them
/// separates the two, most often this one does.
class LowestLine {
public:
    LowestLine(const TriangleLanes& a, const TriangleLanes& b, const Heights& a_over_b, const Heights& b_over_a) {
        for (int j = 0; j < 3; ++j) {
            take_if_lower(b, j, a, a_over_b);
            take_if_lower(a, j, b, b_over_a);
        }
    }
    /// As far as doubles tell.
    [[nodiscard]] LaneMask separates(Lanes limit, LaneMask is_given) const {
        LaneMask is_beyond = ~LaneMask{};
        for (int i = 0; i < 3; ++i) {
            const SignedHeight sharp = sharpened(height_[i], seen_from_nearer_end(start_, end_, edge_, point_[i]), limit,
                                                 is_given, HeightInDoubles{});
            is_beyond &= sharp.is_sure & (sharp.value <= 0.0);
        }
        return is_beyond;
    }

private:
    void take_if_lower(const TriangleLanes& line, int j, const TriangleLanes& point, const Heights& heights) {
        const Lanes top = larger(larger(heights.of[j][0], heights.of[j][1]), heights.of[j][2]);
        const LaneMask is_lower = top < top_;
        top_ = is_lower ? top : top_;
        start_ = choose(is_lower, line.corner[j], start_);
        end_ = choose(is_lower, line.corner[next(j)], end_);
        edge_ = choose(is_lower, line.edge[j], edge_);
        for (int i = 0; i < 3; ++i) {
            point_[i] = choose(is_lower, point.corner[i], point_[i]);
            height_[i] = is_lower ? heights.of[j][i] : height_[i];
        }
    }
    Lanes top_ = Lanes{} + std::numeric_limits<double>::infinity();
    PlaneLanes start_{}, end_{}, edge_{}, point_[3]{};
    Lanes height_[3]{};
};

}  // namespace abut::geometry
