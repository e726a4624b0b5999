#pragma once
#include "abut/contact/option_table.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "apps/support/choices.hpp"

namespace abut::apps {

/// Choices of `--broad-phase` and `--area` in every program.
inline const Choices<geometry::BroadPhase> broad_phases = [] {
    Choices<geometry::BroadPhase> choices;
    for (const geometry::BroadPhase method : geometry::broad_phases()) choices.emplace_back(geometry::name(method), method);
    return choices;
}();
inline const Choices<geometry::AreaMethod> areas = choices_of(contact::area_words);

}  // namespace abut::apps
