#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace abut {

/// The text with U+FFFD in place of each byte that is not part of UTF-8 (RFC 3629: no overlong forms, no surrogates, nothing
/// above U+10FFFF). What is valid stays as it is.
[[nodiscard]] std::string as_utf8(std::string_view text);

/// The text with a space in place of each control character, line ends and tabs among them, and of each mark that turns
/// the direction of writing (Unicode's bidirectional controls), by which a text would look like another one.
[[nodiscard]] std::string in_one_line(std::string text);

/// True if a text has a control character or a mark that turns the direction of writing.
[[nodiscard]] bool has_control_character(std::string_view text);

/// A text as spreadsheets take it for one: those that begin with = + - @ and are no numbers, which they would take for a
/// formula, get an apostrophe in front. In one line, and in UTF-8.
[[nodiscard]] std::string as_cell(const std::string& text);

/// The beginning of a text for a message: at most `most` bytes, cut between characters, and then "...".
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most);

}  // namespace abut
