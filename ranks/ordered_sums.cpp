#include "abut/ranks/ordered_sums.hpp"

#include <algorithm>
#include <cassert>

#include "abut/base/parallel.hpp"
#include "abut/ranks/mpi.hpp"

namespace abut::ranks {
namespace {

constexpr std::int64_t block = parallel_grain;

/// The first of n_blocks blocks that rank r adds up.
std::int64_t first_block(std::int64_t n_blocks, int rank, int size) { return n_blocks * rank / size; }

}  // namespace

const OrderedSums::Plan& OrderedSums::plan_of(const dynamics::Summands& summands) {
    const std::tuple key(summands.per_point, summands.first, summands.last);
    const auto found = plans_.find(key);
    return found != plans_.end() ? found->second : plans_.emplace(key, make_plan(summands)).first->second;
}

OrderedSums::Plan OrderedSums::make_plan(const dynamics::Summands& summands) const {
    const int size = communicator_.size();
    const std::int64_t per_point = summands.per_point;
    Plan plan;
    plan.n = per_point * (std::min(summands.last, n_points_) - summands.first);
    const std::int64_t n_blocks = (plan.n + block - 1) / block;
    const auto begin_of = [&](int rank) { return std::min(plan.n, block * first_block(n_blocks, rank, size)); };
    plan.begin = begin_of(communicator_.rank());
    plan.n_here = begin_of(communicator_.rank() + 1) - plan.begin;

    std::vector<std::int64_t> values;
    plan.counts.assign(size, 0);
    int rank = 0;
    for (const std::int32_t number : numbers_) {
        if (number < summands.first || number >= summands.last) continue;
        for (std::int64_t j = 0; j < per_point; ++j) {
            values.push_back(per_point * (number - summands.first) + j);
            while (values.back() >= begin_of(rank + 1)) ++rank;
            ++plan.counts[rank];
        }
    }
    plan.arrived = exchange<std::int64_t>(communicator_, values, plan.counts).values;
    for (std::int64_t& position : plan.arrived) position -= plan.begin;
    return plan;
}

void OrderedSums::sum(const dynamics::Summands& summands, std::span<const double> terms, std::span<double> total) {
    const Plan& plan = plan_of(summands);
    const auto width = static_cast<std::size_t>(summands.width);
    std::vector<int> counts = plan.counts;
    for (int& count : counts) count = as_count(static_cast<std::size_t>(count) * width);
    assert(static_cast<int>(terms.size()) == offsets_of(counts).back());
    const auto arrived = exchange<double>(communicator_, terms, counts);
    std::vector<double> here(static_cast<std::size_t>(plan.n_here) * width);
    for (std::size_t i = 0; i < plan.arrived.size(); ++i)
        std::copy_n(arrived.values.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                    here.begin() + plan.arrived[i] * summands.width);

    std::vector<double> sums;  // of blocks
    for (std::int64_t begin = 0; begin < plan.n_here; begin += block) {
        sums.insert(sums.end(), width, 0.0);
        const std::span sum_of_block(sums.end() - summands.width, sums.end());
        for (std::int64_t i = begin; i < std::min(plan.n_here, begin + block); ++i)
            for (std::size_t j = 0; j < width; ++j) sum_of_block[j] += here[static_cast<std::size_t>(i) * width + j];
    }
    const auto all = gather_to_first<double>(communicator_, sums);
    std::ranges::fill(total, 0.0);
    for (std::size_t i = 0; i < all.values.size(); ++i) total[i % width] += all.values[i];
    broadcast<double>(communicator_, total);
}

}  // namespace abut::ranks
