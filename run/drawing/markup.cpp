#include "abut/run/drawing/markup.hpp"

#include "abut/base/text.hpp"

namespace abut::run {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

/// Elements that HTML closes by itself; all others it wants closed by a tag of their own.
bool is_void(std::string_view tag) { return tag == "meta" || tag == "br"; }

bool is_allowed(char c) {
    const auto code = static_cast<unsigned char>(c);
    return code >= 0x20 || c == '\t' || c == '\n' || c == '\r';
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : as_utf8(text)) switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += is_allowed(c) ? std::string_view(&c, 1) : replacement;
        }
    return result;
}

}  // namespace

Markup::Markup(std::string_view text) : html_(escaped(text)) {}

Markup& Markup::operator+=(const Markup& more) {
    html_ += more.html_;
    return *this;
}

Markup element(std::string_view tag, const Attributes& attributes, const Markup& content) {
    Markup result;
    std::string& html = result.html_;
    html.append("<").append(tag);
    for (const auto& [name, value] : attributes) html += " " + name + "=\"" + escaped(value) + "\"";
    if (is_void(tag)) {
        html += "/>";
        return result;
    }
    html.append(">").append(content.html_).append("</").append(tag).append(">");
    return result;
}

Markup row(const std::vector<Markup>& cells, std::string_view tag) {
    Markup content;
    for (const Markup& cell : cells) content += cell.empty() ? element(tag, " ") : element(tag, cell);
    return element("tr", content) + "\n";
}

Markup table(const std::vector<Markup>& head, const std::vector<Markup>& rows) {
    if (rows.empty()) return {};
    Markup body;
    for (const Markup& each : rows) body += each;
    const Markup whole = element("table", element("thead", row(head, "th")) + element("tbody", body));
    return element("div", {{"class", "scroll"}}, whole) + "\n";
}

}  // namespace abut::run
