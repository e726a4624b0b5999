// Bodies that overlap at the start on purpose.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "abut/base/error.hpp"
#include "contact/nodal_scenes.hpp"

using namespace abut;
using namespace abut::test;
using contact::Face;
using contact::NodalContact;
using contact::NodalStep;
using contact::TakenForce;

namespace {

constexpr double overlap = 0.03, ramp = 0.5, shift = 0.013, in_series = 15.0 / 8.0;

template <int Dim>
NodalScene<Dim> overlapping_boxes(double by = overlap) {
    return two_boxes<Dim>(2, 3, -by, shift);
}

contact::NodalOptions resolving(double time = ramp) {
    contact::NodalOptions options;
    options.interference.times = {time};
    return options;
}

/// k/2 |P| g^2 of the boxes at rest, when faces are pressed in by `by`.
template <int Dim>
double energy_of(double by) {
    const double area = (1.0 - shift) * (Dim == 3 ? 1.0 - 0.6 * shift : 1.0);
    return 0.5 * in_series * area * by * by;
}

/// A motion without reason in which bodies deform, small beside the overlap.
template <int Dim>
std::vector<Vector<Dim>> moved_at_random(std::vector<Vector<Dim>> x, std::mt19937& random) {
    std::uniform_real_distribution<double> by(-2e-3, 2e-3);
    for (Vector<Dim>& node : x)
        for (double& component : node) component += by(random);
    return x;
}

template <int Dim>
double work_of(const NodalStep<Dim>& step, const std::vector<Vector<Dim>>& x_0, const std::vector<Vector<Dim>>& x_1) {
    double work = 0.0;
    for (std::size_t i = 0; i < step.nodes.size(); ++i) {
        const auto n = static_cast<std::size_t>(step.nodes[i]);
        work += step.gradient[i].dot(x_1[n] - x_0[n]);
    }
    return work;
}

std::string refused(const std::function<void()>& call) {
    try {
        call();
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("bodies that overlap on purpose begin without a force and end with that of all their overlap",
                       "[contact][interference]", ((int Dim), Dim), 2, 3) {
    const auto scene = overlapping_boxes<Dim>();
    NodalContact<Dim> contact(scene.surface(), resolving());
    CHECK(contact.evaluate(scene.rest).energy == Approx(0.0).margin(1e-20));
    REQUIRE(contact.interference().size() == 1);
    CHECK(contact.interference()[0] == Approx(overlap).epsilon(1e-12));
    const int n = 20;
    double work = 0.0;
    for (int i = 1; i <= n + 3; ++i) {
        work += contact.step(ramp / n, scene.rest, scene.rest).interference_work;
        const double y = std::min(i / double(n), 1.0);  // y^2 (3 - 2 y): half of the overlap at half of the time
        const double expected = energy_of<Dim>(overlap * y * y * (3.0 - 2.0 * y));
        CHECK(contact.last().energy == Approx(expected).epsilon(1e-12));
        CHECK(work == Approx(expected).epsilon(1e-12));
    }
    CHECK(contact.last().interference_work == 0.0);
    CHECK(contact.report().missed_contacts == 0);
    const auto force = forces<Dim>(contact.last(), scene.rest.size());
    double up_on_second = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i)
        if (scene.node_body[i] == 1) up_on_second += force[i].dot(up<Dim>());
    CHECK(up_on_second == Approx(2.0 * energy_of<Dim>(overlap) / overlap).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG("while bodies move W changes by what their nodes work and by the interference that grows",
                       "[contact][interference]", ((int Dim), Dim), 2, 3) {
    const auto scene = overlapping_boxes<Dim>();
    NodalContact<Dim> contact(scene.surface(), resolving());
    std::mt19937 random(7);
    auto x = scene.rest;
    double work = 0.0, start = contact.evaluate(x).energy, worst = 0.0;
    for (int i = 0; i < 60; ++i) {
        const auto next = moved_at_random<Dim>(scene.rest, random);
        const auto& step = contact.step(0.01, x, next);
        worst = std::max(worst, std::abs(step.energy_0 - start - step.interference_work));
        work += work_of<Dim>(step, x, next) + step.interference_work;
        start = step.energy;
        x = next;
        CHECK(contact.evaluate(x).energy == Approx(start).epsilon(1e-12).margin(1e-18));
    }
    CHECK(worst < 1e-15);
    CHECK(start > 0.5 * energy_of<Dim>(overlap));
    CHECK(work == Approx(start).epsilon(1e-11));
}

TEST_CASE("schemes that take forces at the ends of steps book the work of interference in between",
          "[contact][interference]") {
    const auto scene = overlapping_boxes<2>();
    NodalContact<2> contact(scene.surface(), resolving());
    double work = 0.0;
    for (int i = 0; i < 50; ++i) work += contact.step(0.01, scene.rest, scene.rest, TakenForce::end).interference_work;
    CHECK(work == Approx(energy_of<2>(overlap)).epsilon(1e-12));
}

TEST_CASE("interference goes on from a saved state with the same bits", "[contact][interference]") {
    const auto scene = overlapping_boxes<2>();
    NodalContact<2> contact(scene.surface(), resolving()), other(scene.surface(), resolving());
    std::mt19937 random(3);
    auto x = scene.rest;
    const auto go = [&](auto&... contacts) {
        const auto next = moved_at_random<2>(scene.rest, random);
        (contacts.step(0.01, x, next), ...);
        x = next;
    };
    for (int i = 0; i < 20; ++i) go(contact);
    other.restore(contact.state());
    for (int i = 0; i < 40; ++i) {
        go(contact, other);
        CHECK(contact.last().energy == other.last().energy);
        CHECK(contact.last().interference_work == other.last().interference_work);
        const std::size_t n = scene.rest.size();  // lists may differ
        REQUIRE(forces<2>(contact.last(), n) == forces<2>(other.last(), n));
    }
    NodalContact<2> without(scene.surface());
    CHECK(refused([&] { without.restore(contact.state()); }).find("interference") != std::string::npos);
}

TEST_CASE("what overlaps on purpose is told by its faces, and others do as they do without", "[contact][interference]") {
    const auto scene = overlapping_boxes<2>();
    auto options = resolving();
    options.interference.of = [](Face, Face) { return -1; };
    NodalContact<2> with(scene.surface(), options), without(scene.surface());
    CHECK(with.evaluate(scene.rest).energy == without.evaluate(scene.rest).energy);
    CHECK(without.last().energy > 0.0);
    CHECK(with.interference()[0] == 0.0);
}

TEST_CASE("interference deeper than half a cell of each body is refused by its faces, and so are times that are none",
          "[contact][interference]") {
    const auto deep = overlapping_boxes<2>(0.25);  // D = 0.2
    NodalContact<2> contact(deep.surface(), resolving());
    const std::string message = refused([&] { contact.evaluate(deep.rest); });
    CHECK(message.find("overlap by 0.25 m") != std::string::npos);
    CHECK(message.find("less than 0.2 m") != std::string::npos);
    for (const double time : {0.0, -1.0, std::numeric_limits<double>::infinity()})
        CHECK(refused([&] { NodalContact<2>(deep.surface(), resolving(time)); }).find("finite and > 0") !=
              std::string::npos);
    auto options = resolving();
    options.interference.of = [](Face, Face) { return 1; };
    NodalContact<2> out_of_range(deep.surface(), options);
    CHECK(refused([&] { out_of_range.evaluate(deep.rest); }).find("time 1 of 1") != std::string::npos);
}
