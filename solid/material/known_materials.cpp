#include "abut/solid/material/known_materials.hpp"

#include <algorithm>
#include <utility>

#include "abut/base/given_value.hpp"

namespace abut::solid {
namespace {

KnownMaterial named(std::string name, double young, double poisson, double density, double yield_stress,
                    std::string source) {
    return {std::move(name),
            {.young = young, .poisson = poisson, .density = density},
            {.yield_stress = yield_stress},
            std::move(source)};
}

/// With B, n and C of Johnson and Cook, C at a rate of 1/s.
KnownMaterial hardened(KnownMaterial material, double b, double n, double c) {
    material.flow.power_hardening = b;
    material.flow.power_exponent = n;
    material.flow.johnson_cook_rate = 1.0;
    material.flow.johnson_cook_factor = c;
    return material;
}

}  // namespace

const std::vector<KnownMaterial>& known_materials() {
    static const std::vector<KnownMaterial> all = {
        named("steel S235", 210e9, 0.3, 7850.0, 235e6,
              "EN 1993-1-1 (E, nu); EN 1991-1-1 (density, the upper value); EN 10025-2 (yield strength up to 16 mm)"),
        named("steel S355", 210e9, 0.3, 7850.0, 355e6,
              "EN 1993-1-1 (E, nu); EN 1991-1-1 (density, the upper value); EN 10025-2 (yield strength up to 16 mm)"),
        named("stainless steel 304", 200e9, 0.3, 7900.0, 210e6,
              "steel 1.4301: EN 10088-1 (E, density); EN 1993-1-4 (nu); EN 10088-2 (least proof strength of hot rolled "
              "plate)"),
        named("cast iron GJL-250", 110e9, 0.26, 7200.0, 0.0, "EN 1561 (E is 103 to 118 GPa there: a value between)"),
        named("cast iron GJS-400-15", 169e9, 0.275, 7100.0, 250e6, "EN 1563"),
        named("aluminium 6061-T6", 68.9e9, 0.33, 2700.0, 276e6, "ASM Metals Handbook, volume 2: typical values"),
        hardened(
            named(
                "copper OFHC", 124e9, 0.34, 8960.0, 90e6,
                "Johnson and Cook 1983 (density; yield stress: their A, annealed; with law = \"j2\" also their B = 292 MPa, "
                "n = 0.31, C = 0.025); Johnson and Holmquist 1989 (E, nu)"),
            292e6, 0.31, 0.025),
        named("brass 70/30", 100.6e9, 0.35, 8530.0, 0.0,
              "Kaye and Laby, Tables of Physical and Chemical Constants (E, nu); Copper Development Association, C26000 "
              "(density)"),
        named("titanium Ti-6Al-4V", 113.8e9, 0.342, 4430.0, 880e6,
              "ASM Metals Handbook, volume 2: typical values, annealed"),
        named("tungsten", 411e9, 0.28, 19300.0, 0.0, "Kaye and Laby, Tables of Physical and Chemical Constants"),
        named("lead", 16.1e9, 0.44, 11340.0, 0.0, "Kaye and Laby, Tables of Physical and Chemical Constants"),
        named("concrete C30/37", 33e9, 0.2, 2400.0, 0.0,
              "EN 1992-1-1, table 3.1 (E: mean secant modulus) and 3.1.3 (nu, uncracked); EN 1991-1-1 (24 kN/m^3, plain)"),
        named("glass soda-lime", 70e9, 0.2, 2500.0, 0.0, "EN 572-1"),
        named("ice", 9.33e9, 0.325, 917.0, 0.0,
              "Schulson and Duval 2009, Creep and Fracture of Ice (E, nu at -16 degrees C, after Gammon and others 1983; "
              "density at 0)"),
        named("PMMA", 3.3e9, 0.37, 1190.0, 0.0, "data sheet of Plexiglas GS (ISO 527, ISO 1183)"),
        named("polycarbonate", 2.4e9, 0.37, 1200.0, 66e6,
              "data sheet of Makrolon 2805 (ISO 527: E, yield stress; ISO 1183); nu is the usual value"),
        named("natural rubber", 1.5e6, 0.49, 970.0, 0.0,
              "Lindley, Engineering Design with Natural Rubber (E of 40 IRHD); Polymer Handbook (density of a pure gum "
              "vulcanizate). nu is a choice: the bulk modulus of 1 GPa means 0.49975 and a step 6 times smaller")};
    return all;
}

const KnownMaterial* known_material(const std::string& name) {
    const auto found = std::ranges::find(known_materials(), name, &KnownMaterial::name);
    return found == known_materials().end() ? nullptr : &*found;
}

const KnownMaterial& material_called(const std::string& name) {
    return entry_called(known_materials(), &KnownMaterial::name, "material", name);
}

void take_flow(Material& material, const KnownMaterial& known) {
    MetalFlow& flow = material.flow;
    flow.yield_stress = known.flow.yield_stress;
    if (flow.hardening == 0.0 && flow.saturation == 0.0 && flow.power_hardening == 0.0) {
        flow.power_hardening = known.flow.power_hardening;
        flow.power_exponent = known.flow.power_exponent;
    }
    if (flow.knows_rates()) return;
    flow.johnson_cook_rate = known.flow.johnson_cook_rate;
    flow.johnson_cook_factor = known.flow.johnson_cook_factor;
}

}  // namespace abut::solid
