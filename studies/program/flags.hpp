#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "abut/base/option.hpp"
#include "apps/support/choices.hpp"
#include "apps/support/cli.hpp"

namespace abut::studies {

/// The options of a study's command line, without the header of CLI11, which takes seconds to compile. A call adds one
/// option, whose default is the present value; the value is set when the command line is read. What a call returns is for
/// apps::restrict_to and the functions below.
class Flags {
public:
    explicit Flags(CLI::App& app) : app_(app) {}

    /// Those of apps: apps::add_contact_options(flags, ..). They have groups of their own.
    operator CLI::App&() const { return app_; }

    /// The heading in --help of the options that follow.
    void group(std::string name) { group_ = std::move(name); }

    CLI::Option* number(const std::string& option, double& value, const std::string& help, const Limits& limits);
    CLI::Option* numbers(const std::string& option, std::vector<double>& values, const std::string& help,
                         const Limits& limits);  ///< separated by commas
    CLI::Option* body_values(const std::string& option, apps::BodyValues& values, const std::string& help,
                             const Limits& limits);
    CLI::Option* count(const std::string& option, int& value, const std::string& help, int least);
    CLI::Option* count(const std::string& option, std::int64_t& value, const std::string& help);  ///< of at least 1
    CLI::Option* counts(const std::string& option, std::vector<int>& values, const std::string& help, int least);
    CLI::Option* flag(const std::string& option, bool& value, const std::string& help);
    /// Some of `known`, separated by commas; none stands for all.
    CLI::Option* names(const std::string& option, std::vector<std::string>& values, const std::string& help,
                       const std::vector<std::string>& known);
    /// Lines of options, each in quotation marks. `refusal` says why one will not do; it is empty where it will.
    CLI::Option* lines(const std::string& option, std::vector<std::string>& values, const std::string& help,
                       const std::function<std::string(const std::string&)>& refusal);
    /// A word without a name in front, which must be given and is one of `known`.
    CLI::Option* positional(const std::string& name, const std::string& help, const std::vector<std::string>& known);
    /// --out, under the heading Output.
    CLI::Option* out(std::filesystem::path& folder);

    /// One of a few names.
    template <class Value>
    CLI::Option* choice(const std::string& option, Value& value, const std::string& help,
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
    [[nodiscard]] std::vector<CLI::Option*> of_group(const std::string& name) const;

private:
    CLI::Option* word(const std::string& option, const std::function<void(const std::string&)>& choose,
                      const std::string& help, const std::vector<std::string>& known, const std::string& by_default);
    CLI::Option* grouped(CLI::Option* option) const;

    CLI::App& app_;
    std::string group_;
};

/// Says that an option may be given only beside another one.
void needs(CLI::Option* option, CLI::Option* other);
/// Once the command line is read.
[[nodiscard]] bool is_given(const CLI::Option* option);
[[nodiscard]] std::string name_of(const CLI::Option* option);

}  // namespace abut::studies
