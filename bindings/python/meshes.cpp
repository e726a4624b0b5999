#include "meshes.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <utility>

#include "abut/base/counted.hpp"
#include "abut/base/given_value.hpp"
#include "abut/mesh/io/read_mesh.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/mesh/mesh_words.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "docstrings.hpp"
#include "vectors.hpp"

namespace abut::python {
namespace {

using mesh::CellShape;
using mesh::Mesh;
using mesh::MeshOptions;
using namespace py::literals;

/// The shapes by the names of meshio, whose order of vertices is the same.
struct ShapeName {
    const char* name;
    CellShape shape;
    int dim;
    int corners;
};
constexpr std::array<ShapeName, 6> shape_names{{{"triangle", CellShape::triangle, 2, 3},
                                                {"quad", CellShape::quadrangle, 2, 4},
                                                {"tetra", CellShape::tetrahedron, 3, 4},
                                                {"hexahedron", CellShape::hexahedron, 3, 8},
                                                {"wedge", CellShape::prism, 3, 6},
                                                {"pyramid", CellShape::pyramid, 3, 5}}};

const ShapeName& shape_of(const std::string& name, int dim) {
    std::vector<ShapeName> of_dim;
    std::ranges::copy_if(shape_names, std::back_inserter(of_dim), [&](const ShapeName& known) { return known.dim == dim; });
    const ShapeName& found =
        entry_called(of_dim, &ShapeName::name, "the type of cells in " + std::to_string(dim) + "D", name);
    return *std::ranges::find(shape_names, found.shape, &ShapeName::shape);
}

mesh::NonPlanarFaces non_planar_of(const std::string& word) {
    return choice_called(mesh::non_planar_words, "non_planar", word);
}

Packed<std::int32_t> index_table(const py::handle& given, const std::string& name, int columns) {
    const auto table = integers_of(py::reinterpret_borrow<py::object>(given), name);
    if (table.ndim() != 2 || (columns > 0 && table.shape(1) != columns)) {
        PyErr_Clear();
        throw py::value_error(name + " must be an array of integers of shape (n, " +
                              (columns > 0 ? std::to_string(columns) : "corners") + ")");
    }
    return table;
}

/// Pairs of a shape and its cells, out of a dict, out of pairs, or out of blocks with `type` and `data` as meshio has them.
std::vector<std::pair<std::string, py::object>> blocks_of(const py::object& cells) {
    std::vector<std::pair<std::string, py::object>> blocks;
    const py::object pairs = py::isinstance<py::dict>(cells) ? py::object(cells.attr("items")()) : cells;
    for (const py::handle block : pairs) {
        if (py::hasattr(block, "type") && py::hasattr(block, "data"))
            blocks.emplace_back(py::cast<std::string>(block.attr("type")), block.attr("data"));
        else
            blocks.push_back(py::cast<std::pair<std::string, py::object>>(block));
    }
    return blocks;
}

/// Tables of a group: one table, or a list of arrays, for faces with different numbers of corners.
py::list tables_of_faces(const py::object& faces) {
    const bool are_many = py::isinstance<py::list>(faces) && py::len(faces) > 0 &&
                          py::isinstance<py::array>(faces[py::int_(0)]) &&
                          py::reinterpret_borrow<py::array>(faces[py::int_(0)]).ndim() == 2;
    if (are_many) return py::reinterpret_borrow<py::list>(faces);
    py::list one;
    one.append(faces);
    return one;
}

template <int Dim>
Mesh<Dim> mesh_of(const py::handle& points, const py::object& cells, const py::object& body,
                  std::vector<std::string> body_names, const std::map<std::string, py::object>& groups,
                  const std::string& name, const std::string& non_planar, double planarity_tolerance) {
    mesh::CellSoup<Dim> soup;
    soup.name = name;
    soup.vertices = vectors_of<Dim>(points, "points");
    for (const auto& [type, data] : blocks_of(cells)) {
        const ShapeName& shape = shape_of(type, Dim);
        const auto table = index_table(data, "cells['" + type + "']", shape.corners);
        for (py::ssize_t c = 0; c < table.shape(0); ++c) {
            soup.cell_shape.push_back(shape.shape);
            soup.cell_vertices.append({table.data(c, 0), static_cast<std::size_t>(shape.corners)});
        }
    }
    const auto n_cells = static_cast<py::ssize_t>(soup.cell_shape.size());
    if (body.is_none()) {
        soup.cell_body.assign(soup.cell_shape.size(), 0);
    } else {
        const auto of_cells = integers_of(body, "body");
        if (of_cells.ndim() != 1 || of_cells.shape(0) != n_cells)
            throw py::value_error("body must be one integer for each of the " + std::to_string(n_cells) + " cells");
        soup.cell_body.assign(of_cells.data(), of_cells.data() + n_cells);
        if (n_cells > 0 && std::ranges::max(soup.cell_body) >= n_cells)
            throw py::value_error("body has the number " + std::to_string(std::ranges::max(soup.cell_body)) + " for " +
                                  std::to_string(n_cells) + " cells; number bodies from 0, without gaps");
    }
    if (body_names.empty() && n_cells > 0)
        for (std::int32_t b = 0; b <= std::ranges::max(soup.cell_body); ++b)
            body_names.push_back("body" + std::to_string(b));
    soup.body_names = std::move(body_names);
    for (const auto& [group, faces] : groups) {
        const auto index = static_cast<std::int32_t>(soup.group_names.size());
        for (const py::handle one : tables_of_faces(faces)) {
            const auto table = index_table(one, "groups['" + group + "']", 0);
            for (py::ssize_t f = 0; f < table.shape(0); ++f)
                soup.named_faces.push_back({{table.data(f, 0), table.data(f, 0) + table.shape(1)}, index});
        }
        soup.group_names.push_back(group);
    }
    return mesh::build_mesh<Dim>(std::move(soup), {.planarity_tolerance = planarity_tolerance,
                                                   .non_planar = non_planar_of(non_planar),
                                                   .shared_vertices = mesh::SharedVertices::separate});
}

py::object mesh_of_arrays(const py::object& points, const py::object& cells, const py::object& body,
                          const std::vector<std::string>& body_names, const std::map<std::string, py::object>& groups,
                          const std::string& name, const std::string& non_planar, double planarity_tolerance) {
    const auto array = py::array::ensure(points);
    if (array && array.ndim() == 2 && array.shape(1) == 2)
        return py::cast(mesh_of<2>(array, cells, body, body_names, groups, name, non_planar, planarity_tolerance));
    if (array && array.ndim() == 2 && array.shape(1) == 3)
        return py::cast(mesh_of<3>(array, cells, body, body_names, groups, name, non_planar, planarity_tolerance));
    PyErr_Clear();
    throw py::value_error("points must have the shape (n, 2) or (n, 3)");
}

/// Blocks of consecutive cells of one shape, as meshio has them.
template <int Dim>
py::list cells_of(const Mesh<Dim>& mesh) {
    py::list blocks;
    for (std::int32_t begin = 0; begin < mesh.n_cells();) {
        const CellShape shape = mesh.cell_shape[static_cast<std::size_t>(begin)];
        std::int32_t end = begin;
        while (end < mesh.n_cells() && mesh.cell_shape[static_cast<std::size_t>(end)] == shape) ++end;
        const ShapeName& known = *std::ranges::find(shape_names, shape, &ShapeName::shape);
        py::array_t<std::int32_t> table({py::ssize_t{end - begin}, py::ssize_t{known.corners}});
        std::copy_n(mesh.cell_vertices[begin].data(), static_cast<std::size_t>(table.size()), table.mutable_data());
        blocks.append(py::make_tuple(known.name, table));
        begin = end;
    }
    return blocks;
}

/// Half the height of the cell behind a boundary face [m].
template <int Dim>
double depth_behind(const Mesh<Dim>& mesh, std::int32_t face) {
    const auto cell = static_cast<std::size_t>(mesh.face_cells[static_cast<std::size_t>(face)][0]);
    const CellShape shape = mesh.cell_shape[cell];
    const bool is_simplex = shape == CellShape::triangle || shape == CellShape::tetrahedron;
    return 0.5 * (is_simplex ? Dim : 1) * mesh.cell_measure[cell] / mesh.face_measure[static_cast<std::size_t>(face)];
}

/// The boundary faces in the words of NodalContact.
template <int Dim>
py::dict surface_of(const Mesh<Dim>& mesh) {
    mesh::Rows faces;
    std::vector<std::int32_t> body;
    std::vector<double> depth;
    for (const std::int32_t f : mesh.boundary_faces) {
        faces.append(mesh.face_vertices[f]);
        const std::int32_t cell = mesh.face_cells[static_cast<std::size_t>(f)][0];
        body.push_back(mesh.cell_body[static_cast<std::size_t>(cell)]);
        depth.push_back(depth_behind(mesh, f));
    }
    return py::dict("faces"_a = copy_of(faces.values), "offsets"_a = copy_of(faces.offsets), "body"_a = copy_of(body),
                    "depth"_a = copy_of(depth));
}

template <int Dim>
py::array_t<std::int32_t> cells_behind_surface(const Mesh<Dim>& mesh) {
    std::vector<std::int32_t> cell;
    for (const std::int32_t f : mesh.boundary_faces) cell.push_back(mesh.face_cells[static_cast<std::size_t>(f)][0]);
    return copy_of(cell);
}

template <int Dim>
py::dict groups_of(const Mesh<Dim>& mesh) {
    py::dict groups;
    for (const mesh::BoundaryGroup& group : mesh.groups) {
        std::vector<std::int32_t> rows;  // in `surface`
        for (const std::int32_t f : group.faces)
            rows.push_back(
                static_cast<std::int32_t>(std::ranges::lower_bound(mesh.boundary_faces, f) - mesh.boundary_faces.begin()));
        groups[text_of(group.name)] = copy_of(rows);
    }
    return groups;
}

template <int Dim>
void add_mesh(py::module_& module, const char* name) {
    py::class_<Mesh<Dim>>(module, name, docs::mesh_class)
        .def_property_readonly(
            "name", [](const Mesh<Dim>& mesh) { return text_of(mesh.name); }, "Name of the mesh in messages.")
        .def_property_readonly(
            "points", [](const Mesh<Dim>& mesh) { return copy_of_vectors<Dim>(mesh.vertices); },
            "Positions of the points (n_points, dim) [m].")
        .def_property_readonly("cells", &cells_of<Dim>,
                               "Cells as meshio has them, [(type, (n, corners)), ...], in their order.")
        .def_property_readonly(
            "body", [](const Mesh<Dim>& mesh) { return copy_of(mesh.cell_body); }, "Body of each cell (n_cells,).")
        .def_property_readonly(
            "label", [](const Mesh<Dim>& mesh) { return copy_of(mesh.cell_label); },
            "Number of each cell in what the mesh was made of (n_cells,).")
        .def_property_readonly(
            "centroids", [](const Mesh<Dim>& mesh) { return copy_of_vectors<Dim>(mesh.cell_centroid); },
            "Centroids of the cells (n_cells, dim) [m].")
        .def_property_readonly(
            "measures", [](const Mesh<Dim>& mesh) { return copy_of(mesh.cell_measure); },
            "Areas or volumes of the cells (n_cells,) [m^dim].")
        .def_property_readonly(
            "body_names", [](const Mesh<Dim>& mesh) { return texts_of(mesh.body_names); }, "Names of the bodies.")
        .def_property_readonly("groups", &groups_of<Dim>, "Named parts of the boundary, {name: rows of `surface`}.")
        .def_property_readonly("surface", &surface_of<Dim>,
                               "Boundary faces, all that NodalContact takes beside nodes and stiffness.\n\n"
                               "A dict: faces (flat), offsets, body, and depth [m].")
        .def_property_readonly("surface_cells", &cells_behind_surface<Dim>, "Cell behind each boundary face (n_faces,).")
        .def("at_points", &python::at_points<Dim>, "values"_a, docs::at_points)
        .def(
            "write_vtu", [](const Mesh<Dim>& mesh, const std::filesystem::path& path) { mesh::write_vtu(mesh, path); },
            "path"_a, docs::write_vtu)
        .def(
            "_set_label",  // of a copy
            [](Mesh<Dim>& mesh, const std::vector<std::int64_t>& label) {
                if (label.size() != mesh.cell_label.size()) throw py::value_error("label must have one number per cell");
                mesh.cell_label = label;
            },
            "label"_a)
        .def("__repr__", [name](const Mesh<Dim>& mesh) {
            return text_of("<abut.solid." + std::string(name) + " '" + mesh.name + "': " + counted(mesh.n_cells(), "cell") +
                           ", " + counted(mesh.n_bodies(), "body") + ">");
        });
    module.def(
        "combine",
        [](const std::vector<Mesh<Dim>>& meshes) {
            if (meshes.empty()) throw py::value_error("combine: there are no meshes; give one or more");
            return mesh::combine<Dim>(meshes);
        },
        "meshes"_a, docs::combine);
    module.def(
        "box",
        [](const std::array<double, Dim>& lower, const std::array<double, Dim>& upper, double size, int variant,
           const std::string& part) {
            return mesh::box<Dim>({.lower = Vector<Dim>(lower.data()),
                                   .upper = Vector<Dim>(upper.data()),
                                   .size = size,
                                   .variant = variant,
                                   .name = part});
        },
        "lower"_a, "upper"_a, "size"_a = 0.1, "variant"_a = 0, "name"_a = "box", docs::box);
    module.def(
        "structured_box",
        [](const std::array<double, Dim>& lower, const std::array<double, Dim>& upper, const std::array<int, Dim>& counts,
           const std::string& shape, const std::string& part) {
            return mesh::structured_box<Dim>(Vector<Dim>(lower.data()), Vector<Dim>(upper.data()), counts,
                                             shape_of(shape, Dim).shape, part);
        },
        "lower"_a, "upper"_a, "counts"_a, "shape"_a = Dim == 2 ? "quad" : "hexahedron", "name"_a = "box",
        docs::structured_box);
}

}  // namespace

template <int Dim>
py::array_t<double> at_points(const Mesh<Dim>& mesh, const Packed<double>& values) {
    if (values.ndim() < 1 || values.shape(0) != mesh.n_cells())
        throw py::value_error("values must have one row for each of the " + std::to_string(mesh.n_cells()) + " cells");
    std::vector<py::ssize_t> shape(values.shape(), values.shape() + values.ndim());
    shape[0] = static_cast<py::ssize_t>(mesh.vertices.size());
    py::array_t<double> means(shape);
    const py::ssize_t width = values.size() / std::max<py::ssize_t>(1, values.shape(0));
    double* const mean = means.mutable_data();
    std::fill_n(mean, means.size(), 0.0);
    std::vector<double> cells_around(mesh.vertices.size(), 0.0);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        for (const std::int32_t v : mesh.cell_vertices[c]) {
            ++cells_around[static_cast<std::size_t>(v)];
            for (py::ssize_t i = 0; i < width; ++i) mean[v * width + i] += values.data()[c * width + i];
        }
    for (py::ssize_t i = 0; i < means.size(); ++i) mean[i] /= cells_around[static_cast<std::size_t>(i / width)];
    return means;
}

template py::array_t<double> at_points<2>(const Mesh<2>&, const Packed<double>&);
template py::array_t<double> at_points<3>(const Mesh<3>&, const Packed<double>&);

void add_meshes(py::module_& module) {
    add_mesh<2>(module, "Mesh2D");
    add_mesh<3>(module, "Mesh3D");
    module.def("mesh", &mesh_of_arrays, "points"_a, "cells"_a, "body"_a = py::none(),
               "body_names"_a = std::vector<std::string>(), "groups"_a = std::map<std::string, py::object>(),
               "name"_a = "mesh", "non_planar"_a = "fail", "planarity_tolerance"_a = MeshOptions{}.planarity_tolerance,
               "See abut.solid.mesh.");
    module.def(
        "read_mesh",
        [](const std::filesystem::path& path, int dim, const std::string& non_planar, double planarity_tolerance) {
            const MeshOptions options{.planarity_tolerance = planarity_tolerance,
                                      .non_planar = non_planar_of(non_planar),
                                      .shared_vertices = mesh::SharedVertices::separate};
            if (dim == 2) return py::cast(mesh::read_mesh<2>(path, options));
            if (dim == 3) return py::cast(mesh::read_mesh<3>(path, options));
            throw py::value_error("dim is " + std::to_string(dim) + "; 2 and 3 are allowed");
        },
        "path"_a, "dim"_a, "non_planar"_a = "fail", "planarity_tolerance"_a = MeshOptions{}.planarity_tolerance,
        docs::read_mesh);
    module.def(
        "disc",
        [](const std::array<double, 2>& centre, double radius, double size, int variant, const std::string& name) {
            return mesh::disc(
                {.centre = Vector<2>(centre.data()), .radius = radius, .size = size, .variant = variant, .name = name});
        },
        "centre"_a = std::array<double, 2>{}, "radius"_a = 1.0, "size"_a = 0.1, "variant"_a = 0, "name"_a = "disc",
        docs::disc);
    module.def(
        "cylinder",
        [](const std::array<double, 3>& centre, double radius, double length, double size, int variant,
           const std::string& name) {
            return mesh::cylinder({.centre = Vector<3>(centre.data()),
                                   .radius = radius,
                                   .length = length,
                                   .size = size,
                                   .variant = variant,
                                   .name = name});
        },
        "centre"_a = std::array<double, 3>{}, "radius"_a = 1.0, "length"_a = 1.0, "size"_a = 0.1, "variant"_a = 0,
        "name"_a = "cylinder", docs::cylinder);
    module.def(
        "sphere",
        [](const std::array<double, 3>& centre, double radius, double size, int variant, const std::string& name) {
            return mesh::sphere(
                {.centre = Vector<3>(centre.data()), .radius = radius, .size = size, .variant = variant, .name = name});
        },
        "centre"_a = std::array<double, 3>{}, "radius"_a = 1.0, "size"_a = 0.1, "variant"_a = 0, "name"_a = "sphere",
        docs::sphere);
}

}  // namespace abut::python
