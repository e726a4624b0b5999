#include "abut/input/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <tuple>

#include "abut/input/fault.hpp"

namespace abut::input {
namespace {

/// What places are told from.
class Places {
public:
    Places(std::string name, bool has_lines) : name_(std::move(name)), has_lines_(has_lines) {}
    [[nodiscard]] std::string at(const toml::source_position& position) const {
        if (!has_lines_ || !position) return name_;
        return fmt::format("{}:{}:{}", name_, position.line, position.column);
    }

private:
    std::string name_;
    bool has_lines_;
};

Node node_of(const toml::node& from, const Places& places);

void append_members(Node& node, const toml::table& table, const Places& places) {
    std::vector<const toml::key*> keys;
    for (const auto& [key, value] : table) keys.push_back(&key);
    std::ranges::sort(keys, {},
                      [](const toml::key* key) { return std::tuple(key->source().begin.line, key->source().begin.column); });
    for (const toml::key* key : keys) {
        node.names.emplace_back(key->str());
        node.items.push_back(node_of(*table.get(key->str()), places));
        node.items.back().where = places.at(key->source().begin);
    }
}

void set_scalar(Node& node, const toml::node& from) {
    switch (from.type()) {
        case toml::node_type::string:
            node.type = Node::Type::text;
            node.text = from.as_string()->get();
            return;
        case toml::node_type::integer:
            node.type = Node::Type::whole;
            node.whole = from.as_integer()->get();
            return;
        case toml::node_type::floating_point:
            node.type = Node::Type::number;
            node.number = from.as_floating_point()->get();
            return;
        case toml::node_type::boolean:
            node.type = Node::Type::truth;
            node.truth = from.as_boolean()->get();
            return;
        default:
            node.type = Node::Type::date;
    }
}

Node node_of(const toml::node& from, const Places& places) {
    Node node{.where = places.at(from.source().begin)};
    if (const toml::table* table = from.as_table()) {
        append_members(node, *table, places);
    } else if (const toml::array* array = from.as_array()) {
        node.type = Node::Type::array;
        for (const toml::node& item : *array) node.items.push_back(node_of(item, places));
    } else {
        set_scalar(node, from);
    }
    return node;
}

Node parse(const std::string& text, const Places& places) {
    try {
        return node_of(toml::parse(text), places);
    } catch (const toml::parse_error& error) {
        throw SceneError({{places.at(error.source().begin), fmt::format("this is no TOML: {}.", error.description())}});
    }
}

std::optional<Node> parsed(const std::string& text, const Places& places) {
    try {
        return parse(text, places);
    } catch (const SceneError&) {
        return std::nullopt;
    }
}

}  // namespace

const Node* Node::find(const std::string& name) const {
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? nullptr : &items[static_cast<std::size_t>(found - names.begin())];
}

std::string description(const Node& node) {
    switch (node.type) {
        case Node::Type::table:
            return "a table";
        case Node::Type::array:
            return fmt::format("a list of {}", node.items.size());
        case Node::Type::text:
            return fmt::format("the text '{}'", node.text);
        case Node::Type::number:
            return fmt::format("the number {:g}", node.number);
        case Node::Type::whole:
            return fmt::format("the number {}", node.whole);
        case Node::Type::truth:
            return node.truth ? "true" : "false";
        case Node::Type::date:
            return "a date or a time of day";
    }
    return "";
}

Node read_document(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path))
        throw SceneError({{path.string(), "the file cannot be read. Give a TOML file, or make one with abut new."}});
    return parse({std::istreambuf_iterator<char>(file), {}}, Places(path.string(), true));
}

Node read_override(const std::string& text) {
    const Places places("--set " + text, false);
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw SceneError({{places.at({}), "a key and its value are needed: --set bodies.left.density=2."}});
    if (auto node = parsed(text, places)) return std::move(*node);
    if (auto node = parsed(text.substr(0, equals + 1) + '\'' + text.substr(equals + 1) + '\'', places))
        return std::move(*node);
    return parse(text, places);
}

void merge(Node& document, const Node& more) {
    for (std::size_t i = 0; i < more.names.size(); ++i) {
        const auto found = std::ranges::find(document.names, more.names[i]);
        if (found == document.names.end()) {
            document.names.push_back(more.names[i]);
            document.items.push_back(more.items[i]);
            continue;
        }
        Node& old = document.items[static_cast<std::size_t>(found - document.names.begin())];
        if (old.type == Node::Type::table && more.items[i].type == Node::Type::table)
            merge(old, more.items[i]);
        else
            old = more.items[i];
    }
}

}  // namespace abut::input
