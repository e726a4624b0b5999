// An ideal gas in the plane on a fixed grid of squares, and solids that move through it: first order, HLLC.
//
// A solid is a closed polygon of walls. Over a step each wall sweeps a patch of space and time, which the grid cuts. The
// area vector (N_x, N_y, N_t) of all patches in a cell tells how much of its sides is open during the step, and its area
// after it: gas in a cell is closed in space and time, so that these are sums along rows and columns. Fluxes balance for
// any motion: mass, momentum and energy are exact, and a uniform flow stays uniform past a solid that flows with it. A cell
// of less than half a square, before a step or after it, mixes with its neighbour away from the wall, which keeps the long
// step. The pressure on a wall is that of the exact Riemann problem between the gas and a piston. L. Monasse et al., J.
// Comput. Phys. 231 (2012) 2977, have solids in a fixed grid with mixing of small cells; the sums in space and time are
// simpler than their swept areas.
//
// Solids may be several, and turn. One that breaks goes on as its parts, if these cover at first what it covered. They must
// be thicker than a square: gas in one square on both sides of a thin one mixes. Gas that is squeezed to nothing ends the
// run, as does a vacuum.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gas {

constexpr double ratio = 1.4;  // of specific heats

using Point = std::array<double, 2>;
using Content = std::array<double, 4>;  // mass, momentum along x and y, energy; as a flux per area and time

struct State {
    double rho, u, v, p;
    [[nodiscard]] double sound() const { return std::sqrt(ratio * p / rho); }
    [[nodiscard]] Content per_area() const {
        return {rho, rho * u, rho * v, p / (ratio - 1.0) + 0.5 * rho * (u * u + v * v)};
    }
};

inline State state_of(const Content& content, double area) {
    const double u = content[1] / content[0], v = content[2] / content[0];
    return {content[0] / area, u, v, (ratio - 1.0) * (content[3] - 0.5 * (content[1] * u + content[2] * v)) / area};
}

/// Pressure on a piston towards which gas flows with w, relative to it: a shock, or a fan for w < 0. Exact.
inline double wall_pressure(const State& gas, double w) {
    const double a = gas.sound(), b = 0.25 * (ratio + 1.0) * w;
    if (w > 0.0) return gas.p + gas.rho * w * (b + std::hypot(b, a));
    return gas.p * std::pow(std::max(0.0, 1.0 + 0.5 * (ratio - 1.0) * w / a), 2.0 * ratio / (ratio - 1.0));
}

/// Flux along x.
inline Content flux(const State& gas) {
    const Content q = gas.per_area();
    return {q[1], q[1] * gas.u + gas.p, q[2] * gas.u, (q[3] + gas.p) * gas.u};
}

/// Flux along x between two states: Toro's HLLC, with the speeds of Davis.
inline Content hllc(const State& left, const State& right) {
    const double s_left = std::min(left.u - left.sound(), right.u - right.sound());
    const double s_right = std::max(left.u + left.sound(), right.u + right.sound());
    if (s_left >= 0.0) return flux(left);
    if (s_right <= 0.0) return flux(right);
    const double m_left = left.rho * (s_left - left.u), m_right = right.rho * (s_right - right.u);
    const double s = (right.p - left.p + m_left * left.u - m_right * right.u) / (m_left - m_right);
    const State& side = s >= 0.0 ? left : right;
    const double s_side = s >= 0.0 ? s_left : s_right, m = s >= 0.0 ? m_left : m_right;
    const double rho = m / (s_side - s), energy = side.per_area()[3] / side.rho;
    const Content star{rho, rho * s, rho * side.v, rho * (energy + (s - side.u) * (s + side.p / m))};
    const Content q = side.per_area();
    Content result = flux(side);
    for (int k = 0; k < 4; ++k) result[k] += s_side * (star[k] - q[k]);
    return result;
}

/// Turns x into y, and back.
inline Content turned(const Content& q) { return {q[0], q[2], q[1], q[3]}; }
inline State turned(const State& gas) { return {gas.rho, gas.v, gas.u, gas.p}; }

/// A straight part of the boundary of a solid during one step. The solid lies to the left of the line from the first end to
/// the second, and all walls of a solid close. One that ends at the edge of the grid goes on beyond it.
struct Wall {
    std::array<Point, 2> before, after;  // its ends at both ends of the step [m]
    Point motion;                        // by which its pressure does work in the step [m]
};

// Patches of space and time ------------------------------------------------------------------------------------------

using Event = std::array<double, 3>;  // x, y, t
using Patch = std::vector<Event>;     // a plane convex polygon

/// The parts of a patch below and above a line of the grid.
inline std::pair<Patch, Patch> split(const Patch& patch, int axis, double line) {
    std::pair<Patch, Patch> parts;
    for (std::size_t k = 0; k < patch.size(); ++k) {
        const Event &here = patch[k], &next = patch[(k + 1) % patch.size()];
        const double d = here[axis] - line, d_next = next[axis] - line;
        if (d <= 0.0) parts.first.push_back(here);
        if (d >= 0.0) parts.second.push_back(here);
        if (d * d_next >= 0.0) continue;
        Event on_line;
        for (int i = 0; i < 3; ++i) on_line[i] = here[i] + d / (d - d_next) * (next[i] - here[i]);
        on_line[axis] = line;
        parts.first.push_back(on_line);
        parts.second.push_back(on_line);
    }
    return parts;
}

inline Event area_vector(const Patch& patch) {
    Event sum{};
    for (std::size_t k = 1; k + 1 < patch.size(); ++k) {
        Event a, b;
        for (int i = 0; i < 3; ++i) a[i] = patch[k][i] - patch[0][i], b[i] = patch[k + 1][i] - patch[0][i];
        for (int i = 0; i < 3; ++i) sum[i] += 0.5 * (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
    }
    return sum;
}

struct Grid {
    Point corner;  // the lowest [m]
    double size;   // of its squares [m]
    int columns, rows;
    [[nodiscard]] double line(int axis, int i) const { return corner[axis] + i * size; }  // before cells i
    [[nodiscard]] int cells() const { return columns * rows; }
    [[nodiscard]] Point centre(int cell) const {
        return {corner[0] + (cell % columns + 0.5) * size, corner[1] + (cell / columns + 0.5) * size};
    }
};

enum class Side { wall, open };  // open: nothing comes back

/// Cells in groups, each known by one of its cells.
class Groups {
public:
    explicit Groups(int cells) : next_(cells) { std::iota(next_.begin(), next_.end(), 0); }
    [[nodiscard]] int of(int cell) {
        while (next_[cell] != cell) cell = next_[cell] = next_[next_[cell]];
        return cell;
    }
    void join(int cell, int other) { next_[of(cell)] = of(other); }

private:
    std::vector<int> next_;
};

class Gas {
public:
    /// Starts with solids that rest at `after` of their walls, and gas in the state that `start` has at centres of cells.
    Gas(const Grid& grid, Side sides, const std::vector<Wall>& walls, const std::function<State(Point)>& start)
        : grid_(grid),
          sides_(sides),
          area_(grid.cells(), grid.size * grid.size),
          content_(grid.cells()),
          state_(grid.cells()) {
        cut(from_beyond(walls), 1.0);
        for (int cell = 0; cell < grid.cells(); ++cell) {
            area_[cell] -= inside(cell)[2];
            state_[cell] = start(grid.centre(cell));
            for (int k = 0; k < 4; ++k) content_[cell][k] = area_[cell] * state_[cell].per_area()[k];
        }
    }

    /// Longest stable step [s], with walls of at most this speed [m/s]. It matters where they withdraw faster than sound.
    [[nodiscard]] double stable_step(double wall_speed = 0.0) const {
        double fastest = wall_speed;
        for (int cell = 0; cell < grid_.cells(); ++cell) {
            const State& here = state_[cell];
            if (!is_empty(area_[cell]))
                fastest = std::max(fastest, std::max(std::abs(here.u), std::abs(here.v)) + here.sound());
        }
        return 0.3 * grid_.size / fastest;
    }

    /// Returns the impulse on each wall [N s/m]. Throws, and is of no use afterwards, where solids leave no room for gas
    /// between them, where they part and no gas reaches what they uncover, and where a density or pressure is not > 0: the
    /// step is too long, or a wall leaves a vacuum behind.
    std::vector<Point> step(double dt, const std::vector<Wall>& walls) {
        cut(walls, dt);
        Groups groups = mixing_groups();
        const std::vector<Part> before = parts(groups);
        fill(groups, before);
        add_fluxes();
        const std::vector<Point> impulse = push(walls, dt, groups, before);
        for (int cell = 0; cell < grid_.cells(); ++cell) area_[cell] -= inside(cell)[2];
        mix(groups, before);
        return impulse;
    }

    /// Content of the gas, with that which has left it through the sides of the grid: 0 mass, 1 and 2 momentum, 3 energy.
    [[nodiscard]] double sum(int k) const {
        double sum = left_[k];
        for (const Content& cell : content_) sum += cell[k];
        return sum;
    }
    [[nodiscard]] const Grid& grid() const { return grid_; }
    [[nodiscard]] const State& state(int cell) const { return state_[cell]; }
    [[nodiscard]] double area(int cell) const { return area_[cell]; }  // which the gas has of a cell [m^2]

private:
    struct Piece {
        std::size_t wall;
        int cell;
        Event area;
    };
    struct Part {
        double area = 0.0;
        Content content{};
    };
    static constexpr double tiny = 1e-12;
    [[nodiscard]] bool is_empty(double area) const { return area < tiny * grid_.size * grid_.size; }
    [[nodiscard]] Event& around(int i, int j) { return swept_[(j + 1) * (grid_.columns + 2) + i + 1]; }
    [[nodiscard]] const Event& inside(int cell) { return around(cell % grid_.columns, cell / grid_.columns); }
    // Sides, as far as they were open during the step [m s]: before cell i of row j along x, before cell j of column i
    // along y.
    [[nodiscard]] double& open_x(int i, int j) { return open_x_[j * (grid_.columns + 1) + i]; }
    [[nodiscard]] double& open_y(int i, int j) { return open_y_[j * grid_.columns + i]; }

    /// These solids, but coming from where there is no grid: what they sweep is what they cover.
    [[nodiscard]] std::vector<Wall> from_beyond(std::vector<Wall> walls) const {
        double lowest = grid_.corner[0];
        for (const Wall& wall : walls) lowest = std::min({lowest, wall.after[0][0], wall.after[1][0]});
        const double shift = grid_.corner[0] - lowest + (grid_.columns + 1) * grid_.size;
        for (Wall& wall : walls) {
            wall.before = wall.after;
            for (Point& end : wall.before) end[0] += shift;
        }
        return walls;
    }

    /// Area vectors of all patches by cells, out of the gas, and what they leave open.
    void cut(const std::vector<Wall>& walls, double dt) {
        swept_.assign(static_cast<std::size_t>(grid_.columns + 2) * (grid_.rows + 2), {});
        pieces_.clear();
        for (std::size_t wall = 0; wall < walls.size(); ++wall) {
            const auto& [before, after, motion] = walls[wall];
            const auto event = [](const Point& x, double t) { return Event{x[0], x[1], t}; };
            const Patch ring{event(before[0], 0.0), event(after[0], dt), event(after[1], dt), event(before[1], 0.0)};
            Event middle;  // four triangles, and not two: a mirrored wall is cut as its image
            for (int i = 0; i < 3; ++i) middle[i] = 0.25 * ((ring[0][i] + ring[2][i]) + (ring[1][i] + ring[3][i]));
            for (int k = 0; k < 4; ++k) cut(wall, {ring[k], ring[(k + 1) % 4], middle}, 0, {});
        }
        find_open_sides(dt);
    }

    /// Cuts along one axis after the other; what lies beyond the grid goes to its border.
    void cut(std::size_t wall, Patch patch, int axis, std::array<int, 2> index) {
        if (patch.size() < 3) return;
        if (axis == 2) return add(wall, area_vector(patch), index);
        const auto by_axis = [&](const Event& a, const Event& b) { return a[axis] < b[axis]; };
        const auto [low, high] = std::ranges::minmax_element(patch, by_axis);
        int& i = index[axis];
        i = index_of((*low)[axis], axis);
        if ((*low)[axis] == (*high)[axis]) {  // on a line it is in the cell that has its gas, not in both
            if (i >= 0 && (*low)[axis] == grid_.line(axis, i) && area_vector(patch)[axis] > 0.0) --i;
            return cut(wall, std::move(patch), axis + 1, index);
        }
        for (; i < cells_along(axis) && patch.size() >= 3; ++i) {
            auto [below, above] = split(patch, axis, grid_.line(axis, i + 1));
            cut(wall, std::move(below), axis + 1, index);
            patch = std::move(above);
        }
        cut(wall, std::move(patch), axis + 1, index);
    }
    void add(std::size_t wall, const Event& area, std::array<int, 2> index) {
        for (int i = 0; i < 3; ++i) around(index[0], index[1])[i] += area[i];
        if (index[0] >= 0 && index[0] < grid_.columns && index[1] >= 0 && index[1] < grid_.rows)
            pieces_.push_back({wall, index[1] * grid_.columns + index[0], area});
    }
    [[nodiscard]] int cells_along(int axis) const { return axis == 0 ? grid_.columns : grid_.rows; }

    /// Index of the cell with line(i) <= x < line(i + 1), as these are rounded; -1 before the first line, n from the last.
    [[nodiscard]] int index_of(double x, int axis) const {
        const int n = cells_along(axis);
        int i = static_cast<int>(std::clamp(std::floor((x - grid_.corner[axis]) / grid_.size), -1.0, double(n)));
        while (i >= 0 && x < grid_.line(axis, i)) --i;
        while (i < n && x >= grid_.line(axis, i + 1)) ++i;
        return i;
    }

    void find_open_sides(double dt) {
        const int columns = grid_.columns, rows = grid_.rows;
        const double all = grid_.size * dt;
        open_x_.assign(static_cast<std::size_t>(columns + 1) * rows, 0.0);
        open_y_.assign(static_cast<std::size_t>(columns) * (rows + 1), 0.0);
        const auto rounded = [&](double open) { return open > tiny * all ? open : 0.0; };
        for (int j = 0; j < rows; ++j) {
            double open = all;
            for (int i = 0; i <= columns; ++i) open_x(i, j) = rounded(open -= around(i - 1, j)[0]);
        }
        for (int i = 0; i < columns; ++i) {
            double open = all;
            for (int j = 0; j <= rows; ++j) open_y(i, j) = rounded(open -= around(i, j - 1)[1]);
        }
    }

    /// The four neighbours, -1 beyond the grid, and what is open towards them: before and after along x, then along y.
    [[nodiscard]] std::array<std::pair<int, double>, 4> neighbours(int cell) {
        const int columns = grid_.columns, i = cell % columns, j = cell / columns;
        return {{{i > 0 ? cell - 1 : -1, open_x(i, j)},
                 {i + 1 < columns ? cell + 1 : -1, open_x(i + 1, j)},
                 {j > 0 ? cell - columns : -1, open_y(i, j)},
                 {j + 1 < grid_.rows ? cell + columns : -1, open_y(i, j + 1)}}};
    }

    /// The neighbour that a small cell mixes with: away from its walls, or where most is open. -1: nothing is open.
    [[nodiscard]] int partner(int cell) {
        const auto sides = neighbours(cell);
        const Event& wall = inside(cell);
        const int axis = std::abs(wall[0]) >= std::abs(wall[1]) ? 0 : 1;
        const auto& away = sides[2 * axis + (wall[axis] > 0.0 ? 0 : 1)];
        if (wall[axis] != 0.0 && away.first >= 0 && away.second > 0.0) return away.first;
        return most_open(sides, [](int) { return true; });
    }
    /// The neighbour of those that are `wanted` towards which most is open, or -1.
    template <class Wanted>
    [[nodiscard]] static int most_open(const std::array<std::pair<int, double>, 4>& sides, const Wanted& wanted) {
        std::pair<int, double> best{-1, 0.0};
        for (const auto& side : sides)
            if (side.first >= 0 && side.second > best.second && wanted(side.first)) best = side;
        return best.first;
    }

    /// Cells that mix at the end of the step.
    [[nodiscard]] Groups mixing_groups() {
        Groups groups(grid_.cells());
        for (int cell = 0; cell < grid_.cells(); ++cell) {
            const double least = std::min(area_[cell], area_[cell] - inside(cell)[2]);
            if (least >= 0.5 * grid_.size * grid_.size) continue;
            if (const int other = partner(cell); other >= 0) groups.join(cell, other);
        }
        for (bool changed = true; changed;) changed = join_uncovered(groups);
        return groups;
    }
    /// Joins groups that have no gas before the step to where most is open, as in a gap between solids that part. Returns
    /// whether there was one.
    bool join_uncovered(Groups& groups) {
        bool changed = false;
        std::vector<double> area(grid_.cells(), 0.0);
        for (int cell = 0; cell < grid_.cells(); ++cell) area[groups.of(cell)] += area_[cell];
        for (int cell = 0; cell < grid_.cells(); ++cell) {
            const int group = groups.of(cell);
            if (!is_empty(area[group])) continue;
            const int other = most_open(neighbours(cell), [&](int next) { return groups.of(next) != group; });
            if (other < 0) continue;
            area[groups.of(other)] += area[group];
            groups.join(cell, other);
            changed = true;
        }
        return changed;
    }

    /// Area and content by groups.
    [[nodiscard]] std::vector<Part> parts(Groups& groups) const {
        std::vector<Part> parts(grid_.cells());
        for (int cell = 0; cell < grid_.cells(); ++cell) {
            Part& part = parts[groups.of(cell)];
            part.area += area_[cell];
            for (int k = 0; k < 4; ++k) part.content[k] += content_[cell][k];
        }
        return parts;
    }
    /// Gives cells that a solid uncovers in this step, and that have no gas yet, the state of their group, for the fluxes.
    void fill(Groups& groups, const std::vector<Part>& before) {
        for (int cell = 0; cell < grid_.cells(); ++cell) {
            const Part& part = before[groups.of(cell)];
            if (is_empty(area_[cell]) && !is_empty(part.area)) state_[cell] = state_of(part.content, part.area);
        }
    }
    /// Gives each cell the state of its group.
    void mix(Groups& groups, const std::vector<Part>& before) {
        const std::vector<Part> after = parts(groups);
        for (int cell = 0; cell < grid_.cells(); ++cell) {
            const int group = groups.of(cell);
            const auto& [area, content] = after[group];
            const bool had_gas = !is_empty(before[group].area), has_gas = !is_empty(area);
            if (had_gas && !has_gas)
                refuse(cell, "solids leave no room for the gas", "Take smaller cells, or end the run before they meet");
            if (!had_gas && has_gas)
                refuse(cell, "solids part, and no gas reaches what they uncover",
                       "Let gas in at the side, or keep them together");
            if (!has_gas) continue;
            state_[cell] = state_of(content, area);
            check(cell);
            for (int k = 0; k < 4; ++k) content_[cell][k] = area_[cell] / area * content[k];
        }
    }
    void check(int cell) const {
        const State& here = state_[cell];
        if (here.rho > 0.0 && here.p > 0.0) return;
        refuse(cell, "the density is " + text(here.rho) + " and the pressure " + text(here.p) + ", which must be > 0",
               "Take shorter steps, or walls that withdraw more slowly");
    }
    [[noreturn]] void refuse(int cell, const std::string& what, const std::string& remedy) const {
        const Point at = grid_.centre(cell);
        throw std::runtime_error("gas: " + what + " at (" + text(at[0]) + ", " + text(at[1]) + "). " + remedy + ".");
    }
    static std::string text(double value) {
        if (std::isnan(value)) return "not a number";
        std::array<char, 32> buffer{};
        std::snprintf(buffer.data(), buffer.size(), "%.3g", value);
        return buffer.data();
    }

    void add_fluxes() {
        for (int j = 0; j < grid_.rows; ++j)
            for (int i = 0; i <= grid_.columns; ++i) {
                const int after = j * grid_.columns + i;
                pass(i > 0 ? after - 1 : -1, i < grid_.columns ? after : -1, open_x(i, j), false);
            }
        for (int j = 0; j <= grid_.rows; ++j)
            for (int i = 0; i < grid_.columns; ++i) {
                const int after = j * grid_.columns + i;
                pass(j > 0 ? after - grid_.columns : -1, j < grid_.rows ? after : -1, open_y(i, j), true);
            }
    }
    /// Moves content from one cell to the next along x or y; -1 is beyond the grid.
    void pass(int before, int after, double open, bool along_y) {
        if (open == 0.0) return;
        const auto state = [&](int cell) { return along_y ? turned(state_[cell]) : state_[cell]; };
        Content flow = before < 0  ? through_side(state(after), -1.0)
                       : after < 0 ? through_side(state(before), 1.0)
                                   : hllc(state(before), state(after));
        if (along_y) flow = turned(flow);
        for (int k = 0; k < 4; ++k) {
            (before < 0 ? left_ : content_[before])[k] -= open * flow[k];
            (after < 0 ? left_ : content_[after])[k] += open * flow[k];
        }
    }
    [[nodiscard]] Content through_side(const State& inner, double outwards) const {
        return sides_ == Side::open ? flux(inner) : Content{0.0, wall_pressure(inner, outwards * inner.u), 0.0, 0.0};
    }

    /// Pressure of the gas on walls. In cells without gas there is none.
    [[nodiscard]] std::vector<Point> push(const std::vector<Wall>& walls, double dt, Groups& groups,
                                          const std::vector<Part>& before) {
        std::vector<Point> impulse(walls.size(), Point{});
        for (const auto& [wall, cell, area] : pieces_) {
            const double u = walls[wall].motion[0] / dt, v = walls[wall].motion[1] / dt;  // of the wall
            const double size = std::hypot(area[0], area[1]);
            if (size == 0.0 || is_empty(before[groups.of(cell)].area)) continue;
            const State& here = state_[cell];
            const double p = wall_pressure(here, ((here.u - u) * area[0] + (here.v - v) * area[1]) / size);
            const Point pushed{p * area[0], p * area[1]};
            for (int i = 0; i < 2; ++i) impulse[wall][i] += pushed[i], content_[cell][1 + i] -= pushed[i];
            content_[cell][3] -= pushed[0] * u + pushed[1] * v;
        }
        return impulse;
    }

    Grid grid_;
    Side sides_;
    std::vector<double> area_;      // which gas has of each cell [m^2]
    std::vector<Content> content_;  // of each cell
    std::vector<State> state_;
    Content left_{};  // through the sides of the grid
    // Of the step that goes on:
    std::vector<Event> swept_;  // by cells, with a border of one
    std::vector<Piece> pieces_;
    std::vector<double> open_x_, open_y_;  // [m s]
};

}  // namespace gas
