#include "apps/support/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "abut/ranks/session.hpp"

namespace abut::apps {
namespace {

constexpr std::size_t least_width = 20;

/// Number of letters of a text in UTF-8.
std::size_t letters(std::string_view text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Margin at which the lines after the first one begin: as far in as that does; of "  name   meaning" under the meaning.
std::size_t margin_of(const std::string& line) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t gap = begin == 0 ? std::string::npos : line.find("  ", begin);
    return gap == std::string::npos ? begin : std::min(line.find_first_not_of(' ', gap), line.size());
}

std::string wrapped_line(const std::string& line, std::size_t width) {
    const std::size_t begin = margin_of(line);
    const std::string margin(begin <= width / 2 ? begin : 0, ' ');
    std::string result = line.substr(0, begin), word;
    std::size_t column = letters(result);
    std::istringstream words(line.substr(begin));
    for (bool first = true; words >> word; first = false) {
        const std::size_t length = letters(word);
        if (!first && column + 1 + length > width) {
            result += "\n" + margin;
            column = margin.size();
        } else if (!first) {
            result += ' ';
            ++column;
        }
        result += word;
        column += length;
    }
    return result;
}

}  // namespace

bool is_terminal(int descriptor) { return isatty(descriptor) == 1 && std::getenv(ranks::plain_output) == nullptr; }

std::optional<std::size_t> terminal_width(int descriptor) {
    if (const char* columns = std::getenv("COLUMNS")) {
        std::size_t width = 0;
        const std::string_view text = columns;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), width);
        if (error == std::errc() && end == text.data() + text.size() && width > 0) return std::max(width, least_width);
    }
    winsize size{};
    if (!is_terminal(descriptor) || ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
    return std::max<std::size_t>(size.ws_col, least_width);
}

std::string wrapped(const std::string& text, std::size_t width) {
    std::string result, line;
    std::istringstream lines(text);
    while (std::getline(lines, line)) {
        result += letters(line) <= width ? line : wrapped_line(line, width);
        if (!lines.eof()) result += '\n';
    }
    return result;
}

std::string for_terminal(const std::string& text, int descriptor) {
    const auto width = terminal_width(descriptor);
    return width ? wrapped(text, *width) : text;
}

}  // namespace abut::apps
