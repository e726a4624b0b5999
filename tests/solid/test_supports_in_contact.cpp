// What a support holds or drives takes part in contact: its faces are rigid ones on its path.
#include <algorithm>
#include <catch2/catch.hpp>

#include "abut/solid/contact_view.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Constraint;
using solid::ContactLaw;
using solid::Kinematics;

namespace {

template <int Dim>
inline const char* const upwards = Dim == 2 ? "ymax" : "zmax";
template <int Dim>
inline const char* const downwards = Dim == 2 ? "ymin" : "zmin";

/// A body above y = 0, or z = 0 in space, and a block whose top is there.
template <int Dim>
mesh::Mesh<Dim> body_above_block(const mesh::Mesh<Dim>& body) {
    Vector<Dim> lower = Vector<Dim>::Constant(-1.0), upper = Vector<Dim>::Constant(1.0);
    upper[Dim - 1] = 0.0;
    std::array<int, Dim> counts;
    counts.fill(Dim == 2 ? 9 : 5);
    return together(
        mesh::structured_box<Dim>(lower, upper, counts, Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron, "block"),
        body);
}

mesh::Mesh<2> falling_disc() { return mesh::disc({.centre = {0.13, 0.42}, .radius = 0.4, .size = 0.1, .name = "disc"}); }
mesh::Mesh<3> falling_box() {
    return mesh::structured_box<3>({-0.4, -0.35, 0.02}, {0.42, 0.4, 0.8}, {3, 3, 3}, CellShape::tetrahedron, "box");
}
template <int Dim>
mesh::Mesh<Dim> falling() {
    if constexpr (Dim == 2)
        return falling_disc();
    else
        return falling_box();
}

template <int Dim>
solid::DirichletCondition<Dim> held(std::string group) {
    solid::DirichletCondition<Dim> condition;
    condition.group = std::move(group);
    return condition;
}

/// As a mesh of several bodies calls it: with the body in front where two have such a group.
template <int Dim>
solid::DirichletCondition<Dim> held(const mesh::Mesh<Dim>& mesh, const std::string& body, const std::string& side) {
    const auto is = [&](const auto& group) { return group.name == body + "." + side; };
    return held<Dim>(std::ranges::any_of(mesh.groups, is) ? body + "." + side : side);
}

template <int Dim>
Vector<Dim> along(double x, double up) {
    Vector<Dim> v = Vector<Dim>::Zero();
    v[0] = x;
    v[Dim - 1] = up;
    return v;
}

template <int Dim>
Vector<Dim> velocity_of(const Scene<Dim>& scene, std::size_t body) {
    return solid::body_motions<Dim>(scene.memm, scene.solid)[body].velocity;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("what lands on a face that is held rebounds as it does from a rigid plane", "[solid][supports]",
                       ((int Dim), Dim), 2, 3) {
    const auto law = GENERATE(ContactLaw::reconstruction, ContactLaw::pair_potential);
    auto options = bodies<Dim>(2);
    options.law = law;
    const auto mesh = body_above_block<Dim>(falling<Dim>());
    options.boundary.dirichlet = {held<Dim>(mesh, "block", upwards<Dim>)};
    const Vector<Dim> down = along<Dim>(0.01, -0.05);
    Scene<Dim> on_block(mesh, options, {Vector<Dim>::Zero(), down}, 0.02);
    auto alone = bodies<Dim>(1);
    alone.law = law;
    alone.obstacles = {contact::plane_obstacle<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Unit(Dim - 1), 1.0)};
    Scene<Dim> on_plane(falling<Dim>(), alone, {down}, 0.02);
    on_block.run_until(12.0);
    on_plane.run_until(12.0);

    const auto motion = solid::body_motions<Dim>(on_block.memm, on_block.solid)[1];
    const Vector<Dim> rebound = velocity_of(on_plane, 0);
    CHECK(rebound[Dim - 1] > 0.03);  // it has landed and left
    CHECK((motion.velocity - rebound).norm() < 1e-3 * rebound.norm());
    const auto impulses = on_block.solid.contact().impulses();
    REQUIRE(impulses.size() == 1);
    CHECK((impulses[0].impulse - motion.mass * (motion.velocity - down)).norm() < 1e-12 * impulses[0].impulse.norm());
    CHECK(on_block.ledger.pseudo_energy_drift() < 1e-12 * on_block.kinetic_start());
    CHECK(on_block.solid.work() == 0.0);
    CHECK(velocity_of(on_block, 0) == Vector<Dim>::Zero());  // the support takes all of the force
}

TEMPLATE_TEST_CASE_SIG("bodies that turn or bend land on faces that are held", "[solid][supports]", ((int Dim), Dim), 2, 3) {
    const auto of_block = GENERATE(Kinematics::small, Kinematics::finite);
    const auto of_body = GENERATE(Kinematics::floating, Kinematics::finite, Kinematics::rigid);
    auto options = bodies<Dim>(2);
    options.kinematics = {of_block, of_body};
    const auto mesh = body_above_block<Dim>(falling<Dim>());
    options.boundary.dirichlet = {held<Dim>(mesh, "block", upwards<Dim>)};
    const Vector<Dim> down = along<Dim>(0.0, -0.05);
    Scene<Dim> scene(mesh, options, {Vector<Dim>::Zero(), down}, 0.01);
    scene.run_until(10.0);
    const auto motion = solid::body_motions<Dim>(scene.memm, scene.solid)[1];
    CHECK(motion.velocity[Dim - 1] > 0.03);
    const auto impulses = scene.solid.contact().impulses();
    REQUIRE(impulses.size() == 1);
    CHECK((impulses[0].impulse - motion.mass * (motion.velocity - down)).norm() < 1e-11 * impulses[0].impulse.norm());
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-11 * scene.kinetic_start());
}

TEMPLATE_TEST_CASE_SIG("a face that is driven throws a body as it would rebound, and H~ gains the work", "[solid][supports]",
                       ((int Dim), Dim), 2, 3) {
    const auto law = GENERATE(ContactLaw::reconstruction, ContactLaw::pair_potential);
    auto still = bodies<Dim>(2);
    still.law = law;
    const auto mesh = body_above_block<Dim>(falling<Dim>());
    still.boundary.dirichlet = {held<Dim>(mesh, "block", upwards<Dim>)};
    auto driven = still;
    driven.boundary.dirichlet[0].history = [](double t, const Vector<Dim>&) { return along<Dim>(0.0, 0.05 * t); };
    Scene<Dim> flying(mesh, still, {Vector<Dim>::Zero(), along<Dim>(0.0, -0.05)}, 0.02);
    Scene<Dim> pushed(mesh, driven, {along<Dim>(0.0, 0.05), Vector<Dim>::Zero()}, 0.02);
    flying.run_until(12.0);
    pushed.run_until(12.0);
    // The same seen from the face.
    CHECK((velocity_of(pushed, 1) - velocity_of(flying, 1) - along<Dim>(0.0, 0.05)).norm() < 1e-9);
    CHECK(pushed.ledger.pseudo_energy_drift() < 1e-12 * pushed.ledger.largest_energy());
    CHECK(pushed.solid.work() > 0.0);
}

TEST_CASE("a driven punch compresses a block by E A / h", "[solid][supports]") {
    const auto law = GENERATE(ContactLaw::reconstruction, ContactLaw::pair_potential);
    // The punch is wider, and its cells do not match; nu = 0, so that the block does not bulge below it.
    const double stroke = 0.02, ramp = 60.0, end = 80.0, gap = 0.001;
    const auto mesh =
        together(mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {8, 8}, CellShape::quadrangle, "piece"),
                 mesh::structured_box<2>({-0.3, 1.0 + gap}, {1.3, 1.5}, {11, 3}, CellShape::triangle, "punch"));
    solid::SolidOptions<2> options;
    options.materials.assign(2, {.young = 1.0, .poisson = 0.0, .density = 1.0});
    options.contact = contact::ContactOptions{};
    options.law = law;
    options.obstacles = {contact::plane_obstacle<2>({0.5, 0.0}, {0.0, 1.0}, 3.0)};
    auto face = held<2>("punch.ymin");
    face.history = [&](double t, const Vector<2>&) {
        const double s = std::min(1.0, t / ramp);
        return Vector<2>(0.0, -(gap + stroke) * s * s * (3.0 - 2.0 * s));
    };
    options.boundary.dirichlet = {face};
    Scene<2> scene(mesh, options, std::vector<Vector<2>>(2, Vector<2>::Zero()));
    scene.run_until(ramp, 20);
    const double before = scene.solid.contact().impulses().front().impulse.norm(), since = scene.memm.time();
    scene.run_until(end, 20);
    double impulse = -before;
    for (const auto& pair : scene.solid.contact().impulses())
        if (pair.body_1 == 0 && pair.body_2 == 1) impulse += pair.impulse.norm();
    CHECK(impulse / (scene.memm.time() - since) == Approx(1.0 * stroke).epsilon(0.02));  // E A stroke / h
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-12 * scene.ledger.largest_energy());
}

TEST_CASE("faces that a support guides along themselves meet as free ones do", "[solid][supports]") {
    // Two bars that mirror each other meet as each of them meets a rigid plane between them.
    const auto bar = [](double y, const char* name) {
        return mesh::structured_box<2>({0.0, y}, {0.4, y + 1.0}, {2, 6}, CellShape::quadrangle, name);
    };
    const auto guide = [](const char* group) {
        auto condition = held<2>(group);
        condition.constraint = Constraint::components;
        condition.components = {true, false};
        return condition;
    };
    auto options = bodies<2>(2);
    options.law = GENERATE(ContactLaw::reconstruction, ContactLaw::pair_potential);
    options.boundary.dirichlet = {guide("lower.ymax"), guide("upper.ymin")};
    auto alone = bodies<2>(1);
    alone.law = options.law;
    alone.boundary.dirichlet = {guide("ymin")};
    alone.obstacles = {contact::plane_obstacle<2>({0.2, 0.0}, {0.0, 1.0}, 1.0)};
    Scene<2> both(together(bar(-1.01, "lower"), bar(0.01, "upper")), options, {{0.0, 0.05}, {0.0, -0.05}}, 0.02);
    Scene<2> one(bar(0.01, "upper"), alone, {{0.0, -0.05}}, 0.02);
    both.run_until(4.0);
    one.run_until(4.0);
    CHECK(velocity_of(one, 0).y() > 0.04);
    CHECK((velocity_of(both, 1) - velocity_of(one, 0)).norm() < 1e-4 * 0.05);
    CHECK((velocity_of(both, 0) + velocity_of(both, 1)).norm() < 1e-9 * 0.05);
}

TEMPLATE_TEST_CASE_SIG("H~ is kept where faces in contact are held in some directions, whatever these are",
                       "[solid][supports]", ((int Dim), Dim), 2, 3) {
    const auto law = GENERATE(ContactLaw::reconstruction, ContactLaw::pair_potential);
    const auto constraint = GENERATE(Constraint::normal, Constraint::components);
    const auto rule = GENERATE(solid::FreeFaceRule::local_equilibrium, solid::FreeFaceRule::extrapolate);
    auto options = bodies<Dim>(2);
    options.law = law;
    options.boundary.free_face_rule = rule;
    mesh::Mesh<Dim> lower, upper;
    if constexpr (Dim == 2) {
        lower = mesh::disc({.centre = {0.0, -0.4}, .radius = 0.4, .size = 0.15, .name = "lower"});
        upper = falling_disc();
    } else {
        lower = mesh::structured_box<3>({-0.5, -0.5, -0.6}, {0.5, 0.5, 0.0}, {3, 3, 2}, CellShape::tetrahedron, "lower");
        upper = falling_box();
    }
    const auto mesh = together(lower, upper);
    options.boundary.dirichlet = {held<Dim>(mesh, "lower", Dim == 2 ? "boundary" : "zmax")};
    options.boundary.dirichlet[0].constraint = constraint;
    options.boundary.dirichlet[0].components[0] = true;
    options.boundary.dirichlet[0].history = [](double t, const Vector<Dim>&) {
        return Vector<Dim>(0.01 * std::sin(2.0 * t) * Vector<Dim>::Ones());
    };
    Scene<Dim> scene(mesh, options, {Vector<Dim>::Zero(), along<Dim>(0.03, -0.05)}, 0.02);
    scene.run_until(6.0);
    CHECK(scene.solid.contact().report().active_pairs_max > 0);
    CHECK(scene.solid.work() != 0.0);
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-12 * scene.ledger.largest_energy());
    CHECK(velocity_of(scene, 1)[Dim - 1] > -0.02);  // it does not go on through it
}

TEST_CASE("a body that rests on a held face is found by the search for its equilibrium", "[solid][supports]") {
    auto options = bodies<2>(2);
    options.boundary.dirichlet = {held<2>("block.ymax")};
    options.law = GENERATE(ContactLaw::reconstruction, ContactLaw::pair_potential);
    const auto mesh =
        body_above_block<2>(mesh::structured_box<2>({-0.4, 0.0}, {0.4, 0.4}, {4, 3}, CellShape::quadrangle, "box"));
    Scene<2> scene(mesh, options, {Vector<2>::Zero(), Vector<2>(0.0, -0.02)}, 0.02);
    scene.run(1);
    const auto touching = scene.solid.contact_at(scene.memm.q()).touching_pairs(1e-3);
    CHECK(touching.size() >= 4);
    const auto field = scene.solid.contact_at(scene.memm.q()).field();
    double force_on_block = 0.0, force_on_box = 0.0;
    for (std::size_t b = 0; b < field.pressure.size(); ++b) {
        const std::int32_t face = mesh.boundary_faces[b];
        (mesh.cell_body[mesh.face_cells[face][0]] == 0 ? force_on_block : force_on_box) +=
            field.pressure[b] * mesh.face_measure[face];
    }
    CHECK(force_on_block == Approx(force_on_box).epsilon(1e-12));
    CHECK(force_on_box > 0.0);
}
