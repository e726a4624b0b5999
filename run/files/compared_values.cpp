#include "abut/run/files/compared_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace abut::run {
namespace {

bool is_same_value(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

double size_of_difference(double a, double b) {
    const double size = std::abs(a - b);
    return std::isfinite(size) ? size : std::numeric_limits<double>::infinity();
}

}  // namespace

void ComparedValues::add(double first, double second, const Place& place) {
    for (const double value : {first, second})
        if (std::isfinite(value)) largest_value_ = std::max(largest_value_, std::abs(value));
    if (!is_same_value(first, second)) {
        const double size = size_of_difference(first, second);
        if (records_.empty() || size > records_.back().size) records_.push_back({place, first, second, size});
        if (tolerance_ == 0.0 && records_.size() > 2) records_.erase(records_.begin() + 1);
    }
    if (tolerance_ == 0.0) return;
    while (!records_.empty() && records_.front().size <= tolerance_ * largest_value_) records_.pop_front();
}

ValueDifference ComparedValues::described(const Difference& difference, const std::string& name) const {
    return {.name = name,
            .first = shortest(difference.first),
            .second = shortest(difference.second),
            .relative = difference.size > 0.0 ? difference.size / largest_value_ : 0.0};
}

std::vector<ValueDifference> largest_of(std::vector<ValueDifference> differences) {
    constexpr std::size_t most = 3;
    std::ranges::stable_sort(differences, std::ranges::greater{}, &ValueDifference::relative);
    differences.resize(std::min(differences.size(), most));
    return differences;
}

std::string shortest(double value) { return fmt::format("{}", value); }

}  // namespace abut::run
