#include "abut/dynamics/ranks.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "abut/base/error.hpp"
#include "abut/dynamics/sum_over.hpp"

namespace abut::dynamics {

std::int32_t Ranks::point_with(std::int32_t number) const {
    const auto here = numbers();
    const auto found = std::ranges::lower_bound(here, number);
    return found != here.end() && *found == number ? static_cast<std::int32_t>(found - here.begin()) : -1;
}

OneRank::OneRank(std::int32_t n_points, int dimension)
    : numbers_(static_cast<std::size_t>(n_points)), dimension_(dimension) {
    std::iota(numbers_.begin(), numbers_.end(), 0);
}

void OneRank::sum(const Summands& summands, std::span<const double> terms, std::span<double> total) const {
    const auto width = static_cast<std::size_t>(summands.width);
    for (std::size_t k = 0; k < width; ++k)
        total[k] = ordered_sum(std::ssize(terms) / summands.width, 0.0,
                               [&](std::ptrdiff_t i) { return terms[static_cast<std::size_t>(i) * width + k]; });
}

double OneRank::fold(double start, std::span<const std::int64_t> numbers, std::span<const double> terms) const {
    std::vector<std::size_t> order(terms.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return numbers[i]; });
    for (const std::size_t i : order) start += terms[i];
    return start;
}

const Ranks& one_rank() {
    static const OneRank one;
    return one;
}

void refuse_ranks(const Ranks& ranks, std::initializer_list<ForOneRank> features) {
    if (ranks.is_one()) return;
    for (const auto& [name, is_used] : features)
        if (is_used)
            throw BadInput(std::string(name) +
                           ": not made for a run on several ranks yet. Run it on one, or leave it out; docs/ranks.md says "
                           "what there is.");
}

}  // namespace abut::dynamics
