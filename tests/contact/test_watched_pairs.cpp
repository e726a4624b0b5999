#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "abut/contact/pairs/watched_pairs.hpp"
#include "abut/geometry/pair_potential/pair_facing.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::contact;
using namespace abut::test;

namespace {

constexpr double none = geometry::FacingFade{}.none;
constexpr int n_pairs = 60, n_steps = 4000;

/// Pairs of facets of two bodies that look anywhere.
template <int Dim>
struct Scene {
    std::vector<NodalPair<Dim>> pairs;
    std::vector<std::int32_t> body;  // of each facet
    std::vector<Vector<Dim>> rest;   // of each node

    explicit Scene(std::mt19937& random) {
        for (std::int32_t p = 0; p < n_pairs; ++p) {
            NodalPair<Dim> pair{.facet_1 = 2 * p, .facet_2 = 2 * p + 1};
            body.insert(body.end(), {0, 1});
            for (std::int32_t& node : pair.node) {
                node = static_cast<std::int32_t>(rest.size());
                rest.push_back(random_vector<Dim>(random, 1.0));
            }
            pairs.push_back(pair);
        }
    }

    /// Both bodies fly apart, one of them turns, and all nodes tremble.
    [[nodiscard]] std::vector<Vector<Dim>> at(int step, std::mt19937& random) const {
        std::vector<Vector<Dim>> x = rest;
        const double angle = 2.0 * step / n_steps;
        Matrix<Dim> turn = Matrix<Dim>::Identity();
        turn(0, 0) = turn(1, 1) = std::cos(angle);
        turn(1, 0) = std::sin(angle);
        turn(0, 1) = -turn(1, 0);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const bool is_first = i % (2 * Dim) < Dim;
            if (is_first) x[i] = turn * x[i];
            x[i] += (is_first ? 0.01 : -0.01) * step * Vector<Dim>::Ones() + 1e-5 * random_vector<Dim>(random, 1.0);
        }
        return x;
    }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("of watched pairs none that looks at its other facet is left out, and most others are", "[contact]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(3);
    const Scene<Dim> scene(random);
    WatchedPairs<Dim> watched(none);
    watched.assign(scene.pairs, scene.body, scene.at(0, random));
    int facing = 0, come_to_face = 0, visits = 0;
    std::set<std::int32_t> before;
    for (int step = 1; step <= n_steps; ++step) {
        const auto x = scene.at(step, random);
        std::set<std::int32_t> visited;
        watched.visit(x, [&](const NodalPair<Dim>& pair) { REQUIRE(visited.insert(pair.facet_1).second); });
        visits += static_cast<int>(visited.size());
        for (const NodalPair<Dim>& pair : scene.pairs) {
            if (geometry::pair_facing<Dim>(pair.at(x)) >= none) continue;
            ++facing;
            REQUIRE(visited.contains(pair.facet_1));
            come_to_face += before.insert(pair.facet_1).second ? 1 : 0;
        }
    }
    CHECK(come_to_face > n_pairs / 4);
    CHECK(facing < n_pairs * n_steps / 2);
    CHECK(visits - facing < (n_pairs * n_steps - facing) / 4);
}

TEST_CASE("positions that are no numbers leave out no watched pair", "[contact]") {
    std::mt19937 random(4);
    const Scene<2> scene(random);
    WatchedPairs<2> watched(none);
    watched.assign(scene.pairs, scene.body, scene.rest);
    auto x = scene.rest;
    x[1][0] = std::nan("");
    int visits = 0;
    watched.visit(x, [&](const NodalPair<2>&) { ++visits; });
    CHECK(visits == n_pairs);
}
