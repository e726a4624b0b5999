#include <array>

#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/input/keys.hpp"

namespace abut::input {
namespace {

using Of = Make<Settings>;
using run::RunOptions;

/// A member of the options of the run.
template <class Value>
auto option(Value RunOptions::*member) {
    return [member](Settings& settings) -> Value& { return settings.options.*member; };
}
template <class Value>
auto contact(Value contact::ContactOptions::*member) {
    return [member](Settings& settings) -> Value& { return settings.options.contact.*member; };
}
auto facing(double geometry::FacingFade::*member) {
    return [member](Settings& settings) -> double& { return settings.options.facing.*member; };
}
template <class Value>
auto search(Value contact::CandidateOptions::*member) {
    return [member](Settings& settings) -> Value& { return settings.options.contact.search.*member; };
}

std::vector<run::Word<geometry::BroadPhase>> broad_phase_words() {
    std::vector<run::Word<geometry::BroadPhase>> words;
    for (const auto method : geometry::broad_phases()) words.push_back({geometry::name(method).data(), method});
    return words;
}

constexpr Limits any{};
constexpr Limits a_time{.unit = "s", .above = 0.0};

constexpr std::array<run::Word<solid::Constraint>, 3> constraint_words{{{"full", solid::Constraint::full},
                                                                        {"normal", solid::Constraint::normal},
                                                                        {"components", solid::Constraint::components}}};

Key<Settings> by_default(std::string words, Key<Settings> key) {
    key.by_default = std::move(words);
    return key;
}

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

}  // namespace

const Keys<Settings>& top_keys() {
    static const Keys<Settings> keys = {
        required(Of::count("dim", &Settings::dim, 2, 3, "dimension: 2, plane strain, or 3")),
        Of::vector("gravity", &Settings::gravity, "m/s^2", "0", "acceleration of all bodies"),
        Of::number("energy_scale", &Settings::energy_scale, {.unit = "J", .above = 0.0, .zero = true},
                   "what energies are measured with; 0: the largest of kinetic energy, V and work from outside so far")};
    return keys;
}

const Keys<Settings>& run_keys() {
    static const Keys<Settings> keys = {
        Of::word("preset", &Settings::preset, run::preset_words,
                 "several choices at once, which other keys overrule (trade.md): speed or accuracy"),
        Of::number("time", option(&RunOptions::time), a_time, "end of the run"),
        Of::count("steps", option(&RunOptions::steps), 0, Of::many, "steps of the run where no time is given"),
        Of::number("cfl", option(&RunOptions::cfl), {.above = 0.0, .below = 1.0, .closed = true},
                   "time step over the stable step"),
        Of::number("dt", option(&RunOptions::dt), a_time, "time step, instead of cfl"),
        Of::truth("allow_unstable", option(&RunOptions::allow_unstable), "take dt even above the stable step"),
        Of::word("integrator", option(&RunOptions::integrator), run::integrator_words, "scheme in time (integrators.md)"),
        Of::word("precision", option(&RunOptions::precision), run::precision_words,
                 "of the bulk in steps of memm and leapfrog: single is less exact (trade.md)"),
        Of::word("device", option(&RunOptions::device), run::device_words,
                 "of the bulk in steps of memm and leapfrog: the host, or what Kokkos was built for (devices.md)"),
        Of::count("levels", option(&RunOptions::levels), 0, Of::many, "of memm_async: different steps at most; 0: 8"),
        Of::count("contact_margin", option(&RunOptions::contact_margin), 0, Of::many,
                  "of memm_async: levels that cells in contact are finer than they need to be alone"),
        Of::count("contact_levels", option(&RunOptions::contact_levels), 0, Of::many,
                  "of memm_async: levels that cells in contact are finer than all others"),
        Of::number("gauge", option(&RunOptions::gauge), {.unit = "J", .above = 0.0},
                   "c of the Bilbao scheme; by default the energy at the start"),
        Of::word("filter", option(&RunOptions::filter), run::filter_words, "energy-neutral filter of the parasitic mode"),
        by_default("50 where a body is finite, else 0", Of::count("restart", option(&RunOptions::restart), 0, Of::many,
                                                                  "of memm: steps between neutral restarts; 0: none")),
        Of::word("kinematics", option(&RunOptions::kinematics), run::kinematics_words,
                 "of all bodies: as each body says (scene), the same for all, or chosen by a pilot run (automatic)"),
        Of::count("threads", option(&RunOptions::threads), 0, Of::many,
                  "threads at most; 0: all. The results do not depend on it")};
    return keys;
}

const Keys<Settings>& contact_keys() {
    using contact::CandidateOptions;
    using contact::ContactOptions;
    static const Keys<Settings> keys = {
        Of::truth("enabled", &Settings::contact, "false: bodies pass through each other"),
        key_of<Settings>("ignored_pairs", "list of pairs of names",
                         "bodies, or a body and an obstacle, that pass through each other: [[\"left\", \"floor\"]]",
                         &Settings::ignored_pairs,
                         [](Reader& reader, const Node& node, const std::string& key) { return reader.pairs(node, key); }),
        Of::word("law", option(&RunOptions::law), run::law_words,
                 "the modified reconstruction for bodies that do not turn; the pair potential for all, and by default"),
        Of::truth("self", search(&CandidateOptions::self_contact),
                  "also between parts of one body; of the modified reconstruction"),
        Of::word("broad_phase", search(&CandidateOptions::broad_phase), broad_phase_words(),
                 "what finds faces that are near"),
        Of::word("overlap", contact(&ContactOptions::overlap), run::overlap_words,
                 "area that follows the motion in a step or is frozen"),
        Of::word("weights", contact(&ContactOptions::weighting), run::weighting_words,
                 "share of a correction between two faces"),
        Of::word("area", contact(&ContactOptions::area), run::area_words, "arithmetic of overlap areas"),
        Of::truth("events", contact(&ContactOptions::events), "cut steps where a pair opens, closes or changes its overlap"),
        Of::count("quadrature", contact(&ContactOptions::quadrature), 0, 3,
                  "Gauss points on each part of a step; 0: the exact number, 2 in 2D, 3 in 3D"),
        Of::number("facing_cosine", search(&CandidateOptions::facing_cosine), {.above = -1.0, .below = 0.0},
                   "faces look at each other where the cosine between their normals is below it"),
        Of::number(
            "facing_full", facing(&geometry::FacingFade::full), {.above = -1.0, .below = 0.0},
            "of the pair potential: cosine between the normals of two faces up to which their pair has its whole weight"),
        Of::number("facing_none", facing(&geometry::FacingFade::none), {.above = -1.0, .below = 0.0, .closed = true},
                   "and from which on it has none; nearer to 0 sharper tips and edges are seen"),
        Of::number("skin", search(&CandidateOptions::skin), {.unit = "m", .above = 0.0, .zero = true},
                   "how far faces move before the list of near faces is rebuilt; 0: chosen"),
        Of::number("compression_limit", contact(&ContactOptions::compression_limit), {.above = 0.0},
                   "depth over that of a cell at which the run stops"),
        Of::word("neumann", option(&RunOptions::neumann), run::free_face_words, "displacement of free faces"),
        Of::word("corners", option(&RunOptions::corners), run::corner_words, "free faces of a cell beside one in contact")};
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
           From::number("scale", &Obstacle::scale, {.unit = "m", .above = 0.0},
                        "length of the file's unit, 1e-3 for millimetres"),
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
