#pragma once
#include <pybind11/pybind11.h>

namespace abut::python {

/// Material, and those that are known by their names.
void add_materials(pybind11::module_& module);

}  // namespace abut::python
