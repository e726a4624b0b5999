#include "abut/input/materials.hpp"

#include <fmt/format.h>

#include "abut/solid/material/known_materials.hpp"

namespace abut::input {
namespace {

std::string stress(double value) {
    if (value == 0.0) return "";
    return value < 1e9 ? fmt::format("{:g} MPa", value / 1e6) : fmt::format("{:g} GPa", value / 1e9);
}

}  // namespace

std::string table_of_materials() {
    std::string text = "| material | young | poisson | density | yield_stress | source |\n|---|---|---|---|---|---|\n";
    for (const solid::KnownMaterial& known : solid::known_materials())
        text += fmt::format("| `{}` | {} | {:g} | {:g} kg/m^3 | {} | {} |\n", known.name, stress(known.material.young),
                            known.material.poisson, known.material.density, stress(known.flow.yield_stress), known.source);
    return text;
}

}  // namespace abut::input
