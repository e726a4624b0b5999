// What pairs remember: across lists, across a restart, and from one owner to another.
#include <catch2/catch.hpp>

#include <cstring>

#include "abut/contact/contact.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Matchers::Contains;
using contact::FacePair;
using contact::PairMemory;
using contact::PairStore;
using contact::SurfaceFace;

namespace {

FacePair faces(std::int32_t face_1, std::int32_t face_2) { return {SurfaceFace{face_1}, SurfaceFace{face_2}}; }

PairStore store_of(const std::vector<FacePair>& pairs, bool admitted) {
    PairStore store;
    store.follow(pairs, [&](std::size_t) { return PairMemory{admitted}; });
    return store;
}

/// Two plates of tiles, one over the other: body 0 looks up, body 1 down, tiles shifted against each other by half a tile.
template <int Dim>
contact::Surface<Dim> plates(int n = 5) {
    contact::Surface<Dim> surface;
    for (int body = 0; body < 2; ++body)
        for (int i = 0; i < n; ++i)
            surface.append(tile<Dim>((i + 0.3 * body) * axis<Dim>(0), (body == 0 ? 1.0 : -1.0) * up<Dim>(), 0.5), 0.2,
                           1.0 + body, body);
    return surface;
}

/// Body 1 pressed in by `depth` and slid by `slip`, body 0 bent a little, so that pairs open and close one by one.
template <int Dim>
std::vector<Vector<Dim>> moved(const contact::Surface<Dim>& surface, double depth, double slip) {
    std::vector<Vector<Dim>> u;
    for (std::int32_t f = 0; f < surface.size(); ++f)
        u.push_back(surface.body[f] == 0 ? Vector<Dim>(0.03 * f * up<Dim>())
                                         : Vector<Dim>(slip * axis<Dim>(0) - depth * up<Dim>()));
    return u;
}

/// A host whose faces answer to their own displacement, driven along a given path.
template <int Dim>
const contact::ContactStep<Dim>& drive(contact::Contact<Dim>& contact, const std::vector<Vector<Dim>>& u_0,
                                       const std::vector<Vector<Dim>>& u_1) {
    return contact.step({.displacement_0 = u_0,
                         .displacement_1 = u_1,
                         .coupling_of = [](auto listed) { return uncoupled<Dim>(listed.size(), 2.0); },
                         .gradients_of =
                             [](auto listed, auto y_0, auto y_1) {
                                 for (std::size_t i = 0; i < listed.size(); ++i)
                                     y_0[i] = y_1[i] = 0.1 * static_cast<double>(i) * Vector<Dim>::Ones();
                             }});
}

/// The way of the plates: down to deeper than D = 0.4, sliding, and up again.
template <int Dim>
std::vector<std::vector<Vector<Dim>>> way(const contact::Surface<Dim>& surface) {
    std::vector<std::vector<Vector<Dim>>> states;
    for (int i = 0; i <= 60; ++i) {
        const double t = i / 60.0;
        states.push_back(moved(surface, -0.1 + 0.7 * std::sin(std::numbers::pi * t), 1.7 * t));
    }
    return states;
}

template <class T>
bool same_bits(std::span<const T> a, std::span<const T> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

contact::ContactOptions deep(double skin = 0.1) {
    contact::ContactOptions options;
    options.compression_limit = 10.0;
    options.search.skin = skin;
    return options;
}

}  // namespace

TEST_CASE("a store keeps what pairs remember from list to list, and forgets pairs that leave", "[contact][store]") {
    PairStore store = store_of({faces(0, 3), faces(0, 4), faces(1, 3)}, true);
    store.memory()[1].admitted = false;
    store.follow(std::vector{faces(0, 2), faces(0, 4), faces(1, 3)}, [](std::size_t i) {
        CHECK(i == 0);  // only what is new is asked for
        return PairMemory{false};
    });
    CHECK(store.size() == 3);
    CHECK(store.find(faces(0, 3)) == nullptr);
    CHECK_FALSE(store.find(faces(0, 2))->admitted);
    CHECK_FALSE(store.find(faces(0, 4))->admitted);
    CHECK(store.find(faces(1, 3))->admitted);
}

TEST_CASE("pairs go from one owner to another and back without a loss", "[contact][store]") {
    PairStore store = store_of({faces(0, 3), faces(0, 4), faces(1, 3), faces(2, 5)}, true);
    store.memory()[2].admitted = false;
    const PairStore before = store;
    const PairStore given = store.release([](FacePair pair) { return pair.face_1 != SurfaceFace{0}; });
    CHECK(given.size() == 2);
    CHECK(store.size() == 2);
    CHECK(store.find(faces(1, 3)) == nullptr);
    CHECK_FALSE(given.find(faces(1, 3))->admitted);
    store.take(given);
    CHECK(store == before);
    CHECK_THROWS_AS(store.take(given), Misuse);
    CHECK_THROWS_WITH(store.take(given), Contains("faces 1 and 3 are a pair of both stores"));
    CHECK(store == before);
}

TEMPLATE_TEST_CASE_SIG("after save and restore the next steps have the same bits, also with pairs deeper than D",
                       "[contact][store]", ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>();
    const auto states = way(surface);
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

TEMPLATE_TEST_CASE_SIG("a state that is damaged, of another version, dimension or surface is refused, and nothing changes",
                       "[contact][store]", ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>();
    const auto states = way(surface);
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
        refuses(std::move(other).finish(), "version 99, 1 is needed");
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

TEMPLATE_TEST_CASE_SIG("one call a step does what search and integrate do", "[contact][step]", ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>();
    const auto states = way(surface);
    contact::Contact<Dim> one_call(surface.view(), deep(0.5));
    Mover<Dim> expert(surface, deep(0.5));
    std::int64_t active = 0;
    for (std::size_t i = 0; i + 1 < states.size(); ++i) {
        const auto& step = one_call.step({.displacement_0 = states[i],
                                          .displacement_1 = states[i + 1],
                                          .coupling_of = [](auto listed) { return uncoupled<Dim>(listed.size()); },
                                          .gradients_of =
                                              [](auto, auto y_0, auto y_1) {
                                                  std::ranges::fill(y_0, Vector<Dim>(Vector<Dim>::Ones()));
                                                  std::ranges::fill(y_1, Vector<Dim>(Vector<Dim>::Ones()));
                                              }});
        expert.search(states[i], states[i + 1]);
        expert.move_to(states[i + 1]);
        const auto& expected = expert.contact.last();
        REQUIRE(step.pairs.size() == expected.pairs.size());
        for (std::size_t p = 0; p < step.pairs.size(); ++p) CHECK(step.pairs[p].force == expected.pairs[p].force);
        CHECK(step.energy == expected.energy);
        active += static_cast<std::int64_t>(step.pairs.size());
    }
    CHECK(active > 50);
    CHECK(one_call.report().rebuilds < expert.contact.report().rebuilds);  // lists live for several steps
}

TEMPLATE_TEST_CASE_SIG("a host that gives nothing to ask, or a motion that is no number, is told so", "[contact][step]",
                       ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>();
    contact::Contact<Dim> contact(surface.view(), deep());
    const auto u = at_rest(surface);
    CHECK_THROWS_WITH(contact.step({.displacement_0 = u, .displacement_1 = u}), Contains("coupling_of"));
    auto lost = u;
    lost[2][0] = std::numeric_limits<double>::quiet_NaN();
    CHECK_NOTHROW(drive(contact, u, u));
    CHECK_THROWS_AS(drive(contact, u, lost), Diverged);
    try {
        drive(contact, u, lost);
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::diverged);
        CHECK(error.facts().face_1 == 2);
    }
    CHECK_NOTHROW(drive(contact, u, u));
}

TEMPLATE_TEST_CASE_SIG("an error of depth says which faces, how deep and what is allowed as numbers", "[contact][errors]",
                       ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>(1);
    contact::ContactOptions options = deep();
    options.compression_limit = 0.5;
    contact::Contact<Dim> contact(surface.view(), options);
    drive(contact, moved(surface, -0.1, 0.0), moved(surface, 0.1, 0.0));
    try {
        drive(contact, moved(surface, 0.1, 0.0), moved(surface, 0.3, 0.0));
        FAIL("0.3 of D = 0.4 is more than half");
    } catch (const TooDeep& error) {
        CHECK(error.kind() == ErrorKind::too_deep);
        CHECK(error.facts().face_1 == 0);
        CHECK(error.facts().face_2 == 1);
        CHECK(error.facts().value == Approx(0.75).epsilon(1e-13));
        CHECK(error.facts().allowed == 0.5);
    }
}
