#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/interference.hpp"

namespace abut::contact {

/// How much of the overlap at the start is not there yet, of each of InterferenceOptions::times: all of it at first,
/// then less and less, without a jump of its rate.
class InterferenceRamps {
public:
    explicit InterferenceRamps(const InterferenceOptions& options) : times_(options.times) {}

    [[nodiscard]] bool any() const { return !times_.empty(); }
    [[nodiscard]] bool has_begun() const { return !overlaps_.empty(); }
    /// `overlaps`: the deepest at the start, of each [m] >= 0.
    void begin(std::vector<double> overlaps);
    [[nodiscard]] std::span<const double> overlaps() const { return overlaps_; }

    /// PairLaw::offset of each at both ends of a step that takes `dt` [s], for `start` and `end` [m].
    void look_ahead(double dt);
    [[nodiscard]] std::span<const double> start() const { return start_; }
    [[nodiscard]] std::span<const double> end() const { return end_; }
    void advance(double dt) { elapsed_ += dt; }

    /// All that the next steps depend on; empty before it begins, or where there is none.
    [[nodiscard]] std::vector<double> saved() const;
    /// Throws BadInput for numbers that `saved` cannot have given.
    void restore(std::span<const double> saved);

private:
    std::vector<double> times_;
    std::vector<double> overlaps_, start_, end_;
    double elapsed_ = 0.0;  // [s]
};

}  // namespace abut::contact
