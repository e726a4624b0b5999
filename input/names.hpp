#pragma once
// Private to the layer.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "abut/input/fault.hpp"
#include "abut/input/nearest_word.hpp"
#include "abut/input/settings.hpp"

namespace abut::input {

/// Names of groups and bodies of the mesh that the scene has, as the file calls them.
template <int Dim>
class Names {
public:
    Names(const mesh::Mesh<Dim>& mesh, const std::vector<BodySettings>& bodies, std::vector<Fault>& faults)
        : mesh_(mesh), bodies_(bodies), faults_(faults) {
        for (const auto& group : mesh.groups) groups_.push_back(group.name);
    }

    /// Whether there is such a group; a fault if there is none.
    [[nodiscard]] bool has_group(const std::string& group, const std::string& where, const std::string& key) const {
        if (std::ranges::find(groups_, group) != groups_.end()) return true;
        if (!group.empty() && !is_of_missing_body(group))
            faults_.push_back({where, fmt::format("{} is '{}', which is no group of boundary faces.{}", key, group,
                                                  hint(group, groups_))});
        return false;
    }
    [[nodiscard]] bool has_body(const std::string& name) const {
        return std::ranges::find(mesh_.body_names, name) != mesh_.body_names.end();
    }
    /// Its number in the mesh; nothing, and a fault, if there is none.
    [[nodiscard]] std::optional<std::int32_t> body(const std::string& name, const std::string& where,
                                                   const std::string& key) const {
        const auto found = std::ranges::find(mesh_.body_names, name);
        if (found != mesh_.body_names.end()) return static_cast<std::int32_t>(found - mesh_.body_names.begin());
        if (!name.empty() && !is_of_missing_body(name))
            faults_.push_back(
                {where, fmt::format("{} is '{}', which is no body.{}", key, name, hint(name, mesh_.body_names))});
        return std::nullopt;
    }

private:
    /// Whether `name` is of a table that has no mesh, so that nothing is known of its names.
    [[nodiscard]] bool is_of_missing_body(const std::string& name) const {
        const auto is_of = [](const std::string& part, const std::string& table) {
            return part == table || part.starts_with(table + ".");
        };
        return std::ranges::any_of(bodies_, [&](const BodySettings& table) {
            return is_of(name, table.name) &&
                   std::ranges::none_of(mesh_.body_names, [&](const auto& body) { return is_of(body, table.name); });
        });
    }

    const mesh::Mesh<Dim>& mesh_;
    const std::vector<BodySettings>& bodies_;
    std::vector<std::string> groups_;  // of the file, whatever is added to the mesh
    std::vector<Fault>& faults_;
};

}  // namespace abut::input
