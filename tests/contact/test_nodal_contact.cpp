#include <oneapi/tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "abut/base/error.hpp"
#include "abut/contact/surface/unseen_edges.hpp"
#include "contact/nodal_scenes.hpp"

using namespace abut;
using namespace abut::test;
using contact::Face;
using contact::NodalContact;
using contact::NodalStep;

namespace {

/// Down into the other box and up again, turning a little: positions of the nodes at step i of 40.
template <int Dim>
std::vector<Vector<Dim>> rocking(const NodalScene<Dim>& scene, int i) {
    const double s = i / 40.0;
    const Vector<Dim> centre = 0.5 * Vector<Dim>::Ones() + up<Dim>();
    return placed<Dim>(scene, 1, turned_about<Dim>(centre, 0.05 * std::sin(5.0 * s), -0.08 * std::sin(3.1 * s) * up<Dim>()));
}

template <int Dim>
std::string message_of(const NodalScene<Dim>& scene, const contact::NodalOptions& options = {}) {
    try {
        NodalContact<Dim> contact(scene.surface(), options);
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEMPLATE_TEST_CASE_SIG("the far side of a thin body is no contact, and no force comes from it", "[contact][nodal]",
                       ((int Dim), Dim), 2, 3) {
    // Two plates, 0.06 thick, with D = 0.04: the bottom of the lower one and the top of the upper one look away from each
    // other, 0.13 apart, and would be pressed in by that much if depth did not count.
    NodalScene<Dim> scene;
    append_box<Dim>(scene, Vector<Dim>::Zero(), Vector<Dim>::Ones() - 0.94 * up<Dim>(), counts<Dim>(2), 3.0, 0.02);
    append_box<Dim>(scene, 0.07 * up<Dim>(), Vector<Dim>::Ones() - 0.87 * up<Dim>(), counts<Dim>(3), 3.0, 0.02);
    contact::NodalOptions options;
    options.search.skin = 0.2;
    options.compression_limit = 5.0;  // pairs up to 0.2 deep are listed
    NodalContact<Dim> contact(scene.surface(), options);
    CHECK_FALSE(contact.step(1.0, scene.rest, scene.rest).is_active());
    REQUIRE(contact.report().inadmissible_overlaps > 0);  // they are listed
    const auto closed = placed<Dim>(scene, 1, shifted<Dim>(-0.02 * up<Dim>()));
    const NodalStep<Dim>& step = contact.step(1.0, scene.rest, closed);
    REQUIRE(step.is_active());
    for (const auto& pair : step.pairs) CHECK(std::min(pair.gap_0, pair.gap_1) > -0.011);
    CHECK(contact.report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("a pair first seen deep inside is no contact; one that should have been seen is counted",
                       "[contact][nodal]", ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(2, 3, 0.5);
    contact::NodalOptions options;
    options.search.skin = 1e-6;
    options.search.largest_motion = 10.0;
    for (const double depth : {0.05, 0.25}) {  // D = 0.2
        NodalContact<Dim> contact(scene.surface(), options);
        contact.step(1.0, scene.rest, scene.rest);
        const auto inside = placed<Dim>(scene, 1, shifted<Dim>(-(0.5 + depth) * up<Dim>()));
        const NodalStep<Dim>& step = contact.step(1.0, inside, inside);  // a host that jumped there
        CHECK_FALSE(step.is_active());
        CHECK((contact.report().missed_contacts > 0) == (depth < 0.2));
        CHECK(contact.report().inadmissible_overlaps > 0);
        // At the very start of a run shallow pairs are contacts.
        NodalContact<Dim> from_there(scene.surface(), options);
        CHECK(from_there.step(1.0, inside, inside).is_active() == (depth < 0.2));
    }
}

TEMPLATE_TEST_CASE_SIG("restored from a state the next steps have the same bits", "[contact][nodal]", ((int Dim), Dim), 2,
                       3) {
    const auto scene = two_boxes<Dim>(3, 4, 0.02);
    NodalContact<Dim> whole(scene.surface()), again(scene.surface());
    for (int i = 0; i < 20; ++i) whole.step(1.0, rocking<Dim>(scene, i), rocking<Dim>(scene, i + 1));
    REQUIRE(whole.last().is_active());
    again.restore(whole.state());
    for (int i = 20; i < 40; ++i) {
        const auto x_0 = rocking<Dim>(scene, i), x_1 = rocking<Dim>(scene, i + 1);
        const auto& a = whole.step(1.0, x_0, x_1);
        const auto& b = again.step(1.0, x_0, x_1);
        REQUIRE(forces<Dim>(a, x_0.size()) == forces<Dim>(b, x_0.size()));
        REQUIRE(a.energy == b.energy);
    }
    CHECK(whole.report().events == again.report().events);
    CHECK(whole.report().compression_max == again.report().compression_max);
    auto damaged = whole.state();
    damaged[damaged.size() / 2] ^= std::byte{1};
    CHECK_THROWS_AS(again.restore(damaged), BadInput);
    NodalContact<Dim> other(two_boxes<Dim>(3, 5, 0.02).surface());
    CHECK_THROWS_AS(other.restore(whole.state()), BadInput);
}

TEMPLATE_TEST_CASE_SIG("faces that erode take their pairs along, and the others remember", "[contact][nodal]",
                       ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(3, 4, 0.02);
    NodalContact<Dim> contact(scene.surface());
    for (int i = 0; i < 20; ++i) contact.step(1.0, rocking<Dim>(scene, i), rocking<Dim>(scene, i + 1));
    const auto x = rocking<Dim>(scene, 20);
    const NodalStep<Dim> before = contact.step(1.0, x, x);
    REQUIRE(before.pairs.size() > 3);
    const Face gone = before.pairs[1].face_1;

    NodalScene<Dim> eroded = scene;
    eroded.faces.nodes.clear();
    eroded.faces.offsets = {0};
    eroded.faces.body.clear();
    eroded.faces.depth.clear();
    std::vector<std::int32_t> old_face_of;
    for (std::int32_t face = contact.surface().n_faces(); face-- > 0;) {  // also in another order
        if (face == number_of(gone)) continue;
        const auto begin = scene.faces.nodes.begin() + scene.faces.offsets[face];
        eroded.faces.append_face(std::vector<std::int32_t>(begin, begin + Dim), scene.faces.depth[face],
                                 scene.faces.body[face]);
        old_face_of.push_back(face);
    }
    contact.surface_replaced(eroded.surface(), old_face_of);
    const NodalStep<Dim>& after = contact.step(1.0, x, x);
    std::size_t expected = 0;
    for (const auto& pair : before.pairs)
        if (pair.face_1 != gone) ++expected;
    CHECK(after.pairs.size() == expected);
    CHECK(after.energy < before.energy);
    CHECK(contact.report().missed_contacts == 0);

    old_face_of[0] = old_face_of[1];
    CHECK_THROWS_AS(contact.surface_replaced(eroded.surface(), old_face_of), BadInput);
    CHECK(contact.step(1.0, x, x).pairs.size() == expected);  // as it was
}

TEST_CASE("a report tells of no contact where the list has become empty", "[contact][nodal]") {
    const auto scene = two_boxes<2>(3, 4, 0.02);
    contact::NodalOptions options;
    options.search.largest_motion = 10.0;
    NodalContact<2> contact(scene.surface(), options);
    const auto closed = placed<2>(scene, 1, shifted<2>({0.0, -0.03})), away = placed<2>(scene, 1, shifted<2>({0.0, 5.0}));
    contact.step(1.0, scene.rest, scene.rest);
    contact.step(1.0, scene.rest, closed);
    REQUIRE(contact.report().active_pairs > 0);
    contact.step(1.0, away, away);
    CHECK(contact.report().candidates == 0);
    CHECK(contact.report().active_pairs == 0);
    CHECK_FALSE(contact.last().is_active());
}

TEST_CASE("pairs that are not wanted do not touch", "[contact][nodal]") {
    const auto scene = two_boxes<2>(3, 4, 0.02);
    contact::NodalOptions options;
    NodalContact<2> all(scene.surface());
    all.step(1.0, scene.rest, scene.rest);
    const auto closed = placed<2>(scene, 1, shifted<2>({0.0, -0.03}));
    const auto found = all.step(1.0, scene.rest, closed).pairs;
    REQUIRE(found.size() > 3);
    const Face left_out = found[0].face_1;
    options.wanted = [&](Face face_1, Face face_2) { return face_1 != left_out && face_2 != left_out; };
    NodalContact<2> some(scene.surface(), options);
    some.step(1.0, scene.rest, scene.rest);
    for (const auto& pair : some.step(1.0, scene.rest, closed).pairs) CHECK(pair.face_1 != left_out);
    CHECK(some.last().is_active());
    CHECK(some.last().pairs.size() < found.size());
}

TEST_CASE("covered faces are in no pair, and the others touch as before", "[contact][nodal]") {
    const auto scene = two_boxes<2>(3, 4, 0.02);
    NodalContact<2> all(scene.surface());
    all.step(1.0, scene.rest, scene.rest);
    const auto closed = placed<2>(scene, 1, shifted<2>({0.0, -0.03}));
    const auto found = all.step(1.0, scene.rest, closed).pairs;
    REQUIRE(found.size() > 3);
    const Face covered = found[0].face_1;
    NodalContact<2> some(scene.surface(), {.covered = [&](Face face) { return face == covered; }});
    some.step(1.0, scene.rest, scene.rest);
    std::vector<contact::PairStep<2>> expected;
    for (const auto& pair : found)
        if (pair.face_1 != covered && pair.face_2 != covered) expected.push_back(pair);
    const auto left = some.step(1.0, scene.rest, closed).pairs;
    REQUIRE(left.size() == expected.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
        CHECK(left[i].face_1 == expected[i].face_1);
        CHECK(left[i].face_2 == expected[i].face_2);
        CHECK(left[i].force == expected[i].force);
    }
    CHECK(some.report().candidates < all.report().candidates);
}

TEMPLATE_TEST_CASE_SIG("forces have the same bits for any number of threads and every broad phase", "[contact][nodal]",
                       ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(Dim == 2 ? 300 : 8, Dim == 2 ? 350 : 9, 0.002);
    std::vector<std::vector<Vector<Dim>>> results;
    for (const int threads : {1, 4})
        for (const auto method : geometry::broad_phases()) {
            const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
            contact::NodalOptions options;
            options.search.broad_phase = method;
            NodalContact<Dim> contact(scene.surface(), options);
            contact.step(1.0, scene.rest, scene.rest);
            results.push_back(forces<Dim>(contact.step(1.0, scene.rest, rocking<Dim>(scene, 5)), scene.rest.size()));
            CHECK(contact.last().is_active());
        }
    for (const auto& result : results) CHECK(result == results.front());
}

TEMPLATE_TEST_CASE_SIG("evaluate gives W and its gradient where a step ended, and changes nothing", "[contact][nodal]",
                       ((int Dim), Dim), 2, 3) {
    const auto scene = two_boxes<Dim>(3, 4, 0.02);
    NodalContact<Dim> contact(scene.surface());
    for (int i = 0; i < 12; ++i) contact.step(1.0, rocking<Dim>(scene, i), rocking<Dim>(scene, i + 1));
    const auto x = rocking<Dim>(scene, 12);
    const double energy = contact.last().energy;
    const auto report = contact.report();
    REQUIRE(energy > 0.0);
    CHECK(contact.evaluate(x).energy == Approx(energy).epsilon(1e-13));
    const auto at_rest = forces<Dim>(contact.last(), x.size());
    CHECK(contact.report().events == report.events);
    // Central differences of W along a direction.
    std::mt19937 random(4);
    std::vector<Vector<Dim>> more = x, less = x, along;
    for (std::size_t i = 0; i < x.size(); ++i) {
        along.push_back(random_vector<Dim>(random, 1.0));
        more[i] += 1e-6 * along[i];
        less[i] -= 1e-6 * along[i];
    }
    double work = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) work += at_rest[i].dot(along[i]);
    const double difference = (contact.evaluate(more).energy - contact.evaluate(less).energy) / 2e-6;
    CHECK(difference == Approx(-work).epsilon(1e-6));
}

TEST_CASE("which way faces must look to be listed has no effect", "[contact][nodal]") {
    const auto scene = two_boxes<2>(3, 4, 0.02);
    const auto closed = placed<2>(scene, 1, shifted<2>({0.0, -0.15}));
    std::vector<double> energies;
    for (const double cosine : {-0.2, 1.0}) {
        contact::NodalOptions options;
        options.search.facing_cosine = cosine;
        options.search.skin = 1e-3;
        NodalContact<2> contact(scene.surface(), options);
        contact.step(1.0, scene.rest, scene.rest);
        energies.push_back(contact.step(1.0, scene.rest, closed).energy);
    }
    CHECK(energies[0] > 0.0);
    CHECK(energies[0] == energies[1]);
}

TEST_CASE("edges that are too sharp to be seen are told before a run", "[contact][nodal]") {
    const auto scene = two_boxes<3>(2, 3, 0.02);  // edges of 90 degrees: sin(45 degrees)^2 = 0.5
    CHECK_FALSE(NodalContact<3>(scene.surface()).unseen_edges());
    contact::NodalOptions options;
    options.facing = {.full = -0.9, .none = -0.45};  // a quarter of the weight at -0.597
    const auto unseen = NodalContact<3>(scene.surface(), options).unseen_edges();
    REQUIRE(unseen);
    CHECK(unseen->facing() == Approx(0.5).epsilon(1e-12));
    options.facing = {.full = -0.9, .none = -0.3};  // at -0.496
    CHECK_FALSE(NodalContact<3>(scene.surface(), options).unseen_edges());
}

TEST_CASE("input of a host that cannot be used is refused by name", "[contact][nodal]") {
    const auto good = two_boxes<3>(2, 2, 0.1);
    CHECK(message_of(good).empty());
    auto scene = good;
    scene.faces.depth[3] = -1.0;
    CHECK(has(message_of(scene), "face 3 has the depth -1"));
    scene = good;
    scene.faces.nodes[4] = 1000;
    CHECK(has(message_of(scene), "face 1 names node 1000"));
    scene = good;
    scene.faces.nodes[1] = scene.faces.nodes[0];
    CHECK(has(message_of(scene), "face 0 has no area"));
    scene = good;
    scene.faces.stiffness[1] = 0.0;
    CHECK(has(message_of(scene), "body 1 has the stiffness 0"));
    scene = good;
    scene.faces.body[2] = 7;
    CHECK(has(message_of(scene), "face 2 belongs to body 7"));
    scene = good;
    scene.rest[0][1] = std::numeric_limits<double>::quiet_NaN();
    CHECK(has(message_of(scene), "not finite"));
    scene = good;
    scene.faces.depth.pop_back();
    CHECK(has(message_of(scene), "`depth` has"));
    contact::NodalOptions options;
    options.compression_limit = 0.0;
    CHECK(has(message_of(good, options), "compression_limit"));
    options = {};
    options.facing = {.full = -0.2, .none = -0.6};
    CHECK(has(message_of(good, options), "facing.full"));
    CHECK_THROWS_AS(contact::skin_stiffness(-1.0, std::vector{1.0}), BadInput);
    CHECK_THROWS_AS(contact::skin_stiffness(1.0, std::vector<double>{}), BadInput);
    CHECK(contact::skin_stiffness(6.0, std::vector{1.0, 2.0}) == Approx(4.0));
}

TEST_CASE("a step that cannot be is refused, and the next one goes on", "[contact][nodal]") {
    const auto scene = two_boxes<3>(2, 3, 0.02);
    NodalContact<3> contact(scene.surface());
    contact.step(1.0, scene.rest, scene.rest);
    auto broken = scene.rest;
    broken[5][1] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(contact.step(1.0, scene.rest, broken), Diverged);
    broken = scene.rest;
    broken[5][1] = 1e6;
    CHECK_THROWS_AS(contact.step(1.0, scene.rest, broken), Diverged);
    broken.pop_back();
    CHECK_THROWS_AS(contact.step(1.0, scene.rest, broken), BadInput);
    const auto closed = placed<3>(scene, 1, shifted<3>({0.0, 0.0, -0.03}));
    CHECK(contact.step(1.0, scene.rest, closed).is_active());
    const auto deep = placed<3>(scene, 1, shifted<3>({0.0, 0.0, -0.5}));  // D = 0.2, 2 D is allowed
    try {
        contact.step(1.0, closed, deep);
        FAIL("not refused");
    } catch (const TooDeep& error) {
        CHECK(error.facts().value > 2.0);
        CHECK(error.facts().face_1 >= 0);
        CHECK(has(error.what(), "body 0"));
    }
    CHECK(contact.step(1.0, scene.rest, closed).is_active());
}

TEST_CASE("the stable step adds the springs at the worst node of both bodies", "[contact][nodal]") {
    // Squares of unit sides, 2 and 4 faces a side: at a corner meet two faces, at any other node as well.
    const auto scene = two_boxes<2>(2, 4, 0.02, 0.013, 3.0, 5.0);
    NodalContact<2> contact(scene.surface());
    std::vector<double> mass;
    for (const std::int32_t body : scene.node_body) mass.push_back(body == 0 ? 0.1 : 0.2);
    const double k = 15.0 / 8.0, raised = k * 0.5 / 0.1 + k * 0.25 / 0.2;
    const auto step = contact.stable_step(mass, 10.0);
    CHECK(step.omega == Approx(std::sqrt(100.0 + raised)).epsilon(1e-12));
    CHECK(step.dt == Approx(0.85 * 2.0 / step.omega).epsilon(1e-12));
    CHECK(step.node >= 0);
    CHECK(has(step.reason, "omega"));
    CHECK_THROWS_AS(contact.stable_step(mass, -1.0), BadInput);
    mass[0] = 0.0;
    CHECK_THROWS_AS(contact.stable_step(mass, 1.0), BadInput);
    // A body alone.
    NodalScene<2> alone;
    append_box<2>(alone, {0, 0}, {1, 1}, {2, 2}, 3.0, 0.1);
    CHECK(NodalContact<2>(alone.surface()).stable_step(std::vector<double>(alone.rest.size(), 1.0), 10.0).dt ==
          Approx(0.17).epsilon(1e-12));
}
