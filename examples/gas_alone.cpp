// The gas of blast_on_plate by itself: shock tube, pistons, uniform flow past a solid, mirrored scenes, and its errors.
//
// Sod's tube against the exact solution of the Riemann problem (the contact discontinuity has order 1/2, shocks have 1); a
// piston that starts at once with v = 0.5 a, and one that withdraws, whose pressures are those of a shock and of a fan; a
// solid that drifts with a uniform flow across the grid and leaves it uniform; a blast on a block that turns, and its image
// in a mirror; blocks whose sides lie on lines of the grid, in gas at rest; and what the gas must refuse by name: to be
// squeezed to nothing, and a vacuum. Mass, and energy less the work on walls, are kept to round-off.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <string>
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
            const double dt = std::min(gas.stable_step(std::hypot(velocity[0], velocity[1])), end - t);
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

/// A piston that moves at once with v, in a channel of 200 squares.
struct Piston {
    State rest{1.4, 0.0, 0.0, 1.0};  // a = 1
    Grid grid{{0.0, 0.0}, 1.0 / 200, 200, 8};
    Walk walk;
    Gas gas;
    double mass = gas.sum(0), energy = gas.sum(3);

    Piston(double front, double v)
        : walk{{{-1.0, -0.5}, {front, -0.5}, {front, 0.5}, {-1.0, 0.5}}, {v, 0.0}},
          gas(grid, Side::wall, moved(walk.polygon, {}), [this](Point) { return rest; }) {}

    /// Mean pressure in the latter half of the time up to `end`, over its exact value, less 1.
    double go(double end) {
        walk.go(gas, end);
        const double exact = middle_of({1.4, 2.0 * walk.velocity[0], 0.0, 1.0}, rest).p;  // two such gases meet
        return -walk.impulse / (walk.late * 8 * grid.size) / exact - 1.0;
    }
    [[nodiscard]] bool keeps_sums() const {
        const bool good = check("    mass, over all", gas.sum(0) / mass - 1.0, 1e-13);
        return check("    energy and work, over all", (gas.sum(3) + walk.work - energy) / energy, 1e-13) && good;
    }
};

bool slow_piston(const char* what, double v) {
    Piston piston(0.203, v);
    const bool good = check(what, piston.go(0.25), 0.01);
    return piston.keeps_sums() && good;
}

/// A piston so fast that cells are uncovered in one step; the exact pressure on it is 1/600 of that at rest.
bool fast_piston() {
    constexpr double start = 0.801, v = -3.0, end = 0.15;
    Piston piston(start, v);
    const Middle exact = middle_of({1.4, 2.0 * v, 0.0, 1.0}, piston.rest);
    const double pressure = (piston.go(end) + 1.0) * exact.p;
    double error = 0.0;
    for (int i = 0; i < piston.grid.columns; ++i) {
        const double known = right_wave(piston.rest, exact, (piston.grid.centre(i)[0] - start) / end).rho;
        error += piston.gas.area(i) / piston.grid.size * std::abs(piston.gas.state(i).rho - known);
    }
    bool good = check("piston at -3 a, error of the pressure over that at rest", pressure - exact.p, 0.004);
    good &= check("    of the density, mean", error, 0.01);
    return piston.keeps_sums() && good;
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

/// Largest change of gas at rest around a block with sides on lines of a grid.
double change_at_rest(const Grid& grid, int first, int last) {
    const State rest{1.4, 0.0, 0.0, 1.0};
    const double x = grid.line(0, first), x_end = grid.line(0, last), y = grid.line(1, first), y_end = grid.line(1, last);
    Walk walk{{{x, y}, {x_end, y}, {x_end, y_end}, {x, y_end}}, {}};
    Gas gas(grid, Side::wall, moved(walk.polygon, {}), [&](Point) { return rest; });
    walk.go(gas, 5.0 * grid.size);
    double off = 0.0;
    for (int cell = 0; cell < grid.cells(); ++cell) {
        const State& here = gas.state(cell);
        off = std::max({off, std::abs(here.rho - rest.rho), std::abs(here.u), std::abs(here.v), std::abs(here.p - rest.p)});
    }
    return off;
}

bool on_lines() {
    constexpr int n = 24, width = 3;
    double off = 0.0;
    for (const auto& [corner, size] : {std::pair{-0.5, 0.1}, {0.0, 0.05}, {0.3, 0.07}, {-0.78, 0.005}, {-1.0 / 3.0, 1e-3}})
        for (int first = 0; first + width <= n; ++first)
            off = std::max(off, change_at_rest({{corner, 2.0 * corner}, size, n, n}, first, first + width));
    return check("blocks with sides on lines, gas at rest: largest change", off, 1e-12);
}

template <class Run>
bool refuses(const char* what, const char* expected, const Run& run) {
    try {
        run();
    } catch (const std::runtime_error& error) {
        std::printf("  %s:\n    %s\n", what, error.what());
        return std::string(error.what()).find(expected) != std::string::npos;
    }
    std::printf("  %s: not refused\n", what);
    return false;
}

/// A block fills the last half of the only cell that has gas.
void squeeze() {
    const Grid grid{{0.0, 0.0}, 0.1, 10, 1};
    const std::vector<Point> block{{-1.0, -1.0}, {0.95, -1.0}, {0.95, 1.0}, {-1.0, 1.0}};
    Gas gas(grid, Side::wall, moved(block, {}), [](Point) { return State{1.4, 0.0, 0.0, 1.0}; });
    gas.step(0.01, moved(block, {0.1, 0.0}));
}

/// Two halves of a block, which part along a line of the grid: open, or beyond the grid at both ends.
struct Halves {
    std::vector<Point> left, right;
    Gas gas;
    double mass = gas.sum(0), energy = gas.sum(3), work = 0.0;

    Halves(double bottom, double top)
        : left{{0.6, bottom}, {1.0, bottom}, {1.0, top}, {0.6, top}},
          right{{1.0, bottom}, {1.4, bottom}, {1.4, top}, {1.0, top}},
          gas({{0.0, 0.0}, 0.1, 20, 10}, Side::wall, moved_by(0.0), [](Point) {
              return State{1.4, 0.0, 0.0, 1.0};
          }) {}

    [[nodiscard]] std::vector<Wall> moved_by(double d) const {
        std::vector<Wall> walls = moved(left, {-d, 0.0}), others = moved(right, {d, 0.0});
        walls.insert(walls.end(), others.begin(), others.end());
        return walls;
    }
    void step() {
        constexpr double speed = 0.5;
        const double dt = gas.stable_step(speed);
        const std::vector<Wall> walls = moved_by(speed * dt);
        const std::vector<Point> pushed = gas.step(dt, walls);
        for (std::size_t k = 0; k < walls.size(); ++k) work += pushed[k][0] * walls[k].motion[0] / dt;
        for (Point& x : left) x[0] -= speed * dt;
        for (Point& x : right) x[0] += speed * dt;
    }
};

bool halves_part() {
    Halves halves(0.3, 0.7);
    for (int k = 0; k < 20; ++k) halves.step();
    const bool good = check("halves of a block part along a line, mass", halves.gas.sum(0) / halves.mass - 1.0, 1e-13);
    return check("    energy and work", (halves.gas.sum(3) + halves.work - halves.energy) / halves.energy, 1e-13) && good;
}

bool refusals() {
    bool good = refuses("gas in one cell, squeezed to nothing", "no room", squeeze);
    good &= refuses("halves that part where no gas comes", "no gas reaches", [] { Halves(-1.0, 2.0).step(); });
    good &= refuses("piston at -15 a, which leaves a vacuum", "must be > 0", [] { Piston(0.803, -15.0).go(0.05); });
    return good;
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
    good &= slow_piston("piston at 0.5 a, pressure against that of a shock", 0.5);
    good &= slow_piston("piston at -0.5 a, pressure against that of a fan", -0.5);
    good &= fast_piston();
    good &= uniform_flow();
    good &= mirrored();
    good &= on_lines();
    good &= halves_part();
    good &= refusals();
    return good ? 0 : 1;
}
