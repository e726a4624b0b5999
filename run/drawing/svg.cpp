#include "abut/run/drawing/svg.hpp"

#include <fmt/format.h>

namespace abut::run {
namespace {

// The light colours of the report, which not every reader of SVG would take from variables. No character of it is
// escaped in XML.
constexpr const char* file_style =
    "text { font-family: sans-serif; font-size: 12px; fill: #1b1b1a; } .heading { font-size: 14px; } "
    ".grid { stroke: #dcdbd6; stroke-width: 1; } .axis { stroke: #1b1b1a; stroke-width: 1; } "
    ".curve { fill: none; stroke-width: 1.6; stroke-linejoin: round; } .blue { stroke: #2a78d6; } .orange { stroke: "
    "#d9591f; } "
    ".grey { stroke: #a5a49f; stroke-width: 4; } .ink { stroke: #1b1b1a; } "
    ".dots { fill: none; stroke-linecap: round; } .ring { fill: none; stroke: #1b1b1a; stroke-width: 2; }";

}  // namespace

std::string shown(double position) { return fmt::format("{:.1f}", position); }

Markup line(const std::string& style, double x_1, double y_1, double x_2, double y_2) {
    return element("line",
                   {{"class", style}, {"x1", shown(x_1)}, {"y1", shown(y_1)}, {"x2", shown(x_2)}, {"y2", shown(y_2)}});
}

Markup label(const std::string& text, double x, double y, const std::string& anchor) {
    return element("text", {{"x", shown(x)}, {"y", shown(y)}, {"text-anchor", anchor}}, text);
}

Markup upright_label(const std::string& text, double x, double y) {
    return element("text",
                   {{"x", "0"},
                    {"y", "0"},
                    {"text-anchor", "middle"},
                    {"transform", fmt::format("translate({:.0f} {:.1f}) rotate(-90)", x, y)}},
                   text);
}

std::string svg_file(const std::string& title, double width, double height, const Markup& content) {
    const std::string wide = fmt::format("{:.0f}", width), high = fmt::format("{:.0f}", height);
    const Markup ground = element("rect", {{"width", wide}, {"height", high}, {"fill", "#ffffff"}});
    return element("svg",
                   {{"xmlns", "http://www.w3.org/2000/svg"},
                    {"width", wide},
                    {"height", high},
                    {"viewBox", fmt::format("0 0 {} {}", wide, high)}},
                   element("title", title) + element("style", file_style) + ground + content)
               .html() +
           "\n";
}

}  // namespace abut::run
