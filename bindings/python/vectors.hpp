#pragma once
// Arrays of numpy of shape (n, Dim) and vectors of the library: the same memory.
#include <span>
#include <string>
#include <vector>

#include "abut/base/vector.hpp"
#include "arrays.hpp"

namespace abut::python {

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
    return Vector<Dim>(values.data());
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
