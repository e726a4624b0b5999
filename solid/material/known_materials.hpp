#pragma once
#include <string>
#include <vector>

#include "abut/solid/material/material.hpp"

namespace abut::solid {

/// A material that is known by its name, "steel S235", with nominal values at room temperature.
struct KnownMaterial {
    std::string name;
    Material material;          ///< isotropic; without a yield stress
    double yield_stress = 0.0;  ///< [Pa], of MaterialLaw::j2; 0: it breaks before it flows, or no value is given
    std::string source;
    // Of Johnson and Cook's law, 0 where no source has them: Material::power_hardening [Pa] and the like
    double power_hardening = 0.0, power_exponent = 0.0, johnson_cook_rate = 0.0, johnson_cook_factor = 0.0;
};

/// Gives a material of MaterialLaw::j2 the yield stress of a known one, and its hardening and rates where it has none
/// of its own.
void take_flow(Material& material, const KnownMaterial& known);

[[nodiscard]] const std::vector<KnownMaterial>& known_materials();
/// Null if none has this name.
[[nodiscard]] const KnownMaterial* known_material(const std::string& name);
/// Throws BadInput, with all names, if none has this one.
[[nodiscard]] const KnownMaterial& material_called(const std::string& name);

}  // namespace abut::solid
