#include "studies/scenes/boxes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "abut/base/error.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "apps/support/choices.hpp"

namespace abut::studies {
namespace {

using mesh::CellShape;

const apps::Choices<BoxCells> names = {{"quadrangles", BoxCells::quadrangles},
                                       {"triangles", BoxCells::triangles},
                                       {"hexahedra", BoxCells::hexahedra},
                                       {"tetrahedra", BoxCells::tetrahedra},
                                       {"prisms", BoxCells::prisms},
                                       {"pyramids", BoxCells::pyramids},
                                       {"gmsh", BoxCells::gmsh}};

CellShape shape_of(BoxCells cells) {
    switch (cells) {
        case BoxCells::quadrangles:
            return CellShape::quadrangle;
        case BoxCells::triangles:
            return CellShape::triangle;
        case BoxCells::hexahedra:
            return CellShape::hexahedron;
        case BoxCells::tetrahedra:
            return CellShape::tetrahedron;
        case BoxCells::prisms:
            return CellShape::prism;
        default:
            return CellShape::pyramid;
    }
}

}  // namespace

std::string name_of(BoxCells cells) { return apps::name_of(names, cells); }

template <int Dim>
std::vector<BoxCells> all_box_cells() {
    if constexpr (Dim == 2)
        return {BoxCells::quadrangles, BoxCells::triangles, BoxCells::gmsh};
    else
        return {BoxCells::hexahedra, BoxCells::tetrahedra, BoxCells::prisms, BoxCells::pyramids, BoxCells::gmsh};
}

template <int Dim>
mesh::Mesh<Dim> box_of(BoxCells cells, const Vector<Dim>& lower, const Vector<Dim>& upper, double size) {
    if (cells == BoxCells::gmsh) return mesh::box<Dim>({.lower = lower, .upper = upper, .size = size});
    const CellShape shape = shape_of(cells);
    if (mesh::dimension(shape) != Dim)
        throw BadInput(
            fmt::format("box of {}: they have {} dimensions, {} are needed. Take cells of that dimension, or gmsh.",
                        name_of(cells), mesh::dimension(shape), Dim));
    std::array<int, Dim> counts;
    for (int i = 0; i < Dim; ++i)
        counts[static_cast<std::size_t>(i)] = std::max(1, static_cast<int>(std::lround((upper[i] - lower[i]) / size)));
    return mesh::structured_box<Dim>(lower, upper, counts, shape);
}

template <int Dim>
double mean_cell_size(const mesh::Mesh<Dim>& mesh) {
    const double volume = std::accumulate(mesh.cell_measure.begin(), mesh.cell_measure.end(), 0.0);
    return std::pow(volume / mesh.n_cells(), 1.0 / Dim);
}

template <int Dim>
std::vector<std::string> box_sides() {
    std::vector<std::string> sides{"xmin", "xmax", "ymin", "ymax"};
    if (Dim == 3) sides.insert(sides.end(), {"zmin", "zmax"});
    return sides;
}

template <int Dim>
std::vector<solid::DirichletCondition<Dim>> whole_boundary(const solid::Field<Dim>& field) {
    std::vector<solid::DirichletCondition<Dim>> conditions;
    for (const std::string& side : box_sides<Dim>()) conditions.push_back({.group = side, .history = field});
    return conditions;
}

template std::vector<BoxCells> all_box_cells<2>();
template std::vector<BoxCells> all_box_cells<3>();
template mesh::Mesh<2> box_of<2>(BoxCells, const Vector<2>&, const Vector<2>&, double);
template mesh::Mesh<3> box_of<3>(BoxCells, const Vector<3>&, const Vector<3>&, double);
template double mean_cell_size<2>(const mesh::Mesh<2>&);
template double mean_cell_size<3>(const mesh::Mesh<3>&);
template std::vector<std::string> box_sides<2>();
template std::vector<std::string> box_sides<3>();
template std::vector<solid::DirichletCondition<2>> whole_boundary<2>(const solid::Field<2>&);
template std::vector<solid::DirichletCondition<3>> whole_boundary<3>(const solid::Field<3>&);

}  // namespace abut::studies
