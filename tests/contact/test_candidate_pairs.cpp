// Which pairs of faces a list of candidates holds.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

#include "abut/contact/search/candidate_search.hpp"
#include "contact/reference.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;
using geometry::BroadPhase;
using geometry::IndexPair;

namespace {
/// The list of a search with a given skin, which may be none at all.
template <int Dim>
std::vector<IndexPair> candidates_of(const contact::Surface<Dim>& surface, const std::vector<Vector<Dim>>& u_0,
                                     const std::vector<Vector<Dim>>& u_1, contact::CandidateOptions options, double skin) {
    options.skin = skin > 0.0 ? skin : 1e-300;
    contact::CandidateSearch<Dim> search(surface.view(), options);
    search.search(u_0, u_1);
    return {search.candidates().begin(), search.candidates().end()};
}

std::int64_t sum_of_outcomes(const contact::CandidateReport& report) {
    return report.neighbours + report.both_rigid + report.not_facing + report.too_far_apart + report.candidates;
}

bool holds(const std::vector<IndexPair>& list, std::int32_t face_1, std::int32_t face_2) {
    return std::binary_search(list.begin(), list.end(), IndexPair{face_1, face_2});
}

template <int Dim>
std::vector<std::pair<std::int32_t, std::int32_t>> facing_pairs(const contact::Surface<Dim>& surface) {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    for (std::int32_t i = 0; i < surface.size(); ++i)
        for (std::int32_t j = i + 1; j < surface.size(); ++j) {
            const bool both_rigid = std::isinf(surface.stiffness[i]) && std::isinf(surface.stiffness[j]);
            if (surface.body[i] != surface.body[j] && !both_rigid && surface.normal[i].dot(surface.normal[j]) < -0.5)
                pairs.emplace_back(i, j);
        }
    return pairs;
}

/// Two grids of tiles that do not match, body 1 turned over and above body 0, pressed `depth` into it.
template <int Dim>
contact::Surface<Dim> pressed_grids(double depth) {
    contact::Surface<Dim> surface;
    const auto add = [&](int n, double offset, double height, int body) {
        const double half = 0.5 / n;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < (Dim == 3 ? n : 1); ++j) {
                Vector<Dim> centre = Vector<Dim>::Constant(offset + half);
                centre[0] += 2.0 * half * i;
                if constexpr (Dim == 3) centre[1] += 2.0 * half * j;
                centre[Dim - 1] = height;
                surface.append(tile<Dim>(centre, (body == 0 ? 1.0 : -1.0) * up<Dim>(), half), half, 1.0, body);
            }
    };
    add(7, 0.0, 0.0, 0);
    add(5, 0.013, -depth, 1);
    return surface;
}

/// Faces within `rings` steps over common corners of each face, itself included, by the definition.
std::vector<std::vector<bool>> within_rings(const contact::Surface<3>& surface, int rings) {
    const auto n = static_cast<std::size_t>(surface.size());
    std::vector<std::vector<bool>> touch(n, std::vector<bool>(n, false)), reached(n, std::vector<bool>(n, false));
    const auto corner = [&](std::size_t face, int k) { return surface.vertices[3 * face + static_cast<std::size_t>(k)]; };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            for (int k = 0; k < 9; ++k) touch[i][j] = touch[i][j] || corner(i, k / 3) == corner(j, k % 3);
    for (std::size_t i = 0; i < n; ++i) reached[i][i] = true;
    for (int ring = 0; ring < rings; ++ring) {
        const auto before = reached;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < n; ++k)
                if (before[i][k])
                    for (std::size_t j = 0; j < n; ++j)
                        if (touch[k][j]) reached[i][j] = true;
    }
    return reached;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "bodies that are ignored, in either order, have no candidates; the lists of all others stay as they are",
    "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    contact::Surface<Dim> surface = pressed_grids<Dim>(0.01);
    const contact::Surface<Dim> above = pressed_grids<Dim>(0.02);  // its second grid is a third body
    for (std::int32_t face = 0; face < above.size(); ++face) {
        if (above.body[face] == 0) continue;
        std::vector<Vector<Dim>> corners;
        for (const std::int32_t v : above.view().vertices_of(face)) corners.push_back(above.vertices[v]);
        surface.append(corners, above.cell_depth[face], 1.0, 2);
    }
    const std::vector<Vector<Dim>> rest(static_cast<std::size_t>(surface.size()), Vector<Dim>::Zero());
    const auto all = candidates_of<Dim>(surface, rest, rest, {}, 0.1);
    const std::array<std::int32_t, 2> pair = GENERATE(std::array{0, 2}, std::array{2, 0});
    const auto some = candidates_of<Dim>(surface, rest, rest, {.ignored_bodies = {pair, {7, 9}}}, 0.1);
    std::vector<IndexPair> expected;
    for (const IndexPair& candidate : all)
        if (surface.body[candidate.first] + surface.body[candidate.second] != 2) expected.push_back(candidate);
    CHECK(expected.size() < all.size());
    CHECK_FALSE(expected.empty());
    CHECK(some == expected);
}

TEMPLATE_TEST_CASE_SIG("flat faces pressed into each other, whose own boxes are disjoint, are found by every broad phase",
                       "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    const BroadPhase method = GENERATE(from_range(geometry::broad_phases()));
    const double face_size = 1.0 / 7.0;
    const double depth = face_size * GENERATE(0.001, 0.002, 0.005, 0.01, 0.02, 0.04);
    const auto surface = pressed_grids<Dim>(depth);
    const auto u = at_rest(surface);
    contact::CandidateOptions options;
    options.broad_phase = method;
    const auto found = candidates_of<Dim>(surface, u, u, options, 0.0);
    const Reference<Dim> reference(surface.view(), facing_pairs(surface), contact::InterfaceWeighting::half);
    int active = 0;
    for (const auto& pair : reference.pairs()) {
        if (reference.gap(pair, u) >= 0.0 || reference.patch(pair, u).area <= 0.0) continue;
        ++active;
        CHECK(holds(found, pair.face_1, pair.face_2));
    }
    CHECK(active > 10);
}

TEMPLATE_TEST_CASE_SIG(
    "candidates hold every pair that is active anywhere along a straight motion, obstacles and tilted faces included",
    "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    static constexpr int trials = 30, samples = 200;
    std::mt19937 random(11);
    int active = 0;
    for (int trial = 0; trial < trials; ++trial) {
        // Tilts up to 25 degrees: pair planes tilt by up to 30 against either face, up to 60 against an obstacle or a face
        // farther from a sharp edge.
        auto surface = random_surface<Dim>(random, Dim == 2 ? 8 : 12, 0.45, 1.5);
        for (const double sign : {1.0, -1.0}) {
            Vector<Dim> normal = sign * up<Dim>();
            normal[0] = uniform(random, -0.6, 0.6);
            contact::append(
                surface, contact::plane_obstacle<Dim>(random_vector<Dim>(random, 0.3), normal, uniform(random, 0.5, 20.0)),
                sign > 0 ? 2 : 3);
        }
        const auto u_0 = random_displacement(random, surface, 1.0), u_1 = random_displacement(random, surface, 1.0);
        const auto found = candidates_of<Dim>(surface, u_0, u_1, {}, 0.0);
        const Reference<Dim> reference(surface.view(), facing_pairs(surface), contact::InterfaceWeighting::half);
        std::vector<Vector<Dim>> u(u_0.size());
        for (int sample = 0; sample <= samples; ++sample) {
            const double tau = static_cast<double>(sample) / samples;
            for (std::size_t f = 0; f < u.size(); ++f) u[f] = u_0[f] + tau * (u_1[f] - u_0[f]);
            for (const auto& pair : reference.pairs()) {
                const double g = reference.gap(pair, u);
                if (g >= 0.0 || g <= -surface.cell_depth[pair.face_1] - surface.cell_depth[pair.face_2]) continue;
                if (reference.patch(pair, u).area <= 0.0) continue;
                ++active;
                if (!holds(found, pair.face_1, pair.face_2))
                    FAIL("pair " << pair.face_1 << ", " << pair.face_2 << " is missed at " << tau);
            }
        }
    }
    CHECK(active > 1000);
}

TEMPLATE_TEST_CASE_SIG("the list stays a superset while no face moves by more than half the skin", "[contact][candidates]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(12);
    const double skin = 0.4;
    int active = 0, beyond_the_bare_list = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const auto surface = random_surface<Dim>(random, 8, 0.45, 1.5);
        const auto u_0 = random_displacement(random, surface, 1.0);
        const auto found = candidates_of<Dim>(surface, u_0, u_0, {}, skin);
        const auto bare = candidates_of<Dim>(surface, u_0, u_0, {}, 0.0);
        const Reference<Dim> reference(surface.view(), facing_pairs(surface), contact::InterfaceWeighting::half);
        for (int sample = 0; sample < 20; ++sample) {
            auto u = u_0;
            for (Vector<Dim>& moved : u) moved += 0.5 * skin * random_vector<Dim>(random, 1.0).normalized();
            for (const auto& pair : reference.pairs()) {
                const double g = reference.gap(pair, u);
                if (g >= 0.0 || g <= -surface.cell_depth[pair.face_1] - surface.cell_depth[pair.face_2]) continue;
                if (reference.patch(pair, u).area <= 0.0) continue;
                ++active;
                if (!holds(bare, pair.face_1, pair.face_2)) ++beyond_the_bare_list;
                if (!holds(found, pair.face_1, pair.face_2))
                    FAIL("pair " << pair.face_1 << ", " << pair.face_2 << " is missed");
            }
        }
    }
    CHECK(active > 1000);
    CHECK(beyond_the_bare_list > 0);  // some pairs only the skin has kept
}

TEMPLATE_TEST_CASE_SIG("every broad phase gives the same list", "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(13);
    for (int trial = 0; trial < 20; ++trial) {
        auto surface = random_surface<Dim>(random, 40, 0.45, 3.0);
        contact::append(surface, contact::plane_obstacle<Dim>(-0.2 * up<Dim>(), up<Dim>(), 50.0), 2);
        const auto u_0 = random_displacement(random, surface, 1.0), u_1 = random_displacement(random, surface, 1.0);
        contact::CandidateOptions options;
        options.self_contact = trial % 2 == 1;
        std::vector<std::vector<IndexPair>> lists;
        for (const BroadPhase method : geometry::broad_phases()) {
            options.broad_phase = method;
            lists.push_back(candidates_of<Dim>(surface, u_0, u_1, options, 0.05));
        }
        for (const auto& list : lists) CHECK(list == lists.back());
        CHECK(lists[0].size() > 50);
        CHECK(std::is_sorted(lists[0].begin(), lists[0].end()));
        CHECK(std::adjacent_find(lists[0].begin(), lists[0].end()) == lists[0].end());
    }
}

TEST_CASE("neighbours on one body within the chosen rings are no candidates, and no other pair is left out",
          "[contact][candidates]") {
    // All pairs of a sheet that lie within a quarter of it are near enough; facing does not matter.
    const auto surface = sheet(6, 0, true, [](double x, double y) { return 0.02 * std::sin(9 * x) * std::cos(7 * y); });
    const int rings = GENERATE(0, 1, 2, 3);
    const auto all =
        candidates_of<3>(surface, at_rest(surface), at_rest(surface),
                         {.facing_cosine = 1.0, .distance = 0.25, .self_contact = true, .self_contact_rings = 0}, 0.0);
    contact::CandidateSearch<3> search(
        surface.view(), {.facing_cosine = 1.0, .distance = 0.25, .self_contact = true, .self_contact_rings = rings});
    search.search(at_rest(surface), at_rest(surface));
    const auto near = within_rings(surface, rings);
    std::vector<IndexPair> expected;
    for (const IndexPair& pair : candidates_of<3>(
             surface, at_rest(surface), at_rest(surface),
             {.facing_cosine = 1.0, .distance = 0.25, .skin = search.skin(), .self_contact = true, .self_contact_rings = 0},
             search.skin()))
        if (!near[pair.first][pair.second]) expected.push_back(pair);
    CHECK(std::ranges::equal(search.candidates(), expected));
    CHECK((search.report().neighbours > 0) == (rings > 0));
    CHECK(search.report().box_pairs == sum_of_outcomes(search.report()));
    CHECK(all.size() > 100);
}

TEMPLATE_TEST_CASE_SIG("pairs of two rigid faces have a count of their own, and the counts add up to the pairs of boxes",
                       "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    // Two bodies of two soft faces and three rigid ones each, all close together; one rigid face looks away.
    contact::Surface<Dim> surface;
    for (int body = 0; body < 2; ++body)
        for (int i = 0; i < 5; ++i) {
            const Vector<Dim> centre = (0.1 * body + 0.001 * i) * up<Dim>(), out = (body == 0 ? 1.0 : -1.0) * up<Dim>();
            surface.append(tile<Dim>(centre, i < 4 ? out : Vector<Dim>(-out), 0.5), 0.3, i < 2 ? 1.0 : rigid, body);
        }
    const double facing_cosine = GENERATE(-0.5, 1.0);
    contact::CandidateSearch<Dim> search(surface.view(), {.facing_cosine = facing_cosine, .distance = 1.0});
    search.search(at_rest(surface), at_rest(surface));
    const contact::CandidateReport& report = search.report();
    CHECK(report.box_pairs == 25);
    CHECK(report.both_rigid == 9);
    CHECK(report.not_facing == (facing_cosine < 1.0 ? 4 : 0));  // the face that looks away, with two soft ones on each side
    CHECK(report.candidates == (facing_cosine < 1.0 ? 12 : 16));
    CHECK(sum_of_outcomes(report) == report.box_pairs);
}

TEMPLATE_TEST_CASE_SIG("pairs up to the chosen distance are candidates", "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.1, 1.0, 0);
    surface.append(tile<Dim>(2.0 * up<Dim>(), -up<Dim>(), 0.5), 0.1, 1.0, 1);
    const auto u = at_rest(surface);
    CHECK(candidates_of<Dim>(surface, u, u, {}, 0.0).empty());
    CHECK(candidates_of<Dim>(surface, u, u, {.distance = 1.999}, 0.0).empty());
    CHECK(candidates_of<Dim>(surface, u, u, {.distance = 2.001}, 0.0).size() == 1);
    auto closer = u;
    closer[1] = -0.5 * up<Dim>();
    CHECK(candidates_of<Dim>(surface, u, closer, {.distance = 1.499}, 0.0).empty());
    CHECK(candidates_of<Dim>(surface, u, closer, {.distance = 1.501}, 0.0).size() == 1);
}

TEST_CASE("many bodies: each pair of them that is near is found, none within a body", "[contact][candidates]") {
    // 125 cubes on a grid, a hundredth apart: 3 * 4 * 5 * 5 pairs of bodies with one facing pair of faces each.
    contact::Surface<3> surface;
    for (int cube = 0; cube < 125; ++cube) {
        const Vector<3> middle = 1.01 * Vector<3>(cube % 5, cube / 5 % 5, cube / 25);
        for (int side = 0; side < 6; ++side) {
            const Vector<3> out = (side % 2 == 0 ? 1.0 : -1.0) * axis<3>(side / 2);
            surface.append(tile<3>(middle + 0.5 * out, out, 0.4), 0.001, 1.0, cube);
        }
    }
    for (const BroadPhase method : geometry::broad_phases()) {
        const auto found = candidates_of<3>(surface, at_rest(surface), at_rest(surface),
                                            {.broad_phase = method, .facing_cosine = -0.9, .distance = 0.011}, 0.0);
        std::ptrdiff_t opposite = 0;
        for (const auto& [face_1, face_2] : found) {
            CHECK(surface.body[face_1] != surface.body[face_2]);
            opposite += (surface.centroid[face_1] - surface.centroid[face_2]).norm() < 0.011;
        }
        CHECK(opposite == 300);
    }
}
