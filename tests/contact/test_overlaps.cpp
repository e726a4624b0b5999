#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <catch2/catch.hpp>
#include <cstring>

#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/pairs/pair_list.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Matchers::Contains;
using geometry::AreaMethod;
using geometry::IndexPair;

namespace {

template <int Dim>
contact::Overlaps<Dim> find(const contact::Surface<Dim>& surface, const std::vector<Vector<Dim>>& u,
                            const std::vector<IndexPair>& pairs, AreaMethod method = AreaMethod::fast) {
    return contact::find_overlaps<Dim>(surface.view(), u, pairs, method);
}

// A wavy sheet over the unit square: n x n cells, two triangles each, looking up (body 0) or down (body 1).
Vector<3> on_sheet(double x, double y) { return {x, y, 0.1 * std::sin(3.0 * x) * std::cos(2.0 * y)}; }

void append_sheet(contact::Surface<3>& surface, int n, int body, double turn = 0.0) {
    const auto point = [&](int i, int j) {
        const double x = static_cast<double>(i) / n - 0.5, y = static_cast<double>(j) / n - 0.5;
        return on_sheet(std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y);
    };
    const auto append = [&](const Vector<3>& a, const Vector<3>& b, const Vector<3>& c) {
        const std::array<Vector<3>, 3> up{a, b, c}, down{a, c, b};
        surface.append(body == 0 ? up : down, 0.1, 1.0, body);
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            append(point(i, j), point(i + 1, j), point(i + 1, j + 1));
            append(point(i, j), point(i + 1, j + 1), point(i, j + 1));
        }
}

template <int Dim>
std::array<Vector<Dim>, Dim> random_corners(std::mt19937& random, bool upward) {
    std::array<Vector<Dim>, Dim> corners;
    if constexpr (Dim == 2) {
        corners = {Vector<2>(uniform(random, -1, 0), uniform(random, -0.1, 0.1)),
                   Vector<2>(uniform(random, 0, 1), uniform(random, -0.1, 0.1))};
    } else {
        for (int i = 0; i < 3; ++i) {
            const double angle = i * 2.0 + uniform(random, 0, 1);
            corners[i] = {std::cos(angle), std::sin(angle), uniform(random, -0.1, 0.1)};
        }
    }
    // In 2D the outside is on the right of the way from the first to the second.
    if ((Dim == 3) != upward) std::swap(corners[0], corners[1]);
    const Vector<Dim> place = random_vector<Dim>(random, 0.5);
    for (auto& corner : corners) corner += place;
    return corners;
}

template <int Dim>
contact::Surface<Dim> random_triangles(std::mt19937& random, int faces_a_body) {
    contact::Surface<Dim> surface;
    for (int body = 0; body < 2; ++body)
        for (int i = 0; i < faces_a_body; ++i)
            surface.append(random_corners<Dim>(random, body == 0), 0.5, i % 7 == 3 && body == 1 ? rigid : 1.0, body);
    return surface;
}

template <int Dim>
bool same_bits(const contact::Overlap<Dim>& a, const contact::Overlap<Dim>& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

double polygon_area(const std::vector<Vector<3>>& corners, const Vector<3>& normal) {
    Vector<3> twice = Vector<3>::Zero();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        twice += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
    return 0.5 * twice.dot(normal);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("two unit tiles shifted by s share 1 - s; the gap is their distance", "[contact][overlaps]",
                       ((int Dim), Dim), 2, 3) {
    const double s = GENERATE(0.0, 0.25, 1.0 - 1e-9, 1.0, 1.5);
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.3, 1.0, 0);
    surface.append(tile<Dim>(0.1 * up<Dim>(), -up<Dim>(), 0.5), 0.3, 1.0, 1);
    const std::vector<Vector<Dim>> u{Vector<Dim>::Zero(), Vector<Dim>(s * axis<Dim>(0) - 0.3 * up<Dim>())};
    const auto overlaps = find<Dim>(surface, u, {{0, 1}}, GENERATE(AreaMethod::fast, AreaMethod::exact));
    REQUIRE(overlaps.found.size() == (s < 1.0 ? 1u : 0u));
    if (s >= 1.0) return;
    const auto& overlap = overlaps.found[0];
    CHECK(overlap.area == Approx(1.0 - s).epsilon(1e-15 / (1.0 - s)));
    CHECK(overlap.gap == Approx(-0.2).epsilon(1e-14));
    CHECK((overlap.normal - up<Dim>()).norm() < 1e-15);
    CHECK((overlap.area_gradient + (s > 0.0 ? 1.0 : 0.0) * axis<Dim>(0)).norm() < 1e-14);
}

TEMPLATE_TEST_CASE_SIG("every pair gives what it gives as a pair of the list of contacts", "[contact][overlaps]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(1);
    for (const bool triangles : {true, false}) {
        const auto surface = triangles ? random_triangles<Dim>(random, 40) : random_surface<Dim>(random, 40);
        const auto u = random_displacement(random, surface, 0.3);
        const auto view = surface.view();
        const auto pairs = all_pairs(surface);
        const auto overlaps = find(surface, u, pairs);
        std::size_t n = 0;
        double difference = 0.0;
        for (const auto& [i, j] : pairs) {
            contact::PairList<Dim> list;
            list.append(view, i, j, contact::InterfaceWeighting::half);
            const auto& pair = list.pairs()[0];
            const auto position = list.position(view, pair, u[i], u[j]);
            const auto shared = list.overlap(pair, position.tangential_offset, AreaMethod::fast);
            if (shared.area == 0.0) continue;
            REQUIRE(n < overlaps.found.size());
            const auto& overlap = overlaps.found[n++];
            REQUIRE(overlap.face_1 == i);
            REQUIRE(overlap.face_2 == j);
            const Vector<Dim> derivative = pair.frame.lift(shared.area_gradient);
            difference = std::max({difference, std::abs(overlap.area - shared.area), std::abs(overlap.gap - position.gap),
                                   (overlap.normal - pair.frame.normal()).norm(),
                                   1e-4 * (overlap.area_gradient - derivative).norm()});
        }
        CHECK(n == overlaps.found.size());
        CHECK(n > 500);
        CHECK(difference < 4e-15);
    }
}

TEMPLATE_TEST_CASE_SIG("swapping the faces reverses normal and derivative and changes nothing else", "[contact][overlaps]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(2);
    const auto surface = random_triangles<Dim>(random, 30);
    const auto u = random_displacement(random, surface, 0.3);
    auto pairs = all_pairs(surface);
    const auto overlaps = find(surface, u, pairs);
    for (IndexPair& pair : pairs) std::swap(pair.first, pair.second);
    const auto swapped = find(surface, u, pairs);
    REQUIRE(swapped.found.size() == overlaps.found.size());
    for (std::size_t k = 0; k < overlaps.found.size(); ++k) {
        const auto &one = overlaps.found[k], &other = swapped.found[k];
        CHECK(std::abs(one.area - other.area) < 2e-15);
        CHECK(std::abs(one.gap - other.gap) < 1e-15);
        CHECK((one.normal + other.normal).norm() < 1e-15);
        CHECK((one.area_gradient + other.area_gradient).norm() < 1e-11);
    }
}

TEST_CASE("the overlaps of two triangulations of one square add up to the square", "[contact][overlaps]") {
    contact::Surface<3> surface;
    append_sheet(surface, 5, 0);
    append_sheet(surface, 7, 1);
    for (Vector<3>& v : surface.vertices) v.z() = 0.0;
    contact::Surface<3> flat;  // with the measures of flat faces
    for (std::int32_t f = 0; f < surface.size(); ++f) {
        std::vector<Vector<3>> corners;
        for (const std::int32_t v : surface.view().vertices_of(f)) corners.push_back(surface.vertices[v]);
        flat.append(corners, 0.1, 1.0, surface.body[f]);
    }
    const auto overlaps = find(flat, at_rest(flat), all_pairs(flat));
    double sum = 0.0;
    for (const auto& overlap : overlaps.found) sum += overlap.area;
    CHECK(sum == Approx(1.0).epsilon(1e-14));
}

TEST_CASE("on surfaces that match every face overlaps its partner alone, decided by doubles", "[contact][overlaps]") {
    contact::Surface<3> surface;
    append_sheet(surface, 8, 0);
    append_sheet(surface, 8, 1);
    std::vector<IndexPair> pairs;
    const int n = surface.size() / 2;
    for (int i = 0; i < n; ++i) pairs.push_back({i, n + i});
    const auto matching = find(surface, at_rest(surface), pairs);
    CHECK(matching.report.decided.by_doubles == n);
    REQUIRE(matching.report.overlaps == n);
    for (int i = 0; i < n; ++i) {
        CHECK(matching.found[i].area == Approx(surface.area[i]).epsilon(1e-14));
        CHECK(matching.found[i].area_gradient.norm() < 1e-15);
        CHECK(std::abs(matching.found[i].gap) < 1e-16);  // of centroids summed in another order
    }
    // Neighbours of a curved sheet have no common plane: their projections may overlap by little, or by rounding.
    const auto all = find(surface, at_rest(surface), all_pairs(surface));
    CHECK(all.report.decided.by_exact_arithmetic + all.report.decided.by_scalar_path < all.report.pairs / 10);
}

TEST_CASE("fast and exact find the same overlaps", "[contact][overlaps]") {
    contact::Surface<3> surface;
    append_sheet(surface, 4, 0);
    append_sheet(surface, GENERATE(4, 5), 1, GENERATE(0.0, 0.4));
    std::mt19937 random(3);
    auto u = at_rest(surface);
    if (GENERATE(false, true)) u = random_displacement(random, surface, 0.1);
    const auto pairs = all_pairs(surface);
    const auto fast = find(surface, u, pairs), exact = find(surface, u, pairs, AreaMethod::exact);
    CHECK(exact.report.decided.by_exact_arithmetic == exact.report.pairs);
    REQUIRE(fast.found.size() == exact.found.size());
    for (std::size_t k = 0; k < fast.found.size(); ++k) {
        CHECK(fast.found[k].face_1 == exact.found[k].face_1);
        CHECK(fast.found[k].face_2 == exact.found[k].face_2);
        CHECK(std::abs(fast.found[k].area - exact.found[k].area) < 1e-16);
    }
}

TEMPLATE_TEST_CASE_SIG("any number of threads gives the same bits", "[contact][overlaps]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(4);
    auto surface = random_triangles<Dim>(random, 70);
    for (int i = 0; i < 6; ++i)  // among them some that are not triangles
        surface.append(random_face<Dim>(random, Vector<Dim>::Zero(), -up<Dim>(), 0.5), 0.3, 1.0, 1);
    const auto u = random_displacement(random, surface, 0.3);
    std::vector<IndexPair> pairs;
    for (int i = 0; i < 3; ++i)
        for (const IndexPair& pair : all_pairs(surface)) pairs.push_back(pair);
    REQUIRE(pairs.size() > 8192);
    contact::Overlaps<Dim> alone;
    oneapi::tbb::task_arena(1).execute([&] { alone = find(surface, u, pairs); });
    for (const int threads : {2, 5}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        contact::Overlaps<Dim> together;
        oneapi::tbb::task_arena(threads).execute([&] { together = find(surface, u, pairs); });
        REQUIRE(together.found.size() == alone.found.size());
        bool is_same = true;
        for (std::size_t k = 0; k < alone.found.size(); ++k)
            is_same = is_same && same_bits(alone.found[k], together.found[k]);
        CHECK(is_same);
        CHECK(together.report.decided.by_doubles == alone.report.decided.by_doubles);
        CHECK(together.report.decided.by_scalar_path == alone.report.decided.by_scalar_path);
    }
    // and a pair does not care for the others
    for (std::size_t k = 0; k < alone.found.size(); k += 17) {
        const auto one = find<Dim>(surface, u, {{alone.found[k].face_1, alone.found[k].face_2}});
        REQUIRE(one.found.size() == 1);
        CHECK(same_bits(one.found[0], alone.found[k]));
    }
}

TEMPLATE_TEST_CASE_SIG("the counts of the report add up to the pairs", "[contact][overlaps]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(5);
    const auto surface = random_triangles<Dim>(random, 20);
    std::vector<IndexPair> pairs;  // of one body as well: these do not face each other
    for (std::int32_t i = 0; i < surface.size(); ++i)
        for (std::int32_t j = 0; j < surface.size(); ++j) pairs.push_back({i, j});
    const auto overlaps = find(surface, at_rest(surface), pairs);
    CHECK(overlaps.report.pairs == 1600);
    CHECK(overlaps.report.not_facing == 800);
    CHECK(overlaps.report.not_facing + overlaps.report.decided.total() == 1600);
    CHECK(overlaps.report.overlaps == static_cast<std::int64_t>(overlaps.found.size()));
    CHECK(find<Dim>(surface, at_rest(surface), {}).report.pairs == 0);
}

TEST_CASE("the polygon of a pair has its area, and lies halfway between the faces", "[contact][overlaps]") {
    std::mt19937 random(6);
    const auto surface = GENERATE(true, false) ? random_triangles<3>(random, 15) : random_surface<3>(random, 15);
    const auto u = random_displacement(random, surface, 0.3);
    const auto overlaps = find(surface, u, all_pairs(surface));
    REQUIRE(overlaps.found.size() > 50);
    std::vector<geometry::IndexPair> pairs;
    for (const auto& overlap : overlaps.found) pairs.push_back({overlap.face_1, overlap.face_2});
    const auto polygons = contact::overlap_polygons<3>(surface.view(), u, pairs);
    REQUIRE(polygons.size() == pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto& overlap = overlaps.found[i];
        const auto polygon = contact::overlap_polygon<3>(surface.view(), u, pairs[i]);
        CHECK(polygons[i] == polygon);
        CHECK(polygon_area(polygon, overlap.normal) == Approx(overlap.area).margin(1e-14));
        const Vector<3> c_1 = surface.centroid[overlap.face_1] + u[overlap.face_1],
                        c_2 = surface.centroid[overlap.face_2] + u[overlap.face_2];
        for (const Vector<3>& corner : polygon) {
            CHECK((corner - c_1).dot(overlap.normal) == Approx(0.5 * overlap.gap).margin(1e-14));
            CHECK((corner - c_2).dot(overlap.normal) == Approx(-0.5 * overlap.gap).margin(1e-14));
        }
    }
}

TEST_CASE("2D: the shared segment has two ends at the distance of its length", "[contact][overlaps][2d]") {
    contact::Surface<2> surface;
    surface.append(tile<2>({0, 0}, up<2>(), 0.5), 0.3, 1.0, 0);
    surface.append(tile<2>({0.25, 0.1}, -up<2>(), 0.5), 0.3, 1.0, 1);
    const auto ends = contact::overlap_polygon<2>(surface.view(), at_rest(surface), {0, 1});
    REQUIRE(ends.size() == 2);
    CHECK((ends[1] - ends[0]).norm() == Approx(0.75).epsilon(1e-15));
    for (const Vector<2>& end : ends) CHECK(end.y() == Approx(0.05).epsilon(1e-14));
    CHECK(contact::overlap_polygon<2>(surface.view(), at_rest(surface), {0, 0}).empty());
}

TEMPLATE_TEST_CASE_SIG("overlaps of wrong arrays or of faces that do not exist are refused by name", "[contact][overlaps]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(7);
    const auto surface = random_triangles<Dim>(random, 2);
    auto u = at_rest(surface);
    CHECK_THROWS_WITH(find<Dim>(surface, u, {{0, 1}, {1, 4}}),
                      "overlaps: pair 1 names face 4, but there are 4 faces. Correct `pairs`.");
    CHECK_THROWS_WITH(find<Dim>(surface, u, {{-1, 1}}), Contains("pair 0 names face -1"));
    CHECK_THROWS_WITH(contact::overlap_polygon<Dim>(surface.view(), u, {0, 9}), Contains("the pair names face 9"));
    const std::vector<geometry::IndexPair> pairs{{0, 1}, {9, 0}};
    CHECK_THROWS_WITH(contact::overlap_polygons<Dim>(surface.view(), u, pairs), Contains("pair 1 names face 9"));
    u.pop_back();
    CHECK_THROWS_WITH(find<Dim>(surface, u, {}), Contains("`displacement` has 3 entries, 4 are needed: one per face."));
    auto broken = surface;
    broken.stiffness.pop_back();
    CHECK_THROWS_WITH(find<Dim>(broken, at_rest(surface), {}), Contains("`stiffness` has 3 entries"));
}

TEMPLATE_TEST_CASE_SIG(
    "a displacement that is not finite is refused with its face if a pair names it, and no pair is dropped",
    "[contact][overlaps][errors]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(8);
    const int n = GENERATE(2, 40);  // few pairs of many faces are looked up, of few faces all displacements are
    const auto surface = random_triangles<Dim>(random, n);
    const auto method = GENERATE(AreaMethod::fast, AreaMethod::exact);
    const double bad = GENERATE(std::numeric_limits<double>::quiet_NaN(), rigid);
    const auto check_refused = [&](IndexPair pair, std::int32_t face) {
        auto u = at_rest(surface);
        u[face][Dim - 1] = bad;
        const std::vector<IndexPair> pairs{{1, n}, pair};
        const std::string says = "the displacement of face " + std::to_string(face) + " (body";
        CHECK_THROWS_AS(find(surface, u, pairs, method), Diverged);
        CHECK_THROWS_WITH(find(surface, u, pairs, method), Contains(says) && Contains("not finite"));
        CHECK_THROWS_WITH(contact::overlap_polygon<Dim>(surface.view(), u, pair), Contains(says) && Contains("not finite"));
        CHECK_THROWS_WITH(contact::overlap_polygons<Dim>(surface.view(), u, pairs),
                          Contains(says) && Contains("not finite"));
    };
    check_refused({0, n}, 0);
    check_refused({0, n}, n);
    check_refused({0, 1}, 0);  // these do not face each other
    auto u = at_rest(surface);
    const auto before = find<Dim>(surface, u, {{1, n}}, method);
    u[0][0] = bad;  // no pair names it
    const auto after = find<Dim>(surface, u, {{1, n}}, method);
    REQUIRE(after.found.size() == before.found.size());
    CHECK(std::equal(after.found.begin(), after.found.end(), before.found.begin(),
                     [](const auto& a, const auto& b) { return same_bits<Dim>(a, b); }));
    CHECK(contact::overlap_polygon<Dim>(surface.view(), u, {1, n}).empty() == before.found.empty());
}
