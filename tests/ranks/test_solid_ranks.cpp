#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "ranks/beside_one.hpp"
#include "ranks/shared_solid.hpp"
#include "ranks/solid_scenes.hpp"

using namespace abut;
using namespace abut::test;

TEST_CASE("parts have as many cells each, and every rank knows the same", "[ranks][solid]") {
    const ranks::Communicator all = test::world();
    const auto mesh = bar<3>(mesh::CellShape::tetrahedron);
    const std::vector<int> owner = parts(all, mesh);
    std::vector<int> count(static_cast<std::size_t>(all.size()), 0);
    for (const int rank : owner) ++count.at(static_cast<std::size_t>(rank));
    for (const int n : count) CHECK(std::abs(n - mesh.n_cells() / all.size()) <= 1);
    double sum = 0.0;
    for (std::size_t c = 0; c < owner.size(); ++c) sum += owner[c] * std::cos(static_cast<double>(c));
    CHECK(all.largest(sum) == sum);
    std::vector<double> weights(owner.size(), 1.0);
    weights[3] = -1.0;
    CHECK_THROWS_AS(ranks::partition<3>(all, mesh.cell_centroid, weights), BadInput);
}

TEMPLATE_TEST_CASE_SIG("a free body with waves has the bits of one rank, step by step", "[ranks][solid]", ((int Dim), Dim),
                       2, 3) {
    const ranks::Communicator all = test::world();
    const mesh::CellShape shape = Dim == 2 ? GENERATE(mesh::CellShape::triangle, mesh::CellShape::quadrangle)
                                           : GENERATE(mesh::CellShape::tetrahedron, mesh::CellShape::hexahedron);
    const auto mesh = bar<Dim>(shape);
    solid::SolidOptions<Dim> options;
    options.materials = {steel};
    const std::vector<Vector<Dim>> velocity{Vector<Dim>::Unit(0)};
    check_same_bits<Dim>(all, mesh, options, velocity, 20, parts(all, mesh), {.waves = 0.1});
}

TEMPLATE_TEST_CASE_SIG("loads, supports and gravity have the bits of one rank", "[ranks][solid]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = bar<Dim>(Dim == 2 ? mesh::CellShape::triangle : mesh::CellShape::tetrahedron);
    solid::SolidOptions<Dim> options;
    options.materials = {steel};
    options.acceleration = {-0.3 * Vector<Dim>::Unit(1)};
    options.body_load = [](const Vector<Dim>& x) -> Vector<Dim> { return 0.1 * std::sin(x[0]) * Vector<Dim>::Unit(0); };
    options.boundary.dirichlet = {{.group = "xmin", .history = [](double t, const Vector<Dim>&) -> Vector<Dim> {
                                       return 0.01 * std::sin(5.0 * t) * Vector<Dim>::Unit(1);
                                   }}};
    options.boundary.traction = {{.group = "ymax", .history = [](double t, const Vector<Dim>& x) -> Vector<Dim> {
                                      return 0.02 * std::sin(3.0 * t + x[0]) * Vector<Dim>::Unit(1);
                                  }}};
    const std::vector<Vector<Dim>> velocity{Vector<Dim>::Zero()};
    check_same_bits<Dim>(all, mesh, options, velocity, 20, parts(all, mesh), {.waves = 0.1});
}

TEMPLATE_TEST_CASE_SIG("two bodies that collide have the bits of one rank, pairs and lists included",
                       "[ranks][solid][contact]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<Dim>();
    solid::SolidOptions<Dim> options;
    options.materials = {steel, {.young = 1.0, .poisson = 0.2, .density = 1.0}};
    options.contact = contact::ContactOptions{};
    const auto report =
        check_same_bits<Dim>(all, mesh, options, towards_each_other<Dim>(0.1), Dim == 2 ? 130 : 58, parts(all, mesh));
    CHECK(report.events > 0);
    CHECK(report.rebuilds > 1);
}

TEST_CASE("contact with a moving wall and with itself has the bits of one rank", "[ranks][solid][contact]") {
    const ranks::Communicator all = test::world();
    const auto mesh = bar<2>(mesh::CellShape::triangle);
    solid::SolidOptions<2> options;
    options.materials = {steel};
    options.contact = contact::ContactOptions{};
    options.contact->search.self_contact = true;
    options.law = GENERATE(solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential);
    options.obstacles = {{.faces = {{Vector<2>(5.0, -0.01), Vector<2>(-1.0, -0.01)}},
                          .path = [](double t) -> Vector<2> { return 0.05 * t * Vector<2>::Unit(1); }}};
    const std::vector<Vector<2>> velocity{Vector<2>(0.0, -0.1)};
    const auto report = check_same_bits<2>(all, mesh, options, velocity, 120, parts(all, mesh));
    CHECK(report.events > 0);
}

TEMPLATE_TEST_CASE_SIG("bodies that turn, and strike each other and a wall, have the bits of one rank",
                       "[ranks][solid][contact]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<Dim>();
    solid::SolidOptions<Dim> options;
    options.materials = {steel, {.young = 1.0, .poisson = 0.2, .density = 1.0}};
    options.kinematics = {solid::Kinematics::floating,
                          GENERATE(solid::Kinematics::floating, solid::Kinematics::small, solid::Kinematics::finite)};
    options.contact = contact::ContactOptions{};
    options.acceleration.assign(2, -0.05 * Vector<Dim>::Unit(1));
    options.obstacles = {contact::plane_obstacle<Dim>(-Vector<Dim>::Unit(1), Vector<Dim>::Unit(1), 5.0)};
    const auto report = check_same_bits<Dim>(all, mesh, options, towards_each_other<Dim>(0.1), Dim == 2 ? 120 : 44,
                                             parts(all, mesh), {.waves = 0.01, .spin = 0.05});
    CHECK(report.events > 0);
    CHECK(report.rebuilds > 1);
}

TEMPLATE_TEST_CASE_SIG("damped metal bodies that flow as they strike each other have the bits of one rank, memory included",
                       "[ranks][solid][contact]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<Dim>();
    solid::SolidOptions<Dim> options;
    const solid::Material metal{.young = 1.0,
                                .poisson = 0.3,
                                .density = 1.0,
                                .law = solid::MaterialLaw::j2,
                                .flow = {.yield_stress = 5e-3, .hardening = 0.05}};
    options.materials = {metal, metal};
    options.materials[0].flow.kinematic_hardening = 0.02;
    options.materials[1].flow.jump_cap = 0.2;
    options.materials[0].damping.stiffness = 0.01;
    options.materials[1].damping.mass = 0.1;
    options.materials[1].damping.linear_viscosity = 0.1;
    options.kinematics = {GENERATE(solid::Kinematics::small, solid::Kinematics::floating), solid::Kinematics::finite};
    if (options.kinematics[0] == solid::Kinematics::floating) options.materials[1].flow.kinematic_hardening = 0.02;
    options.contact = contact::ContactOptions{};
    const auto report = check_same_bits<Dim>(all, mesh, options, towards_each_other<Dim>(0.1), Dim == 2 ? 96 : 36,
                                             parts(all, mesh), {.waves = 0.01, .spin = 0.05});
    CHECK(report.events > 0);
}

TEMPLATE_TEST_CASE_SIG("orthotropic bodies that strike each other have the bits of one rank", "[ranks][solid][contact]",
                       ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<Dim>();
    solid::SolidOptions<Dim> options;
    solid::Material ply{.young = 4.0, .poisson = 0.3, .density = 1.0, .law = solid::MaterialLaw::orthotropic};
    ply.orthotropic.young_2 = ply.orthotropic.young_3 = 1.0;
    ply.orthotropic.poisson_13 = ply.orthotropic.poisson_23 = 0.3;
    ply.orthotropic.shear_12 = ply.orthotropic.shear_13 = 0.5;
    ply.orthotropic.shear_23 = 0.4;
    if constexpr (Dim == 2)
        ply.orthotropic.axis_angle = 0.5;
    else
        ply.orthotropic.axis_1 = {1.0, 1.0, 0.0}, ply.orthotropic.axis_2 = {1.0, -1.0, 0.0};
    options.materials = {ply, steel};
    options.materials[0].damping.stiffness = 0.01;
    options.kinematics = {GENERATE(solid::Kinematics::small, solid::Kinematics::floating), solid::Kinematics::finite};
    options.contact = contact::ContactOptions{};
    const auto report = check_same_bits<Dim>(all, mesh, options, towards_each_other<Dim>(0.1), Dim == 2 ? 96 : 36,
                                             parts(all, mesh), {.waves = 0.01, .spin = 0.05});
    CHECK(report.events > 0);
}

TEST_CASE("a bar that bends far, and one that turns without contact, have the bits of one rank", "[ranks][solid]") {
    const ranks::Communicator all = test::world();
    const auto mesh = bar<2>(mesh::CellShape::triangle);
    solid::SolidOptions<2> options;
    options.materials = {steel};
    options.kinematics = {GENERATE(solid::Kinematics::floating, solid::Kinematics::finite)};
    const std::vector<Vector<2>> velocity{Vector<2>::Zero()};
    check_same_bits<2>(all, mesh, options, velocity, 100, parts(all, mesh), {.waves = 0.1, .spin = 0.2});
    check_same_bits<2, dynamics::Leapfrog>(all, mesh, options, velocity, 40, parts(all, mesh), {.waves = 0.1, .spin = 0.2});
}

TEMPLATE_TEST_CASE_SIG("the filter of bodies in contact with each other, a wall and a support has the bits of one rank",
                       "[ranks][solid][contact][filter]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    solid::SolidOptions<Dim> options;
    options.materials = {steel, {.young = 1.0, .poisson = 0.2, .density = 1.0}};
    options.contact = contact::ContactOptions{};
    options.law = GENERATE(solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential);
    options.obstacles = {contact::plane_obstacle<Dim>(-0.26 * Vector<Dim>::Unit(1), Vector<Dim>::Unit(1), 5.0)};
    options.boundary.dirichlet = {{.group = "xmin"}};
    // A block held on its left, and one that falls on its top and its right-hand neighbour: a wall.
    std::vector<mesh::Mesh<Dim>> blocks;
    for (int i = 0; i < 2; ++i) {
        Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Constant(0.5);
        lower[1] = i == 0 ? -0.25 : 0.255, upper[1] = lower[1] + 0.5;
        lower[0] = 0.07 * i, upper[0] = lower[0] + 1.0;
        std::array<int, Dim> n;
        n.fill(Dim == 2 ? 12 : 5);
        blocks.push_back(
            mesh::structured_box<Dim>(lower, upper, n, Dim == 2 ? mesh::CellShape::triangle : mesh::CellShape::tetrahedron));
        if (i == 1) blocks.back().groups.clear();
    }
    const auto mesh = mesh::combine<Dim>(blocks);
    const std::vector<Vector<Dim>> velocity{-0.05 * Vector<Dim>::Unit(1), -0.1 * Vector<Dim>::Unit(1)};
    const auto report = check_same_bits<Dim>(all, mesh, options, velocity, Dim == 2 ? 150 : 80, parts(all, mesh),
                                             {.waves = 0.01}, {.filter = true});
    CHECK(report.active_pairs_max > 0);
}

TEMPLATE_TEST_CASE_SIG("neutral restarts have the bits of one rank, with the filter and without", "[ranks][solid][restart]",
                       ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<Dim>();
    solid::SolidOptions<Dim> options;
    options.materials = {steel, {.young = 1.0, .poisson = 0.2, .density = 1.0}};
    const auto kinematics = GENERATE(solid::Kinematics::small, solid::Kinematics::floating);
    options.kinematics = {kinematics, kinematics};
    options.contact = contact::ContactOptions{};
    const auto report = check_same_bits<Dim>(all, mesh, options, towards_each_other<Dim>(0.1), Dim == 2 ? 80 : 44,
                                             parts(all, mesh), {.waves = 0.05, .spin = 0.02},
                                             {.filter = kinematics == solid::Kinematics::floating, .restart = 7});
    CHECK(report.active_pairs_max > 0);
}

TEST_CASE("central differences have the bits of one rank", "[ranks][solid][contact]") {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<2>();
    solid::SolidOptions<2> options;
    options.materials = {steel, steel};
    options.contact = contact::ContactOptions{};
    check_same_bits<2, dynamics::Leapfrog>(all, mesh, options, towards_each_other<2>(0.1), 80, parts(all, mesh));
}

TEST_CASE("a rank without cells, and parts without any order, change no bit", "[ranks][solid][contact]") {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<2>();
    solid::SolidOptions<2> options;
    options.materials = {steel, steel};
    options.materials[1].law = solid::MaterialLaw::j2;
    options.materials[1].flow.yield_stress = 5e-3;
    options.materials[1].damping.stiffness = 0.01;
    options.contact = contact::ContactOptions{};
    std::vector<int> owner(static_cast<std::size_t>(mesh.n_cells()), 0);  // all on rank 0
    SECTION("all but one rank have none") {}
    SECTION("a body each") {
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            owner[static_cast<std::size_t>(c)] = mesh.cell_body[c] % all.size();
    }
    SECTION("scattered in rows") {
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) owner[static_cast<std::size_t>(c)] = c / 37 % all.size();
    }
    check_same_bits<2>(all, mesh, options, towards_each_other<2>(0.1), 50, owner);
}

TEST_CASE("too few layers of copies are refused on all ranks", "[ranks][solid]") {
    const ranks::Communicator all = test::world();
    const auto mesh = bar<2>(mesh::CellShape::triangle);
    solid::SolidOptions<2> options;
    options.materials = {steel};
    const std::vector<int> owner = parts(all, mesh);
    if (all.size() == 1)
        CHECK_NOTHROW(test::SharedSolid<2>(all, mesh::part_of<2>(mesh, owner, all.rank(), 1), options));
    else
        CHECK_THROWS_WITH(test::SharedSolid<2>(all, mesh::part_of<2>(mesh, owner, all.rank(), 2), options),
                          Catch::Contains("more layers of copies"));
}

TEST_CASE("what one rank finds wrong is thrown on all, and nobody waits", "[ranks][solid]") {
    const ranks::Communicator all = test::world();
    const auto mesh = bar<2>(mesh::CellShape::triangle);
    solid::SolidOptions<2> options;
    options.materials = {steel};
    options.body_load = [](const Vector<2>& x) -> Vector<2> {  // at one end alone
        return x[0] < 0.05 ? Vector<2>(std::nan(""), 0.0) : Vector<2>(0.0, 0.0);
    };
    const std::vector<int> owner = parts(all, mesh);
    CHECK_THROWS_AS(test::SharedSolid<2>(all, mesh, options, owner), BadInput);

    options.body_load = nullptr;
    options.boundary.traction = {{.group = "xmin", .history = [](double t, const Vector<2>&) -> Vector<2> {
                                      return {t < 0.02 ? 0.0 : std::nan(""), 0.0};
                                  }}};
    test::SharedSolid<2> shared(all, mesh, options, owner);
    dynamics::Memm run(shared.solid, std::vector<double>(shared.solid.size(), 0.0),
                       std::vector<double>(shared.solid.size(), 0.0), 0.01);
    const auto make_steps = [&] {
        for (int step = 0; step < 5; ++step) run.step();
    };
    CHECK_THROWS_AS(make_steps(), BadInput);
}

TEMPLATE_TEST_CASE_SIG("warm bodies that collide, turn and yield have the bits of one rank, and the same work of heat",
                       "[ranks][solid][temperature]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<Dim>();
    const auto [kinematics, yields] = GENERATE(table<solid::Kinematics, bool>(
        {{solid::Kinematics::small, true}, {solid::Kinematics::floating, false}, {solid::Kinematics::finite, true}}));
    CAPTURE(yields, static_cast<int>(kinematics));
    solid::SolidOptions<Dim> options;
    options.materials.assign(2, steel);
    for (solid::Material& material : options.materials) {
        material.expansion.along_1 = kinematics == solid::Kinematics::finite ? 1e-3 : 1e-4;
        if (!yields) continue;
        material.law = solid::MaterialLaw::j2;
        material.flow.yield_stress = 1e-3;
        material.flow.hardening = 0.1;
    }
    options.kinematics.assign(2, kinematics);
    options.contact = contact::ContactOptions{};
    options.law = solid::ContactLaw::pair_potential;
    for (const double amplitude : {60.0, -40.0})
        options.temperature_rise.push_back(
            {.value = [amplitude](double t, const Vector<Dim>& x) { return amplitude * (std::sin(2.0 * t) + 0.3 * x[1]); },
             .varies = true});
    const int steps = kinematics == solid::Kinematics::finite ? 28 : 16;  // whose stable step is shorter
    const auto report =
        check_same_bits<Dim>(all, mesh, options, towards_each_other<Dim>(Dim == 2 ? 0.1 : 0.3), steps, parts(all, mesh),
                             {.spin = kinematics == solid::Kinematics::small ? 0.0 : 0.05});
    CHECK(report.active_pairs_max > 0);
}

TEST_CASE("a temperature that strains too much in a cell of one rank is refused on all of them, by its cell",
          "[ranks][solid][temperature][errors]") {
    const ranks::Communicator all = test::world();
    const auto mesh = bar<2>(mesh::CellShape::triangle);
    solid::SolidOptions<2> options;
    options.materials = {steel};
    options.materials[0].expansion.along_1 = 1e-3;
    options.temperature_rise = {{.value = [](double, const Vector<2>& x) { return x[0] > 3.95 ? 200.0 : 1.0; }}};
    CHECK_THROWS_WITH(test::SharedSolid<2>(all, mesh, options, parts(all, mesh)),
                      Catch::Contains("K warmer") && Catch::Contains("a thermal strain of 0.2"));
}

TEMPLATE_TEST_CASE_SIG("a solid at dictated times has the bits of one rank, also where a step is taken again",
                       "[ranks][solid][contact][clock]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<Dim>();
    solid::SolidOptions<Dim> options;
    options.materials = {steel, {.young = 1.0, .poisson = 0.2, .density = 1.0}};
    options.kinematics.assign(2, GENERATE(solid::Kinematics::small, solid::Kinematics::floating, solid::Kinematics::finite,
                                          solid::Kinematics::rigid));
    options.contact = contact::ContactOptions{};
    options.friction.coefficient = 0.2;
    const std::vector<Vector<Dim>> velocity = towards_each_other<Dim>(0.04);
    std::optional<test::ClockedPart<Dim>> alone;
    on_first(all, [&] { alone.emplace(mesh, options, velocity); });
    test::ClockedPart<Dim> shared(all, mesh, options, parts(all, mesh), velocity);
    const double dt = shared.run.memm().dt();
    const auto clock_alone = [&] {
        std::vector<double> values{alone->run.memm().dt(), alone->clock.time(), alone->clock.time_to_node()};
        const auto q = alone->clock.q();
        values.insert(values.end(), q.begin(), q.end());
        return values;
    };
    const auto check = [&] {
        const std::vector<double> of_one = of_first<std::vector<double>>(all, clock_alone);
        REQUIRE(dt == of_one[0]);
        REQUIRE(shared.clock.time() == of_one[1]);
        REQUIRE(shared.clock.time_to_node() == of_one[2]);
        REQUIRE(everywhere(all, test::same_bits(shared.own(std::span(of_one).subspan(3)), shared.clock.q())));
    };
    const auto advance = [dt](test::ClockedPart<Dim>& one, int i) {
        if (i % 10 == 5) {
            const auto before = one.clock.state();
            one.clock.advance(1.9 * dt);
            one.clock.restore(before);
        }
        one.clock.advance((0.1 + 0.37 * (i % 7)) * dt);
    };
    for (int i = 0; i < 100; ++i) {
        on_first(all, [&] { advance(*alone, i); });
        advance(shared, i);
        check();
    }
    CHECK(shared.run.solid().contact().report().active_pairs_max > 0);
    const std::vector<std::byte> state = shared.run.solid().state();
    CHECK(state == of_first<std::vector<std::byte>>(all, [&] { return alone->run.solid().state(); }));
    if (all.size() == 1) return;
    CHECK_THROWS_WITH(shared.clock.advance((1.0 + all.rank()) * dt), Catch::Contains("Give the same on all of them"));
    check();
}

TEST_CASE("what is not made for ranks yet is refused by name", "[ranks][solid]") {
    const ranks::Communicator all = test::world();
    const auto mesh = bar<2>(mesh::CellShape::triangle);
    const std::vector<int> owner = parts(all, mesh);
    solid::SolidOptions<2> options;
    options.materials = {steel};
    options.precision = solid::Precision::single_precision;
    CHECK_THROWS_WITH(test::SharedSolid<2>(all, mesh, options, owner), Catch::Contains("single precision"));
}
