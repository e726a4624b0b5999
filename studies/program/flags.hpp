#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "abut/base/option.hpp"
#include "apps/support/choices.hpp"
#include "apps/support/command_parser.hpp"

namespace abut::studies {

/// The options of a study's command line. A call adds one option, whose default is the present value; the value is set when
/// the command line is read. What a call returns is for restrict_to, and says then whether the option was given.
class Flags {
public:
    explicit Flags(apps::CommandParser& parser) : parser_(parser) {}

    /// Those of apps: apps::add_contact_options(flags, ..). They have groups of their own.
    operator apps::CommandParser&() const { return parser_; }

    /// The heading in --help of the options that follow.
    void group(std::string name) { group_ = std::move(name); }

    apps::Flag number(const std::string& option, double& value, const std::string& help, const Limits& limits);
    apps::Flag numbers(const std::string& option, std::vector<double>& values, const std::string& help,
                       const Limits& limits);  ///< separated by commas
    apps::Flag body_values(const std::string& option, apps::BodyValues& values, const std::string& help,
                           const Limits& limits);
    apps::Flag count(const std::string& option, int& value, const std::string& help, int least);
    apps::Flag count(const std::string& option, std::int64_t& value, const std::string& help, int least);
    apps::Flag counts(const std::string& option, std::vector<int>& values, const std::string& help, int least);
    apps::Flag flag(const std::string& option, bool& value, const std::string& help);
    /// Some of `known`, separated by commas; none stands for all.
    apps::Flag names(const std::string& option, std::vector<std::string>& values, const std::string& help,
                     const std::vector<std::string>& known);
    /// Lines of options, each in quotation marks. `refusal` says why one will not do; it is empty where it will.
    apps::Flag lines(const std::string& option, std::vector<std::string>& values, const std::string& help,
                     const std::function<std::string(const std::string&)>& refusal);
    /// A word without a name in front, which must be given and is one of `known`.
    apps::Flag positional(const std::string& name, const std::string& help, const std::vector<std::string>& known);
    /// --out, under the heading Output.
    apps::Flag out(std::filesystem::path& folder);

    /// One of a few names.
    template <class Value>
    apps::Flag choice(const std::string& option, Value& value, const std::string& help,
                      const apps::Choices<Value>& choices) {
        std::vector<std::string> known;
        for (const auto& [name, one] : choices) known.push_back(name);
        const auto choose = [&value, choices](const std::string& text) {
            for (const auto& [name, one] : choices)
                if (name == text) value = one;
        };
        return word(option, choose, help, known, apps::name_of(choices, value));
    }

    /// Options that were added until now under a heading.
    [[nodiscard]] std::vector<apps::Flag> of_group(const std::string& name) const;

private:
    apps::Flag word(const std::string& option, const std::function<void(const std::string&)>& choose,
                    const std::string& help, const std::vector<std::string>& known, const std::string& by_default);
    apps::Flag grouped(apps::Flag option) const;

    apps::CommandParser& parser_;
    std::string group_;
};

}  // namespace abut::studies
