#include <array>

#include "abut/input/keys.hpp"

namespace abut::input {
namespace {

using Of = Make<Settings>;
using run::FrameFields;
using run::RunOptions;

template <class Value>
auto option(Value RunOptions::*member) {
    return [member](Settings& settings) -> Value& { return settings.options.*member; };
}

constexpr std::array<run::Word<bool FrameFields::*>, 6> field_words{{{"velocity", &FrameFields::velocity},
                                                                     {"stress", &FrameFields::stress},
                                                                     {"von_mises", &FrameFields::von_mises},
                                                                     {"pressure", &FrameFields::pressure},
                                                                     {"gap", &FrameFields::gap},
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
    Key<Settings> key = key_of<Settings>("fields", "list of velocity, stress, von_mises, pressure, gap, pairs",
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
        Keys<Settings> all = {
            Of::text("out", option(&RunOptions::out), "path", "folder of all results, from where the program is started"),
            Of::count("interval", option(&RunOptions::interval), 0, Of::many,
                      "steps between records of the energies; 0: as many as make about 2,000, in 3D at least 10"),
            Of::number("checkpoint", option(&RunOptions::checkpoint), {.unit = "min", .above = 0.0, .zero = true},
                       "time from one checkpoint to the next; 0: none"),
            Of::count("checkpoint_steps", option(&RunOptions::checkpoint_steps), 0, Of::many,
                      "steps from one checkpoint to the next, beside that; 0: by minutes alone"),
            Of::truth("keep_last_checkpoint", option(&RunOptions::keep_last_checkpoint),
                      "a run that comes to its end keeps its last state: abut restart DIR --until TIME goes on from there"),
            Of::count("frames", option(&RunOptions::frames), 0, Of::many,
                      "frames for ParaView, first and last included; 0: none"),
            Of::truth("pieces", option(&RunOptions::pieces),
                      "each rank writes its own cells of these frames; false: rank 0 writes the whole"),
            fields(),
            probes(),
            Of::truth("forces", &Settings::forces, "forces.csv: mean forces of contact between bodies, and on obstacles"),
            Of::count("sample_interval", &Settings::sample_interval, 0, Of::many,
                      "steps between rows of probes.csv and forces.csv; 0: as those of the energies")};
        all.front().by_default = "out/<scene>";
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
                     "without it their means over the body")};
    return keys;
}

}  // namespace abut::input
