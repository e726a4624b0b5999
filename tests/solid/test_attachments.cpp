// Springs, dashpots, hinges, moments and tractions on bodies that turn.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "abut/dynamics/leapfrog.hpp"
#include "abut/solid/cell_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Anchor;
using solid::Kinematics;
using solid::Spring;

namespace {

using std::numbers::pi;

template <int Dim>
solid::SolidOptions<Dim> free_bodies(int n) {
    auto options = bodies<Dim>(n);
    options.contact.reset();
    return options;
}

/// A bar from x = 0 to 1.
mesh::Mesh<2> bar() { return mesh::structured_box<2>({0.0, -0.05}, {1.0, 0.05}, {20, 2}, CellShape::quadrangle); }

template <int Dim>
mesh::Mesh<Dim> two_blocks() {
    std::array<int, Dim> counts;
    counts.fill(3);
    const Vector<Dim> half = Vector<Dim>::Constant(0.5), apart = 2.0 * Vector<Dim>::Unit(0);
    const CellShape shape = Dim == 2 ? CellShape::triangle : CellShape::tetrahedron;
    return together(mesh::structured_box<Dim>(-half, half, counts, shape, "left"),
                    mesh::structured_box<Dim>(apart - half, apart + half, counts, shape, "right"));
}

}  // namespace

TEST_CASE("a hinged bar swings with the period of a physical pendulum", "[solid][attachments]") {
    const Kinematics kinematics = GENERATE(Kinematics::rigid, Kinematics::floating);
    const double gravity = 1e-3;
    auto options = free_bodies<2>(1);
    options.springs = {{.first = {}, .second = {.body = 0, .position = {0.0, 0.0}}, .stiffness = 10.0}};
    // Hangs from its end at rest, turned to the side by a small angle: I/(m d) = (1/3 + 0.1^2/12)/0.5.
    const double angle = 0.01, arm = (1.0 / 3.0 + 0.01 / 12.0) / 0.5;
    options.acceleration = {{gravity * std::cos(angle), -gravity * std::sin(angle)}};
    options.kinematics = {kinematics};
    const auto mesh = bar();
    solid::Solid<2> solid(mesh, options);
    dynamics::Memm memm(solid, std::vector<double>(solid.size(), 0.0), std::vector<double>(solid.size(), 0.0), 0.02);
    const double energy = memm.pseudo_energy();
    double drift = 0.0, crossed = 0.0;
    for (double before = 0.0; crossed == 0.0;) {
        memm.step();
        raise(drift, std::abs(memm.pseudo_energy() - energy));
        const auto q = solid.cells().displacement(memm.q());
        const Vector<2> rest = mesh.cell_centroid.back() - mesh.cell_centroid.front(), now = rest + q.back() - q.front();
        const double down = std::atan2(moment<2>(rest, now)[0], rest.dot(now)) + angle;
        if (before > 0.0 && down <= 0.0) crossed = memm.time();
        before = down;
        REQUIRE(memm.steps() < 100000);
    }
    CHECK(4.0 * crossed == Approx(2.0 * pi * std::sqrt(arm / gravity)).epsilon(5e-3));
    CHECK(drift <= 1e-12 * gravity * 0.1);  // of the weight at rest
}

TEMPLATE_TEST_CASE_SIG("bodies joined by springs keep H~, momentum and J~, and dashpots take what they book",
                       "[solid][attachments]", ((int Dim), Dim), 2, 3) {
    const double length = GENERATE(0.0, 0.8), damping = GENERATE(0.0, 0.02);
    const auto kinematics = GENERATE(std::vector{Kinematics::floating, Kinematics::floating},
                                     std::vector{Kinematics::rigid, Kinematics::floating});
    auto options = free_bodies<Dim>(2);
    options.springs = {{.first = {.body = 0, .position = 0.5 * Vector<Dim>::Unit(0), .radius = 0.3},
                        .second = {.body = 1, .position = 1.5 * Vector<Dim>::Unit(0)},
                        .stiffness = 0.05,
                        .length = length,
                        .damping = damping}};
    TurningScene<Dim> scene(
        two_blocks<Dim>(), options,
        {{.velocity = Vector<Dim>::Constant(0.02), .spin = some_spin<Dim>(0.1)}, {.velocity = -0.03 * Vector<Dim>::Unit(1)}},
        0.6, kinematics);
    scene.run_until(100.0);
    const Drifts drifts = scene.drifts();
    CAPTURE(length, damping);
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.momentum <= 1e-13);
    // A dashpot of no length acts across it, too.
    if (length > 0.0 || damping == 0.0) CHECK(drifts.pseudo_moment <= 1e-13);
    if (damping == 0.0)
        CHECK(scene.solid.work() == 0.0);
    else
        CHECK(scene.solid.work() < -1e-4 * scene.ledger.largest_energy());
}

namespace {

/// A mass on a spring, k/m = (w/dt)^2 and c dt/m = g, under MEMM; the dashpot acts on `of_before` of the rate of the step before
/// and on the rest of that of the step itself. Largest |q| of `last` steps that end after `steps`.
double swing(double w, double g, double of_before, int steps, int last) {
    double q = 0.0, before = 1.0 + 0.5 * g, after = 1.0 - 0.5 * g, largest = 0.0;  // velocities in units of 1/dt
    for (int n = 1; n <= steps; ++n) {
        const double next = q + after;
        const double rate = of_before * before + (1.0 - of_before) * after;
        before = std::exchange(after, before - w * w * (q + next) - 2.0 * g * rate);
        q = next;
        if (n > steps - last) raise(largest, std::abs(q));
    }
    return largest;
}

}  // namespace

TEST_CASE("dashpots on the mean of two rates damp every vibration alike, on the rate before they feed fast ones",
          "[solid][attachments]") {
    const double w = GENERATE(0.2, 1.0, 1.5, 1.7, 1.9), g = 0.02, dt = 0.5;
    const double exact =
        std::sqrt(1.0 - g);  // of one step: the product of both roots of leapfrog with a lagged dashpot is 1 - g
    const int steps = 600, last = 100;
    CAPTURE(w);
    const double decay = std::pow(exact, steps - last);
    CHECK(swing(w, g, 0.5, steps, last) / swing(w, g, 0.5, last, last) == Approx(decay).epsilon(0.1));
    if (w > std::numbers::sqrt2) CHECK(swing(w, g, 1.0, steps, last) > swing(w, g, 1.0, last, last));

    auto options = free_bodies<2>(1);
    const double mass = 1.0;
    options.springs = {
        {.first = {}, .second = {.body = 0}, .stiffness = mass * w * w / (dt * dt), .damping = g * mass / dt}};
    TurningScene<2> scene(mesh::structured_box<2>({-0.5, -0.5}, {0.5, 0.5}, {2, 2}, CellShape::quadrangle), options,
                          {moving<2>({1e-3, 0.0})}, -dt, Kinematics::rigid);
    const auto largest_of = [&](int n) {
        double largest = 0.0;
        for (int i = 0; i < n; ++i) {
            scene.run(1);
            raise(largest, std::abs(scene.memm.q()[0]));
        }
        return largest;
    };
    const double e_at_start = [&] {
        std::vector<double> e(scene.solid.size());
        scene.memm.parasitic_momentum(e);
        return largest(e);
    }();
    CHECK(e_at_start <= g * g * mass * 1e-3);  // F has that of the dashpot: else it is g m v
    const double early = largest_of(last);
    scene.run(steps - 2 * last);
    CHECK(largest_of(last) / early == Approx(decay).epsilon(0.1));
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
}

TEST_CASE("a brake damps fast torsion as well", "[solid][attachments]") {
    const double w = GENERATE(0.2, 1.7, 1.9), g = 0.02, dt = 0.5, inertia = 1.0 / 6.0, arm = 0.5;
    auto options = free_bodies<2>(1);
    for (const double side : {-arm, arm})
        options.springs.push_back({.first = {.position = {side, 0.0}},
                                   .second = {.body = 0, .position = {side, 0.0}},
                                   .stiffness = 0.5 * inertia * w * w / (dt * dt * arm * arm)});
    options.moments = {{.body = 0, .damping = g * inertia / dt}};
    TurningScene<2> scene(mesh::structured_box<2>({-0.5, -0.5}, {0.5, 0.5}, {2, 2}, CellShape::quadrangle), options,
                          {moving<2>({0.0, 0.0}, some_spin<2>(1e-3))}, -dt, Kinematics::rigid);
    const auto largest_of = [&](int n) {
        double largest = 0.0;
        for (int i = 0; i < n; ++i) {
            scene.run(1);
            raise(largest, scene.solid.rotations(scene.memm.q())[0]);
        }
        return largest;
    };
    const double early = largest_of(100);
    scene.run(400);
    CAPTURE(w);
    CHECK(largest_of(100) / early == Approx(std::pow(1.0 - g, 250.0)).epsilon(0.1));
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
}

TEMPLATE_TEST_CASE_SIG("a moment turns a body as its inertia says, and its work is booked", "[solid][attachments]",
                       ((int Dim), Dim), 2, 3) {
    const Kinematics kinematics = GENERATE(Kinematics::rigid, Kinematics::floating);
    auto options = free_bodies<Dim>(1);
    AxialVector<Dim> moment = AxialVector<Dim>::Zero();
    moment[moment.size() - 1] = 1e-4;
    options.moments = {{.body = 0, .moment = moment}};
    std::array<int, Dim> counts;
    counts.fill(4);
    TurningScene<Dim> scene(mesh::structured_box<Dim>(-Vector<Dim>::Constant(0.5), Vector<Dim>::Constant(0.5), counts,
                                                      Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron),
                            options, {moving<Dim>(Vector<Dim>::Zero())}, -0.05, kinematics);
    scene.run_until(90.0);
    const double time = scene.memm.time(), inertia = 1.0 / 6.0;  // of the unit square and the unit cube
    CHECK(scene.pseudo_moment()[moment.size() - 1] == Approx(moment[moment.size() - 1] * time).epsilon(1e-3));
    const double turned = 0.5 * moment[moment.size() - 1] / inertia * time * time;
    CHECK(scene.solid.rotations(scene.memm.q())[0] == Approx(turned).epsilon(5e-3));
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
    CHECK(scene.solid.work() == Approx(moment[moment.size() - 1] * turned).epsilon(5e-3));
}

TEST_CASE("a moment that varies in time gives its integral, and its work is booked", "[solid][attachments]") {
    // M = M_0 cos(w t) about a square of inertia 1/6: spin M_0/(w I) sin(w t), turned by M_0/(w^2 I) (1 - cos(w t)); at w t = pi/2 its
    // work is its kinetic energy.
    const double w = 0.05, m_0 = 1e-3, inertia = 1.0 / 6.0, time = 0.5 * std::numbers::pi / w;
    auto options = free_bodies<2>(1);
    options.moments = {{.body = 0, .history = [=](double t) { return AxialVector<2>(m_0 * std::cos(w * t)); }}};
    TurningScene<2> scene(mesh::structured_box<2>({-0.5, -0.5}, {0.5, 0.5}, {4, 4}, CellShape::quadrangle), options,
                          {moving<2>(Vector<2>::Zero())}, -0.05, Kinematics::rigid);
    scene.run_until(time);
    const double end = scene.memm.time(), dt = scene.memm.dt();
    // The moment is that of the start of each step: it is ahead by half of it, M_0 (1 - cos(w t)) dt/2.
    const double late = 0.5 * dt * m_0;
    CHECK(scene.pseudo_moment()[0] == Approx(m_0 / w * std::sin(w * end)).margin(1.5 * late));
    CHECK(scene.solid.rotations(scene.memm.q())[0] ==
          Approx(m_0 / (w * w * inertia) * (1.0 - std::cos(w * end))).epsilon(5e-3));
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
    CHECK(scene.solid.work() == Approx(0.5 * m_0 * m_0 / (w * w * inertia) * std::pow(std::sin(w * end), 2)).epsilon(1e-2));
}

TEMPLATE_TEST_CASE_SIG("a traction that follows turns with its body, a dead one does not; both book their work",
                       "[solid][attachments]", ((int Dim), Dim), 2, 3) {
    const Kinematics kinematics = GENERATE(Kinematics::rigid, Kinematics::floating);
    const bool follows = GENERATE(false, true);
    auto options = free_bodies<Dim>(1);
    const double pressure = 1e-4, spin = 0.1;
    const Vector<Dim> push = pressure * Vector<Dim>::Unit(0);
    // On both ends of the axis about which it does not turn away: force on one side, along the outer normal of the other.
    options.boundary.traction = {{.group = "xmin", .value = push, .follows = follows}};
    std::array<int, Dim> counts;
    counts.fill(3);
    const auto mesh = mesh::structured_box<Dim>(-Vector<Dim>::Constant(0.5), Vector<Dim>::Constant(0.5), counts,
                                                Dim == 2 ? CellShape::triangle : CellShape::tetrahedron);
    AxialVector<Dim> about_last = AxialVector<Dim>::Zero();
    about_last[about_last.size() - 1] = spin;
    TurningScene<Dim> scene(mesh, options, {moving<Dim>(Vector<Dim>::Zero(), about_last)}, -0.05, kinematics);
    const double time = 0.5 * pi / spin;
    scene.run_until(time);
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
    Vector<Dim> impulse = Vector<Dim>::Zero();
    for (const auto& body : solid::body_motions<Dim>(scene.memm, scene.solid)) impulse += body.mass * body.velocity;
    if (follows) {  // the integral of (cos, sin)(spin t), the centre of pressure being behind the centre
        CHECK(impulse[0] == Approx(pressure / spin).epsilon(0.02));
        CHECK(impulse[1] == Approx(pressure / spin).epsilon(0.02));
    } else {
        CHECK(impulse[0] == Approx(pressure * scene.memm.time()).epsilon(1e-3));
        CHECK(std::abs(impulse[1]) <= 1e-12);
    }
}

TEST_CASE("leapfrog with springs keeps energy with order 2", "[solid][attachments]") {
    auto options = free_bodies<2>(2);
    options.kinematics = {Kinematics::floating, Kinematics::rigid};
    options.springs = {{.first = {.body = 0, .position = {0.5, 0.3}},
                        .second = {.body = 1, .position = {1.5, 0.1}},
                        .stiffness = 0.05,
                        .length = 0.4}};
    const auto mesh = two_blocks<2>();
    const auto drift_at = [&](double dt) {
        solid::Solid<2> solid(mesh, options);
        dynamics::Leapfrog leapfrog(
            solid, std::vector<double>(solid.size(), 0.0),
            momentum_of<2>(solid, {moving<2>({0.0, 0.0}, some_spin<2>(0.05)), moving<2>({0.0, 0.02})}), dt);
        const double start = leapfrog.energy();
        double drift = 0.0;
        while (leapfrog.time() < 40.0) {
            leapfrog.step();
            raise(drift, std::abs(leapfrog.energy() - start));
        }
        return drift;
    };
    CHECK(std::log2(drift_at(0.04) / drift_at(0.02)) == Approx(2.0).margin(0.3));
}

TEST_CASE("a traction on a body that turns must be finite, in every step", "[solid][attachments]") {
    const auto mesh = two_blocks<2>();
    auto options = free_bodies<2>(2);
    options.kinematics.assign(2, Kinematics::rigid);
    const auto late = [](double time, const Vector<2>&) -> Vector<2> { return {time > 0.25 ? std::nan("") : 0.0, 0.0}; };
    options.boundary.traction = {{.group = "left.xmin", .history = late}};
    solid::Solid<2> solid(mesh, options);
    const std::vector<double> rest(solid.size(), 0.0);
    dynamics::Memm memm(solid, rest, rest, 0.1);
    for (int i = 0; i < 3; ++i) memm.step();
    CHECK_THROWS_WITH(memm.step(), Catch::Contains("left.xmin") && Catch::Contains("not finite"));
}

TEST_CASE("springs and moments that cannot be are refused", "[solid][attachments]") {
    const auto mesh = two_blocks<2>();
    auto options = free_bodies<2>(2);
    SECTION("no such body") { options.springs = {{.first = {.body = 2}, .second = {}, .stiffness = 1.0}}; }
    SECTION("a stiffness below 0") { options.springs = {{.first = {.body = 0}, .second = {}, .stiffness = -1.0}}; }
    SECTION("a moment on no body") { options.moments = {{.body = -1}}; }
    SECTION("a prescribed displacement on a body that turns") {
        options.kinematics = {Kinematics::floating, Kinematics::small};
        options.boundary.dirichlet = {{.group = "left.xmin"}};
    }
    CHECK_THROWS_AS(solid::Solid<2>(mesh, options), BadInput);
}
