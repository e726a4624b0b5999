// A step of contact as a host asks for it.
#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

#include "abut/contact/contact.hpp"
#include "contact/plates.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Matchers::Contains;
using contact::Face;

namespace {

/// A host whose gradients are constant and do not answer to corrections: what a pair does depends on nothing but itself.
template <int Dim>
contact::HostStep<Dim> constant_host(const std::vector<Vector<Dim>>& u_0, const std::vector<Vector<Dim>>& u_1,
                                     contact::TakenForce take = contact::TakenForce::mean) {
    return {.displacement_0 = u_0,
            .displacement_1 = u_1,
            .coupling_of = [](auto listed) { return uncoupled<Dim>(listed.size(), 0.0); },
            .gradients_of =
                [](auto, auto y_0, auto y_1) {
                    std::ranges::fill(y_0, Vector<Dim>::Ones());
                    std::ranges::fill(y_1, Vector<Dim>::Ones());
                },
            .take = take};
}

/// A pair that shares a face with others is cut where these change, too: its force may differ by rounding.
template <int Dim>
void check_same_pair(const contact::PairStep<Dim>& a, const contact::PairStep<Dim>& b) {
    CHECK(a.face_1 == b.face_1);
    CHECK(a.face_2 == b.face_2);
    CHECK(a.gap_1 == b.gap_1);
    CHECK(a.area == b.area);
    CHECK((a.force - b.force).norm() <= 1e-14 * b.force.norm());
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("one call per step does what search and integrate do", "[contact][step]", ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>();
    const auto states = path_of_plates(surface);
    contact::Contact<Dim> one_call(surface.view(), deep(0.5));
    Mover<Dim> expert(surface, deep(0.5));
    std::int64_t active = 0;
    for (std::size_t i = 0; i + 1 < states.size(); ++i) {
        const auto& step = one_call.step(1.0, {.displacement_0 = states[i],
                                               .displacement_1 = states[i + 1],
                                               .coupling_of = [](auto listed) { return uncoupled<Dim>(listed.size()); },
                                               .gradients_of =
                                                   [](auto, auto y_0, auto y_1) {
                                                       std::ranges::fill(y_0, Vector<Dim>::Ones());
                                                       std::ranges::fill(y_1, Vector<Dim>::Ones());
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
    CHECK_THROWS_WITH(contact.step(1.0, {.displacement_0 = u, .displacement_1 = u}), Contains("coupling_of"));
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

TEMPLATE_TEST_CASE_SIG("the force at the end of a step is that of search and integrate", "[contact][step]", ((int Dim), Dim),
                       2, 3) {
    const auto surface = plates<Dim>();
    const auto states = path_of_plates(surface);
    contact::Contact<Dim> one_call(surface.view(), deep(0.5)), expert(surface.view(), deep(0.5)),
        mean(surface.view(), deep(0.5));
    std::int64_t active = 0, differs = 0;
    for (std::size_t i = 0; i + 1 < states.size(); ++i) {
        const auto& step = one_call.step(1.0, constant_host<Dim>(states[i], states[i + 1], contact::TakenForce::end));
        const auto& of_mean = mean.step(1.0, constant_host<Dim>(states[i], states[i + 1]));
        expert.search(states[i], states[i + 1], [](auto listed) { return uncoupled<Dim>(listed.size(), 0.0); });
        std::vector<Vector<Dim>> u_0, u_1;
        for (const Face f : expert.faces()) {
            u_0.push_back(states[i][static_cast<std::size_t>(f)]);
            u_1.push_back(states[i + 1][static_cast<std::size_t>(f)]);
        }
        const std::vector<Vector<Dim>> y(u_0.size(), Vector<Dim>::Ones());
        const auto& expected = expert.integrate(1.0, {u_0, u_1, {}, y}, contact::TakenForce::end);
        REQUIRE(step.pairs.size() == expected.pairs.size());
        for (std::size_t p = 0; p < step.pairs.size(); ++p) {
            check_same_pair(step.pairs[p], expected.pairs[p]);
            CHECK(step.pairs[p].events == 0);
        }
        active += static_cast<std::int64_t>(step.pairs.size());
        differs += step.pairs.size() != of_mean.pairs.size() ||
                   (!step.pairs.empty() && step.pairs[0].area != of_mean.pairs[0].area);
    }
    CHECK(active > 50);
    CHECK(differs > 10);  // it is not the mean
    CHECK(one_call.search_report().searches == one_call.report().rebuilds);
    CHECK(one_call.search_report().searches < expert.search_report().searches);
}

TEMPLATE_TEST_CASE_SIG("a step that begins where no step ended is searched for, too", "[contact][step]", ((int Dim), Dim), 2,
                       3) {
    const auto surface = plates<Dim>();
    contact::Contact<Dim> contact(surface.view(), deep(0.1));
    const auto apart = moved(surface, -2.0, 0.0), together = moved(surface, 0.02, 0.0);
    drive(contact, apart, apart);
    CHECK(contact.faces().empty());
    drive(contact, together, apart);  // its end alone is within the list
    CHECK_FALSE(contact.faces().empty());
    CHECK(contact.report().missed_contacts > 0);  // they were pressed in before anybody looked, and one is told
}

TEMPLATE_TEST_CASE_SIG("after a search there is no step yet: no pairs, and zeros for the faces of the new list",
                       "[contact][step]", ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>();
    contact::Contact<Dim> contact(surface.view(), deep());
    REQUIRE(drive(contact, moved(surface, -0.1, 0.0), moved(surface, 0.1, 0.0)).is_active());
    const auto u = moved(surface, 0.1, 0.0);
    contact.search(u, u, [](auto listed) { return uncoupled<Dim>(listed.size()); });
    const auto& last = contact.last();
    CHECK_FALSE(last.is_active());
    CHECK(last.energy == 0.0);
    CHECK(last.report.compression == 0.0);
    REQUIRE(std::ranges::equal(last.faces, contact.faces()));
    REQUIRE_FALSE(last.faces.empty());
    CHECK(last.mean_correction.size() == last.faces.size());
    CHECK(last.mean_normal_force.size() == last.faces.size());
    for (const auto& gradient : last.mean_gradient) CHECK(gradient.isZero(0.0));
}

TEMPLATE_TEST_CASE_SIG("arrays of a wrong size and functions that are not set are refused", "[contact][step]",
                       ((int Dim), Dim), 2, 3) {
    const auto surface = plates<Dim>();
    contact::Contact<Dim> contact(surface.view());
    const auto u = moved(surface, 0.01, 0.0);
    CHECK_THROWS_AS(contact.search(u, u, {}), BadInput);
    drive(contact, u, u);
    std::vector<Vector<Dim>> listed(contact.faces().size(), Vector<Dim>::Zero());
    CHECK_NOTHROW(contact.admitted_overlaps(listed));
    listed.pop_back();
    CHECK_THROWS_AS(contact.admitted_overlaps(listed), BadInput);
}
