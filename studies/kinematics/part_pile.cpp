#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "studies/kinematics/rows.hpp"
#include "studies/kinematics/shapes.hpp"

namespace abut::studies::kinematics {
namespace pile_part {
namespace {

/// Convex polygons in a grid over a floor, within four walls, moving to all sides.
Case<2> polygons(const std::string& name, int columns, int rows, int cuts, Kinematics kinematics) {
    constexpr double pitch = 1.0, radius = 0.4, speed = 0.01;
    std::vector<mesh::Mesh<2>> meshes;
    std::vector<Motion<2>> motion;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const int i = row * columns + column;
            const double golden = 2.0 * std::numbers::pi * 0.6180339887 * i;
            meshes.push_back(polygon({.centre = {pitch * (column + 0.5), pitch * (row + 0.5)},
                                      .radius = radius,
                                      .corners = 5 + i % 4,
                                      .cuts = cuts,
                                      .turn = golden,
                                      .name = fmt::format("polygon {}", i)}));
            motion.push_back({.velocity = speed * Vector<2>(std::cos(golden), std::sin(golden)),
                              .spin = AxialVector<2>(0.02 * std::cos(3.0 * golden))});
        }
    Case<2> one = case_of<2>(name, meshes, kinematics);
    one.motion = motion;
    let_fall<2>(one, 1e-4);
    const double width = pitch * columns, height = pitch * (rows + 2);
    one.scene.solid.obstacles = {wall_along({{0.0, 0.0}, {width, 0.0}, {width, height}, {0.0, height}, {0.0, 0.0}})};
    one.run.filter = true;
    return one;
}

void run_mixed(int restart, const Options& options, const Sink& sink) {
    Case<2> one = polygons("pile", 11, 5, 3, Kinematics::rigid);
    for (std::size_t i = 5; i < one.motion.size(); i += 11) one.scene.solid.kinematics[i] = Kinematics::floating;
    one.run.steps = options.quick ? 2000 : options.steps;
    one.run.interval = std::max(1, one.run.steps / 1500);
    one.run.restart = restart;
    Row row = row_of<2>(one, restart > 0 ? fmt::format("filter, restart {}", restart) : "filter", options);
    row.quantities.at_most("H - H~", row.run->excess, 0.1);
    sink(row);
}

/// Seconds of computing per second of the scene.
double cost(Kinematics kinematics, int columns, const Options& options, const Sink& sink) {
    Case<2> one = polygons("cost", columns, columns, 4, kinematics);
    one.run.steps = options.quick ? 200 : 2000;
    one.run.interval = one.run.steps;
    Options without_frames = options;
    without_frames.frames = 0;
    const Row row = row_of<2>(one, fmt::format("{} {}", columns * columns, run::name_of(kinematics)), without_frames);
    sink(row);
    return row.run->seconds_of_steps / (row.run->dt * static_cast<double>(row.run->steps));
}

}  // namespace
}  // namespace pile_part

void run_pile(const Options& options, const Sink& sink) {
    using namespace pile_part;
    run_mixed(0, options, sink);
    run_mixed(50, options, sink);
    const int columns = options.quick ? 4 : 10;
    const double rigid = cost(Kinematics::rigid, columns, options, sink);
    const double elastic = cost(Kinematics::floating, columns, options, sink);
    Row row{.scene = "cost", .setting = "floating over rigid"};
    row.quantities.at_most("times as fast short of 20", std::max(0.0, 20.0 - elastic / rigid),
                           options.quick ? no_target : 0.0);
    row.quantities.at_most("computing time of elastic bodies over that of rigid ones", elastic / rigid);
    sink(row);
}

}  // namespace abut::studies::kinematics
