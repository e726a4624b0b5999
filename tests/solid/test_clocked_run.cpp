// Times that a program outside dictates: the solid keeps its own step.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include "abut/base/error.hpp"
#include "abut/dynamics/pairs.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/solid/clocked_run.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/outside_view.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using solid::Kinematics;
using solid::LoadImpulse;

namespace {

constexpr const char* loaded = "upper.xmax";

/// A block falls onto another one, and is loaded from outside at its side.
template <int Dim>
struct Blocks {
    mesh::Mesh<Dim> mesh = made();
    std::unique_ptr<solid::SteppedRun<Dim>> run;

    explicit Blocks(Kinematics kinematics, solid::RunRemedies remedies = {.filter = true, .restart = 7}) {
        auto options = bodies<Dim>(2);
        options.law = solid::ContactLaw::pair_potential;
        options.kinematics.assign(2, kinematics);
        options.friction.coefficient = 0.3;
        options.boundary.traction = {{.group = loaded, .from_outside = true}};
        auto solid = std::make_unique<solid::Solid<Dim>>(mesh, options);
        const double dt = 0.8 * dynamics::stable_step(*solid).dt;
        const std::vector<Vector<Dim>> falling{Vector<Dim>::Zero(), Vector<Dim>(-0.05 * Vector<Dim>::Unit(Dim - 1))};
        const std::vector<double> p = solid::uniform_momentum<Dim>(*solid, falling), q(p.size(), 0.0);
        run = std::make_unique<solid::SteppedRun<Dim>>(std::move(solid), q, p, dt, remedies);
    }
    [[nodiscard]] std::size_t n_faces() const { return mesh.group(loaded).faces.size(); }

private:
    static mesh::Mesh<Dim> made() {
        Vector<Dim> upper = Vector<Dim>::Ones(), lower = Vector<Dim>::Constant(0.1), other = Vector<Dim>::Constant(0.83);
        upper[Dim - 1] = 0.5;
        lower[Dim - 1] = 0.505;
        other[Dim - 1] = 1.2;
        const double size = Dim == 2 ? 0.2 : 0.35;
        return together(mesh::box<Dim>({.lower = Vector<Dim>::Zero(), .upper = upper, .size = size, .name = "lower"}),
                        mesh::box<Dim>({.lower = lower, .upper = other, .size = 0.8 * size, .name = "upper"}));
    }
};

/// Numbers between `least` and `most`.
std::function<double()> random_between(double least, double most, unsigned seed) {
    return [engine = std::mt19937(seed), least, most]() mutable {
        return least + (most - least) * static_cast<double>(engine()) / static_cast<double>(std::mt19937::max());
    };
}

/// A bar of 1 m and E = rho = 1, whose end is pressed from outside.
struct Bar {
    mesh::Mesh<2> mesh;
    std::unique_ptr<solid::SteppedRun<2>> run;

    Bar(int n, double courant, int restart, double velocity = 0.0)
        : mesh(mesh::structured_box<2>({0, 0}, {1, 2.0 / n}, {n, 2}, mesh::CellShape::quadrangle)) {
        solid::SolidOptions<2> options;
        options.materials = {{.young = 1.0, .poisson = 0.0, .density = 1.0}};
        options.boundary.traction = {{.group = "xmin", .from_outside = true}};
        auto solid = std::make_unique<solid::Solid<2>>(mesh, options);
        const std::vector<Vector<2>> moving{Vector<2>(velocity, 0.0)};
        const std::vector<double> rest(solid->size(), 0.0), p = solid::uniform_momentum<2>(*solid, moving);
        run = std::make_unique<solid::SteppedRun<2>>(std::move(solid), rest, p, courant / n,
                                                     solid::RunRemedies{.restart = restart});
    }
    void press(solid::ClockedRun<2>& clock, double pressure) const {
        clock.set_traction("xmin", std::vector<Vector<2>>(2, Vector<2>(pressure, 0.0)));
    }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("without loads the nodes have the same bits, whatever times are dictated", "[solid][clock]",
                       ((int Dim), Dim), 2, 3) {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite, Kinematics::rigid);
    const auto& [least, most] = GENERATE(std::pair{0.5, 1.5}, std::pair{0.01, 1.5}, std::pair{0.5, 9.0});
    CAPTURE(static_cast<int>(kinematics), least, most);
    Blocks<Dim> stepped(kinematics), dictated(kinematics);
    solid::ClockedRun<Dim> clock(*dictated.run);
    const double dt = dictated.run->memm().dt();
    const auto factor = random_between(least, most, 3);
    for (int i = 0; i < 150; ++i) {
        clock.advance(factor() * dt);
        while (stepped.run->memm().steps() < dictated.run->memm().steps()) stepped.run->step();
        REQUIRE(std::ranges::equal(stepped.run->memm().q(), dictated.run->memm().q()));
        REQUIRE(std::ranges::equal(stepped.run->memm().p_after(), dictated.run->memm().p_after()));
        REQUIRE(clock.time_to_node() > 0.0);
        REQUIRE(clock.time() >= dictated.run->memm().time());
    }
    CHECK(dictated.run->solid().contact().report().active_pairs_max > 0);
}

TEST_CASE("tractions that stay act as they are, to the bit, whatever times are dictated", "[solid][clock]") {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite, Kinematics::rigid);
    const LoadImpulse impulse = GENERATE(LoadImpulse::as_given, LoadImpulse::trapezoid);
    CAPTURE(static_cast<int>(kinematics), static_cast<int>(impulse));
    Blocks<2> stepped(kinematics), dictated(kinematics);
    solid::ClockedRun<2> clock(*dictated.run, impulse);
    const auto amount = random_between(-0.01, 0.01, 8);
    std::vector<Vector<2>> traction(stepped.n_faces());
    for (Vector<2>& t : traction) t = Vector<2>(amount(), amount());
    stepped.run->solid().set_traction(loaded, traction);
    clock.set_traction(loaded, traction);
    const auto factor = random_between(0.01, 2.5, 9);
    for (int i = 0; i < 100; ++i) {
        clock.advance(factor() * dictated.run->memm().dt());
        while (stepped.run->memm().steps() < dictated.run->memm().steps()) stepped.run->step();
        REQUIRE(std::ranges::equal(stepped.run->memm().q(), dictated.run->memm().q()));
        REQUIRE(std::ranges::equal(stepped.run->memm().p_after(), dictated.run->memm().p_after()));
    }
    CHECK(stepped.run->memm().steps() > 50);
}

TEMPLATE_TEST_CASE_SIG("the work of loads that change at dictated times is their traction times the motion of faces",
                       "[solid][clock]", ((int Dim), Dim), 2, 3) {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite, Kinematics::rigid);
    CAPTURE(static_cast<int>(kinematics));
    Blocks<Dim> blocks(kinematics);
    solid::ClockedRun<Dim> clock(*blocks.run);
    const auto factor = random_between(0.1, 1.0, 5), amount = random_between(-0.01, 0.01, 6);
    const double start = blocks.run->memm().pseudo_energy();
    double given = 0.0, energy = std::abs(start);
    for (int i = 0; i < 200; ++i) {
        const double d = std::min(factor() * blocks.run->memm().dt(), clock.time_to_node());
        std::vector<Vector<Dim>> traction(blocks.n_faces());
        for (Vector<Dim>& t : traction) t = amount() * Vector<Dim>::Ones() + 0.01 * Vector<Dim>::Unit(0);
        const auto motion = clock.motion(loaded, d);
        const auto before = clock.faces(loaded);
        clock.set_traction(loaded, traction);
        const std::int64_t steps = blocks.run->memm().steps();
        clock.advance(d);
        CHECK(clock.faces(loaded).traction == traction);  // at nodes, too
        for (std::size_t face = 0; face < motion.size(); ++face)
            given += before.area[face] * traction[face].dot(motion[face]);
        if (blocks.run->memm().steps() == steps)  // a node moves faces by loads and frames as well
            for (std::size_t face = 0; face < motion.size(); ++face)
                CHECK((clock.faces(loaded).position[face] - before.position[face] - motion[face]).norm() < 1e-14);
        raise(energy, std::abs(blocks.run->memm().pseudo_energy()));
    }
    while (clock.time() > blocks.run->memm().time()) {  // to a node
        const double d = clock.time_to_node();
        const auto motion = clock.motion(loaded, d);
        const auto faces = clock.faces(loaded);
        for (std::size_t face = 0; face < motion.size(); ++face)
            given += faces.area[face] * faces.traction[face].dot(motion[face]);
        clock.advance(d);
    }
    const solid::OutsideWork work = blocks.run->solid().outside_work(blocks.run->memm().q());
    CHECK(work.steps == Approx(given).epsilon(1e-11).margin(1e-13 * energy));
    CHECK(std::abs(given) > 1e-3 * energy);
}

TEST_CASE("a step that is rejected and taken again has the same bits, across nodes with friction and remedies",
          "[solid][clock]") {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::finite);
    const LoadImpulse impulse = GENERATE(LoadImpulse::as_given, LoadImpulse::trapezoid);
    Blocks<2> blocks(kinematics);
    solid::ClockedRun<2> clock(*blocks.run, impulse);
    const double dt = blocks.run->memm().dt();
    const auto go = [&](unsigned seed) {
        const auto factor = random_between(0.2, 2.3, seed), amount = random_between(-0.01, 0.01, seed + 1);
        for (int i = 0; i < 40; ++i) {
            clock.set_traction(loaded, std::vector<Vector<2>>(blocks.n_faces(), Vector<2>(amount(), amount())));
            clock.advance(factor() * dt);
        }
    };
    go(1);
    REQUIRE(blocks.run->solid().contact().report().active_pairs_max > 0);
    const auto saved = clock.state();
    go(2);
    const std::vector<double> q = clock.q();
    const double time = clock.time(), energy = blocks.run->memm().pseudo_energy();
    clock.restore(saved);
    go(9);  // another try
    clock.restore(saved);
    go(2);
    CHECK(clock.q() == q);
    CHECK(clock.time() == time);
    CHECK(blocks.run->memm().pseudo_energy() == energy);
}

TEST_CASE("a pulse at dictated times runs through a bar with order 2, however its impulses are taken", "[solid][clock]") {
    const LoadImpulse impulse = GENERATE(LoadImpulse::as_given, LoadImpulse::trapezoid);
    const auto& [least, most] = GENERATE(std::pair{0.1, 0.3}, std::pair{0.5, 1.5}, std::pair{1.0, 3.0});
    CAPTURE(static_cast<int>(impulse), least, most);
    const int n = 40;
    constexpr double end = 1.5, width = 0.4;
    const auto pressure = [](double t) {
        return t < width ? 1e-3 * std::pow(std::sin(std::numbers::pi * t / width), 2) : 0.0;
    };
    const auto displacement = [&](double courant, bool random) {
        Bar bar(n, courant, 0);
        solid::ClockedRun<2> clock(*bar.run, impulse);
        const double dt = courant / n;
        const auto factor = random_between(least, most, 11);
        while (clock.time() < end - 1e-12) {
            double d = std::min((random ? factor() : 1.0) * dt, end - clock.time());
            bar.press(clock, pressure(clock.time() + 0.5 * d));  // the mean over the step, to order 2
            clock.advance(d);
        }
        return clock.q();
    };
    const std::vector<double> exact = displacement(0.02, false);  // of these cells
    const auto error = [&](double courant) {
        const std::vector<double> q = displacement(courant, true);
        double sum = 0.0, size = 0.0;
        for (std::size_t i = 0; i < q.size(); ++i) sum += std::pow(q[i] - exact[i], 2), size += exact[i] * exact[i];
        return std::sqrt(sum / size);
    };
    const double coarse = error(0.5), middle = error(0.25), fine = error(0.125);
    CAPTURE(coarse, middle, fine);
    CHECK(0.5 * std::log2(coarse / fine) == Approx(2.0).margin(0.3));  // the times are at random
    CHECK(middle < coarse);
    CHECK(fine < 2e-3);
}

TEST_CASE("under the trapezoid the work that is given and that of the solid differ by a part of order 2", "[solid][clock]") {
    constexpr double end = 1.5, width = 0.4;
    const auto apart = [&](double courant) {
        Bar bar(40, courant, 0);
        solid::ClockedRun<2> clock(*bar.run, LoadImpulse::trapezoid);
        double given = 0.0;
        while (clock.time() < end) {
            const double d = std::min(0.3 * courant / 40, clock.time_to_node());
            const double t = clock.time() + 0.5 * d;
            const double pressure = t < width ? 1e-3 * std::pow(std::sin(std::numbers::pi * t / width), 2) : 0.0;
            for (const Vector<2>& motion : clock.motion("xmin", d)) given += pressure * motion[0] / 40;  // faces of 1/40
            bar.press(clock, pressure);
            clock.advance(d);
        }
        const double work = bar.run->solid().outside_work(bar.run->memm().q()).steps;
        return std::abs(work - given) / given;
    };
    const double coarse = apart(0.5), fine = apart(0.125);
    CAPTURE(coarse, fine);
    CHECK(coarse < 0.05);
    CHECK(0.5 * std::log2(coarse / fine) == Approx(2.0).margin(0.3));
}

TEST_CASE("a load that answers to the motion is kept by neutral restarts or the trapezoid, and lost without",
          "[solid][clock]") {
    // A bar that flies, and a dashpot p = -Z v at its end, in pieces of 0.2 of the step: it pumps the alternating mode.
    constexpr double dashpot = 0.3;  // of rho c
    struct Energies {
        double largest = 0.0, last = 0.0;  // kinetic, over that at the start
    };
    const auto energies = [&](LoadImpulse impulse, int restart) {
        Bar bar(40, 0.6, restart, 1e-3);
        auto& memm = bar.run->memm();
        solid::ClockedRun<2> clock(*bar.run, impulse);
        const double begin = memm.kinetic_energy();
        Energies found;
        while (clock.time() < 25.0 && found.largest < 1e3) {
            const double part = std::min(0.2 * memm.dt(), clock.time_to_node());
            const auto motion = clock.motion("xmin", part);
            bar.press(clock, -dashpot * 0.5 * (motion[0][0] + motion[1][0]) / part);
            clock.advance(part);
            raise(found.largest, memm.kinetic_energy() / begin);
        }
        found.last = memm.kinetic_energy() / begin;
        return found;
    };
    for (const auto& [impulse, restart] : {std::pair{LoadImpulse::as_given, 3}, std::pair{LoadImpulse::trapezoid, 0}}) {
        const Energies kept = energies(impulse, restart);
        CAPTURE(static_cast<int>(impulse), kept.largest, kept.last);
        CHECK(kept.largest < 1.01);
        CHECK(kept.last < 1e-3);  // the dashpot has it
    }
    CHECK(energies(LoadImpulse::as_given, 0).largest > 1e3);
}

TEST_CASE("the clock refuses what it cannot do, and nothing has changed", "[solid][clock]") {
    Blocks<2> blocks(Kinematics::small, {});
    solid::ClockedRun<2> clock(*blocks.run);
    const double dt = blocks.run->memm().dt();
    clock.advance(0.3 * dt);
    const std::vector<double> q = clock.q();
    const double time = clock.time();
    for (const double d : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        CHECK_THROWS_WITH(clock.advance(d), Contains("give a finite time > 0"));
        CHECK_THROWS_AS(clock.advance(d), BadInput);
    }
    CHECK_THROWS_WITH(clock.motion(loaded, dt), Contains("until the next node") && Contains("time_to_node"));
    CHECK_THROWS_AS(clock.set_traction("upper.side", std::vector<Vector<2>>(1)), BadInput);
    CHECK_THROWS_AS(clock.set_traction(loaded, std::vector<Vector<2>>(blocks.n_faces() + 1, Vector<2>::Zero())), BadInput);
    CHECK_THROWS_AS(clock.set_traction(loaded, std::vector<Vector<2>>(blocks.n_faces(), Vector<2>::Constant(std::nan("")))),
                    BadInput);
    CHECK(clock.q() == q);
    CHECK(clock.time() == time);
    auto other = clock.state();
    other.loads.pop_back();
    CHECK_THROWS_WITH(clock.restore(other), Contains("on other groups or faces"));
    CHECK(clock.time() == time);
    blocks.run->memm().set_step(0.5 * dt, dynamics::StepChange::restart);
    CHECK_THROWS_AS(clock.advance(0.1 * dt), Misuse);
    CHECK_THROWS_WITH(clock.advance(0.1 * dt), Contains("inside a step of the clock"));
}

TEST_CASE("a step that changes by more than 5 % is warned of once, and the clock is named", "[solid][clock]") {
    Bar bar(20, 0.5, 20, 0.1);
    solid::SteppedRun<2>& run = *bar.run;
    const double dt = run.memm().dt();
    const auto change = GENERATE(dynamics::StepChange::keep, dynamics::StepChange::restart);
    CHECK(run.set_step(0.7 * dt, change).empty());  // before the first step
    CHECK(run.set_step(dt, change).empty());
    run.step();
    CHECK(run.set_step(1.04 * dt, change).empty());
    CHECK(run.set_step(dt, change).empty());
    CHECK_THROWS_AS(static_cast<void>(run.set_step(-dt, change)), BadInput);
    CHECK_THAT(run.set_step(0.9 * dt, change), Contains("by more than 5 %") && Contains("solid::ClockedRun"));
    CHECK(run.memm().dt() == 0.9 * dt);
    run.step();
    CHECK(run.set_step(dt, change).empty());
}

TEST_CASE("pairs of sub-steps refuse a solid by name, and name its clock", "[solid][clock][errors]") {
    Bar bar(8, 0.5, 0);
    solid::Solid<2>& solid = bar.run->solid();
    const std::vector<double> rest(solid.size(), 0.0);
    CHECK_THROWS_WITH(dynamics::Pairs(solid, rest, rest, 1.0), Contains("Pairs") && Contains("solid::ClockedRun"));
}
