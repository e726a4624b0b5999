// The gas of blast_on_plate by itself: shock tube, piston, uniform flow past a solid, mirrored scenes.
//
// Sod's tube against the exact solution of the Riemann problem (the contact discontinuity has order 1/2, shocks have 1); a
// piston that starts at once with v = 0.5 a, and one that withdraws, whose pressures are those of a shock and of a fan; a
// solid that drifts with a uniform flow across the grid and leaves it uniform; a blast on a block that turns, and its image
// in a mirror. Mass, and energy less the work on walls, are kept to round-off.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "cut_cell_gas.hpp"
#include "exact_gas.hpp"

namespace {

using namespace gas;

/// A closed polygon that turns by `angle` about its middle and moves by `motion` (of the middle). Its points are
/// counter-clockwise.
std::vector<Wall> moved(const std::vector<Point>& polygon, Point motion, double angle = 0.0) {
    Point middle{};
    for (const Point& x : polygon)
        for (int i = 0; i < 2; ++i) middle[i] += x[i] / static_cast<double>(polygon.size());
    const auto image = [&](const Point& x) {
        const double dx = x[0] - middle[0], dy = x[1] - middle[1], c = std::cos(angle), s = std::sin(angle);
        return Point{middle[0] + motion[0] + c * dx - s * dy, middle[1] + motion[1] + s * dx + c * dy};
    };
    std::vector<Wall> walls;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()], a_1 = image(a), b_1 = image(b);
        walls.push_back(
            {{a, b}, {a_1, b_1}, {0.5 * (a_1[0] + b_1[0] - a[0] - b[0]), 0.5 * (a_1[1] + b_1[1] - a[1] - b[1])}});
    }
    return walls;
}

std::vector<Point> corners(const std::vector<Wall>& walls) {
    std::vector<Point> points;
    for (const Wall& wall : walls) points.push_back(wall.after[0]);
    return points;
}

/// Steps a gas and one solid to `end`; `velocity` and `spin` are those of the solid.
struct Walk {
    std::vector<Point> polygon;
    Point velocity;
    double spin = 0.0;
    double impulse = 0.0, work = 0.0;  // of the gas on the solid: along x in the latter half of the time, and all

    void go(Gas& gas, double end) {
        for (double t = 0.0; t < end;) {
            const double dt = std::min(gas.stable_step(), end - t);
            const std::vector<Wall> walls = moved(polygon, {dt * velocity[0], dt * velocity[1]}, dt * spin);
            const std::vector<Point> pushed = gas.step(dt, walls);
            for (std::size_t k = 0; k < walls.size(); ++k) {
                work += (pushed[k][0] * walls[k].motion[0] + pushed[k][1] * walls[k].motion[1]) / dt;
                if (t >= 0.5 * end) impulse += pushed[k][0];
            }
            if (t < 0.5 * end) late = end - t - dt;
            polygon = corners(walls);
            t = end - t - dt <= 1e-12 * end ? end : t + dt;
        }
    }
    double late = 0.0;  // how long the latter half is
};

bool check(const char* what, double value, double limit) {
    std::printf("  %-58s %9.2e  (below %.0e)\n", what, value, limit);
    return std::isfinite(value) && std::abs(value) <= limit;
}

double sod_error(int n) {
    const State left{1.0, 0.0, 0.0, 1.0}, right{0.125, 0.0, 0.0, 0.1};
    const Grid grid{{-0.5, 0.0}, 1.0 / n, n, 3};
    Gas gas(grid, Side::wall, {}, [&](Point x) { return x[0] < 0.0 ? left : right; });
    Walk none;
    none.go(gas, 0.2);
    double error = 0.0;
    for (int i = 0; i < n; ++i)
        error += std::abs(gas.state(n + i).rho - riemann(left, right, grid.centre(n + i)[0] / 0.2).rho) / n;
    return error;
}

/// Mean pressure on a piston, which moves at once, over its exact value, less 1.
bool piston(const char* what, double v) {
    const State rest{1.4, 0.0, 0.0, 1.0};  // a = 1
    const Grid grid{{0.0, 0.0}, 1.0 / 200, 200, 8};
    Walk walk{{{-1.0, -0.5}, {0.203, -0.5}, {0.203, 0.5}, {-1.0, 0.5}}, {v, 0.0}};
    Gas gas(grid, Side::wall, moved(walk.polygon, {}), [&](Point) { return rest; });
    const double mass = gas.sum(0), energy = gas.sum(3);
    walk.go(gas, 0.25);
    const double exact = middle_of({1.4, 2.0 * v, 0.0, 1.0}, rest).p;  // of two such gases that meet: symmetric about v
    const double seen = -walk.impulse / (walk.late * 8 * grid.size);
    bool good = check(what, seen / exact - 1.0, 0.01);
    good &= check("    mass, over all", gas.sum(0) / mass - 1.0, 1e-13);
    return check("    energy and work, over all", (gas.sum(3) + walk.work - energy) / energy, 1e-13) && good;
}

bool uniform_flow() {
    const State flow{1.2, 0.37, -0.21, 1.0};
    const Grid grid{{0.0, 0.0}, 0.05, 40, 40};
    Walk walk{{{0.61, 1.03}, {0.93, 0.98}, {1.11, 1.21}, {0.87, 1.52}, {0.58, 1.37}}, {flow.u, flow.v}};
    Gas gas(grid, Side::open, moved(walk.polygon, {}), [&](Point) { return flow; });
    walk.go(gas, 1.0);  // over seven squares
    double off = 0.0;
    for (int cell = 0; cell < grid.cells(); ++cell) {
        if (gas.area(cell) < 1e-9 * grid.size * grid.size) continue;
        const State& here = gas.state(cell);
        off = std::max({off, std::abs(here.rho - flow.rho), std::abs(here.u - flow.u), std::abs(here.v - flow.v),
                        std::abs(here.p - flow.p)});
    }
    return check("a pentagon drifts with a uniform flow: largest change", off, 1e-12);
}

bool mirrored() {
    const Grid grid{{-1.0, -0.5}, 0.04, 50, 25};
    const auto run = [&](double side) {
        std::vector<Point> block{{0.31, -0.13}, {0.57, -0.11}, {0.55, 0.17}, {0.33, 0.19}};
        if (side < 0.0) {
            for (Point& x : block) x[0] = -x[0];
            std::ranges::reverse(block);
        }
        Walk walk{block, {0.1 * side, 0.05}, 0.5 * side};
        Gas gas(grid, Side::wall, moved(block, {}), [&](Point x) {
            const bool charge = std::hypot(x[0] + 0.4 * side, x[1] - 0.1) < 0.15;
            return charge ? State{5.0, 0.0, 0.0, 20.0} : State{1.0, 0.0, 0.0, 1.0};
        });
        walk.go(gas, 0.5);
        return std::pair{gas, walk.work};
    };
    const auto [right, work] = run(1.0);
    const auto [left, mirrored_work] = run(-1.0);
    double off = std::abs(work - mirrored_work) / std::abs(work);
    for (int cell = 0; cell < grid.cells(); ++cell) {
        const int image = cell / grid.columns * grid.columns + grid.columns - 1 - cell % grid.columns;
        if (right.area(cell) < 1e-9 * grid.size * grid.size) continue;
        off = std::max(
            {off, std::abs(right.state(cell).p - left.state(image).p), std::abs(right.state(cell).u + left.state(image).u)});
    }
    return check("a blast on a turning block and its mirror image", off, 1e-12);
}

}  // namespace

int main() {
    bool good = true;
    double before = 0.0;
    std::printf("Sod's tube, mean error of the density (1/8 to 1):\n");
    for (const int n : {100, 200, 400}) {
        const double error = sod_error(n);
        std::printf("  1/%-4d %.2e", n, error);
        if (before > 0.0) std::printf("  order %.2f", std::log2(before / error));
        std::printf("\n");
        good = good && (before == 0.0 || std::log2(before / error) > 0.5);
        before = error;
    }
    good &= before < 0.008;
    std::printf("Others:\n");
    good &= piston("piston at 0.5 a, pressure against that of a shock", 0.5);
    good &= piston("piston at -0.5 a, pressure against that of a fan", -0.5);
    good &= uniform_flow();
    good &= mirrored();
    return good ? 0 : 1;
}
