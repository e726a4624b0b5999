#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "abut/input/keys.hpp"
#include "abut/mesh/grains.hpp"
#include "abut/mesh/io/length_units.hpp"
#include "abut/mesh/mesh_words.hpp"
#include "abut/run/option_table.hpp"
#include "abut/solid/material/material_numbers.hpp"
#include "abut/solid/options/number_tables.hpp"
#include "abut/solid/options/option_words.hpp"

namespace abut::input {
namespace {

using Of = Make<BodySettings>;
using Body = BodySettings;

constexpr Limits a_length{.unit = "m", .above = 0.0};

struct CellWord {
    const char* word;
    mesh::CellShape choice;
};
constexpr std::array<CellWord, 6> cell_words{{{"triangle", mesh::CellShape::triangle},
                                              {"quadrangle", mesh::CellShape::quadrangle},
                                              {"tetrahedron", mesh::CellShape::tetrahedron},
                                              {"hexahedron", mesh::CellShape::hexahedron},
                                              {"prism", mesh::CellShape::prism},
                                              {"pyramid", mesh::CellShape::pyramid}}};
/// Words of run::kinematics_words that a body may have by itself.
std::vector<Word<solid::Kinematics>> body_kinematics() {
    std::vector<Word<solid::Kinematics>> words;
    for (const auto& [word, choice] : run::kinematics_words)
        if (const auto kinematics = run::kinematics_of_all(choice)) words.push_back({word, *kinematics});
    return words;
}

Key<Body> radius() { return required(Of::number("radius", &Body::radius, a_length, "radius")); }
Key<Body> size() { return required(Of::number("size", &Body::size, a_length, "wanted edge length of cells")); }
Key<Body> variant() {
    return Of::count("variant", &Body::variant, 0, Of::many,
                     "makes equal shapes differ in their meshes, not in their number of cells: give each body another");
}
Key<Body> most_cells() {
    return Of::number("most_cells", &Body::most_cells, {.above = 0.0},
                      "that may be made; an estimate beyond it is refused before anything is made");
}
Key<Body> lower() { return required(Of::vector("lower", &Body::lower, "m", "", "corner with the smallest coordinates")); }
Key<Body> upper() { return required(Of::vector("upper", &Body::upper, "m", "", "corner with the largest coordinates")); }
Key<Body> length() { return required(Of::number("length", &Body::length, a_length, "length along z")); }

/// A table within that of the body.
template <class Settings>
Key<Body> inner_table(const char* name, const char* help, std::optional<Settings> Body::*member,
                      const Keys<Settings>& keys) {
    const auto read = [&keys](Reader& reader, const Node& node, const std::string& key) -> std::optional<Settings> {
        if (!reader.is_table(node, key)) return std::nullopt;
        Settings settings;
        read_table(settings, node, key, keys, reader);
        return settings;
    };
    return key_of<Body>(name, "table", help, member, read);
}
Key<Body> refinement() {
    return inner_table("refinement", "smaller cells near a point: keys below", &Body::refinement, refinement_keys());
}
Key<Body> fracture() {
    return inner_table("fracture", "pieces that it may break into, and what holds them together: keys below",
                       &Body::fracture, fracture_keys());
}

Key<Body> erosion() {
    const auto read = [](Reader& reader, const Node& node, const std::string& key) -> std::optional<solid::ErosionLimits> {
        if (!reader.is_table(node, key)) return std::nullopt;
        solid::ErosionLimits limits;
        read_table(limits, node, key, erosion_keys(), reader);
        if (node.items.empty())
            reader.fault(node,
                         key + " has no limit. Give strain, plastic_strain or stress, or leave it out: all cells stay.");
        return limits;
    };
    return key_of<Body>("erosion", "table", "limits beyond which a cell leaves the run: keys below", &Body::erosion, read);
}

Key<Body> counts() {
    const auto read = [](Reader& reader, const Node& node, const std::string& key) { return reader.counts(node, key); };
    return required(key_of<Body>("counts", "whole numbers", "bricks along each direction", &Body::counts, read));
}

std::vector<Word<solid::MaterialLaw>> material_laws() {
    return {solid::material_law_words.begin(), solid::material_law_words.end()};
}

std::optional<std::vector<solid::HardeningPoint>> read_hardening(Reader& reader, const Node& node, const std::string& key) {
    const auto is_row = [](const Node& row) { return row.type == Node::Type::array && row.items.size() == 2; };
    if (node.type != Node::Type::array || node.items.empty() || !std::ranges::all_of(node.items, is_row)) {
        reader.wrong_type(node, key, "a list of rows [plastic strain, stress in Pa]");
        return std::nullopt;
    }
    std::vector<solid::HardeningPoint> table;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
        const std::string row = key + ", row " + std::to_string(i + 1);
        const auto strain = reader.number(node.items[i].items[0], row, {.above = 0.0, .zero = true});
        const auto stress = reader.number(node.items[i].items[1], row, {.unit = "Pa", .above = 0.0});
        if (!strain || !stress) return std::nullopt;
        table.push_back({*strain, *stress});
    }
    return table;
}

std::optional<std::array<double, 3>> read_axis(Reader& reader, const Node& node, const std::string& key) {
    const auto axis = reader.vector(node, key, {});
    if (!axis) return std::nullopt;
    return std::array<double, 3>{(*axis)[0], (*axis)[1], (*axis)[2]};
}

/// Keys of a material by itself, and of a body that has one of its own.
template <class Section>
Keys<Section> material_values() {
    using From = Make<Section>;
    Keys<Section> keys;
    for (const solid::MaterialNumber& number : solid::material_numbers) {
        const auto value = [in = number.at.in](Section& section) -> double& { return in(section.material); };
        Key<Section> key = From::number(number.name, value, number.limits, number.help);
        keys.push_back(number.required ? required(std::move(key)) : std::move(key));
    }
    const auto behind = std::ranges::find(keys, std::string("eta"), &Key<Section>::name) + 1;
    keys.insert(
        behind,
        From::word(
            "law", [](Section& section) -> solid::MaterialLaw& { return section.material.law; }, material_laws(),
            "what it does beyond small strains: st_venant_kirchhoff up to 0.1, in finite bodies neo_hookean and "
            "mooney_rivlin (rubber) beyond, j2: metal that yields, orthotropic: other moduli along axes of its own"));
    const auto behind_hardening = std::ranges::find(keys, std::string("power_exponent"), &Key<Section>::name) + 1;
    keys.insert(behind_hardening,
                key_of<Section>(
                    "hardening_table", "list of [plastic strain, stress]",
                    "of j2, in the place of yield_stress and of what rises: where it flows after a plastic strain, from 0 "
                    "on, straight between rows and constant behind the last [Pa]",
                    [](Section& section) -> std::vector<solid::HardeningPoint>& { return section.material.flow.table; },
                    read_hardening));
    const auto behind_angle = std::ranges::find(keys, std::string("axis_angle"), &Key<Section>::name) + 1;
    const auto axis = [](const char* name, std::array<double, 3> solid::Orthotropy::*member, const char* by_default,
                         const char* help) {
        Key<Section> key = key_of<Section>(
            name, "list of 3 numbers", help,
            [member](Section& section) -> std::array<double, 3>& { return section.material.orthotropic.*member; },
            read_axis);
        key.by_default = by_default;
        return key;
    };
    keys.insert(behind_angle,
                {axis("axis_1", &solid::Orthotropy::axis_1, "[1, 0, 0]",
                      "of orthotropic in 3D: direction of axis 1 at rest, of any length"),
                 axis("axis_2", &solid::Orthotropy::axis_2, "[0, 1, 0]",
                      "of orthotropic in 3D: direction of axis 2, at a right angle to it; axis 3 completes both")});
    return keys;
}

}  // namespace

const Keys<MaterialSettings>& material_keys() {
    static const Keys<MaterialSettings> keys = material_values<MaterialSettings>();
    return keys;
}

const Keys<RefinementSettings>& refinement_keys() {
    using Part = RefinementSettings;
    using From = Make<Part>;
    static const Keys<Part> keys = {
        required(
            From::vector("point", &Part::point, "m", "", "where cells are smallest, before the body is turned and placed")),
        required(From::number("size", &Part::size, a_length, "edge length of cells there")),
        required(From::number("distance", &Part::distance, a_length, "over which cells grow to the size of the body")),
        From::number("uniform", &Part::uniform, {.unit = "m", .above = 0.0, .zero = true},
                     "distance from the point within which cells are smallest")};
    return keys;
}

const Keys<FractureSettings>& fracture_keys() {
    using Part = FractureSettings;
    using From = Make<Part>;
    static const Keys<Part> keys = {
        required(From::number("grain", &Part::grain, mesh::grain_size,
                              "size of the pieces: edge of a square or cube as large. Cracks follow their faces")),
        required(From::number("strength", &Part::strength, number_of(solid::bond_numbers, &solid::Bond::strength).limits,
                              "largest traction that a face between pieces bears, pressure not counted")),
        From::number(
            "fracture_energy", &Part::fracture_energy, number_of(solid::bond_numbers, &solid::Bond::fracture_energy).limits,
            "energy per area that an opening crack takes; 0: faces break at once, with less energy in smaller cells"),
        From::number("weibull", &Part::weibull, number_of(solid::bond_numbers, &solid::Bond::weibull_modulus).limits,
                     "modulus of the scatter of strength from face to face, 63 % of which are below `strength`; not given: "
                     "all have it"),
        From::count("seed", &Part::seed, 0, Of::many, "another one gives other pieces and another scatter")};
    return keys;
}

const Keys<solid::ErosionLimits>& erosion_keys() {
    using Limits = solid::ErosionLimits;
    using From = Make<Limits>;
    static const Keys<Limits> keys = {
        From::number("strain", &Limits::strain, number_of(solid::erosion_numbers, &Limits::strain).limits,
                     "largest principal strain of a cell; of finite bodies its largest stretch less 1"),
        From::number("plastic_strain", &Limits::plastic_strain,
                     number_of(solid::erosion_numbers, &Limits::plastic_strain).limits, "equivalent one, of j2"),
        From::number("stress", &Limits::stress, number_of(solid::erosion_numbers, &Limits::stress).limits,
                     "largest principal stress, tension above 0")};
    return keys;
}

const Keys<Body>& body_keys() {
    static const Keys<Body> keys = [] {
        Keys<Body> all = {
            Of::text(
                "material", &Body::material_name, "text",
                "[materials.NAME] that it is made of, or one that is known by its name (abut materials): of the values of "
                "a material it gives those that the body does not"),
            Of::word("kinematics", &Body::kinematics, body_kinematics(),
                     "how it may move: without turns, in a frame that turns, bending, or rigid"),
            key_of<Body>("self", "true, false", "whether its faces touch each other; by default as [contact] says",
                         &Body::self,
                         [](Reader& reader, const Node& node, const std::string& path) { return reader.truth(node, path); }),
            Of::vector("place", &Body::place, "m", "0",
                       "where its own origin goes: of disc, fan_disc, gear, cylinder and sphere their centre"),
            Of::axial("turn", &Body::turn, "rad", "turn about its own origin before it is placed; in 3D axis times angle"),
            Of::formula("temperature_rise", &Body::temperature_rise, "", Variables::time_and_space,
                        "kelvins above where it has no thermal strain, of a body that deforms and whose material has a "
                        "thermal_expansion; x, y, z at rest in the scene"),
            erosion(),
            Of::vector("velocity", &Body::velocity, "m/s", "0", "velocity at the start"),
            Of::axial("spin", &Body::spin, "rad/s", "angular velocity about its centroid at the start"),
            fracture()};
        const Keys<Body> own = material_values<Body>();
        all.insert(all.begin() + 1, own.begin(), own.end());
        return all;
    }();
    return keys;
}

const Keys<Body>& part_keys() {
    static const Keys<Body> keys = [] {
        Keys<Body> chosen;
        for (const Key<Body>& key : body_keys())
            if (key.name != "place" && key.name != "turn" && key.name != "fracture") {
                chosen.push_back(key);
                chosen.back().required = false;
            }
        chosen.push_back(
            Of::formula("region", &Body::region, "", Variables::time_and_space,
                        "not 0 where its cells are, by the centroids of cells before the body is turned and placed: "
                        "\"sqrt(x^2 + y^2) < 0.01\"; cells that no region takes are BODY \"rest\""));
        return chosen;
    }();
    return keys;
}

const std::vector<Variety<Body, Shape>>& body_varieties() {
    static const std::vector<Variety<Body, Shape>> varieties = with_all_keys<Body, Shape>(
        {{"disc", Shape::disc, {2}, {radius(), size(), refinement(), variant(), most_cells()}},
         {"fan_disc",
          Shape::fan_disc,
          {2},
          {radius(), required(Of::count("sectors", &Body::sectors, 3, Of::many, "triangles around the centre")),
           most_cells()}},
         {"gear",
          Shape::gear,
          {2},
          {required(Of::count("teeth", &Body::teeth, 4, Of::many, "number of involute teeth")),
           required(Of::number("radius", &Body::radius, a_length, "radius of the pitch circle")),
           required(Of::number("bore", &Body::bore, a_length, "radius of the hole")),
           Of::number("pressure_angle", &Body::pressure_angle, {.unit = "rad", .above = 0.0, .below = 0.78, .zero = true},
                      "two gears mesh where theirs are equal, and radius over teeth, too"),
           Of::number("backlash", &Body::backlash, {.unit = "m", .above = 0.0, .zero = true},
                      "half of what a tooth is thinner than a gap on the pitch circle"),
           Of::count("cells_per_tooth", &Body::cells_per_tooth, 2, Of::many, "across a tooth; an even number"),
           most_cells()}},
         {"box", Shape::box, {2, 3}, {lower(), upper(), size(), refinement(), variant(), most_cells()}},
         {"structured_box",
          Shape::structured_box,
          {2, 3},
          {lower(), upper(), counts(),
           Of::word("cells", &Body::cells, cell_words, "shape of cells; by default quadrangles in 2D, hexahedra in 3D"),
           most_cells()}},
         {"cylinder", Shape::cylinder, {3}, {radius(), length(), size(), refinement(), variant(), most_cells()}},
         {"sphere", Shape::sphere, {3}, {radius(), size(), refinement(), variant(), most_cells()}},
         {"file",
          Shape::file,
          {2, 3},
          {required(
               Of::text("mesh", &Body::mesh, "path", ".msh or .vtu file, from the folder of the scene; no shape is needed")),
           Of::word("non_planar", &Body::non_planar, mesh::non_planar_words,
                    "cells with faces that are not planar: refuse them, or split them into tetrahedra"),
           Of::number("planarity_tolerance", &Body::planarity_tolerance, {.above = 0.0, .zero = true},
                      "how far a corner may lie off the plane of its face, over the size of the face")}},
         {"surface",
          Shape::surface,
          {3},
          {required(
               Of::text("surface", &Body::surface, "path",
                        ".stl, .obj, .off, .ply or .vtp file with one closed surface, which is filled with tetrahedra; no "
                        "shape is needed")),
           size(), Of::word("unit", &Body::unit, mesh::length_units, "unit of the file's lengths"),
           Of::number("scale", &Body::scale, {.above = 0.0}, "the body is that many times as large as the file has it"),
           Of::truth(
               "keep_triangles", &Body::keep_triangles,
               "true: triangles of the file become faces of the mesh. false: the surface is remeshed with `size`, and edges "
               "sharper than 40 degrees stay"),
           most_cells()}}});
    return varieties;
}

}  // namespace abut::input
