#include "abut/run/steps/rank_balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::run {
namespace {

/// A cell weighs at most so many times the mean, and at least that part of it: one odd measurement moves no more.
constexpr double most = 10.0;

/// Costliest over mean, of seconds and cells of each rank in turn; NaN where nothing was measured.
double imbalance_of(std::span<const double> of_ranks) {
    double largest = 0.0, total = 0.0;
    for (std::size_t i = 0; i < of_ranks.size(); i += 2) {
        largest = std::max(largest, of_ranks[i]);
        total += of_ranks[i];
    }
    const double mean = 2.0 * total / static_cast<double>(of_ranks.size());
    return mean > 0.0 ? largest / mean : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void RankBalance::look(const dynamics::Ranks& ranks, double seconds) {
    of_ranks_ = ranks.gather(std::vector{seconds, static_cast<double>(ranks.numbers().size())});
    imbalance_ = imbalance_of(of_ranks_);
    if (is_after_) report_.done.back().imbalance_after = imbalance_;
    is_after_ = false;
    ++report_.looks;
}

std::vector<double> RankBalance::weights(const dynamics::Ranks& ranks, double seconds) {
    look(ranks, seconds);
    const bool wanted = ranks.rank() == 0 && (above_ <= 1.0 || imbalance_ >= above_);
    if (ranks.largest(wanted ? 1.0 : 0.0) == 0.0) return {};
    const std::vector<double> numbers = ranks.gather(std::vector<double>(ranks.numbers().begin(), ranks.numbers().end()));
    double total = 0.0;
    for (std::size_t i = 0; i < of_ranks_.size(); i += 2) total += of_ranks_[i];
    const double mean = total / static_cast<double>(numbers.size());  // per cell
    std::vector<double> weights(numbers.size(), 1.0);
    std::size_t at = 0;
    for (std::size_t i = 0; i < of_ranks_.size(); i += 2) {
        const auto n = static_cast<std::size_t>(of_ranks_[i + 1]);
        const double weight = mean > 0.0 ? std::clamp(of_ranks_[i] / of_ranks_[i + 1] / mean, 1.0 / most, most) : 1.0;
        for (const std::size_t end = at + n; at < end; ++at) weights[static_cast<std::size_t>(numbers[at])] = weight;
    }
    return weights;
}

void RankBalance::shared_out(std::int64_t step, std::span<const std::int32_t> before, const dynamics::Ranks& ranks,
                             double seconds) {
    const auto now = ranks.numbers();
    const auto came =
        std::ranges::count_if(now, [&](std::int32_t number) { return !std::ranges::binary_search(before, number); });
    std::int64_t moved = 0;
    for (const double of_rank : ranks.gather(std::vector{static_cast<double>(came)}))
        moved += static_cast<std::int64_t>(of_rank);
    report_.done.push_back({.step = step,
                            .cells_moved = moved,
                            .imbalance_before = imbalance_,
                            .imbalance_after = std::numeric_limits<double>::quiet_NaN(),
                            .seconds = seconds});
    is_after_ = true;
}

void RankBalance::end(const dynamics::Ranks& ranks, double seconds) { look(ranks, seconds); }

}  // namespace abut::run
