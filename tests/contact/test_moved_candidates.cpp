// The list of candidates of faces that turn and deform.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "abut/base/rotation.hpp"
#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "contact/turning.hpp"

using namespace abut;
using namespace abut::test;
using contact::GapOf;
using geometry::BroadPhase;
using geometry::IndexPair;

namespace {

using List = std::vector<IndexPair>;

template <int Dim>
List moved_candidates_of(const contact::Surface<Dim>& surface, const Points<Dim>& x_0, const Points<Dim>& x_1,
                         contact::CandidateOptions options, double skin, GapOf gap = GapOf::overlap) {
    options.skin = skin > 0.0 ? skin : 1e-300;
    contact::CandidateSearch<Dim> search(surface.view(), options);
    search.search_moved(x_0, x_1, gap);
    return {search.candidates().begin(), search.candidates().end()};
}

bool holds(const List& list, IndexPair pair) { return std::binary_search(list.begin(), list.end(), pair); }

template <int Dim>
double twice_depth(const contact::Surface<Dim>& surface, IndexPair pair) {
    double depth = 0.0;
    for (const std::int32_t face : {pair.first, pair.second})
        if (surface.stiffness[face] != rigid) depth += surface.cell_depth[face];
    return 2.0 * depth;
}

template <int Dim>
bool both_rigid(const contact::Surface<Dim>& surface, IndexPair pair) {
    return surface.stiffness[pair.first] == rigid && surface.stiffness[pair.second] == rigid;
}

/// Pairs that face each other and whose heights over one another, at random points, are less than what the list promises.
template <int Dim>
List pairs_by_height(std::mt19937& random, const contact::Surface<Dim>& now, double distance) {
    List found;
    for (const IndexPair pair : all_pairs(now)) {
        const Vector<Dim>&n_1 = now.normal[pair.first], &n_2 = now.normal[pair.second];
        if (both_rigid(now, pair) || n_1.dot(n_2) >= -0.2) continue;
        Points<Dim> face_1, face_2;
        for (const std::int32_t v : now.view().vertices_of(pair.first)) face_1.push_back(now.vertices[v]);
        for (const std::int32_t v : now.view().vertices_of(pair.second)) face_2.push_back(now.vertices[v]);
        const Vector<Dim> n = (n_1 - n_2).normalized();
        for (int sample = 0; sample < 10; ++sample) {
            const double g = height_over(random_point<Dim>(random, face_1), n, face_2);
            if (!(std::abs(g) < distance + twice_depth(now, pair))) continue;
            found.push_back(pair);
            break;
        }
    }
    return found;
}

/// Pairs that face each other, overlap, and have so small a gap between their centroids.
template <int Dim>
List pairs_by_centroids(const contact::Surface<Dim>& now, double distance) {
    const auto pairs = all_pairs(now);
    const Points<Dim> none(static_cast<std::size_t>(now.size()), Vector<Dim>::Zero());
    List found;
    for (const auto& overlap : contact::find_overlaps<Dim>(now.view(), none, pairs).found) {
        const IndexPair pair{overlap.face_1, overlap.face_2};
        if (both_rigid(now, pair) || now.normal[pair.first].dot(now.normal[pair.second]) >= -0.2) continue;
        if (std::abs(overlap.gap) < distance + twice_depth(now, pair)) found.push_back(pair);
    }
    return found;
}

/// Two bodies of random faces and two rigid plates.
template <int Dim>
contact::Surface<Dim> random_scene(std::mt19937& random) {
    auto surface = random_surface<Dim>(random, Dim == 2 ? 8 : 12, 0.45, 1.5);
    for (double& depth : surface.cell_depth) depth *= 0.2;
    for (const double sign : {1.0, -1.0})
        contact::append(
            surface,
            contact::plane_obstacle<Dim>(random_vector<Dim>(random, 0.3), sign * up<Dim>(), uniform(random, 0.5, 5.0)),
            sign > 0 ? 2 : 3);
    return surface;
}

struct Tally {
    int required = 0;
    int without_need = 0;  ///< of them, held by the other list as well
};

template <int Dim>
void check_all_held(const List& required, const List& list, const List& other, Tally& tally) {
    for (const IndexPair pair : required) {
        ++tally.required;
        tally.without_need += holds(other, pair) ? 1 : 0;
        if (!holds(list, pair)) FAIL("pair " << pair.first << ", " << pair.second << " is missed");
    }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "a list of moved vertices holds every facing pair that is near over a common point at any time of "
    "the step, turned and deformed",
    "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(21);
    const double distance = GENERATE(0.0, 0.3);
    Tally tally;
    for (int trial = 0; trial < 30; ++trial) {
        const auto surface = random_scene<Dim>(random);
        const auto x_0 = turned_and_deformed(random, surface, 1.0, 1.0, 0.2);
        const auto x_1 = turned_and_deformed(random, surface, 1.0, 1.0, 0.2);
        const auto found = moved_candidates_of<Dim>(surface, x_0, x_1, {.distance = distance}, 0.0);
        const auto at_start = moved_candidates_of<Dim>(surface, x_0, x_0, {.distance = distance}, 0.0);
        for (int sample = 0; sample <= 20; ++sample) {
            const auto now = rebuilt(surface, between<Dim>(x_0, x_1, sample / 20.0));
            check_all_held<Dim>(pairs_by_height<Dim>(random, now, distance), found, at_start, tally);
        }
    }
    CHECK(tally.required > 1000);
    CHECK(tally.without_need < tally.required);  // the motion has brought some together
}

TEMPLATE_TEST_CASE_SIG(
    "a list of moved vertices with gaps between centroids holds every facing pair that overlaps at any "
    "time of the step, and more than one with gaps over common points",
    "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(22);
    Tally tally;
    std::size_t more = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const auto surface = random_scene<Dim>(random);
        const auto x_0 = turned_and_deformed(random, surface, 1.0, 1.0, 0.2);
        const auto x_1 = turned_and_deformed(random, surface, 1.0, 1.0, 0.2);
        const auto found = moved_candidates_of<Dim>(surface, x_0, x_1, {}, 0.0, GapOf::centroids);
        const auto over_points = moved_candidates_of<Dim>(surface, x_0, x_1, {}, 0.0, GapOf::overlap);
        CHECK(std::ranges::includes(found, over_points));
        more += found.size() - over_points.size();
        for (int sample = 0; sample <= 20; ++sample) {
            const auto now = rebuilt(surface, between<Dim>(x_0, x_1, sample / 20.0));
            check_all_held<Dim>(pairs_by_centroids<Dim>(now, 0.0), found, over_points, tally);
        }
    }
    CHECK(tally.required > 1000);
    CHECK(more > 0);
}

TEST_CASE("tilted faces without a gap between centroids can be farther apart than all their depth",
          "[contact][candidates]") {
    // Two segments, n_1 = (0, 1), n_2 = (-cos a, -sin a) with sin a = 0.25: n_1 . n_2 = -0.25. The second, a little smaller,
    // has its middle on the line through that of the first across the mean normal, and its near end over its left end.
    const double sine = 0.25, cosine = std::sqrt(1.0 - sine * sine);
    const Vector<2> n_1(0.0, 1.0), n_2(-cosine, -sine), n = (n_1 - n_2).normalized(), t(-n[1], n[0]);
    contact::Surface<2> surface;
    surface.append(std::vector<Vector<2>>{{1.0, 0.0}, {-1.0, 0.0}}, 1e-3, 1.0, 0);
    const Vector<2> middle = 1.49 * t, along = 0.9 * Vector<2>(-n_2[1], n_2[0]);
    surface.append(std::vector<Vector<2>>{middle - along, middle + along}, 1e-3, 1.0, 1);
    const Points<2> none(2, Vector<2>::Zero());
    const auto overlaps = contact::find_overlaps<2>(surface.view(), none, all_pairs(surface));
    REQUIRE(overlaps.found.size() == 1);
    REQUIRE(overlaps.found[0].gap == Approx(0.0).margin(1e-12));
    const auto& x = surface.vertices;
    CHECK(moved_candidates_of<2>(surface, x, x, {}, 0.0, GapOf::overlap).empty());
    CHECK(moved_candidates_of<2>(surface, x, x, {}, 0.0, GapOf::centroids).size() == 1);
}

TEMPLATE_TEST_CASE_SIG("a list of moved vertices stays a superset while no vertex is farther than half the skin",
                       "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(23);
    const double skin = 0.2;
    Tally over_points, between_centroids;
    for (int trial = 0; trial < 60; ++trial) {
        contact::Surface<Dim> surface;  // segments and triangles only: they stay flat
        for (const auto scene = random_scene<Dim>(random); const std::int32_t body : {0, 1})
            for (std::int32_t face = 0; face < scene.size(); ++face)
                if (scene.body[face] == body) {
                    Points<Dim> corners;
                    for (const std::int32_t v : scene.view().vertices_of(face).first(Dim))
                        corners.push_back(scene.vertices[v]);
                    surface.append(corners, scene.cell_depth[face], 1.0, body);
                }
        const auto x_0 = turned_and_deformed(random, surface, 1.0, 1.0, 0.2);
        const auto list = moved_candidates_of<Dim>(surface, x_0, x_0, {}, skin);
        const auto bare = moved_candidates_of<Dim>(surface, x_0, x_0, {}, 0.0);
        const auto list_c = moved_candidates_of<Dim>(surface, x_0, x_0, {}, skin, GapOf::centroids);
        for (int sample = 0; sample < 20; ++sample) {
            auto x = x_0;
            for (Vector<Dim>& moved : x) moved += 0.5 * skin * random_vector<Dim>(random, 1.0).normalized();
            const auto now = rebuilt(surface, x);
            check_all_held<Dim>(pairs_by_height<Dim>(random, now, 0.0), list, bare, over_points);
            check_all_held<Dim>(pairs_by_centroids<Dim>(now, 0.0), list_c, list_c, between_centroids);
        }
    }
    CHECK(over_points.required > 1000);
    CHECK(over_points.without_need < over_points.required);  // some only the skin has kept
    CHECK(between_centroids.required > 1000);
}

TEMPLATE_TEST_CASE_SIG("every broad phase and any number of threads give the same list of moved vertices",
                       "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(24);
    for (int trial = 0; trial < 4; ++trial) {  // of enough faces that threads share them
        const auto surface = random_surface<Dim>(random, 1100, 0.45, Dim == 2 ? 50.0 : 15.0);
        const auto x_0 = turned_and_deformed(random, surface, 1.0, 1.0, 0.2);
        const auto x_1 = turned_and_deformed(random, surface, 1.0, 1.0, 0.2);
        contact::CandidateOptions options;
        options.self_contact = trial % 2 == 1;
        std::vector<List> lists;
        for (const BroadPhase method : geometry::broad_phases()) {
            options.broad_phase = method;
            lists.push_back(moved_candidates_of<Dim>(surface, x_0, x_1, options, 0.05));
        }
        for (const int threads : {1, 3}) {
            const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(threads));
            tbb::task_arena arena(threads);
            arena.execute([&] { lists.push_back(moved_candidates_of<Dim>(surface, x_0, x_1, options, 0.05)); });
        }
        for (const List& list : lists) CHECK(list == lists.back());
        CHECK(lists[0].size() > 50);
        CHECK(std::is_sorted(lists[0].begin(), lists[0].end()));
        CHECK(std::adjacent_find(lists[0].begin(), lists[0].end()) == lists[0].end());
    }
}

TEMPLATE_TEST_CASE_SIG(
    "where nothing turns and no normal counts, both ways to search give one list: neighbours, rigid faces "
    "and one's own body included",
    "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(25);
    const bool self_contact = GENERATE(false, true);
    for (int trial = 0; trial < 20; ++trial) {
        const auto surface = random_scene<Dim>(random);
        const auto u_0 = random_displacement(random, surface, 1.0), u_1 = random_displacement(random, surface, 1.0);
        Points<Dim> x_0 = surface.vertices, x_1 = surface.vertices;  // every vertex is of one face
        for (std::int32_t face = 0; face < surface.size(); ++face)
            for (const std::int32_t v : surface.view().vertices_of(face)) {
                x_0[v] += u_0[static_cast<std::size_t>(face)];
                x_1[v] += u_1[static_cast<std::size_t>(face)];
            }
        const contact::CandidateOptions options{
            .facing_cosine = 1.0, .distance = 0.2, .skin = 0.1, .self_contact = self_contact};
        contact::CandidateSearch<Dim> translated(surface.view(), options), moved(surface.view(), options);
        translated.search(u_0, u_1);
        moved.search_moved(x_0, x_1);
        CHECK(std::ranges::equal(moved.candidates(), translated.candidates()));
        CHECK(moved.report().box_pairs == translated.report().box_pairs);
        CHECK(moved.report().both_rigid == translated.report().both_rigid);
        CHECK(moved.report().neighbours == translated.report().neighbours);
        CHECK(moved.report().motion == Approx(translated.report().motion));
    }
}

TEST_CASE(
    "a face that turns towards another is in the list of moved vertices before it does, and not in one of rest normals",
    "[contact][candidates]") {
    contact::Surface<3> surface;
    surface.append(tile<3>(Vector<3>::Zero(), up<3>(), 0.5), 0.1, 1.0, 0);
    surface.append(tile<3>(Vector<3>(0.0, 0.0, 0.6), -axis<3>(0), 0.5), 0.1, 1.0, 1);
    const contact::CandidateOptions options{.distance = 0.5, .skin = 1.0};
    Points<3> turned = surface.vertices;
    const Matrix<3> tip = rotation_about(Vector<3>::UnitY(), -0.25 * std::numbers::pi);
    for (std::size_t v = 4; v < 8; ++v)
        turned[v] = Vector<3>(0.0, 0.0, 0.6) + Vector<3>(tip * (surface.vertices[v] - Vector<3>(0.0, 0.0, 0.6)));
    double motion = 0.0;
    for (std::size_t v = 0; v < 8; ++v) motion = std::max(motion, (turned[v] - surface.vertices[v]).norm());
    const auto now = rebuilt(surface, turned);
    REQUIRE(now.normal[0].dot(now.normal[1]) < -0.7);
    const auto required = pairs_by_centroids<3>(now, 0.5);
    REQUIRE(required.size() == 1);

    contact::CandidateSearch<3> translated(surface.view(), options), moved(surface.view(), options);
    translated.search(at_rest(surface), at_rest(surface));
    moved.search_moved(surface.vertices, surface.vertices);
    CHECK(translated.is_valid_for(0.5));
    CHECK(motion < 0.6);
    CHECK(translated.candidates().empty());
    CHECK(moved.candidates().size() == 1);
    contact::CandidateSearch<3> along(surface.view(), {.distance = 0.5, .skin = 1e-6});
    along.search_moved(surface.vertices, turned);
    CHECK(along.candidates().size() == 1);
    CHECK(along.report().motion == Approx(motion).epsilon(1e-14));
}

TEST_CASE("positions may lie as a host keeps them, and vertices that no face names may hold anything",
          "[contact][candidates]") {
    std::mt19937 random(26);
    auto surface = random_surface<3>(random, 20);
    const double no_number = std::numeric_limits<double>::quiet_NaN();
    surface.vertices.push_back(Vector<3>::Constant(no_number));
    const auto x_0 = turned_and_deformed(random, surface, 1.0, 1.0, 0.2);
    const auto x_1 = turned_and_deformed(random, surface, 1.0, 1.0, 0.2);
    const auto n = static_cast<std::int32_t>(x_0.size());
    std::vector<double> by_component;
    for (int i = 0; i < 3; ++i)
        for (const Vector<3>& x : x_0) by_component.push_back(x[i]);
    contact::CandidateSearch<3> search(surface.view(), {.skin = 0.1});
    search.search_moved({by_component.data(), n, 1, n}, x_1);
    CHECK(std::ranges::equal(search.candidates(), moved_candidates_of<3>(surface, x_0, x_1, {}, 0.1)));
}

TEMPLATE_TEST_CASE_SIG("a vertex that is not finite, or moves beyond all measure within a step, is refused by name",
                       "[contact][errors]", ((int Dim), Dim), 2, 3) {
    using Catch::Matchers::Contains;
    contact::Surface<Dim> surface;
    for (int i = 0; i < 5; ++i)
        surface.append(tile<Dim>(Vector<Dim>(static_cast<double>(i) * axis<Dim>(0)), up<Dim>(), 0.5), 0.1, 1.0, 0);
    const auto& x = surface.vertices;
    const std::int32_t vertex = surface.face_vertices[static_cast<std::size_t>(surface.face_offsets[3] + 1)];
    const auto named = Contains("vertex " + std::to_string(vertex) + " of face 3");
    contact::CandidateSearch<Dim> search(surface.view(), {});
    search.search_moved(x, x);
    REQUIRE(search.is_valid_for(0.0));
    auto bad = x;
    bad[vertex] = 1e9 * up<Dim>();
    CHECK_THROWS_WITH(search.search_moved(x, bad), named && Contains("1e+09") && Contains("largest_motion"));
    CHECK_THROWS_AS(search.search_moved(x, bad), Diverged);
    CHECK_FALSE(search.is_valid_for(0.0));
    CHECK(search.candidates().empty());
    bad[vertex] = Vector<Dim>::Constant(std::numeric_limits<double>::infinity());
    CHECK_THROWS_WITH(search.search_moved(x, bad), named && Contains("not finite"));
    bad[vertex] = Vector<Dim>::Constant(std::numeric_limits<double>::quiet_NaN());
    CHECK_THROWS_WITH(search.search_moved(bad, x), named && Contains("not finite"));
    CHECK_THROWS_WITH(search.search_moved(bad, bad), named && Contains("not finite"));
    bad[vertex] = x[vertex] + Vector<Dim>(4.0 * up<Dim>());  // less than the five faces are long
    CHECK_NOTHROW(search.search_moved(x, bad));
    bad.pop_back();
    CHECK_THROWS_AS(search.search_moved(x, bad), BadInput);
    CHECK_THROWS_WITH(search.search_moved(bad, x), Contains("one each"));
    CHECK_FALSE(search.is_valid_for(0.0));
}

TEST_CASE("more pairs of moved faces than allowed are an error, and leave no list", "[contact][errors]") {
    std::mt19937 random(27);
    const auto surface = random_surface<3>(random, 30);
    const auto& x = surface.vertices;
    const auto n = static_cast<std::int64_t>(moved_candidates_of<3>(surface, x, x, {}, 0.01).size());
    contact::CandidateSearch<3> tight(surface.view(), {.skin = 0.01, .limits = {.pairs = n - 1}});
    CHECK_THROWS_AS(tight.search_moved(x, x), geometry::SearchLimitError);
    CHECK_FALSE(tight.is_valid_for(0.0));
    CHECK(tight.candidates().empty());
}
