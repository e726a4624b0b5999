#pragma once
// Private to the sources of run.
#include <string>

#include "abut/run/drawing/markup.hpp"

/// Parts of drawings, in units of the drawing, y downwards. Styles are classes of the style sheet around them.
namespace abut::run {

/// "12.3"
[[nodiscard]] std::string shown(double position);
[[nodiscard]] Markup line(const std::string& style, double x_1, double y_1, double x_2, double y_2);
/// `anchor` is start, middle or end, of the text at x.
[[nodiscard]] Markup label(const std::string& text, double x, double y, const std::string& anchor);
/// A label that reads upwards, around (x, y).
[[nodiscard]] Markup upright_label(const std::string& text, double x, double y);

/// A drawing as a file of its own: dark on white, whatever its reader's colours are.
[[nodiscard]] std::string svg_file(const std::string& title, double width, double height, const Markup& content);

}  // namespace abut::run
