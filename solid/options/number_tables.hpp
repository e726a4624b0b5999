#pragma once
// Private to the sources of the layers.
#include <array>

#include "abut/base/given_value.hpp"
#include "abut/solid/options/attachments.hpp"
#include "abut/solid/options/erosion_limits.hpp"

/// Numbers of what bodies are joined, held and worn by, with their limits: keys of scenes, hosts and solids check by these.
namespace abut::solid {

inline constexpr std::array bond_numbers{
    NumberOf<Bond>{"strength", &Bond::strength, {.unit = "Pa", .above = 0.0, .endless = true}},
    NumberOf<Bond>{"fracture_energy", &Bond::fracture_energy, {.unit = "J/m^2", .above = 0.0, .zero = true}},
    NumberOf<Bond>{"weibull", &Bond::weibull_modulus, {.above = 0.0, .endless = true}}};

template <int Dim>
inline constexpr std::array spring_numbers{
    NumberOf<Spring<Dim>>{"stiffness", &Spring<Dim>::stiffness, {.unit = "N/m", .above = 0.0, .zero = true}},
    NumberOf<Spring<Dim>>{"length", &Spring<Dim>::length, {.unit = "m", .above = 0.0, .zero = true}},
    NumberOf<Spring<Dim>>{"damping", &Spring<Dim>::damping, {.unit = "N s/m", .above = 0.0, .zero = true}}};

inline constexpr std::array erosion_numbers{
    NumberOf<ErosionLimits>{"strain", &ErosionLimits::strain, {.above = 0.0, .endless = true}},
    NumberOf<ErosionLimits>{"plastic_strain", &ErosionLimits::plastic_strain, {.above = 0.0, .endless = true}},
    NumberOf<ErosionLimits>{"stress", &ErosionLimits::stress, {.unit = "Pa", .above = 0.0, .endless = true}}};

}  // namespace abut::solid
