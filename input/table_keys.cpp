#include <fmt/format.h>

#include <algorithm>

#include "abut/base/counted.hpp"
#include "abut/input/key_readers.hpp"
#include "abut/input/keys.hpp"
#include "abut/input/make_body.hpp"
#include "abut/input/nearest_word.hpp"
#include "abut/solid/material/known_materials.hpp"

namespace abut::input {
namespace {

template <class Variety>
bool fits(const Variety& variety, int dimension) {
    return dimension == 0 || std::ranges::find(variety.dimensions, dimension) != variety.dimensions.end();
}

template <class Section, class Kind>
std::vector<std::string> words_of(const std::vector<Variety<Section, Kind>>& varieties, int dimension) {
    std::vector<std::string> words;
    for (const auto& variety : varieties)
        if (variety.choice != Kind::none && fits(variety, dimension)) words.push_back(variety.word);
    return words;
}

/// The variety that `shape` names; that of none, with a fault, if it names none of this dimension.
template <class Section, class Kind>
const Variety<Section, Kind>& chosen_variety(const Node& table, const std::string& path,
                                             const std::vector<Variety<Section, Kind>>& varieties, Reader& reader) {
    const auto words = words_of(varieties, reader.dimension);
    const Node* shape = table.find("shape");
    if (!shape) {
        reader.fault(table, fmt::format("{}.shape is missing: what it is.{}", path, hint("", words)));
        return varieties.front();
    }
    const auto index = reader.word(*shape, path + ".shape", words);
    if (!index) return varieties.front();
    return *std::ranges::find_if(varieties, [&](const auto& variety) { return variety.word == words[*index]; });
}

/// The key of a file says the shape, too: `files` pairs shapes with keys.
template <class Section, class Kind>
const Variety<Section, Kind>& variety_of(const Node& table, const std::string& path,
                                         const std::vector<Variety<Section, Kind>>& varieties,
                                         const std::vector<std::pair<Kind, const char*>>& files, Reader& reader) {
    if (!table.find("shape"))
        for (const auto& variety : varieties)
            for (const auto& [choice, key] : files)
                if (variety.choice == choice && fits(variety, reader.dimension) && table.find(key)) return variety;
    return chosen_variety(table, path, varieties, reader);
}

/// Its own keys, those of its kind, and `shape`, which is read already.
template <class Section, class Kind>
void read_varied(Section& section, const Node& table, const std::string& path, const Variety<Section, Kind>& variety,
                 const Keys<Section>& common, Reader& reader) {
    section.shape = variety.choice;
    Keys<Section> keys = variety.keys;
    keys.insert(keys.end(), common.begin(), common.end());
    keys.push_back({.name = "shape", .take = [](Section&, const Node&, const std::string&, Reader&) {}});
    read_table(section, table, path, keys, reader);
}

void read(MaterialSettings& material, const Node& table, const std::string& path, Reader& reader) {
    material.table = std::make_shared<GivenKey>(GivenKey{.path = path, .where = table.where});
    material.table->why = "without a body that is made of it";
    material.table->remedy = "Give one this material, or leave it out.";
    reader.given.push_back(material.table);
    read_table(material, table, path, material_keys(), reader);
}

/// The body begins with the values of the material that it names.
void take_material(BodySettings& body, const Node& name, const std::string& path,
                   const std::vector<MaterialSettings>& materials, Reader& reader) {
    if (name.type != Node::Type::text) return;  // the key says so
    for (const auto& key : material_keys()) body.given.remove(key.name);
    const auto found = std::ranges::find(materials, name.text, &MaterialSettings::name);
    if (found != materials.end()) {
        body.material = found->material;
        body.given.add(found->given);
        found->table->is_read = true;
        return;
    }
    if (const solid::KnownMaterial* known = solid::known_material(name.text)) {
        body.material = known->material;
        return;
    }
    std::vector<std::string> names;
    for (const MaterialSettings& material : materials) names.push_back(material.name);
    for (const solid::KnownMaterial& known : solid::known_materials()) names.push_back(known.name);
    reader.fault(name, fmt::format("{}.material is '{}', which is no material.{} Give [materials.NAME] for another; abut "
                                   "materials lists those that need no table.",
                                   path, name.text, hint_of_name(name.text, names)));
}

/// Takes the yield stress of the table, or of a material known by its name, with its hardening and rates, where the law
/// needs one and the scene gives none.
void take_yield_stress(BodySettings& body, const std::vector<MaterialSettings>& materials) {
    if (body.material.law != solid::MaterialLaw::j2 || body.material.flow.yield_stress > 0.0) return;
    if (const auto& table = body.material.flow.table; !table.empty()) {
        body.material.flow.yield_stress = table.front().stress;
        return;
    }
    if (std::ranges::find(materials, body.material_name, &MaterialSettings::name) != materials.end()) return;
    if (const solid::KnownMaterial* known = solid::known_material(body.material_name))
        solid::take_flow(body.material, *known);
}

/// Tables within that of a body that are none of its keys: each of a body of its file, or of a region.
std::vector<std::size_t> part_tables(const Node& body, const Variety<BodySettings, Shape>& variety) {
    std::vector<std::size_t> tables;
    const auto is_part = [&](std::size_t i) {
        return variety.choice == Shape::file || body.names[i] == rest_of_regions || body.items[i].find("region");
    };
    const auto known = [&](const std::string& name) {
        return std::ranges::find(variety.keys, name, &Key<BodySettings>::name) != variety.keys.end() ||
               std::ranges::find(body_keys(), name, &Key<BodySettings>::name) != body_keys().end();
    };
    for (std::size_t i = 0; i < body.items.size(); ++i)
        if (body.items[i].type == Node::Type::table && !known(body.names[i]) && is_part(i)) tables.push_back(i);
    return tables;
}

/// A material is complete, so that nothing of it is required of a body that has one, nor of bodies with tables of their own.
Keys<BodySettings> keys_of(const Node& body, const std::vector<std::size_t>& parts) {
    Keys<BodySettings> keys = body_keys();
    if (body.find("material") || !parts.empty())
        for (auto& key : keys) key.required = false;
    for (const std::size_t part : parts)
        keys.push_back({.name = body.names[part], .take = [](BodySettings&, const Node&, const std::string&, Reader&) {}});
    return keys;
}

bool gives_material(const Node& table) { return table.find("material") || (table.find("young") && table.find("density")); }

/// Values that a body of a file does not give are those of the table around it.
BodySettings read_part(const BodySettings& around, const Node& table_around, const Node& table, const std::string& name,
                       const std::string& path, const std::vector<MaterialSettings>& materials, Reader& reader) {
    BodySettings part = around;
    part.parts.clear();
    part.name = name;
    part.where = table.where;
    if (const Node* material = table.find("material")) take_material(part, *material, path, materials, reader);
    read_table(part, table, path, part_keys(), reader);
    take_yield_stress(part, materials);
    const auto gives = [&](const char* key) { return table.find(key) || table_around.find(key); };
    part.has_material = gives("material") || (gives("young") && gives("density"));
    return part;
}

void read(BodySettings& body, const Node& table, const std::string& path, const std::vector<MaterialSettings>& materials,
          Reader& reader) {
    const std::size_t before = reader.faults().size();
    if (const Node* name = table.find("material")) take_material(body, *name, path, materials, reader);
    const auto& variety = variety_of<BodySettings, Shape>(table, path, body_varieties(),
                                                          {{Shape::file, "mesh"}, {Shape::surface, "surface"}}, reader);
    const std::vector<std::size_t> parts = part_tables(table, variety);
    read_varied(body, table, path, variety, keys_of(table, parts), reader);
    take_yield_stress(body, materials);
    body.has_material = gives_material(table);
    std::vector<BodySettings> read_parts;  // each a copy of the body, which has none of them yet
    for (const std::size_t part : parts)
        read_parts.push_back(
            read_part(body, table, table.items[part], table.names[part], path + "." + table.names[part], materials, reader));
    body.parts = std::move(read_parts);
    if (reader.faults().size() != before) body.shape = Shape::none;  // not to be made
}

void check_path(const ObstacleSettings& obstacle, const Node& table, const std::string& path, Reader& reader) {
    if (obstacle.path && table.find("velocity"))
        reader.fault(table, fmt::format("{} has both velocity and path. Leave one of them out.", path));
    if (obstacle.rotation && table.find("spin"))
        reader.fault(table, fmt::format("{} has both spin and rotation. Leave one of them out.", path));
    if (obstacle.pivot && !table.find("rotation") && !table.find("spin"))
        reader.fault(table, fmt::format("{} has a pivot and does not turn. Give its spin or rotation.", path));
    if (obstacle.shape == ObstacleShape::plane && table.find("normal") && obstacle.normal.isZero(0.0))
        reader.fault(table, fmt::format("{}.normal is zero. Give the direction it faces.", path));
}

void read(ObstacleSettings& obstacle, const Node& table, const std::string& path, Reader& reader) {
    const std::size_t before = reader.faults().size();
    const auto& variety = variety_of<ObstacleSettings, ObstacleShape>(table, path, obstacle_varieties(),
                                                                      {{ObstacleShape::surface, "surface"}}, reader);
    read_varied(obstacle, table, path, variety, obstacle_keys(), reader);
    if (reader.faults().size() == before) check_path(obstacle, table, path, reader);
    if (reader.faults().size() != before) obstacle.shape = ObstacleShape::none;
}

void read(SupportSettings& support, const Node& table, const std::string& path, Reader& reader) {
    read_table(support, table, path, support_keys(), reader);
    const bool by_components = support.constraint == solid::Constraint::components;
    if (by_components != (table.find("components") != nullptr))
        reader.fault(table, by_components
                                ? fmt::format("{}.components is missing: which are prescribed, such as [\"x\"].", path)
                                : fmt::format("{} has components. Add constraint = \"components\".", path));
}

void read(TractionSettings& traction, const Node& table, const std::string& path, Reader& reader) {
    read_table(traction, table, path, traction_keys(), reader);
    const bool has_value = table.find("value"), has_pressure = table.find("pressure");
    if (!has_value && !has_pressure)
        reader.fault(table, fmt::format("{}.value is missing: force per area [Pa], or give {}.pressure.", path, path));
    if (has_value && has_pressure)
        reader.fault(table, fmt::format("{} has both value and pressure. Leave one of them out.", path));
}

void read(SpringSettings& spring, const Node& table, const std::string& path, Reader& reader) {
    read_table(spring, table, path, spring_keys(), reader);
    if (!table.find("stiffness") && !table.find("damping"))
        reader.fault(table, fmt::format("{} does nothing. Give its stiffness [N/m], its damping [N s/m], or both.", path));
}

void read(MomentSettings& moment, const Node& table, const std::string& path, Reader& reader) {
    read_table(moment, table, path, moment_keys(), reader);
    if (!table.find("value") && !table.find("damping"))
        reader.fault(table, fmt::format("{} does nothing. Give its value [N m], its damping [N m s], or both.", path));
}

/// Reads what makes a row, a grid, a ring or a table of places of it.
void read(PatternSettings& pattern, const Node& table, const std::string& path, Reader& reader) {
    read_table(pattern, table, path, pattern_keys(), reader);
    const auto has = [&](const char* key) { return table.find(key) != nullptr; };
    const auto fault = [&](const std::string& text) { reader.fault(table, path + text); };
    const int n_kinds = int{has("step")} + int{has("centre")} + int{has("places")};
    if (n_kinds != 1)
        return fault(fmt::format(" has {} of step, of a row or a grid, centre, of a ring, and places. Give one of them.",
                                 n_kinds == 0 ? "none" : std::to_string(n_kinds)));
    if (has("count") == has("places"))
        return fault(has("count") ? " has both count and places. Leave one of them out."
                                  : ".count is missing: copies in a row or around the centre, or in a grid.");
    if (has("centre") && table.find("count")->type == Node::Type::array)
        return fault(".count is a list, and a ring has one whole number of copies.");
    if (has("centre") && reader.dimension == 3 && !has("angle"))
        return fault(".angle is missing: axis times angle from one copy to the next [rad], such as [0, 0, \"30 deg\"].");
    for (const auto& [key, with] : {std::pair("shift", "step"), std::pair("angle", "centre"), std::pair("turns", "places")})
        if (has(key) && !has(with)) return fault(fmt::format(" has {} without {}. Leave it out.", key, with));
    if (!pattern.turns.empty() && pattern.turns.size() != pattern.places.size())
        fault(fmt::format(" has {} for {}. Give as many.", counted(std::ssize(pattern.turns), "turn"),
                          counted(std::ssize(pattern.places), "place")));
}

void read(SymmetrySettings& symmetry, const Node& table, const std::string& path, Reader& reader) {
    const std::size_t before = reader.faults().size();
    read_table(symmetry, table, path, symmetry_keys(), reader);
    if (reader.faults().size() == before && symmetry.normal.isZero(0.0))
        reader.fault(table, path + ".normal is zero. Give the direction to the side where bodies are.");
}

/// Tables in a list, [[patterns]]. What has a fault is left out.
template <class Section>
Key<Settings> list_key(const char* name, std::vector<Section> Settings::*member) {
    const auto take = [member, name](Settings& settings, const Node& node, const std::string& key, Reader& reader) {
        if (node.type != Node::Type::array)
            return reader.wrong_type(node, key, fmt::format("a list of tables, [[{}]],", name));
        for (std::size_t i = 0; i < node.items.size(); ++i) {
            Section section;
            section.path = fmt::format("{}[{}]", key, i);
            section.where = node.items[i].where;
            if (!reader.is_table(node.items[i], section.path)) continue;
            const std::size_t before = reader.faults().size();
            read(section, node.items[i], section.path, reader);
            if (reader.faults().size() == before) (settings.*member).push_back(std::move(section));
        }
    };
    return {.name = name, .take = take};
}

/// Sections that are tables of keys.
Key<Settings> table_key(const char* name, const Keys<Settings>& keys) {
    const auto take = [&keys](Settings& settings, const Node& node, const std::string& key, Reader& reader) {
        if (reader.is_table(node, key)) read_table(settings, node, key, keys, reader);
    };
    return {.name = name, .take = take};
}

template <class Section>
Key<Settings> named_key(const char* name, std::vector<Section> Settings::*member) {
    const auto take = [member](Settings& settings, const Node& node, const std::string& key, Reader& reader) {
        read_named(
            settings.*member, node, key, reader,
            [&reader](Section& section, const Node& table, const std::string& path) { read(section, table, path, reader); });
    };
    return {.name = name, .take = take};
}
/// Key of a table that is read already, wherever it stands.
Key<Settings> read_before(const char* name) {
    return {.name = name, .take = [](Settings&, const Node&, const std::string&, Reader&) {}};
}

Key<Settings> bodies_key() {
    const auto take = [](Settings& settings, const Node& node, const std::string& key, Reader& reader) {
        read_named(settings.bodies, node, key, reader, [&](BodySettings& body, const Node& table, const std::string& path) {
            read(body, table, path, settings.materials, reader);
        });
    };
    return {.name = "bodies", .help = "what is run, [bodies.NAME]", .take = take, .required = true};
}

}  // namespace

Key<Settings> materials_key() { return named_key("materials", &Settings::materials); }

Keys<Settings> all_keys() {
    Keys<Settings> keys = top_keys();
    keys.push_back(read_before("values"));
    keys.push_back(read_before("materials"));
    keys.push_back(bodies_key());
    keys.push_back(list_key("patterns", &Settings::patterns));
    keys.push_back(list_key("symmetry", &Settings::symmetries));
    keys.push_back(named_key("obstacles", &Settings::obstacles));
    keys.push_back(named_key("supports", &Settings::supports));
    keys.push_back(named_key("tractions", &Settings::tractions));
    keys.push_back(named_key("springs", &Settings::springs));
    keys.push_back(named_key("moments", &Settings::moments));
    keys.push_back(table_key("run", run_keys()));
    keys.push_back(table_key("contact", contact_keys()));
    keys.push_back(table_key("output", output_keys()));
    keys.push_back(table_key("laboratory", laboratory_keys()));
    return keys;
}

}  // namespace abut::input
