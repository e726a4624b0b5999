#pragma once
// The contact model written down once more, straight from docs/method.md, Contact, and as slowly as it likes: nothing here
// is shared with the library but the arrays of the surface.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "abut/contact/options.hpp"
#include "abut/contact/surface/surface.hpp"

namespace abut::test {

/// A_12 and its derivative with respect to a translation of face 2, as a vector of space.
template <int Dim>
struct Patch {
    double area = 0.0;
    Vector<Dim> derivative = Vector<Dim>::Zero();
};

inline Patch<2> shared_patch(const std::vector<Vector<2>>& face_1, const std::vector<Vector<2>>& face_2,
                             const Vector<2>& normal) {
    const Vector<2> t(-normal[1], normal[0]);
    const auto [lower_1, upper_1] = std::minmax({t.dot(face_1[0]), t.dot(face_1[1])});
    const auto [lower_2, upper_2] = std::minmax({t.dot(face_2[0]), t.dot(face_2[1])});
    const double length = std::min(upper_1, upper_2) - std::max(lower_1, lower_2);
    if (length <= 0.0) return {};
    return {length, ((upper_2 < upper_1 ? 1.0 : 0.0) - (lower_2 > lower_1 ? 1.0 : 0.0)) * t};
}

/// Sutherland-Hodgman for the area; for its derivative every edge of face 2 is cut to the part inside face 1.
inline Patch<3> shared_patch(const std::vector<Vector<3>>& face_1, const std::vector<Vector<3>>& face_2,
                             const Vector<3>& normal) {
    using Point = Vector<2>;
    const Vector<3> e_1 = Vector<3>(normal).unitOrthogonal();
    const Vector<3> e_2 = Vector<3>(normal).cross(Vector<3>(e_1));
    const auto cross = [](const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); };
    const auto area_of = [&](const std::vector<Point>& p) {
        double twice = 0.0;
        for (std::size_t i = 1; i + 1 < p.size(); ++i) twice += cross(p[i] - p[0], p[i + 1] - p[0]);
        return 0.5 * twice;
    };
    const auto project = [&](const std::vector<Vector<3>>& face) {
        std::vector<Point> p;
        for (const Vector<3>& x : face) p.emplace_back(e_1.dot(x), e_2.dot(x));
        if (area_of(p) < 0.0) std::reverse(p.begin(), p.end());
        return p;
    };
    const std::vector<Point> p_1 = project(face_1), p_2 = project(face_2);
    const auto side = [&](std::size_t edge, const Point& x) {
        return cross(p_1[(edge + 1) % p_1.size()] - p_1[edge], x - p_1[edge]);
    };

    std::vector<Point> clipped = p_2;
    for (std::size_t e = 0; e < p_1.size() && !clipped.empty(); ++e) {
        std::vector<Point> next;
        for (std::size_t i = 0; i < clipped.size(); ++i) {
            const Point &a = clipped[i], &b = clipped[(i + 1) % clipped.size()];
            const double s_a = side(e, a), s_b = side(e, b);
            if (s_a >= 0.0) next.push_back(a);
            if ((s_a > 0.0 && s_b < 0.0) || (s_a < 0.0 && s_b > 0.0)) next.push_back(a + s_a / (s_a - s_b) * (b - a));
        }
        clipped = std::move(next);
    }
    Patch<3> patch;
    patch.area = std::max(0.0, area_of(clipped));
    if (patch.area == 0.0) return {};
    for (std::size_t i = 0; i < p_2.size(); ++i) {
        const Point &a = p_2[i], &b = p_2[(i + 1) % p_2.size()];
        double begin = 0.0, end = 1.0;
        for (std::size_t e = 0; e < p_1.size(); ++e) {
            const double s_a = side(e, a), s_b = side(e, b);
            if (s_a < 0.0 && s_b < 0.0)
                end = begin;
            else if (s_a < 0.0)
                begin = std::max(begin, s_a / (s_a - s_b));
            else if (s_b < 0.0)
                end = std::min(end, s_a / (s_a - s_b));
        }
        if (end <= begin) continue;
        const Point outward((b - a).y(), -(b - a).x());  // times the length of the edge
        patch.derivative += (end - begin) * (outward.x() * e_1 + outward.y() * e_2);
    }
    return patch;
}

template <int Dim>
struct ReferencePair {
    std::int32_t face_1, face_2;
    Vector<Dim> normal;
    double theta_1, theta_2;
};

/// The model for a fixed set of admitted pairs.
template <int Dim>
class Reference {
public:
    Reference(const contact::SurfaceView<Dim>& surface, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs,
              contact::InterfaceWeighting weighting)
        : surface_(surface) {
        for (const auto& [f_1, f_2] : pairs) {
            ReferencePair<Dim> pair{f_1, f_2, (surface.normal[f_1] - surface.normal[f_2]).normalized(), 0.5, 0.5};
            if (!surface.steps_to_sharp_edge.empty()) {
                const int steps_1 = surface.steps_to_sharp_edge[f_1], steps_2 = surface.steps_to_sharp_edge[f_2];
                if (steps_1 < steps_2) pair.normal = -surface.normal[f_2];
                if (steps_1 > steps_2) pair.normal = surface.normal[f_1];
            }
            const double ratio = std::pow(surface.area[f_1] / surface.area[f_2], 1.0 / (Dim - 1));  // of sizes
            if (ratio > 1.45) pair.normal = surface.normal[f_1];
            if (ratio < 1.0 / 1.45) pair.normal = -surface.normal[f_2];
            const double k_1 = surface.stiffness[f_1], k_2 = surface.stiffness[f_2];
            if (weighting == contact::InterfaceWeighting::stiffness)
                pair.theta_1 = k_2 / (k_1 + k_2), pair.theta_2 = k_1 / (k_1 + k_2);
            if (std::isinf(k_1)) pair.normal = surface.normal[f_1], pair.theta_1 = 0.0, pair.theta_2 = 1.0;
            if (std::isinf(k_2)) pair.normal = -surface.normal[f_2], pair.theta_1 = 1.0, pair.theta_2 = 0.0;
            pairs_.push_back(pair);
        }
    }

    [[nodiscard]] double gap(const ReferencePair<Dim>& pair, const std::vector<Vector<Dim>>& u) const {
        return (surface_.centroid[pair.face_2] + u[pair.face_2] - surface_.centroid[pair.face_1] - u[pair.face_1])
            .dot(pair.normal);
    }
    [[nodiscard]] Patch<Dim> patch(const ReferencePair<Dim>& pair, const std::vector<Vector<Dim>>& u) const {
        return shared_patch(moved(pair.face_1, u), moved(pair.face_2, u), pair.normal);
    }

    /// delta_f of every face.
    [[nodiscard]] std::vector<Vector<Dim>> corrections(const std::vector<Vector<Dim>>& u) const {
        std::vector<Vector<Dim>> delta(u.size(), Vector<Dim>::Zero());
        for (const auto& pair : pairs_) {
            const double g = gap(pair, u);
            if (g >= 0.0) continue;
            const double area = patch(pair, u).area;
            delta[pair.face_1] += pair.theta_1 * area / surface_.area[pair.face_1] * g * pair.normal;
            delta[pair.face_2] -= pair.theta_2 * area / surface_.area[pair.face_2] * g * pair.normal;
        }
        return delta;
    }

    /// The pairs' part of dV/dû for the face forces y.
    [[nodiscard]] std::vector<Vector<Dim>> pair_forces(const std::vector<Vector<Dim>>& u,
                                                       const std::vector<Vector<Dim>>& y) const {
        std::vector<Vector<Dim>> force(u.size(), Vector<Dim>::Zero());
        for (const auto& pair : pairs_) {
            const double g = gap(pair, u);
            if (g >= 0.0) continue;
            const Patch<Dim> shared = patch(pair, u);
            const double beta = pair.theta_1 * y[pair.face_1].dot(pair.normal) / surface_.area[pair.face_1] -
                                pair.theta_2 * y[pair.face_2].dot(pair.normal) / surface_.area[pair.face_2];
            const Vector<Dim> f = beta * (shared.area * pair.normal + g * shared.derivative);
            force[pair.face_2] += f;
            force[pair.face_1] -= f;
        }
        return force;
    }

    [[nodiscard]] const std::vector<ReferencePair<Dim>>& pairs() const { return pairs_; }

private:
    [[nodiscard]] std::vector<Vector<Dim>> moved(std::int32_t face, const std::vector<Vector<Dim>>& u) const {
        std::vector<Vector<Dim>> corners;
        for (const std::int32_t v : surface_.vertices_of(face)) corners.push_back(surface_.vertices[v] + u[face]);
        return corners;
    }

    contact::SurfaceView<Dim> surface_;
    std::vector<ReferencePair<Dim>> pairs_;
};

/// Mean of a function over [0, 1] that is smooth but for kinks and jumps: five Lobatto points, halved where two halves say
/// something else than the whole, down to 1e-13.
class AdaptiveMean {
public:
    using Function = std::function<Eigen::VectorXd(double)>;
    AdaptiveMean(Function f, double scale) : f_(std::move(f)), tolerance_(1e-15 * scale) {}

    [[nodiscard]] Eigen::VectorXd over_unit_interval() const {
        static constexpr int parts = 64;
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(f_(0.0).size());
        for (int i = 0; i < parts; ++i)
            sum += refined(double(i) / parts, double(i + 1) / parts, lobatto(double(i) / parts, double(i + 1) / parts));
        return sum;
    }

private:
    // The ends belong to the rule: a jump beside one of them does not go unseen.
    [[nodiscard]] Eigen::VectorXd lobatto(double a, double b) const {
        const double middle = 0.5 * (a + b), half = 0.5 * (b - a), inner = std::sqrt(3.0 / 7.0) * half;
        return half *
               (32.0 / 45.0 * f_(middle) + 49.0 / 90.0 * (f_(middle - inner) + f_(middle + inner)) + 0.1 * (f_(a) + f_(b)));
    }
    [[nodiscard]] Eigen::VectorXd refined(double a, double b, const Eigen::VectorXd& whole) const {
        const double middle = 0.5 * (a + b);
        const Eigen::VectorXd left = lobatto(a, middle), right = lobatto(middle, b);
        if ((left + right - whole).lpNorm<Eigen::Infinity>() <= tolerance_ || b - a < 1e-13) return left + right;
        return refined(a, middle, left) + refined(middle, b, right);
    }

    Function f_;
    double tolerance_;
};

}  // namespace abut::test
