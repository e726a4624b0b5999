#include "abut/input/read_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "abut/input/key_readers.hpp"
#include "abut/input/keys.hpp"
#include "abut/input/nearest_word.hpp"
#include "abut/input/patterns.hpp"

namespace abut::input {
namespace {

/// Each may be a formula of those before it. One that cannot be read is 1, so that nothing is said of formulas that use it.
void read_numbers(const Node& table, Reader& reader) {
    if (!reader.is_table(table, "values")) return;
    for (std::size_t i = 0; i < table.items.size(); ++i) {
        const std::string key = "values." + table.names[i];
        try {
            check_name_of_number(table.names[i]);
        } catch (const BadInput& error) {
            reader.fault(table.items[i], fmt::format("{}: {}", in_one_line(key), error.what()));
            continue;
        }
        const auto measured = reader.measured(table.items[i], key).value_or(Reader::Measured{.value = 1.0, .dimension = {}});
        reader.numbers.push_back({.name = table.names[i],
                                  .where = table.items[i].where,
                                  .value = measured.value,
                                  .dimension = measured.dimension});
    }
}

/// A number that no formula uses may be a name mistyped. Those of the file may be in formulas that `set` has replaced.
void check_numbers_used(const std::vector<std::string>& set, Reader& reader) {
    std::vector<std::string> used;
    for (const NamedNumber& number : reader.numbers)
        if (number.used) used.push_back(number.name);
    for (const NamedNumber& number : reader.numbers)
        if (!number.used && (set.empty() || number.where.starts_with("--set")))
            reader.faults().push_back(
                {number.where, fmt::format("values.{} is used by no formula.{}", number.name,
                                           used.empty() ? " Leave it out." : hint(number.name, used))});
}

/// Vectors cannot be read before.
int dimension_of(const Node& document) {
    const Node* dim = document.find("dim");
    return dim && (dim->whole == 2 || dim->whole == 3) ? static_cast<int>(dim->whole) : 0;
}

/// Under all other keys, wherever they stand. One that is none of its words stays for the key to say.
void apply_preset(const Node& document, run::RunOptions& options) {
    const Node* run = document.find("run");
    const Node* preset = run ? run->find("preset") : nullptr;
    if (!preset) return;
    for (const auto& [word, choice] : run::preset_words)
        if (preset->text == word) run::apply(choice, options);
}

/// Keys of [run] of which one alone is read.
constexpr std::array<std::array<const char*, 2>, 2> alternatives{{{"steps", "time"}, {"cfl", "dt"}}};

const Node* of_run(const Node& document, const std::string& key) {
    const Node* run = document.find("run");
    return run ? run->find(key) : nullptr;
}

void erase_of_run(Node& document, const std::string& key) {
    const auto run = std::ranges::find(document.names, "run");
    if (!of_run(document, key)) return;
    Node& table = document.items[static_cast<std::size_t>(run - document.names.begin())];
    const auto at = std::ranges::find(table.names, key) - table.names.begin();
    table.names.erase(table.names.begin() + at);
    table.items.erase(table.items.begin() + at);
}

/// A key that is set takes the place of its alternative in the file.
void merge_overrides(Node& document, const std::vector<std::string>& set, std::vector<Fault>& faults) {
    std::vector<Node> given;
    for (const std::string& text : set) try {
            given.push_back(read_override(text));
        } catch (const SceneError& error) {
            faults.insert(faults.end(), error.faults().begin(), error.faults().end());
        }
    for (const auto& keys : alternatives)
        for (const std::size_t i : {0, 1})
            if (std::ranges::any_of(given, [&](const Node& node) { return of_run(node, keys[i]) != nullptr; }))
                erase_of_run(document, keys[1 - i]);
    for (const Node& node : given) merge(document, node);
}

/// Checks what no key by itself can know.
void check_options(const Settings& settings, std::vector<Fault>& faults) {
    const std::string where = settings.file.string();
    const run::RunOptions& options = settings.options;
    if (std::isnan(options.time) && options.steps == 0 && !settings.given.has("run.time"))
        faults.push_back({where, "nothing says when the run ends. Give run.time [s] or run.steps."});
    if (options.allow_unstable && std::isnan(options.dt))
        faults.push_back({where, "run.allow_unstable is for run.dt, which is missing. Give it, or leave both out."});
    try {
        run::check(options);
    } catch (const BadInput& error) {
        faults.push_back({where, error.what()});
    }
}

/// Contact looks within bodies if one of them touches itself.
void take_self_contact(Settings& settings) {
    bool& looks_within = settings.options.contact.search.self_contact;
    settings.self = looks_within;
    const auto touches = [](const BodySettings& body) { return body.self.value_or(false); };
    for (const BodySettings& body : settings.bodies)
        looks_within = looks_within || touches(body) || std::ranges::any_of(body.parts, touches);
}

/// To contact the other half of a body is a rigid plane, which each of its faces meets half way.
void add_mirrors(Settings& settings) {
    for (std::size_t i = 0; i < settings.symmetries.size(); ++i) {
        const SymmetrySettings& symmetry = settings.symmetries[i];
        ObstacleSettings mirror;
        mirror.name = fmt::format("symmetry_{}", i);
        mirror.where = symmetry.where;
        mirror.shape = ObstacleShape::plane;
        mirror.point = symmetry.point;
        mirror.normal = symmetry.normal;
        mirror.is_symmetry = true;
        settings.obstacles.push_back(std::move(mirror));
    }
}

/// Settings and the reader that has their faults and keys.
struct ReadTables {
    Settings settings;
    Reader reader;
};

ReadTables tables_from(Node document, const std::filesystem::path& file, const Overrides& overrides) {
    ReadTables read{.settings = {.file = file, .set = overrides.set, .meshes = overrides.meshes}, .reader = {}};
    Reader& reader = read.reader;
    merge_overrides(document, overrides.set, reader.faults());
    reader.dimension = dimension_of(document);
    read.settings.options.out = std::filesystem::path("out") / read.settings.file.stem();
    apply_preset(document, read.settings.options);
    if (const Node* values = document.find("values")) read_numbers(*values, reader);
    if (const Node* materials = document.find("materials"))
        materials_key().take(read.settings, *materials, "materials", reader);
    read_table(read.settings, document, "", all_keys(), reader);
    if (read.settings.dim != 0 && document.find("bodies") && read.settings.bodies.empty())
        reader.fault(*document.find("bodies"), "bodies has no table. Give a body, [bodies.NAME].");
    if (read.settings.dim != 0) lay_out_patterns(read.settings, reader);
    if (read.settings.contact) add_mirrors(read.settings);
    check_numbers_used(overrides.set, reader);
    if (overrides.options) overrides.options(read.settings.options);
    take_self_contact(read.settings);
    mark_keys_read(read.settings);
    return read;
}

/// Faults of keys that nothing reads. A key of the file that has no effect only beside `set` or an option is in order,
/// and so is one of `set` beside an option: `set` and options of a command line are how a scene is tried.
std::vector<Fault> unread_keys(const ReadTables& read, const Node& document, const Overrides& overrides) {
    std::vector<Fault> faults = faults_of_unread(read.reader.given);
    if (faults.empty() || (overrides.set.empty() && !overrides.options)) return faults;
    const auto unread_with = [&](const std::vector<std::string>& set) {
        return faults_of_unread(
            tables_from(document, read.settings.file, {.set = set, .meshes = overrides.meshes}).reader.given);
    };
    const auto of_file = unread_with({}), of_set = unread_with(overrides.set);
    std::erase_if(faults, [&](const Fault& fault) {
        const std::vector<Fault>& without_others = fault.where.starts_with("--set") ? of_set : of_file;
        return std::ranges::find(without_others, fault.where, &Fault::where) == without_others.end();
    });
    return faults;
}

ReadSettings settings_from(const Node& document, const std::filesystem::path& file, const Overrides& overrides) {
    ReadTables read = tables_from(document, file, overrides);
    std::vector<Fault> faults = std::move(read.reader.faults());
    std::vector<Fault> unread;
    if (faults.empty()) unread = unread_keys(read, document, overrides);
    if (unread.empty())
        check_options(read.settings, faults);
    else
        faults = std::move(unread);
    return {std::move(read.settings), std::move(faults)};
}

}  // namespace

ReadSettings read_settings(const std::filesystem::path& path, const Overrides& overrides) {
    return settings_from(read_document(path), overrides.origin.empty() ? path : overrides.origin, overrides);
}

ReadSettings read_settings(const SceneText& scene, const Overrides& overrides) {
    return settings_from(read_text(scene.toml, scene.file.string()), scene.file, overrides);
}

}  // namespace abut::input
