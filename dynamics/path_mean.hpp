#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/quadrature.hpp"
#include "abut/dynamics/system.hpp"

namespace abut::dynamics {

/// How the mean of the force over the straight path of a step is taken.
enum class PathMean {
    system,   ///< the system's own mean, exact: what the scheme conserves is conserved to round-off
    gauss_1,  ///< Gauss-Legendre: exact for forces that are polynomials of degree 1, 3, 5 along the path
    gauss_2,
    gauss_3,
};

/// The mean of the force along straight paths.
template <System S>
class PathMeanForce {
public:
    /// Throws BadInput for a rule that the system does not allow.
    PathMeanForce(S& system, PathMean mean) : system_(system), mean_(mean) {
        if (mean == PathMean::system && !PathMeanSystem<S>)
            throw BadInput(
                "integrator: the system does not know the mean of its force along a path. Take PathMean::gauss_1, _2 or "
                "_3.");
        if (mean != PathMean::system && FollowedSystem<S>)
            throw BadInput(
                "integrator: the system must be led along every step. Take PathMean::system; contact has its own quadrature "
                "in ContactOptions.");
        if (mean == PathMean::system) return;
        q_.resize(system.size());
        force_.resize(system.size());
    }

    void operator()(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                    std::span<double> force) {
        if constexpr (PathMeanSystem<S>)
            if (mean_ == PathMean::system) {
                system_.mean_force(q_0, q_1, time, dt, force);
                return;
            }
        const Quadrature rule = gauss_legendre(static_cast<int>(mean_));
        std::fill(force.begin(), force.end(), 0.0);
        for (int k = 0; k < rule.size; ++k) {
            for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = q_0[i] + rule.node[k] * (q_1[i] - q_0[i]);
            system_.force(q_, force_);
            add_scaled(force, rule.weight[k], force_, force);
        }
    }

private:
    S& system_;
    PathMean mean_;
    std::vector<double> q_;
    std::vector<double> force_;
};

}  // namespace abut::dynamics
