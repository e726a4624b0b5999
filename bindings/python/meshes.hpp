#pragma once
#include <pybind11/pybind11.h>

namespace abut::python {

/// Mesh2D, Mesh3D and the functions that make them.
void add_meshes(pybind11::module_& module);

}  // namespace abut::python
