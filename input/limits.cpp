#include "abut/input/limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

namespace abut::input {

bool Limits::allow(double value) const {
    if (zero && value == 0.0) return true;
    return std::isfinite(value) && value > above && (value < below || (closed && value == below));
}

std::string text_of(const Limits& limits) {
    std::vector<std::string> parts;
    if (limits.zero && limits.above == 0.0)
        parts.push_back(with_unit(0.0, limits) + " or above");
    else if (std::isfinite(limits.above))
        parts.push_back("above " + with_unit(limits.above, limits));
    if (std::isfinite(limits.below))
        parts.push_back((limits.closed ? "at most " : "below ") + with_unit(limits.below, limits));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string with_unit(double value, const Limits& limits) {
    return fmt::format("{:g}{}{}", value, *limits.unit == '\0' ? "" : " ", limits.unit);
}

}  // namespace abut::input
