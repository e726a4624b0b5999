// What a solid of bodies that turn refuses, and what it makes of displacements and velocities of cells.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "abut/base/error.hpp"
#include "abut/base/rotation.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using solid::Kinematics;

namespace {

mesh::Mesh<2> one_box(int cells = 2) {
    return mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.5}, {cells, cells}, CellShape::quadrangle);
}
solid::SolidOptions<2> of_kind(Kinematics kinematics) {
    auto options = bodies<2>(1);
    options.kinematics = {kinematics};
    return options;
}

}  // namespace

TEST_CASE("bodies that turn refuse what only small ones can have, with a sentence", "[solid][kinematics]") {
    const auto mesh = one_box();
    const auto make = [&](const solid::SolidOptions<2>& options) { solid::Solid<2> solid(mesh, options); };
    auto options = of_kind(Kinematics::floating);
    options.kinematics.push_back(Kinematics::small);
    CHECK_THROWS_WITH(make(options), Contains("kinematics: 2 given for 1 body"));
    for (const Kinematics kind : {Kinematics::floating, Kinematics::rigid}) {
        options = of_kind(kind);
        options.boundary.dirichlet.push_back({.group = "xmin", .value = {}});
        CHECK_THROWS_WITH(make(options), Contains("prescribed displacement") && Contains("xmin") && Contains("small"));
        options = of_kind(kind);
        options.law = solid::ContactLaw::reconstruction;
        CHECK_THROWS_WITH(make(options), Contains("pair_potential"));
        options = of_kind(kind);
        options.contact->overlap = contact::OverlapMode::frozen;
        CHECK_THROWS_WITH(make(options), Contains("overlap") && Contains("small"));
        options = of_kind(kind);
        options.body_load = [](const Vector<2>&) -> Vector<2> { return {0.0, std::nan("")}; };
        CHECK_THROWS_AS(make(options), BadInput);
    }
}

TEST_CASE(
    "a choice that the law which acts does not read is refused by its key, and says which law reads it; defaults may be "
    "given",
    "[solid][kinematics][errors]") {
    using Set = std::function<void(solid::SolidOptions<2>&)>;
    const auto mesh = one_box();
    const auto refused = [&](solid::ContactLaw acting, const Set& set, const std::string& key) {
        auto options = of_kind(Kinematics::small);
        options.law = acting;
        set(options);
        const bool by_pairs = acting != solid::ContactLaw::reconstruction;
        CAPTURE(key);
        CHECK_THROWS_WITH(solid::Solid<2>(mesh, options),
                          Contains((by_pairs ? "laboratory." : "contact.") + key + " has no effect") &&
                              Contains(by_pairs ? "Set law = \"reconstruction\"" : "Set law = \"pair_potential\""));
    };
    const auto pairs = solid::ContactLaw::pair_potential, faces = solid::ContactLaw::reconstruction;
    for (const auto by_pairs : {pairs, solid::ContactLaw::automatic}) {
        refused(
            by_pairs, [](auto& o) { o.contact->overlap = contact::OverlapMode::frozen; }, "overlap");
        refused(
            by_pairs, [](auto& o) { o.contact->weighting = contact::InterfaceWeighting::half; }, "weighting");
        refused(
            by_pairs, [](auto& o) { o.contact->area = geometry::AreaMethod::exact; }, "area");
        refused(
            by_pairs, [](auto& o) { o.contact->quadrature = 1; }, "quadrature");
        refused(
            by_pairs, [](auto& o) { o.contact->search.facing_cosine = -0.3; }, "facing_cosine");
    }
    refused(
        faces, [](auto& o) { o.facing.full = -0.7; }, "facing_full");
    refused(
        faces, [](auto& o) { o.facing.none = -0.1; }, "facing_none");
    for (const auto law : {pairs, faces}) {
        auto options = of_kind(Kinematics::small);
        options.law = law;
        options.contact->quadrature = 2;  // the exact number in 2D
        options.contact->events = false;
        CHECK_NOTHROW(solid::Solid<2>(mesh, options));
    }
}

TEST_CASE("a floating body of one cell is refused, a rigid one spins", "[solid][kinematics]") {
    const auto mesh = one_box(1);
    CHECK_THROWS_WITH((solid::Solid<2>(mesh, of_kind(Kinematics::floating))), Contains("at least two cells"));
    solid::Solid<2> solid(mesh, of_kind(Kinematics::rigid));
    dynamics::Memm memm(solid, std::vector<double>(solid.size(), 0.0), momentum_of<2>(solid, {{.spin = some_spin<2>(0.5)}}),
                        0.01);
    for (int i = 0; i < 100; ++i) memm.step();
    CHECK(solid.rotations(memm.q())[0] == Approx(0.5).epsilon(1e-4));
}

TEST_CASE("a floating body of cells in a row is refused in space", "[solid][kinematics]") {
    const auto mesh = mesh::structured_box<3>({0.0, 0.0, 0.0}, {4.0, 1.0, 1.0}, {4, 1, 1}, CellShape::hexahedron);
    auto options = bodies<3>(1);
    options.kinematics = {Kinematics::floating};
    CHECK_THROWS_WITH((solid::Solid<3>(mesh, options)), Contains("at least two cells"));
}

TEST_CASE("a rigid body takes the turn of its cells, also where they are in a row", "[solid][kinematics]") {
    const std::array<int, 3> cells = GENERATE(std::array{4, 1, 1}, std::array{3, 2, 1}, std::array{3, 2, 2});
    const double width = GENERATE(1.0, 1e-9, 1e9);
    const Vector<3> upper = width * Vector<3>(1.0, 0.4, 0.3);
    const auto mesh = mesh::structured_box<3>(Vector<3>::Zero(), upper, cells, CellShape::hexahedron);
    auto options = bodies<3>(1);
    options.contact.reset();
    options.kinematics = {Kinematics::rigid};
    solid::Solid<3> solid(mesh, options);
    const Matrix<3> turn = rotation_about(Vector<3>::UnitZ(), 0.3);
    const Vector<3> shift = 0.2 * upper;
    std::vector<Vector<3>> of_cells;
    for (const Vector<3>& x : mesh.cell_centroid) of_cells.emplace_back(turn * x + shift - x);
    const auto q = solid.cells().to_q(of_cells);
    for (std::size_t i = 0; i < solid.masses().size(); ++i) {
        const Vector<3> x = solid.rest_positions()[i];
        CHECK((vectors<3>(q)[i] - (turn * x + shift - x)).norm() <= 1e-12 * width);
    }
    const auto back = solid.cells().displacement(q);
    for (std::size_t c = 0; c < back.size(); ++c) CHECK((back[c] - of_cells[c]).norm() <= 1e-12 * width);
}

TEST_CASE("velocities of cells go to the points and back, however slow or far away", "[solid][kinematics]") {
    const double speed = GENERATE(1.0, 1e-9);
    const double far = GENERATE(0.0, 1e6);
    const auto mesh = mesh::structured_box<3>(Vector<3>::Constant(far), Vector<3>::Constant(far) + Vector<3>(1.0, 0.7, 0.4),
                                              {3, 2, 2}, CellShape::hexahedron);
    auto options = bodies<3>(1);
    options.contact.reset();
    options.kinematics = {Kinematics::rigid};
    solid::Solid<3> solid(mesh, options);
    std::vector<Vector<3>> of_cells;
    for (const Vector<3>& x : mesh.cell_centroid)
        of_cells.emplace_back(
            speed * (Vector<3>(0.1, 0.2, 0.3) +
                     dynamics::turning_velocity<3>(AxialVector<3>(0.3, -0.5, 0.2), Vector<3>(x - mesh.cell_centroid[0]))));
    const auto p = solid.cells().to_p(of_cells);
    const auto back = solid.cells().velocity(p);
    for (std::size_t c = 0; c < back.size(); ++c) CHECK((back[c] - of_cells[c]).norm() <= 1e-8 * speed);
}

TEST_CASE("every step of rigid bodies without contact is stable", "[solid][kinematics]") {
    const auto mesh = one_box();
    auto options = of_kind(Kinematics::rigid);
    options.contact.reset();
    solid::Solid<2> solid(mesh, options);
    CHECK(std::isinf(dynamics::stable_step(solid).dt));
}

TEST_CASE("a state that is not finite is a run that has diverged", "[solid][kinematics]") {
    const Kinematics kind = GENERATE(Kinematics::floating, Kinematics::rigid);
    const auto mesh = two_discs(0.8);
    auto options = bodies<2>(2);
    options.kinematics = {kind, Kinematics::floating};
    solid::Solid<2> solid(mesh, options);
    const std::vector<double> q(solid.size(), 0.0);
    for (const std::size_t wrong : {std::size_t{0}, solid.size() - 1}) {
        std::vector<double> q_1(q), force(q.size());
        q_1[wrong] = std::nan("");
        CHECK_THROWS_AS(solid.mean_force(q, q_1, 0.0, 0.01, force), Diverged);
    }
}

TEST_CASE("a rigid body that spins by half a turn in a step is refused", "[solid][kinematics]") {
    const auto mesh = one_box();
    auto options = of_kind(Kinematics::rigid);
    options.contact.reset();
    solid::Solid<2> solid(mesh, options);
    CHECK_THROWS_AS(dynamics::Memm(solid, std::vector<double>(solid.size(), 0.0),
                                   momentum_of<2>(solid, {{.spin = some_spin<2>(1.0)}}), 30.0),
                    Diverged);
}

TEMPLATE_TEST_CASE_SIG("an obstacle that turns works on bodies, and H~ less the work stays", "[solid][kinematics]",
                       ((int Dim), Dim), 2, 3) {
    const Kinematics kind = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::rigid);
    Vector<Dim> lower = Vector<Dim>::Constant(-0.3), upper = Vector<Dim>::Constant(0.3);
    lower[Dim - 1] = 0.05, upper[Dim - 1] = 0.4, lower[0] = 0.5, upper[0] = 1.2;
    std::array<int, Dim> counts;
    counts.fill(3);
    const auto mesh =
        mesh::structured_box<Dim>(lower, upper, counts, Dim == 2 ? CellShape::triangle : CellShape::tetrahedron);
    auto options = bodies<Dim>(1);
    options.acceleration = {-0.01 * Vector<Dim>::Unit(Dim - 1)};
    auto paddle = contact::plane_obstacle<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Unit(Dim - 1), 2.0);
    paddle.placement = [](double t) -> contact::Placement<Dim> {
        Matrix<Dim> turn = Matrix<Dim>::Identity();
        const double angle = 0.1 * std::sin(0.5 * t), c = std::cos(angle), s = std::sin(angle);
        turn(0, 0) = c, turn(0, Dim - 1) = -s, turn(Dim - 1, 0) = s, turn(Dim - 1, Dim - 1) = c;
        return {.turn = turn, .offset = 0.02 * std::sin(t) * Vector<Dim>::Unit(0)};
    };
    options.obstacles = {paddle};
    TurningScene<Dim> scene(mesh, options, std::vector<Motion<Dim>>(1), 0.5, kind);
    scene.run_until(20.0);
    CHECK(scene.solid.contact().report().active_pairs_max > 0);
    CHECK(std::abs(scene.solid.work()) > 1e-6);
    CHECK(scene.drifts().pseudo_energy <= 1e-12);

    options.law = solid::ContactLaw::reconstruction;
    CHECK_THROWS_WITH((solid::Solid<Dim>(mesh, options)), Contains("pair_potential"));
    options.law = solid::ContactLaw::automatic;
    options.obstacles[0].placement = [](double) { return contact::Placement<Dim>{.turn = 1.1 * Matrix<Dim>::Identity()}; };
    solid::Solid<Dim> solid(mesh, options);
    const std::vector<double> q(solid.size(), 0.0);
    std::vector<double> force(q.size());
    CHECK_THROWS_WITH(solid.mean_force(q, q, 0.0, 0.01, force), Contains("obstacle 0") && Contains("rotation"));
}

TEMPLATE_TEST_CASE_SIG("a body load on a rigid body is its force and moment", "[solid][kinematics]", ((int Dim), Dim), 2,
                       3) {
    std::array<int, Dim> counts;
    counts.fill(3);
    const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Constant(-0.5), Vector<Dim>::Constant(0.5), counts,
                                                Dim == 2 ? CellShape::triangle : CellShape::hexahedron);
    auto options = bodies<Dim>(1);
    options.contact.reset();
    options.kinematics = {Kinematics::rigid};
    // Of x: a force up that grows along it, whose moment is turned into a spin about the last axis.
    options.body_load = [](const Vector<Dim>& x) -> Vector<Dim> { return (0.1 + 0.2 * x[0]) * Vector<Dim>::Unit(1); };
    solid::Solid<Dim> solid(mesh, options);
    std::vector<double> q(solid.size(), 0.0), force(solid.size());
    solid.force(q, force);
    Vector<Dim> sum = Vector<Dim>::Zero();
    AxialVector<Dim> torque = AxialVector<Dim>::Zero();
    double expected_torque = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        expected_torque += mesh.cell_measure[c] * mesh.cell_centroid[c][0] * (0.1 + 0.2 * mesh.cell_centroid[c][0]);
    for (std::size_t i = 0; i < solid.masses().size(); ++i) {
        sum += vectors<Dim>(force)[i];
        torque += moment<Dim>(solid.rest_positions()[i], vectors<Dim>(force)[i]);
    }
    CHECK(sum[1] == Approx(0.1).epsilon(1e-12));
    CHECK(torque[torque.size() - 1] == Approx(expected_torque).epsilon(1e-12));
    CHECK(std::abs(sum[0]) <= 1e-14);
}
