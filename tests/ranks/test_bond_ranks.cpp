// Bonds on several ranks.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "abut/mesh/grains.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/split_body.hpp"
#include "ranks/beside_one.hpp"
#include "ranks/shared_solid.hpp"
#include "ranks/solid_scenes.hpp"

using namespace abut;
using namespace abut::test;

namespace {

/// Two bars behind each other along x whose meshes do not match.
template <int Dim>
mesh::Mesh<Dim> two_bars(mesh::CellShape shape) {
    Vector<Dim> lower = Vector<Dim>::Zero(), middle = Vector<Dim>::Constant(0.5), upper = middle;
    lower[0] = -1.5, middle[0] = 0.0, upper[0] = 1.5;
    Vector<Dim> begin = lower;
    begin[0] = 0.0;
    std::array<int, Dim> left, right;
    left.fill(Dim == 2 ? 6 : 2);
    right.fill(Dim == 2 ? 8 : 3);
    left[0] = Dim == 2 ? 18 : 10;
    right[0] = Dim == 2 ? 24 : 12;
    return mesh::combine<Dim>(std::vector{mesh::structured_box<Dim>(lower, middle, left, shape, "left"),
                                          mesh::structured_box<Dim>(begin, upper, right, shape, "right")});
}

template <int Dim>
solid::SolidOptions<Dim> bonded(solid::Kinematics left, solid::Kinematics right) {
    solid::SolidOptions<Dim> options;
    options.materials = {steel, {.young = 1.0, .poisson = 0.2, .density = 1.0}};
    options.kinematics = {left, right};
    options.bonds = {{.sides = {0, 1}}};
    return options;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("bodies that are bonded, and turn, have the bits of one rank", "[ranks][solid][bonds]",
                       ((int Dim), Dim), 2, 3) {
    using enum solid::Kinematics;
    const ranks::Communicator all = test::world();
    const auto shape = Dim == 2 ? GENERATE(mesh::CellShape::triangle, mesh::CellShape::quadrangle)
                                : GENERATE(mesh::CellShape::tetrahedron, mesh::CellShape::hexahedron);
    const auto [left, right] = GENERATE(std::array{small, small}, std::array{floating, finite}, std::array{small, floating});
    CAPTURE(Dim, static_cast<int>(shape), static_cast<int>(left), static_cast<int>(right));
    const auto mesh = two_bars<Dim>(shape);
    auto options = bonded<Dim>(left, right);
    const std::vector<Vector<Dim>> velocity(2, Vector<Dim>::Unit(0));
    check_same_bits<Dim>(all, mesh, options, velocity, 10, parts(all, mesh),
                         {.waves = 0.05, .spin = left == small ? 0.0 : 0.1});
}

TEMPLATE_TEST_CASE_SIG("a support that shakes bonded bodies does the same work on several ranks, to the bit",
                       "[ranks][solid][bonds]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto mesh = two_bars<Dim>(Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron);
    auto options = bonded<Dim>(solid::Kinematics::small, solid::Kinematics::small);
    // Its faces are beside bonded ones, which answer to them.
    options.boundary.dirichlet = {{.group = "left.ymin", .history = [](double t, const Vector<Dim>&) -> Vector<Dim> {
                                       return 0.01 * std::sin(5.0 * t) * Vector<Dim>::Unit(0);
                                   }}};
    const std::vector<Vector<Dim>> velocity(2, Vector<Dim>::Zero());
    check_same_bits<Dim>(all, mesh, options, velocity, 20, parts(all, mesh), {.waves = 0.05});
}

TEST_CASE("bonds that open and break, and let bodies touch, have the bits of one rank", "[ranks][solid][bonds][contact]") {
    using enum solid::Kinematics;
    const ranks::Communicator all = test::world();
    const auto kinematics = GENERATE(small, floating);
    const double energy = GENERATE(0.0, 2e-4);
    CAPTURE(static_cast<int>(kinematics), energy);
    const auto mesh = two_bars<2>(mesh::CellShape::triangle);
    auto options = bonded<2>(kinematics, kinematics);
    options.bonds.front().strength = 0.02;
    options.bonds.front().weibull_modulus = 9.0;  // ranks draw the same
    options.bonds.front().fracture_energy = energy;
    options.contact = contact::ContactOptions{};
    options.acceleration = {Vector<2>::Zero(), -0.02 * Vector<2>::Unit(0)};  // brings the right one back
    const std::vector<Vector<2>> velocity{-0.03 * Vector<2>::Unit(0), 0.03 * Vector<2>::Unit(0)};
    const auto report = check_same_bits<2>(all, mesh, options, velocity, 400, parts(all, mesh), {.waves = 0.002});
    CHECK(report.active_pairs_max > 0);  // which it is only where a bond is broken
}

TEMPLATE_TEST_CASE_SIG("bonds that are sheared under pressure have the bits of one rank", "[ranks][solid][bonds][contact]",
                       ((int Dim), Dim), 2, 3) {
    using enum solid::Kinematics;
    const ranks::Communicator all = test::world();
    const auto kinematics = GENERATE(small, floating);
    CAPTURE(Dim, static_cast<int>(kinematics));
    const auto mesh = two_bars<Dim>(Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron);
    auto options = bonded<Dim>(kinematics, kinematics);
    options.bonds.front().strength = 0.002;
    options.bonds.front().fracture_energy = 1e-5;
    options.contact = contact::ContactOptions{};
    const Vector<Dim> of_left = 0.03 * Vector<Dim>::Unit(0) + 0.04 * Vector<Dim>::Unit(1);
    const std::vector<Vector<Dim>> velocity{of_left, -of_left};
    check_same_bits<Dim>(all, mesh, options, velocity, Dim == 2 ? 60 : 30, parts(all, mesh), {.waves = 0.002});
}

TEMPLATE_TEST_CASE_SIG("a body that breaks into fragments has the bits of one rank", "[ranks][solid][bonds][fracture]",
                       ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    std::array<int, Dim> counts;
    counts.fill(Dim == 2 ? 12 : 4);
    counts[0] *= 2;
    Vector<Dim> upper = Vector<Dim>::Ones();
    upper[0] = 2.0;
    const auto whole = mesh::structured_box<Dim>(Vector<Dim>::Zero(), upper, counts,
                                                 Dim == 2 ? mesh::CellShape::triangle : mesh::CellShape::hexahedron);
    const auto grains = mesh::grains_of<Dim>(whole, {.size = Dim == 2 ? 0.5 : 0.8});
    std::vector<std::string> names;
    for (std::int32_t i = 0; i <= *std::ranges::max_element(grains); ++i) names.push_back(std::to_string(i));
    const auto mesh = mesh::split_body<Dim>(whole, grains, names);
    solid::SolidOptions<Dim> options;
    options.materials.assign(names.size(), {.young = 1.0, .poisson = 0.25, .density = 1.0});
    options.kinematics.assign(names.size(), solid::Kinematics::floating);
    for (const auto& sides : mesh.report.joined_bodies)
        options.bonds.push_back({.sides = sides, .strength = 0.02, .weibull_modulus = 9.0, .of_grains = true});
    options.contact = contact::ContactOptions{};
    std::vector<Vector<Dim>> velocity;
    for (std::size_t body = 0; body < names.size(); ++body)
        velocity.push_back((body % 2 == 0 ? 0.05 : -0.05) * Vector<Dim>::Unit(0));
    const auto report = check_same_bits<Dim>(all, mesh, options, velocity, Dim == 2 ? 60 : 40, parts(all, mesh),
                                             {.waves = 0.002, .spin = 0.1});
    CHECK(report.active_pairs_max > 0);  // which it is only where a bond is broken
}

TEST_CASE("a round body in grains has the bits of one rank, also where a bonded face rests on a cell that no force needs",
          "[ranks][solid][bonds][fracture]") {
    const ranks::Communicator all = test::world();
    const auto whole = mesh::disc({.radius = 0.5, .size = 0.05});  // on two ranks there is such a face
    const auto grains = mesh::grains_of<2>(whole, {.size = 0.2});
    std::vector<std::string> names;
    for (std::int32_t i = 0; i <= *std::ranges::max_element(grains); ++i) names.push_back(std::to_string(i));
    const auto mesh = mesh::split_body<2>(whole, grains, names);
    solid::SolidOptions<2> options;
    options.materials.assign(names.size(), {.young = 1.0, .poisson = 0.25, .density = 1.0});
    options.kinematics.assign(names.size(), solid::Kinematics::floating);
    for (const auto& sides : mesh.report.joined_bodies)
        options.bonds.push_back({.sides = sides, .strength = 0.01, .of_grains = true});
    const std::vector<Vector<2>> velocity(names.size(), Vector<2>::Zero());
    check_same_bits<2>(all, mesh, options, velocity, 20, parts(all, mesh), {.waves = 0.002, .spin = 0.1});
}

TEMPLATE_TEST_CASE_SIG("several materials in one body have the bits of one rank, with the filter and neutral restarts",
                       "[ranks][solid][bonds][pieces]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto kinematics = GENERATE(solid::Kinematics::small, solid::Kinematics::floating);
    const auto whole = bar<Dim>(Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron);
    std::vector<std::int32_t> part_of;
    for (const Vector<Dim>& x : whole.cell_centroid) part_of.push_back(x[1] < (Dim == 2 ? 0.2 : 0.14) && x[0] > 0.7 ? 0 : 1);
    const auto mesh = mesh::split_body<Dim>(whole, part_of, {"core", "rest"});
    solid::SolidOptions<Dim> options = bonded<Dim>(kinematics, kinematics);
    options.bonds.clear();
    for (const auto& pair : mesh.report.joined_bodies) options.bonds.push_back({.sides = pair});
    options.contact = contact::ContactOptions{};
    options.obstacles = {contact::plane_obstacle<Dim>(-0.005 * Vector<Dim>::Unit(1), Vector<Dim>::Unit(1), 9.0)};
    const std::vector<Vector<Dim>> velocity(2, -0.05 * Vector<Dim>::Unit(1));
    const auto report = check_same_bits<Dim>(all, mesh, options, velocity, 40, parts(all, mesh), {.waves = 0.01},
                                             {.filter = true, .restart = 7});
    CHECK(report.active_pairs_max > 0);
}

TEST_CASE("a bonded face that is held is refused on all ranks by its cell", "[ranks][solid][bonds]") {
    const ranks::Communicator all = test::world();
    const auto mesh = two_bars<2>(mesh::CellShape::triangle);
    auto options = bonded<2>(solid::Kinematics::small, solid::Kinematics::small);
    options.boundary.dirichlet = {{.group = "left.xmax"}};
    CHECK_THROWS_WITH(SharedSolid<2>(all, mesh, options, parts(all, mesh)), Catch::Contains("is held by a support"));
    options.boundary.dirichlet.clear();
    options.bonds.front().sides = {0, 0};
    CHECK_THROWS_WITH(SharedSolid<2>(all, mesh, options, parts(all, mesh)), Catch::Contains("both sides of a bond"));
}

TEMPLATE_TEST_CASE_SIG("bodies that overlap on purpose come to push each other with the bits of one rank",
                       "[ranks][solid][contact][interference]", ((int Dim), Dim), 2, 3) {
    const ranks::Communicator all = test::world();
    const auto kinematics = GENERATE(solid::Kinematics::small, solid::Kinematics::floating);
    Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Constant(0.5);
    std::vector<mesh::Mesh<Dim>> blocks;
    for (int i = 0; i < 2; ++i) {
        lower[0] = i == 0 ? -1.0 : -0.01, upper[0] = i == 0 ? 0.0 : 0.99;
        std::array<int, Dim> n;
        n.fill(Dim == 2 ? 5 + i : 2 + i);
        n[0] *= 2;
        blocks.push_back(mesh::structured_box<Dim>(lower, upper, n,
                                                   Dim == 2 ? mesh::CellShape::triangle : mesh::CellShape::tetrahedron,
                                                   i == 0 ? "left" : "right"));
    }
    const auto mesh = mesh::combine<Dim>(blocks);
    auto options = bonded<Dim>(kinematics, kinematics);
    options.bonds.clear();
    options.contact = contact::ContactOptions{};
    options.interference = {{.bodies = {0, 1}, .time = 0.5}};
    const std::vector<Vector<Dim>> velocity(2, Vector<Dim>::Zero());
    const auto report = check_same_bits<Dim>(all, mesh, options, velocity, Dim == 2 ? 40 : 20, parts(all, mesh));
    CHECK(report.active_pairs_max > 0);
    CHECK(report.missed_contacts == 0);
}

TEST_CASE("bonded metal that yields has the bits of one rank, and bonds of the modified reconstruction are for one",
          "[ranks][solid][bonds]") {
    const ranks::Communicator all = test::world();
    const auto mesh = two_bars<2>(mesh::CellShape::triangle);
    auto options = bonded<2>(solid::Kinematics::floating, solid::Kinematics::finite);
    for (solid::Material& material : options.materials) {
        material.law = solid::MaterialLaw::j2;
        material.flow.yield_stress = 2e-3;
        material.flow.hardening = 0.05;
    }
    const std::vector<Vector<2>> velocity{-0.02 * Vector<2>::Unit(0), 0.02 * Vector<2>::Unit(0)};
    check_same_bits<2>(all, mesh, options, velocity, 40, parts(all, mesh));
    options = bonded<2>(solid::Kinematics::small, solid::Kinematics::small);
    options.contact = contact::ContactOptions{};
    options.law = solid::ContactLaw::reconstruction;
    if (all.size() > 1)
        CHECK_THROWS_WITH(SharedSolid<2>(all, mesh, options, parts(all, mesh)),
                          Catch::Contains("bonded under the modified reconstruction"));
}
