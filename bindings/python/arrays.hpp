#pragma once
// Arrays of numpy as the library takes them.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abut::python {

namespace py = pybind11;

template <class Value>
using Packed = py::array_t<Value, py::array::c_style | py::array::forcecast>;

/// A text of the library: bytes that are not UTF-8, as names in files may have, become U+FFFD each.
inline py::str text_of(std::string_view text) {
    PyObject* const decoded = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
    if (decoded == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(decoded);
}
inline py::list texts_of(const std::vector<std::string>& texts) {
    py::list list;
    for (const std::string& text : texts) list.append(text_of(text));
    return list;
}

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
