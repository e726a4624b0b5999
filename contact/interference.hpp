#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// Faces that overlap at the start on purpose, as those of parts that are pressed on each other. The contact of such
/// faces begins without a force, as if one of both were ground off by the deepest overlap, and what was ground off
/// grows back over a time. That takes work from outside (NodalStep::interference_work). docs/method.md, Interference.
struct InterferenceOptions {
    /// [s] finite and > 0, over which each of them comes to act, from the first step on; none: no face overlaps on purpose
    std::vector<double> times = {};
    /// Index in `times` of two faces, in either order; -1: none. Asked once per pair of a candidate list, and must
    /// always give the same. Empty: the first is that of all
    std::function<std::int32_t(Face, Face)> of = {};

    [[nodiscard]] bool any() const { return !times.empty(); }
    /// Index of the time of two faces; -1: none. Throws BadInput for another index.
    [[nodiscard]] std::int32_t between(Face face_1, Face face_2) const;
};

/// Throws BadInput naming the value, its limit and the remedy.
void check(const InterferenceOptions& options);

}  // namespace abut::contact
