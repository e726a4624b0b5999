#include "abut/run/drawing/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "abut/run/drawing/svg.hpp"
#include "abut/run/drawing/ticks.hpp"

namespace abut::run {
namespace {

// All in units of the drawing, which a reader scales as a whole.
constexpr double width = 760.0, height = 300.0;
constexpr double left = 78.0, right = 12.0, top = 30.0, bottom = 44.0;
constexpr double heading_height = 30.0;  // above the plots of a file
constexpr double tick_length = 5.0, legend_mark = 22.0, letter = 7.2;
constexpr int most_ticks_x = 9, most_ticks_y = 7, columns = 640;
constexpr double margin = 0.04;  // above and below the curves, of their range

struct Range {
    double least = std::numeric_limits<double>::infinity();
    double greatest = -least;

    void add(double value) {
        least = std::min(least, value);
        greatest = std::max(greatest, value);
    }
    [[nodiscard]] bool empty() const { return least > greatest; }
};

Range range_of(const Plot& plot) {
    Range range;
    for (const Curve& curve : plot.curves)
        for (const double y : curve.y)
            if (std::isfinite(y) && !(plot.logarithmic && y < plot.floor)) range.add(y);
    return range;
}

Axis y_axis(const Plot& plot) {
    Range range = range_of(plot);
    if (plot.logarithmic)
        return range.empty() ? logarithmic_axis(plot.floor, plot.floor, plot.floor, most_ticks_y)
                             : logarithmic_axis(range.least, range.greatest, plot.floor, most_ticks_y);
    if (range.empty()) range.add(0.0);
    const double more = margin * (range.greatest - range.least);
    return linear_axis(range.least - more, range.greatest + more, most_ticks_y);
}

Axis x_axis(const Plot& plot) {
    return plot.x.empty() ? linear_axis(0.0, 1.0, most_ticks_x) : linear_axis(plot.x.front(), plot.x.back(), most_ticks_x);
}

/// The two axes as places on the drawing, y downwards.
struct Frame {
    Axis x, y;

    [[nodiscard]] double at_x(double value) const { return left + x.share(value) * (width - left - right); }
    [[nodiscard]] double at_y(double value) const { return height - bottom - y.share(value) * (height - top - bottom); }
};

Markup grid(const Frame& frame) {
    Markup result;
    for (const Tick& tick : frame.x.ticks) {
        const double x = frame.at_x(tick.at);
        result += line("grid", x, top, x, height - bottom + tick_length);
        result += label(tick.label, x, height - bottom + 18.0, "middle");
    }
    for (const Tick& tick : frame.y.ticks) {
        const double y = frame.at_y(tick.at);
        result += line("grid", left - tick_length, y, width - right, y);
        result += label(tick.label, left - 8.0, y + 4.0, "end");
    }
    return result;
}

Markup axes(const Plot& plot, const Frame& frame) {
    const double middle = 0.5 * (top + height - bottom);
    return grid(frame) + line("axis", left, height - bottom, width - right, height - bottom) +
           line("axis", left, top, left, height - bottom) +
           label(plot.x_label, 0.5 * (left + width - right), height - 6.0, "middle") +
           upright_label(plot.y_label, 14.0, middle);
}

/// "M1,2L3,4": after a gap it begins again.
std::string path(const Plot& plot, const Curve& curve, const Frame& frame) {
    std::string result;
    bool open = false;
    for (const std::size_t i : thinned(plot.x, curve.y, columns)) {
        const double x = frame.at_x(plot.x[i]), y = frame.at_y(curve.y[i]);
        if (std::isfinite(curve.y[i])) fmt::format_to(std::back_inserter(result), "{}{:.1f},{:.1f}", open ? 'L' : 'M', x, y);
        open = std::isfinite(curve.y[i]);
    }
    return result;
}

/// Above the plot, from left to right.
Markup legend(const Plot& plot) {
    Markup result;
    double x = left;
    for (const Curve& curve : plot.curves) {
        result += line("curve " + curve.style, x, top - 14.0, x + legend_mark, top - 14.0);
        result += label(curve.name, x + legend_mark + 6.0, top - 10.0, "start");
        x += legend_mark + 24.0 + letter * static_cast<double>(curve.name.size());
    }
    return result;
}

Markup content(const Plot& plot) {
    const Frame frame{x_axis(plot), y_axis(plot)};
    Markup result = axes(plot, frame);
    for (const Curve& curve : plot.curves)
        result += element("path", {{"class", "curve " + curve.style}, {"d", path(plot, curve, frame)}});
    return result + legend(plot);
}

/// First, last, least and greatest of the points of a part of the x axis.
class Part {
public:
    void add(std::size_t i, double y) {
        if (empty_) first_ = least_ = greatest_ = i, least_y_ = greatest_y_ = y;
        if (y < least_y_) least_ = i, least_y_ = y;
        if (y > greatest_y_) greatest_ = i, greatest_y_ = y;
        last_ = i;
        empty_ = false;
    }
    void take_to(std::vector<std::size_t>& kept) {
        if (empty_) return;
        for (const std::size_t i : {first_, std::min(least_, greatest_), std::max(least_, greatest_), last_})
            if (kept.empty() || kept.back() < i) kept.push_back(i);
        empty_ = true;
    }

private:
    bool empty_ = true;
    std::size_t first_ = 0, last_ = 0, least_ = 0, greatest_ = 0;
    double least_y_ = 0.0, greatest_y_ = 0.0;
};

}  // namespace

std::vector<std::size_t> thinned(std::span<const double> x, std::span<const double> y, int columns) {
    std::vector<std::size_t> kept;
    if (x.empty()) return kept;
    const double length = std::max(x.back() - x.front(), std::numeric_limits<double>::min());
    Part part;
    int column = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const int own = std::min(columns - 1, static_cast<int>((x[i] - x.front()) / length * columns));
        if (own != column || !std::isfinite(y[i])) part.take_to(kept);
        column = own;
        if (std::isfinite(y[i]))
            part.add(i, y[i]);
        else if (kept.empty() || std::isfinite(y[kept.back()]))
            kept.push_back(i);
    }
    part.take_to(kept);
    return kept;
}

Markup drawing(const Plot& plot) {
    return element("svg",
                   {{"xmlns", "http://www.w3.org/2000/svg"},
                    {"viewBox", fmt::format("0 0 {} {}", width, height)},
                    {"role", "img"}},
                   element("title", plot.title) + content(plot)) +
           "\n";
}

std::string drawing_file(const std::string& title, std::span<const Plot> plots) {
    Markup all = element("text", {{"class", "heading"}, {"x", shown(left)}, {"y", "22"}}, title);
    double y = heading_height;
    for (const Plot& plot : plots) {
        all += element("g", {{"transform", fmt::format("translate(0 {:.0f})", y)}}, content(plot));
        y += height;
    }
    return svg_file(title, width, y, all);
}

}  // namespace abut::run
