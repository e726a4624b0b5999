#pragma once
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/unit.hpp"

namespace abut::python {

/// A number, or a text with a unit such as "210 GPa", in `unit`; empty: none. Throws py::cast_error for what is
/// neither, BadInput for a unit of another dimension.
inline double number_in(const std::string& unit, const pybind11::handle& value) {
    if (!pybind11::isinstance<pybind11::str>(value)) return pybind11::cast<double>(value);
    const auto parts = value_with_unit(pybind11::cast<std::string>(value));
    if (!parts || parts->is_formula) throw pybind11::cast_error("no number, nor one with a unit");
    return converted(parts->value, unit_for(parts->unit, unit), unit_of(unit));
}

/// As `number_in`, of an argument, which what is thrown names: TypeError or BadInput.
inline double number_of_argument(const std::string& name, const std::string& unit, const pybind11::handle& value) {
    try {
        return number_in(unit, value);
    } catch (const pybind11::cast_error&) {
        throw pybind11::type_error(name + " cannot be " + std::string(pybind11::str(pybind11::repr(value))));
    } catch (const BadInput& error) {
        throw BadInput(name + " is " + std::string(pybind11::str(pybind11::repr(value))) + ": " + error.what());
    }
}

/// Numbers of a sequence, which is no text, as `number_in` takes each.
inline std::vector<double> numbers_in(const std::string& unit, const pybind11::handle& value) {
    if (pybind11::isinstance<pybind11::str>(value) || !pybind11::isinstance<pybind11::sequence>(value))
        throw pybind11::cast_error("no list of numbers");
    std::vector<double> numbers;
    for (const pybind11::handle& one : pybind11::cast<pybind11::sequence>(value)) numbers.push_back(number_in(unit, one));
    return numbers;
}

}  // namespace abut::python
