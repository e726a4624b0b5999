#pragma once
// Private to the layer.
#include <optional>
#include <string>

#include "abut/base/option.hpp"
#include "abut/input/key.hpp"

namespace abut::input {

/// The value that a scene gives an option; nothing, with a fault, where it is not of its kind or not allowed.
[[nodiscard]] std::optional<OptionValue> read_option(Reader& reader, const Node& node, const std::string& key,
                                                     const OptionFacts& option);
/// "whole number", "true, false", "half, stiffness": what a key takes.
[[nodiscard]] std::string taken_by(const OptionFacts& option);
/// As a scene would say it.
[[nodiscard]] std::string default_in_scene(const OptionFacts& option, const OptionValue& by_default);

/// An option of a table as a key. `owner_of` leads from a section to the owner of the option.
template <class Section, class Owner, class OwnerOf>
[[nodiscard]] Key<Section> key_of_option(const Option<Owner>& option, OwnerOf owner_of) {
    return {.name = option.scene_key(),
            .value = taken_by(option),
            .unit = option.limits.unit,
            .by_default = default_in_scene(option, option.get(Owner{})),
            .help = option.help,
            .take = [option, owner_of](Section& section, const Node& node, const std::string& key, Reader& reader) {
                if (const auto value = read_option(reader, node, key, option)) option.set(owner_of(section), *value);
            }};
}

/// The keys of a table of a scene, such as "contact". Everyday ones come first.
template <class Section, class Owner, class OwnerOf>
[[nodiscard]] Keys<Section> keys_of_options(const OptionList<Owner>& options, const std::string& table, OwnerOf owner_of) {
    Keys<Section> keys;
    for (const OptionDepth depth : {OptionDepth::everyday, OptionDepth::expert, OptionDepth::laboratory})
        for (const Option<Owner>& option : options)
            if (option.depth == depth && option.table == table && option.places.scene)
                keys.push_back(key_of_option<Section>(option, owner_of));
    return keys;
}

}  // namespace abut::input
