// W and the normal force of pairs against rational numbers. The faces are mirror images of each other's slope, so that n is
// e_3 and all of W but its weight is rational.
#include <CGAL/Gmpq.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "abut/geometry/pair_potential/lanes/lane_task.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"
#include "geometry/random_pairs.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::geometry;
using namespace abut::test;

namespace {

using Number = CGAL::Gmpq;
struct ExactPoint {
    Number x, y;
};

Number cross(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The part of a polygon in which a linear function, given by its values, is positive.
std::vector<ExactPoint> cut(const std::vector<ExactPoint>& polygon, const std::vector<Number>& value) {
    std::vector<ExactPoint> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t next = (i + 1) % polygon.size();
        if (value[i] > 0) kept.push_back(polygon[i]);
        if ((value[i] > 0) == (value[next] > 0)) continue;
        const Number at = value[i] / (value[i] - value[next]);
        kept.push_back(
            {polygon[i].x + at * (polygon[next].x - polygon[i].x), polygon[i].y + at * (polygon[next].y - polygon[i].y)});
    }
    return kept;
}

/// Two triangles in the plane, counter-clockwise, and the heights slope . p + height of the first and -slope . p + height of
/// the second. All products must be exact in double.
struct TiltedPair {
    std::array<Vector<2>, 3> first, second;
    Vector<2> slope;
    double height_1, height_2;

    [[nodiscard]] PairCorners<3> corners() const {
        PairCorners<3> x;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector<2>&p = first[i], &q = second[(3 - i) % 3];
            x[i] = {p[0], p[1], slope.dot(p) + height_1};
            x[3 + i] = {q[0], q[1], height_2 - slope.dot(q)};
        }
        return x;
    }
    [[nodiscard]] double size() const {
        double largest = 0.0;
        for (const auto* triangle : {&first, &second})
            for (std::size_t i = 0; i < 3; ++i) raise(largest, ((*triangle)[(i + 1) % 3] - (*triangle)[i]).norm());
        return largest;
    }
};

/// Integrals of |g| and g^2 over the part of the overlap where g < 0.
struct ExactIntegrals {
    explicit ExactIntegrals(const TiltedPair& pair) {
        std::vector<ExactPoint> polygon;
        for (const Vector<2>& p : pair.first) polygon.push_back({Number(p[0]), Number(p[1])});
        for (std::size_t line = 0; line < 3; ++line) {
            const Vector<2>&a = pair.second[line], &b = pair.second[(line + 1) % 3];
            std::vector<Number> inside;
            for (const ExactPoint& p : polygon)
                inside.push_back(cross({Number(a[0]), Number(a[1])}, {Number(b[0]), Number(b[1])}, p));
            polygon = cut(polygon, inside);
        }
        const auto depth = [&](const ExactPoint& p) -> Number {
            return Number(pair.height_1) - Number(pair.height_2) +
                   2 * (Number(pair.slope[0]) * p.x + Number(pair.slope[1]) * p.y);
        };
        std::vector<Number> depths;
        for (const ExactPoint& p : polygon) depths.push_back(depth(p));
        polygon = cut(polygon, depths);
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
            const Number of = cross(polygon[0], polygon[i], polygon[i + 1]) / 2;
            const Number a = depth(polygon[0]), b = depth(polygon[i]), c = depth(polygon[i + 1]), sum = a + b + c;
            area += CGAL::to_double(of);
            first += CGAL::to_double(Number(of * sum / 3));
            second += CGAL::to_double(Number(of * (sum * sum + a * a + b * b + c * c) / 12));
            for (const Number& d : {a, b, c}) raise(deepest, CGAL::to_double(d));
        }
    }
    double area = 0.0, first = 0.0, second = 0.0, deepest = 0.0;
};

enum class Kind { free, on_a_line, nearly_on_a_line, at_a_corner, nearly_alike, sliver, gap_on_edge };

/// Points of a grid, so that products of theirs are exact in double; and steps of next to nothing between them.
Vector<2> grid_point(std::mt19937& random, double size = 1.0) {
    const auto any = [&] { return std::round(4096.0 * uniform(random, -size, size)) / 4096.0; };
    return {any(), any()};
}
Vector<2> hair(std::mt19937& random) {
    const double size = std::ldexp(1.0, -static_cast<int>(uniform(random, 20.0, 46.0)));
    return size * Vector<2>(std::round(uniform(random, -2.0, 2.0)), std::round(uniform(random, -2.0, 2.0)));
}

bool is_usable(const std::array<Vector<2>, 3>& t) {
    const Vector<2> u = t[1] - t[0], w = t[2] - t[0];
    return u[0] * w[1] - u[1] * w[0] > 0.0;
}

TiltedPair pair_of(Kind kind, int i, std::mt19937& random) {
    const auto triangle = [&] {
        std::array<Vector<2>, 3> t;
        do t = {grid_point(random), grid_point(random), grid_point(random)};
        while (!is_usable(t) || (t[1] - t[0]).norm() < 0.1);
        return t;
    };
    TiltedPair pair{triangle(), triangle(), {}, 0.0, 0.0};
    const auto sixteenth = [&](double size) { return std::round(16.0 * uniform(random, -size, size)) / 16.0; };
    pair.slope = {sixteenth(0.4), sixteenth(0.4)};
    pair.height_2 = sixteenth(0.5);
    auto& [a, b, c] = pair.first;
    auto& second = pair.second;
    const Vector<2> along = b - a;
    const bool same_side = uniform(random, 0.0, 1.0) < 0.7;
    const auto on_line = [start = a, along](double at) { return Vector<2>(start + std::round(16.0 * at) / 16.0 * along); };
    const auto put_on_line = [&] {
        const double low = uniform(random, -0.5, 0.5), high = uniform(random, 0.6, 1.4);
        second[0] = same_side ? on_line(low) : on_line(high);
        second[1] = same_side ? on_line(high) : on_line(low);
        do second[2] = grid_point(random);
        while (!is_usable(second));
    };
    switch (kind) {
        case Kind::free:
            break;
        case Kind::on_a_line:
            put_on_line();
            break;
        case Kind::nearly_on_a_line:
            put_on_line();
            second[1] += hair(random);
            if (uniform(random, 0.0, 1.0) < 0.5) second[0] += hair(random);
            break;
        case Kind::at_a_corner:
            put_on_line();
            second[same_side ? 0 : 1] = a;
            second[same_side ? 1 : 0] += hair(random);
            break;
        case Kind::nearly_alike:
            second = pair.first;
            for (Vector<2>& p : second) p += hair(random);
            std::rotate(second.begin(), second.begin() + static_cast<int>(uniform(random, 0.0, 3.0)), second.end());
            break;
        case Kind::sliver:
            c = on_line(uniform(random, 0.0, 1.0)) +
                std::ldexp(1.0, -static_cast<int>(uniform(random, 10.0, 34.0))) * Vector<2>(-along[1], along[0]);
            break;
        case Kind::gap_on_edge:  // g = 0 all along an edge of face 1, or everywhere
            pair.slope = i % 5 == 0 ? Vector<2>(0, 0) : (i % 2 == 0 ? 0.125 : -0.125) * Vector<2>(along[1], -along[0]);
            pair.height_2 = 2.0 * pair.slope.dot(a);
            break;
    }
    return pair;
}

}  // namespace

TEST_CASE("W and the normal force of triangles are those of exact polygons, in general position and in every degenerate one",
          "[pair_potential][exact]") {
    const auto kind = GENERATE(Kind::free, Kind::on_a_line, Kind::nearly_on_a_line, Kind::at_a_corner, Kind::nearly_alike,
                               Kind::sliver, Kind::gap_on_edge);
    std::mt19937 random(static_cast<unsigned>(kind) + 1);
    double worst_energy = 0.0, worst_force = 0.0;
    int pressed = 0;
    for (int i = 0; i < 3000; ++i) {
        const TiltedPair pair = pair_of(kind, i, random);
        if (!is_usable(pair.first) || !is_usable(pair.second)) continue;
        const PairLaw<3> law{.stiffness = 2.0, .facing = {-0.3, -0.05}};
        const ExactIntegrals exact(pair);
        const auto found = pair_gradient<3>(pair.corners(), law);
        const double square = pair.slope.squaredNorm(), cosine = (square - 1.0) / (square + 1.0);
        REQUIRE(cosine < law.facing.full);  // chi = 1
        const double size = pair.size();
        if (exact.deepest == 0.0) {
            raise(worst_energy, found.energy);
            continue;
        }
        ++pressed;
        const Vector<3> on_second = found.gradient[3] + found.gradient[4] + found.gradient[5];
        raise(worst_energy, std::abs(found.energy - exact.second) / (exact.deepest * exact.deepest * size * size));
        raise(worst_force, std::abs(-on_second[2] - 2.0 * exact.first) / (exact.deepest * size * size));
    }
    CHECK(pressed > 500);
    CHECK(worst_energy < 1e-12);
    CHECK(worst_force < 1e-12);
}

TEST_CASE("W of needles that cross is that of exact polygons, to rounding of positions beside their widths",
          "[pair_potential][exact]") {
    std::mt19937 random(8);
    const auto sixteenth = [&](double size) { return std::round(16.0 * uniform(random, -size, size)) / 16.0; };
    double worst = 0.0;
    for (int i = 0; i < 3000; ++i) {
        const double width = std::ldexp(1.0, -static_cast<int>(uniform(random, 8.0, 20.0)));
        const Vector<2> crossing = grid_point(random, 0.5), along_1 = grid_point(random), along_2 = grid_point(random);
        if (std::abs(along_1[0] * along_2[1] - along_1[1] * along_2[0]) < 0.1) continue;
        const auto needle = [&](const Vector<2>& along) {
            std::array<Vector<2>, 3> corners{crossing - along, crossing + along,
                                             crossing + sixteenth(1.0) * along + width * Vector<2>(-along[1], along[0])};
            std::rotate(corners.begin(), corners.begin() + static_cast<int>(uniform(random, 0.0, 3.0)), corners.end());
            return corners;
        };
        TiltedPair pair{needle(along_1), needle(along_2), {sixteenth(0.4), sixteenth(0.4)}, 0.0, 0.0};
        pair.height_2 = 2.0 * pair.slope.dot(crossing) - width;
        const double exact = ExactIntegrals(pair).second;
        const auto found = pair_gradient<3>(pair.corners(), {.stiffness = 2.0, .facing = {-0.3, -0.05}});
        raise(worst, std::abs(found.energy / exact - 1.0) * width / pair.size() / 0x1p-52);
    }
    CHECK(worst < 10.0);  // units in the last place
}

TEMPLATE_TEST_CASE_SIG("a pair is bitwise identical by itself, with others, on any number of lanes and with its start known",
                       "[pair_potential][exact]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(3);
    constexpr std::size_t n = 150;  // more than go at once, and no multiple of any number of lanes
    std::vector<PairCorners<Dim>> x_0(n), x_1(n);
    std::vector<PairLaw<Dim>> law(n);
    std::vector<PairMeanGradient<Dim>> together(n), known(n);
    std::vector<PairEnd<Dim>> start(n), end(n), same_end(n);
    std::vector<PairStep<Dim>> steps, next_steps;
    for (std::size_t i = 0; i < n; ++i) {
        x_0[i] = random_pair<Dim>(random);
        x_1[i] = moved_on<Dim>(x_0[i], random, 0.02, i % 3 == 0 ? 0.1 : 1e-3);
        law[i] = law_of<Dim>(x_0[i], 1.0 + static_cast<double>(i));
        steps.push_back({&x_0[i], &x_1[i], &law[i], nullptr, &end[i], &together[i]});
        next_steps.push_back({&x_0[i], &x_1[i], &law[i], &start[i], &same_end[i], &known[i]});
        PairMeanGradient<Dim> of_start;
        const PairStep<Dim> before{&x_1[i], &x_0[i], &law[i], nullptr, &start[i], &of_start};
        integrate_pairs<Dim>({&before, 1});
    }
    const PairPathOptions options =
        GENERATE(PairPathOptions{}, PairPathOptions{.gauss = true}, PairPathOptions{.events = false});
    integrate_pairs<Dim>(steps, options);
    integrate_pairs<Dim>(next_steps, options);
    const auto same = [](const PairMeanGradient<Dim>& a, const PairMeanGradient<Dim>& b) {
        return std::memcmp(&a.gradient, &b.gradient, sizeof(a.gradient)) == 0 &&
               std::memcmp(&a.pressure, &b.pressure, sizeof(a.pressure)) == 0 && a.energy_0 == b.energy_0 &&
               a.energy_1 == b.energy_1 && a.gap_0 == b.gap_0 && a.gap_1 == b.gap_1 && a.facing == b.facing &&
               a.normal == b.normal && a.active_share == b.active_share && a.area == b.area &&
               a.correction == b.correction && a.events == b.events;
    };
    int active = 0, finer = 0;
    for (std::size_t i = 0; i < n; ++i) {
        active += together[i].active_share > 0.0 ? 1 : 0;
        finer += together[i].events > 0 ? 1 : 0;
        REQUIRE(same(together[i], pair_mean_gradient<Dim>(x_0[i], x_1[i], law[i], options)));
        REQUIRE(same(together[i], known[i]));
        REQUIRE(end[i] == same_end[i]);
    }
    CHECK(active > 50);
    if (options.events) CHECK(finer > 3);

    std::vector<lanes::LaneTask<Dim>> tasks(lanes::most_tasks);
    std::vector<PairMeanGradient<Dim>> found(tasks.size());
    const auto integrate = [&](auto by) {
        for (std::size_t i = 0; i < tasks.size(); ++i)
            tasks[i] = {.x_0 = x_0[i][0].data(),
                        .x_1 = x_1[i][0].data(),
                        .start = nullptr,
                        .stiffness = law[i].stiffness,
                        .length = {law[i].length[0], law[i].length[1]},
                        .full = law[i].facing.full,
                        .none = law[i].facing.none,
                        .offset = 0.0,
                        .end = end[i].data(),
                        .gradient = found[i].gradient[0].data(),
                        .pressure = found[i].pressure.data(),
                        .normal = found[i].normal.data()};
        by(tasks.data(), lanes::most_tasks, lanes::Integral::checked);
        for (std::size_t i = 0; i < tasks.size(); ++i)
            REQUIRE(std::memcmp(&found[i].gradient, &together[i].gradient, sizeof(found[i].gradient)) == 0);
    };
    integrate_pairs<Dim>(steps);
    integrate([](auto* of, int count, auto integral) { lanes::integrate_by_2(of, count, integral); });
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2"))
        integrate([](auto* of, int count, auto integral) { lanes::integrate_by_4(of, count, integral); });
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        integrate([](auto* of, int count, auto integral) { lanes::integrate_by_8(of, count, integral); });
#endif
}
