#include "studies/extremes/scenes.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "studies/cases/shapes.hpp"

namespace abut::studies::extremes {
namespace {

template <int Dim>
void set_materials(run::Scene<Dim>& scene, const Meeting<Dim>& meeting) {
    for (std::size_t body = 0; body < 2; ++body)
        scene.solid.materials.push_back({.young = meeting.young[body] * meeting.units.stress,
                                         .poisson = meeting.poisson,
                                         .density = meeting.density[body] * meeting.units.density});
}

/// All that does not depend on the shape of the bodies, which run into each other along an axis.
template <int Dim>
void set_in_motion(run::Scene<Dim>& scene, const Meeting<Dim>& meeting, int axis) {
    set_materials(scene, meeting);
    const double speed = meeting.speed * meeting.units.speed();
    scene.velocity = {speed * Vector<Dim>::Unit(axis), -speed * Vector<Dim>::Unit(axis)};
    scene.velocity[1] += meeting.slide * meeting.units.speed() * Vector<Dim>::Unit((axis + 1) % Dim);
    scene.time = meeting.time * meeting.units.time();
    scene.remedy_if_overlapping = "Raise the gap.";
}

/// Rows of triangles below one another from the tip at the origin to a base at height 1: row i has 2i + 1 of them.
mesh::Mesh<2> triangle(const Vector<2>& tip, double angle, double unit) {
    constexpr int rows = 6;
    const double half_width = std::tan(0.5 * angle) / rows;
    mesh::CellSoup<2> soup;
    soup.name = "wedge";
    soup.body_names = {"wedge"};
    const auto vertex = [](int row, int i) { return row * (row + 1) / 2 + i; };
    for (int row = 0; row <= rows; ++row)
        for (int i = 0; i <= row; ++i)
            soup.vertices.push_back(tip + unit * Vector<2>((2 * i - row) * half_width, static_cast<double>(row) / rows));
    const auto append = [&](int a, int b, int c) {
        soup.cell_vertices.append(std::array<std::int32_t, 3>{a, b, c});
        soup.cell_shape.push_back(mesh::CellShape::triangle);
        soup.cell_body.push_back(0);
    };
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i <= row; ++i) {
            append(vertex(row, i), vertex(row + 1, i + 1), vertex(row + 1, i));
            if (i < row) append(vertex(row, i), vertex(row, i + 1), vertex(row + 1, i + 1));
        }
    return mesh::build_mesh(std::move(soup));
}

/// Square of side 1, a corner below.
mesh::Mesh<2> turned_square(const Vector<2>& corner, int cells, double unit) {
    const auto square = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {cells, cells}, mesh::CellShape::quadrangle);
    return mapped<2>(square, "square", [&](const Vector<2>& x) {
        return Vector<2>(corner + unit * std::numbers::sqrt2 / 2.0 * Vector<2>(x[0] - x[1], x[0] + x[1]));
    });
}

}  // namespace

double Units::speed() const { return std::sqrt(stress / density); }
double Units::time() const { return length / speed(); }

run::Scene<2> discs(const Meeting<2>& meeting, std::array<double, 2> size) {
    const double unit = meeting.units.length;
    const double along = std::sqrt(4.0 - meeting.aside * meeting.aside) + meeting.gap;
    const Vector<2> half(0.5 * along, 0.5 * meeting.aside);
    const auto disc = [&](double side, int variant, const char* name) {
        return mesh::disc({.centre = unit * (meeting.place + side * half),
                           .radius = unit,
                           .size = unit * size[static_cast<std::size_t>(variant)],
                           .variant = variant,
                           .name = name});
    };
    run::Scene<2> scene;
    scene.mesh = mesh::combine<2>(std::vector{disc(-1.0, 0, "left"), disc(1.0, 1, "right")});
    set_in_motion(scene, meeting, 0);
    return scene;
}

template <int Dim>
run::Scene<Dim> blocks(const Meeting<Dim>& meeting, const std::array<Block<Dim>, 2>& blocks) {
    std::vector<mesh::Mesh<Dim>> meshes;
    for (std::size_t body = 0; body < 2; ++body) {
        const Block<Dim>& block = blocks[body];
        Vector<Dim> lower = meeting.place - 0.5 * block.sides;
        lower[Dim - 1] = meeting.place[Dim - 1] + (body == 0 ? -block.sides[Dim - 1] : meeting.gap);
        if (body == 1) lower[0] += meeting.aside * block.sides[0];
        const double unit = meeting.units.length;
        meshes.push_back(mesh::structured_box<Dim>(unit * lower, unit * (lower + block.sides), block.cells, block.shape,
                                                   body == 0 ? "lower" : "upper"));
    }
    run::Scene<Dim> scene;
    scene.mesh = mesh::combine<Dim>(meshes);
    set_in_motion(scene, meeting, Dim - 1);
    return scene;
}

run::Scene<2> wedge(const Meeting<2>& meeting, double angle, bool on_plane) {
    const double unit = meeting.units.length;
    const Vector<2> tip = unit * (meeting.place + meeting.gap * Vector<2>::UnitY());
    run::Scene<2> scene;
    if (on_plane) {
        scene.mesh = triangle(tip, angle, unit);
        set_in_motion(scene, meeting, 1);
        scene.solid.materials.erase(scene.solid.materials.begin());
        scene.velocity.erase(scene.velocity.begin());
        scene.solid.obstacles = {contact::plane_obstacle<2>(unit * meeting.place, Vector<2>::UnitY(), 4.0 * unit)};
        return scene;
    }
    const Vector<2> lower(-1.0 + meeting.aside, -1.0), upper(1.0 + meeting.aside, 0.0);
    const auto block = mesh::structured_box<2>(unit * (meeting.place + lower), unit * (meeting.place + upper), {11, 6},
                                               mesh::CellShape::quadrangle, "block");
    scene.mesh = mesh::combine<2>(std::vector{block, triangle(tip, angle, unit)});
    set_in_motion(scene, meeting, 1);
    return scene;
}

run::Scene<2> square_on_corner(const Meeting<2>& meeting, int cells) {
    const double unit = meeting.units.length;
    const auto block =
        mesh::structured_box<2>(unit * (meeting.place + Vector<2>(-1.0, -1.0)), unit * (meeting.place + Vector<2>(1.0, 0.0)),
                                {2 * cells, cells}, mesh::CellShape::quadrangle, "block");
    const Vector<2> corner = unit * (meeting.place + Vector<2>(meeting.aside, meeting.gap));
    run::Scene<2> scene;
    scene.mesh = mesh::combine<2>(std::vector{block, turned_square(corner, cells, unit)});
    set_in_motion(scene, meeting, 1);
    scene.velocity[0].setZero();
    return scene;
}

run::Scene<3> crossing_beams(const Meeting<3>& meeting, double angle) {
    const Vector<3> above = meeting.place + Vector<3>(meeting.aside, 0.0, meeting.gap);
    run::Scene<3> scene;
    const auto shape = mesh::CellShape::hexahedron;
    const double unit = meeting.units.length;
    scene.mesh = mesh::combine<3>(std::vector{beam(Vector<3>::UnitX(), meeting.place, angle, false, shape, unit),
                                              beam(Vector<3>::UnitY(), above, angle, true, shape, unit)});
    set_in_motion(scene, meeting, 2);
    return scene;
}

template <int Dim>
run::Scene<Dim> blocks_on_rollers(const Meeting<Dim>& meeting) {
    std::array<Block<Dim>, 2> pair;
    pair[0].cells.fill(Dim == 2 ? 5 : 3);
    pair[1].cells.fill(Dim == 2 ? 4 : 2);
    run::Scene<Dim> scene = blocks<Dim>(meeting, pair);
    for (const char* side : {"lower.xmin", "upper.xmin"})
        scene.solid.boundary.dirichlet.push_back({.group = side, .constraint = solid::Constraint::normal});
    return scene;
}

run::Scene<2> spinning_bar(double rate, double angle, Growth& growth) {
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({-1.0, -0.25}, {1.0, 0.25}, {16, 4}, mesh::CellShape::quadrangle, "bar");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0}};
    scene.velocity = {Vector<2>::Zero()};
    scene.added_velocity = [rate](const Vector<2>& x) { return Vector<2>(-rate * x.y(), rate * x.x()); };
    scene.time = std::tan(angle) / rate;  // every point flies straight on
    scene.remedy_if_overlapping = "The bar is one body.";
    scene.after_step = [&growth](const solid::Solid<2>& solid, double dt) {
        const Matrix<2> stretched = Matrix<2>::Identity() + solid.ccg().displacement_gradient(0);
        growth.of_cell = std::sqrt(stretched.determinant()) - 1.0;
        growth.time += growth.time == 0.0 ? 0.5 * dt : dt;
    };
    return scene;
}

run::Scene<2> crowd(int n, double speed, double gap) {
    run::Scene<2> scene;
    std::vector<mesh::Mesh<2>> meshes;
    const double middle = 0.5 * (n - 1);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vector<2> centre(i - middle, j - middle);
            meshes.push_back(mesh::disc({.centre = centre,
                                         .radius = 0.5 * (1.0 - gap),
                                         .size = 0.2,
                                         .variant = n * i + j,
                                         .name = "disc " + std::to_string(n * i + j)}));
            scene.velocity.push_back(-speed / (std::numbers::sqrt2 * middle) * centre);
        }
    scene.mesh = mesh::combine<2>(meshes);
    scene.solid.materials.assign(scene.velocity.size(), {.young = 1.0, .poisson = 0.3, .density = 1.0});
    scene.time = 20.0;
    scene.remedy_if_overlapping = "Raise the gap.";
    return scene;
}

run::Scene<2> resting(double load) {
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({-0.5, 0.0}, {0.5, 1.0}, {6, 6}, mesh::CellShape::triangle, "block");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0}};
    scene.solid.acceleration = {Vector<2>(0.0, -load)};
    scene.solid.obstacles = {contact::plane_obstacle<2>(Vector<2>::Zero(), Vector<2>::UnitY(), 4.0)};
    scene.velocity = {Vector<2>::Zero()};
    scene.energy_scale = {"E0", load * load / 6.0};  // elastic, at rest: int (load (1 - y))^2 / 2
    scene.time = 100.0;
    scene.remedy_if_overlapping = "The block is one body.";
    return scene;
}

run::Scene<2> between_walls(double speed) {
    run::Scene<2> scene;
    scene.mesh = mesh::disc({.radius = 1.0, .size = 0.4});
    scene.solid.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0}};
    for (const double side : {-1.0, 1.0})
        scene.solid.obstacles.push_back(
            contact::plane_obstacle<2>(side * 1.05 * Vector<2>::UnitX(), -side * Vector<2>::UnitX(), 1e3));
    scene.velocity = {speed * Vector<2>::UnitX()};
    scene.time = 100.0;
    scene.remedy_if_overlapping = "The disc is one body.";
    return scene;
}

run::Scene<2> falling_strip(int cells) {
    const double width = 2.0 / cells, gravity = 0.01;
    run::Scene<2> scene;
    scene.mesh =
        mesh::structured_box<2>({-0.5 * width, 0.5}, {0.5 * width, 1.5}, {2, cells}, mesh::CellShape::quadrangle, "strip");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.0, .density = 1.0}};
    scene.solid.acceleration = {Vector<2>(0.0, -gravity)};
    for (const char* side : {"xmin", "xmax"})
        scene.solid.boundary.dirichlet.push_back({.group = side, .constraint = solid::Constraint::normal});
    scene.solid.obstacles = {contact::plane_obstacle<2>(Vector<2>::Zero(), Vector<2>::UnitY(), 1.0)};
    scene.velocity = {Vector<2>::Zero()};
    scene.energy_scale = {"H0", width * gravity * 0.5};  // all kinetic at the first impact, at a tenth of the wave speed
    scene.time = 100.0;
    scene.remedy_if_overlapping = "The strip is one body.";
    return scene;
}

template run::Scene<2> blocks<2>(const Meeting<2>&, const std::array<Block<2>, 2>&);
template run::Scene<3> blocks<3>(const Meeting<3>&, const std::array<Block<3>, 2>&);
template run::Scene<2> blocks_on_rollers<2>(const Meeting<2>&);
template run::Scene<3> blocks_on_rollers<3>(const Meeting<3>&);

}  // namespace abut::studies::extremes
