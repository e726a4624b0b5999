#include "studies/nodal/shapes.hpp"

#include <cmath>
#include <numbers>

#include "abut/mesh/shapes/shapes.hpp"

namespace abut::studies::nodal {

mesh::Mesh<2> gear(const Gear& gear) {
    const int around = gear.teeth * gear.cells;
    const double side = 2.0 * std::numbers::pi * gear.radius / around;
    const int layers = std::max(2, static_cast<int>(std::lround((gear.radius - gear.bore) / side)));
    mesh::CellSoup<2> soup;
    soup.name = gear.name;
    soup.body_names = {gear.name};
    for (int layer = 0; layer <= layers; ++layer)
        for (int i = 0; i < around; ++i) {
            const double angle = gear.phase + 2.0 * std::numbers::pi * i / around;
            const double outer = gear.radius + gear.height * std::cos(gear.teeth * (angle - gear.phase));
            const double radius = gear.bore + (outer - gear.bore) * layer / layers;
            soup.vertices.push_back(gear.centre + radius * Vector<2>(std::cos(angle), std::sin(angle)));
        }
    const auto append = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        soup.cell_vertices.append(std::array<std::int32_t, 3>{a, b, c});
        soup.cell_shape.push_back(mesh::CellShape::triangle);
        soup.cell_body.push_back(0);
    };
    for (int layer = 0; layer < layers; ++layer)
        for (int i = 0; i < around; ++i) {
            const int next = (i + 1) % around;
            const int a = layer * around + i, b = layer * around + next, c = a + around, d = b + around;
            append(a, c, d);
            append(a, d, b);
        }
    return mesh::build_mesh(std::move(soup));
}

contact::RigidObstacle<2> rectangle_obstacle(const Vector<2>& half_sides) {
    const double a = half_sides[0], b = half_sides[1];
    const std::array<Vector<2>, 4> corners{Vector<2>(-a, -b), Vector<2>(a, -b), Vector<2>(a, b), Vector<2>(-a, b)};
    contact::RigidObstacle<2> obstacle;
    for (std::size_t i = 0; i < 4; ++i) obstacle.faces.push_back({corners[i], corners[(i + 1) % 4]});
    return obstacle;
}

}  // namespace abut::studies::nodal
