#pragma once
// Every scheme, and the small systems on which they are compared.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "abut/dynamics/bilbao.hpp"
#include "abut/dynamics/composed.hpp"
#include "abut/dynamics/energy_momentum.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/memm_async.hpp"
#include "abut/dynamics/particles.hpp"
#include "studies/orders/known_motions.hpp"
#include "support/worst.hpp"

namespace abut::test {

using dynamics::Bond;
using dynamics::LineSpring;
using dynamics::PathMean;
using dynamics::StringSegment;

using Chain = dynamics::Particles<LineSpring>;
using ElasticString = dynamics::Particles<StringSegment>;

using Values = std::vector<double>;

// How each integrator is made, and which laws it obeys.
template <PathMean mean>
struct MemmOf {
    static constexpr bool one_step = false;
    static constexpr bool two_step = true;
    static constexpr double stability = 2.0;  // omega dt
    static constexpr bool conserves_nonlinear = mean == PathMean::system || mean == PathMean::gauss_2;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        return dynamics::Memm<S>(system, std::move(q), p, dt, mean);
    }
};
struct MemmExact : MemmOf<PathMean::system> {};
struct MemmGauss1 : MemmOf<PathMean::gauss_1> {};
struct MemmGauss2 : MemmOf<PathMean::gauss_2> {};
struct MemmGauss3 : MemmOf<PathMean::gauss_3> {
    static constexpr bool conserves_nonlinear = true;
};
struct LeapfrogScheme {
    static constexpr bool one_step = false;
    static constexpr bool two_step = false;
    static constexpr double stability = 2.0;
    static constexpr bool conserves_nonlinear = false;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        return dynamics::Leapfrog<S>(system, std::move(q), p, dt);
    }
};
struct BilbaoScheme {
    static constexpr bool one_step = false;
    static constexpr bool two_step = false;
    static constexpr double stability = std::numeric_limits<double>::infinity();
    static constexpr bool conserves_nonlinear = true;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        return dynamics::Bilbao<S>(system, std::move(q), p, dt, 1.0);
    }
};
struct EnergyMomentumScheme {
    static constexpr bool one_step = true;
    static constexpr bool two_step = false;
    static constexpr double stability = std::numeric_limits<double>::infinity();
    static constexpr bool conserves_nonlinear = true;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        return dynamics::EnergyMomentum<S>(system, std::move(q), p, dt);
    }
};
/// The first half of the degrees of freedom with the whole step, the rest with a third of it.
struct AsyncScheme {
    static constexpr bool one_step = false;
    static constexpr bool two_step = true;
    static constexpr double stability = 2.0;
    static constexpr bool conserves_nonlinear = true;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        std::vector<std::int32_t> level(q.size(), 0);
        std::fill(level.begin() + static_cast<std::ptrdiff_t>((q.size() + 1) / 2), level.end(), 1);
        return dynamics::MemmAsync<S>(system, std::move(q), p, dt, {{1, 3}, level});
    }
};

/// The composition of order 2; those of higher order are in test_composed.cpp.
struct StrangScheme {
    static constexpr bool one_step = false;
    static constexpr bool two_step = false;
    static constexpr double stability = 4.0;
    static constexpr bool conserves_nonlinear = true;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        return dynamics::Composed<S>(system, std::move(q), p, dt, dynamics::Composition::strang);
    }
};

/// Ratio between errors of energies with steps of dt and dt/2: H - H~ = |a - b|^2/8 of a composition, where a - b is of order
/// dt^2, and of order dt^2 elsewhere.
template <class Scheme>
inline constexpr double energy_ratio = std::is_same_v<Scheme, StrangScheme> ? 16.0 : 4.0;

/// Six masses between two walls, springs of the fourth order.
inline Chain held_chain() {
    std::vector<Bond<LineSpring>> bonds;
    for (std::int32_t i = -1; i < 6; ++i) bonds.push_back({i, i == 5 ? -1 : i + 1, {.stiffness = 1.0, .quartic = 1.0}});
    return Chain({1.0, 0.5, 1.0, 0.8, 1.0, 2.0}, bonds);
}
inline const Values held_q{0.3, -0.2, 0.1, 0.4, -0.3, 0.2};
inline const Values held_p{0.1, 0.4, -0.2, 0.0, 0.3, -0.1};

/// The same without walls.
inline Chain free_chain() {
    std::vector<Bond<LineSpring>> bonds;
    for (std::int32_t i = 0; i < 5; ++i) bonds.push_back({i, i + 1, {.stiffness = 1.0, .quartic = 1.0}});
    return Chain({1.0, 0.5, 1.0, 0.8, 1.0, 2.0}, bonds);
}

/// An elastic string of n segments between (0, 0) and (n, 0), stretched by a tenth.
inline ElasticString string_of(int n) {
    std::vector<Bond<StringSegment>> bonds;
    for (std::int32_t i = -1; i < n - 1; ++i)
        bonds.push_back({i, i == n - 2 ? -1 : i + 1, {.stiffness = 2.0, .length = 0.9}, {1.0, 0.0}});
    return ElasticString(Values(static_cast<std::size_t>(2 * (n - 1)), 1.0), bonds);
}

/// q at `time` by many small steps of the fourth-order Runge-Kutta scheme.
template <class S>
Values reference(S& system, const Values& q_0, const Values& p_0, double time, int steps) {
    return studies::orders::run_by_small_steps(system, q_0, p_0, time, steps).end_q;
}

inline double distance(std::span<const double> a, std::span<const double> b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) raise(worst, std::abs(a[i] - b[i]));
    return worst;
}

inline double total(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += 0.5 * (a[i] + b[i]);
    return sum;
}

inline double rate(const std::function<double(int)>& error_of, int steps) {
    return std::log2(error_of(steps) / error_of(2 * steps));
}

}  // namespace abut::test

#define ABUT_ALL_INTEGRATORS                                                                                        \
    MemmExact, MemmGauss1, MemmGauss2, MemmGauss3, LeapfrogScheme, BilbaoScheme, EnergyMomentumScheme, AsyncScheme, \
        StrangScheme
