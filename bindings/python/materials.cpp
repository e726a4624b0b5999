#include "materials.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/given_value.hpp"
#include "abut/base/nearest_word.hpp"
#include "abut/solid/material/known_materials.hpp"
#include "abut/solid/material/material_numbers.hpp"
#include "docstrings.hpp"
#include "numbers.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace abut::python {
namespace {

/// Rows [plastic strain, stress], stresses also as texts with units.
std::vector<solid::HardeningPoint> hardening_table(const py::handle& rows) {
    std::vector<solid::HardeningPoint> table;
    try {
        for (const py::handle& row : rows) {
            const auto [strain, stress] = py::cast<std::pair<double, py::object>>(row);
            table.push_back({strain, number_in("Pa", stress)});
        }
    } catch (const py::cast_error&) {
        throw py::type_error("hardening_table cannot be " + std::string(py::str(py::repr(rows))) +
                             "; it is a list of rows [plastic strain, stress]");
    }
    return table;
}

/// " Did you mean 'young'?"; empty: no value is called nearly so.
std::string hint(const std::string& word) {
    std::vector<std::string> known{"law", "hardening_table", "axis_1", "axis_2"};
    for (const solid::MaterialNumber& number : solid::material_numbers) known.emplace_back(number.name);
    const auto nearest = nearest_word(word, known);
    return nearest ? " Did you mean '" + *nearest + "'?" : "";
}

solid::Material material_of(const std::optional<std::string>& name, const py::kwargs& values) {
    const solid::KnownMaterial* known = name ? &solid::material_called(*name) : nullptr;
    solid::Material material = known ? known->material : solid::Material{};
    for (const auto& [key, value] : values) {
        const auto word = py::cast<std::string>(key);
        const auto number = std::ranges::find(solid::material_numbers, word, &solid::MaterialNumber::name);
        if (word == "law")
            material.law = choice_called(solid::material_law_words, "law", py::cast<std::string>(value));
        else if (word == "hardening_table")
            material.flow.table = hardening_table(value);
        else if (word == "axis_1")
            material.orthotropic.axis_1 = py::cast<std::array<double, 3>>(value);
        else if (word == "axis_2")
            material.orthotropic.axis_2 = py::cast<std::array<double, 3>>(value);
        else if (number != solid::material_numbers.end())
            number->at.in(material) = number_of_argument(number->name, number->limits.unit, value);
        else
            throw py::type_error("Material has no value '" + word + "'." + hint(word));
    }
    if (values.contains("yield_stress")) return material;
    if (!material.flow.table.empty())
        material.flow.yield_stress = material.flow.table.front().stress;
    else if (known && material.law == solid::MaterialLaw::j2)
        solid::take_flow(material, *known);
    return material;
}

py::dict all_known() {
    py::dict all;
    for (const solid::KnownMaterial& known : solid::known_materials())
        all[py::str(known.name)] = py::dict("young"_a = known.material.young, "poisson"_a = known.material.poisson,
                                            "density"_a = known.material.density, "yield_stress"_a = known.flow.yield_stress,
                                            "source"_a = known.source);
    return all;
}

/// With a capital in front and a full stop.
std::string sentence(std::string text) {
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text + ".";
}

}  // namespace

void add_materials(py::module_& module) {
    py::class_<solid::Material> of_material(module, "Material", docs::material);
    of_material.def(py::init(&material_of), "material"_a = py::none());
    for (const solid::MaterialNumber& number : solid::material_numbers) {
        const std::string unit = number.limits.unit;
        const std::string doc = sentence(number.help + (unit.empty() ? "" : " [" + unit + "]"));
        of_material.def_property(
            number.name, number.at.of,
            [&number](solid::Material& material, const py::object& value) {
                number.at.in(material) = number_of_argument(number.name, number.limits.unit, value);
            },
            doc.c_str());
    }
    of_material.def_property(
        "law", [](const solid::Material& material) { return word_of(solid::material_law_words, material.law); },
        [](solid::Material& material, const std::string& law) {
            material.law = choice_called(solid::material_law_words, "law", law);
        },
        "Law beyond isotropic elasticity of small strains.\n\n"
        "'st_venant_kirchhoff', of finite bodies 'neo_hookean' or 'mooney_rivlin', or 'j2', which yields, or 'orthotropic', "
        "which has other moduli along axes of its own.");
    const auto axis = [&](const char* name, std::array<double, 3> solid::Orthotropy::*member, const char* doc) {
        of_material.def_property(
            name, [member](const solid::Material& material) { return material.orthotropic.*member; },
            [member](solid::Material& material, const std::array<double, 3>& given) {
                material.orthotropic.*member = given;
            },
            doc);
    };
    axis("axis_1", &solid::Orthotropy::axis_1, "Direction of axis 1 at rest (3,), of any length, of orthotropic in 3D.");
    axis("axis_2", &solid::Orthotropy::axis_2,
         "Direction of axis 2 (3,), at a right angle to axis 1, of orthotropic in 3D.");
    of_material.def_property(
        "hardening_table",
        [](const solid::Material& material) {
            std::vector<std::pair<double, double>> rows;
            for (const auto& [strain, stress] : material.flow.table) rows.emplace_back(strain, stress);
            return rows;
        },
        [](solid::Material& material, const py::object& rows) {
            material.flow.table = hardening_table(rows);
            if (!material.flow.table.empty()) material.flow.yield_stress = material.flow.table.front().stress;
        },
        "Rows [plastic strain, stress at which it flows there [Pa]], of j2.\n\n"
        "It takes the place of yield_stress and of what rises. Strains begin at 0; stresses are straight between rows, and "
        "constant behind the last.");
    module.def("known_materials", &all_known, docs::known_materials);
}

}  // namespace abut::python
