#pragma once
// Arrays of numpy and of the library. Shape (n, Dim) and n vectors are the same memory.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/vector.hpp"

namespace abut::python {

namespace py = pybind11;

template <class Value>
using Packed = py::array_t<Value, py::array::c_style | py::array::forcecast>;

/// A copy, of shape (n).
template <class Value>
py::array_t<Value> copy_of(std::span<const Value> values) {
    return py::array_t<Value>(static_cast<py::ssize_t>(values.size()), values.data());
}
template <class Value>
py::array_t<Value> copy_of(const std::vector<Value>& values) {
    return copy_of(std::span<const Value>(values));
}

/// A copy, of shape (n, Dim).
template <int Dim>
py::array_t<double> copy_of_vectors(std::span<const Vector<Dim>> vectors) {
    return py::array_t<double>({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{Dim}},
                               reinterpret_cast<const double*>(vectors.data()));
}

/// Anything that is Dim numbers.
template <int Dim>
Vector<Dim> vector_of(const py::handle& given, const char* name) {
    const auto values = Packed<double>::ensure(given);
    if (!values || values.ndim() != 1 || values.shape(0) != Dim) {
        PyErr_Clear();
        throw py::value_error(std::string(name) + " must be " + std::to_string(Dim) + " numbers");
    }
    return Eigen::Map<const Vector<Dim>>(values.data());
}

/// Anything of shape (n, Dim).
template <int Dim>
std::vector<Vector<Dim>> vectors_of(const py::handle& given, const char* name) {
    const auto values = Packed<double>::ensure(given);
    if (!values || values.ndim() != 2 || values.shape(1) != Dim) {
        PyErr_Clear();
        throw py::value_error(std::string(name) + " must have the shape (n, " + std::to_string(Dim) + ")");
    }
    const auto* first = reinterpret_cast<const Vector<Dim>*>(values.data());
    return {first, first + values.shape(0)};
}

}  // namespace abut::python
