#include <fmt/format.h>

#include <cmath>

#include "abut/mesh/shapes/shapes.hpp"
#include "studies/nodal/rows.hpp"
#include "studies/nodal/scenes.hpp"
#include "studies/nodal/shapes.hpp"

/// How far the advised step can be exceeded before a run is lost.
namespace abut::studies::turning {
namespace {

/// Two boxes, one above the other, which run into each other.
template <int Dim>
struct Pair {
    std::string name;
    std::array<int, 2> cells{6, 5};
    std::array<double, 2> young{1.0, 1.0};
    std::array<double, 2> density{1.0, 1.0};
    double tilt = 0.0;  ///< of the upper one [rad]
};

template <int Dim>
Case<Dim> two_boxes(const Pair<Dim>& pair) {
    std::vector<mesh::Mesh<Dim>> meshes;
    for (std::size_t body = 0; body < 2; ++body) {
        TurnedBox<Dim> box{.name = body == 0 ? "lower" : "upper"};
        box.cells.fill(pair.cells[body]);
        box.centre[Dim - 1] = body == 0 ? -0.5 : 0.52 + 0.5 * std::abs(pair.tilt);
        if (body == 1) box.centre[0] = pair.tilt == 0.0 && pair.cells[0] == pair.cells[1] ? 0.0 : 0.07;
        if constexpr (Dim == 2) box.turn = rotation(pair.tilt);
        meshes.push_back(turned_box<Dim>(box));
    }
    auto one = case_of<Dim>(pair.name, meshes, Kinematics::finite);
    for (std::size_t body = 0; body < 2; ++body)
        one.scene.solid.materials[body] = {.young = pair.young[body], .density = pair.density[body]};
    const double speed =
        0.03 * std::sqrt(std::min(pair.young[0], pair.young[1]) / std::max(pair.density[0], pair.density[1]));
    one.motion[0].velocity = speed * Vector<Dim>::Unit(Dim - 1);
    one.motion[1].velocity = -speed * Vector<Dim>::Unit(Dim - 1);
    one.scene.time = (Dim == 2 ? 60.0 : 20.0) * (0.03 / speed);
    return one;
}

/// Runs it at the advised step, then at longer and longer ones until it is lost.
template <int Dim>
void sweep(const Case<Dim>& impact, const Options& options, const Sink& sink) {
    constexpr int records = 300;
    run::RunOptions run = options.run;
    run.frames = 0;
    run.cfl = 1.0;
    Row row = row_of<Dim>(impact, run, "advised step", options, nullptr, {}, records);
    row.quantities.at_most("lost at the advised step", held(*row.run) ? 0.0 : 1.0, 0.0);
    double lost_at = std::numeric_limits<double>::infinity();
    Case<Dim> longer = impact;
    longer.run = run;
    for (double factor = 1.2; factor < 2.3 && std::isinf(lost_at); factor += 0.1) {
        longer.run.cfl = factor;
        const Figures figures = nodal::run_case<Dim>(longer, {}, {}, records).figures;
        row.seconds += figures.seconds;
        if (held(figures)) continue;
        lost_at = factor;
        row.remark = fmt::format(
            "at {:.2g} times the advised step: {}", factor,
            figures.ending.empty() ? fmt::format("H - H~ is {:.2g} of the largest energy", figures.excess) : figures.ending);
    }
    row.quantities.at_most("lost at this part of the advised step", lost_at);
    sink(row);
}

}  // namespace

void sweep_steps(const Options& options, const Sink& sink) {
    std::vector<Pair<2>> plane{{.name = "blocks, not matching"},
                               {.name = "blocks, matching", .cells = {6, 6}},
                               {.name = "blocks, corner first", .tilt = 0.6}};
    if (!options.quick) {
        plane.push_back({.name = "cells 1:3", .cells = {4, 12}});
        plane.push_back({.name = "stiffness 1:100", .young = {100.0, 1.0}});
        plane.push_back({.name = "stiffness 100:1", .young = {1.0, 100.0}, .tilt = 0.6});
        plane.push_back({.name = "density 1:100", .density = {100.0, 1.0}});
        plane.push_back({.name = "density 100:1", .density = {1.0, 100.0}, .tilt = 0.6});
    }
    for (const Pair<2>& pair : plane) sweep<2>(two_boxes(pair), options, sink);
    sweep<2>(tumbling_block(options.quick ? 2 : 4), options, sink);
    if (options.quick) return;
    sweep<3>(two_boxes<3>({.name = "3D blocks", .cells = {4, 3}}), options, sink);
    sweep<3>(two_boxes<3>({.name = "3D blocks, matching", .cells = {3, 3}}), options, sink);
    sweep<3>(two_boxes<3>({.name = "3D cells 1:3", .cells = {2, 6}}), options, sink);
    sweep<3>(spinning_cubes(3), options, sink);
    sweep<3>(cube_on_corner(3), options, sink);
}

}  // namespace abut::studies::turning
