#pragma once
#include <array>
#include <optional>

#include "abut/base/option.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::solid {

inline constexpr std::array<Word<MaterialLaw>, 4> material_law_words{
    {{"st_venant_kirchhoff", MaterialLaw::st_venant_kirchhoff},
     {"neo_hookean", MaterialLaw::neo_hookean},
     {"mooney_rivlin", MaterialLaw::mooney_rivlin},
     {"j2", MaterialLaw::j2}}};

/// A number of a Material, under its name in scenes and in Python.
struct MaterialNumber {
    const char* name;
    double Material::*member;
    Limits limits;
    const char* help;
    bool required = false;
    std::optional<MaterialLaw> law{};  ///< the only one that reads it; others take 0 alone. None: all do
};

/// All of them: the keys of scenes and the attributes in Python come from here.
inline constexpr std::array material_numbers{
    MaterialNumber{"young",
                   &Material::young,
                   {.unit = "Pa", .above = 0.0, .remedy = "Steel has 2.1e11 Pa."},
                   "Young's modulus E",
                   true},
    MaterialNumber{"poisson",
                   &Material::poisson,
                   {.above = -1.0, .below = 0.5, .remedy = "An incompressible body has no stable explicit step; take 0.49."},
                   "Poisson's ratio nu"},
    MaterialNumber{"density",
                   &Material::density,
                   {.unit = "kg/m^3", .above = 0.0, .remedy = "Steel has 7800 kg/m^3."},
                   "density rho",
                   true},
    MaterialNumber{"eta",
                   &Material::eta,
                   {.unit = "Pa", .above = 0.0, .zero = true},
                   "stabilisation of jumps between cells; 0: Young's modulus"},
    MaterialNumber{"second_share",
                   &Material::second_share,
                   {.above = 0.0, .below = 1.0, .closed = true, .zero = true, .remedy = "It is at most lambda/(2 mu)."},
                   "of mooney_rivlin: shear modulus of the second invariant over all of it, at most lambda/(2 mu)",
                   false,
                   MaterialLaw::mooney_rivlin},
    MaterialNumber{"yield_stress",
                   &Material::yield_stress,
                   {.unit = "Pa", .above = 0.0, .zero = true},
                   "of j2, which needs it: stress at which it begins to flow in tension",
                   false,
                   MaterialLaw::j2},
    MaterialNumber{"hardening",
                   &Material::hardening,
                   {.unit = "Pa", .above = 0.0, .zero = true},
                   "of j2: rise of that stress per equivalent plastic strain",
                   false,
                   MaterialLaw::j2},
    MaterialNumber{"saturation",
                   &Material::saturation,
                   {.unit = "Pa", .above = 0.0, .zero = true},
                   "of j2: Voce's rise of that stress in the end, beside `hardening`",
                   false,
                   MaterialLaw::j2},
    MaterialNumber{"saturation_rate",
                   &Material::saturation_rate,
                   {.above = 0.0, .zero = true},
                   "of j2: how fast it comes, per equivalent plastic strain",
                   false,
                   MaterialLaw::j2},
    MaterialNumber{"power_hardening",
                   &Material::power_hardening,
                   {.unit = "Pa", .above = 0.0, .zero = true},
                   "of j2: B of a rise B alpha^n of that stress with the plastic strain alpha (Ludwik, Johnson and Cook)",
                   false,
                   MaterialLaw::j2},
    MaterialNumber{"power_exponent",
                   &Material::power_exponent,
                   {.above = 0.0, .below = 1.0, .closed = true, .zero = true},
                   "of j2: n of `power_hardening`",
                   false,
                   MaterialLaw::j2},
    MaterialNumber{
        "cowper_symonds_rate",
        &Material::cowper_symonds_rate,
        {.unit = "1/s", .above = 0.0, .zero = true},
        "of j2: D of a factor 1 + (r/D)^(1/q) to that stress, r the rate of the plastic strain; 0: rates do not count",
        false,
        MaterialLaw::j2},
    MaterialNumber{"cowper_symonds_exponent",
                   &Material::cowper_symonds_exponent,
                   {.above = 1.0, .zero = true, .from = true},
                   "of j2: q of `cowper_symonds_rate`",
                   false,
                   MaterialLaw::j2},
    MaterialNumber{"johnson_cook_rate",
                   &Material::johnson_cook_rate,
                   {.unit = "1/s", .above = 0.0, .zero = true},
                   "of j2: r_0 of a factor 1 + C ln(r/r_0) to that stress, 1 below r_0; 0: rates do not count",
                   false,
                   MaterialLaw::j2},
    MaterialNumber{"johnson_cook_factor",
                   &Material::johnson_cook_factor,
                   {.above = 0.0, .zero = true},
                   "of j2: C of `johnson_cook_rate`",
                   false,
                   MaterialLaw::j2},
    MaterialNumber{
        "kinematic_hardening",
        &Material::kinematic_hardening,
        {.unit = "Pa", .above = 0.0, .zero = true},
        "of j2: rise of the stress that shifts the yield surface (Prager), per plastic strain; not of finite bodies",
        false,
        MaterialLaw::j2},
    MaterialNumber{"jump_cap",
                   &Material::jump_cap,
                   {.above = 0.0, .zero = true},
                   "of j2: largest stress of the stabilisation of jumps over yield_stress; 0: 0.1 between simplices, 0.3 "
                   "elsewhere, none in finite bodies with contact",
                   false,
                   MaterialLaw::j2},
    MaterialNumber{"mass_damping",
                   &Material::mass_damping,
                   {.unit = "1/s", .above = 0.0, .zero = true},
                   "Rayleigh's alpha: a force alpha m v against all motion, that of the body as a whole as well"},
    MaterialNumber{"stiffness_damping",
                   &Material::stiffness_damping,
                   {.unit = "s", .above = 0.0, .zero = true},
                   "Rayleigh's beta: a stress beta C : (rate of strain); it damps most what vibrates fast"},
    MaterialNumber{"linear_viscosity",
                   &Material::linear_viscosity,
                   {.above = 0.0, .zero = true},
                   "of shocks: pressure over rho c h (rate of compression), h the size of a cell; 0.25 is usual"},
    MaterialNumber{"quadratic_viscosity",
                   &Material::quadratic_viscosity,
                   {.above = 0.0, .zero = true},
                   "of shocks: root of pressure over rho h^2 (rate of compression)^2; 2 is usual"}};

}  // namespace abut::solid
