#pragma once
#include <array>
#include <filesystem>
#include <vector>

#include "abut/base/option.hpp"

/// A table of options of nothing that Abut has: what is made from it is made by the functions that serve all tables.
namespace abut::test {

enum class Grain { fine, coarse };
inline constexpr std::array<Word<Grain>, 2> grain_words{{{"fine", Grain::fine}, {"coarse", Grain::coarse}}};

struct Soil {
    double stiffness = 2.5;  ///< [Pa]
    int layers = 3;
    bool is_wet = false;
    bool drains = true;
    Grain grain = Grain::coarse;
    std::filesystem::path map;
    std::vector<double> depths;  ///< [m]
};

inline const OptionList<Soil>& soil_options() {
    static const OptionList<Soil> options = [] {
        OptionList<Soil> made = {
            option("soil_stiffness", &Soil::stiffness,
                   {.help = "of the soil", .limits = {.unit = "Pa", .above = 0.0}, .laws = {"pair_potential"}}),
            option("soil_layers", &Soil::layers,
                   {.help = "layers of the soil",
                    .least = 1,
                    .most = 9,
                    .key = "layers",
                    .schemes = {"memm"},
                    .named = Named::with_scheme}),
            option("is_wet", &Soil::is_wet, {.help = "it has rained", .named = Named::changed}),
            option("drains", &Soil::drains, {.help = "water leaves", .is_switch = true}),
            choice("grain", &Soil::grain, grain_words, {.help = "size of the grains"}),
            option("map", &Soil::map, {.help = "where it lies", .by_default = "nowhere", .named = Named::never}),
            option("depths", &Soil::depths,
                   {.help = "of its layers", .limits = {.unit = "m", .above = 0.0}, .named = Named::changed})};
        for (Option<Soil>& one : made) one.table = "soil", one.group = "Soil";
        return made;
    }();
    return options;
}

}  // namespace abut::test
