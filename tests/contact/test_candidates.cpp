#include <catch2/catch.hpp>

#include <algorithm>

#include "contact/reference.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;
using geometry::BroadPhase;
using geometry::IndexPair;

namespace {

inline constexpr std::array back_ends{BroadPhase::embree, BroadPhase::fcl, BroadPhase::brute_force};

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

}  // namespace

TEMPLATE_TEST_CASE_SIG("flat faces pressed into each other, whose own boxes are disjoint, are found by every broad phase",
                       "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    const BroadPhase method = GENERATE(from_range(back_ends));
    const double face_size = 1.0 / 7.0;
    const double depth = face_size * GENERATE(0.001, 0.002, 0.005, 0.01, 0.02, 0.04);
    const auto surface = pressed_grids<Dim>(depth);
    const auto u = at_rest(surface);
    contact::ContactOptions options;
    options.broad_phase = method;
    const auto found = contact::find_candidates<Dim>(surface.view(), u, u, options, 0.0);
    const Reference<Dim> reference(surface.view(), facing_pairs(surface), contact::Weights::half);
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
        // Tilts up to 25 degrees: pair planes tilt by up to 30 against either face, up to 60 against an obstacle.
        auto surface = random_surface<Dim>(random, Dim == 2 ? 8 : 12, 0.45, 1.5);
        for (const double sign : {1.0, -1.0}) {
            Vector<Dim> normal = sign * up<Dim>();
            normal[0] = uniform(random, -0.6, 0.6);
            contact::append(
                surface, contact::plane_obstacle<Dim>(random_vector<Dim>(random, 0.3), normal, uniform(random, 0.5, 20.0)),
                sign > 0 ? 2 : 3);
        }
        const auto u_0 = random_displacement(random, surface, 1.0), u_1 = random_displacement(random, surface, 1.0);
        const auto found = contact::find_candidates<Dim>(surface.view(), u_0, u_1, {}, 0.0);
        const Reference<Dim> reference(surface.view(), facing_pairs(surface), contact::Weights::half);
        std::vector<Vector<Dim>> u(u_0.size());
        for (int sample = 0; sample <= samples; ++sample) {
            const double tau = static_cast<double>(sample) / samples;
            for (std::size_t f = 0; f < u.size(); ++f) u[f] = u_0[f] + tau * (u_1[f] - u_0[f]);
            for (const auto& pair : reference.pairs()) {
                const double g = reference.gap(pair, u);
                if (g >= 0.0 || g <= -surface.depth[pair.face_1] - surface.depth[pair.face_2]) continue;
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
        const auto found = contact::find_candidates<Dim>(surface.view(), u_0, u_0, {}, skin);
        const auto bare = contact::find_candidates<Dim>(surface.view(), u_0, u_0, {}, 0.0);
        const Reference<Dim> reference(surface.view(), facing_pairs(surface), contact::Weights::half);
        for (int sample = 0; sample < 20; ++sample) {
            auto u = u_0;
            for (Vector<Dim>& moved : u) moved += 0.5 * skin * random_vector<Dim>(random, 1.0).normalized();
            for (const auto& pair : reference.pairs()) {
                const double g = reference.gap(pair, u);
                if (g >= 0.0 || g <= -surface.depth[pair.face_1] - surface.depth[pair.face_2]) continue;
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
        contact::ContactOptions options;
        options.self_contact = trial % 2 == 1;
        std::vector<std::vector<IndexPair>> lists;
        for (const BroadPhase method : back_ends) {
            options.broad_phase = method;
            lists.push_back(contact::find_candidates<Dim>(surface.view(), u_0, u_1, options, 0.05));
        }
        CHECK(lists[0] == lists[2]);
        CHECK(lists[1] == lists[2]);
        CHECK(lists[2].size() > 50);
        CHECK(std::is_sorted(lists[0].begin(), lists[0].end()));
        CHECK(std::adjacent_find(lists[0].begin(), lists[0].end()) == lists[0].end());
    }
}

TEMPLATE_TEST_CASE_SIG("a list covers motions up to half its skin, and nothing before the first search",
                       "[contact][candidates]", ((int Dim), Dim), 2, 3) {
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.1, 1.0, 0);
    surface.append(tile<Dim>(up<Dim>(), -up<Dim>(), 1.5), 0.1, 1.0, 1);
    surface.append(tile<Dim>(-up<Dim>(), up<Dim>(), 100.0), 0.0, rigid, 2);
    contact::ContactOptions options;
    options.skin = GENERATE(0.0, 0.3);
    Mover<Dim> mover(surface, options);
    // By default the mean size of the deformable faces, 1 and 3.
    const double expected = options.skin > 0.0 ? options.skin : 2.0;
    CHECK(mover.contact.skin() == Approx(expected).epsilon(1e-14));
    CHECK_FALSE(mover.contact.covers(0.0));
    mover.search(at_rest(surface));
    CHECK(mover.contact.covers(0.0));
    CHECK(mover.contact.covers(0.4999 * expected));
    CHECK_FALSE(mover.contact.covers(0.5001 * expected));
    CHECK_FALSE(mover.contact.covers(std::numeric_limits<double>::quiet_NaN()));
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
    options.skin = 0.5;
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
    CHECK(mover.contact.report().lost_contacts == 0);
}
