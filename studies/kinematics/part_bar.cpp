#include <algorithm>
#include <cmath>

#include "abut/solid/cell_view.hpp"
#include "studies/kinematics/rows.hpp"
#include "studies/kinematics/shapes.hpp"

namespace abut::studies::kinematics {
namespace bar_part {
namespace {

constexpr double length = 1.0, height = 0.1, radians = 5.0;

/// Mean position of the cells of the bar beyond x = `from` at rest.
Vector<2> end_of(const dynamics::RunView<2>& run, const solid::Solid<2>& solid, bool right, double from) {
    const auto u = solid.cells().displacement(run.q);
    Vector<2> sum = Vector<2>::Zero();
    double measure = 0.0;
    for (std::int32_t c = 0; c < solid.mesh().n_cells(); ++c) {
        const Vector<2>& x = solid.mesh().cell_centroid[c];
        if (solid.mesh().cell_body[c] != 0 || (right ? x.x() < from : x.x() > -from)) continue;
        sum += solid.mesh().cell_measure[c] * (x + u[static_cast<std::size_t>(c)]);
        measure += solid.mesh().cell_measure[c];
    }
    return sum / measure;
}

void strike(Kinematics kinematics, const Options& options, const Sink& sink) {
    const int across = options.quick ? 2 : 4;
    const double side = 0.1, arm = 0.44, gap = 0.002, speed = options.quick ? 0.05 : 0.02;
    const auto bar = turned_box<2>({.sides = {length, height}, .cells = {10 * across, across}, .name = "bar"});
    const auto hammer = turned_box<2>({.centre = {arm, -0.5 * (height + side) - gap},
                                       .sides = {side, side},
                                       .cells = {across + 1, across + 1},
                                       .name = "hammer"});
    Case<2> one = case_of<2>("bar", {bar, hammer}, kinematics);
    one.motion[1].velocity = {0.0, speed};
    one.run.filter = true;
    // An impulse between free rigid bodies, rebounding with their energy.
    const double mass = length * height, inertia = mass * (length * length + height * height) / 12.0;
    const double impulse = 2.0 * speed / (1.0 / (side * side) + 1.0 / mass + arm * arm / inertia);
    const double spin = arm * impulse / inertia;
    one.scene.time = (kinematics == Kinematics::rigid ? 1.1 : 1.7) * radians / spin;
    // A hammer that bends leaves a part of its energy in vibrations, and turns the bar more slowly.
    const double from = 0.5 * length * (1.0 - 0.5 / across);
    double rest = 0.0, longest = 0.0, turned = 0.0, before = 0.0, at_end = 0.0;
    const Watch<2> watch = [&](const auto& run, const auto& solid) {
        const Vector<2> along = end_of(run, solid, true, from) - end_of(run, solid, false, from);
        if (run.steps == 0) rest = along.norm();
        const double angle = std::atan2(along.y(), along.x());
        turned += std::remainder(angle - before, 2.0 * std::acos(-1.0));
        before = angle;
        if (turned > radians) return;
        at_end = along.norm() / rest;
        longest = std::max(longest, std::abs(at_end - 1.0));
    };
    Row row = row_of<2>(one, run::name_of(kinematics), options, nullptr, watch);
    const bool grows = kinematics == Kinematics::small;
    // A point that flies straight on turns by less than a right angle.
    row.quantities.near("turns by [rad]", std::min(turned, radians), radians, grows ? no_target : 1e-12);
    row.quantities.near("length then, over that at rest", at_end, 1.0, grows ? no_target : 1e-3);
    row.quantities.at_most("largest change of it on the way", longest, grows ? no_target : 0.02);
    sink(row);
}

}  // namespace
}  // namespace bar_part

void run_bar(const Options& options, const Sink& sink) {
    using namespace bar_part;
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating, Kinematics::rigid})
        strike(kinematics, options, sink);
}

}  // namespace abut::studies::kinematics
