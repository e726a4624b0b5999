#pragma once
// Private to the layer.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "abut/base/text.hpp"
#include "abut/input/nearest_word.hpp"
#include "abut/input/reader.hpp"

/// The keys of a table of the file as a table of ours: it reads, it checks, it knows the nearest key, and it is printed as
/// the grammar. `Section` is what the values go to; an `access` is a member of it, or a function that returns a reference.
namespace abut::input {

template <class Section>
struct Key {
    std::string name;
    std::string value;       ///< what it takes: "number", "2D|3D"
    std::string unit;        ///< empty: none
    std::string by_default;  ///< empty: none
    std::string help;
    std::function<void(Section&, const Node&, const std::string& key, Reader&)> take;
    bool required = false;
};

template <class Section>
using Keys = std::vector<Key<Section>>;

template <class Section>
[[nodiscard]] Key<Section> required(Key<Section> key) {
    key.required = true;
    key.by_default.clear();
    return key;
}

/// Whether a value asks for something: neither 0 nor false nor the default does.
template <class Section>
[[nodiscard]] bool asks_for_something(const Key<Section>& key, const Node& node) {
    switch (node.type) {
        case Node::Type::number:
        case Node::Type::whole: {
            const double value = node.type == Node::Type::whole ? static_cast<double>(node.whole) : node.number;
            return value != 0.0 && fmt::format("{:g}", value) != key.by_default;
        }
        case Node::Type::truth:
            return node.truth && key.by_default != "true";
        case Node::Type::text:
            return node.text != key.by_default;
        default:
            return true;
    }
}

/// Sections that keep the keys that they are given have a member for them; values of others act whatever else a scene says.
template <class Section>
void keep(Section& section, const Key<Section>& key, const std::string& path, const Node& node, Reader& reader) {
    if constexpr (requires { section.given; }) {
        reader.given.push_back(
            std::make_shared<GivenKey>(GivenKey{.path = path, .where = node.where, .asks = asks_for_something(key, node)}));
        section.given.add(std::is_same_v<Section, Settings> ? path : key.name, reader.given.back());
    }
}

template <class Section>
[[nodiscard]] std::vector<std::string> names_of(const Keys<Section>& keys) {
    std::vector<std::string> names;
    for (const auto& key : keys) names.push_back(key.name);
    return names;
}

/// Takes every key that the table has; faults for those that are not known and for required ones that are not there.
/// `path` is what messages put in front of a key: "bodies.left".
template <class Section>
void read_table(Section& section, const Node& table, const std::string& path, const Keys<Section>& keys, Reader& reader) {
    const std::string in = path.empty() ? "" : path + ".";
    for (std::size_t i = 0; i < table.names.size(); ++i) {
        const auto key =
            std::find_if(keys.begin(), keys.end(), [&](const auto& known) { return known.name == table.names[i]; });
        if (key == keys.end())
            reader.fault(table.items[i], fmt::format("{}{} is an unknown key.{}", in, table.names[i],
                                                     hint_of_key(table.names[i], names_of(keys))));
        else {
            keep(section, *key, in + key->name, table.items[i], reader);
            key->take(section, table.items[i], in + key->name, reader);
        }
    }
    for (const auto& key : keys)
        if (key.required && !table.find(key.name))
            reader.fault(table, fmt::format("{}{} is missing: {}{}.", in, key.name, key.help,
                                            key.unit.empty() ? "" : " [" + key.unit + "]"));
}

/// A table of tables that have names, each of which `read_one(section, table, path)` reads.
template <class Section, class ReadOne>
void read_named(std::vector<Section>& sections, const Node& node, const std::string& name, Reader& reader,
                const ReadOne& read_one) {
    if (!reader.is_table(node, name)) return;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
        const std::string path = name + "." + node.names[i];
        if (!reader.is_table(node.items[i], path)) continue;
        if (has_control_character(node.names[i]))
            reader.fault(node.items[i],
                         fmt::format("{} has a name with a control character, such as a line end or a mark that "
                                     "turns the direction of writing. Name it by letters, digits and signs.",
                                     in_one_line(path)));
        Section section;
        section.name = node.names[i];
        section.where = node.items[i].where;
        read_one(section, node.items[i], path);
        sections.push_back(std::move(section));
    }
}

/// One key: `read(reader, node, key)` returns an optional, which goes to what `access` leads to.
template <class Section, class Access, class Read>
[[nodiscard]] Key<Section> key_of(std::string name, std::string value, std::string help, Access access, Read read) {
    const auto take = [access, read](Section& section, const Node& node, const std::string& key, Reader& reader) {
        if (const auto taken = read(reader, node, key)) std::invoke(access, section) = *taken;
    };
    return {.name = std::move(name), .value = std::move(value), .help = std::move(help), .take = take};
}

/// The factories of one section.
template <class Section>
struct Make {
    using K = Key<Section>;
    static constexpr int many = std::numeric_limits<int>::max();

    template <class Access>
    static K number(std::string name, Access access, Limits limits, std::string help) {
        K key = key_of<Section>(std::move(name), "number", std::move(help), access,
                                [limits](Reader& reader, const Node& node, const std::string& path) {
                                    return reader.number(node, path, limits);
                                });
        Section fresh{};
        const double value = std::invoke(access, fresh);
        key.by_default = std::isfinite(value) ? fmt::format("{:g}", value) : "";
        key.unit = limits.unit;
        return key;
    }
    template <class Access>
    static K count(std::string name, Access access, int least, int most, std::string help) {
        K key = key_of<Section>(std::move(name), "whole number", std::move(help), access,
                                [least, most](Reader& reader, const Node& node, const std::string& path) {
                                    return reader.count(node, path, least, most);
                                });
        Section fresh{};
        key.by_default = std::to_string(std::invoke(access, fresh));
        return key;
    }
    template <class Access>
    static K truth(std::string name, Access access, std::string help) {
        K key = key_of<Section>(
            std::move(name), "true, false", std::move(help), access,
            [](Reader& reader, const Node& node, const std::string& path) { return reader.truth(node, path); });
        Section fresh{};
        key.by_default = std::invoke(access, fresh) ? "true" : "false";
        return key;
    }
    template <class Access>
    static K text(std::string name, Access access, std::string value, std::string help) {
        return key_of<Section>(
            std::move(name), std::move(value), std::move(help), access,
            [](Reader& reader, const Node& node, const std::string& path) { return reader.text(node, path); });
    }
    /// One of some words; an array of Word or the like.
    template <class Access, class Words>
    static K word(std::string name, Access access, const Words& words, std::string help) {
        using Choice = std::decay_t<decltype(std::begin(words)->choice)>;
        std::vector<std::string> names;
        std::vector<Choice> choices;
        std::string shown;
        for (const auto& [text, choice] : words) {
            names.emplace_back(text);
            choices.push_back(choice);
            shown += (shown.empty() ? "" : ", ") + names.back();
        }
        K key = key_of<Section>(std::move(name), shown, std::move(help), access,
                                [names, choices](Reader& reader, const Node& node, const std::string& path) {
                                    const auto index = reader.word(node, path, names);
                                    return index ? std::optional<Choice>(choices[*index]) : std::nullopt;
                                });
        Section fresh{};
        for (std::size_t i = 0; i < choices.size(); ++i)
            if (std::optional<Choice>(std::invoke(access, fresh)) == choices[i]) key.by_default = names[i];
        return key;
    }
    template <class Access>
    static K vector(std::string name, Access access, const char* unit, std::string by_default, std::string help) {
        K key = key_of<Section>(std::move(name), "vector", std::move(help), access,
                                [unit](Reader& reader, const Node& node, const std::string& path) {
                                    return reader.vector(node, path, {.unit = unit});
                                });
        key.unit = unit;
        key.by_default = std::move(by_default);
        return key;
    }
    template <class Access>
    static K axial(std::string name, Access access, const char* unit, std::string help) {
        K key = key_of<Section>(std::move(name), "number (2D), vector (3D)", std::move(help), access,
                                [unit](Reader& reader, const Node& node, const std::string& path) {
                                    return reader.axial(node, path, {.unit = unit});
                                });
        key.unit = unit;
        key.by_default = "0";
        return key;
    }
    template <class Access>
    static K field(std::string name, Access access, const char* unit, Variables variables, std::string help) {
        const char* value = variables == Variables::time ? "vector of formulas in t" : "vector of formulas in t, x, y, z";
        K key = key_of<Section>(std::move(name), value, std::move(help), access,
                                [unit, variables](Reader& reader, const Node& node, const std::string& path) {
                                    return reader.field(node, path, {.unit = unit}, variables);
                                });
        key.unit = unit;
        return key;
    }
    template <class Access>
    static K axial_field(std::string name, Access access, const char* unit, std::string help) {
        K key = key_of<Section>(std::move(name), "formula in t (2D), vector of formulas in t (3D)", std::move(help), access,
                                [unit](Reader& reader, const Node& node, const std::string& path) {
                                    return reader.axial_field(node, path, {.unit = unit});
                                });
        key.unit = unit;
        return key;
    }
    template <class Access>
    static K formula(std::string name, Access access, const char* unit, Variables variables, std::string help) {
        const char* value = variables == Variables::time ? "formula in t" : "formula in t, x, y, z";
        K key = key_of<Section>(std::move(name), value, std::move(help), access,
                                [unit, variables](Reader& reader, const Node& node, const std::string& path) {
                                    return reader.formula(node, path, {.unit = unit}, variables);
                                });
        key.unit = unit;
        return key;
    }
};

}  // namespace abut::input
