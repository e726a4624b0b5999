#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "abut/solid/kinematics/kinematics.hpp"

namespace abut::solid {

/// Properties of a kinematics. Code asks for one of these, not for a name: docs/kinematics.md shows the table.
struct KinematicsProperties {
    std::string_view name;
    bool deforms;  ///< its cells are points of the solid; else a few points stand for all of it
    bool turns;    ///< it may turn by any angle: normals and directions at rest do not hold for long
    /// strains are linear in a frame that turns with it; masses have the inertia of their cells
    bool has_frame;
    bool finite_strains;  ///< stress is a law of F: forces are not linear in displacements, and feed the alternating mode
    int more_layers;  ///< of neighbours that a part needs, beside those of all: free faces depend on the stress behind them
    double step_margin;  ///< part of 2/omega_max that is stable without contact [-]
};

inline constexpr std::array<KinematicsProperties, 4> kinematics_properties{{
    // clang-format off
    //            deforms, turns, has_frame, finite_strains, more_layers, step_margin
    {"small",       true,  false,   false,       false,           0,          1.0},
    {"floating",    true,  true,    true,        false,           0,          1.0},
    {"finite",      true,  true,    false,       true,            1,       2.0 / 3.0},  // 0.6 of it with the 0.9 that runs take
    {"rigid",       false, true,    false,       false,           0,          1.0},
    // clang-format on
}};

[[nodiscard]] constexpr const KinematicsProperties& properties_of(Kinematics kinematics) {
    return kinematics_properties[static_cast<std::size_t>(kinematics)];
}

// One kinematics per body, or none: all are `small`.

[[nodiscard]] constexpr Kinematics kinematics_of(std::span<const Kinematics> of_bodies, std::size_t body) {
    return of_bodies.empty() ? Kinematics{} : of_bodies[body];
}
[[nodiscard]] constexpr const KinematicsProperties& properties_of(std::span<const Kinematics> of_bodies, std::size_t body) {
    return properties_of(kinematics_of(of_bodies, body));
}
[[nodiscard]] constexpr bool any_body(std::span<const Kinematics> of_bodies, bool KinematicsProperties::*property) {
    return of_bodies.empty()
               ? properties_of(Kinematics{}).*property
               : std::ranges::any_of(of_bodies, [property](Kinematics k) { return properties_of(k).*property; });
}
[[nodiscard]] constexpr bool all_bodies(std::span<const Kinematics> of_bodies, bool KinematicsProperties::*property) {
    return of_bodies.empty()
               ? properties_of(Kinematics{}).*property
               : std::ranges::all_of(of_bodies, [property](Kinematics k) { return properties_of(k).*property; });
}

}  // namespace abut::solid
