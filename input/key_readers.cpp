#include "abut/input/key_readers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "abut/contact/option_table.hpp"
#include "abut/input/keys.hpp"
#include "abut/run/option_table.hpp"
#include "abut/solid/combinations/combinations.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/material/material_numbers.hpp"
#include "abut/solid/options/option_words.hpp"

namespace abut::input {
namespace {

const std::string with_contact = "contact, which contact.enabled switches off";
const std::string with_deformation = "a kinematics that deforms (small, floating, finite)";

std::string words(const char* key, const std::vector<std::string>& values) {
    return fmt::format("{} = \"{}\"", key, fmt::join(values, "\" or \""));
}

template <class Section>
bool has_key(const Keys<Section>& keys, const std::string& name) {
    return std::ranges::find(keys, name, &Key<Section>::name) != keys.end();
}

// What a body may have, by the kinematics that it is run with.
class Mover {
public:
    Mover(const BodySettings& body, const run::RunOptions& options)
        : chosen_by_pilot_(options.kinematics == run::BodyKinematics::automatic),
          kinematics_(run::kinematics_of_all(options.kinematics).value_or(body.kinematics)) {}

    [[nodiscard]] bool has(solid::Feature feature) const {
        return chosen_by_pilot_ || solid::go_together(solid::feature_of(kinematics_), feature);
    }
    [[nodiscard]] bool deforms() const { return chosen_by_pilot_ || solid::properties_of(kinematics_).deforms; }
    [[nodiscard]] bool has_finite_strains() const {
        return !chosen_by_pilot_ && solid::properties_of(kinematics_).finite_strains;
    }

private:
    bool chosen_by_pilot_;
    solid::Kinematics kinematics_;
};

template <class Asked>
bool any_body(const Settings& settings, const Asked& asked) {
    return std::ranges::any_of(
        settings.bodies, [&](const BodySettings& body) { return asked(body) || std::ranges::any_of(body.parts, asked); });
}

void read_number(const BodySettings& body, const Mover& mover, const solid::MaterialNumber& number) {
    const GivenKeys& given = body.given;
    if (number.law && *number.law != body.material.law)
        return given.read_with(false, number.name, words("law", {word_of(solid::material_law_words, *number.law)}));
    switch (number.use) {
        case solid::MaterialUse::motion:
            return given.read(number.name);
        case solid::MaterialUse::deformation:
            return given.read_with(mover.deforms(), number.name, with_deformation);
        case solid::MaterialUse::damping:
            return given.read_with(mover.has(solid::Feature::damping), number.name, with_deformation);
        case solid::MaterialUse::temperature:
            return given.read_with(body.temperature_rise.has_value(), number.name, "temperature_rise");
    }
}

void read_material(const BodySettings& body, const Mover& mover) {
    const bool has_axes =
        body.material.law == solid::MaterialLaw::orthotropic;  // which contact with a rigid body knows, too
    for (const solid::MaterialNumber& number : solid::material_numbers) read_number(body, mover, number);
    body.given.read_with(mover.deforms() || has_axes, "law", with_deformation);
    body.given.read_with(body.material.law == solid::MaterialLaw::j2, "hardening_table", words("law", {"j2"}));
    for (const char* axis : {"axis_1", "axis_2"}) body.given.read_with(has_axes, axis, words("law", {"orthotropic"}));
}

/// A mesh that is given comes as it is.
bool is_given(const BodySettings& body, const GivenMeshes* meshes) {
    const std::string name = body.mesh.string();
    return meshes && (meshes->of<2>().contains(name) || meshes->of<3>().contains(name));
}

void read_keys(const BodySettings& body, const Settings& settings) {
    const Mover mover(body, settings.options);
    for (const char* key : {"material", "kinematics", "place", "turn", "velocity", "spin"}) body.given.read(key);
    read_material(body, mover);
    body.given.read_with(mover.has(solid::Feature::temperature), "temperature_rise", with_deformation);
    body.given.read_with(mover.deforms(), "fracture", with_deformation);
    body.given.read_with(mover.has(solid::Feature::erosion_limit), "erosion", with_deformation);
    if (settings.contact)
        body.given.read_with(mover.deforms(), "self", with_deformation);
    else
        body.given.read_with(false, "self", with_contact);
    for (const std::string& name : body.given.names())
        if (!has_key(body_keys(), name)) body.given.read(name);  // its shape has it, or it is a table of a part
    if (is_given(body, settings.meshes.get()))
        for (const char* key : {"non_planar", "planarity_tolerance"})
            body.given.read_with(false, key, "a mesh that is read from a file");
    for (const BodySettings& part : body.parts) read_keys(part, settings);
}

/// `prefix`: of its names.
void read_friction(const GivenKeys& given, const std::string& prefix) {
    const auto has = [&](const char* key) { return given.has(prefix + key); };
    for (const char* key : {"friction", "sliding_friction", "shear_strength"}) given.read(prefix + key);
    for (const char* key : {"decay_speed", "decay_slip"})
        given.read_with(has("sliding_friction"), prefix + key, prefix + "sliding_friction");
    given.read_with(has("friction") || has("sliding_friction") || has("shear_strength"), prefix + "relaxation_time",
                    prefix + "friction");
}

void read_keys(const PairSettings& pair) {
    for (const char* key : {"bodies", "groups", "interference"}) pair.given.read(key);
    pair.given.read_with(pair.interference == Interference::resolve, "interference_time",
                         words("interference", {"resolve"}));
    read_friction(pair.given, "");
}

void read_keys(const BondSettings& bond, const run::RunOptions& options) {
    for (const char* key : {"bodies", "groups"}) bond.given.read(key);
    bond.given.read_with(options.integrator == run::SolidIntegrator::memm, "strength", words("run.integrator", {"memm"}));
    bond.given.read_with(bond.given.has("strength"), "fracture_energy", "strength");
}

void read_keys(const AnchorSettings& anchor) {
    for (const char* key : {"body", "point"}) anchor.given.read(key);
    anchor.given.read_with(!anchor.body.empty(), "radius", "body: the ground has no cells");
}

void read_keys(const ProbeSettings& probe, bool has_contact) {
    for (const char* key : {"body", "point"}) probe.given.read(key);
    probe.given.read_with(probe.point.has_value(), "in_body", "point");
    probe.given.read_with(has_contact, "contact", with_contact);
}

bool is_friction(const OptionFacts& option) {
    return std::ranges::find(contact::friction_options(), option.name, &OptionFacts::name) !=
           contact::friction_options().end();
}

/// Options of contact alone, in [contact] and in [laboratory].
bool is_of_contact(const OptionFacts& option) {
    const auto& of_contact = contact::contact_options();
    return option.table == "contact" || std::ranges::find(of_contact, option.name, &OptionFacts::name) != of_contact.end();
}

std::string path_of(const OptionFacts& option) { return option.table + "." + option.scene_key(); }

/// Whether the chosen scheme and law read an option; else the key is left with the names of those that do.
bool read_by_scheme_and_law(const Settings& settings, const OptionFacts& option, const std::string& path) {
    const auto is_in = [](const std::vector<std::string>& all, const std::string& word) {
        return all.empty() || std::ranges::find(all, word) != all.end();
    };
    const std::string scheme = name_of(settings.options.integrator),
                      law = word_of(solid::law_words, acting_law(settings.options.law));
    const bool has_scheme = is_in(option.schemes, scheme);
    const bool has_law = is_in(option.laws, law);
    if (!has_scheme) settings.given.read_with(false, path, words("run.integrator", option.schemes));
    if (!has_law) settings.given.read_with(false, path, words("contact.law", option.laws));
    return has_scheme && has_law;
}

bool has_frames(const Settings& settings) { return settings.options.frames != 0 || !settings.options.times.empty(); }

/// Options that depend on others, by their paths.
bool depends_on_others(const Settings& settings, const std::string& path) {
    const GivenKeys& given = settings.given;
    const auto mover = [&](const BodySettings& body) { return Mover(body, settings.options); };
    if (path == "run.steps") return given.read_unless(given.has("run.time"), path, "run.time"), true;
    if (path == "run.cfl") return given.read_unless(given.has("run.dt"), path, "run.dt"), true;
    if (path == "run.rebalance_above") return given.read_with(given.has("run.rebalance"), path, "run.rebalance"), true;
    if (path == "laboratory.mean_force") {
        const bool bends = any_body(settings, [&](const auto& body) { return mover(body).has_finite_strains(); });
        return given.read_with(bends, path, words("kinematics", {"finite"})), true;
    }
    if (path == "laboratory.free_faces") {
        const auto has_rule = [&](const BodySettings& body) {
            return mover(body).deforms() && !mover(body).has_finite_strains();
        };
        return given.read_with(any_body(settings, has_rule), path, words("kinematics", {"small", "floating"})), true;
    }
    if (path == "laboratory.corners") {
        // Faces answer to what the modified reconstruction or a bond moves; parts of a file are bonded.
        const bool may_be_bonded = !settings.bonds.empty() || any_body(settings, [](const BodySettings& body) {
            return body.shape == Shape::file || !body.parts.empty();
        });
        const bool by_pairs = !settings.contact || acting_law(settings.options.law) == solid::ContactLaw::pair_potential;
        return given.read_with(may_be_bonded || !by_pairs, path, words("contact.law", {"reconstruction"})), true;
    }
    if (path == "contact.self") {
        const bool deforms = any_body(settings, [&](const auto& body) { return mover(body).deforms(); });
        return given.read_with(deforms, path, with_deformation), true;
    }
    if (path == "laboratory.self_contact_rings")
        return given.read_with(settings.options.contact.search.self_contact, path, "self = true"), true;
    if (path == "output.format" || path == "output.pieces")
        return given.read_with(has_frames(settings), path, "output.frames"), true;
    if (path == "output.frames") return given.read_unless(!settings.options.times.empty(), path, "output.times"), true;
    return false;
}

void read_options(const Settings& settings) {
    for (const OptionFacts& option : run::run_options()) {
        const std::string path = path_of(option);
        if (is_of_contact(option) && (!settings.contact || is_friction(option))) continue;
        if (!read_by_scheme_and_law(settings, option, path) || depends_on_others(settings, path)) continue;
        settings.given.read(path);
    }
}

void read_contact(const Settings& settings) {
    settings.given.read("contact.enabled");
    if (settings.contact) {
        for (const char* key : {"contact.pairs", "contact.ignored_pairs", "obstacles"}) settings.given.read(key);
        return read_friction(settings.given, "contact.");
    }
    const auto idle = [&](const std::string& path) { settings.given.read_with(false, path, with_contact); };
    for (const std::string& name : settings.given.names())
        if (name == "obstacles" || (name.starts_with("contact.") && name != "contact.enabled")) idle(name);
    for (const OptionFacts& option : run::run_options())
        if (option.table == "laboratory" && is_of_contact(option)) idle(path_of(option));
}

void read_output(const Settings& settings) {
    const GivenKeys& given = settings.given;
    given.read("output.probes");
    given.read("output.sample_interval");  // in memory there are always rows to take
    given.read_with(settings.contact, "output.forces", with_contact);
    given.read_with(has_frames(settings), "output.fields", "output.frames");
}

}  // namespace

void mark_keys_read(const Settings& settings) {
    for (const std::string& name : settings.given.names())
        if (name.find('.') == std::string::npos && name != "obstacles") settings.given.read(name);
    settings.given.read("run.preset");
    read_options(settings);
    read_contact(settings);
    read_output(settings);
    for (const BodySettings& body : settings.bodies) read_keys(body, settings);
    for (const PairSettings& pair : settings.pairs) read_keys(pair);
    for (const BondSettings& bond : settings.bonds) read_keys(bond, settings.options);
    for (const SpringSettings& spring : settings.springs)
        for (const AnchorSettings* end : {&spring.from, &spring.to}) read_keys(*end);
    for (const ProbeSettings& probe : settings.probes) read_keys(probe, settings.contact);
}

}  // namespace abut::input
