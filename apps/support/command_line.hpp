#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "abut/base/option.hpp"
#include "apps/support/choices.hpp"
#include "apps/support/command_parser.hpp"

/// Options that say by themselves what they take: unit, default and limits in --help, and one clear message for a value
/// that will not do. All throw BadInput from CommandParser::parse.
namespace abut::apps {

using abut::Limits;

/// A finite number, without surplus characters, within the limits; throws BadInput. `option` is what the message names.
[[nodiscard]] double parse_number(const std::string& text, const std::string& option, const Limits& limits);

Flag add_number(CommandParser& parser, const std::string& option, double& value, const std::string& help,
                const Limits& limits);
Flag add_body_values(CommandParser& parser, const std::string& option, BodyValues& values, const std::string& help,
                     const Limits& limits);
Flag add_count(CommandParser& parser, const std::string& option, int& value, const std::string& help, int least);
Flag add_count(CommandParser& parser, const std::string& option, std::int64_t& value, const std::string& help, int least);
/// --out, under the heading Output.
Flag add_out(CommandParser& parser, std::filesystem::path& folder);
/// An option of a table as its flag; its default is the present value.
Flag add_option(CommandParser& parser, const BoundOption& option);
/// Numbers separated by commas; no default is shown of an empty list.
Flag add_numbers(CommandParser& parser, const std::string& option, std::vector<double>& values, const std::string& help,
                 const Limits& limits);
/// One or several whole numbers, separated by commas.
Flag add_counts(CommandParser& parser, const std::string& option, std::vector<int>& values, const std::string& help,
                int least);

/// "1", "0.25": as --help shows a default.
[[nodiscard]] std::string shown(double value);

/// "a|b|c"
[[nodiscard]] std::string joined(const std::vector<std::string>& names);

/// One of a few words, with which `choose` is called.
Flag add_word(CommandParser& parser, const std::string& option, const std::function<void(const std::string&)>& choose,
              const std::string& help, const std::vector<std::string>& words, const std::string& by_default);
/// One of a few names; the present value of `value` is the default.
template <class Value>
Flag add_choice(CommandParser& parser, const std::string& option, Value& value, const std::string& help,
                const Choices<Value>& choices) {
    std::vector<std::string> names;
    for (const auto& [name, choice] : choices) names.push_back(name);
    const auto choose = [&value, choices](const std::string& text) {
        for (const auto& [name, choice] : choices)
            if (name == text) value = choice;
    };
    return add_word(parser, option, choose, help, names, name_of(choices, value));
}

}  // namespace abut::apps
