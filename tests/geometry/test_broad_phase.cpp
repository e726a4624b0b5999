#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/geometry/broad_phase/spatial_order.hpp"

using namespace abut;
using namespace abut::geometry;

namespace {

template <int Dim>
using Boxes = std::vector<Box<Dim>>;

std::vector<BroadPhase> those_of(const std::vector<BroadPhase>& wanted) {
    std::vector<BroadPhase> there;
    for (const BroadPhase method : broad_phases())
        if (std::ranges::find(wanted, method) != wanted.end()) there.push_back(method);
    return there;
}
std::vector<BroadPhase> without_brute_force() {
    return those_of({BroadPhase::automatic, BroadPhase::packed_tree, BroadPhase::embree, BroadPhase::fcl});
}
std::vector<BroadPhase> of_many_boxes() { return those_of({BroadPhase::packed_tree, BroadPhase::embree}); }

template <int Dim>
std::vector<IndexPair> between(const SearchOptions& options, const Boxes<Dim>& boxes_1, const Boxes<Dim>& boxes_2) {
    return overlapping_pairs<Dim>(options, boxes_1, boxes_2);
}
template <int Dim>
std::vector<IndexPair> between(BroadPhase method, const Boxes<Dim>& boxes_1, const Boxes<Dim>& boxes_2) {
    return overlapping_pairs<Dim>({method}, boxes_1, boxes_2);
}
template <int Dim>
std::vector<IndexPair> within(BroadPhase method, const Boxes<Dim>& boxes) {
    return overlapping_pairs<Dim>({method}, boxes);
}

template <int Dim>
Vector<Dim> random_vector(std::mt19937& random, double lower, double upper) {
    std::uniform_real_distribution<double> number(lower, upper);
    Vector<Dim> result;
    for (double& x : result) x = number(random);
    return result;
}

template <int Dim>
Boxes<Dim> random_boxes(int count, unsigned seed, double largest) {
    std::mt19937 random(seed);
    Boxes<Dim> boxes;
    for (int i = 0; i < count; ++i) {
        const Vector<Dim> lower = random_vector<Dim>(random, 0.0, 1.0);
        boxes.push_back({lower, lower + random_vector<Dim>(random, 0.0, largest)});
    }
    return boxes;
}

template <int Dim>
Boxes<Dim> placed(Boxes<Dim> boxes, double scale, double offset) {
    for (Box<Dim>& box : boxes) {
        box.lower = scale * box.lower + Vector<Dim>::Constant(offset);
        box.upper = scale * box.upper + Vector<Dim>::Constant(offset);
    }
    return boxes;
}

// Cubes of a grid, side by side: closed boxes touch at faces, edges and corners.
Boxes<3> grid(int n, double cell) {
    Boxes<3> boxes;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const Vector<3> lower(i, j, k);
                boxes.push_back({cell * lower, cell * (lower + Vector<3>::Ones())});
            }
    return boxes;
}

template <int Dim>
void check_against_brute_force(const Boxes<Dim>& boxes_1, const Boxes<Dim>& boxes_2) {
    const std::vector<IndexPair> expected = between(BroadPhase::brute_force, boxes_1, boxes_2);
    const std::vector<IndexPair> expected_within = within(BroadPhase::brute_force, boxes_1);
    for (const BroadPhase method : broad_phases()) {
        CAPTURE(std::string(name(method)), boxes_1.size(), boxes_2.size(), expected.size());
        CHECK((between(method, boxes_1, boxes_2) == expected));
        CHECK((within(method, boxes_1) == expected_within));
    }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("every broad phase is brute force on random boxes of every scale and place", "[broad_phase]",
                       ((int Dim), Dim), 2, 3) {
    const int count = GENERATE(1, 2, 7, 100, 700);
    const double largest = GENERATE(0.0, 0.01, 0.3);
    const Boxes<Dim> boxes_1 = random_boxes<Dim>(count, 1, largest), boxes_2 = random_boxes<Dim>(2 * count, 2, largest);
    for (const auto& [scale, offset] :
         {std::pair{1.0, 0.0}, {1e-9, 0.0}, {1e9, 0.0}, {1e-3, 1e7}, {1.0, -1e6}, {1e-9, 1.0}, {1e30, 0.0}}) {
        CAPTURE(scale, offset);
        check_against_brute_force<Dim>(placed(boxes_1, scale, offset), placed(boxes_2, scale, offset));
    }
}

TEST_CASE("every broad phase finds all neighbours of touching boxes", "[broad_phase]") {
    // Pairs of cells that differ by at most 1 in every index: ((3n-2)^3 - n^3)/2.
    const double cell = GENERATE(1.0, 0.1, 1.0 / 3.0, 1e-9, 1e9);
    const int n = 7;
    const Boxes<3> boxes = placed(grid(n, 1.0), cell, 0.0);
    const std::size_t expected = (19 * 19 * 19 - n * n * n) / 2;
    for (const BroadPhase method : broad_phases()) CHECK(within(method, boxes).size() == expected);
}

TEST_CASE("more than 100,000 boxes: counts known by formula", "[broad_phase]") {
    const int n = 50;
    const Boxes<3> boxes = grid(n, 0x1p-5);
    const std::size_t expected = (148ull * 148 * 148 - 125000) / 2;
    const std::vector<IndexPair> pairs = within(BroadPhase::packed_tree, boxes);
    CHECK(boxes.size() > 100000);
    CHECK(pairs.size() == expected);
    for (const BroadPhase method : without_brute_force()) CHECK((within(method, boxes) == pairs));
    // Between two copies: those pairs in both orders, and every box with its own copy.
    for (const BroadPhase method : of_many_boxes())
        CHECK(between(method, boxes, boxes).size() == 2 * expected + boxes.size());
}

TEST_CASE("flat boxes, points, and identical boxes", "[broad_phase]") {
    Boxes<3> flat = random_boxes<3>(300, 5, 0.4), points = random_boxes<3>(100, 6, 0.0);
    for (std::size_t i = 0; i < flat.size(); ++i) {
        const int axis = static_cast<int>(i % 3);
        flat[i].lower[axis] = flat[i].upper[axis] = 0.5;  // planes that cut one another, many of them coplanar
    }
    check_against_brute_force<3>(flat, flat);
    check_against_brute_force<3>(flat, points);
    points.insert(points.end(), points.begin(), points.end());
    check_against_brute_force<3>(points, points);
    check_against_brute_force<3>(Boxes<3>(300, flat[0]), Boxes<3>(200, flat[0]));
    check_against_brute_force<2>(Boxes<2>(50, Box<2>{{1, 1}, {1, 1}}), Boxes<2>(50, Box<2>{{1, 1}, {2, 1}}));
}

TEST_CASE("boxes that miss by one last digit do not overlap, boxes that touch do", "[broad_phase]") {
    for (const double x : {1.0, 1e-9, 1e9, 1e7 + 1e-3, 1.0 / 3.0}) {
        const Boxes<3> box = {{Vector<3>(x / 2, 0, 0), Vector<3>(x, 1, 1)}};
        const Boxes<3> touching = {{Vector<3>(x, 0, 0), Vector<3>(2 * x, 1, 1)}};
        const Boxes<3> apart = {{Vector<3>(std::nextafter(x, 2 * x), 0, 0), Vector<3>(2 * x, 1, 1)}};
        for (const BroadPhase method : broad_phases()) {
            CAPTURE(x, std::string(name(method)));
            CHECK(between(method, box, touching).size() == 1);
            CHECK(between(method, box, apart).empty());
            CHECK(within(method, Boxes<3>{box[0], touching[0]}).size() == 1);
            CHECK(within(method, Boxes<3>{box[0], apart[0]}).empty());
        }
    }
}

TEST_CASE("an obstacle of 1e6 among boxes of 1e-3", "[broad_phase]") {
    Boxes<3> small = placed(random_boxes<3>(2000, 7, 0.05), 1e-3, 0.0);
    const Boxes<3> obstacle = {{Vector<3>(-1e6, -1e6, -1e6), Vector<3>(1e6, 1e6, 5e-4)},
                               {Vector<3>(-1e6, -1e6, -1e6), Vector<3>(-1, 1e6, 1e6)}};
    check_against_brute_force<3>(small, obstacle);
    check_against_brute_force<3>(obstacle, small);
    small.insert(small.end(), obstacle.begin(), obstacle.end());
    check_against_brute_force<3>(small, small);
}

TEST_CASE("small boxes stay apart beside an obstacle 1e9 times their size, in single precision too", "[broad_phase]") {
    const BroadPhase method = GENERATE(from_range(of_many_boxes()));
    // Without care all 30,000 would fall on one float: 4.5e8 false pairs. Each touches its neighbour only.
    const int n = 30000;
    Boxes<3> boxes;
    for (int i = 0; i < n; ++i)
        boxes.push_back({Vector<3>(i * 0x1p-10, 0, 0), Vector<3>((i + 1) * 0x1p-10, 0x1p-10, 0x1p-10)});
    boxes.push_back({Vector<3>(-1e6, -1e6, -1e6), Vector<3>(1e6, 1e6, -1.0)});
    CHECK(within(method, boxes).size() == n - 1);
    boxes.push_back({Vector<3>(-1e6, -1e6, -1e6), Vector<3>(1e6, 1e6, 0.0)});
    CHECK(within(method, boxes).size() == 2 * n);  // the neighbours, the second obstacle with all, both obstacles
}

TEST_CASE("small boxes spread over many orders of magnitude", "[broad_phase]") {
    Boxes<3> boxes;
    for (int k = -9; k <= 9; ++k)
        for (const Box<3>& box : random_boxes<3>(60, 20 + k, 0.2)) {
            const double scale = std::pow(10.0, k);
            boxes.push_back({scale * box.lower, scale * box.upper});
        }
    check_against_brute_force<3>(boxes, boxes);
}

TEST_CASE("empty sets and empty boxes overlap nothing", "[broad_phase]") {
    const Boxes<3> none, one = {{Vector<3>(0, 0, 0), Vector<3>(1, 1, 1)}}, empty(5);
    const Boxes<3> turned = {{Vector<3>(0, 1, 0), Vector<3>(1, 0, 1)}};  // empty: lower > upper in y
    for (const BroadPhase method : broad_phases()) {
        CAPTURE(std::string(name(method)));
        CHECK(between(method, none, one).empty());
        CHECK(between(method, one, none).empty());
        CHECK(between(method, one, empty).empty());
        CHECK(between(method, one, turned).empty());
        CHECK(within(method, none).empty());
        CHECK(within(method, one).empty());
        CHECK(within(method, empty).empty());
        CHECK((between(method, Boxes<3>{turned[0], one[0], Box<3>()}, one) == std::vector<IndexPair>{{1, 0}}));
        CHECK((within(method, Boxes<3>{one[0], turned[0], Box<3>(), one[0]}) == std::vector<IndexPair>{{0, 3}}));
    }
}

TEST_CASE("a bound that is not finite is an error that names the box", "[broad_phase][errors]") {
    using Catch::Matchers::Contains;
    const double bad = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
    const Box<3> good{Vector<3>(0, 0, 0), Vector<3>(1, 1, 1)};
    Boxes<3> boxes(4, good);
    boxes[2].upper.y() = bad;
    for (const BroadPhase method : broad_phases()) {
        CHECK_THROWS_AS(within(method, boxes), BadInput);
        CHECK_THROWS_WITH(within(method, boxes), Contains("box 2"));
        CHECK_THROWS_WITH(between(method, Boxes<3>{good}, boxes), Contains("box 2"));
    }
}

TEMPLATE_TEST_CASE_SIG("a box around a point that is no number is no empty box, and an error", "[broad_phase][errors]",
                       ((int Dim), Dim), 2, 3) {
    using Catch::Matchers::Contains;
    const Vector<Dim> no_number = Vector<Dim>::Constant(std::numeric_limits<double>::quiet_NaN()),
                      point = Vector<Dim>::Ones();
    const auto around = [](const std::vector<Vector<Dim>>& points) {
        Box<Dim> box;
        for (const Vector<Dim>& p : points) box.extend(p);
        return box;
    };
    Vector<Dim> half_a_number = point;
    half_a_number[1] = no_number[1];
    Box<Dim> of_boxes = around({point});
    of_boxes.extend(around({no_number}));
    of_boxes.extend(around({point}));
    for (const Box<Dim>& bad : {around({no_number}), around({no_number, point}), around({point, no_number}),
                                around({point, half_a_number, point}), of_boxes}) {
        CHECK_FALSE(bad.empty());
        for (const BroadPhase method : broad_phases())
            CHECK_THROWS_WITH(within(method, Boxes<Dim>{around({point}), bad}), Contains("box 1") && Contains("nan"));
    }
}

TEST_CASE("queries from several threads at once give the same answers", "[broad_phase]") {
    const BroadPhase method = GENERATE(from_range(of_many_boxes()));
    const Boxes<3> boxes_1 = random_boxes<3>(3000, 8, 0.05), boxes_2 = random_boxes<3>(3000, 9, 0.05);
    const std::vector<IndexPair> expected = between(BroadPhase::brute_force, boxes_1, boxes_2);
    std::array<std::vector<IndexPair>, 4> answers;
    std::vector<std::jthread> threads;
    for (std::vector<IndexPair>& answer : answers) threads.emplace_back([&] { answer = between(method, boxes_1, boxes_2); });
    threads.clear();
    for (const std::vector<IndexPair>& answer : answers) CHECK((answer == expected));
}

TEST_CASE("a thousand random soups of triangles: no broad phase misses a pair", "[broad_phase][soup]") {
    // Triangles of sizes from 1e-6 to 3 times the scene, many of them flat along an axis; scenes from 1e-9 to 1e9 in size,
    // up to 1e7 away from the origin.
    std::mt19937 random(2026);
    const auto number = [&](double lower, double upper) {
        return std::uniform_real_distribution<double>(lower, upper)(random);
    };
    const auto soup = [&](int count, double scale, const Vector<3>& origin) {
        Boxes<3> boxes;
        for (int i = 0; i < count; ++i) {
            const Vector<3> centre = random_vector<3>(random, -1.0, 1.0);
            const double size = std::pow(10.0, number(-6.0, 0.5));
            Vector<3> reach = size * random_vector<3>(random, 0.0, 1.0);
            if (i % 4 == 0) reach[i / 4 % 3] = 0.0;
            Box<3> box;
            for (int corner = 0; corner < 3; ++corner)
                box.extend(origin + scale * (centre + reach.cwiseProduct(random_vector<3>(random, -1.0, 1.0))));
            boxes.push_back(box);
        }
        return boxes;
    };
    std::size_t pairs = 0, wrong = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const double scale = std::pow(10.0, number(-9.0, 9.0));
        const Vector<3> origin = (trial % 2) * std::pow(10.0, number(-9.0, 7.0)) * random_vector<3>(random, -1.0, 1.0);
        const Boxes<3> boxes_1 = soup(40 + trial % 60, scale, origin), boxes_2 = soup(40 + trial % 37, scale, origin);
        const auto expected = between(BroadPhase::brute_force, boxes_1, boxes_2);
        const auto expected_within = within(BroadPhase::brute_force, boxes_1);
        pairs += expected.size() + expected_within.size();
        for (const BroadPhase method : broad_phases())
            wrong += between(method, boxes_1, boxes_2) != expected || within(method, boxes_1) != expected_within;
    }
    CHECK(wrong == 0);
    CHECK(pairs > 40000);
}

TEST_CASE("boxes inside boxes, and one body inside another", "[broad_phase]") {
    Boxes<3> nested;
    for (int i = 0; i < 200; ++i)
        nested.push_back({Vector<3>::Constant(-1.0 / (1 + i)), Vector<3>::Constant(1.0 / (1 + i))});  // all hold the origin
    for (const BroadPhase method : broad_phases()) CHECK(within(method, nested).size() == 200 * 199 / 2);

    // The shell of a cube of 20 cells around a small full one that it does not touch.
    Boxes<3> shell, core = placed(grid(4, 1.0), 1.0, 8.0);
    for (const Box<3>& cell : grid(20, 1.0))
        if (cell.lower.minCoeff() == 0.0 || cell.upper.maxCoeff() == 20.0) shell.push_back(cell);
    for (const BroadPhase method : broad_phases()) CHECK(between(method, shell, core).empty());
    core.push_back({Vector<3>(8, 8, 8), Vector<3>(8, 8, 20)});  // a thread from the core to the shell
    for (const BroadPhase method : broad_phases()) CHECK(between(method, shell, core).size() == 4);
    check_against_brute_force<3>(shell, core);
}

TEMPLATE_TEST_CASE_SIG("boxes that come in spatial order, or are falsely said to, give the same pairs", "[broad_phase]",
                       ((int Dim), Dim), 2, 3) {
    const Boxes<Dim> boxes_1 = random_boxes<Dim>(1500, 3, 0.05), boxes_2 = random_boxes<Dim>(900, 4, 0.05);
    const auto expected = between(BroadPhase::brute_force, boxes_1, boxes_2);
    CHECK((between<Dim>({.method = BroadPhase::packed_tree, .in_spatial_order = true}, boxes_1, boxes_2) == expected));

    std::vector<Vector<Dim>> corners;
    for (const Box<Dim>& box : boxes_1) corners.push_back(box.lower);
    const std::vector<std::int32_t> order = spatial_order<Dim>(corners);
    Boxes<Dim> ordered;
    for (const std::int32_t i : order) ordered.push_back(boxes_1[i]);
    auto found = between<Dim>({.method = BroadPhase::packed_tree, .in_spatial_order = true}, ordered, boxes_2);
    for (IndexPair& pair : found) pair.first = order[pair.first];
    std::sort(found.begin(), found.end());
    CHECK((found == expected));
}

TEST_CASE("any number of threads gives the same pairs", "[broad_phase]") {
    const Boxes<3> boxes_1 = random_boxes<3>(20000, 8, 0.03), boxes_2 = random_boxes<3>(30000, 9, 0.03);
    const auto on_threads = [&](int threads, BroadPhase method) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
        tbb::task_arena arena(threads);
        return arena.execute([&] { return std::pair(between(method, boxes_1, boxes_2), within(method, boxes_1)); });
    };
    for (const BroadPhase method : of_many_boxes()) {
        const auto one = on_threads(1, method);
        CHECK(one.first.size() > 10000);
        for (const int threads : {2, 3, 7}) CHECK((on_threads(threads, method) == one));
    }
}

TEST_CASE("more pairs than allowed are an error that gives both numbers", "[broad_phase][errors]") {
    using Catch::Matchers::Contains;
    const Boxes<3> boxes(600, Box<3>{Vector<3>(0, 0, 0), Vector<3>(1, 1, 1)});
    const std::int64_t all = 600 * 600;
    const BroadPhase method = GENERATE(from_range(broad_phases()));
    CAPTURE(std::string(name(method)));
    CHECK(between<3>({method, {.pairs = all}}, boxes, boxes).size() == all);
    CHECK(overlapping_pairs<3>({method, {.pairs = 600 * 599 / 2}}, boxes).size() == 600 * 599 / 2);
    CHECK_THROWS_AS(overlapping_pairs<3>({method, {.pairs = 600 * 599 / 2 - 1}}, boxes), SearchLimitError);
    for (const std::int64_t allowed : {std::int64_t{0}, std::int64_t{1000}, all - 1}) try {
            (void)between<3>({method, {.pairs = allowed}}, boxes, boxes);
            FAIL("no error with " << allowed << " pairs allowed");
        } catch (const SearchLimitError& error) {
            CHECK(error.facts().allowed == static_cast<double>(allowed));
            CHECK(error.facts().value > error.facts().allowed);
            CHECK(error.facts().value <= static_cast<double>(all));
            CHECK_THAT(error.what(), Contains(std::to_string(allowed) + " are allowed") && Contains("SearchLimits::pairs"));
        }
}

TEST_CASE("a search that would take more memory than allowed is refused", "[broad_phase][errors]") {
    using Catch::Matchers::Contains;
    const Boxes<3> boxes(2000, Box<3>{Vector<3>(0, 0, 0), Vector<3>(1, 1, 1)});
    const BroadPhase method = GENERATE(from_range(broad_phases()));
    CAPTURE(std::string(name(method)));
    const auto allowing = [&](std::size_t bytes) { return SearchOptions{method, {.bytes = bytes}}; };
    // Not even the boxes fit; the boxes and their trees fit, four million pairs do not; all does.
    CHECK_THROWS_WITH(between<3>(allowing(2000 * 48), boxes, boxes),
                      Contains("4000 boxes") && Contains("SearchLimits::bytes"));
    CHECK_THROWS_WITH(between<3>(allowing(4'000'000), boxes, boxes),
                      Contains("pairs of boxes or more overlap") && Contains("SearchLimits::bytes"));
    CHECK(between<3>(allowing(80'000'000), boxes, boxes).size() == 4'000'000);
    // Room for all pairs at 16 bytes each, but for no tree beside them.
    try {
        (void)between<3>(allowing(64'000'000), boxes, boxes);
        FAIL("no error where the trees do not fit beside the pairs");
    } catch (const SearchLimitError& error) {
        CHECK(error.facts().allowed == 64e6);
        CHECK(error.facts().value > error.facts().allowed);
    }
}

TEST_CASE("broad phases have names", "[broad_phase]") {
    CHECK(name(BroadPhase::automatic) == "automatic");
    CHECK(name(BroadPhase::packed_tree) == "packed_tree");
    CHECK(name(BroadPhase::embree) == "embree");
    CHECK(name(BroadPhase::fcl) == "fcl");
    CHECK(name(BroadPhase::brute_force) == "brute_force");
}

TEST_CASE("a back end that this build does not have is refused by name", "[broad_phase]") {
    const Boxes<3> boxes = random_boxes<3>(10, 1, 0.5);
    for (const BroadPhase method : {BroadPhase::embree, BroadPhase::fcl}) {
        const bool is_there = !those_of({method}).empty();
        if (is_there)
            CHECK_NOTHROW(within(method, boxes));
        else
            CHECK_THROWS_WITH(within(method, boxes), Catch::Matchers::Contains("this build of Abut has no") &&
                                                         Catch::Matchers::Contains("packed_tree"));
    }
}
