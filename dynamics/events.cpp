#include "abut/dynamics/events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics {
namespace {

std::vector<int> sides_at(std::span<const Events::Function> functions, std::span<const double> q) {
    std::vector<int> sides;
    for (const Events::Function& function : functions) {
        const double value = function(q);
        if (!(value != 0.0) || std::isnan(value))
            throw BadInput("events: function " + std::to_string(sides.size()) + " is " + number(value) +
                               " at the start, which is on neither side. Give the side that it comes from, +1 or -1.",
                           {.value = value});
        sides.push_back(value > 0.0 ? 1 : -1);
    }
    return sides;
}

}  // namespace

Events::Events(std::vector<Function> functions, std::span<const double> q)
    : functions_(std::move(functions)), sides_(sides_at(functions_, q)) {}

Events::Events(std::vector<Function> functions, std::vector<int> sides)
    : functions_(std::move(functions)), sides_(std::move(sides)) {
    const auto wrong = std::ranges::find_if_not(sides_, [](int side) { return side == 1 || side == -1; });
    if (sides_.size() != functions_.size() || wrong != sides_.end())
        throw BadInput("events: " + std::to_string(sides_.size()) + " sides are given" +
                       (wrong == sides_.end() ? "" : ", one of them " + std::to_string(*wrong)) + ", for " +
                       std::to_string(functions_.size()) + " functions. Give +1 or -1 for each.");
}

std::vector<double> Events::values(std::span<const double> q) const {
    std::vector<double> values(functions_.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = signed_value(i, q);
    return values;
}

double Events::least(std::span<const double> q, std::span<const double> scales) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < functions_.size(); ++i) least = std::min(least, signed_value(i, q) / scales[i]);
    return least;
}

std::size_t Events::turn(std::span<const double> q, std::span<const double> scales, double tolerance) {
    std::size_t turned = 0;
    for (std::size_t i = 0; i < functions_.size(); ++i) {
        if (signed_value(i, q) > tolerance * scales[i]) continue;
        sides_[i] = -sides_[i];
        ++turned;
    }
    return turned;
}

double Events::signed_value(std::size_t i, std::span<const double> q) const {
    const double value = sides_[i] * functions_[i](q);
    if (std::isnan(value))
        throw Diverged("events: function " + std::to_string(i) +
                       " is not a number. The run has lost its solution, or the function is not defined there: take a "
                       "shorter step.");
    return value;
}

std::vector<double> detail::event_scales(std::span<const double> at_start, std::span<const double> at_end) {
    std::vector<double> scales(at_start.size(), 0.0);
    for (const std::span<const double> values : {at_start, at_end})
        for (std::size_t i = 0; i < scales.size(); ++i)
            if (std::isfinite(values[i])) scales[i] = std::max(scales[i], std::abs(values[i]));
    std::ranges::replace(scales, 0.0, 1.0);
    return scales;
}

}  // namespace abut::dynamics
