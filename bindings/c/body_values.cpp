#include "body_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/given_value.hpp"
#include "abut/base/unit.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/material/material_numbers.hpp"

namespace abut::c_layer {
namespace {

const solid::MaterialNumber& number_called(const std::string& key) {
    return entry_called(solid::material_numbers, &solid::MaterialNumber::name, "a number of a body", key);
}

solid::Kinematics kinematics_called(const std::string& text) {
    const auto& all = solid::kinematics_properties;
    const auto& found = entry_called(all, &solid::KinematicsProperties::name, "kinematics", text);
    return static_cast<solid::Kinematics>(&found - all.data());
}

double with_unit(const solid::MaterialNumber& number, const std::string& text) {
    const std::optional<ValueWithUnit> parts = value_with_unit(text);
    if (!parts || parts->is_formula)
        throw BadInput(std::string(number.name) + " is '" + text +
                       "', which is no number with a unit. Give one such as \"210 GPa\", or a number without.");
    return converted(parts->value, unit_for(parts->unit, number.limits.unit), unit_of(number.limits.unit));
}

}  // namespace

void set_number(BodyValues& values, const std::string& key, double value) {
    const solid::MaterialNumber& number = number_called(key);
    require_allowed(key, number.limits, value);
    number.at.in(values.material) = value;
}

void set_text(BodyValues& values, const std::string& key, const std::string& text) {
    if (key == "law") {
        values.material.law = choice_called(solid::material_law_words, key, text);
    } else if (key == "kinematics") {
        values.kinematics = kinematics_called(text);
    } else if (key == "material") {
        values.known = &solid::material_called(text);
        for (const auto member : {&solid::Material::young, &solid::Material::poisson, &solid::Material::density})
            values.material.*member = values.known->material.*member;
    } else {
        set_number(values, key, with_unit(number_called(key), text));
    }
}

void set_numbers(BodyValues& values, const std::string& key, std::span<const double> numbers) {
    const auto require = [&](bool is_met, const char* what) {
        if (!is_met)
            throw BadInput(key + " has " + std::to_string(numbers.size()) + " numbers; it takes " + what + ".",
                           {.value = static_cast<double>(numbers.size())});
    };
    if (key == "axis_1" || key == "axis_2") {
        require(numbers.size() == 3, "3");
        solid::Orthotropy& axes = values.material.orthotropic;
        std::ranges::copy(numbers, (key == "axis_1" ? axes.axis_1 : axes.axis_2).begin());
    } else if (key == "hardening_table") {
        require(!numbers.empty() && numbers.size() % 2 == 0, "rows of two, plastic strain and stress");
        values.material.flow.table.clear();
        for (std::size_t i = 0; i < numbers.size(); i += 2)
            values.material.flow.table.push_back({numbers[i], numbers[i + 1]});
    } else {
        throw BadInput("a body has no list '" + key + "'. There are 'axis_1', 'axis_2' and 'hardening_table'.");
    }
}

solid::Material material_of(const BodyValues& values) {
    solid::Material material = values.material;
    if (material.law != solid::MaterialLaw::j2 || material.flow.yield_stress > 0.0) return material;
    if (!material.flow.table.empty())
        material.flow.yield_stress = material.flow.table.front().stress;
    else if (values.known != nullptr)
        solid::take_flow(material, *values.known);
    return material;
}

}  // namespace abut::c_layer
