#pragma once
// Private to the C layer.
#include <span>
#include <string>

#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/known_materials.hpp"

namespace abut::c_layer {

/// Material and kinematics of a body, as a host names them.
struct BodyValues {
    solid::Material material;
    solid::Kinematics kinematics = solid::Kinematics::small;
    const solid::KnownMaterial* known = nullptr;  ///< that was named last
};

// By the names of scenes. All throw BadInput for a name that is not known, and for a value that it cannot have.

/// A number of solid::material_numbers, in SI.
void set_number(BodyValues& values, const std::string& key, double value);
/// "material", "law", "kinematics", or a number with a unit.
void set_text(BodyValues& values, const std::string& key, const std::string& text);
/// "axis_1", "axis_2" (3), "hardening_table" (rows of plastic strain and stress).
void set_numbers(BodyValues& values, const std::string& key, std::span<const double> numbers);

/// With the stress where flow begins of the table of hardening or, where it has no other, of the material that was named.
[[nodiscard]] solid::Material material_of(const BodyValues& values);

}  // namespace abut::c_layer
