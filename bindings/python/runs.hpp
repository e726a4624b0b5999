#pragma once
#include <pybind11/pybind11.h>

namespace abut::python {

/// simulate, Memm2D, Memm3D and what they give back.
void add_runs(pybind11::module_& module);

}  // namespace abut::python
