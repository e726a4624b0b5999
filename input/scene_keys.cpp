#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "abut/contact/option_table.hpp"
#include "abut/input/keys.hpp"
#include "abut/input/option_keys.hpp"
#include "abut/mesh/io/length_units.hpp"
#include "abut/run/option_table.hpp"
#include "abut/solid/options/number_tables.hpp"

namespace abut::input {
namespace {

using Of = Make<Settings>;

/// The keys of a table of options, behind those that are none.
Keys<Settings> with_options(Keys<Settings> keys, const char* table) {
    const auto owner = [](Settings& settings) -> run::RunOptions& { return settings.options; };
    const Keys<Settings> of_table = keys_of_options<Settings>(run::run_options(), table, owner);
    keys.insert(keys.end(), of_table.begin(), of_table.end());
    return keys;
}

constexpr std::array<Word<solid::Constraint>, 3> constraint_words{{{"full", solid::Constraint::full},
                                                                   {"normal", solid::Constraint::normal},
                                                                   {"components", solid::Constraint::components}}};

constexpr std::array<Word<Interference>, 2> interference_words{
    {{"refuse", Interference::refuse}, {"resolve", Interference::resolve}}};

template <class Section>
Key<Section> group() {
    return required(Make<Section>::text("group", &Section::group, "text",
                                        "group of boundary faces, \"<body>.<group>\" such as \"left.xmin\""));
}

Key<TractionSettings> follows() {
    Key<TractionSettings> key = key_of<TractionSettings>(
        "follows", "true, false", "of value: it turns with the body; a pressure always does", &TractionSettings::follows,
        [](Reader& reader, const Node& node, const std::string& path) { return reader.truth(node, path); });
    key.by_default = "false";
    return key;
}

/// One name or two.
std::optional<std::vector<std::string>> names(Reader& reader, const Node& node, const std::string& key) {
    if (node.type != Node::Type::array || node.items.empty() || node.items.size() > 2 ||
        std::ranges::any_of(node.items, [](const Node& name) { return name.type != Node::Type::text; })) {
        reader.wrong_type(node, key, "two names such as [\"left\", \"floor\"]");
        return std::nullopt;
    }
    std::vector<std::string> all;
    for (const Node& name : node.items) all.push_back(name.text);
    return all;
}

/// Tables [[name]], each of two sides: bodies and groups together.
template <class Section>
Key<Settings> tables_of_two(const char* name, const char* help, const Keys<Section>& (*keys)(),
                            std::vector<Section> Settings::*member, const char* examples) {
    const auto take = [keys, member, examples](Settings& settings, const Node& node, const std::string& key,
                                               Reader& reader) {
        if (node.type != Node::Type::array) return reader.wrong_type(node, key, "tables [[" + key + "]]");
        for (std::size_t i = 0; i < node.items.size(); ++i) {
            const std::string path = key + "[" + std::to_string(i) + "]";
            if (!reader.is_table(node.items[i], path)) continue;
            Section section;
            section.where = node.items[i].where;
            const std::size_t n_faults = reader.faults().size();
            read_table(section, node.items[i], path, keys(), reader);
            const std::size_t n_sides = section.bodies.size() + section.groups.size();
            if (n_sides == 2)
                (settings.*member).push_back(std::move(section));
            else if (reader.faults().size() == n_faults)
                reader.fault(node.items[i], path + ": bodies and groups name " + std::to_string(n_sides) +
                                                " together, 2 are needed: " + examples + ", or one of each.");
        }
    };
    return {.name = name, .value = "tables", .help = help, .take = take};
}

Key<Settings> pairs() {
    return tables_of_two("pairs",
                         "two bodies, obstacles or groups of faces with a law of friction of their own or an overlap at the "
                         "start, [[contact.pairs]]",
                         pair_keys, &Settings::pairs,
                         "bodies = [\"left\", \"floor\"], groups = [\"left.xmin\", \"right.xmax\"]");
}

Key<Settings> bonds() {
    return tables_of_two("bonds", "two bodies or groups of faces that are glued where they touch at rest, [[bonds]]",
                         bond_keys, &Settings::bonds,
                         "bodies = [\"left\", \"right\"], groups = [\"left.xmax\", \"right.xmin\"]");
}

}  // namespace

const Keys<Settings>& top_keys() {
    static const Keys<Settings> keys = {
        required(Of::count("dim", &Settings::dim, 2, 3, "dimension: 2, plane strain, or 3")),
        Of::text("title", &Settings::title, "text", "heads the report, instead of the name of the scene"),
        Of::text("comment", &Settings::comment, "text", "what the scene is about, for the report"),
        Of::vector("gravity", &Settings::gravity, "m/s^2", "0", "acceleration of all bodies"),
        Of::number("energy_scale", &Settings::energy_scale, {.unit = "J", .above = 0.0, .zero = true},
                   "what energies are measured with; 0: the largest of kinetic energy, V and work from outside so far"),
        bonds()};
    return keys;
}

const Keys<Settings>& run_keys() {
    static const Keys<Settings> keys =
        with_options({Of::word("preset", &Settings::preset, run::preset_words,
                               "several choices at once, which other keys overrule (docs/trade.md): speed or accuracy")},
                     "run");
    return keys;
}

const Keys<Settings>& contact_keys() {
    static const Keys<Settings> keys = with_options(
        {Of::truth("enabled", &Settings::contact, "false: bodies pass through each other"),
         key_of<Settings>("ignored_pairs", "list of pairs of names",
                          "bodies, or a body and an obstacle, that pass through each other: [[\"left\", \"floor\"]]",
                          &Settings::ignored_pairs,
                          [](Reader& reader, const Node& node, const std::string& key) { return reader.pairs(node, key); }),
         pairs()},
        "contact");
    return keys;
}

const Keys<Settings>& laboratory_keys() {
    static const Keys<Settings> keys = with_options({}, "laboratory");
    return keys;
}

const Keys<PairSettings>& pair_keys() {
    static const Keys<PairSettings> keys = [] {
        Keys<PairSettings> all{
            key_of<PairSettings>("bodies", "names",
                                 "two bodies, or a body and an obstacle; one of them beside one of `groups`",
                                 &PairSettings::bodies, names),
            key_of<PairSettings>(
                "groups", "names",
                "two groups of boundary faces, \"<body>.<group>\"; one of them beside one of `bodies`. A law "
                "with more groups goes before one with fewer, then that which comes first",
                &PairSettings::groups, names),
            Make<PairSettings>::word("interference", &PairSettings::interference, interference_words,
                                     "resolve: they overlap at the start on purpose, and contact comes to act over "
                                     "interference_time"),
            Make<PairSettings>::number("interference_time", &PairSettings::interference_time, {.unit = "s", .above = 0.0},
                                       "from the start on; needed with interference = \"resolve\"")};
        const Keys<PairSettings> of_friction =
            keys_of_options<PairSettings>(contact::friction_options(), "", [](PairSettings& pair) -> contact::Friction& {
                pair.has_friction = true;
                return pair.friction;
            });
        all.insert(all.end(), of_friction.begin(), of_friction.end());
        return all;
    }();
    return keys;
}

const Keys<BondSettings>& bond_keys() {
    static const Keys<BondSettings> keys = {
        key_of<BondSettings>(
            "bodies", "names",
            "two bodies; one of them beside one of `groups`. Of copies of a pattern: all that lie side by side",
            &BondSettings::bodies, names),
        key_of<BondSettings>("groups", "names",
                             "two groups of boundary faces, \"<body>.<group>\"; one of them beside one of `bodies`",
                             &BondSettings::groups, names),
        Make<BondSettings>::number("strength", &BondSettings::strength,
                                   number_of(solid::bond_numbers, &solid::Bond::strength).limits,
                                   "largest traction that it bears, pressure not counted; not given: it holds for ever"),
        Make<BondSettings>::number("fracture_energy", &BondSettings::fracture_energy,
                                   number_of(solid::bond_numbers, &solid::Bond::fracture_energy).limits,
                                   "that it takes per area as it opens from its strength on; 0: it breaks at once")};
    return keys;
}

const Keys<ObstacleSettings>& obstacle_keys() {
    using Obstacle = ObstacleSettings;
    using From = Make<Obstacle>;
    static const Keys<Obstacle> keys = {
        From::vector("place", &Obstacle::place, "m", "0", "where its own origin goes, after it is turned"),
        From::axial("turn", &Obstacle::turn, "rad", "turn about its own origin before it is placed"),
        From::vector("velocity", &Obstacle::velocity, "m/s", "0", "velocity, constant in time"),
        From::field("path", &Obstacle::path, "m", Variables::time, "how far it has moved at t [s], instead of velocity"),
        From::axial("spin", &Obstacle::spin, "rad/s", "angular velocity, constant in time"),
        From::axial_field("rotation", &Obstacle::rotation, "rad", "how far it has turned at t [s], instead of spin"),
        From::vector(
            "pivot", &Obstacle::pivot, "m", "",
            "about which it turns, and which moves with it; by default the middle of the box around it, of a plane its "
            "point")};
    return keys;
}

const std::vector<Variety<ObstacleSettings, ObstacleShape>>& obstacle_varieties() {
    using Obstacle = ObstacleSettings;
    using From = Make<Obstacle>;
    const auto inside = From::truth("inside", &Obstacle::inside, "bodies are inside of it, as in a room");
    const auto points = [](Reader& reader, const Node& node, const std::string& key) {
        return reader.points(node, key, {.unit = "m"});
    };
    auto corners = required(
        key_of<Obstacle>("corners", "list of points", "corners in order, in either sense", &Obstacle::corners, points));
    corners.unit = "m";
    static const std::vector<Variety<Obstacle, ObstacleShape>> varieties = with_all_keys<Obstacle, ObstacleShape>(
        {{"plane",
          ObstacleShape::plane,
          {2, 3},
          {required(
               From::vector("point", &Obstacle::point, "m", "", "one of its points; its middle where it has a half_width")),
           required(From::vector("normal", &Obstacle::normal, "", "", "direction it faces, of any length")),
           From::number("half_width", &Obstacle::half_width, {.unit = "m", .above = 0.0},
                        "how far it reaches in every direction; not given: without end")}},
         {"box",
          ObstacleShape::box,
          {2, 3},
          {required(From::vector("lower", &Obstacle::lower, "m", "", "corner with the smallest coordinates")),
           required(From::vector("upper", &Obstacle::upper, "m", "", "corner with the largest coordinates")), inside}},
         {"polygon", ObstacleShape::polygon, {2}, {corners, inside}},
         {"surface",
          ObstacleShape::surface,
          {3},
          {required(From::text("surface", &Obstacle::surface, "path",
                               ".stl, .obj, .off, .ply or .vtp file, from the folder of the scene; no shape is needed")),
           From::word("unit", &Obstacle::unit, mesh::length_units, "unit of the file's lengths"),
           From::number("scale", &Obstacle::scale, {.above = 0.0},
                        "the obstacle is that many times as large as the file has it"),
           inside}}});
    return varieties;
}

const Keys<SupportSettings>& support_keys() {
    using Support = SupportSettings;
    using From = Make<Support>;
    static const Keys<Support> keys = {
        group<Support>(),
        From::word("constraint", &Support::constraint, constraint_words,
                   "all of the displacement, along the normal alone (roller), or some components"),
        key_of<Support>(
            "components", "list of x, y, z", "of constraint \"components\": which", &Support::components,
            [](Reader& reader, const Node& node, const std::string& key) { return reader.components(node, key); }),
        From::field("value", &Support::value, "m", Variables::time_and_space, "displacement; by default 0")};
    return keys;
}

const Keys<TractionSettings>& traction_keys() {
    using Traction = TractionSettings;
    using From = Make<Traction>;
    static const Keys<Traction> keys = {
        group<Traction>(), From::field("value", &Traction::value, "Pa", Variables::time_and_space, "force per area"),
        From::formula("pressure", &Traction::pressure, "Pa", Variables::time_and_space,
                      "against the outward normals, with which it turns, instead of value"),
        follows()};
    return keys;
}

}  // namespace abut::input
