#pragma once
#include <array>
#include <charconv>
#include <string>

namespace abut::mesh {

/// A value as error messages show it, "0.00021" or "2.1e-12", whatever the locale.
[[nodiscard]] inline std::string number(double value) {
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3).ptr};
}

/// The shortest text that reads back as the same number, whatever the locale.
[[nodiscard]] inline std::string exact_number(double value) {
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace abut::mesh
