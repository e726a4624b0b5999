#include "abut/base/text.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace abut {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

unsigned char byte_at(std::string_view text, std::size_t at) { return static_cast<unsigned char>(text[at]); }

bool continues(std::string_view text, std::size_t at) { return at < text.size() && (byte_at(text, at) & 0xC0U) == 0x80U; }

/// Bytes of the character that begins here; 0: none does.
std::size_t length_of_character(std::string_view text, std::size_t at) {
    const unsigned char first = byte_at(text, at);
    if (first < 0x80U) return 1;
    const std::size_t length = first >= 0xC2U && first <= 0xDFU   ? 2
                               : first >= 0xE0U && first <= 0xEFU ? 3
                               : first >= 0xF0U && first <= 0xF4U ? 4
                                                                  : 0;
    for (std::size_t i = 1; i < length; ++i)
        if (!continues(text, at + i)) return 0;
    if (length < 3) return length;
    const unsigned char second = byte_at(text, at + 1);
    const bool overlong = (first == 0xE0U && second < 0xA0U) || (first == 0xF0U && second < 0x90U);
    const bool surrogate = first == 0xEDU && second >= 0xA0U, too_large = first == 0xF4U && second >= 0x90U;
    return overlong || surrogate || too_large ? 0 : length;
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }

/// Bytes of a mark that turns the direction of writing, where one begins here: U+061C, U+200E, U+200F, U+202A to
/// U+202E, U+2066 to U+2069. 0: none does.
std::size_t length_of_direction_mark(std::string_view text, std::size_t at) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("\xD8\x9C")) return 2;
    if (!rest.starts_with("\xE2\x80") && !rest.starts_with("\xE2\x81")) return 0;
    if (rest.size() < 3) return 0;
    const unsigned char block = byte_at(rest, 1), last = byte_at(rest, 2);
    const bool is_mark = block == 0x80U ? (last == 0x8EU || last == 0x8FU || (last >= 0xAAU && last <= 0xAEU))
                                        : (last >= 0xA6U && last <= 0xA9U);
    return is_mark ? 3 : 0;
}

/// As a whole, whatever the locale; also inf and nan.
bool is_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error != std::errc::invalid_argument && end == text.data() + text.size();
}

}  // namespace

std::string in_one_line(std::string text) {
    std::ranges::replace_if(text, is_control, ' ');
    for (std::size_t at = 0; at < text.size(); ++at)
        if (const std::size_t length = length_of_direction_mark(text, at)) {
            text[at] = ' ';
            text.erase(at + 1, length - 1);
        }
    return text;
}

bool has_control_character(std::string_view text) {
    for (std::size_t at = 0; at < text.size(); ++at)
        if (is_control(text[at]) || length_of_direction_mark(text, at) > 0) return true;
    return false;
}

std::string as_cell(const std::string& text) {
    const std::string cell = in_one_line(as_utf8(text));
    const bool looks_like_formula = !cell.empty() && std::string_view("=+-@").find(cell.front()) != std::string_view::npos;
    return looks_like_formula && !is_number(cell) ? "'" + cell : cell;
}

std::string as_utf8(std::string_view text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = length_of_character(text, at);
        result += length == 0 ? replacement : text.substr(at, length);
        at += std::max<std::size_t>(length, 1);
    }
    return result;
}

std::string shortened(std::string_view text, std::size_t most) {
    if (text.size() <= most) return std::string(text);
    while (most > 0 && continues(text, most)) --most;
    return std::string(text.substr(0, most)) + "...";
}

}  // namespace abut
