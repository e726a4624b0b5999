// The Python module `abut._solid`, of which abut.solid and abut.run are made: meshes, solids and runs for numpy.
#include <pybind11/pybind11.h>

#include <cctype>
#include <string>
#include <string_view>

#include "abut.h"
#include "abut/base/error.hpp"
#include "arrays.hpp"
#include "materials.hpp"
#include "meshes.hpp"
#include "runs.hpp"

namespace py = pybind11;

namespace {

const char* class_of(abut::ErrorKind kind) {
    switch (kind) {
        case abut::ErrorKind::bad_input:
            return "BadInput";
        case abut::ErrorKind::misuse:
            return "Misuse";
        case abut::ErrorKind::diverged:
            return "Diverged";
        case abut::ErrorKind::too_deep:
            return "TooDeep";
        case abut::ErrorKind::limit_exceeded:
            return "LimitExceeded";
    }
    return "InternalError";
}

static_assert(static_cast<int>(abut::ErrorKind::bad_input) + 1 == ABUT_BAD_INPUT &&
              static_cast<int>(abut::ErrorKind::limit_exceeded) + 1 == ABUT_LIMIT_EXCEEDED);

/// An option as it is written in Python: --contact-margin is contact_margin, and --lab gauge is gauge.
std::string in_python(const std::string& text) {
    constexpr std::string_view laboratory = "--lab ";
    std::string changed;
    for (std::size_t i = 0; i < text.size();) {
        if (text.compare(i, laboratory.size(), laboratory) == 0) {
            i += laboratory.size();
            continue;
        }
        const bool is_option = text.compare(i, 2, "--") == 0 && i + 2 < text.size() && std::islower(text[i + 2]) != 0;
        if (!is_option) {
            changed += text[i++];
            continue;
        }
        for (i += 2; i < text.size() && (std::islower(text[i]) != 0 || text[i] == '-'); ++i)
            changed += text[i] == '-' ? '_' : text[i];
    }
    return changed;
}

/// The exceptions of the package `abut`, with their facts.
void raise(const abut::Error& error) {
    const py::object kind = py::module_::import("abut").attr(class_of(error.kind()));
    const py::object instance = kind(abut::python::text_of(in_python(error.what())));
    instance.attr("status") = static_cast<int>(error.kind()) + 1;
    instance.attr("face_1") = error.facts().face_1;
    instance.attr("face_2") = error.facts().face_2;
    instance.attr("cell") = error.facts().cell;
    instance.attr("value") = error.facts().value;
    instance.attr("allowed") = error.facts().allowed;
    PyErr_SetObject(kind.ptr(), instance.ptr());
}

}  // namespace

PYBIND11_MODULE(_solid, module) {
    module.doc() = "Meshes, solids of linear elasticity in contact, and their runs. docs/languages.md walks through it.";
    py::register_local_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const abut::Error& error) {
            raise(error);
        }
    });
    abut::python::add_meshes(module);
    abut::python::add_materials(module);
    abut::python::add_runs(module);
    abut::python::add_memm(module);
}
