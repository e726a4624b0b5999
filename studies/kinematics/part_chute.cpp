#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/mesh/shapes/shapes.hpp"
#include "studies/kinematics/rows.hpp"
#include "studies/kinematics/shapes.hpp"

namespace abut::studies::kinematics {
namespace chute_part {
namespace {

using std::numbers::pi;

constexpr double gravity = 1e-3, gap = 0.01;

Vector<2> downhill(double slope) { return {std::cos(slope), -std::sin(slope)}; }
Vector<2> upwards(double slope) { return {std::sin(slope), std::cos(slope)}; }

/// A disc of this many corners above the origin on a slope, on the middle of a side or on a corner.
Case<2> disc_on(double slope, int corners, bool on_side, const std::vector<Vector<2>>& wall) {
    const double lowest = on_side ? std::cos(pi / corners) : 1.0;
    const Vector<2> up = upwards(slope), centre = (lowest + gap) * up;
    const double down = std::atan2(-up.y(), -up.x());
    const auto disc = mesh::fan_disc(centre, 1.0, corners, down + (on_side ? pi / corners : 0.0));
    Case<2> one = case_of<2>("disc on a chute", {disc}, Kinematics::rigid);
    let_fall<2>(one, gravity);
    one.scene.solid.obstacles = {wall_along(wall)};
    one.scene.energy_scale = {"E0", gravity};
    return one;
}

/// Spin and the drop of the whole motion of a run.
struct Slide {
    double largest_spin = 0.0, largest_speed = 0.0;
    Watch<2> watch = [this](const auto& run, const auto& solid) {
        const solid::BodyMotion<2> motion = solid::body_motions<2>(run, solid).front();
        largest_spin = std::max(largest_spin, std::abs(motion.spin[0]));
        largest_speed = std::max(largest_speed, motion.velocity.norm());
    };
    Slide() = default;
    Slide(const Slide&) = delete;
};

/// On one facet the disc is its own mirror image in the line through its centre and across the facet. Where it falls along
/// that line no force has a moment. Where it slides, the mean force of a step has one of dt^2 times speed and change of
/// force, of a sign that changes as the contact opens: a pair keeps J~ exactly, and the couple of its faces to second
/// order.
void slide_straight(double degrees, bool on_side, double cfl, const Options& options, const Sink& sink) {
    const double slope = degrees * pi / 180.0;
    const std::vector<Vector<2>> wall{-3.0 * downhill(slope), (degrees == 0.0 ? 3.0 : 60.0) * downhill(slope)};
    Case<2> one = disc_on(slope, 48, on_side, wall);
    one.scene.time = options.quick ? 60.0 : 300.0;
    one.run.cfl = cfl;
    Slide slide;
    const std::string setting = fmt::format("{:g} degrees, on a {}, cfl {:g}", degrees, on_side ? "side" : "corner", cfl);
    Row row = row_of<2>(one, setting, options, nullptr, slide.watch);
    const double spin = slide.largest_spin / slide.largest_speed;
    row.quantities.at_most("spin times radius over speed", spin, 1e-12);
    if (degrees > 0.0) row.quantities.at_most("that over cfl^2", spin / (cfl * cfl), 1e-5);
    row.quantities.at_most("H - H~", row.run->excess, 1e-2);
    sink(row);
}

/// Where facets meet nothing is its own mirror image, and forces pass the centre by up to half a side: what spin they give
/// falls with the length of the sides.
void slide_around(int corners, const Options& options, const Sink& sink) {
    std::vector<Vector<2>> wall{Vector<2>::Zero()};
    std::vector<double> slopes;
    for (int i = 0; i < 9; ++i) slopes.push_back((40.0 - 10.0 * i) * pi / 180.0);
    wall.front() = -2.0 * downhill(slopes.front());
    for (std::size_t i = 0; i < slopes.size(); ++i)
        wall.push_back(wall.back() + (i == 0 ? 5.0 : i + 1 == slopes.size() ? 20.0 : 2.0) * downhill(slopes[i]));
    Case<2> one = disc_on(slopes.front(), corners, true, wall);
    one.scene.time = options.quick ? 150.0 : 250.0;
    one.run.filter = true;
    Slide slide;
    Row row = row_of<2>(one, fmt::format("{} sides, 9 facets", corners), options, nullptr, slide.watch);
    row.quantities.at_most("spin times radius over speed", slide.largest_spin / slide.largest_speed);
    row.quantities.at_most("that over half a side", slide.largest_spin / slide.largest_speed * corners / pi, 1.0);
    row.quantities.at_most("H - H~", row.run->excess, 5e-2);
    sink(row);
}

}  // namespace
}  // namespace chute_part

void run_chute(const Options& options, const Sink& sink) {
    using namespace chute_part;
    for (const bool on_side : {true, false}) slide_straight(0.0, on_side, 0.8, options, sink);
    for (const double cfl : {0.8, 0.4, 0.2}) slide_straight(30.0, true, cfl, options, sink);
    slide_straight(30.0, false, 0.8, options, sink);
    for (const int corners : {24, 48, 96, 192})
        if (!options.quick || corners == 48) slide_around(corners, options, sink);
}

}  // namespace abut::studies::kinematics
