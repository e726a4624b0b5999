// Overlaps within a distance, for hosts that ask for them alone.
#include "abut/contact/search/near_overlaps.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "abut/base/error.hpp"
#include "contact/nodal_scenes.hpp"

using namespace abut;
using namespace abut::test;
using contact::NearOverlaps;

namespace {

/// Two boxes one over the other in another unit of length.
template <int Dim>
NodalScene<Dim> boxes_in(double unit) {
    auto scene = two_boxes<Dim>(8, 7, 0.02);
    for (Vector<Dim>& corner : scene.rest) corner *= unit;
    for (double& depth : scene.faces.depth) depth *= unit;
    return scene;
}

template <int Dim>
std::vector<geometry::IndexPair> found_pairs_of(const NearOverlaps<Dim>& near) {
    std::vector<geometry::IndexPair> pairs;
    for (const auto& overlap : near.found) pairs.push_back({overlap.face_1, overlap.face_2});
    return pairs;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("overlaps within a distance are those that a look at every pair of faces finds",
                       "[contact][overlaps]", ((int Dim), Dim), 2, 3) {
    const double distance = GENERATE(0.0, 0.01, 0.02000001, 0.3);
    const auto surface = boxes_in<Dim>(1.0).surface();
    const auto near = contact::find_near_overlaps<Dim>(surface, distance);
    std::vector<geometry::IndexPair> all, expected;
    for (std::int32_t face_1 = 0; face_1 < surface.facets().size(); ++face_1)
        for (std::int32_t face_2 = face_1 + 1; face_2 < surface.facets().size(); ++face_2)
            if (surface.facets().body[face_1] != surface.facets().body[face_2]) all.push_back({face_1, face_2});
    const auto looked_at = contact::find_overlaps_moved<Dim>(surface.facets().view(), surface.facets().vertices, all);
    for (const auto& overlap : looked_at.found)
        if (std::abs(overlap.gap) <= distance) expected.push_back({overlap.face_1, overlap.face_2});
    CHECK(found_pairs_of(near) == expected);
    CHECK(expected.empty() == (distance < 0.02));
}

TEMPLATE_TEST_CASE_SIG("in any unit of length the same pairs of faces are looked at and found", "[contact][overlaps]",
                       ((int Dim), Dim), 2, 3) {
    const double distance = 0.05;
    const auto surface = boxes_in<Dim>(1.0).surface();
    const auto near = contact::find_near_overlaps<Dim>(surface, distance);
    REQUIRE(near.found.size() > (Dim == 2 ? 10 : 100));
    CHECK(near.search.candidates < 16 * surface.facets().size());  // neighbours, not all pairs
    for (const double unit :
         {std::ldexp(1.0, -40), std::ldexp(1.0, -10), 1e-3, 1e3, std::ldexp(1.0, 10), std::ldexp(1.0, 40)}) {
        const auto scaled = contact::find_near_overlaps<Dim>(boxes_in<Dim>(unit).surface(), distance * unit);
        CHECK(found_pairs_of(scaled) == found_pairs_of(near));
        CHECK(scaled.search.candidates == near.search.candidates);
        CHECK(scaled.search.box_pairs == near.search.box_pairs);
        if (std::log2(unit) != std::round(std::log2(unit))) continue;
        for (std::size_t i = 0; i < scaled.found.size(); ++i) {
            CHECK(scaled.found[i].gap == unit * near.found[i].gap);
            CHECK(scaled.found[i].area == std::pow(unit, Dim - 1) * near.found[i].area);
            CHECK(scaled.found[i].normal == near.found[i].normal);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("in any unit of length contact lists the same pairs", "[contact][candidates]", ((int Dim), Dim), 2,
                       3) {
    const auto candidates = [](double unit) {
        const auto scene = boxes_in<Dim>(unit);
        contact::NodalContact<Dim> contact(scene.surface());
        contact.step(1.0, scene.rest, placed<Dim>(scene, 1, shifted<Dim>(-0.04 * unit * up<Dim>())));
        return std::array{contact.search_report().box_pairs, contact.report().candidates, contact.report().active_pairs};
    };
    const auto expected = candidates(1.0);
    CHECK(expected[2] > 0);
    for (const double unit : {std::ldexp(1.0, -20), 1e-3, 1e3, std::ldexp(1.0, 20)}) CHECK(candidates(unit) == expected);
}

TEST_CASE("a distance that is no length is refused by name", "[contact][overlaps][errors]") {
    const auto surface = boxes_in<2>(1.0).surface();
    for (const double distance : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(contact::find_near_overlaps<2>(surface, distance), BadInput);
}
