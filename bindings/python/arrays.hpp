#pragma once
// Arrays of numpy as the library takes them.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace abut::python {

namespace py = pybind11;

template <class Value>
using Packed = py::array_t<Value, py::array::c_style | py::array::forcecast>;

/// A packed copy; no number is rounded or wrapped.
inline Packed<std::int32_t> integers_of(const py::object& given, const std::string& name) {
    const py::array array = py::array::ensure(given);
    const char kind = array ? array.dtype().kind() : '?';
    if (kind != 'i' && kind != 'u' && !(kind == 'f' && array.size() == 0)) {  // an empty list has no type
        PyErr_Clear();
        throw py::type_error(name + " must be an array of integers");
    }
    if (array.size() > 0) {
        const auto largest = py::cast<double>(array.attr("max")()), least = py::cast<double>(array.attr("min")());
        if (largest > std::numeric_limits<std::int32_t>::max() || least < std::numeric_limits<std::int32_t>::min())
            throw py::value_error(name + " must be within -2147483648 and 2147483647");
    }
    return Packed<std::int32_t>::ensure(array);
}

/// A copy, of shape (n).
template <class Value>
py::array_t<Value> copy_of(std::span<const Value> values) {
    return py::array_t<Value>(static_cast<py::ssize_t>(values.size()), values.data());
}
template <class Value>
py::array_t<Value> copy_of(const std::vector<Value>& values) {
    return copy_of(std::span<const Value>(values));
}

}  // namespace abut::python
