#pragma once
#include <cmath>
#include <vector>

#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/particles.hpp"
#include "studies/long_runs/point_run.hpp"

namespace abut::studies::long_runs {

/// A spring between two points of the plane, geometrically exact: V = k/2 (|r| - L)^2; of a contact only where |r| < L.
struct Strut {
    static constexpr int dim = 2;
    double stiffness = 0.0;  ///< k [N/m]
    double length = 0.0;     ///< L [m]
    bool one_sided = false;

    [[nodiscard]] double energy(const Vector<2>& r) const {
        const double x = stretch(r.norm());
        return 0.5 * stiffness * x * x;
    }
    [[nodiscard]] Vector<2> tension(const Vector<2>& r) const {
        const double distance = r.norm();
        return (stiffness * stretch(distance) / distance) * r;
    }
    /// Along r_0 + r_1, so that it has no moment about the mean position; its product with r_1 - r_0 is V(r_1) - V(r_0).
    [[nodiscard]] Vector<2> mean_tension(const Vector<2>& r_0, const Vector<2>& r_1) const {
        const double a = r_0.norm(), b = r_1.norm(), x_a = stretch(a), x_b = stretch(b);
        if (x_a == 0.0 && x_b == 0.0) return Vector<2>::Zero();
        // (x_b^2 - x_a^2)/(b - a), without the difference where both ends act.
        const bool both_act = !one_sided || (a < length && b < length);
        const double slope = both_act ? x_a + x_b : (x_b - x_a) * (x_b + x_a) / (b - a);
        return (0.5 * stiffness * slope / (a + b)) * (r_0 + r_1);
    }

private:
    [[nodiscard]] double stretch(double distance) const {
        return one_sided ? std::fmin(distance - length, 0.0) : distance - length;
    }
};

/// A net that flies and spins inside a ring and hits it again and again: two bodies that turn through any angle, with
/// nothing outside. Momentum, J~ and H~ are exact under MEMM.
class Rattle : public dynamics::Particles<Strut> {
public:
    static constexpr int dimension = 2;

    Rattle();
    [[nodiscard]] std::span<const Vector<2>> rest_positions() const { return rest_; }
    [[nodiscard]] std::span<const double> masses() const { return masses_; }
    [[nodiscard]] dynamics::MomentArms moment_arms() const { return dynamics::MomentArms::mid_step; }
    [[nodiscard]] std::span<const std::int32_t> body_of_points() const { return bodies_; }
    [[nodiscard]] dynamics::ContactCounts contact_counts() const {
        return {static_cast<std::int64_t>(touching_.size()), events_};
    }
    /// Momenta of the net, which flies and spins, and of the ring, which takes the opposite momentum.
    [[nodiscard]] std::vector<double> momenta(const Vector<2>& velocity, double omega) const;
    /// Above the highest frequency, as long as a point touches few others [rad/s].
    [[nodiscard]] double highest_frequency() const;

    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                    std::span<double> force);
    /// Points that touched in the last step, with those that are joined to them.
    [[nodiscard]] std::vector<dynamics::ContactPatch<2>> contact_patches() const;
    void end_force_on(std::span<const std::int32_t> points, std::span<const double> q, std::span<Vector<2>> on_points);

private:
    struct Parts {
        std::vector<Vector<2>> rest;
        std::vector<std::int32_t> bodies;
        std::vector<dynamics::Bond<Strut>> bonds;
        std::vector<dynamics::Bond<Strut>> contacts;
    };
    static Parts make();
    explicit Rattle(Parts parts);
    [[nodiscard]] bool is_closed(const dynamics::Bond<Strut>& contact, std::span<const double> q) const;

    std::vector<Vector<2>> rest_;
    std::vector<std::int32_t> bodies_;
    std::vector<dynamics::Bond<Strut>> bonds_of_bodies_;
    std::vector<dynamics::Bond<Strut>> contacts_;
    std::vector<std::vector<std::int32_t>> neighbours_;  // by bonds of bodies, each point's own included
    std::vector<double> masses_, force_;
    std::vector<std::int32_t> touching_;  // contacts, in the last step
    std::int64_t events_ = 0;
};

}  // namespace abut::studies::long_runs
