#pragma once
#include <cstdint>
#include <span>

#include "abut/solid/contact/contact_results.hpp"

namespace abut::run {

/// State of a run as each rank knows it by itself, after a step or before the first one.
template <int Dim>
struct Moment {
    std::int64_t steps = 0;
    double time = 0.0;                                    ///< [s]
    std::span<const solid::BodyImpulse<Dim>> impulses{};  ///< of contact so far: ContactView::impulses
};

}  // namespace abut::run
