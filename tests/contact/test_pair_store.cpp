// What pairs remember: across lists and across a restart.
#include <catch2/catch.hpp>

#include <cstring>

#include "abut/contact/contact.hpp"
#include "contact/plates.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Matchers::Contains;
using contact::Facet;
using contact::FacetPair;
using contact::PairMemory;
using contact::PairStore;

namespace {

FacetPair facets(std::int32_t facet_1, std::int32_t facet_2) { return {Facet{facet_1}, Facet{facet_2}}; }

PairStore store_of(const std::vector<FacetPair>& pairs, bool admitted) {
    PairStore store;
    store.follow(pairs, [&](std::size_t) { return PairMemory{admitted}; });
    return store;
}

}  // namespace

TEST_CASE("a store keeps what pairs remember from list to list, and forgets pairs that leave", "[contact][store]") {
    PairStore store = store_of({facets(0, 3), facets(0, 4), facets(1, 3)}, true);
    store.memory()[1].admitted = false;
    store.follow(std::vector{facets(0, 2), facets(0, 4), facets(1, 3)}, [](std::size_t i) {
        CHECK(i == 0);  // only what is new is asked for
        return PairMemory{false};
    });
    CHECK(store.size() == 3);
    CHECK(store.find(facets(0, 3)) == nullptr);
    CHECK_FALSE(store.find(facets(0, 2))->admitted);
    CHECK_FALSE(store.find(facets(0, 4))->admitted);
    CHECK(store.find(facets(1, 3))->admitted);
}

TEMPLATE_TEST_CASE_SIG("after save and restore the next steps have the same bits, also with pairs deeper than D",
                       "[contact][store]", ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>();
    const auto states = path_of_plates(surface);
    contact::Contact<Dim> whole(surface.view(), deep());
    std::vector<std::vector<std::byte>> saved;
    for (std::size_t i = 0; i + 1 < states.size(); ++i) {
        drive(whole, states[i], states[i + 1]);
        saved.push_back(whole.state());
    }
    REQUIRE(whole.report().compression_max > 1.2);  // there are pairs deeper than D
    REQUIRE(whole.report().rebuilds > 3);

    std::size_t deep_restarts = 0, naive_losses = 0;
    for (std::size_t stop = 3; stop + 2 < states.size(); stop += 4) {
        CAPTURE(stop);
        contact::Contact<Dim> original(surface.view(), deep()), restored(surface.view(), deep());
        for (std::size_t i = 0; i <= stop; ++i) drive(original, states[i], states[i + 1]);
        restored.restore(saved[stop]);
        contact::Contact<Dim> naive(surface.view(), deep());  // what a restart without the state would do
        for (std::size_t i = stop + 1; i + 1 < states.size(); ++i) {
            const auto& expected = drive(original, states[i], states[i + 1]);
            const auto& found = drive(restored, states[i], states[i + 1]);
            const auto& lost = drive(naive, states[i], states[i + 1]);
            naive_losses += expected.pairs.size() > lost.pairs.size();
            deep_restarts += i == stop + 1 && expected.report.compression > 1.0;
            REQUIRE(found.pairs.size() == expected.pairs.size());
            CHECK(std::memcmp(&found.energy, &expected.energy, sizeof(double)) == 0);
            for (std::size_t p = 0; p < found.pairs.size(); ++p) {
                CHECK(found.pairs[p].face_1 == expected.pairs[p].face_1);
                CHECK(found.pairs[p].face_2 == expected.pairs[p].face_2);
                CHECK(std::memcmp(found.pairs[p].force.data(), expected.pairs[p].force.data(), Dim * sizeof(double)) == 0);
            }
        }
        CHECK(original.report().missed_contacts == restored.report().missed_contacts);
        CHECK(original.report().events == restored.report().events);
        CHECK(original.report().compression_max == restored.report().compression_max);
    }
    CHECK(deep_restarts > 2);
    CHECK(naive_losses > 2);  // the state is what makes the difference
}

TEMPLATE_TEST_CASE_SIG("an object whose faces have other numbers takes over from another one with the same bits",
                       "[contact][store]", ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>();
    const auto states = path_of_plates(surface);
    contact::Surface<Dim> longer;  // the same faces behind one that is far away
    longer.append(tile<Dim>(100.0 * axis<Dim>(0), up<Dim>(), 0.5), 0.2, 1.0, 0);
    for (int body = 0; body < 2; ++body)
        for (int i = 0; i < 5; ++i)
            longer.append(tile<Dim>((i + 0.3 * body) * axis<Dim>(0), (body == 0 ? 1.0 : -1.0) * up<Dim>(), 0.5), 0.2,
                          1.0 + body, body);
    std::vector<std::int32_t> old_face_of;
    for (std::int32_t face = 0; face < longer.size(); ++face) old_face_of.push_back(face - 1);
    const auto behind = [](std::vector<Vector<Dim>> u) {
        u.insert(u.begin(), Vector<Dim>::Zero());
        return u;
    };
    for (std::size_t stop = 3; stop + 2 < states.size(); stop += 8) {
        contact::Contact<Dim> whole(surface.view(), deep()), other(longer.view(), deep());
        for (std::size_t i = 0; i <= stop; ++i) drive(whole, states[i], states[i + 1]);
        other.take_over(whole, old_face_of);
        for (std::size_t i = stop + 1; i + 1 < states.size(); ++i) {
            const auto& expected = drive(whole, states[i], states[i + 1]);
            const auto& found = drive(other, behind(states[i]), behind(states[i + 1]));
            REQUIRE(found.pairs.size() == expected.pairs.size());
            CHECK(found.energy == expected.energy);
            for (std::size_t p = 0; p < found.pairs.size(); ++p) CHECK(found.pairs[p].force == expected.pairs[p].force);
        }
        CHECK(other.report().events == whole.report().events);
        CHECK(other.report().missed_contacts == whole.report().missed_contacts);
        CHECK_THROWS_WITH(whole.take_over(other, old_face_of), Contains("give one each"));
        old_face_of.back() = old_face_of[1];
        CHECK_THROWS_WITH(other.take_over(whole, old_face_of), Contains("another one is, too"));
        old_face_of.back() = 10;
        CHECK_THROWS_WITH(other.take_over(whole, old_face_of), Contains("there were 10 faces"));
        old_face_of.back() = 9;
    }
}

TEMPLATE_TEST_CASE_SIG("a state that is damaged, of another version, dimension or surface is refused, and nothing changes",
                       "[contact][store]", ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>();
    const auto states = path_of_plates(surface);
    contact::Contact<Dim> contact(surface.view(), deep());
    for (std::size_t i = 0; i < 20; ++i) drive(contact, states[i], states[i + 1]);
    const auto good = contact.state();
    const auto refuses = [&](std::span<const std::byte> bytes, const std::string& why) {
        CHECK_THROWS_AS(contact.restore(bytes), BadInput);
        CHECK_THROWS_WITH(contact.restore(bytes), Contains(why));
        CHECK(contact.state() == good);
    };
    for (std::size_t i = 0; i < good.size(); i += 7) {
        auto damaged = good;
        damaged[i] ^= std::byte{0x10};
        CHECK_THROWS_AS(contact.restore(damaged), BadInput);
    }
    refuses(std::span(good).first(good.size() - 9), "checksum");
    refuses({}, "no state is so short");
    {
        StateWriter other("contact " + std::to_string(Dim) + "D", 99);
        refuses(std::move(other).finish(), "version 99, 12 is needed");
    }
    {
        const auto other_surface = plates<5 - Dim>();
        contact::Contact<5 - Dim> other(other_surface.view(), deep());
        refuses(other.state(), "it is one of contact " + std::to_string(5 - Dim) + "D");
    }
    {
        auto stiffer = plates<Dim>();
        stiffer.stiffness[3] *= 2.0;
        contact::Contact<Dim> other(stiffer.view(), deep());
        refuses(other.state(), "another surface");
    }
    CHECK_NOTHROW(contact.restore(good));
    CHECK(contact.state() == good);
}
