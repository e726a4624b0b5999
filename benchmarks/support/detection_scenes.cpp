#include "support/detection_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/base/error.hpp"

namespace abut::benchmark {
namespace {

constexpr double height = 2.0;  // of the cylinders, whose radius is 1 [m]

// The wall of a cylinder about the axis z through `middle`: about n triangles, rows turned against each other.
void append_wall(Body& body, int n, const Vector<3>& middle, double radius, double turn, bool looks_out) {
    const double around = 2.0 * std::numbers::pi * radius, side = std::sqrt(2.0 * height * around / n);
    const int columns = std::max(8, static_cast<int>(std::lround(around / side)));
    const int rows = std::max(1, static_cast<int>(std::lround(0.5 * n / columns)));
    const auto first = static_cast<std::int32_t>(body.vertices.size());
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const double angle = turn + 2.0 * std::numbers::pi * (column + 0.37 * row) / columns;
            body.vertices.push_back(middle + Vector<3>(radius * std::cos(angle), radius * std::sin(angle),
                                                       height * (static_cast<double>(row) / rows - 0.5)));
        }
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        if (!looks_out) std::swap(a, b);
        body.triangles.push_back({first + a, first + b, first + c});
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const std::int32_t a = row * columns + column, b = row * columns + (column + 1) % columns;
            add(a, b, b + columns);
            add(a, b + columns, a + columns);
        }
}

}  // namespace

std::vector<geometry::Box<3>> Body::boxes(double margin) const {
    std::vector<geometry::Box<3>> result;
    result.reserve(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto [a, b, c] = corners(i);
        result.push_back(geometry::Box<3>{a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)}.grown(margin));
    }
    return result;
}

DetectionScene detection_scene(const std::string& name, int n) {
    const double side = std::sqrt(2.0 * height * 2.0 * std::numbers::pi / n);
    const double gap = 0.2 * side;
    DetectionScene scene{.bodies = {}, .side = side, .distance = 0.5 * side};
    append_wall(scene.bodies[0], n, Vector<3>::Zero(), 1.0, 0.0, true);
    if (name == "press") {
        append_wall(scene.bodies[1], n, Vector<3>(2.0 + gap, 0.0, 0.3 * side), 1.0, 0.1, true);
    } else if (name == "plug") {
        append_wall(scene.bodies[1], n / 2, Vector<3>(0.0, 0.0, 0.3 * side), 1.0 + gap, 0.1, false);
        append_wall(scene.bodies[1], n / 2, Vector<3>(0.0, 0.0, 0.3 * side), 1.2, 0.1, true);
    } else {
        throw BadInput("there is no scene '" + name + "'; there are 'press' and 'plug'.");
    }
    return scene;
}

}  // namespace abut::benchmark
