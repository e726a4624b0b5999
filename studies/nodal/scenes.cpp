#include "studies/nodal/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/base/rotation.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "studies/nodal/shapes.hpp"
#include "studies/scenes/two_cylinders.hpp"

namespace abut::studies::nodal {
namespace {

/// Nodes of one body at which something is so.
template <int Dim, class IsIn>
std::vector<std::int32_t> nodes_where(const mesh::Mesh<Dim>& mesh, std::int32_t body, const IsIn& is_in) {
    std::vector<char> wanted(mesh.vertices.size(), 0);
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell)
        for (const std::int32_t node : mesh.cell_vertices[cell])
            if (mesh.cell_body[cell] == body && is_in(mesh.vertices[node])) wanted[node] = 1;
    std::vector<std::int32_t> nodes;
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(wanted.size()); ++node)
        if (wanted[node] != 0) nodes.push_back(node);
    return nodes;
}

/// Two round bodies of radius 1, 0.8 aside and 0.02 apart.
template <int Dim>
Case<Dim> two_round_bodies(const std::string& name, Kinematics strain, double size) {
    const TwoCylinders bodies{.size = size};
    auto one = case_of<Dim>(name, {two_cylinders<Dim>(bodies).mesh}, strain);
    for (std::size_t body = 0; body < 2; ++body) {
        one.motion[body].velocity[0] = body == 0 ? bodies.speed : -bodies.speed;
        one.motion[body].centre = Vector<Dim>::Zero();
        std::ranges::copy(centres(bodies)[body], one.motion[body].centre->begin());
    }
    one.scene.time = 20.0;
    return one;
}

/// Turns the diagonal of a cube upright, and a little aside of it.
Matrix<3> corner_down() { return rotation_between({1.0, 1.0, 1.0}, {0.1, 0.06, 1.0}); }

double lowest(const mesh::Mesh<3>& mesh) {
    double least = mesh.vertices.front().z();
    for (const Vector<3>& x : mesh.vertices) least = std::min(least, x.z());
    return least;
}

}  // namespace

Case<2> slipping_discs(Kinematics strain, double size) { return two_round_bodies<2>("slipping discs", strain, size); }

Case<3> slipping_cylinders(Kinematics strain, double size) {
    return two_round_bodies<3>("slipping cylinders", strain, size);
}

Case<2> spinning_discs(double size) {
    auto one = two_round_bodies<2>("spinning discs", Kinematics::finite, size);
    one.motion[0].spin[0] = 0.1;
    one.motion[1].spin[0] = 0.03;
    return one;
}

Case<2> tumbling_block(int cells) {
    auto one = case_of<2>(
        "tumbling block",
        {turned_box<2>(
            {.centre = Vector<2>(0.0, 0.65), .sides = {1.0, 0.5}, .cells = {2 * cells, cells}, .turn = rotation(0.4)})},
        Kinematics::finite);
    let_fall<2>(one, 0.004);
    one.scene.solid.obstacles = {contact::plane_obstacle<2>({0.0, 0.0}, {0.0, 1.0}, 20.0)};
    one.motion[0] = {.velocity = {0.02, -0.02}, .centre = Vector<2>(0.0, 0.65)};
    one.motion[0].spin[0] = -0.08;
    one.scene.time = 80.0;
    return one;
}

Case<2> gears(int cells_around_tooth, double turns) {
    const double spin = 0.06, second_spin = 0.04, apart = 2.02;
    Gear first{.centre = {-0.5 * apart, 0.0}, .cells = cells_around_tooth, .name = "first"};
    Gear second = first;
    second.centre[0] *= -1.0;
    second.name = "second";
    second.phase = std::numbers::pi + std::numbers::pi / first.teeth;  // a gap faces the tooth of the first
    auto one = case_of<2>("gears", {gear(first), gear(second)}, Kinematics::finite);
    for (const auto& [body, centre] : {std::pair{0, first.centre}, std::pair{1, second.centre}}) {
        const auto on_bore = [&](const Vector<2>& x) { return (x - centre).norm() < first.bore + 1e-9; };
        one.on_nodes.pins.push_back({nodes_where<2>(one.scene.mesh, body, on_bore), 1.0});
        one.motion[static_cast<std::size_t>(body)].centre = centre;
    }
    one.motion[0].spin[0] = spin;
    one.motion[1].spin[0] = -second_spin;
    one.scene.time = turns * 2.0 * std::numbers::pi / second_spin;  // they share the spin, and lose some of it to vibration
    one.is_free = false;
    return one;
}

Case<2> rotor(double size) {
    const double spin = 0.05, radius = 0.5, far = 1.4, spring = 0.05;
    const std::array<Vector<2>, 2> centre{Vector<2>(far, 0.0), Vector<2>(0.0, far)};
    auto one = case_of<2>("rotor",
                          {mesh::disc({.centre = centre[0], .radius = radius, .size = size}),
                           mesh::disc({.centre = centre[1], .radius = radius, .size = size, .variant = 1})},
                          Kinematics::finite);
    for (std::int32_t body = 0; body < 2; ++body) {
        const auto all = [](const Vector<2>&) { return true; };
        one.on_nodes.pins.push_back({nodes_where<2>(one.scene.mesh, body, all), spring});
        one.motion[static_cast<std::size_t>(body)].centre = centre[static_cast<std::size_t>(body)];
    }
    const auto path = [spin](double time) {
        return contact::Placement<2>{.turn = rotation(std::numbers::pi / 4.0 + spin * time)};
    };
    one.scene.solid.obstacles = {rectangle_obstacle({1.0, 0.1})};
    one.scene.solid.obstacles[0].placement = path;
    one.scene.time = 2.0 * std::numbers::pi / spin;
    one.is_free = false;
    return one;
}

Case<3> spinning_cubes(int cells) {
    const std::array<Vector<3>, 2> centre{Vector<3>(-0.55, -0.1, -0.05), Vector<3>(0.55, 0.1, 0.05)};
    const std::array<int, 2> counts{cells, cells + 1};
    std::vector<mesh::Mesh<3>> meshes;
    for (std::size_t body = 0; body < 2; ++body)
        meshes.push_back(turned_box<3>({.centre = centre[body],
                                        .cells = {counts[body], counts[body], counts[body]},
                                        .name = body == 0 ? "left" : "right"}));
    auto one = case_of<3>("spinning cubes", meshes, Kinematics::finite);
    one.motion[0] = {.velocity = {0.03, 0.0, 0.0}, .spin = {0.02, 0.05, 0.03}, .centre = centre[0]};
    one.motion[1] = {.velocity = {-0.03, 0.0, 0.0}, .spin = {-0.03, 0.02, 0.04}, .centre = centre[1]};
    one.scene.time = 12.0;
    return one;
}

Case<3> cube_on_corner(int cells) {
    auto cube = turned_box<3>({.cells = {cells, cells, cells}, .turn = corner_down()});
    const Vector<3> up(0.0, 0.0, 0.02 - lowest(cube));
    cube = mapped<3>(cube, "cube", [&](const Vector<3>& x) { return Vector<3>(x + up); });
    auto one = case_of<3>("cube on its corner", {cube}, Kinematics::finite);
    let_fall<3>(one, 0.002);
    one.scene.solid.obstacles = {contact::plane_obstacle<3>(Vector<3>::Zero(), Vector<3>::UnitZ(), 10.0)};
    one.motion[0].velocity = {0.0, 0.0, -0.02};
    one.scene.time = 40.0;
    return one;
}

Case<2> disc_between_walls(Kinematics strain, double size) {
    auto one = case_of<2>("disc between walls", {mesh::disc({.size = size})}, strain);
    for (const double side : {-1.0, 1.0})
        one.scene.solid.obstacles.push_back(
            contact::plane_obstacle<2>(side * 1.05 * Vector<2>::UnitX(), -side * Vector<2>::UnitX(), 100.0));
    one.motion[0].velocity = {0.05, 0.0};
    one.scene.time = 1e9;  // the number of steps is given
    one.is_free = false;
    return one;
}

}  // namespace abut::studies::nodal
