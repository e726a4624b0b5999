#include "abut/input/option_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace abut::input {

std::optional<OptionValue> read_option(Reader& reader, const Node& node, const std::string& key, const OptionFacts& option) {
    const auto value = [](const auto& taken) { return taken ? std::optional<OptionValue>(*taken) : std::nullopt; };
    switch (option.kind) {
        case OptionKind::truth:
            return value(reader.truth(node, key));
        case OptionKind::count: {
            constexpr std::int64_t many = std::numeric_limits<int>::max();
            const auto count =
                reader.count(node, key, static_cast<int>(option.least), static_cast<int>(std::min(option.most, many)));
            return count ? std::optional<OptionValue>(std::int64_t{*count}) : std::nullopt;
        }
        case OptionKind::number:
            return value(reader.number(node, key, option.limits));
        case OptionKind::numbers:
            return value(reader.increasing(node, key, option.limits));
        case OptionKind::path:
            return value(reader.text(node, key));
        case OptionKind::word:
            break;
    }
    const auto index = reader.word(node, key, option.words);
    return index ? std::optional<OptionValue>(option.words[*index]) : std::nullopt;
}

std::string taken_by(const OptionFacts& option) {
    switch (option.kind) {
        case OptionKind::truth:
            return "true, false";
        case OptionKind::count:
            return "whole number";
        case OptionKind::number:
            return "number";
        case OptionKind::numbers:
            return "list of numbers";
        case OptionKind::path:
            return "path";
        case OptionKind::word:
            break;
    }
    return fmt::format("{}", fmt::join(option.words, ", "));
}

std::string default_in_scene(const OptionFacts& option, const OptionValue& by_default) {
    const bool* truth = std::get_if<bool>(&by_default);
    return truth ? (*truth ? "true" : "false") : default_text(option, by_default);
}

}  // namespace abut::input
