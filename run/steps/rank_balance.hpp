#pragma once
// Private to the layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/dynamics/ranks.hpp"
#include "abut/run/values/rebalancing.hpp"

namespace abut::run {

/// Cost of the own cells of each rank, and whether it is worth distributing them again. Costs differ from run to run: rank 0
/// decides, and all know what it has decided on. No bit of a run depends on that.
class RankBalance {
public:
    /// Looks every `interval` steps (0: never) whether the costliest rank is at `above` times the mean.
    RankBalance(int interval, double above) : interval_(interval), above_(above) {}

    [[nodiscard]] bool is_on() const { return interval_ > 0; }
    [[nodiscard]] bool is_due(std::int64_t step) const { return is_on() && step % interval_ == 0; }

    /// `seconds`: of this rank, since the last call. Returns weights of all points, by number; none where they stay
    /// where they are. A call of all ranks.
    [[nodiscard]] std::vector<double> weights(const dynamics::Ranks& ranks, double seconds);
    /// Cells have been shared out again after this step: `before` are the numbers that this rank had. A call of all ranks.
    void shared_out(std::int64_t step, std::span<const std::int32_t> before, const dynamics::Ranks& ranks, double seconds);
    /// The run has ended, `seconds` after the last call of `weights`. A call of all ranks.
    void end(const dynamics::Ranks& ranks, double seconds);

    [[nodiscard]] const Rebalancing& report() const { return report_; }

private:
    void look(const dynamics::Ranks& ranks, double seconds);

    int interval_;
    double above_;
    Rebalancing report_;
    std::vector<double> of_ranks_;  // seconds and cells of each rank, in turn
    double imbalance_ = 0.0;        // of these
    bool is_after_ = false;         // of the next look, for the report
};

}  // namespace abut::run
