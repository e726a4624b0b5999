#pragma once
// Private to the sources of run.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace abut::run {

/// A piece of HTML that is well-formed XML as well. It is made of text, which is escaped, and of elements, and of nothing
/// else: no text gets in as it is.
class Markup {
public:
    Markup() = default;
    /// Characters that XML has no place for become U+FFFD.
    Markup(std::string_view text);
    Markup(const char* text) : Markup(std::string_view(text)) {}
    Markup(const std::string& text) : Markup(std::string_view(text)) {}

    Markup& operator+=(const Markup& more);
    [[nodiscard]] friend Markup operator+(Markup left, const Markup& right) { return std::move(left += right); }

    [[nodiscard]] bool empty() const { return html_.empty(); }
    [[nodiscard]] const std::string& html() const { return html_; }

private:
    friend Markup element(std::string_view tag, const std::vector<std::pair<std::string, std::string>>& attributes,
                          const Markup& content);

    std::string html_;
};

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// `<tag name="value">content</tag>`; `<meta name="value"/>`, which has no content. Tags and names are taken as they are,
/// values are escaped.
[[nodiscard]] Markup element(std::string_view tag, const Attributes& attributes, const Markup& content = {});
[[nodiscard]] inline Markup element(std::string_view tag, const Markup& content) { return element(tag, {}, content); }

/// A row of a table: one cell for each, <td>, or another tag for all of them.
[[nodiscard]] Markup row(const std::vector<Markup>& cells, std::string_view tag = "td");
/// A table with a head, which scrolls where it is wider than the page; nothing where there are no rows.
[[nodiscard]] Markup table(const std::vector<Markup>& head, const std::vector<Markup>& rows);

}  // namespace abut::run
