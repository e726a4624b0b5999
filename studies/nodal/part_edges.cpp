#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/mesh/shapes/shapes.hpp"
#include "studies/nodal/rows.hpp"
#include "studies/nodal/shapes.hpp"

/// Corners and edges: a square that comes down on its corner, beams that cross on their edges. The bodies of `extremes`, of
/// triangles and tetrahedra.
namespace abut::studies::turning {
namespace {

constexpr double side_push_allowed = 0.05;  // over the speed, as in `extremes`

/// A corner 0.2 v above the middle of a block at rest, 0.3 faces aside of one of its nodes.
Case<2> square_on_corner(int cells, double speed) {
    const double aside = 0.3 / cells, gap = 0.2 * speed, half_diagonal = std::numbers::sqrt2 / 2.0;
    const auto block =
        turned_box<2>({.centre = {0.0, -0.5}, .sides = {2.0, 1.0}, .cells = {2 * cells, cells}, .name = "block"});
    const auto square = turned_box<2>({.centre = {aside, gap + half_diagonal},
                                       .cells = {cells, cells},
                                       .turn = rotation(std::numbers::pi / 4.0),
                                       .name = "square"});
    auto impact = case_of<2>("square on its corner", {block, square}, Kinematics::finite);
    impact.scene.time = 10.0;
    impact.motion[1].velocity = {0.0, -speed};
    return impact;
}

/// How deep the lowest node of the square is below the top of the block, which is straight between its nodes [m].
double depth_of_corner(const dynamics::RunView<2>& run, const P1Bodies<2>& bodies) {
    const auto u = as_vectors<2>(run.q);
    const auto rest = bodies.rest_positions();
    Vector<2> corner(0.0, 1e9), left(-1e9, 0.0), right(1e9, 0.0);
    for (std::size_t i = 0; i < u.size(); ++i)
        if (const Vector<2> x = rest[i] + u[i]; bodies.body_of_points()[i] == 1 && x.y() < corner.y()) corner = x;
    for (std::size_t i = 0; i < u.size(); ++i) {
        if (bodies.body_of_points()[i] != 0 || rest[i].y() < -1e-9) continue;
        const Vector<2> x = rest[i] + u[i];
        if (x.x() <= corner.x() && x.x() > left.x()) left = x;
        if (x.x() > corner.x() && x.x() < right.x()) right = x;
    }
    const double share = (corner.x() - left.x()) / (right.x() - left.x());
    return left.y() + share * (right.y() - left.y()) - corner.y();
}

void land(int cells, double speed, const Options& options, const Sink& sink) {
    const Case<2> impact = square_on_corner(cells, speed);
    double depth = 0.0;
    const Watch<2> watch = [&](const auto& run, const auto& bodies) {
        depth = std::max(depth, depth_of_corner(run, bodies));
    };
    CaseResult<2> result;
    Row row = row_of<2>(impact, options.run, fmt::format("{} cells, v = {:g}", cells, speed), options, &result, watch);
    row.quantities.at_most("pushed aside, over v", std::abs(result.velocity[1].x()) / speed, side_push_allowed);
    row.quantities.at_most("sinks in, over the size of a cell", depth * cells);
    row.quantities.at_most("leaves upwards, over v", result.velocity[1].y() / speed);
    sink(row);
}

/// `facing`: the contact's own by default.
void cross_beams(double degrees, const geometry::FacingFade& facing, const Options& options, const Sink& sink) {
    const double angle = degrees * std::numbers::pi / 180.0, speed = 0.05;
    const auto shape = mesh::CellShape::tetrahedron;
    auto impact = case_of<3>("crossing beams",
                             {beam(Vector<3>::UnitX(), Vector<3>::Zero(), angle, false, shape),
                              beam(Vector<3>::UnitY(), Vector<3>(0.03, 0.0, 0.02), angle, true, shape)},
                             Kinematics::finite);
    impact.scene.time = 12.0;
    run::RunOptions run = options.run;
    run.facing = facing;
    impact.motion[0].velocity = {0.0, 0.0, speed};
    impact.motion[1].velocity = {0.0, 0.0, -speed};
    CaseResult<3> result;
    const std::string setting = fmt::format("edges of {:g} degrees, fade {:g} to {:g}", degrees, facing.full, facing.none);
    Row row = row_of<3>(impact, run, setting, options, &result);
    const double apart = (result.velocity[1].z() - result.velocity[0].z()) / (2.0 * speed);
    row.quantities.at_most("speed apart over that of approach: rebounds where > 0", apart);
    row.quantities.at_most("does not rebound", apart > 0.0 ? 0.0 : 1.0, 0.0);
    sink(row);
}

}  // namespace

void run_edges(const Options& options, const Sink& sink) {
    for (const int cells : options.quick ? std::vector{8} : std::vector{20, 40})
        for (const double speed : {0.02, 0.005, 0.001})
            if (!options.quick || speed == 0.005) land(cells, speed, options, sink);
    for (const double degrees : {20.0, 30.0, 45.0, 60.0, 70.0, 80.0, 88.0, 90.0, 100.0})
        if (!options.quick || degrees == 100.0) cross_beams(degrees, {}, options, sink);
    for (const double degrees : {45.0, 60.0, 70.0, 90.0})
        if (!options.quick) cross_beams(degrees, {.full = -0.25, .none = -0.05}, options, sink);
}

}  // namespace abut::studies::turning
