#pragma once
#include <cstddef>
#include <optional>
#include <string>

namespace abut::apps {

/// Whether a terminal shows at once what goes to this descriptor. Of a rank that `--ranks` has started it is the
/// terminal of the program that was called.
[[nodiscard]] bool is_terminal(int descriptor);

/// Columns of the terminal behind a descriptor; what COLUMNS in the environment says where that is set, 20 at least;
/// nothing where there is neither: what goes to a file or another program keeps its lines.
[[nodiscard]] std::optional<std::size_t> terminal_width(int descriptor);

/// Lines of at most `width` letters, broken at spaces. What follows the first part of a line begins where that does, and of
/// "  name   meaning" where the meaning does. A word that is longer stays whole, in a line of its own.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t width);

/// `wrapped` for the terminal behind a descriptor, as it is where there is none.
[[nodiscard]] std::string for_terminal(const std::string& text, int descriptor);

}  // namespace abut::apps
