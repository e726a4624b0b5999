#include <array>

#include "abut/input/keys.hpp"
#include "abut/input/option_keys.hpp"
#include "abut/run/option_table.hpp"

namespace abut::input {
namespace {

using Of = Make<Settings>;
using run::FrameFields;

constexpr std::array<Word<bool FrameFields::*>, 8> field_words{{{"velocity", &FrameFields::velocity},
                                                                {"stress", &FrameFields::stress},
                                                                {"von_mises", &FrameFields::von_mises},
                                                                {"plastic_strain", &FrameFields::plastic_strain},
                                                                {"pressure", &FrameFields::pressure},
                                                                {"gap", &FrameFields::gap},
                                                                {"friction", &FrameFields::friction},
                                                                {"pairs", &FrameFields::pairs}}};

Key<Settings> fields() {
    const auto read = [](Reader& reader, const Node& node, const std::string& key) -> std::optional<FrameFields> {
        std::vector<std::string> words;
        for (const auto& [word, member] : field_words) words.emplace_back(word);
        const auto chosen = reader.words(node, key, words);
        if (!chosen) return std::nullopt;
        FrameFields fields{};
        for (const auto& [word, member] : field_words) fields.*member = false;
        for (const std::size_t index : *chosen) fields.*field_words[index].choice = true;
        return fields;
    };
    Key<Settings> key =
        key_of<Settings>("fields", "list of velocity, stress, von_mises, plastic_strain, pressure, gap, friction, pairs",
                         "what frames hold beside the displacement", &Settings::fields, read);
    key.by_default = "all";
    return key;
}

Key<Settings> probes() {
    const auto take = [](Settings& settings, const Node& node, const std::string& key, Reader& reader) {
        read_named(settings.probes, node, key, reader,
                   [&](ProbeSettings& probe, const Node& table, const std::string& path) {
                       read_table(probe, table, path, probe_keys(), reader);
                   });
    };
    return {.name = "probes",
            .value = "tables",
            .help = "places that are watched, [output.probes.NAME]: a row of probes.csv tells of all",
            .take = take};
}

}  // namespace

const Keys<Settings>& output_keys() {
    static const Keys<Settings> keys = [] {
        Keys<Settings> all = keys_of_options<Settings>(
            run::run_options(), "output", [](Settings& settings) -> run::RunOptions& { return settings.options; });
        const Keys<Settings> more = {
            fields(), probes(),
            Of::truth("forces", &Settings::forces, "forces.csv: mean forces of contact between bodies, and on obstacles"),
            Of::count("sample_interval", &Settings::sample_interval, 0, Of::many,
                      "steps between rows of probes.csv and forces.csv; 0: as those of the energies")};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }();
    return keys;
}

const Keys<ProbeSettings>& probe_keys() {
    using From = Make<ProbeSettings>;
    static const Keys<ProbeSettings> keys = {
        required(From::text("body", &ProbeSettings::body, "text", "the body that is watched")),
        From::vector("point", &ProbeSettings::point, "m", "",
                     "where, at rest and in the scene: its displacement, and velocity and stress of the cell that holds it; "
                     "without it their means over the body"),
        From::truth("in_body", &ProbeSettings::in_body,
                    "whether the point is seen from the body, before its turn and place: as in its file, after scale"),
        From::truth(
            "contact", &ProbeSettings::contact,
            "forces of contact on the body, the mean since the row before, along normals and by friction, and its slip; "
            "not with a point")};
    return keys;
}

}  // namespace abut::input
