#pragma once
// Private to the layer.
#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "abut/run/option_table.hpp"

namespace abut::run {

/// Capabilities that a scene may ask of a scheme and not every one has.
enum class SchemeCapability {
    friction,  ///< bodies that rub
    memory,    ///< materials that flow or are damped
    ranks,     ///< several of them
};

/// Which schemes have one, and why the others have not: a sentence without its full stop, and what to do.
struct SchemeCapabilityRow {
    SchemeCapability capability;
    std::string_view name;
    std::array<bool, integrator_words.size()> of;  ///< in the order of integrator_words
    std::string_view reason;
    std::string_view remedy;
};

/// Refusals because of the scheme, beside those of options (OptionFacts::schemes) and of kinematics.
/// docs/integrators.md shows them.
inline constexpr std::array<SchemeCapabilityRow, 3> scheme_capabilities{{
    {SchemeCapability::friction,
     "friction",
     {true, false, true, false},
     "it has no friction",
     "Take memm, which closes its balance of energy, or leapfrog; or leave friction out."},
    {SchemeCapability::memory,
     "flow and damping",
     {true, false, false, false},
     "such a material remembers what happens to it, and forces at ends of steps do not tell",
     "Take memm, which closes its balance of energy, or another material."},
    {SchemeCapability::ranks,
     "several ranks",
     {true, false, true, true},
     "cells of one step lie on several ranks",
     "Take memm, or one rank."},
}};

[[nodiscard]] constexpr const SchemeCapabilityRow& row_of(SchemeCapability capability) {
    return scheme_capabilities[static_cast<std::size_t>(capability)];
}

/// Whether a scheme has it; false of one that is none of integrator_words.
[[nodiscard]] constexpr bool has(SolidIntegrator scheme, SchemeCapability capability) {
    const auto* const found = std::ranges::find(integrator_words, scheme, &Word<SolidIntegrator>::choice);
    return found != integrator_words.end() &&
           row_of(capability).of[static_cast<std::size_t>(found - integrator_words.begin())];
}

}  // namespace abut::run
