#pragma once
// Private to the sources of run.
#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "abut/run/drawing/markup.hpp"
#include "abut/run/files/picture_marks.hpp"

namespace abut::run {

/// Projection of positions into a drawing: to the right, downwards, and the greater the third, the nearer to the eye.
struct Projection {
    std::function<std::array<double, 3>(const std::array<double, 3>&)> place;
    double per_metre;  ///< units of the drawing
};

/// Arrows that press on their faces or pull at them, as long as they are large beside `largest` [Pa]. Those on faces
/// that are not seen, and such as are near 0, are left out.
[[nodiscard]] Markup drawn_loads(std::span<const PictureMarks::Load> loads, double largest, const Projection& projection);
/// A spring as a zigzag, a hinge as a ring.
[[nodiscard]] Markup drawn_spring(const std::array<std::array<double, 3>, 2>& ends, const Projection& projection);
/// An arrow along gravity, whose middle is at (x, y); none without gravity.
[[nodiscard]] Markup drawn_gravity(const std::array<double, 3>& gravity, double x, double y, const Projection& projection);

/// A name that belongs to a place in a drawing.
struct PlacedName {
    std::string name;
    double x, y;
};
/// As many names as lie within an area, in this order, without lying on each other.
[[nodiscard]] Markup drawn_names(const std::vector<PlacedName>& names, double left, double right, double top, double bottom);

}  // namespace abut::run
