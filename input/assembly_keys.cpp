#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "abut/input/keys.hpp"

namespace abut::input {
namespace {

/// A list of what `read_one` reads.
template <class ReadOne>
std::optional<std::vector<Vector<3>>> vectors(Reader& reader, const Node& node, const std::string& key, const char* wanted,
                                              const ReadOne& read_one) {
    if (node.type != Node::Type::array || node.items.empty()) {
        reader.wrong_type(node, key, wanted);
        return std::nullopt;
    }
    std::vector<Vector<3>> all;
    for (std::size_t i = 0; i < node.items.size(); ++i)
        if (const auto one = read_one(node.items[i], key + "[" + std::to_string(i) + "]")) all.push_back(*one);
    return all.size() == node.items.size() ? std::optional(all) : std::nullopt;
}

Key<PatternSettings> count() {
    const auto read = [](Reader& reader, const Node& node, const std::string& key) -> std::optional<std::vector<int>> {
        if (node.type != Node::Type::array) {
            const auto one = reader.count(node, key, 1, std::numeric_limits<int>::max());
            return one ? std::optional(std::vector<int>{*one}) : std::nullopt;
        }
        const auto all = reader.counts(node, key);
        return all ? std::optional(std::vector<int>(all->begin(), all->begin() + std::ssize(node.items))) : std::nullopt;
    };
    return key_of<PatternSettings>("count", "whole number, or one for each direction",
                                   "copies in a row or around the centre, or in a grid", &PatternSettings::count, read);
}

Key<PatternSettings> places() {
    const auto read = [](Reader& reader, const Node& node, const std::string& key) {
        return vectors(reader, node, key, "a list of places such as [[0, 0], [1, 0]]",
                       [&](const Node& item, const std::string& path) { return reader.vector(item, path, {.unit = "m"}); });
    };
    Key<PatternSettings> key = key_of<PatternSettings>(
        "places", "list of vectors", "how far each copy is from where the body is, instead of count and step",
        &PatternSettings::places, read);
    key.unit = "m";
    return key;
}

Key<PatternSettings> turns() {
    const auto read = [](Reader& reader, const Node& node, const std::string& key) {
        return vectors(reader, node, key, "a list of turns, one for each of places",
                       [&](const Node& item, const std::string& path) { return reader.axial(item, path, {.unit = "rad"}); });
    };
    Key<PatternSettings> key = key_of<PatternSettings>(
        "turns", "list of numbers (2D), of vectors (3D)",
        "with places: turn of each copy about its own origin, after that of the body", &PatternSettings::turns, read);
    key.unit = "rad";
    return key;
}

}  // namespace

const Keys<PatternSettings>& pattern_keys() {
    using Pattern = PatternSettings;
    using Of = Make<Pattern>;
    static const Keys<Pattern> keys = {
        required(Of::text("body", &Pattern::body, "text", "[bodies.NAME] that is copied; it is there as its copies alone")),
        count(),
        Of::vector("step", &Pattern::step, "m", "",
                   "from one copy to the next: along a row, or in each direction of a grid"),
        Of::vector("shift", &Pattern::shift, "m", "0",
                   "of every second copy of a row, or course of a grid along its last direction"),
        Of::vector("centre", &Pattern::centre, "m", "", "of a ring, about which copies are turned with their velocities"),
        Of::axial("angle", &Pattern::angle, "rad",
                  "of a ring: from one copy to the next; in 2D by default a full circle by count, in 3D axis times angle"),
        places(),
        turns()};
    return keys;
}

const Keys<SymmetrySettings>& symmetry_keys() {
    using Symmetry = SymmetrySettings;
    using Of = Make<Symmetry>;
    static const Keys<Symmetry> keys = {
        required(Of::vector("point", &Symmetry::point, "m", "", "one of the points of the plane")),
        required(Of::vector("normal", &Symmetry::normal, "", "", "to the side where bodies are, of any length"))};
    return keys;
}

}  // namespace abut::input
