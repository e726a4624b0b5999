#include "studies/cases/shapes.hpp"

#include <cmath>

#include "abut/base/rotation.hpp"
#include "abut/mesh/shapes/shapes.hpp"

namespace abut::studies {

template <int Dim>
mesh::Mesh<Dim> mapped(const mesh::Mesh<Dim>& mesh, const std::string& name,
                       const std::function<Vector<Dim>(const Vector<Dim>&)>& map) {
    mesh::CellSoup<Dim> soup;
    soup.name = name;
    soup.body_names = {name};
    soup.cell_shape = mesh.cell_shape;
    soup.cell_vertices = mesh.cell_vertices;
    soup.cell_body = mesh.cell_body;
    for (const Vector<Dim>& x : mesh.vertices) soup.vertices.push_back(map(x));
    return mesh::build_mesh(std::move(soup));
}

template <int Dim>
mesh::Mesh<Dim> turned_box(const TurnedBox<Dim>& box) {
    const auto shape = Dim == 2 ? mesh::CellShape::triangle : mesh::CellShape::tetrahedron;
    const Vector<Dim> half = 0.5 * box.sides;
    const auto upright = mesh::structured_box<Dim>(-half, half, box.cells, shape, box.name);
    return mapped<Dim>(upright, box.name, [&](const Vector<Dim>& x) { return Vector<Dim>(box.centre + box.turn * x); });
}

Matrix<2> rotation(double angle) { return rotation_in_plane(angle); }

mesh::Mesh<3> beam(const Vector<3>& axis, const Vector<3>& middle, double angle, bool is_upper, mesh::CellShape shape,
                   double unit) {
    constexpr double length = 2.0, side = 0.5;
    const Vector<3> up = Vector<3>::UnitZ(), across = up.cross(axis);
    const double half_width = side * std::sin(0.5 * angle), half_height = side * std::cos(0.5 * angle);
    const auto cube = mesh::structured_box<3>(Vector<3>::Zero(), Vector<3>::Ones(), {9, 3, 3}, shape);
    return mapped<3>(cube, is_upper ? "upper" : "lower", [&](const Vector<3>& x) {
        return Vector<3>(unit * (middle + (is_upper ? half_height : -half_height) * up + length * (x[0] - 0.5) * axis +
                                 half_width * (x[1] - x[2]) * across + half_height * (x[1] + x[2] - 1.0) * up));
    });
}

#define ABUT_INSTANTIATE(Dim)                                                                    \
    template mesh::Mesh<Dim> mapped<Dim>(const mesh::Mesh<Dim>&, const std::string&,             \
                                         const std::function<Vector<Dim>(const Vector<Dim>&)>&); \
    template mesh::Mesh<Dim> turned_box<Dim>(const TurnedBox<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies
