#include <cmath>

#include "abut/geometry/pair_potential/kernel.hpp"

namespace abut::geometry {
namespace {

constexpr double tie = 1e-12;  // of the lengths: ends this near to each other share what the end of the overlap does

/// An end of the overlap: the corner of one face or, where they coincide, of both.
struct End {
    double xi;
    int corner;    ///< which it is
    int other;     ///< the corner of the other face that is next to it
    double share;  ///< of `corner`; the rest is for `other`
};

End nearer_end(double xi_1, int corner_1, double xi_2, int corner_2, bool first_is_end, double tolerance) {
    const double share = std::abs(xi_1 - xi_2) <= tolerance ? 0.5 : 1.0;
    if (first_is_end) return {xi_1, corner_1, corner_2, share};
    return {xi_2, corner_2, corner_1, share};
}

/// The faces over the line along which both are seen: xi falls from corner 0 to 1 of face 1 and rises from 2 to 3 of face 2.
class Strip {
public:
    Strip(const PairNormals<2>& normals, const PairCorners<2>& z) : normals_(normals), z_(z) {
        const double tolerance = tie * (normals.length[0] + normals.length[1]);
        high = nearer_end(z[0][0], 0, z[3][0], 3, z[0][0] < z[3][0], tolerance);
        low = nearer_end(z[1][0], 1, z[2][0], 2, z[1][0] > z[2][0], tolerance);
    }

    [[nodiscard]] double height(int face, double xi) const {
        const Vector<2>& corner = z_[2 * face];
        return corner[1] + normals_.slope[face] * (xi - corner[0]);
    }
    [[nodiscard]] double gap(double xi) const { return height(1, xi) - height(0, xi); }
    /// Linear shape function of a corner on its own face.
    [[nodiscard]] double shape(int corner, double xi) const {
        const int face = corner / 2;
        const double along = (xi - z_[2 * face][0]) / normals_.edge[face][0];
        return corner % 2 == 0 ? 1.0 - along : along;
    }

    End high{};
    End low{};

private:
    const PairNormals<2>& normals_;
    const PairCorners<2>& z_;
};

/// Derivative for face `face` with unit lengths: d(n_1 . n_2)/d(second corner less first).
Vector<2> facing_gradient(const PairNormals<2>& normals, int face) {
    const double own = normals.length[face], other = normals.length[1 - face];
    return normals.edge[1 - face] / (own * other) - normals.facing / (own * own) * normals.edge[face];
}

void add_facing(const PairNormals<2>& normals, double factor, PairCorners<2>& gradient) {
    for (int face = 0; face < 2; ++face) {
        const Vector<2> of_edge = factor * facing_gradient(normals, face);
        gradient[2 * face] -= of_edge;
        gradient[2 * face + 1] += of_edge;
    }
}

}  // namespace

template <>
double facing_cosine(const PairCorners<2>& corners) {
    const Vector<2> edge_1 = corners[1] - corners[0], edge_2 = corners[3] - corners[2];
    return edge_1.dot(edge_2) / (edge_1.norm() * edge_2.norm());
}

PairNormals<2>::PairNormals(const PairCorners<2>& z) : edge{z[1] - z[0], z[3] - z[2]} {
    for (int face = 0; face < 2; ++face) {
        length[face] = edge[face].norm();
        slope[face] = edge[face][1] / edge[face][0];
    }
    facing = edge[0].dot(edge[1]) / (length[0] * length[1]);
}

template <>
PairEnergy<2> pair_energy(const PairNormals<2>& normals, const PairCorners<2>& z, const PairLaw<2>& law,
                          bool with_gradient) {
    PairEnergy<2> result;
    if (normals.facing >= law.facing.none) return result;
    const Strip strip(normals, z);
    const double low = strip.low.xi, high = strip.high.xi;
    if (!(high > low)) return result;
    const double gap_low = strip.gap(low) + law.offset, gap_high = strip.gap(high) + law.offset;
    if (gap_low >= 0.0 && gap_high >= 0.0) return result;

    // used where the signs differ; rounding may take it past an end
    const double root = std::clamp(low + (high - low) * gap_low / (gap_low - gap_high), low, high);
    const double p = gap_low < 0.0 ? low : root, q = gap_high < 0.0 ? high : root, m = 0.5 * (p + q);
    const double g_p = std::min(gap_low, 0.0), g_q = std::min(gap_high, 0.0), g_m = 0.5 * (g_p + g_q);
    const double energy = law.stiffness * (q - p) / 12.0 * (g_p * g_p + 4.0 * g_m * g_m + g_q * g_q);
    const FacingWeight weight = facing_weight(normals.facing, law.facing);
    result.energy = weight.chi * energy;
    result.area = q - p;
    result.gap = std::min(g_p, g_q);
    if (!with_gradient) return result;

    for (int corner = 0; corner < 4; ++corner) {
        const double sign = corner < 2 ? -1.0 : 1.0;
        const double integral =
            law.stiffness * (q - p) / 6.0 *
            (g_p * strip.shape(corner, p) + 4.0 * g_m * strip.shape(corner, m) + g_q * strip.shape(corner, q));
        result.pressure[corner] = -weight.chi * integral;
        result.gradient[corner] = weight.chi * sign * integral * Vector<2>(-normals.slope[corner < 2 ? 0 : 1], 1.0);
    }
    const auto add_end = [&](const End& end, double gap, double sign) {
        const double pull = weight.chi * sign * 0.5 * law.stiffness * gap * gap;
        result.gradient[end.corner][0] += end.share * pull;
        result.gradient[end.other][0] += (1.0 - end.share) * pull;
    };
    add_end(strip.high, g_q, 1.0);
    add_end(strip.low, g_p, -1.0);
    if (weight.slope != 0.0) add_facing(normals, energy * weight.slope, result.gradient);
    return result;
}

template <>
PairView pair_view(const PairNormals<2>& normals, const PairCorners<2>& z, double offset) {
    const Strip strip(normals, z);
    const double low = strip.low.xi, high = strip.high.xi;
    if (!(high > low)) return {0.0, strip.gap(0.5 * (low + high)) + offset};
    return {high - low, std::min(strip.gap(low), strip.gap(high)) + offset};
}

}  // namespace abut::geometry
