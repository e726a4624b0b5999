#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/dynamics/bilbao.hpp"
#include "abut/dynamics/energy_momentum.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/memm_async.hpp"
#include "abut/dynamics/scheme.hpp"

namespace abut::dynamics {

/// Setup that only some schemes need.
struct SchemeSetup {
    PathMean mean = PathMean::system;  ///< of memm and energy_momentum
    double gauge = 0.0;                ///< c of bilbao [J]
};

/// Calls use(make), where make(system, q, p, dt, local_steps) is an integrator of this scheme; `local_steps` are of
/// memm_async. This is the one place that knows all schemes. Throws BadInput for one that the system is not made for.
template <System S, class Use>
void with_scheme(Scheme scheme, const SchemeSetup& setup, const Use& use) {
    using Q = std::vector<double>;
    using P = std::span<const double>;
    switch (scheme) {
        case Scheme::memm:
            return use([setup](S& system, Q q, P p, double dt, const LocalSteps&) {
                return Memm<S>(system, std::move(q), p, dt, setup.mean);
            });
        case Scheme::memm_async:
            if constexpr (requires { typename MemmAsync<S>; })
                return use([](S& system, Q q, P p, double dt, const LocalSteps& steps) {
                    return MemmAsync<S>(system, std::move(q), p, dt, steps);
                });
            break;
        case Scheme::leapfrog:
            return use(
                [](S& system, Q q, P p, double dt, const LocalSteps&) { return Leapfrog<S>(system, std::move(q), p, dt); });
        case Scheme::bilbao:
            return use([setup](S& system, Q q, P p, double dt, const LocalSteps&) {
                return Bilbao<S>(system, std::move(q), p, dt, setup.gauge);
            });
        case Scheme::energy_momentum:
            if constexpr (requires { typename EnergyMomentum<S>; })
                return use([setup](S& system, Q q, P p, double dt, const LocalSteps&) {
                    return EnergyMomentum<S>(system, std::move(q), p, dt, setup.mean);
                });
            break;
    }
    throw BadInput("integrator " + name_of(scheme) + ": it is not made for this system. Take memm.");
}

}  // namespace abut::dynamics
