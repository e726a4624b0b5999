// Overlaps of faces whose vertices have moved.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>

#include "abut/contact/overlap/overlaps.hpp"
#include "contact/turning.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Matchers::Contains;
using geometry::AreaMethod;
using geometry::IndexPair;

namespace {

template <int Dim>
contact::Overlaps<Dim> by_hand(const contact::Surface<Dim>& surface, const Points<Dim>& x,
                               const std::vector<IndexPair>& pairs, AreaMethod method) {
    const auto moved = rebuilt(surface, x);
    return contact::find_overlaps<Dim>(moved.view(), at_rest(moved), pairs, method);
}

template <int Dim>
bool same_bits(const contact::Overlaps<Dim>& a, const contact::Overlaps<Dim>& b) {
    const auto counts = [](const contact::OverlapReport& r) {
        return std::array{r.pairs,
                          r.overlaps,
                          r.not_facing,
                          r.decided.by_doubles,
                          r.decided.by_scalar_path,
                          r.decided.by_exact_arithmetic};
    };
    return counts(a.report) == counts(b.report) && a.found.size() == b.found.size() &&
           std::ranges::equal(a.found, b.found,
                              [](const auto& p, const auto& q) { return std::memcmp(&p, &q, sizeof p) == 0; });
}

/// Faces of all kinds, rigid ones among them.
template <int Dim>
contact::Surface<Dim> random_faces(std::mt19937& random, int faces_per_body) {
    auto surface = random_surface<Dim>(random, faces_per_body, 0.45, 1.5);
    for (std::int32_t face = 3; face < surface.size(); face += 7) surface.stiffness[face] = rigid;
    return surface;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("overlaps of moved vertices have the bits of a surface that was rebuilt",
                       "[contact][overlaps][moved]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(31);
    const AreaMethod method = GENERATE(AreaMethod::fast, AreaMethod::exact);
    const int size = method == AreaMethod::fast ? 60 : 12;
    std::size_t found = 0;
    for (int trial = 0; trial < 10; ++trial) {
        auto surface = random_faces<Dim>(random, size);
        if (trial % 2 == 0) surface.steps_to_sharp_edge.clear();
        const auto x = turned_and_deformed(random, surface, 1.0, 0.5, 0.2);
        auto pairs = all_pairs(surface);
        std::ranges::shuffle(pairs, random);
        const auto overlaps = contact::find_overlaps_moved<Dim>(surface.view(), x, pairs, method);
        CHECK(same_bits(overlaps, by_hand(surface, x, pairs, method)));
        found += overlaps.found.size();
    }
    CHECK(found > 100);
}

TEMPLATE_TEST_CASE_SIG("patches of moved vertices have the bits of a surface that was rebuilt", "[contact][overlaps][moved]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(32);
    const auto surface = random_faces<Dim>(random, 20);
    const auto x = turned_and_deformed(random, surface, 1.0, 0.5, 0.2);
    const auto pairs = all_pairs(surface);
    const auto moved = rebuilt(surface, x);
    const auto patches = contact::overlap_polygons_moved<Dim>(surface.view(), x, pairs);
    CHECK(patches == contact::overlap_polygons<Dim>(moved.view(), at_rest(moved), pairs));
    CHECK(std::ranges::count_if(patches, [](const auto& patch) { return !patch.empty(); }) > 10);
}

TEMPLATE_TEST_CASE_SIG("any number of threads, any layout of positions and memory used again give the same bits",
                       "[contact][overlaps][moved]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(33);
    const auto surface = random_faces<Dim>(random, 1200);  // of enough faces that threads share them
    const auto x = turned_and_deformed(random, surface, 1.0, 0.5, 0.2);
    std::vector<IndexPair> pairs;
    for (std::int32_t i = 0; i < 1200; ++i)
        for (std::int32_t j = 0; j < 8; ++j) pairs.push_back({i, 1200 + (17 * i + j) % 1200});
    const auto n = static_cast<std::int32_t>(x.size());
    std::vector<double> by_component;
    for (int i = 0; i < Dim; ++i)
        for (const Vector<Dim>& point : x) by_component.push_back(point[i]);
    const auto expected = by_hand(surface, x, pairs, AreaMethod::fast);
    contact::Overlaps<Dim> overlaps;
    for (const int threads : {1, 2, 5}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
        tbb::task_arena arena(threads);
        arena.execute([&] {
            contact::find_overlaps_moved<Dim>(surface.view(), PointsView<Dim>(by_component.data(), n, 1, n), pairs,
                                              AreaMethod::fast, overlaps);
        });
        CHECK(same_bits(overlaps, expected));
    }
    CHECK(expected.found.size() > 100);
}

TEMPLATE_TEST_CASE_SIG("two unit tiles turned together by any angle and shifted by s share 1 - s",
                       "[contact][overlaps][moved]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(34);
    const double s = GENERATE(0.0, 0.25, 1.0 - 1e-9);
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.3, 1.0, 0);
    surface.append(tile<Dim>(0.1 * up<Dim>(), -up<Dim>(), 0.5), 0.3, 1.0, 1);
    for (int trial = 0; trial < 20; ++trial) {
        const Matrix<Dim> by = turn<Dim>(random, 3.0);
        auto x = surface.vertices;
        for (std::size_t v = x.size() / 2; v < x.size(); ++v) x[v] += s * axis<Dim>(0);
        for (Vector<Dim>& point : x) point = Vector<Dim>(by * point);
        const auto overlaps = contact::find_overlaps_moved<Dim>(surface.view(), x, std::vector<IndexPair>{{0, 1}});
        REQUIRE(overlaps.found.size() == 1);
        CHECK(overlaps.found[0].area == Approx(1.0 - s).epsilon(1e-14 / (1.0 - s)));
        CHECK(overlaps.found[0].gap == Approx(0.1).epsilon(1e-14));
        CHECK((overlaps.found[0].normal - Vector<Dim>(by * up<Dim>())).norm() < 1e-14);
    }
}

TEMPLATE_TEST_CASE_SIG("a face that collapses as it moves shares nothing, and its pairs are counted as not facing",
                       "[contact][overlaps][moved]", ((int Dim), Dim), 2, 3) {
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.3, 1.0, 0);
    surface.append(tile<Dim>(0.1 * up<Dim>(), -up<Dim>(), 0.5), 0.3, 1.0, 1);
    const std::vector<IndexPair> pair{{0, 1}};
    auto x = surface.vertices;
    for (std::size_t v = x.size() / 2; v < x.size(); ++v) x[v] = up<Dim>();
    const auto point = contact::find_overlaps_moved<Dim>(surface.view(), x, pair);
    CHECK(point.found.empty());
    CHECK(point.report.not_facing == 1);
    CHECK(contact::overlap_polygons_moved<Dim>(surface.view(), x, pair)[0].empty());
    for (std::size_t v = x.size() / 2; v < x.size(); ++v) x[v] = static_cast<double>(v) * axis<Dim>(0);
    if (Dim == 3) CHECK(contact::find_overlaps_moved<Dim>(surface.view(), x, pair).report.not_facing == 1);
}

TEST_CASE("a quadrangle that warps a little gives area and gap to first order in the warp", "[contact][overlaps][moved]") {
    contact::Surface<3> surface;
    surface.append(tile<3>(Vector<3>::Zero(), up<3>(), 0.5), 0.3, 1.0, 0);
    surface.append(tile<3>(0.1 * up<3>(), -up<3>(), 0.5), 0.3, 1.0, 1);
    for (const double warp : {1e-3, 1e-2, 1e-1}) {
        auto x = surface.vertices;
        x[5] += warp * up<3>();
        const auto overlaps = contact::find_overlaps_moved<3>(surface.view(), x, std::vector<IndexPair>{{0, 1}});
        REQUIRE(overlaps.found.size() == 1);
        CHECK(std::abs(overlaps.found[0].area - 1.0) <= warp);
        CHECK(std::abs(overlaps.found[0].gap - 0.1) <= warp);
    }
}

TEMPLATE_TEST_CASE_SIG("positions that are no good are refused with the face and the vertex, if a pair names them",
                       "[contact][errors][moved]", ((int Dim), Dim), 2, 3) {
    contact::Surface<Dim> surface;
    for (int body = 0; body < 4; ++body)
        surface.append(tile<Dim>(0.1 * body * up<Dim>(), (body % 2 == 0 ? 1.0 : -1.0) * up<Dim>(), 0.5), 0.3, 1.0, body);
    const auto view = surface.view();
    const std::vector<IndexPair> pairs{{0, 1}, {2, 1}};
    const std::int32_t vertex = view.vertices_of(2)[1], unnamed = view.vertices_of(3)[0];
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        auto x = surface.vertices;
        x[unnamed][0] = bad;
        CHECK(contact::find_overlaps_moved<Dim>(view, x, pairs).report.pairs == 2);
        x[vertex][0] = bad;
        const std::string named = "vertex " + std::to_string(vertex) + " of face 2";
        CHECK_THROWS_WITH(contact::find_overlaps_moved<Dim>(view, x, pairs), Contains(named) && Contains("not finite"));
        CHECK_THROWS_AS(contact::find_overlaps_moved<Dim>(view, x, pairs), Diverged);
        CHECK_THROWS_WITH(contact::overlap_polygons_moved<Dim>(view, x, pairs), Contains(named) && Contains("not finite"));
    }
    auto x = surface.vertices;
    x[vertex] = Vector<Dim>::Constant(1.7e308);
    x[view.vertices_of(2)[0]] = Vector<Dim>::Constant(-1.7e308);
    CHECK_THROWS_AS(contact::find_overlaps_moved<Dim>(view, x, pairs), Diverged);
    if constexpr (Dim == 3) {
        x = surface.vertices;
        x[vertex] = surface.centroid[2] + 0.5 * (surface.centroid[2] - x[vertex]);  // past the diagonal
        CHECK_THROWS_WITH(contact::find_overlaps_moved<Dim>(view, x, pairs), Contains("face 2") && Contains("not convex"));
    }
    x = surface.vertices;
    CHECK_THROWS_WITH(contact::find_overlaps_moved<Dim>(view, x, std::vector<IndexPair>{{0, 4}}), Contains("face 4"));
    CHECK_THROWS_WITH(contact::find_overlaps_moved<Dim>(view, x, std::vector<IndexPair>{{-1, 0}}), Contains("face -1"));
    x.pop_back();
    CHECK_THROWS_WITH(contact::find_overlaps_moved<Dim>(view, x, pairs), Contains("one each"));
    CHECK_THROWS_AS(contact::overlap_polygons_moved<Dim>(view, x, pairs), BadInput);
}
