// Rigid bodies, and what is held by single points.
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "ranks/beside_one.hpp"
#include "ranks/shared_solid.hpp"
#include "ranks/solid_scenes.hpp"

using namespace abut;
using namespace abut::test;

TEMPLATE_TEST_CASE_SIG("rigid bodies that strike each other, others and a wall have the bits of one rank",
                       "[ranks][solid][contact][rigid]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<Dim>();
    solid::SolidOptions<Dim> options;
    options.materials = {steel, {.young = 1.0, .poisson = 0.2, .density = 1.0}};
    const auto other =
        GENERATE(solid::Kinematics::floating, solid::Kinematics::small, solid::Kinematics::finite, solid::Kinematics::rigid);
    options.kinematics = {other, solid::Kinematics::rigid};
    if (GENERATE(false, true)) std::swap(options.kinematics[0], options.kinematics[1]);
    options.contact = contact::ContactOptions{};
    options.acceleration.assign(2, -0.05 * Vector<Dim>::Unit(1));
    options.obstacles = {contact::plane_obstacle<Dim>(-Vector<Dim>::Unit(1), Vector<Dim>::Unit(1), 5.0)};
    const auto report = check_same_bits<Dim>(all, mesh, options, towards_each_other<Dim>(0.04), Dim == 2 ? 120 : 60,
                                             parts(all, mesh), {.waves = 0.01, .spin = 0.05});
    CHECK(report.events > 0);
}

TEST_CASE("rigid bodies of any owner, with the filter and restarts, have the bits of one rank",
          "[ranks][solid][contact][rigid]") {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<2>();
    solid::SolidOptions<2> options;
    options.materials = {steel, steel};
    options.kinematics = {solid::Kinematics::rigid, solid::Kinematics::floating};
    options.contact = contact::ContactOptions{};
    std::vector<int> owner(static_cast<std::size_t>(mesh.n_cells()), 0);
    SECTION("all on the first") {}
    SECTION("the rigid one on the last, the other on the first") {
        for (std::size_t c = 0; c < owner.size(); ++c) owner[c] = mesh.cell_body[c] == 0 ? all.size() - 1 : 0;
    }
    SECTION("its cells on all of them") {
        for (std::size_t c = 0; c < owner.size(); ++c) owner[c] = static_cast<int>(1 + c / 37) % all.size();
    }
    const auto report = check_same_bits<2>(all, mesh, options, towards_each_other<2>(0.04), 120, owner,
                                           {.waves = 0.05, .spin = 0.02}, {.filter = true, .restart = 7});
    CHECK(report.events > 0);
}

TEMPLATE_TEST_CASE_SIG("springs, dashpots and moments have the bits of one rank", "[ranks][solid][attachments]",
                       ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = two_round_bodies<Dim>();
    solid::SolidOptions<Dim> options;
    options.materials = {steel, {.young = 1.0, .poisson = 0.2, .density = 1.0}};
    options.kinematics = {GENERATE(solid::Kinematics::small, solid::Kinematics::floating, solid::Kinematics::finite),
                          GENERATE(solid::Kinematics::floating, solid::Kinematics::rigid)};
    const Vector<Dim> x = Vector<Dim>::Unit(0), y = Vector<Dim>::Unit(1);
    options.springs = {{.first = {.body = 0, .position = -0.3 * x, .radius = 0.4},
                        .second = {.body = 1, .position = 0.3 * x + 0.5 * y},
                        .stiffness = 0.02,
                        .damping = 0.01},
                       {.first = {.body = 1, .position = x + 0.5 * y, .radius = 0.2},
                        .second = {.position = 3.0 * x},
                        .stiffness = 0.03,
                        .length = 1.0}};
    options.moments = {{.body = 0, .moment = AxialVector<Dim>::Constant(0.01), .damping = 0.02},
                       {.body = 1, .moment = AxialVector<Dim>::Constant(-0.02)}};
    check_same_bits<Dim>(all, mesh, options, towards_each_other<Dim>(0.05), 30, parts(all, mesh),
                         {.waves = 0.01, .spin = 0.05});
    check_same_bits<Dim, dynamics::Leapfrog>(all, mesh, options, towards_each_other<Dim>(0.05), 10, parts(all, mesh),
                                             {.waves = 0.01, .spin = 0.05});
}

TEMPLATE_TEST_CASE_SIG("tractions on bodies that turn have the bits of one rank, also where a rank has no face of theirs",
                       "[ranks][solid][attachments]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = bar<Dim>(Dim == 2 ? mesh::CellShape::triangle : mesh::CellShape::tetrahedron);
    solid::SolidOptions<Dim> options;
    options.materials = {steel};
    options.kinematics = {GENERATE(solid::Kinematics::floating, solid::Kinematics::finite, solid::Kinematics::rigid)};
    const bool follows = options.kinematics[0] != solid::Kinematics::finite;
    options.boundary.traction = {{.group = "xmax", .value = 0.01 * Vector<Dim>::Unit(1), .follows = follows},
                                 {.group = "ymin", .history = [](double t, const Vector<Dim>& x) -> Vector<Dim> {
                                      return 0.005 * std::sin(3.0 * t + x[0]) * Vector<Dim>::Unit(1);
                                  }}};
    const std::vector<Vector<Dim>> velocity{Vector<Dim>::Zero()};
    check_same_bits<Dim>(all, mesh, options, velocity, 40, parts(all, mesh), {.waves = 0.01, .spin = 0.05});
}

TEST_CASE("a moment on a body of several blocks of cells has the bits of one rank", "[ranks][solid][attachments]") {
    const ranks::Communicator all = test::world();
    const auto mesh = bar<3>(mesh::CellShape::tetrahedron);
    REQUIRE(mesh.n_cells() > 3 * parallel_grain);
    solid::SolidOptions<3> options;
    options.materials = {steel};
    options.kinematics = {solid::Kinematics::floating};
    options.moments = {{.body = 0, .moment = Vector<3>(0.01, 0.02, -0.01), .damping = 0.1}};
    const std::vector<Vector<3>> velocity{Vector<3>::Zero()};
    check_same_bits<3>(all, mesh, options, velocity, 20, parts(all, mesh), {.waves = 0.01, .spin = 0.05});
}

TEST_CASE("a traction on a floating and a rigid body, on faces in any order, has the bits of one rank",
          "[ranks][solid][attachments][rigid]") {
    const ranks::Communicator all = test::world();
    const std::array boxes{mesh::structured_box<2>({0.0, 0.0}, {2.0, 1.0}, {16, 8}, mesh::CellShape::triangle),
                           mesh::structured_box<2>({3.0, 0.0}, {5.0, 1.0}, {16, 8}, mesh::CellShape::triangle)};
    auto mesh = mesh::combine<2>(boxes);
    mesh.groups.push_back({"all", {mesh.boundary_faces.rbegin(), mesh.boundary_faces.rend()}});
    solid::SolidOptions<2> options;
    options.materials = {steel, steel};
    options.kinematics = {solid::Kinematics::floating, solid::Kinematics::rigid};
    if (GENERATE(false, true)) std::swap(options.kinematics[0], options.kinematics[1]);
    options.boundary.traction = {{.group = "all", .value = Vector<2>(0.002, 0.01), .follows = true}};
    const std::vector<Vector<2>> velocity(2, Vector<2>::Zero());
    check_same_bits<2>(all, mesh, options, velocity, 40, parts(all, mesh), {.waves = 0.01, .spin = 0.05});
}

TEST_CASE("a traction on bodies of both kinds is refused on all ranks", "[ranks][solid][attachments]") {
    const ranks::Communicator all = test::world();
    const std::array boxes{mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {4, 4}, mesh::CellShape::quadrangle),
                           mesh::structured_box<2>({2.0, 0.0}, {3.0, 1.0}, {4, 4}, mesh::CellShape::quadrangle)};
    auto mesh = mesh::combine<2>(boxes);
    mesh.groups.push_back({"both", mesh.boundary_faces});
    solid::SolidOptions<2> options;
    options.materials = {steel, steel};
    options.kinematics = {solid::Kinematics::small, solid::Kinematics::floating};
    options.boundary.traction = {{.group = "both", .value = Vector<2>(0.0, 0.1)}};
    std::vector<int> owner;  // a body each: none sees the other
    for (const std::int32_t body : mesh.cell_body) owner.push_back(body % all.size());
    CHECK_THROWS_WITH(test::SharedSolid<2>(all, mesh, options, owner), Catch::Contains("Give each kind a group of its own"));
}

TEST_CASE("parts without the whole of a rigid body, or with its points on two ranks, are refused on all ranks",
          "[ranks][solid][rigid]") {
    const ranks::Communicator all = test::world();
    if (all.size() == 1) return;
    const auto mesh = bar<2>(mesh::CellShape::triangle);
    solid::SolidOptions<2> options;
    options.materials = {steel};
    options.kinematics = {solid::Kinematics::rigid};
    const std::vector<int> owner = parts(all, mesh);
    const auto whole = solid::part_of<2>(mesh, owner, all.rank(), options.kinematics);
    const auto cut = mesh::part_of<2>(mesh, owner, all.rank());
    solid::PartPoints its = solid::points_of<2>(whole, options.kinematics);
    const ranks::PointRanks points(all, ranks::shared_points(all, 2, its.n_points, its.number, its.owner));
    CHECK_THROWS_WITH(solid::Solid<2>(cut.mesh, options, points), Catch::Contains("whole of it"));
    its.owner.back() = (its.owner.back() + 1) % all.size();
    const ranks::PointRanks split(all, ranks::shared_points(all, 2, its.n_points, its.number, its.owner));
    CHECK_THROWS_WITH(solid::Solid<2>(whole.mesh, options, split), Catch::Contains("are on several ranks"));
}
