#pragma once
#include <span>

#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/options/options.hpp"

namespace abut::solid {

/// Steps between neutral restarts of runs with a body of finite strains: its forces feed the alternating mode
/// (docs/filter.md).
inline constexpr int restart_with_finite_strains = 50;

/// Remedies of a run against the alternating mode (dynamics::Remedies).
struct RunRemedies {
    bool filter = false;
    int restart = 0;  ///< steps between neutral restarts; 0: none
};

/// Remedies of a run of MEMM that is told none. `kinematics`: of each body, empty: all are `small`; `rubs`: there is
/// friction.
[[nodiscard]] constexpr RunRemedies default_remedies(std::span<const Kinematics> kinematics, bool rubs) {
    if (rubs) return {.filter = true, .restart = restart_with_friction};
    const bool any_finite = any_body(kinematics, &KinematicsProperties::finite_strains);
    return {.filter = false, .restart = any_finite ? restart_with_finite_strains : 0};
}

}  // namespace abut::solid
