// How a search for candidates is used: how long a list is valid, its skin, its options and limits.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "abut/contact/search/candidate_search.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;
using geometry::IndexPair;

namespace {

contact::Surface<3> together(contact::Surface<3> surface, const contact::Surface<3>& other) {
    for (std::int32_t face = 0; face < other.size(); ++face) {
        std::vector<Vector<3>> corners;
        for (const std::int32_t v : other.view().vertices_of(face)) corners.push_back(other.vertices[v]);
        surface.append(corners, other.cell_depth[face], other.stiffness[face], other.body[face]);
    }
    return surface;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a list is valid for motions up to half its skin, and for none before the first search",
                       "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.1, 1.0, 0);
    surface.append(tile<Dim>(up<Dim>(), -up<Dim>(), 1.5), 0.1, 1.0, 1);
    surface.append(tile<Dim>(-up<Dim>(), up<Dim>(), 100.0), 0.0, rigid, 2);
    contact::ContactOptions options;
    options.search.skin = GENERATE(0.0, 0.3);
    Mover<Dim> mover(surface, options);
    // By default the first one is half the mean size of the deformable faces, 1 and 3.
    const double expected = options.search.skin > 0.0 ? options.search.skin : 1.0;
    CHECK(mover.contact.skin() == Approx(expected).epsilon(1e-14));
    CHECK_FALSE(mover.contact.is_valid_for(0.0));
    mover.search(at_rest(surface));
    CHECK(mover.contact.is_valid_for(0.0));
    CHECK(mover.contact.is_valid_for(0.4999 * expected));
    CHECK_FALSE(mover.contact.is_valid_for(0.5001 * expected));
    CHECK_FALSE(mover.contact.is_valid_for(std::numeric_limits<double>::quiet_NaN()));
}

TEMPLATE_TEST_CASE_SIG("a long slide leaves no trail in the list", "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    // A tile of body 1, pressed a little into a long strip of body 0, passes over all of its tiles.
    contact::Surface<Dim> surface;
    for (int i = 0; i < 40; ++i) {
        Vector<Dim> centre = Vector<Dim>::Zero();
        centre[0] = i;
        surface.append(tile<Dim>(centre, up<Dim>(), 0.5), 0.3, 1.0, 0);
    }
    surface.append(tile<Dim>(Vector<Dim>(0.05 * up<Dim>()), -up<Dim>(), 0.5), 0.3, 1.0, 1);
    contact::ContactOptions options;
    options.search.skin = 0.5;
    Mover<Dim> mover(surface, options);
    auto u = at_rest(surface);
    mover.search(u);
    u.back() = -0.1 * up<Dim>();
    CHECK(mover.move_to(u));
    for (int step = 0; step < 180; ++step) {
        u.back()[0] += 0.2;
        CHECK(mover.move_to(u));
        mover.search(u);
        CHECK(mover.contact.report().candidates <= 5);
    }
    CHECK(mover.contact.report().missed_contacts == 0);
}

TEST_CASE("any number of threads gives the same list and the same counts", "[contact][candidates]") {
    const auto height = [](double x, double y) { return 0.1 * std::sin(9 * x) * std::cos(7 * y); };
    const auto surface =
        together(sheet(40, 0, true, height), sheet(33, 1, false, [&](double x, double y) { return height(x, y) + 0.001; }));
    const auto on_threads = [&](int threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
        tbb::task_arena arena(threads);
        return arena.execute([&] {
            contact::CandidateSearch<3> search(surface.view(), {.self_contact = true});
            search.search(at_rest(surface), at_rest(surface));
            const auto& r = search.report();
            return std::pair(std::vector<IndexPair>(search.candidates().begin(), search.candidates().end()),
                             std::array{r.box_pairs, r.neighbours, r.both_rigid, r.not_facing, r.too_far_apart});
        });
    };
    const auto one = on_threads(1);
    CHECK(one.first.size() > 5000);
    for (const int threads : {2, 5}) CHECK(on_threads(threads) == one);
}

TEST_CASE("the chosen skin costs little more than the best fixed one", "[contact][candidates][skin]") {
    // A sheet slides over another one, pressed a little into it. The cost of a run by the model of the choice: a list costs
    // 4 per face and 10 per pair, a pair in a step 1. Some lists, by which the choice learns, come first.
    const auto [speed, by_vertices] =  // m per step; faces of 0.04 m
        GENERATE(table<double, bool>({{5e-5, false}, {5e-4, false}, {5e-3, false}, {5e-5, true}, {5e-4, true}}));
    const auto flat = [](double, double) { return 0.0; };
    const auto surface = together(sheet(17, 0, true, flat), sheet(15, 1, false, [](double, double) { return -0.0001; }));
    const auto positions = [&](const std::vector<Vector<3>>& u) {
        auto x = surface.vertices;  // each is of one face
        for (std::size_t v = 0; v < x.size(); ++v) x[v] += u[v / 3];
        return x;
    };
    const auto cost_with = [&, speed = speed, by_vertices = by_vertices](double skin) {
        contact::CandidateSearch<3> search(surface.view(), {.skin = skin});
        const auto search_along = [&](const std::vector<Vector<3>>& u_0, const std::vector<Vector<3>>& u_1) {
            if (by_vertices)
                search.search_moved(positions(u_0), positions(u_1));
            else
                search.search(u_0, u_1);
        };
        auto start = at_rest(surface), end = start;
        for (Vector<3>& path : end) path.x() = speed;
        for (int list = 0; list < 10; ++list) search_along(start, end);
        start = end = at_rest(surface);
        const auto slide_to = [&](double x, std::vector<Vector<3>>& u) {
            for (std::size_t face = 0; face < u.size(); ++face)
                if (surface.body[face] == 1) u[face].x() = x;
        };
        double cost = 0.0, motion = std::numeric_limits<double>::infinity(), x = 0.0;
        const int steps = 400;
        for (int step = 0; step < steps; ++step) {
            const double before = x;
            x += (step / 100 % 2 == 0 ? 1.0 : -1.0) * speed;  // to and fro
            motion += speed;
            if (!search.is_valid_for(motion)) {
                slide_to(before, start);
                slide_to(x, end);
                search_along(start, end);
                motion = speed;
                cost += 4.0 * surface.size() + 10.0 * static_cast<double>(search.candidates().size());
            }
            cost += static_cast<double>(search.candidates().size());
        }
        return cost;
    };
    double best = std::numeric_limits<double>::infinity();
    for (double skin = 0.003; skin < 0.1; skin *= 1.6) best = std::min(best, cost_with(skin));
    const double chosen = cost_with(0.0);
    CAPTURE(speed, by_vertices, best, chosen, chosen / best);
    CHECK(chosen < 1.25 * best);
}

TEMPLATE_TEST_CASE_SIG("a face that moves beyond all measure within a step is refused by name", "[contact][errors]",
                       ((int Dim), Dim), 2, 3) {
    using Catch::Matchers::Contains;
    contact::Surface<Dim> surface;
    for (int i = 0; i < 5; ++i)
        surface.append(tile<Dim>(Vector<Dim>(static_cast<double>(i) * axis<Dim>(0)), up<Dim>(), 0.5), 0.1, 1.0, 0);
    const auto u = at_rest(surface);
    contact::CandidateSearch<Dim> search(surface.view(), {});
    search.search(u, u);
    REQUIRE(search.is_valid_for(0.0));
    auto far = u;
    far[3] = 1e9 * up<Dim>();
    CHECK_THROWS_WITH(search.search(u, far), Contains("face 3") && Contains("1e+09") && Contains("largest_motion"));
    CHECK_FALSE(search.is_valid_for(0.0));
    CHECK(search.candidates().empty());
    far[3] = Vector<Dim>::Constant(std::numeric_limits<double>::infinity());
    CHECK_THROWS_WITH(search.search(u, far), Contains("face 3") && Contains("not finite"));
    far[3] = Vector<Dim>::Constant(std::numeric_limits<double>::quiet_NaN());
    CHECK_THROWS_WITH(search.search(far, u), Contains("face 3") && Contains("not finite"));
    far[3] = 4.0 * up<Dim>();  // less than the five faces are long
    CHECK_NOTHROW(search.search(u, far));
    contact::CandidateSearch<Dim> loose(surface.view(), {.largest_motion = 1e12});
    far[3] = 1e9 * up<Dim>();
    CHECK_NOTHROW(loose.search(u, far));
}

TEST_CASE("more candidates than allowed are an error, and leave no list", "[contact][errors]") {
    const auto flat = [](double, double) { return 0.0; };
    const auto surface = together(sheet(10, 0, true, flat), sheet(10, 1, false, [](double, double) { return 0.001; }));
    const auto u = at_rest(surface);
    contact::CandidateSearch<3> free(surface.view(), {.skin = 0.01});
    free.search(u, u);
    const auto n = static_cast<std::int64_t>(free.candidates().size());
    contact::CandidateSearch<3> enough(surface.view(), {.skin = 0.01, .limits = {.pairs = n}});
    CHECK_NOTHROW(enough.search(u, u));
    contact::CandidateSearch<3> tight(surface.view(), {.skin = 0.01, .limits = {.pairs = n - 1}});
    CHECK_THROWS_AS(tight.search(u, u), geometry::SearchLimitError);
    CHECK_FALSE(tight.is_valid_for(0.0));
    CHECK(tight.candidates().empty());
    contact::CandidateSearch<3> small(surface.view(), {.skin = 0.01, .limits = {.bytes = 1000}});
    CHECK_THROWS_AS(small.search(u, u), geometry::SearchLimitError);
}

TEST_CASE("a limit that is met between the second two bodies leaves no part of a list, and says what was there before",
          "[contact][errors]") {
    using Catch::Matchers::Contains;
    const auto at_height = [](double z) { return [z](double, double) { return z; }; };
    const auto two = together(sheet(10, 0, true, at_height(0.0)), sheet(10, 1, false, at_height(0.001)));
    const auto three = together(two, sheet(10, 2, false, at_height(0.002)));
    const auto u_of_two = at_rest(two), u = at_rest(three);
    contact::CandidateSearch<3> of_two(two.view(), {.skin = 0.01});
    of_two.search(u_of_two, u_of_two);
    const auto n = static_cast<std::int64_t>(of_two.candidates().size());
    contact::CandidateSearch<3> search(three.view(), {.skin = 0.01, .limits = {.pairs = n + 1}});
    CHECK_THROWS_WITH(search.search(u, u), Contains(" 1 are allowed") && Contains("Beside them " + std::to_string(n)));
    CHECK_FALSE(search.is_valid_for(0.0));
    CHECK(search.candidates().empty());
}

TEST_CASE("options of a search that are no good are refused by name", "[contact][errors]") {
    using Catch::Matchers::Contains;
    const auto surface = sheet(2, 0, true, [](double, double) { return 0.0; });
    const auto with = [&](const contact::CandidateOptions& options) {
        contact::CandidateSearch<3>(surface.view(), options);
    };
    const double no_number = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(with({.facing_cosine = -1.0}), Contains("facing_cosine"));
    CHECK_THROWS_WITH(with({.facing_cosine = 1.01}), Contains("facing_cosine"));
    CHECK_THROWS_WITH(with({.distance = -1.0}), Contains("distance"));
    CHECK_THROWS_WITH(with({.distance = no_number}), Contains("distance"));
    CHECK_THROWS_WITH(with({.skin = -1.0}), Contains("skin"));
    CHECK_THROWS_WITH(with({.self_contact_rings = -1}), Contains("self_contact_rings"));
    CHECK_THROWS_WITH(with({.largest_motion = 0.0}), Contains("largest_motion"));
    CHECK_THROWS_WITH(with({.largest_motion = no_number}), Contains("largest_motion"));
}
