#pragma once
#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "abut/base/option.hpp"
#include "apps/support/choices.hpp"

/// Options that say by themselves what they take: unit, default and limits in --help, and one clear message for a value
/// that will not do. All throw CLI::ValidationError from App::parse.
namespace abut::apps {

using abut::Limits;

/// A finite number, without surplus characters, within the limits; `option` is what the message names.
[[nodiscard]] double parse_number(const std::string& text, const std::string& option, const Limits& limits);

CLI::Option* add_number(CLI::App& app, const std::string& option, double& value, const std::string& help,
                        const Limits& limits);
CLI::Option* add_body_values(CLI::App& app, const std::string& option, BodyValues& values, const std::string& help,
                             const Limits& limits);
CLI::Option* add_count(CLI::App& app, const std::string& option, int& value, const std::string& help, int least);
/// An option of a table as its flag; its default is the present value.
CLI::Option* add_option(CLI::App& app, const BoundOption& option);
/// Numbers separated by commas; no default is shown of an empty list.
CLI::Option* add_numbers(CLI::App& app, const std::string& option, std::vector<double>& values, const std::string& help,
                         const Limits& limits);
/// One or several whole numbers, separated by commas.
CLI::Option* add_counts(CLI::App& app, const std::string& option, std::vector<int>& values, const std::string& help,
                        int least);

/// "1", "0.25": as --help shows a default.
[[nodiscard]] std::string shown(double value);

/// "a|b|c"
[[nodiscard]] std::string joined(const std::vector<std::string>& names);
[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& names);

/// How --help shows an option: "--gap X    distance of the two surfaces at the start [m] (default 0.02)".
class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter() { column_width(30); }
    std::string make_option_opts(const CLI::Option* option) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
};

/// One of a few names; the present value of `value` is the default.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& option, Value& value, const std::string& help,
                        const Choices<Value>& choices) {
    std::vector<std::string> names;
    for (const auto& [name, choice] : choices) names.push_back(name);
    const auto choose = [&value, choices](const std::string& text) {
        for (const auto& [name, choice] : choices)
            if (name == text) value = choice;
    };
    auto* added = app.add_option_function<std::string>(option, choose, help)->check(one_of(names));
    return added->type_name(joined(names))->default_str(name_of(choices, value));
}

}  // namespace abut::apps
