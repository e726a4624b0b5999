#pragma once
// Private to the layer; see lanes.hpp.
#include "abut/geometry/pair_potential/lanes/lanes.hpp"

namespace abut::geometry::lanes {

/// PairLaw, of a pair in each lane.
template <class T>
struct LaneLaw {
    T stiffness;
    T length[2];
    T full, none;  // of FacingFade
    T offset;
};

template <class T, int Dim>
LaneCorners<T, Dim> from_mean(const LaneCorners<T, Dim>& x) {
    LaneVector<T, Dim> mean = x.at[0];
    for (int v = 1; v < 2 * Dim; ++v) mean += x.at[v];
    mean = T(1.0 / (2 * Dim)) * mean;
    LaneCorners<T, Dim> y;
    for (int v = 0; v < 2 * Dim; ++v) y.at[v] = x.at[v] - mean;
    return y;
}

template <class T, int Dim>
LaneVector<T, Dim> mean_of(const LaneVector<T, Dim>& a, const LaneVector<T, Dim>& b) {
    return T(0.5) * (a + b);
}

/// Least squared length of a mean of two unit vectors: rounding errors of momenta are divided by it.
inline constexpr double turned_over = 1e-8;

/// Coordinates z of the corners of a pair that do not change when it moves or turns as a whole.
template <class T, int Dim>
struct LaneFrame;

template <class T>
struct LaneFrame<T, 2> {
    LaneFrame(const LaneCorners<T, 2>& x, const LaneLaw<T>& law) : y(from_mean(x)) {
        const LaneVector<T, 2> d_1 = x.at[1] - x.at[0], d_2 = x.at[3] - x.at[2];
        const LaneVector<T, 2> m{d_1.c[1] / law.length[0] - d_2.c[1] / law.length[1],
                                 d_2.c[0] / law.length[1] - d_1.c[0] / law.length[0]};
        m_length = norm(m);
        normal = {m.c[0] / m_length, m.c[1] / m_length};
        along = {normal.c[1], -normal.c[0]};
        for (int v = 0; v < 4; ++v) z.at[v] = {dot(along, y.at[v]), dot(normal, y.at[v])};
    }
    [[nodiscard]] LaneVector<T, 2> in_space(const LaneVector<T, 2>& a) const { return a.c[0] * along + a.c[1] * normal; }

    LaneCorners<T, 2> y;      // from the mean of the corners
    T m_length;               // of n_1 - n_2 with lengths at rest, linear in x
    LaneVector<T, 2> normal;  // n
    LaneVector<T, 2> along;   // t
    LaneCorners<T, 2> z;      // (t . y, n . y)
};

/// The normal of face 1 is e_3, and the first edge of face 1 lies along e_1.
template <class T>
struct LaneFrame<T, 3> {
    LaneFrame(const LaneCorners<T, 3>& x, const LaneLaw<T>&)
        : y(from_mean(x)), edge_b(x.at[1] - x.at[0]), edge_c(x.at[2] - x.at[0]) {
        e[0] = (T(1.0) / norm(edge_b)) * edge_b;
        const LaneVector<T, 3> area = cross(edge_b, edge_c);
        // the product of two edges that are long beside the width of their face is off by rounding along these, too
        e[2] = (T(1.0) / norm(area)) * (area - dot(area, e[0]) * e[0]);
        e[1] = cross(e[2], e[0]);
        for (int v = 0; v < 6; ++v) z.at[v] = {dot(e[0], y.at[v]), dot(e[1], y.at[v]), dot(e[2], y.at[v])};
    }
    [[nodiscard]] LaneVector<T, 3> in_space(const LaneVector<T, 3>& a) const {
        return a.c[0] * e[0] + a.c[1] * e[1] + a.c[2] * e[2];
    }

    LaneCorners<T, 3> y;
    LaneVector<T, 3> edge_b, edge_c;  // of face 1, from its first corner
    LaneVector<T, 3> e[3];
    LaneCorners<T, 3> z;
};

/// True if the pair turns by half a turn along a step, or next to it: there is no way back then that keeps the momenta.
template <class T>
FlagsOf<T> turns_over(const LaneFrame<T, 2>& start, const LaneFrame<T, 2>& end) {
    const LaneVector<T, 2> normal = mean_of(start.normal, end.normal);
    return dot(normal, normal) < T(turned_over);
}
template <class T>
FlagsOf<T> turns_over(const LaneFrame<T, 3>& start, const LaneFrame<T, 3>& end) {
    const LaneVector<T, 3> along = mean_of(start.e[0], end.e[0]), normal = mean_of(start.e[2], end.e[2]);
    return (dot(along, along) < T(turned_over)) | (dot(normal, normal) < T(turned_over));
}

/// The way back along a step: Delta z is an exact discrete derivative of z, and this is its transpose. For any phi,
/// sum result . Delta x = sum phi . Delta z, and result has neither a sum nor moments about the mean of both ends.
template <class T>
LaneCorners<T, 2> in_mean_frame(const LaneFrame<T, 2>& start, const LaneFrame<T, 2>& end, const LaneLaw<T>& law,
                                const LaneCorners<T, 2>& phi) {
    const LaneVector<T, 2> along = mean_of(start.along, end.along), normal = mean_of(start.normal, end.normal);
    LaneCorners<T, 2> result;
    T moment = T(0.0);
    for (int v = 0; v < 4; ++v) {
        const T& of_along = phi.at[v].c[0];
        const T& of_normal = phi.at[v].c[1];
        result.at[v] = of_along * along + of_normal * normal;
        const LaneVector<T, 2> y = mean_of(start.y.at[v], end.y.at[v]);
        moment = moment + (of_along * dot(normal, y) - of_normal * dot(along, y));
    }
    result = from_mean(result);
    const T m_length = T(0.5) * (start.m_length + end.m_length);
    const T factor = -moment / (m_length * dot(normal, normal));
    const LaneVector<T, 2> pull{-factor * along.c[1], factor * along.c[0]};
    const LaneVector<T, 2> of_first = (T(1.0) / law.length[0]) * pull, of_second = (T(1.0) / law.length[1]) * pull;
    result.at[0] -= of_first;
    result.at[1] += of_first;
    result.at[2] += of_second;
    result.at[3] -= of_second;
    return result;
}

template <class T>
LaneCorners<T, 3> in_mean_frame(const LaneFrame<T, 3>& start, const LaneFrame<T, 3>& end, const LaneLaw<T>&,
                                const LaneCorners<T, 3>& phi) {
    LaneVector<T, 3> e[3];
    for (int a = 0; a < 3; ++a) e[a] = mean_of(start.e[a], end.e[a]);
    LaneCorners<T, 3> result;
    LaneVector<T, 3> moment = no_vector<T, 3>();
    for (int v = 0; v < 6; ++v) {
        const auto& of = phi.at[v].c;
        result.at[v] = of[0] * e[0] + of[1] * e[1] + of[2] * e[2];
        moment += cross(result.at[v], mean_of(start.y.at[v], end.y.at[v]));
    }
    result = from_mean(result);
    const LaneVector<T, 3> edge_b = mean_of(start.edge_b, end.edge_b), edge_c = mean_of(start.edge_c, end.edge_c);
    // the columns of L^T, and L^T lambda = -moment by their triple products
    const LaneVector<T, 3> l_0 = cross(e[1], edge_b), l_1 = cross(e[2], edge_b), l_2 = cross(e[2], edge_c);
    const LaneVector<T, 3> across_0 = cross(l_1, l_2), across_1 = cross(l_2, l_0), across_2 = cross(l_0, l_1);
    const T factor = T(-1.0) / dot(l_0, across_0);
    const T lambda_0 = factor * dot(across_0, moment), lambda_1 = factor * dot(across_1, moment),
            lambda_2 = factor * dot(across_2, moment);
    const LaneVector<T, 3> at_b = lambda_0 * e[1] + lambda_1 * e[2], at_c = lambda_2 * e[2];
    result.at[0] -= at_b + at_c;
    result.at[1] += at_b;
    result.at[2] += at_c;
    return result;
}

}  // namespace abut::geometry::lanes
