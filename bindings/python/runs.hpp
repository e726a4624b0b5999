#pragma once
#include <pybind11/pybind11.h>

namespace abut::python {

/// `simulate` and runs of scenes, and what they give back.
void add_runs(pybind11::module_& module);
/// Memm2D, Memm3D and their clocks: runs that take steps when asked.
void add_memm(pybind11::module_& module);

}  // namespace abut::python
