#include "abut/input/changes.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "abut/input/document.hpp"

namespace abut::input {
namespace {

bool is_same(const Node& a, const Node& b) {
    if (a.type != b.type || a.text != b.text || a.number != b.number || a.whole != b.whole || a.truth != b.truth ||
        a.items.size() != b.items.size())
        return false;
    for (std::size_t i = 0; i < a.items.size(); ++i) {
        const Node* other = a.type == Node::Type::table ? b.find(a.names[i]) : &b.items[i];
        if (!other || !is_same(a.items[i], *other)) return false;
    }
    return true;
}

/// `path` is what the keys of these tables begin with: "bodies.".
void compare(const Node& before, const Node& now, const std::string& path, std::vector<std::string>& changes) {
    for (std::size_t i = 0; i < before.names.size(); ++i) {
        const std::string key = path + before.names[i];
        const Node &was = before.items[i], *is = now.find(before.names[i]);
        if (!is)
            changes.push_back(fmt::format("{} is not there any more, it was {}", key, description(was)));
        else if (was.type == Node::Type::table && is->type == Node::Type::table)
            compare(was, *is, key + ".", changes);
        else if (!is_same(was, *is) && description(was) == description(*is))
            changes.push_back(fmt::format("{} is {} now with other values", key, description(*is)));
        else if (!is_same(was, *is))
            changes.push_back(fmt::format("{} is {} now, it was {}", key, description(*is), description(was)));
    }
    for (std::size_t i = 0; i < now.names.size(); ++i)
        if (!before.find(now.names[i]))
            changes.push_back(fmt::format("{}{} is new: {}", path, now.names[i], description(now.items[i])));
}

}  // namespace

std::vector<std::string> changed_keys(const std::filesystem::path& before, const std::filesystem::path& now) {
    std::vector<std::string> changes;
    compare(read_document(before), read_document(now), "", changes);
    return changes;
}

}  // namespace abut::input
