#pragma once
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "abut/run/options.hpp"
#include "abut/run/scene.hpp"
#include "arrays.hpp"

namespace abut::python {

/// What a scene is made of, in the words of Python.
template <int Dim>
struct SceneArguments {
    using OfPosition = std::function<std::array<double, Dim>(const std::array<double, Dim>&)>;

    const mesh::Mesh<Dim>& mesh;
    std::vector<solid::Material> materials;
    py::object velocity;
    py::object acceleration;
    std::map<std::string, py::object> held;
    std::vector<std::string> rollers;
    std::map<std::string, py::object> traction;
    OfPosition displacement;
    OfPosition added_velocity;
    bool contact;
    std::optional<double> energy_scale;
};

template <int Dim>
run::Scene<Dim> scene_of(const SceneArguments<Dim>& given) {
    const auto as_field = [](const typename SceneArguments<Dim>::OfPosition& of_position) {
        std::function<Vector<Dim>(const Vector<Dim>&)> field;
        if (of_position)
            field = [of_position](const Vector<Dim>& x) {
                std::array<double, Dim> position;
                std::copy_n(x.data(), Dim, position.begin());
                return Vector<Dim>(of_position(position).data());
            };
        return field;
    };
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
    scene.displacement = as_field(given.displacement);
    scene.added_velocity = as_field(given.added_velocity);
    scene.contact = given.contact;
    if (given.energy_scale) scene.energy_scale = {"E0", *given.energy_scale};
    return scene;
}

/// Options of a run by the names of the command line, - written as _. Throws for a name or a word that is not known.
run::RunOptions options_of(const py::dict& given);

}  // namespace abut::python
