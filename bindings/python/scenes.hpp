#pragma once
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/input/given_meshes.hpp"
#include "abut/input/scene_file.hpp"
#include "abut/run/options.hpp"
#include "abut/run/scene.hpp"
#include "vectors.hpp"

namespace abut::python {

/// Parts of a scene, in the words of Python.
template <int Dim>
struct SceneArguments {
    const mesh::Mesh<Dim>& mesh;
    std::vector<solid::Material> materials;
    py::object velocity;
    py::object acceleration;
    std::map<std::string, py::object> held;
    std::vector<std::string> rollers;
    std::map<std::string, py::object> traction;
    std::map<std::string, py::object> temperature_rise;
    py::object displacement;  // functions of a position, or None
    py::object added_velocity;
    bool contact;
    std::optional<double> energy_scale;
};

/// A scene in the words of TOML.
struct SceneSource {
    std::filesystem::path file;       ///< with `toml` what messages call it, and from where its paths begin
    std::optional<std::string> toml;  ///< its text; none: that of the file
    py::dict given_meshes;            ///< that are no files: by the text that the key `mesh` of a body has
    std::vector<std::string> set;     ///< "bodies.left.density=2"

    [[nodiscard]] std::shared_ptr<const input::GivenMeshes> meshes() const {
        auto meshes = std::make_shared<input::GivenMeshes>();
        for (const auto& [text, mesh] : given_meshes) {
            if (py::isinstance<mesh::Mesh<2>>(mesh))
                meshes->plane.emplace(py::cast<std::string>(text), py::cast<const mesh::Mesh<2>&>(mesh));
            else
                meshes->space.emplace(py::cast<std::string>(text), py::cast<const mesh::Mesh<3>&>(mesh));
        }
        return meshes;
    }
};

/// A scene in TOML with the options of Python above its own. Without `out` it writes nothing, whatever the scene says.
/// `least_steps`: of one that does not say when it ends.
[[nodiscard]] input::SceneFile scene_file(const SceneSource& source, const py::dict& given, int least_steps);

/// An object that may be copied and dropped without the interpreter's lock.
inline std::shared_ptr<py::object> kept(const py::object& object) {
    return {new py::object(object), [](py::object* held) {
                const py::gil_scoped_acquire lock;
                delete held;
            }};
}

/// A function of Python as a field; empty for None. It may be called, copied and dropped without the interpreter's lock.
template <int Dim>
std::function<Vector<Dim>(const Vector<Dim>&)> field_of(const py::object& function, const char* name) {
    if (function.is_none()) return {};
    return [held = kept(function), name](const Vector<Dim>& x) {
        const py::gil_scoped_acquire lock;
        return vector_of<Dim>((*held)(py::array_t<double>(py::ssize_t{Dim}, x.data())), name);
    };
}

/// A number, or a function of time and position that is asked in each step.
template <int Dim>
solid::TemperatureRise<Dim> temperature_of(const py::object& given, const std::string& name) {
    if (PyCallable_Check(given.ptr()) == 0) {
        try {
            return {.value = [value = py::cast<double>(given)](double, const Vector<Dim>&) { return value; }};
        } catch (const py::cast_error&) {
            throw py::type_error(name + " is a number [K] or a function of t and x, not " +
                                 std::string(py::str(py::repr(given))));
        }
    }
    return {
        .value =
            [function = kept(given), name](double time, const Vector<Dim>& x) {
                const py::gil_scoped_acquire lock;
                const py::object value = (*function)(time, py::array_t<double>(py::ssize_t{Dim}, x.data()));
                try {
                    return py::cast<double>(value);
                } catch (const py::cast_error&) {
                    throw py::type_error(name + " gave " + std::string(py::str(py::repr(value))) + ", which is no number");
                }
            },
        .varies = true};
}

template <int Dim>
std::vector<solid::TemperatureRise<Dim>> temperatures_of(const std::map<std::string, py::object>& given,
                                                         const mesh::Mesh<Dim>& mesh) {
    std::vector<solid::TemperatureRise<Dim>> rises;
    if (!given.empty()) rises.resize(mesh.body_names.size());
    for (const auto& [body, value] : given) {
        const std::string name = "temperature_rise['" + body + "']";
        const auto found = std::ranges::find(mesh.body_names, body);
        if (found == mesh.body_names.end()) {
            std::string all;
            for (const std::string& one : mesh.body_names) all += (all.empty() ? "'" : ", '") + one + "'";
            throw BadInput(mesh.name + ": " + name + ": there is no body of this name; there are " + all + ".");
        }
        rises[static_cast<std::size_t>(found - mesh.body_names.begin())] = temperature_of<Dim>(value, name);
    }
    return rises;
}

template <int Dim>
run::Scene<Dim> scene_of(const SceneArguments<Dim>& given) {
    if (const mesh::Mesh<Dim>& mesh = given.mesh; !mesh.report.joined_bodies.empty()) {
        const auto& [body_1, body_2] = mesh.report.joined_bodies.front();
        throw BadInput(mesh.name + ": bodies '" + mesh.body_names[static_cast<std::size_t>(body_1)] + "' and '" +
                       mesh.body_names[static_cast<std::size_t>(body_2)] +
                       "' share points, and these arguments have no bonds. Give each its own points, or run the mesh in a "
                       "scene (text or a file), which bonds them.");
    }
    run::Scene<Dim> scene;
    scene.mesh = given.mesh;
    scene.solid.materials = given.materials;
    scene.velocity = vectors_of<Dim>(given.velocity, "velocity");
    if (!given.acceleration.is_none()) scene.solid.acceleration = vectors_of<Dim>(given.acceleration, "acceleration");
    for (const auto& [group, value] : given.held)
        scene.solid.boundary.dirichlet.push_back(
            {.group = group, .value = vector_of<Dim>(value, ("held['" + group + "']").c_str())});
    for (const std::string& group : given.rollers)
        scene.solid.boundary.dirichlet.push_back({.group = group, .constraint = solid::Constraint::normal});
    for (const auto& [group, value] : given.traction)
        scene.solid.boundary.traction.push_back(
            {.group = group, .value = vector_of<Dim>(value, ("traction['" + group + "']").c_str())});
    scene.solid.temperature_rise = temperatures_of<Dim>(given.temperature_rise, given.mesh);
    scene.displacement = field_of<Dim>(given.displacement, "displacement(x)");
    scene.added_velocity = field_of<Dim>(given.added_velocity, "added_velocity(x)");
    scene.contact = given.contact;
    if (given.energy_scale) scene.energy_scale = {"E0", *given.energy_scale};
    return scene;
}

/// Options of a run by the names of the command line, - written as _. Throws for a name or a word that is not known.
run::RunOptions options_of(const py::dict& given);
/// Takes such options above what `options` has; of two that exclude each other that one goes.
void take_options(const py::dict& given, run::RunOptions& options);
/// All of them, one per line, with words or unit and default.
std::string option_text();

}  // namespace abut::python
