#pragma once
// Private to the layer.
#include <limits>
#include <string>

namespace abut::input {

/// The values that a number may take.
struct Limits {
    const char* unit = "";                                    ///< empty: a plain number
    double above = -std::numeric_limits<double>::infinity();  ///< open
    double below = std::numeric_limits<double>::infinity();   ///< open, unless `closed`
    bool closed = false;                                      ///< `below` itself is allowed
    bool zero = false;                                        ///< 0 is allowed as well

    [[nodiscard]] bool allow(double value) const;
};

/// "above 0 kg/m^3", "above 0, at most 1"; empty where every finite number is allowed.
[[nodiscard]] std::string text_of(const Limits& limits);
/// "2 kg/m^3"
[[nodiscard]] std::string with_unit(double value, const Limits& limits);

}  // namespace abut::input
