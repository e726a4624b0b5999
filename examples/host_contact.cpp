// Contact in a solver of one's own, step by step: two pucks of mass m whose faces sit on springs, k per area.
//
// Puck 0 flies at v = 1 m/s into puck 1 at rest. Each has a front of 1 m, of three faces and of four, that do not match.
// With V = sum_f k |f| |ũ_f - u|^2 / 2 the corrections put half of the gap g on each side: V = k g^2 / 4, a spring of k/2
// between m/2. Exact: the pucks exchange their velocities, after a contact of pi sqrt(m/k) = 0.314159 s, pressed in by
// v sqrt(m/k) = 0.1 m at most. The scheme keeps H~ and momentum to round-off.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "abut/contact/contact.hpp"
#include "abut/dynamics/memm.hpp"

using namespace abut;

constexpr double mass = 1.0, stiffness = 100.0, speed = 1.0, cell_depth = 0.5;  // [kg], [N/m^3], [m/s], [m]
constexpr double dt = 1e-3;                                                     // of all steps [s]

/// The unknowns q are the displacements of the two pucks, (2, 2); a host with a mesh has its own reconstruction û = R q.
class Pucks {
public:
    std::size_t size() const { return 4; }
    std::span<const double> inverse_mass() const { return inverse_mass_; }
    double potential(std::span<const double> q) { return step(q, q).energy; }
    void force(std::span<const double> q, std::span<double> f) { mean_force(q, q, 0.0, 0.0, f); }
    /// The mean of F = -dV/dq over the straight path from q_0 to q_1. In dV/du the springs' answer to the corrections,
    /// -k |f| delta_f, and what comes through û, +k |f| delta_f, cancel: the gradients of the pairs are left.
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double, double, std::span<double> f) {
        const contact::ContactStep<2>& found = step(q_0, q_1);
        std::ranges::fill(f, 0.0);
        for (std::size_t i = 0; i < found.faces.size(); ++i)  // R^T
            as_vectors<2>(f)[std::size_t(surface_.body[std::size_t(found.faces[i])])] -= found.mean_gradient.values()[i];
    }
    const contact::ContactReport& report() const { return contact_.report(); }

private:
    static contact::Surface<2> fronts() {
        contact::Surface<2> surface;
        for (const auto& [body, n] : {std::pair(0, 3), std::pair(1, 4)})
            for (int i = 0; i < n; ++i) {
                const Vector<2> low(0.05 * body, double(i) / n), high(0.05 * body, double(i + 1) / n);
                surface.append(body == 0 ? std::vector{low, high} : std::vector{high, low}, cell_depth, stiffness, body);
            }
        return surface;
    }
    std::vector<Vector<2>> displacement(std::span<const double> q) const {  // û = R q of all faces
        std::vector<Vector<2>> u;
        for (const std::int32_t body : surface_.body) u.push_back(as_vectors<2>(q)[static_cast<std::size_t>(body)]);
        return u;
    }
    contact::FaceCoupling<2> coupling(std::span<const contact::Face> faces) const {
        contact::FaceCoupling<2> own;  // Q = k |f| I: a face answers to itself alone
        for (const contact::Face face : faces) {
            own.columns.push_back(static_cast<std::int32_t>(own.columns.size()));
            own.offsets.push_back(static_cast<std::int32_t>(own.columns.size()));
            own.blocks.push_back(stiffness * surface_.area[std::size_t(face)] * Matrix<2>::Identity());
        }
        return own;
    }
    const contact::ContactStep<2>& step(std::span<const double> q_0, std::span<const double> q_1) {
        const auto u_0 = displacement(q_0), u_1 = displacement(q_1);
        const auto springs_at_rest = [](auto, auto y_0, auto y_1) {  // y = dV/dũ where ũ = û
            for (std::size_t i = 0; i < y_0.size(); ++i) y_0[i] = y_1[i] = Vector<2>(0.0, 0.0);
        };
        return contact_.step(dt, {u_0, u_1, [this](auto faces) { return coupling(faces); }, springs_at_rest});
    }

    std::vector<double> inverse_mass_ = std::vector<double>(4, 1.0 / mass);
    contact::Surface<2> surface_ = fronts();
    contact::Contact<2> contact_{surface_.view(), {}};  // views the surface, which must stay where it is
};

int main() {
    Pucks pucks;
    dynamics::Memm<Pucks> memm(pucks, std::vector<double>(4, 0.0), std::vector{mass * speed, 0.0, 0.0, 0.0}, dt);
    double drift = 0.0, duration = 0.0, energy = memm.pseudo_energy();
    while (memm.time() < 0.5) {
        memm.step();
        duration += pucks.report().active_pairs > 0 ? memm.dt() : 0.0;
        drift = std::max(drift, std::abs(memm.pseudo_energy() - energy));
    }
    const auto velocity = [&](std::size_t i) { return 0.5 * (memm.p_before()[i] + memm.p_after()[i]) / mass; };
    const double v_0 = velocity(0), v_1 = velocity(2), exact = speed * std::sqrt(mass / stiffness);
    const double pressed = pucks.report().compression_max * 2.0 * cell_depth, pi = std::numbers::pi;
    std::printf("velocities %.6f and %.6f m/s, exact 0 and %g\n", v_0, v_1, speed);
    std::printf("contact %.4f s, exact %.4f; %.5f m deep, exact %.5f\n", duration, pi * exact / speed, pressed, exact);
    std::printf("drift of H~ %.1e J, of momentum %.1e kg m/s\n", drift, std::abs(mass * (v_0 + v_1 - speed)));
    return std::abs(v_1 - speed) < 1e-3 && std::abs(pressed - exact) < 1e-3 && drift < 1e-14 ? 0 : 1;
}
