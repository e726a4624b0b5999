#pragma once
#include <pybind11/pybind11.h>

#include "abut/mesh/mesh.hpp"
#include "arrays.hpp"

namespace abut::python {

/// Mesh2D, Mesh3D and the functions that make them.
void add_meshes(pybind11::module_& module);

/// Mean over the cells around each point.
template <int Dim>
[[nodiscard]] py::array_t<double> at_points(const mesh::Mesh<Dim>& mesh, const Packed<double>& values);

}  // namespace abut::python
