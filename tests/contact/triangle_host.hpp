#pragma once
// A host of linear elastic triangles, E = rho = 1, nu = 0.3 in plane strain, for tests of contact on nodes in motion.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/surface/nodal_faces.hpp"

namespace abut::test {

using PlanePoints = std::vector<Vector<2>>;

/// Bodies of triangles, each of rows of nodes one over the other.
class TriangleHost {
public:
    /// Rows from below, each from left to right; nodes of neighbouring rows are joined to triangles.
    void append(const std::vector<PlanePoints>& rows) {
        const auto body = static_cast<std::int32_t>(depths_.size());
        depths_.emplace_back();
        std::vector<std::vector<std::int32_t>> number;
        for (const PlanePoints& row : rows) {
            number.emplace_back();
            for (const Vector<2>& x : row) {
                number.back().push_back(static_cast<std::int32_t>(rest_.size()));
                rest_.push_back(x);
                mass_.push_back(0.0);
                body_.push_back(body);
            }
        }
        for (std::size_t i = 0; i + 1 < rows.size(); ++i) join(number[i], number[i + 1]);
        append_outline(number);
    }

    [[nodiscard]] const PlanePoints& rest() const { return rest_; }
    [[nodiscard]] const std::vector<double>& mass() const { return mass_; }
    [[nodiscard]] std::int32_t body_of(std::size_t node) const { return body_[node]; }
    [[nodiscard]] contact::NodalSurface<2> surface() const {
        contact::NodalFaceArrays<2> faces = faces_;
        for (const std::vector<double>& depth : depths_)
            faces.stiffness.push_back(contact::skin_stiffness(lambda + 2.0 * mu, depth));
        return {rest_, faces.view()};
    }

    /// f -= K u.
    void add_force(const PlanePoints& u, PlanePoints& f) const {
        for (const Triangle& t : triangles_) {
            Matrix<2> g = Matrix<2>::Zero();
            for (int i = 0; i < 3; ++i) g += u[t.node[i]] * t.slope[i].transpose();
            const Matrix<2> stress = t.area * (lambda * g.trace() * Matrix<2>::Identity() + mu * (g + g.transpose()));
            for (int i = 0; i < 3; ++i) f[t.node[i]] -= stress * t.slope[i];
        }
    }
    [[nodiscard]] double energy(const PlanePoints& u) const {
        PlanePoints f(u.size(), Vector<2>::Zero());
        add_force(u, f);
        double energy = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i) energy -= 0.5 * u[i].dot(f[i]);
        return energy;
    }
    /// Highest frequency without contact, from below to 1e-3 or so [rad/s].
    [[nodiscard]] double omega() const {
        PlanePoints u(rest_.size());
        for (std::size_t i = 0; i < u.size(); ++i) u[i] = {std::sin(7.0 * i), std::cos(11.0 * i)};
        double omega_squared = 0.0;
        for (int round = 0; round < 300; ++round) {
            PlanePoints f(u.size(), Vector<2>::Zero());
            add_force(u, f);
            double of_f = 0.0, of_u = 0.0;
            for (std::size_t i = 0; i < u.size(); ++i) {
                of_u += u[i].squaredNorm() * mass_[i];
                u[i] = -f[i] / mass_[i];
                of_f += u[i].squaredNorm() * mass_[i];
            }
            omega_squared = std::sqrt(of_f / of_u);
            for (Vector<2>& x : u) x /= std::sqrt(of_f);
        }
        return std::sqrt(omega_squared);
    }

private:
    static constexpr double nu = 0.3, lambda = nu / (1.0 + nu) / (1.0 - 2.0 * nu), mu = 0.5 / (1.0 + nu);

    struct Triangle {
        std::array<std::int32_t, 3> node;
        std::array<Vector<2>, 3> slope;
        double area;
    };

    void join(const std::vector<std::int32_t>& lower, const std::vector<std::int32_t>& upper) {
        for (std::size_t i = 0, j = 0; i + 1 < lower.size() || j + 1 < upper.size();) {
            const auto share = [](std::size_t at, std::size_t n) { return n < 2 ? 2.0 : (at + 0.5) / (n - 1.0); };
            const bool is_lower =
                j + 1 == upper.size() || (i + 1 < lower.size() && share(i, lower.size()) <= share(j, upper.size()));
            append_triangle(is_lower ? std::array{lower[i], lower[i + 1], upper[j]}
                                     : std::array{lower[i], upper[j + 1], upper[j]});
            ++(is_lower ? i : j);
        }
    }
    void append_triangle(const std::array<std::int32_t, 3>& node) {
        const auto edges = Matrix<2>::from_columns(rest_[node[1]] - rest_[node[0]], rest_[node[2]] - rest_[node[0]]);
        const Matrix<2> slopes = edges.inverse();
        Triangle t{node, {}, 0.5 * edges.determinant()};
        t.slope = {-(slopes.row(0) + slopes.row(1)).transpose(), slopes.row(0).transpose(), slopes.row(1).transpose()};
        for (const std::int32_t i : node) mass_[i] += t.area / 3.0;
        triangles_.push_back(t);
    }
    /// Along the lower row, up the right side, back along the upper row, and down: the outside is on the right.
    void append_outline(const std::vector<std::vector<std::int32_t>>& rows) {
        std::vector<std::int32_t> outline = rows.front();
        for (std::size_t i = 1; i + 1 < rows.size(); ++i) outline.push_back(rows[i].back());
        outline.insert(outline.end(), rows.back().rbegin(), rows.back().rend());
        for (std::size_t i = rows.size() - 2; i > 0; --i) outline.push_back(rows[i].front());
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const std::array face{outline[i], outline[(i + 1) % outline.size()]};
            const auto behind = std::ranges::find_if(triangles_, [&](const Triangle& t) {
                return std::ranges::count(t.node, face[0]) + std::ranges::count(t.node, face[1]) == 2;
            });
            const double depth = behind->area / (rest_[face[1]] - rest_[face[0]]).norm();
            depths_.back().push_back(depth);
            faces_.append_face(face, depth, static_cast<std::int32_t>(depths_.size()) - 1);
        }
    }

    PlanePoints rest_;
    std::vector<double> mass_;
    std::vector<std::int32_t> body_;
    std::vector<Triangle> triangles_;
    contact::NodalFaceArrays<2> faces_;
    std::vector<std::vector<double>> depths_;  // of the faces of each body
};

/// Rows of a body with a tip of this angle below, at the origin, and parallel sides where it is `widest` across.
inline std::vector<PlanePoints> tip_rows(double angle, double height, double widest, double size) {
    std::vector<PlanePoints> rows;
    for (int j = 0; j <= std::lround(height / size); ++j) {
        const double y = j * size, width = std::min(widest, 2.0 * y * std::tan(0.5 * angle));
        const int n = static_cast<int>(std::max(j > 0 ? 1.0 : 0.0, std::round(width / size)));
        rows.emplace_back();
        for (int i = 0; i <= n; ++i) rows.back().push_back({n == 0 ? 0.0 : width * (double(i) / n - 0.5), y});
    }
    return rows;
}
/// Rows of a block with the middle of its upper side at (`middle`, 0).
inline std::vector<PlanePoints> block_rows(double width, double height, double size, double middle) {
    std::vector<PlanePoints> rows;
    const auto n = std::lround(width / size), m = std::lround(height / size);
    for (int j = 0; j <= m; ++j) {
        rows.emplace_back();
        for (int i = 0; i <= n; ++i)
            rows.back().push_back({middle + width * (double(i) / n - 0.5), height * (double(j) / m - 1.0)});
    }
    return rows;
}
/// Every point moved.
inline std::vector<PlanePoints> moved(std::vector<PlanePoints> rows, const Matrix<2>& turn, const Vector<2>& by) {
    for (PlanePoints& row : rows)
        for (Vector<2>& x : row) x = turn * x + by;
    return rows;
}

/// What a run ends with.
struct Collision {
    std::array<Vector<2>, 2> velocity{Vector<2>::Zero(), Vector<2>::Zero()};  ///< of each body
    double excess = 0.0;          ///< largest |H - H~| over the energy at the start
    double pseudo_drift = 0.0;    ///< of H~ over the energy at the start
    double momentum_drift = 0.0;  ///< over the sum of |p|
    double moment = 0.0;          ///< largest of the contact forces of a step about their middle positions, over their sum
    double compression = 0.0;     ///< largest |g|/D
    double correction = 0.0;
    std::int64_t missed = 0;
};

inline double cross(const Vector<2>& a, const Vector<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

/// MEMM with the step that NodalContact advises for a surface without bevels. Velocities of the bodies at the start.
inline Collision collide(const TriangleHost& host, const std::array<Vector<2>, 2>& velocity, double time,
                         const contact::NodalOptions& options = {}) {
    contact::NodalContact<2> bodies(host.surface(), options);
    const std::size_t n = host.rest().size();
    const double dt = bodies.stable_step(host.mass(), host.omega()).dt;
    PlanePoints u(n, Vector<2>::Zero()), next(n), x_0 = host.rest(), x_1(n), v_before(n), v_after(n), force(n), middle(n);
    for (std::size_t i = 0; i < n; ++i) v_before[i] = v_after[i] = velocity[host.body_of(i)];
    Collision found;
    double start = 0.0, momenta = 0.0;
    Vector<2> momentum_start = Vector<2>::Zero();
    const auto look = [&](double contact_energy, bool is_first) {
        double staggered = 0.0, kinetic = 0.0;
        Vector<2> momentum = Vector<2>::Zero();
        for (std::size_t i = 0; i < n; ++i) {
            const double m = host.mass()[i];
            const Vector<2> v = 0.5 * (v_before[i] + v_after[i]);
            staggered += 0.5 * m * v_before[i].dot(v_after[i]);
            kinetic += 0.5 * m * v.squaredNorm();
            momentum += m * v;
            if (is_first) momenta += m * v.norm();
        }
        const double pseudo = staggered + host.energy(u) + contact_energy;
        if (is_first) start = pseudo, momentum_start = momentum;
        found.excess = std::max(found.excess, (kinetic - staggered) / start);
        found.pseudo_drift = std::max(found.pseudo_drift, std::abs(pseudo - start) / start);
        found.momentum_drift = std::max(found.momentum_drift, (momentum - momentum_start).norm() / momenta);
    };
    double contact_energy = bodies.evaluate(x_0).energy;
    look(contact_energy, true);
    double corrections = 0.0, forces = 0.0;
    for (double t = 0.0; t < time; t += dt) {
        for (std::size_t i = 0; i < n; ++i) {
            next[i] = u[i] + dt * v_after[i];
            x_1[i] = host.rest()[i] + next[i];
            middle[i] = 0.5 * (u[i] + next[i]);
            force[i].setZero();
        }
        host.add_force(middle, force);
        const auto& step = bodies.step(dt, x_0, x_1);
        step.add_force_to(force);
        double moment = 0.0, moments = 0.0;
        for (std::size_t i = 0; i < step.nodes.size(); ++i) {
            const Vector<2> arm = 0.5 * (x_0[step.nodes[i]] + x_1[step.nodes[i]]);
            moment += cross(arm, step.gradient[i]);
            moments += arm.norm() * step.gradient[i].norm();
        }
        if (moments > 0.0) found.moment = std::max(found.moment, std::abs(moment) / moments);
        for (std::size_t i = 0; i < n; ++i) v_before[i] += 2.0 * dt / host.mass()[i] * force[i];
        std::swap(v_before, v_after);
        std::swap(u, next);
        std::swap(x_0, x_1);
        double in_step = 0.0;
        for (const auto& pair : step.pairs) in_step += pair.force.norm();
        forces += in_step;
        corrections += in_step * step.report.correction;
        look(step.energy, false);
    }
    std::array<double, 2> mass{};
    for (std::size_t i = 0; i < n; ++i) {
        found.velocity[host.body_of(i)] += 0.5 * host.mass()[i] * (v_before[i] + v_after[i]);
        mass[host.body_of(i)] += host.mass()[i];
    }
    for (int body = 0; body < 2; ++body) found.velocity[body] /= mass[body];
    found.compression = bodies.report().compression_max;
    found.missed = bodies.report().missed_contacts;
    found.correction = forces > 0.0 ? corrections / forces : 0.0;
    return found;
}

/// A reference without facets on body 1: each of its nodes that is below the upper side of body 0, `upper` from left to right,
/// by g there has the energy g^2/2. Leapfrog with half the step. Gives the velocities of the bodies at the end.
inline std::array<Vector<2>, 2> collide_by_penalty(const TriangleHost& host, const std::array<Vector<2>, 2>& velocity,
                                                   double time, const std::vector<std::int32_t>& upper) {
    const contact::NodalContact<2> bodies(host.surface());
    const std::size_t n = host.rest().size();
    const double dt = 0.5 * bodies.stable_step(host.mass(), host.omega()).dt;
    PlanePoints u(n, Vector<2>::Zero()), v(n), force(n);
    for (std::size_t i = 0; i < n; ++i) v[i] = velocity[host.body_of(i)];
    const auto at = [&](std::size_t i) { return Vector<2>(host.rest()[i] + u[i]); };
    for (double t = 0.0; t < time; t += dt) {
        for (std::size_t i = 0; i < n; ++i) force[i].setZero();
        host.add_force(u, force);
        for (std::size_t i = 0; i < n; ++i) {
            if (host.body_of(i) != 1 || at(i)[1] > 0.05) continue;
            const Vector<2> x = at(i);
            for (std::size_t k = 0; k + 1 < upper.size(); ++k) {
                const Vector<2> a = at(upper[k]), b = at(upper[k + 1]);
                const double share = (x[0] - a[0]) / (b[0] - a[0]), slope = (b[1] - a[1]) / (b[0] - a[0]);
                const double gap = x[1] - a[1] - slope * (x[0] - a[0]);
                if (share < 0.0 || share >= 1.0 || gap >= 0.0) continue;
                const Vector<2> push = -gap * Vector<2>(-slope, 1.0);
                force[i] += push;
                force[upper[k]] -= (1.0 - share) * push;
                force[upper[k + 1]] -= share * push;
            }
        }
        for (std::size_t i = 0; i < n; ++i) {
            v[i] += dt / host.mass()[i] * force[i];
            u[i] += dt * v[i];
        }
    }
    std::array<Vector<2>, 2> mean{Vector<2>::Zero(), Vector<2>::Zero()};
    std::array<double, 2> mass{};
    for (std::size_t i = 0; i < n; ++i) {
        mean[host.body_of(i)] += host.mass()[i] * v[i];
        mass[host.body_of(i)] += host.mass()[i];
    }
    return {Vector<2>(mean[0] / mass[0]), Vector<2>(mean[1] / mass[1])};
}

}  // namespace abut::test
