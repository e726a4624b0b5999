#pragma once
// Private to the sources of run.
#include <span>
#include <string>
#include <vector>

#include "abut/run/drawing/markup.hpp"

namespace abut::run {

/// A curve over the abscissae of its plot.
struct Curve {
    std::string name;
    std::string style;      ///< class of the style sheet
    std::vector<double> y;  ///< as many as abscissae; a value that is not finite leaves a gap
};

struct Plot {
    std::string title;    ///< for those who cannot see it
    std::string x_label;  ///< with its unit
    std::string y_label;
    std::vector<double> x;  ///< does not decrease
    std::vector<Curve> curves;
    bool logarithmic = false;  ///< of y; what is below `floor` is drawn at the lower end
    double floor = 1e-18;
};

/// The plot as inline SVG with axes, ticks and the names of the curves. It takes at most a few thousand points per curve,
/// however many there are: see `thinned`.
[[nodiscard]] Markup drawing(const Plot& plot);
/// Plots below each other under their title, as the text of an SVG file.
[[nodiscard]] std::string drawing_file(const std::string& title, std::span<const Plot> plots);

/// Indices of the points that show a curve in `columns` equal parts of the x axis: of each part the first, the last, the
/// least and the greatest value, in order; of values in a row that are not finite the first.
[[nodiscard]] std::vector<std::size_t> thinned(std::span<const double> x, std::span<const double> y, int columns);

}  // namespace abut::run
