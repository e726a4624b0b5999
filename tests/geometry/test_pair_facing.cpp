#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "abut/geometry/pair_potential/pair_facing.hpp"
#include "geometry/random_pairs.hpp"

using namespace abut;
using namespace abut::geometry;
using namespace abut::test;

namespace {

constexpr double none = FacingFade{}.none;

/// Corners that go as far as they may, each in a direction of its own, and with the translation of their face.
template <int Dim>
PairCorners<Dim> moved(const PairCorners<Dim>& x, double reach, std::mt19937& random) {
    PairCorners<Dim> result = x;
    for (int face = 0; face < 2; ++face) {
        const Vector<Dim> by = random_vector<Dim>(random, 5.0);
        for (int v = Dim * face; v < Dim * (face + 1); ++v)
            result[v] += by + reach * random_vector<Dim>(random, 1.0).normalized();
    }
    return result;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("faces that are turned away stay so wherever their corners go within reach", "[pair_potential]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(7);
    int turned_away = 0, come_to_face = 0;
    for (int i = 0; i < 20000; ++i) {
        PairCorners<Dim> x = random_pair<Dim>(random);
        const Matrix<Dim> turn = random_turn<Dim>(random, 3.0);
        for (int v = 1; v < Dim; ++v) x[v] = turn * (x[v] - x[0]) + x[0];
        const double reach = reach_turned_away<Dim>(x, none);
        if (pair_facing<Dim>(x) < none) REQUIRE(reach == 0.0);
        if (reach == 0.0) continue;
        ++turned_away;
        for (int j = 0; j < 40; ++j) {
            REQUIRE(pair_facing<Dim>(moved<Dim>(x, reach, random)) >= none);
            come_to_face += pair_facing<Dim>(moved<Dim>(x, 10.0 * reach, random)) < none ? 1 : 0;
        }
    }
    CHECK(turned_away > 5000);
    CHECK(come_to_face > 5000);  // the bound is no small part of what they need
}

TEST_CASE("two segments at a right angle have nearly all of the reach that they can have", "[pair_potential]") {
    const PairCorners<2> x{Vector<2>(0, 0), Vector<2>(2, 0), Vector<2>(5, 0), Vector<2>(5, 2)};
    const double left = std::acos(none) - 0.5 * std::numbers::pi;
    const double exact = std::sin(0.5 * left);  // ends that move apart turn each of both by half of what is left
    CHECK(reach_turned_away<2>(x, none) <= exact);
    CHECK(reach_turned_away<2>(x, none) >= 0.99 * exact);
}

TEMPLATE_TEST_CASE_SIG("the cosine of a pair alone is that of its state, to the bit", "[pair_potential]", ((int Dim), Dim),
                       2, 3) {
    std::mt19937 random(8);
    for (int i = 0; i < 1000; ++i) {
        const PairCorners<Dim> x = random_pair<Dim>(random);
        REQUIRE(pair_facing<Dim>(x) == pair_state<Dim>(x, {.stiffness = 1.0}).facing);
    }
}
