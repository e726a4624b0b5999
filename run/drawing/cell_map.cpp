#include "abut/run/drawing/cell_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include "abut/run/drawing/svg.hpp"
#include "abut/run/drawing/ticks.hpp"

namespace abut::run {
namespace {

// All in units of the drawing.
constexpr double map_width = 760.0, map_left = 70.0, map_right = 110.0, map_top = 60.0, map_bottom = 48.0;
constexpr double least_height = 120.0, most_height = 640.0;
constexpr double bar_gap = 24.0, bar_width = 14.0, ring_radius = 12.0;
constexpr int most_map_ticks = 7, levels = 48;

/// The axes of the map, one unit of length as long on both.
class Sheet {
public:
    explicit Sheet(const CellMap& map) {
        std::array<double, 2> low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
        for (const auto* points : {&map.position, &map.rings})
            for (const auto& point : *points)
                for (std::size_t i = 0; i < 2; ++i) {
                    low[i] = std::min(low[i], point[i]);
                    high[i] = std::max(high[i], point[i]);
                }
        std::array<double, 2> length{high[0] - low[0], high[1] - low[1]};
        const double margin = std::max(0.04 * std::max(length[0], length[1]), std::numeric_limits<double>::min());
        for (std::size_t i = 0; i < 2; ++i) {
            low[i] -= margin;
            high[i] += margin;
            length[i] = high[i] - low[i];
        }
        const double wide = map_width - map_left - map_right;
        height_ = std::clamp(wide * length[1] / length[0], least_height, most_height);
        scale_ = std::min(wide / length[0], height_ / length[1]);
        const std::array<double, 2> size{wide / scale_, height_ / scale_};
        for (std::size_t i = 0; i < 2; ++i) {
            const double middle = 0.5 * (low[i] + high[i]);
            axis_[i] = linear_axis(middle - 0.5 * size[i], middle + 0.5 * size[i], most_map_ticks);
        }
    }
    [[nodiscard]] double bottom() const { return map_top + height_; }
    [[nodiscard]] double height() const { return bottom() + map_bottom; }
    [[nodiscard]] double x(double value) const {
        return map_left + axis_[0].share(value) * (map_width - map_left - map_right);
    }
    [[nodiscard]] double y(double value) const { return bottom() - axis_[1].share(value) * height_; }
    [[nodiscard]] const std::vector<Tick>& ticks(std::size_t axis) const { return axis_[axis].ticks; }

private:
    std::array<Axis, 2> axis_;
    double height_ = 0.0;
    double scale_ = 1.0;
};

/// From pale over blue to orange.
std::string colour(double share) {
    constexpr std::array<std::array<double, 3>, 3> stops{{{223, 232, 243}, {42, 120, 214}, {235, 104, 52}}};
    const std::size_t part = share < 0.5 ? 0 : 1;
    const double within = 2.0 * share - static_cast<double>(part);
    std::string text = "#";
    for (std::size_t i = 0; i < 3; ++i) {
        const double mixed = stops[part][i] + within * (stops[part + 1][i] - stops[part][i]);
        fmt::format_to(std::back_inserter(text), "{:02x}", static_cast<int>(std::lround(mixed)));
    }
    return text;
}

double share_of(double value, const CellMap& map) {
    if (!std::isfinite(value)) return 1.0;
    if (!(value > map.lower)) return 0.0;
    return std::min(1.0, std::log(value / map.lower) / std::log(map.upper / map.lower));
}

int level_of(double value, const CellMap& map) {
    return std::min(levels - 1, static_cast<int>(share_of(value, map) * levels));
}

/// Dots of one colour as one path; of those on the same unit of the drawing the highest alone.
Markup dots(const CellMap& map, const Sheet& sheet) {
    const double size = std::clamp(240.0 / std::sqrt(static_cast<double>(map.position.size())), 1.5, 16.0);
    struct Dot {
        long x, y;
        int level;
    };
    std::vector<Dot> all;
    for (std::size_t i = 0; i < map.position.size(); ++i)
        all.push_back({std::lround(sheet.x(map.position[i][0])), std::lround(sheet.y(map.position[i][1])),
                       level_of(map.value[i], map)});
    const auto place = [](const Dot& dot) { return std::pair(dot.x, dot.y); };
    std::ranges::stable_sort(
        all, [&](const Dot& a, const Dot& b) { return place(a) != place(b) ? place(a) < place(b) : a.level > b.level; });
    const auto rest = std::ranges::unique(all, {}, place);
    all.erase(rest.begin(), rest.end());
    std::ranges::stable_sort(all, {}, &Dot::level);
    Markup result;
    for (auto dot = all.begin(); dot != all.end();) {
        const int level = dot->level;
        std::string path;
        for (; dot != all.end() && dot->level == level; ++dot)
            fmt::format_to(std::back_inserter(path), "M{},{}h.01", dot->x, dot->y);
        result += element(
            "path",
            {{"class", "dots"}, {"stroke", colour((level + 0.5) / levels)}, {"stroke-width", shown(size)}, {"d", path}});
    }
    return result;
}

Markup frame(const CellMap& map, const Sheet& sheet) {
    const double right = map_width - map_right, bottom = sheet.bottom();
    Markup result;
    for (const Tick& tick : sheet.ticks(0)) {
        result += line("grid", sheet.x(tick.at), map_top, sheet.x(tick.at), bottom + 5.0);
        result += label(tick.label, sheet.x(tick.at), bottom + 18.0, "middle");
    }
    for (const Tick& tick : sheet.ticks(1)) {
        result += line("grid", map_left - 5.0, sheet.y(tick.at), right, sheet.y(tick.at));
        result += label(tick.label, map_left - 8.0, sheet.y(tick.at) + 4.0, "end");
    }
    return result + line("axis", map_left, bottom, right, bottom) + line("axis", map_left, map_top, map_left, bottom) +
           label(map.x_label, 0.5 * (map_left + right), bottom + 38.0, "middle") +
           upright_label(map.y_label, 14.0, 0.5 * (map_top + bottom));
}

/// The colours beside the map, with their values.
Markup colour_bar(const CellMap& map, const Sheet& sheet) {
    const double x = map_width - map_right + bar_gap, bottom = sheet.bottom(), step = (bottom - map_top) / levels;
    Markup result;
    for (int level = 0; level < levels; ++level)
        result += element("rect", {{"x", shown(x)},
                                   {"y", shown(bottom - (level + 1) * step)},
                                   {"width", shown(bar_width)},
                                   {"height", shown(step + 1.0)},
                                   {"fill", colour((level + 0.5) / levels)}});
    for (const double value : {map.lower, std::sqrt(map.lower * map.upper), map.upper})
        result += label(fmt::format("{:.2g}", value), x + bar_width + 5.0,
                        bottom - share_of(value, map) * (bottom - map_top) + 4.0, "start");
    return result + label(map.value_label, x, map_top - 8.0, "start");
}

}  // namespace

std::string drawing_file(const CellMap& map) {
    const Sheet sheet(map);
    Markup content = element("text", {{"class", "heading"}, {"x", "14"}, {"y", "20"}}, map.title) +
                     label(map.subtitle, 14.0, 38.0, "start") + frame(map, sheet) + dots(map, sheet);
    for (const auto& ring : map.rings)
        content += element("circle", {{"class", "ring"},
                                      {"cx", shown(sheet.x(ring[0]))},
                                      {"cy", shown(sheet.y(ring[1]))},
                                      {"r", shown(ring_radius)}});
    return svg_file(map.title, map_width, sheet.height(), content + colour_bar(map, sheet));
}

}  // namespace abut::run
