#pragma once
// Arrays of numpy as abut.h sees them, callbacks, and the exceptions of the package.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "abut.h"
#include "arrays.hpp"

namespace abut::python {

using Doubles = py::array_t<double>;

/// One class of exceptions per status; all carry the facts as attributes.
struct Exceptions {
    py::object base, bad_input, misuse, diverged, too_deep, limit_exceeded, cancelled, internal;
    [[nodiscard]] const py::object& of(int status) const {
        switch (status) {
            case ABUT_BAD_INPUT:
                return bad_input;
            case ABUT_MISUSE:
                return misuse;
            case ABUT_DIVERGED:
                return diverged;
            case ABUT_TOO_DEEP:
                return too_deep;
            case ABUT_LIMIT_EXCEEDED:
                return limit_exceeded;
            case ABUT_CANCELLED:
                return cancelled;
            default:
                return internal;
        }
    }
};
inline Exceptions* exceptions = nullptr;  // made with the module, kept until the interpreter ends

/// Throws what went wrong as an exception of Python.
inline void require_ok(int status, const abut_error& error) {
    if (status == ABUT_OK) return;
    if (PyErr_Occurred() != nullptr) throw py::error_already_set();  // of a callback
    const py::object instance = exceptions->of(status)(text_of(error.message));
    instance.attr("status") = status;
    instance.attr("face_1") = error.face_1;
    instance.attr("face_2") = error.face_2;
    instance.attr("value") = error.value;
    instance.attr("allowed") = error.allowed;
    PyErr_SetObject(exceptions->of(status).ptr(), instance.ptr());
    throw py::error_already_set();
}

/// Calls without the interpreter's lock.
template <class Call>
inline void call_unlocked(const Call& call) {
    abut_error error = ABUT_ERROR_INIT;
    int status;
    {
        const py::gil_scoped_release release;
        status = call(&error);
    }
    require_ok(status, error);
}

/// A view of an array (n, dim) of float64, not a copy.
inline abut_array view_of(const py::array& array, int dim, const char* name) {
    if (!py::isinstance<Doubles>(array))
        throw py::type_error(std::string(name) + " must be an array of float64; it is one of " +
                             std::string(py::str(array.dtype())) + ". Convert it: a copy would hide what contact writes.");
    if (array.ndim() != 2 || array.shape(1) != dim)
        throw py::value_error(std::string(name) + " must have the shape (n_nodes, " + std::to_string(dim) + ")");
    for (int axis = 0; axis < 2; ++axis)
        if (array.strides(axis) % static_cast<py::ssize_t>(sizeof(double)) != 0)
            throw py::value_error(std::string(name) + ": its strides are no whole numbers of float64");
    const auto size = static_cast<py::ssize_t>(sizeof(double));
    return {const_cast<double*>(static_cast<const double*>(array.data())), array.shape(0), array.strides(0) / size,
            array.strides(1) / size};
}

inline abut_array writable_view_of(const py::object& array, int dim, const char* name) {
    if (array.is_none()) return {nullptr, 0, 0, 0};
    if (!py::isinstance<py::array>(array))
        throw py::type_error(std::string(name) + " must be an array of numpy: the forces are added to it where it lies");
    const auto doubles = py::reinterpret_borrow<py::array>(array);
    if (!doubles.writeable()) throw py::value_error(std::string(name) + " is read-only");
    return view_of(doubles, dim, name);
}

/// Copies of the arrays of the faces, packed: they are read once.
struct Faces {
    Faces(const py::object& corners, const py::object& of_body, const Packed<double>& depths,
          const Packed<double>& stiffnesses, const py::object& of_offsets, const py::object& shear_stiffnesses, int dim)
        : Faces(corners, of_body, of_offsets, dim) {
        depth = depths;
        stiffness = stiffnesses;
        if (!shear_stiffnesses.is_none()) {
            shear_stiffness = py::cast<Packed<double>>(shear_stiffnesses);
            if (shear_stiffness.size() != stiffness.size())
                throw py::value_error("shear_stiffness has " + std::to_string(shear_stiffness.size()) + " entries for " +
                                      std::to_string(stiffness.size()) + " bodies in stiffness; give one each");
            view.shear_stiffness = shear_stiffness.data();
        }
        if (depth.size() != body.size())
            throw py::value_error("depth has " + std::to_string(depth.size()) + " entries for " +
                                  std::to_string(body.size()) + " faces in body; give one each");
        view.depth = depth.data();
        view.stiffness = stiffness.data();
        view.n_bodies = stiffness.size();
    }
    /// Without depths and stiffnesses: for overlaps.
    Faces(const py::object& corners, const py::object& of_body, const py::object& of_offsets, int dim)
        : nodes(integers_of(corners, "faces")), body(integers_of(of_body, "body")) {
        view.n_faces = body.size();
        if (!of_offsets.is_none()) {
            offsets = integers_of(of_offsets, "offsets");
            if (offsets.size() != body.size() + 1)
                throw py::value_error("offsets must have one entry per face and one more");
            view.offsets = offsets.data();
        } else if (nodes.ndim() == 2 && nodes.shape(1) != dim) {
            std::vector<std::int32_t> regular;
            for (py::ssize_t i = 0; i <= nodes.shape(0); ++i)
                regular.push_back(static_cast<std::int32_t>(i * nodes.shape(1)));
            offsets = Packed<std::int32_t>(static_cast<py::ssize_t>(regular.size()), regular.data());
            view.offsets = offsets.data();
        }
        if (nodes.ndim() == 2 && nodes.shape(0) != body.size())
            throw py::value_error("body has " + std::to_string(body.size()) + " entries for " +
                                  std::to_string(nodes.shape(0)) + " faces; give one each");
        view.nodes = nodes.data();
        view.n_nodes = nodes.size();
        view.body = body.data();
    }

    Packed<std::int32_t> nodes, body, offsets;
    Packed<double> depth, stiffness, shear_stiffness;
    abut_faces view = ABUT_FACES_INIT;
};

/// Functions of Python behind callbacks of C; None for those that there are not.
struct Callbacks {
    py::object wanted, cancel, log, law_of, own_coefficient, interferes;
    std::optional<py::error_already_set> of_log;  // raised once the call is over, which has happened all the same
    std::vector<std::string> untold;              // warnings for which there is no log

    void put_into(abut_options& options) {
        options.user = this;
        if (!wanted.is_none()) options.wanted = ask_wanted;
        if (!cancel.is_none()) options.cancel = ask_cancel;
        if (!law_of.is_none()) options.law_of = ask_law;
        if (!own_coefficient.is_none()) options.own_coefficient = ask_coefficient;
        if (!interferes.is_none()) options.interferes = ask_interferes;
        options.log = log.is_none() ? keep : tell;
    }
    /// Raises what the log raised; without a log, tells by warnings.warn, which raises where the host wants that.
    void after_call() {
        if (of_log) throw *std::exchange(of_log, std::nullopt);
        for (const std::string& text : std::exchange(untold, {}))
            if (PyErr_WarnEx(PyExc_RuntimeWarning, ("abut: " + text).c_str(), 1) < 0) throw py::error_already_set();
    }

private:
    /// Asks the function, and returns what `read` makes of the answer; an exception ends the call, and is raised by it.
    template <class Read, class... Arguments>
    static auto ask(const Read& read, const py::object& function, Arguments... arguments) {
        const py::gil_scoped_acquire acquire;
        try {
            return read(function(arguments...));
        } catch (py::error_already_set& error) {
            error.restore();
        } catch (const py::cast_error&) {
            PyErr_SetString(PyExc_TypeError, "a callback of the contact has not given a number");
        }
        throw std::exception();
    }
    static int is_true(const py::object& answer) {
        const int truth = PyObject_IsTrue(answer.ptr());
        if (truth < 0) throw py::error_already_set();
        return truth;
    }
    template <class Value>
    static Value number(const py::object& answer) {
        return py::cast<Value>(answer);
    }
    static int ask_wanted(std::int32_t face_1, std::int32_t face_2, void* user) {
        return ask(is_true, static_cast<Callbacks*>(user)->wanted, face_1, face_2);
    }
    static int ask_interferes(std::int32_t face_1, std::int32_t face_2, void* user) {
        return ask(is_true, static_cast<Callbacks*>(user)->interferes, face_1, face_2);
    }
    static int ask_cancel(void* user) { return ask(is_true, static_cast<Callbacks*>(user)->cancel); }
    static std::int32_t ask_law(std::int32_t face_1, std::int32_t face_2, void* user) {
        return ask(number<std::int32_t>, static_cast<Callbacks*>(user)->law_of, face_1, face_2);
    }
    static double ask_coefficient(double speed, double slid, double pressure, void* user) {
        return ask(number<double>, static_cast<Callbacks*>(user)->own_coefficient, speed, slid, pressure);
    }
    static void keep(int severity, const char* text, void* user) {
        const py::gil_scoped_acquire acquire;
        if (severity >= ABUT_WARNING) static_cast<Callbacks*>(user)->untold.emplace_back(text);
    }
    static void tell(int severity, const char* text, void* user) {
        const py::gil_scoped_acquire acquire;
        auto& callbacks = *static_cast<Callbacks*>(user);
        try {
            callbacks.log(severity, text_of(text));
        } catch (py::error_already_set& error) {
            if (!callbacks.of_log) callbacks.of_log = error;
        }
    }
};

inline int dimension_of(const py::array& nodes) {
    if (nodes.ndim() != 2 || (nodes.shape(1) != 2 && nodes.shape(1) != 3))
        throw py::value_error("nodes must have the shape (n_nodes, 2) or (n_nodes, 3)");
    return static_cast<int>(nodes.shape(1));
}

}  // namespace abut::python
