#include "studies/nodal/scenes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "abut/mesh/shapes/shapes.hpp"
#include "studies/nodal/shapes.hpp"

namespace abut::studies::nodal {
namespace {

/// Where the right one of two round bodies of radius 1 is, seen from the left one: 0.8 aside, and 0.02 apart.
Vector<2> second_centre() {
    constexpr double aside = 0.8, apart = 2.02;
    return {std::sqrt(apart * apart - aside * aside), aside};
}

template <int Dim>
Impact<Dim> impact_of(const std::string& name, const std::vector<mesh::Mesh<Dim>>& meshes, Strain strain) {
    Impact<Dim> impact{.name = name, .scene = {}, .motion = {}, .time = 0.0};
    impact.scene.mesh = meshes.size() == 1 ? meshes.front() : mesh::combine<Dim>(meshes);
    impact.scene.materials.resize(meshes.size());
    impact.scene.strain = strain;
    impact.motion.resize(meshes.size());
    return impact;
}

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

Impact<2> two_discs(const std::string& name, Strain strain, double size) {
    const Vector<2> half = 0.5 * second_centre();
    auto impact = impact_of<2>(
        name, {mesh::disc({.centre = -half, .size = size}), mesh::disc({.centre = half, .size = size, .variant = 1})},
        strain);
    impact.motion[0] = {.velocity = {0.05, 0.0}, .centre = -half};
    impact.motion[1] = {.velocity = {-0.05, 0.0}, .centre = half};
    impact.time = 20.0;
    return impact;
}

/// Turns the diagonal of a cube upright, and a little aside of it.
Matrix<3> corner_down() {
    const auto upright = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d(1.0, 1.0, 1.0), Eigen::Vector3d(0.1, 0.06, 1.0));
    return upright.toRotationMatrix();
}

double lowest(const mesh::Mesh<3>& mesh) {
    double least = mesh.vertices.front().z();
    for (const Vector<3>& x : mesh.vertices) least = std::min(least, x.z());
    return least;
}

}  // namespace

Impact<2> slipping_discs(Strain strain, double size) { return two_discs("slipping discs", strain, size); }

Impact<3> slipping_cylinders(Strain strain, double size) {
    const Vector<2> in_plane = 0.5 * second_centre();
    const Vector<3> half(in_plane[0], in_plane[1], 0.0);
    auto impact = impact_of<3>(
        "slipping cylinders",
        {mesh::cylinder({.centre = -half, .size = size}), mesh::cylinder({.centre = half, .size = size, .variant = 1})},
        strain);
    impact.motion[0] = {.velocity = {0.05, 0.0, 0.0}, .spin = Vector<3>::Zero(), .centre = -half};
    impact.motion[1] = {.velocity = {-0.05, 0.0, 0.0}, .spin = Vector<3>::Zero(), .centre = half};
    impact.time = 20.0;
    return impact;
}

Impact<2> spinning_discs(double size) {
    auto impact = two_discs("spinning discs", Strain::finite, size);
    impact.motion[0].spin[0] = 0.1;
    impact.motion[1].spin[0] = 0.03;
    return impact;
}

Impact<2> tumbling_block(int cells) {
    auto impact = impact_of<2>(
        "tumbling block",
        {turned_box<2>({.centre = {0.0, 0.65}, .sides = {1.0, 0.5}, .cells = {2 * cells, cells}, .turn = rotation(0.4)})},
        Strain::finite);
    impact.scene.gravity = {0.0, -0.004};
    impact.scene.obstacles = {{contact::plane_obstacle<2>({0.0, 0.0}, {0.0, 1.0}, 20.0)}};
    impact.motion[0] = {.velocity = {0.02, -0.02}, .centre = {0.0, 0.65}};
    impact.motion[0].spin[0] = -0.08;
    impact.time = 80.0;
    impact.is_free = false;
    return impact;
}

Impact<2> gears(int cells_around_tooth, double turns) {
    const double spin = 0.06, second_spin = 0.04, apart = 2.02;
    Gear first{.centre = {-0.5 * apart, 0.0}, .cells = cells_around_tooth, .name = "first"};
    Gear second = first;
    second.centre[0] *= -1.0;
    second.name = "second";
    second.phase = std::numbers::pi + std::numbers::pi / first.teeth;  // a gap faces the tooth of the first
    auto impact = impact_of<2>("gears", {gear(first), gear(second)}, Strain::finite);
    for (const auto& [body, centre] : {std::pair{0, first.centre}, std::pair{1, second.centre}}) {
        const auto on_bore = [&](const Vector<2>& x) { return (x - centre).norm() < first.bore + 1e-9; };
        impact.scene.pins.push_back({nodes_where<2>(impact.scene.mesh, body, on_bore), 1.0});
        impact.motion[static_cast<std::size_t>(body)].centre = centre;
    }
    impact.motion[0].spin[0] = spin;
    impact.motion[1].spin[0] = -second_spin;
    impact.time = turns * 2.0 * std::numbers::pi / second_spin;  // they share the spin, and lose some of it to vibration
    impact.is_free = false;
    return impact;
}

Impact<2> rotor(double size) {
    const double spin = 0.05, radius = 0.5, far = 1.4, spring = 0.05;
    const std::array<Vector<2>, 2> centre{Vector<2>(far, 0.0), Vector<2>(0.0, far)};
    auto impact = impact_of<2>("rotor",
                               {mesh::disc({.centre = centre[0], .radius = radius, .size = size}),
                                mesh::disc({.centre = centre[1], .radius = radius, .size = size, .variant = 1})},
                               Strain::finite);
    for (std::int32_t body = 0; body < 2; ++body) {
        const auto all = [](const Vector<2>&) { return true; };
        impact.scene.pins.push_back({nodes_where<2>(impact.scene.mesh, body, all), spring});
        impact.motion[static_cast<std::size_t>(body)].centre = centre[static_cast<std::size_t>(body)];
    }
    const auto path = [spin](double time) {
        return contact::Placement<2>{.turn = rotation(std::numbers::pi / 4.0 + spin * time)};
    };
    impact.scene.obstacles = {{rectangle_obstacle({1.0, 0.1}), path}};
    impact.time = 2.0 * std::numbers::pi / spin;
    impact.is_free = false;
    return impact;
}

Impact<3> spinning_cubes(int cells) {
    const std::array<Vector<3>, 2> centre{Vector<3>(-0.55, -0.1, -0.05), Vector<3>(0.55, 0.1, 0.05)};
    const std::array<int, 2> counts{cells, cells + 1};
    std::vector<mesh::Mesh<3>> meshes;
    for (std::size_t body = 0; body < 2; ++body)
        meshes.push_back(turned_box<3>({.centre = centre[body],
                                        .cells = {counts[body], counts[body], counts[body]},
                                        .name = body == 0 ? "left" : "right"}));
    auto impact = impact_of<3>("spinning cubes", meshes, Strain::finite);
    impact.motion[0] = {.velocity = {0.03, 0.0, 0.0}, .spin = {0.02, 0.05, 0.03}, .centre = centre[0]};
    impact.motion[1] = {.velocity = {-0.03, 0.0, 0.0}, .spin = {-0.03, 0.02, 0.04}, .centre = centre[1]};
    impact.time = 12.0;
    return impact;
}

Impact<3> cube_on_corner(int cells) {
    auto cube = turned_box<3>({.cells = {cells, cells, cells}, .turn = corner_down()});
    const Vector<3> up(0.0, 0.0, 0.02 - lowest(cube));
    cube = mapped<3>(cube, "cube", [&](const Vector<3>& x) { return Vector<3>(x + up); });
    auto impact = impact_of<3>("cube on its corner", {cube}, Strain::finite);
    impact.scene.gravity = {0.0, 0.0, -0.002};
    impact.scene.obstacles = {{contact::plane_obstacle<3>(Vector<3>::Zero(), Vector<3>::UnitZ(), 10.0)}};
    impact.motion[0].velocity = {0.0, 0.0, -0.02};
    impact.time = 40.0;
    impact.is_free = false;
    return impact;
}

Impact<2> disc_between_walls(Strain strain, double size) {
    auto impact = impact_of<2>("disc between walls", {mesh::disc({.size = size})}, strain);
    for (const double side : {-1.0, 1.0})
        impact.scene.obstacles.push_back(
            {contact::plane_obstacle<2>(side * 1.05 * Vector<2>::UnitX(), -side * Vector<2>::UnitX(), 100.0)});
    impact.motion[0].velocity = {0.05, 0.0};
    impact.time = 1e9;  // the number of steps is given
    impact.is_free = false;
    return impact;
}

}  // namespace abut::studies::nodal
