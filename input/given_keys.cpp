#include "abut/input/given_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace abut::input {
namespace {

bool is_within(const std::string& path, const std::string& table) {
    return path.size() > table.size() && path.starts_with(table) && (path[table.size()] == '.' || path[table.size()] == '[');
}

}  // namespace

std::vector<std::string> GivenKeys::names() const {
    std::vector<std::string> names;
    for (const auto& [name, key] : keys_) names.push_back(name);
    return names;
}

void GivenKeys::read(const std::string& name) const {
    if (const auto found = keys_.find(name); found != keys_.end()) found->second->is_read = true;
}

void GivenKeys::read_with(bool acts, const std::string& name, const std::string& other) const {
    acts ? read(name) : leave(name, "without " + other, "Give both, or leave it out.");
}

void GivenKeys::read_unless(bool has_precedence, const std::string& name, const std::string& other) const {
    has_precedence ? leave(name, "beside " + other, "Leave one of them out.") : read(name);
}

void GivenKeys::leave(const std::string& name, const std::string& why, const char* remedy) const {
    const auto found = keys_.find(name);
    if (found == keys_.end()) return;
    found->second->why = why;
    found->second->remedy = remedy;
}

std::vector<Fault> faults_of_unread(const std::vector<std::shared_ptr<GivenKey>>& keys) {
    std::vector<const GivenKey*> unread;
    for (const auto& key : keys)
        if (!key->is_read && key->asks) unread.push_back(key.get());
    std::vector<Fault> faults;
    for (const GivenKey* key : unread)
        if (std::ranges::none_of(unread, [&](const GivenKey* other) { return is_within(key->path, other->path); }))
            faults.push_back(
                {key->where, key->why.empty()
                                 ? fmt::format("{} has no effect here: nothing reads it. Leave it out.", key->path)
                                 : fmt::format("{} has no effect {}. {}", key->path, key->why, key->remedy)});
    return faults;
}

}  // namespace abut::input
