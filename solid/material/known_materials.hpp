#pragma once
#include <string>
#include <vector>

#include "abut/solid/material/material.hpp"

namespace abut::solid {

/// A material that is known by its name, "steel S235", with nominal values at room temperature.
struct KnownMaterial {
    std::string name;
    Material material;  ///< isotropic and elastic
    MetalFlow flow;     ///< its flow under MaterialLaw::j2; a yield stress of 0: it breaks before, or no value is given
    std::string source;
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
