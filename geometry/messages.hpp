#pragma once
// Private to the sources of the layers.
#include <charconv>
#include <string>

namespace abut {

/// A value as error messages show it, whatever the locale: "2.1e-04".
[[nodiscard]] inline std::string number(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6).ptr;
    return {text, end};
}

}  // namespace abut
