#include <catch2/catch.hpp>

#include "abut/solid/contact_view.hpp"
#include "abut/solid/rigid_obstacle.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;

namespace {

/// The bouncing bar: L = 10, E = 900, rho = 1, so c = 30; v0 = 10, 5 from the wall.
/// Contact from 0.5 to 0.5 + 2 L/c, pressure v0 sqrt(E rho) = 300, rebound 10.
inline constexpr double length = 10.0, young = 900.0, wave_speed = 30.0, speed = 10.0, gap = 5.0, height = 0.2;
inline constexpr int n = 100;
inline constexpr double dt = 0.5 * (length / n) / wave_speed;

mesh::Mesh<2> bar() {
    return mesh::structured_box<2>({gap, 0.0}, {gap + length, height}, {n, 2}, CellShape::quadrangle, "bar");
}

solid::SolidOptions<2> bar_and_wall(std::function<Vector<2>(double)> path = {}) {
    solid::SolidOptions<2> options;
    options.materials = {{.young = young, .poisson = 0.0, .density = 1.0}};
    options.contact = contact::ContactOptions{};
    options.law = solid::ContactLaw::reconstruction;
    options.obstacles = {contact::plane_obstacle<2>({0.0, 0.1}, {1.0, 0.0}, 3.0, std::move(path))};
    return options;
}

}  // namespace

TEST_CASE("the force on an obstacle that there is not is refused", "[solid][obstacle][errors]") {
    const mesh::Mesh<2> mesh = bar();
    auto options = bar_and_wall();
    const solid::Solid<2> with_wall(mesh, options);
    CHECK(with_wall.contact().obstacle_force(0) == Vector<2>::Zero());
    CHECK_THROWS_AS(with_wall.contact().obstacle_force(1), Misuse);
    options.obstacles.clear();
    options.contact.reset();
    CHECK_THROWS_AS(solid::Solid<2>(mesh, options).contact().obstacle_force(0), Misuse);
}

TEST_CASE("a bar on a rigid wall feels the pressure v0 sqrt(E rho) for the time 2L/c and rebounds", "[solid][obstacle]") {
    Scene<2> scene(bar(), bar_and_wall(), {Vector<2>(-speed, 0.0)}, dt);
    double impulse = 0.0, first = 0.0, last = 0.0;
    while (scene.memm.time() < 1.4) {
        scene.run(1);
        const Vector<2> force = scene.solid.contact().obstacle_force(0);
        CHECK(std::abs(force[1]) < 1e-9);
        if (force[0] == 0.0) continue;
        if (first == 0.0) first = scene.memm.time() - dt;
        last = scene.memm.time();
        impulse -= force[0] * dt;
    }
    const auto motion = solid::body_motions<2>(scene.memm, scene.solid)[0];
    CHECK(first == Approx(gap / speed).margin(2.0 * dt));
    CHECK(last == Approx(gap / speed + 2.0 * length / wave_speed).epsilon(0.02));
    CHECK(impulse / (height * (2.0 * length / wave_speed)) == Approx(speed * std::sqrt(young)).epsilon(0.02));
    CHECK(motion.velocity[0] == Approx(speed).epsilon(0.03));
    CHECK(motion.velocity[0] < speed);
    CHECK(std::abs(motion.velocity[1]) < 1e-10);
    CHECK(impulse == Approx(motion.mass * (speed + motion.velocity[0])).epsilon(1e-2));
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-11 * scene.kinetic_start());
    CHECK(scene.ledger.energy_excess() < 5e-3 * scene.kinetic_start());
    CHECK(scene.solid.work() == 0.0);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
}

TEST_CASE("the contact field of a bar on a wall is the pressure on its end, and no gap elsewhere", "[solid][obstacle]") {
    Scene<2> scene(bar(), bar_and_wall(), {Vector<2>(-speed, 0.0)}, dt);
    scene.run_until(0.6, 1000);
    double pressure = 0.0, pressed_in = 0.0;
    const int steps = 200;
    for (int i = 0; i < steps; ++i) {
        scene.memm.step();
        const auto field = scene.solid.contact_at(scene.memm.q()).field();
        for (std::size_t b = 0; b < field.pressure.size(); ++b) {
            if (scene.mesh.face_normal[scene.mesh.boundary_faces[b]][0] < -0.99) {
                pressure += field.pressure[b] / (2.0 * steps);  // two faces at the end
                raise(pressed_in, -field.gap[b]);
            } else {
                CHECK(field.pressure[b] == 0.0);
                CHECK(field.gap[b] == std::numeric_limits<double>::infinity());
            }
        }
    }
    CHECK(pressure == Approx(speed * std::sqrt(young)).epsilon(0.02));
    CHECK(pressed_in > 0.0);
    CHECK(pressed_in < 0.5 * length / n);  // less than the depth of a cell
}

TEST_CASE("H~ gains the work of a moving wall exactly, and a bar at rest is thrown off as a flying one rebounds",
          "[solid][obstacle]") {
    Scene<2> flying(bar(), bar_and_wall(), {Vector<2>(-speed, 0.0)}, dt);
    Scene<2> pushed(bar(), bar_and_wall([](double t) { return Vector<2>(speed * t, 0.0); }), {Vector<2>::Zero()}, dt);
    flying.run_until(1.4);
    pushed.run_until(1.4);
    CHECK(pushed.ledger.pseudo_energy_drift() < 1e-12 * pushed.ledger.largest_energy());
    CHECK(pushed.solid.work() == Approx(pushed.ledger.largest_energy()).epsilon(0.05));
    // The same impact seen from a wall that moves.
    const auto motion_1 = solid::body_motions<2>(flying.memm, flying.solid)[0],
               motion_2 = solid::body_motions<2>(pushed.memm, pushed.solid)[0];
    CHECK(motion_2.velocity[0] == Approx(motion_1.velocity[0] + speed).epsilon(1e-6));
}

TEMPLATE_TEST_CASE_SIG(
    "H~ gains the work of a tilted wall that turns back and of one behind, in contact with an unstructured body",
    "[solid][obstacle]", ((int Dim), Dim), 2, 3) {
    auto options = reconstructed_bodies<Dim>(1);
    Vector<Dim> tilted = Vector<Dim>::Unit(0), origin = Vector<Dim>::Zero();
    tilted[1] = 0.2;
    origin[0] = -1.05;
    const Vector<Dim> behind = -origin;
    options.obstacles = {
        contact::plane_obstacle<Dim>(origin, tilted, 4.0,
                                     [](double t) { return Vector<Dim>(0.3 * std::sin(1.5 * t) * Vector<Dim>::Unit(0)); }),
        contact::plane_obstacle<Dim>(behind, -Vector<Dim>::Unit(0), 4.0)};
    Scene<Dim> scene(round_body<Dim>(Dim == 2 ? 0.25 : 0.5), options, {Vector<Dim>::Zero()});
    scene.run_until(5.0);
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-12 * scene.ledger.largest_energy());
    CHECK(scene.solid.work() > 0.1 * scene.ledger.largest_energy());
    CHECK(scene.solid.contact().report().missed_contacts == 0);
    CHECK(scene.solid.contact().report().events > 20);
}

TEST_CASE("the momentum that a body loses is the mean force on the obstacle times twice the step, step by step",
          "[solid][obstacle]") {
    auto options = reconstructed_bodies<2>(1);
    options.obstacles = {contact::plane_obstacle<2>({-1.02, 0.0}, {1.0, 0.1}, 4.0)};
    Scene<2> scene(unit_disc(0.25), options, {Vector<2>(-0.1, 0.02)});
    const auto total = [](std::span<const double> p) {
        Vector<2> sum = Vector<2>::Zero();
        for (const Vector<2>& p_c : as_vectors<2>(p)) sum += p_c;
        return sum;
    };
    bool touched = false;
    for (int i = 0; i < 150; ++i) {
        const Vector<2> before = total(scene.memm.p_before());
        scene.memm.step();
        const Vector<2> gained = total(scene.memm.p_after()) - before;
        CHECK((gained + 2.0 * scene.memm.dt() * scene.solid.contact().obstacle_force(0)).norm() < 1e-14);
        touched = touched || gained.norm() > 1e-3;
    }
    CHECK(touched);
}

TEMPLATE_TEST_CASE_SIG("H~ gains the work of a rigid box that strikes a body with its face, edge or corner",
                       "[solid][obstacle]", ((int Dim), Dim), 2, 3) {
    contact::ContactOptions narrow;
    narrow.search.facing_cosine = -0.9;  // the sides of the box are no partners of the round face in front of it
    auto options = reconstructed_bodies<Dim>(1, narrow);
    const mesh::CellShape shape = Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron;
    // Of two cells each way, left of the body; shifted across so that an edge or a corner comes first on some of its faces.
    Vector<Dim> lower = Vector<Dim>::Constant(GENERATE(-0.37, 0.05, 0.2)), upper = lower + Vector<Dim>::Constant(0.7);
    lower[0] = -1.72, upper[0] = -1.02;
    if constexpr (Dim == 3) lower[2] = -0.15, upper[2] = 0.6;  // past one end of the cylinder
    std::array<int, Dim> cells;
    cells.fill(2);
    const auto box = mesh::structured_box<Dim>(lower, upper, cells, shape, "box");
    options.obstacles = {
        solid::rigid_obstacle<Dim>(box, [](double t) { return Vector<Dim>(0.02 * t * Vector<Dim>::Unit(0)); })};
    Scene<Dim> scene(round_body<Dim>(Dim == 2 ? 0.25 : 0.5), options, {Vector<Dim>::Zero()});
    scene.run_until(20.0, 5);
    CHECK(scene.solid.contact().report().events > 1);
    CHECK(scene.solid.work() > 1e-4);
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-12 * scene.ledger.largest_energy());
    CHECK(scene.solid.contact().report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("a rigid obstacle has the faces of the mesh it is made of, seen from outside", "[solid][obstacle]",
                       ((int Dim), Dim), 2, 3) {
    const auto mesh = round_body<Dim>(0.5);
    contact::Surface<Dim> surface;
    contact::append(surface, solid::rigid_obstacle<Dim>(mesh), 0);
    REQUIRE(surface.area.size() == mesh.boundary_faces.size());
    for (std::size_t b = 0; b < surface.area.size(); ++b) {
        CHECK(surface.area[b] == Approx(mesh.face_measure[mesh.boundary_faces[b]]).epsilon(1e-13));
        CHECK((surface.normal[b] - mesh.face_normal[mesh.boundary_faces[b]]).norm() < 1e-13);
    }
}
