// What pairs of facets remember, what a list may leave out, and what a look elsewhere must not change.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"
#include "contact/nodal_scenes.hpp"

using namespace abut;
using namespace abut::test;
using contact::Face;
using contact::NodalContact;
using contact::NodalStep;
using contact::TakenForce;

namespace {

using Corners = std::vector<Vector<2>>;

/// One face along the ground that looks up, and one above it that looks down; D = 0.2.
struct TwoFaces {
    NodalScene<2> scene;

    TwoFaces() {
        scene.rest = {Vector<2>(1, 0), Vector<2>(0, 0), Vector<2>(0, 0.1), Vector<2>(1, 0.1)};
        scene.faces.stiffness = {3.0, 3.0};
        scene.faces.append_face(std::vector<std::int32_t>{0, 1}, 0.1, 0);
        scene.faces.append_face(std::vector<std::int32_t>{2, 3}, 0.1, 1);
    }
    /// With the upper face's first corner there.
    [[nodiscard]] Corners at(double x, double y) const {
        Corners all = scene.rest;
        all[2] = {x, y};
        all[3] = {x + 1.0, y};
        return all;
    }
};

contact::NodalOptions with_skin(double skin) {
    contact::NodalOptions options;
    options.search.skin = skin;
    options.search.largest_motion = 100.0;
    return options;
}

/// Goes there in steps of at most 0.05; the last step.
const NodalStep<2>& go(NodalContact<2>& contact, const TwoFaces& faces, Vector<2> from, const Vector<2>& to) {
    const int n = static_cast<int>(std::ceil((to - from).norm() / 0.05));
    for (int i = 0; i < n; ++i) {
        const Vector<2> a = from + i * (to - from) / n, b = from + (i + 1) * (to - from) / n;
        contact.step(1.0, faces.at(a.x(), a.y()), faces.at(b.x(), b.y()));
    }
    return contact.last();
}

std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

bool has_part(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE(
    "an open face that comes in past the open end of another one touches where it is shallower than D / 100, and passes "
    "behind where it is deeper",
    "[contact][nodal]") {
    const TwoFaces faces;
    for (const double depth : {0.001, 0.0019, 0.0021, 0.1, 0.25, 0.3}) {
        NodalContact<2> contact(faces.scene.surface(), with_skin(0.05));
        const Corners beside = faces.at(2.0, -depth);
        contact.step(1.0, beside, beside);
        CHECK(go(contact, faces, {2.0, -depth}, {0.5, -depth}).is_active() == (depth < 0.002));
        CHECK(contact.report().missed_contacts == 0);
    }
}

TEST_CASE("a pair that leaves the list forgets that it was admitted", "[contact][nodal]") {
    const TwoFaces faces;
    NodalContact<2> contact(faces.scene.surface(), with_skin(0.05));
    const Corners above = faces.at(0.0, 0.1);
    contact.step(1.0, above, above);
    CHECK(go(contact, faces, {0.0, 0.1}, {0.0, -0.1}).is_active());  // admitted from above
    go(contact, faces, {0.0, -0.1}, {0.0, 0.1});
    go(contact, faces, {0.0, 0.1}, {4.0, 0.1});
    REQUIRE(contact.report().candidates == 0);
    go(contact, faces, {4.0, 0.1}, {4.0, -0.25});
    CHECK_FALSE(go(contact, faces, {4.0, -0.25}, {0.5, -0.25}).is_active());
    CHECK(contact.report().inadmissible_overlaps == 1);
}

TEST_CASE("what acts only inside a step is followed", "[contact][nodal]") {
    // Above at the start, past the end of the other face at the end, and for a moment in between pressed in by 0.003.
    const TwoFaces faces;
    NodalContact<2> contact(faces.scene.surface(), with_skin(0.5));
    const Corners start = faces.at(0.9, 0.001), end = faces.at(1.2, -0.019);
    contact.step(1.0, start, start);
    const NodalStep<2>& step = contact.step(1.0, start, end);
    const auto expected = geometry::pair_mean_gradient<2>({start[0], start[1], start[2], start[3]},
                                                          {end[0], end[1], end[2], end[3]}, {.stiffness = 1.5});
    REQUIRE(expected.active_share > 0.0);
    REQUIRE(step.pairs.size() == 1);
    CHECK(step.pairs[0].active_share == expected.active_share);
    CHECK(forces<2>(step, 4)[2] == -expected.gradient[2]);
}

TEST_CASE("to evaluate elsewhere changes nothing that the next steps depend on", "[contact][nodal]") {
    const TwoFaces faces;
    NodalContact<2> contact(faces.scene.surface(), with_skin(0.05)), other(faces.scene.surface(), with_skin(0.05));
    const Corners apart = faces.at(0.0, 0.02), closed = faces.at(0.1, -0.05), on = faces.at(0.1, -0.06);
    for (auto* one : {&contact, &other}) {
        one->step(1.0, apart, apart);
        one->step(1.0, apart, closed);
    }
    REQUIRE(contact.last().is_active());
    const double energy = contact.evaluate(closed).energy;
    const auto state = contact.state();
    for (const Corners& far : {faces.at(5.0, 3.0), faces.at(0.1, 2.0), faces.at(-7.0, -0.1)}) {
        CHECK(contact.evaluate(far).energy == 0.0);
        CHECK(contact.state() == state);
        CHECK(contact.evaluate(closed).energy == energy);
    }
    CHECK_THROWS_AS(contact.evaluate(faces.at(std::nan(""), 0.0)), Diverged);
    CHECK(contact.state() == state);
    const auto expected = forces<2>(other.step(1.0, closed, on), 4);
    CHECK(forces<2>(contact.step(1.0, closed, on), 4) == expected);
    CHECK(contact.report().missed_contacts == 0);
}

TEST_CASE("W is that of the pair at any depth, whether a list holds there or not", "[contact][nodal]") {
    const TwoFaces faces;
    for (const double skin : {0.02, 3.0}) {
        NodalContact<2> contact(faces.scene.surface(), with_skin(skin));
        const Corners apart = faces.at(0.0, 0.01), closed = faces.at(0.0, -0.01);
        contact.step(1.0, apart, apart);
        contact.step(1.0, apart, closed);
        for (const double depth : {0.1, 0.5, 0.9})  // far more than the limit of 2 D
            CHECK(contact.evaluate(faces.at(0.0, -depth)).energy == Approx(0.5 * 1.5 * depth * depth));
    }
}

TEST_CASE("pairs have their gaps at both ends, whatever force is taken", "[contact][nodal]") {
    const TwoFaces faces;
    for (const TakenForce take : {TakenForce::mean, TakenForce::end}) {
        NodalContact<2> contact(faces.scene.surface());
        contact.step(1.0, faces.at(0.0, 0.01), faces.at(0.0, -0.08), take);
        const auto& pair = contact.step(1.0, faces.at(0.0, -0.08), faces.at(0.0, -0.02), take).pairs.at(0);
        CHECK(pair.gap_0 == Approx(-0.08));
        CHECK(pair.gap_1 == Approx(-0.02));
        CHECK(pair.compression == Approx(0.4));
        const auto& at_one = contact.evaluate(faces.at(0.0, -0.02)).pairs.at(0);
        CHECK(at_one.gap_0 == at_one.gap_1);
    }
}

TEST_CASE("errors name the faces of the host, not their halves", "[contact][nodal]") {
    const auto scene = two_boxes<3>(2, 3, 0.02, 0.013, 3.0, 5.0, false);
    NodalContact<3> contact(scene.surface());
    auto broken = scene.rest;
    broken.back()[1] = std::nan("");
    try {
        contact.step(1.0, scene.rest, broken);
        FAIL("not refused");
    } catch (const Diverged& error) {
        const auto face = static_cast<std::size_t>(error.facts().face_1);
        REQUIRE(face < scene.faces.body.size());
        bool has_it = false;
        for (std::int32_t i = scene.faces.offsets[face]; i < scene.faces.offsets[face + 1]; ++i)
            has_it = has_it || scene.faces.nodes[i] + 1 == static_cast<std::int32_t>(scene.rest.size());
        CHECK(has_it);
        CHECK(has_part(error.what(), "face " + std::to_string(face) + " "));
    }
}

TEST_CASE("faces of bodies that have become one, or rigid, press on each other no more", "[contact][nodal]") {
    const TwoFaces faces;
    const Corners apart = faces.at(0.0, 0.01), closed = faces.at(0.0, -0.05);
    const std::vector<std::int32_t> old_face_of{0, 1};
    NodalScene<2> one_body = faces.scene, both_rigid = faces.scene;
    one_body.faces.body = {0, 0};
    both_rigid.faces.stiffness.assign(2, std::numeric_limits<double>::infinity());
    for (const NodalScene<2>& next : {one_body, both_rigid}) {
        NodalContact<2> contact(faces.scene.surface());
        contact.step(1.0, apart, apart);
        REQUIRE(contact.step(1.0, apart, closed).is_active());
        contact.surface_replaced(next.surface(), old_face_of);
        CHECK_FALSE(contact.step(1.0, closed, closed).is_active());
    }
    NodalContact<2> contact(faces.scene.surface());
    const auto refused = [&](std::vector<std::int32_t> old) {
        return message_of([&] { contact.surface_replaced(faces.scene.surface(), old); });
    };
    NodalContact<2> before(faces.scene.surface());
    before.step(1.0, apart, apart);
    before.step(1.0, apart, closed);
    contact.take_over(before, old_face_of);  // made for its surface, with options of its own
    CHECK(contact.report().rebuilds == before.report().rebuilds);
    CHECK(contact.step(1.0, closed, closed).energy == before.step(1.0, closed, closed).energy);
    contact::NodalOptions rough;
    rough.friction.laws = {{.coefficient = 0.3}};
    contact::NodalFaces<2> with_shear = faces.scene.faces.view();
    const std::vector<double> shear{1.0, 1.0};
    with_shear.shear_stiffness = shear;
    NodalContact<2> rubbing(contact::NodalSurface<2>(faces.scene.rest, with_shear), rough);
    CHECK(has_part(message_of([&] { rubbing.take_over(before, old_face_of); }), "same laws of friction"));
    CHECK(has_part(refused({0, 0}), "which another one is, too"));
    CHECK(has_part(refused({0, 2}), "there were 2 faces"));
    CHECK(has_part(refused({0}), "give one each"));
}

TEST_CASE("the run begins for a new face: it is in contact where its nodes are pressed in", "[contact][nodal]") {
    // The lower face erodes; two that lie in its place have a node between them, which was there before.
    TwoFaces faces;
    faces.scene.rest.push_back({0.5, 0.0});
    NodalScene<2> next = faces.scene;
    next.faces.nodes = {0, 4, 4, 1, 2, 3};
    next.faces.offsets = {0, 2, 4, 6};
    next.faces.body = {0, 0, 1};
    next.faces.depth.assign(3, 0.1);
    const std::vector<std::int32_t> old_face_of{-1, -1, 1};
    const auto at = [&](double y) { return faces.at(0.0, y); };

    NodalContact<2> contact(faces.scene.surface());
    contact.step(1.0, at(0.01), at(0.01));
    const double before = contact.step(1.0, at(0.01), at(-0.05)).energy;
    CHECK(before == Approx(0.5 * 1.5 * 0.05 * 0.05));
    contact.surface_replaced(next.surface(), old_face_of);
    NodalContact<2> restarted(next.surface());
    restarted.restore(contact.state());  // before anybody has looked at the new faces
    CHECK(contact.evaluate(at(0.01)).energy == 0.0);
    CHECK(contact.evaluate(at(-0.05)).energy == Approx(before));
    CHECK(contact.step(1.0, at(-0.05), at(-0.05)).energy == Approx(before));
    CHECK(contact.report().missed_contacts == 0);
    CHECK(restarted.step(1.0, at(-0.05), at(-0.05)).energy == contact.last().energy);

    // A second time, before a step: what was new stays new.
    NodalContact<2> twice(faces.scene.surface());
    twice.step(1.0, at(0.01), at(0.01));
    twice.step(1.0, at(0.01), at(-0.05));
    twice.surface_replaced(next.surface(), old_face_of);
    twice.surface_replaced(next.surface(), std::vector<std::int32_t>{0, 1, 2});
    CHECK(twice.step(1.0, at(-0.05), at(-0.05)).energy == Approx(before));
    CHECK(twice.report().missed_contacts == 0);

    // A face that turns up deeper than D is a far side, as at a start.
    NodalContact<2> deep(faces.scene.surface());
    deep.step(1.0, at(1.0), at(1.0));
    deep.surface_replaced(next.surface(), old_face_of);
    CHECK_FALSE(deep.step(1.0, at(-0.25), at(-0.25)).is_active());
}

namespace {

/// Pairs are not wanted, or all faces are covered, while `holds` is true.
contact::NodalOptions held_apart(contact::NodalOptions options, const bool& holds, bool covers) {
    if (covers)
        options.covered = [&holds](Face) { return holds; };
    else
        options.wanted = [&holds](Face, Face) { return !holds; };
    return options;
}

}  // namespace

TEST_CASE(
    "faces that were held together and lie inside of each other as they are let go bear k A/2 times the square of what they "
    "are pressed in more, and of all of it once they have been apart",
    "[contact][nodal]") {
    const TwoFaces faces;
    bool holds = true;
    const contact::NodalOptions options = held_apart(with_skin(0.05), holds, GENERATE(false, true));
    const auto at = [&](double y) { return faces.at(0.0, y); };
    NodalContact<2> contact(faces.scene.surface(), options);
    contact.step(1.0, at(-0.05), at(-0.05));
    holds = false;
    contact.search(at(-0.05), at(-0.05));
    CHECK(contact.step(1.0, at(-0.05), at(-0.05)).energy == 0.0);
    NodalContact<2> restarted(faces.scene.surface(), options);
    restarted.restore(contact.state());
    CHECK(go(contact, faces, {0.0, -0.05}, {0.0, -0.08}).energy == Approx(0.5 * 1.5 * 0.03 * 0.03));
    CHECK(go(restarted, faces, {0.0, -0.05}, {0.0, -0.08}).energy == contact.last().energy);
    CHECK(contact.evaluate(at(-0.07)).energy == Approx(0.5 * 1.5 * 0.02 * 0.02));
    go(contact, faces, {0.0, -0.08}, {0.0, 0.01});
    CHECK(go(contact, faces, {0.0, 0.01}, {0.0, -0.05}).energy == Approx(0.5 * 1.5 * 0.05 * 0.05));
    CHECK(contact.report().missed_contacts == 0);
}

TEST_CASE(
    "faces that were held together have the energy from the moment on that they are let go with, all of their overlap's at "
    "most",
    "[contact][nodal]") {
    const TwoFaces faces;
    bool holds = true;
    contact::NodalOptions options = held_apart(with_skin(0.05), holds, GENERATE(false, true));
    const double pressed = GENERATE(0.02, 0.08), acts = std::min(pressed, 0.05);
    options.energy_at_first = [pressed](Face, Face) { return 0.5 * 1.5 * pressed * pressed; };
    const auto at = [&](double y) { return faces.at(0.0, y); };
    NodalContact<2> contact(faces.scene.surface(), options);
    contact.step(1.0, at(-0.05), at(-0.05));
    holds = false;
    contact.end_list();
    CHECK(contact.evaluate(at(-0.05)).energy == Approx(0.5 * 1.5 * acts * acts).epsilon(1e-12));
    CHECK(contact.step(1.0, at(-0.05), at(-0.05)).energy == Approx(0.5 * 1.5 * acts * acts).epsilon(1e-12));
    CHECK(contact.last().energy <= 0.5 * 1.5 * pressed * pressed);
    CHECK(go(contact, faces, {0.0, -0.05}, {0.0, -0.06}).energy == Approx(0.5 * 1.5 * std::pow(acts + 0.01, 2)));
    go(contact, faces, {0.0, -0.06}, {0.0, 0.01});
    CHECK(go(contact, faces, {0.0, 0.01}, {0.0, -0.05}).energy == Approx(0.5 * 1.5 * 0.05 * 0.05));
    CHECK(contact.report().missed_contacts == 0);
}

TEST_CASE("faces that were let go while they were apart are a missed contact where they are first seen inside of each other",
          "[contact][nodal]") {
    const TwoFaces faces;
    bool holds = true;
    contact::NodalOptions options = held_apart(with_skin(0.05), holds, GENERATE(false, true));
    options.pieces = {0, 0};
    NodalContact<2> contact(faces.scene.surface(), options);
    contact.step(1.0, faces.at(0.0, 0.01), faces.at(0.0, 0.01));
    holds = false;
    contact.search(faces.at(5.0, 0.01), faces.at(5.0, 0.01));
    NodalContact<2> restarted(faces.scene.surface(), options);
    restarted.restore(contact.state());
    for (NodalContact<2>* each : {&contact, &restarted}) {
        each->search(faces.at(0.0, -0.05), faces.at(0.0, -0.05));  // a jump that no list has foreseen
        CHECK_FALSE(each->step(1.0, faces.at(0.0, -0.05), faces.at(0.0, -0.06)).is_active());
        CHECK(each->report().missed_contacts == 1);
    }
}

TEST_CASE("forces on obstacles that a host has appended to its nodes are left out of its own", "[contact][nodal]") {
    TwoFaces faces;
    auto scene = faces.scene;
    const auto obstacle =
        scene.faces.append_obstacle(contact::plane_obstacle<2>(Vector<2>(0, -0.2), Vector<2>(0, 1), 5.0), scene.rest);
    scene.faces.body[0] = 0;
    NodalContact<2> contact(scene.surface());
    auto pressed = scene.rest;
    // The upper face, two units aside of the lower one, goes down onto the plane.
    for (auto* x : {&scene.rest, &pressed}) (*x)[2] = {2.0, -0.1}, (*x)[3] = {3.0, -0.1};
    pressed[2].y() = pressed[3].y() = -0.21;
    contact.step(1.0, scene.rest, scene.rest);
    const NodalStep<2>& step = contact.step(1.0, scene.rest, pressed);
    REQUIRE(step.is_active());
    REQUIRE(step.nodes.back() >= 4);
    std::vector<double> own(8, 0.0), guard(9, 7.0);
    step.add_force_to(std::span(guard).first(8));
    CHECK(guard[8] == 7.0);
    step.add_force_to(std::span(own));
    const auto all = forces<2>(step, scene.rest.size());
    for (int i = 0; i < 4; ++i)
        for (int d = 0; d < 2; ++d) CHECK(own[2 * i + d] == all[i][d]);
    const auto on = std::ranges::find(step.bodies, obstacle, &contact::BodyStep<2>::body);
    REQUIRE(on != step.bodies.end());
    CHECK(on->force.y() == Approx(-(own[5] + own[7])));
    CHECK(on->moment[0] == Approx(2.5 * on->force.y()));  // about the origin
    CHECK_THROWS_AS(step.add_force_to(std::span(guard)), BadInput);
    CHECK(step.least_force_size == 4);
    CHECK_THROWS_AS(step.add_force_to(std::span(own).first(6)), BadInput);  // a force would be lost
}

TEST_CASE("faces with four corners are cut inside, and refused where their edges cross", "[contact][nodal]") {
    NodalScene<3> scene;
    scene.faces.stiffness = {1.0};
    scene.rest = {Vector<3>(-1, 0, 0), Vector<3>(0, 0.2, 0), Vector<3>(1, 0, 0), Vector<3>(0, 5, 0)};  // a dart
    scene.faces.append_face(std::vector<std::int32_t>{0, 1, 2, 3}, 0.1, 0);
    const auto surface = scene.surface();
    REQUIRE(surface.facets().size() == 2);
    CHECK(surface.facets().area[0] + surface.facets().area[1] == Approx(0.5 * 2.0 * 5.0 - 0.5 * 2.0 * 0.2));
    for (const Vector<3>& normal : surface.facets().normal) CHECK(normal.z() == Approx(1.0));
    scene.rest = {Vector<3>(0, 0, 0), Vector<3>(1, 1, 0), Vector<3>(1, 0, 0), Vector<3>(0, 1, 0)};
    CHECK(has_part(message_of([&] { static_cast<void>(scene.surface()); }), "edges that cross"));
    scene.faces.nodes.push_back(0);
    CHECK(has_part(message_of([&] { static_cast<void>(scene.surface()); }), "`offsets` goes from 0 to 4"));
}

TEMPLATE_TEST_CASE_SIG("bodies whose faces look inwards are told of", "[contact][nodal]", ((int Dim), Dim), 2, 3) {
    auto scene = two_boxes<Dim>(2, 3, 0.1);
    CHECK(scene.surface().inward_bodies().empty());
    for (std::size_t face = 0; face < scene.faces.body.size(); ++face)
        if (scene.faces.body[face] == 1)
            std::reverse(scene.faces.nodes.begin() + scene.faces.offsets[face],
                         scene.faces.nodes.begin() + scene.faces.offsets[face + 1]);
    CHECK(scene.surface().inward_bodies() == std::vector{1});
    scene.faces.append_obstacle(contact::plane_obstacle<Dim>(Vector<Dim>::Zero(), up<Dim>(), 1.0), scene.rest);
    CHECK(scene.surface().inward_bodies() == std::vector{1});
}
