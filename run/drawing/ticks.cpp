#include "abut/run/drawing/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abut::run {
namespace {

constexpr int decades_of_nothing = 3;

/// The least of 1, 2, 5, 10, 20, ... times a power of ten that is `length` or more.
double round_step(double length) {
    const double power = std::pow(10.0, std::floor(std::log10(length)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= length) return factor * power;
    return 10.0 * power;
}

}  // namespace

double Axis::share(double value) const {
    if (!logarithmic) return (value - lower) / (upper - lower);
    if (!(value > lower)) return 0.0;
    return std::log10(value / lower) / std::log10(upper / lower);
}

Axis linear_axis(double least, double greatest, int most) {
    const double size = std::max(std::abs(least), std::abs(greatest));
    if (greatest - least <= 1e-12 * size || size == 0.0) {
        const double half = size > 0.0 ? 0.1 * size : 1.0;
        least -= half;
        greatest += half;
    }
    const double step = round_step((greatest - least) / (most - 1));
    Axis axis{.lower = least, .upper = greatest, .ticks = {}};
    for (double n = std::ceil(least / step); n * step <= greatest; ++n)
        axis.ticks.push_back({n * step, fmt::format("{:g}", n == 0.0 ? 0.0 : n * step)});
    return axis;
}

Axis logarithmic_axis(double least, double greatest, double floor, int most) {
    const auto decade = [](double value) { return static_cast<int>(std::floor(std::log10(value) + 1e-9)); };
    const int lowest = decade(std::max(least, floor));
    int highest = greatest > floor ? static_cast<int>(std::ceil(std::log10(greatest) - 1e-9)) : lowest + decades_of_nothing;
    highest = std::max(highest, lowest + 1);
    const int step = (highest - lowest) / most + 1;
    Axis axis{.lower = std::pow(10.0, lowest), .upper = std::pow(10.0, highest), .ticks = {}, .logarithmic = true};
    for (int exponent = lowest; exponent <= highest; exponent += step)
        axis.ticks.push_back({std::pow(10.0, exponent), fmt::format("1e{}", exponent)});
    return axis;
}

}  // namespace abut::run
