#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/mesh/cell_shape.hpp"
#include "studies/extremes/families.hpp"
#include "studies/extremes/scenes.hpp"

namespace abut::studies::extremes {
namespace {

using mesh::CellShape;

const std::array plane_shapes = {CellShape::quadrangle, CellShape::triangle};
const std::array solid_shapes = {CellShape::hexahedron, CellShape::tetrahedron};

constexpr int steps_of_thin_cells = 2000;

/// A corner that comes down on a flat side is not pushed along it.
std::string ask_of_corner(const run::RunResult<2>& result, double speed) {
    double aside = 0.0;
    for (const auto& body : result.bodies.end) aside = std::fmax(aside, std::abs(body.velocity.x()) / speed);
    if (aside <= largest_speed_aside) return "";
    return fmt::format("speed aside {:.2g} v, {:g} is allowed", aside, largest_speed_aside);
}

}  // namespace

/// Cells are 1/6 wide at most; the thin way is 1/6 over the aspect. The gap closes within a few steps.
void sweep_aspect(const SweepOptions& options, const Sink& sink) {
    const std::vector<double> aspects = options.quick ? std::vector{1.0, 1e4} : std::vector{1.0, 10.0, 1e2, 1e3, 1e4};
    run::RunOptions run = options.run;
    run.steps = steps_of_thin_cells;
    for (const CellShape shape : plane_shapes)
        for (const double aspect : aspects)
            for (const int thin : {0, 1}) {
                Vector<2> sides = Vector<2>::Ones();
                sides[thin] /= aspect;
                const Meeting<2> meeting{.gap = 0.02 / aspect, .aside = 0.3};
                const auto value =
                    fmt::format("{} {:g} {}", mesh::name(shape), aspect, thin == 0 ? "along the normal" : "across it");
                const std::array<Block<2>, 2> pair{{{sides, {6, 6}, shape}, {sides, {5, 5}, shape}}};
                sink(attempt(meeting_of_blocks<2>("aspect", value, meeting, pair, run)));
                if (thin == 1) continue;
                run::RunOptions filtered = run;
                filtered.filter = true;
                sink(attempt(meeting_of_blocks<2>("aspect", value + ", filter", meeting, pair, filtered)));
            }
    for (const CellShape shape : solid_shapes)
        for (const double aspect : aspects) {
            if (aspect != aspects.front() && aspect != aspects.back()) continue;
            const Vector<3> sides(1.0, 1.0, 1.0 / aspect);
            const Meeting<3> meeting{.gap = 0.02 / aspect, .aside = 0.3};
            run::RunOptions few = run;
            few.steps = 300;
            const std::array<Block<3>, 2> pair{{{sides, {3, 3, 3}, shape}, {sides, {2, 2, 2}, shape}}};
            const auto value = fmt::format("{} {:g} across the normal", mesh::name(shape), aspect);
            sink(attempt(meeting_of_blocks<3>("aspect", value, meeting, pair, few)));
        }
}

/// Three cells below; above cells of 1/(3 ratio), as many as cover one and a bit of them.
void sweep_refinement(const SweepOptions& options, const Sink& sink) {
    for (const int ratio : options.quick ? std::vector{1, 100} : std::vector{1, 3, 10, 30, 100})
        for (const CellShape shape : plane_shapes) {
            const double fine = 1.0 / (3.0 * ratio);
            const int along = ratio + ratio / 3 + 1, across = 4;
            const Block<2> coarse{.sides = {1.0, 1.0}, .cells = {3, 3}, .shape = shape};
            const Block<2> upper{.sides = {along * fine, across * fine}, .cells = {along, across}, .shape = shape};
            const Meeting<2> meeting{.gap = 0.02 / ratio, .slide = 0.02};
            run::RunOptions run = options.run;
            run.steps = steps_of_thin_cells;
            sink(attempt(meeting_of_blocks<2>("refinement", fmt::format("{} 1:{}", mesh::name(shape), ratio), meeting,
                                              {coarse, upper}, run)));
        }
}

void sweep_thickness(const SweepOptions& options, const Sink& sink) {
    for (const int cells : {1, 2, 4}) {
        const Meeting<2> meeting{.gap = 0.01, .time = 6.0};
        for (const CellShape shape : plane_shapes) {
            const Block<2> plate{.sides = {1.0, 0.1 * cells}, .cells = {10, cells}, .shape = shape};
            const Block<2> block{.sides = {0.5, 0.5}, .cells = {6, 6}, .shape = shape};
            sink(attempt(meeting_of_blocks<2>("thickness", fmt::format("2D {} {}", mesh::name(shape), cells), meeting,
                                              {plate, block}, options.run)));
        }
        const Meeting<3> in_space{.gap = 0.01, .time = 2.0};
        for (const CellShape shape : solid_shapes) {
            const Block<3> plate{.sides = {1.0, 1.0, 0.25 * cells}, .cells = {4, 4, cells}, .shape = shape};
            const Block<3> block{.sides = {0.5, 0.5, 0.5}, .cells = {3, 3, 3}, .shape = shape};
            sink(attempt(meeting_of_blocks<3>("thickness", fmt::format("3D {} {}", mesh::name(shape), cells), in_space,
                                              {plate, block}, options.run)));
        }
    }
}

/// A tip below 23 degrees looks at a flat face with no face of its own by the default facing cosine: -0.02 lets it.
void sweep_wedge(const SweepOptions& options, const Sink& sink) {
    for (const double degrees : {120.0, 90.0, 60.0, 20.0, 5.0})
        for (const double facing : {options.run.contact.search.facing_cosine, -0.02})
            for (const bool on_plane : {true, false}) {
                const Meeting<2> meeting{.aside = 0.03, .time = 6.0};
                run::RunOptions run = options.run;
                run.contact.search.facing_cosine = facing;
                sink(attempt<2>(
                    {.family = "wedge",
                     .value = fmt::format("{:g} degrees on a {}, {:g}", degrees, on_plane ? "plane" : "block", facing),
                     .speed = meeting.speed,
                     .keeps_momentum = !on_plane,
                     .make = [=] { return wedge(meeting, degrees * std::numbers::pi / 180.0, on_plane); },
                     .run = run}));
            }
}

/// The corner meets a face of the block off its middle, so that the two sides do not mirror each other.
void sweep_corner(const SweepOptions& options, const Sink& sink) {
    for (const int cells : {20, 40})
        for (const double speed : {0.02, 0.005, 0.001}) {
            if (options.quick && cells > 20) continue;
            // Gaps are read at the middle of faces: the corner is in contact when that of its faces has come down.
            const double depth = 0.25 * std::numbers::sqrt2 / cells;
            const Meeting<2> meeting{.speed = speed, .gap = 0.2 * speed, .aside = 0.3 / cells, .time = 8.0 + depth / speed};
            Row row = attempt<2>({.family = "corner",
                                  .value = fmt::format("{} cells, v = {:g} c", cells, speed),
                                  .speed = speed,
                                  .make = [=] { return square_on_corner(meeting, cells); },
                                  .run = options.run,
                                  .ask_more = [=](const auto& result, Row&) { return ask_of_corner(result, speed); }});
            if (row.verdict == Verdict::held)
                row.message = fmt::format("it leaves with {:+.2g} v aside and {:.2g} v up", row.numbers[2].value,
                                          row.numbers[3].value);
            sink(row);
        }
}

void sweep_crossing(const SweepOptions& options, const Sink& sink) {
    for (const double degrees : {60.0, 70.0, 80.0, 88.0, 90.0, 100.0}) {
        if (options.quick && degrees > 60.0 && degrees < 88.0) continue;
        const Meeting<3> meeting{.gap = 0.02, .aside = 0.03};
        sink(attempt<3>({.family = "crossing",
                         .value = fmt::format("edges of {:g} degrees", degrees),
                         .speed = meeting.speed,
                         .make = [=] { return crossing_beams(meeting, degrees * std::numbers::pi / 180.0); },
                         .run = options.run}));
    }
}

void sweep_edge(const SweepOptions& options, const Sink& sink) {
    for (const double slide : {0.02, 0.1, 0.3}) {
        const Meeting<2> meeting{.gap = 0.005, .aside = 0.8, .slide = slide};
        const std::array<Block<2>, 2> pair{{{.cells = {7, 7}}, {.cells = {5, 5}}}};
        sink(attempt(
            meeting_of_blocks<2>("edge", fmt::format("2D off the edge, {:g} c", slide), meeting, pair, options.run)));
        Meeting<3> in_space{.gap = 0.005, .aside = 0.6, .slide = slide, .time = 4.0};
        const std::array<Block<3>, 2> boxes{{{.cells = {3, 3, 3}}, {.cells = {2, 2, 2}}}};
        sink(attempt(
            meeting_of_blocks<3>("edge", fmt::format("3D off the corner, {:g} c", slide), in_space, boxes, options.run)));
    }
}

}  // namespace abut::studies::extremes
