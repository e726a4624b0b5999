#include "abut/run/report/mark_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "abut/run/drawing/svg.hpp"

namespace abut::run {
namespace {

using Position = PictureMarks::Position;

// All in units of the drawing.
constexpr double longest_arrow = 20.0, head_length = 7.0, head_width = 3.2, gravity_arrow = 22.0;
constexpr double tooth_height = 4.0, hinge_radius = 4.5, shortest_spring = 10.0;
constexpr double width_of_letter = 7.5, height_of_letter = 16.0;  // about
constexpr double least_share = 0.02;                              // of the largest traction, that is drawn
constexpr int teeth = 6;
constexpr double lead = 0.15;  // part of a spring that is straight, at each end

double length_of(const Position& x) { return std::hypot(x[0], x[1], x[2]); }

Position moved(Position x, const Position& along, double by) {
    for (std::size_t i = 0; i < 3; ++i) x[i] += by * along[i];
    return x;
}

struct OnPaper {
    double x, y;
};

std::string path_of(const std::vector<OnPaper>& points) {
    std::string path;
    for (const auto& [x, y] : points) path += (path.empty() ? "M" : "L") + shown(x) + "," + shown(y);
    return path;
}

/// Lines that are seen on dark bodies and on the page.
Markup lined(const std::string& style, const std::string& path) {
    return element("path", {{"class", "halo"}, {"d", path}}) + element("path", {{"class", style}, {"d", path}});
}

Markup arrow(const std::string& style, OnPaper tail, OnPaper tip) {
    const double length = std::hypot(tip.x - tail.x, tip.y - tail.y);
    if (!(length > 0.0)) return {};
    const double x = (tip.x - tail.x) / length, y = (tip.y - tail.y) / length, head = std::min(head_length, length);
    const double across = head_width * head / head_length;
    const OnPaper neck{tip.x - head * x, tip.y - head * y};
    return lined(style,
                 path_of({tail, neck}) +
                     path_of({tip, {neck.x - across * y, neck.y + across * x}, {neck.x + across * y, neck.y - across * x}}) +
                     "Z");
}

}  // namespace

Markup drawn_loads(std::span<const PictureMarks::Load> loads, double largest, const Projection& projection) {
    Markup drawn;
    for (const auto& [at, traction, normal] : loads) {
        const double size = length_of(traction);
        if (!(size > least_share * largest)) continue;  // or not finite
        const double towards_eye = projection.place(moved(at, normal, 1.0))[2] - projection.place(at)[2];
        if (towards_eye < 0.0) continue;
        const double pressing = traction[0] * normal[0] + traction[1] * normal[1] + traction[2] * normal[2];
        const double length = longest_arrow * size / largest / projection.per_metre;
        const Position other = moved(at, traction, (pressing < 0.0 ? -length : length) / size);
        const Position on_face = projection.place(at), outside = projection.place(other);
        const OnPaper near{on_face[0], on_face[1]}, far{outside[0], outside[1]};
        drawn += pressing < 0.0 ? arrow("load", far, near) : arrow("load", near, far);
    }
    return drawn;
}

Markup drawn_spring(const std::array<std::array<double, 3>, 2>& ends, const Projection& projection) {
    const Position first = projection.place(ends[0]), last = projection.place(ends[1]);
    const double length = std::hypot(last[0] - first[0], last[1] - first[1]);
    if (!std::isfinite(length)) return {};
    if (length < shortest_spring)
        return element("circle", {{"class", "spring"},
                                  {"cx", shown(0.5 * (first[0] + last[0]))},
                                  {"cy", shown(0.5 * (first[1] + last[1]))},
                                  {"r", shown(hinge_radius)}});
    const double x = (last[0] - first[0]) / length, y = (last[1] - first[1]) / length;
    const auto point = [&](double share, double across) {
        return OnPaper{first[0] + share * length * x - across * y, first[1] + share * length * y + across * x};
    };
    std::vector<OnPaper> points = {point(0.0, 0.0), point(lead, 0.0)};
    for (int tooth = 0; tooth < 2 * teeth; ++tooth)
        points.push_back(
            point(lead + (1.0 - 2.0 * lead) * (tooth + 0.5) / (2 * teeth), tooth % 2 == 0 ? tooth_height : -tooth_height));
    points.push_back(point(1.0 - lead, 0.0));
    points.push_back(point(1.0, 0.0));
    return lined("spring", path_of(points));
}

Markup drawn_gravity(const std::array<double, 3>& gravity, double x, double y, const Projection& projection) {
    const double size = length_of(gravity);
    if (!(size > 0.0)) return {};
    const Position from = projection.place({}), to = projection.place(moved({}, gravity, 1.0 / projection.per_metre / size));
    const double half_x = 0.5 * gravity_arrow * (to[0] - from[0]), half_y = 0.5 * gravity_arrow * (to[1] - from[1]);
    return arrow("gravity", {x - half_x, y - half_y}, {x + half_x, y + half_y}) +
           label("gravity", x + 16.0, y + 4.0, "start");
}

Markup drawn_names(const std::vector<PlacedName>& names, double left, double right, double top, double bottom) {
    struct Box {
        double x, y, half;
    };
    std::vector<Box> taken;
    Markup drawn;
    for (const auto& [name, x, y] : names) {
        const Box here{x, y, 0.5 * width_of_letter * static_cast<double>(name.size())};
        const bool is_inside =
            here.x - here.half > left && here.x + here.half < right && here.y - height_of_letter > top && here.y < bottom;
        const bool is_free = std::ranges::none_of(taken, [&](const Box& other) {
            return std::abs(other.x - here.x) < other.half + here.half && std::abs(other.y - here.y) < height_of_letter;
        });
        if (!is_inside || !is_free) continue;
        taken.push_back(here);
        drawn +=
            element("text", {{"class", "name"}, {"x", shown(x)}, {"y", shown(y + 4.0)}, {"text-anchor", "middle"}}, name);
    }
    return drawn;
}

}  // namespace abut::run
