#include "studies/kinematics/shapes.hpp"

#include <cmath>
#include <numbers>

#include "abut/mesh/shapes/shapes.hpp"

namespace abut::studies::kinematics {
namespace {

/// Vertices of a polygon: the centre, then ring by ring from corner 0 on, `ring` of them on each side.
struct Rings {
    int corners;
    [[nodiscard]] std::int32_t vertex(int ring, int side, int place) const {
        if (ring == 0) return 0;
        return 1 + corners * ring * (ring - 1) / 2 + (side * ring + place) % (corners * ring);
    }
};

}  // namespace

mesh::Mesh<2> polygon(const Polygon& polygon) {
    mesh::CellSoup<2> soup;
    soup.name = polygon.name;
    soup.body_names = {polygon.name};
    const auto corner = [&](int i) -> Vector<2> {
        const double angle = polygon.turn + 2.0 * std::numbers::pi * i / polygon.corners;
        return polygon.radius * Vector<2>(std::cos(angle), std::sin(angle));
    };
    soup.vertices.push_back(polygon.centre);
    for (int ring = 1; ring <= polygon.cuts; ++ring)
        for (int side = 0; side < polygon.corners; ++side)
            for (int i = 0; i < ring; ++i) {
                const double share = static_cast<double>(i) / ring;
                const Vector<2> x = (1.0 - share) * corner(side) + share * corner(side + 1);
                soup.vertices.push_back(polygon.centre + static_cast<double>(ring) / polygon.cuts * x);
            }
    const auto append = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        soup.cell_vertices.append(std::array<std::int32_t, 3>{a, b, c});
        soup.cell_shape.push_back(mesh::CellShape::triangle);
        soup.cell_body.push_back(0);
    };
    const Rings rings{polygon.corners};
    for (int ring = 0; ring < polygon.cuts; ++ring)
        for (int side = 0; side < polygon.corners; ++side)
            for (int i = 0; i <= ring; ++i) {
                const std::int32_t inner = rings.vertex(ring, side, i);
                append(inner, rings.vertex(ring + 1, side, i), rings.vertex(ring + 1, side, i + 1));
                if (i < ring) append(inner, rings.vertex(ring + 1, side, i + 1), rings.vertex(ring, side, i + 1));
            }
    return mesh::build_mesh(std::move(soup));
}

double Ball::back_area() const {
    const double r = radius * std::sin(back);
    return 0.5 * around * r * r * std::sin(2.0 * std::numbers::pi / around);
}

namespace {

/// Corners of a ball from its centre: the middles of its caps, then circle by circle from the one in front on.
std::vector<Vector<3>> corners_of(const Ball& ball) {
    std::vector<Vector<3>> corners{ball.front_distance() * Vector<3>::UnitX(), -ball.back_distance() * Vector<3>::UnitX()};
    for (int circle = 0; circle < ball.circles; ++circle)
        for (int i = 0; i < ball.around; ++i) {
            const double share = static_cast<double>(circle) / (ball.circles - 1),
                         angle = 2.0 * std::numbers::pi * i / ball.around;
            const double from_axis = (1.0 - share) * ball.front + share * (std::numbers::pi - ball.back);
            const double aside = std::sin(from_axis);
            corners.push_back(ball.radius *
                              Vector<3>(std::cos(from_axis), aside * std::cos(angle), aside * std::sin(angle)));
        }
    return corners;
}

}  // namespace

mesh::Mesh<3> faceted_ball(const Ball& ball) {
    const std::vector<Vector<3>> corners = corners_of(ball);
    const auto n = static_cast<std::int32_t>(corners.size());
    mesh::CellSoup<3> soup;
    soup.name = ball.name;
    soup.body_names = {ball.name};
    for (const double share : {1.0, 1.0 - ball.skin})
        for (const Vector<3>& corner : corners) soup.vertices.push_back(ball.centre + share * corner);
    soup.vertices.push_back(ball.centre);
    const auto append = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        soup.cell_vertices.append(std::array<std::int32_t, 6>{n + a, n + b, n + c, a, b, c});
        soup.cell_vertices.append(std::array<std::int32_t, 4>{2 * n, n + a, n + b, n + c});
        soup.cell_shape.insert(soup.cell_shape.end(), {mesh::CellShape::prism, mesh::CellShape::tetrahedron});
        soup.cell_body.insert(soup.cell_body.end(), {0, 0});
    };
    const auto corner = [&](int circle, int i) { return 2 + circle * ball.around + i % ball.around; };
    for (int i = 0; i < ball.around; ++i) {
        append(0, corner(0, i), corner(0, i + 1));
        append(1, corner(ball.circles - 1, i + 1), corner(ball.circles - 1, i));
        for (int circle = 0; circle + 1 < ball.circles; ++circle) {
            append(corner(circle, i), corner(circle + 1, i), corner(circle + 1, i + 1));
            append(corner(circle, i), corner(circle + 1, i + 1), corner(circle, i + 1));
        }
    }
    return mesh::build_mesh(std::move(soup));
}

contact::RigidObstacle<2> wall_along(const std::vector<Vector<2>>& points) {
    contact::RigidObstacle<2> obstacle;  // the outside is on the right of a face
    for (std::size_t i = 0; i + 1 < points.size(); ++i) obstacle.faces.push_back({points[i + 1], points[i]});
    return obstacle;
}

}  // namespace abut::studies::kinematics
