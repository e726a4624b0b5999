#include "abut/input/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/input_file.hpp"
#include "abut/base/text.hpp"
#include "abut/input/fault.hpp"

namespace abut::input {
namespace {

/// Positions in a document, as messages name them.
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

/// Tables and lists within each other. Scenes need five; what reads and frees them calls itself for each.
constexpr int most_nested = 64;
constexpr std::size_t most_shown = 80;  // of a text in a message [bytes]

/// Looks through a text of TOML for keys and brackets that go deeper than `most_nested`. What is no TOML may count
/// wrongly: the parser says then what is wrong.
class Nesting {
public:
    explicit Nesting(std::string_view text) : text_(text) {}

    /// Position where keys or brackets first go too deep; nothing: nowhere.
    [[nodiscard]] std::optional<toml::source_position> too_deep() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '#')
                skip_to("\n");
            else if (c == '"' || c == '\'')
                skip_string(c);
            else
                take(c);
            if (below_ + dots_ > most_nested) return position();
        }
        return std::nullopt;
    }

private:
    void take(char c) {
        ++at_;
        if (c == '.') ++dots_;
        if (c == '[' || c == '{') {
            open_.push_back(dots_ + 1);
            below_ += dots_ + 1;
        }
        if ((c == ']' || c == '}') && !open_.empty()) {
            below_ -= open_.back();
            open_.pop_back();
        }
        if (c == '[' || c == '{' || c == ']' || c == '}' || c == ',' || c == '\n') dots_ = 0;
    }
    void skip_to(std::string_view end) { at_ = std::min(text_.find(end, at_), text_.size()); }
    void skip_string(char quote) {
        const std::string three(3, quote);
        const bool many_lines = text_.substr(at_).starts_with(three);
        const std::string_view end = many_lines ? std::string_view(three) : std::string_view(three).substr(0, 1);
        at_ += end.size();
        while (at_ < text_.size() && !text_.substr(at_).starts_with(end) && (many_lines || text_[at_] != '\n'))
            at_ += quote == '"' && text_[at_] == '\\' ? 2 : 1;
        at_ = std::min(at_ + end.size(), text_.size());
    }
    [[nodiscard]] toml::source_position position() const {
        const std::string_view before = text_.substr(0, at_);
        const auto line = static_cast<toml::source_index>(1 + std::ranges::count(before, '\n'));
        return {line, static_cast<toml::source_index>(before.size() - (before.rfind('\n') + 1))};
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int dots_ = 0;           // of the key that is read
    int below_ = 0;          // levels of all open brackets
    std::vector<int> open_;  // levels of each
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
    if (const auto where = Nesting(text).too_deep())
        throw SceneError({{places.at(*where), fmt::format("tables or lists are nested more than {} deep, at most {} are "
                                                          "allowed. Take out dots or brackets.",
                                                          most_nested, most_nested)}});
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
            return fmt::format("the text '{}'", shortened(node.text, most_shown));
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
    std::string text;
    try {
        text = file_bytes(path);
    } catch (const BadInput& error) {
        const std::string what = error.what(), start = path.string() + ": ";
        throw SceneError({{path.string(), (what.starts_with(start) ? what.substr(start.size()) : what) +
                                              " The file cannot be read: give a TOML file, or make one with abut new."}});
    }
    return parse(text, Places(path.string(), true));
}

Node read_text(const std::string& text, const std::string& name) { return parse(text, Places(name, false)); }

Node read_override(const std::string& text) {
    const Places places("--set " + as_utf8(shortened(text, most_shown)), false);
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
