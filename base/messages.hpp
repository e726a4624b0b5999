#pragma once
// Private to the sources of the layers.
#include <array>
#include <charconv>
#include <string>

namespace abut {

/// A value as error messages show it, in 6 digits, whatever the locale: "0.00021" or "2.1e-12".
[[nodiscard]] inline std::string number(double value) {
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6).ptr};
}

/// The shortest text that reads back as the same number, whatever the locale.
[[nodiscard]] inline std::string exact_number(double value) {
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace abut
