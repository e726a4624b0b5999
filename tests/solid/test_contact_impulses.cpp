// How deep two bodies are pressed into each other where they bear, of pairs of faces that are made up.
#include "abut/solid/contact/contact_impulses.hpp"

#include <catch2/catch.hpp>
#include <vector>

namespace {

using namespace abut;

contact::PairStep<2> pair_of(int face_1, int face_2, double force, double compression) {
    contact::PairStep<2> pair{};
    pair.face_1 = contact::Face{face_1};
    pair.face_2 = contact::Face{face_2};
    pair.normal_force = force;
    pair.compression = compression;
    return pair;
}

/// Compression of bodies 0 and 1, of which all faces are even and odd.
solid::BodyImpulse<2> pressed(const std::vector<contact::PairStep<2>>& pairs) {
    solid::ContactImpulses<2> impulses;
    impulses.add(0, 1, Vector<2>::Zero(), 0.0);
    impulses.add_compression(
        pairs, [](contact::Face face) { return static_cast<std::int32_t>(face) % 2; }, 0.3);
    return impulses.pairs().front();
}

}  // namespace

TEST_CASE("pairs that bear less than a hundredth of the force of two bodies do not count as compressed",
          "[solid][contact]") {
    const double force = 100.0;
    for (const double of_deepest : {0.009, 0.011}) {
        const solid::BodyImpulse<2> found = pressed({pair_of(0, 1, (1.0 - of_deepest) * force, 0.4),
                                                     pair_of(3, 2, of_deepest * force, 0.9), pair_of(4, 5, 0.0, 1.5)});
        CHECK(found.compression == (of_deepest < 0.01 ? 0.4 : 0.9));
        CHECK(found.compressed_steps == 1);
    }
}

TEST_CASE("two pairs that bear six thousandths of the force each count together", "[solid][contact]") {
    CHECK(pressed({pair_of(0, 1, 98.8, 0.1), pair_of(2, 3, 0.6, 0.9), pair_of(4, 5, 0.6, 0.8)}).compression == 0.8);
    CHECK(pressed({pair_of(0, 1, 99.4, 0.1), pair_of(2, 3, 0.6, 0.9)}).compressed_steps == 0);
}
