#pragma once
// A reference for rings that break, apart from Abut's operators, bonds and schemes.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace abut::test {

/// Mott's bar without ends, of length 2 pi with E = rho = 1, that is stretched evenly: elements of linear springs between lumped
/// nodes, whose every third node may open. It opens where its traction reaches a strength of its own, drawn from Weibull's law,
/// and its pull then falls to 0 along a straight line, over which it takes the fracture energy. Central differences.
class BarOfPlaces {
public:
    BarOfPlaces(int n_elements, double rate, double energy, double strength, double weibull_modulus, unsigned seed)
        : n_(static_cast<std::size_t>(n_elements)),
          h_(2.0 * std::numbers::pi / n_elements),
          rate_(rate),
          energy_(energy),
          left_(n_),
          right_(n_),
          opening_(n_, 0.0),
          strength_(n_, std::numeric_limits<double>::infinity()) {
        std::mt19937 draw(seed);
        std::uniform_real_distribution<double> uniform(std::numeric_limits<double>::min(), 1.0);
        for (std::size_t i = 0; i < n_; i += 3)
            strength_[i] = strength * std::pow(-std::log(uniform(draw)), 1.0 / weibull_modulus);
    }

    void run(double end) {
        const double dt = 0.2 * h_;
        for (double time = dt; time < end; time += dt) step(time, dt);
    }

    [[nodiscard]] int n_broken() const {
        int n = 0;
        for (std::size_t i = 0; i < n_; ++i) n += opening_[i] > 0.0 && opening_[i] >= last_opening(i);
        return n;
    }

private:
    struct Side {
        double u = 0.0, v = 0.0;
    };

    [[nodiscard]] double last_opening(std::size_t i) const { return 2.0 * energy_ / strength_[i]; }

    void step(double time, double dt) {
        for (auto* sides : {&left_, &right_})
            for (Side& side : *sides) side.u += dt * side.v;
        double before = stress(n_ - 1, time);
        for (std::size_t i = 0; i < n_; ++i) {
            const double behind = stress(i, time);
            push(i, before, behind, dt);
            before = behind;
        }
    }

    /// Stress of the element behind node i, in which all nodes move apart at `rate`.
    [[nodiscard]] double stress(std::size_t i, double time) const {
        return (left_[(i + 1) % n_].u - right_[i].u) / h_ + rate_ * time;
    }

    void push(std::size_t i, double before, double behind, double dt) {
        const double half_mass = 0.5 * h_;
        if (opening_[i] == 0.0 && 0.5 * (before + behind) < strength_[i]) {
            left_[i].v += dt * (behind - before) / (2.0 * half_mass);
            right_[i].v = left_[i].v;
            return;
        }
        const double jump = right_[i].u - left_[i].u;
        opening_[i] = std::max({opening_[i], jump, std::numeric_limits<double>::min()});
        const double pull = traction(i, jump);
        left_[i].v += dt * (pull - before) / half_mass;
        right_[i].v += dt * (behind - pull) / half_mass;
    }

    /// Back to 0 along a straight line where it closes, and as stiff as half an element where it is closed.
    [[nodiscard]] double traction(std::size_t i, double jump) const {
        if (jump < 0.0) return 2.0 * jump / h_;
        const double envelope = strength_[i] * std::max(0.0, 1.0 - opening_[i] / last_opening(i));
        return envelope * (jump < opening_[i] && jump > 0.0 ? jump / opening_[i] : 1.0);
    }

    std::size_t n_;
    double h_, rate_, energy_;
    std::vector<Side> left_, right_;  ///< of each node
    std::vector<double> opening_;     ///< largest so far of each node; 0: it has not opened
    std::vector<double> strength_;
};

}  // namespace abut::test
