#include "apps/support/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "apps/support/terminal.hpp"

namespace abut::apps {
namespace {

std::string with_unit(double value, const Limits& limits) {
    return *limits.unit == '\0' ? fmt::format("{}", value) : fmt::format("{} {}", value, limits.unit);
}

std::string allowed(const Limits& limits) {
    std::string text = "it must be a finite number";
    const char* joint = ", ";
    if (std::isfinite(limits.above)) {
        text += fmt::format("{}{} {}", joint, limits.from || (limits.zero && limits.above == 0.0) ? "not below" : "above",
                            with_unit(limits.above, limits));
        joint = " and ";
    }
    if (std::isfinite(limits.below))
        text += fmt::format("{}{} {}", joint, limits.closed ? "not above" : "below", with_unit(limits.below, limits));
    return text;
}

[[noreturn]] void refuse(const std::string& option, const std::string& what, const Limits& limits) {
    throw CLI::ValidationError(
        option, fmt::format("{}; {}.{}{}", what, allowed(limits), *limits.remedy == '\0' ? "" : " ", limits.remedy));
}

BodyValues parse_body_values(const std::string& text, const std::string& option, const Limits& limits) {
    const auto comma = text.find(',');
    if (comma == std::string::npos) {
        const double value = parse_number(text, option, limits);
        return {value, value};
    }
    if (text.find(',', comma + 1) != std::string::npos)
        throw CLI::ValidationError(
            option,
            fmt::format("'{}' holds more than two values; give one for both bodies, or two separated by a comma.", text));
    return {parse_number(text.substr(0, comma), option, limits), parse_number(text.substr(comma + 1), option, limits)};
}

constexpr std::int64_t many = std::numeric_limits<int>::max();

std::int64_t parse_count(std::string_view text, const std::string& option, std::int64_t least, std::int64_t most = many) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least || value > most)
        throw CLI::ValidationError(option, fmt::format("'{}' is not allowed; it must be a whole number {}.", text,
                                                       most >= many ? fmt::format("of at least {}", least)
                                                                    : fmt::format("from {} to {}", least, most)));
    return value;
}
int parse_int(std::string_view text, const std::string& option, int least) {
    return static_cast<int>(parse_count(text, option, least));
}

std::string unit_after(const std::string& help, const Limits& limits) {
    return fmt::format("{} [{}]", help, *limits.unit == '\0' ? "-" : limits.unit);
}

std::string default_text(const BodyValues& values) {
    if (std::isnan(values[0])) return "";
    return values[0] == values[1] ? shown(values[0]) : shown(values[0]) + "," + shown(values[1]);
}

/// What commas separate.
std::vector<std::string_view> parts_of(std::string_view text) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
        end = text.find(',', begin);
        parts.push_back(text.substr(begin, end - begin));
    }
    return parts;
}

}  // namespace

std::string joined(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, "|")); }

CLI::Validator one_of(const std::vector<std::string>& names) {
    const auto check = [names](std::string& text) {
        if (std::ranges::find(names, text) != names.end()) return std::string();
        return fmt::format("'{}' is not known; choose one of {}.", text, fmt::join(names, ", "));
    };
    return CLI::Validator(check, "");
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
    return option->get_type_size() == 0 ? "" : " " + option->get_type_name();
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
    const std::string& by_default = option->get_default_str();
    const std::string text = by_default.empty() ? option->get_description()
                                                : fmt::format("{} (default {})", option->get_description(), by_default);
    const auto width = terminal_width(STDOUT_FILENO);
    return width && *width > 2 * get_column_width() ? wrapped(text, *width - get_column_width()) : text;
}

std::string shown(double value) { return fmt::format("{:g}", value); }

double parse_number(const std::string& text, const std::string& option, const Limits& limits) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || end != text.c_str() + text.size()) refuse(option, fmt::format("'{}' is no number", text), limits);
    if (!limits.allow(value)) refuse(option, with_unit(value, limits) + " is not allowed", limits);
    return value;
}

CLI::Option* add_number(CLI::App& app, const std::string& option, double& value, const std::string& help,
                        const Limits& limits) {
    const auto read = [&value, option, limits](const std::string& text) { value = parse_number(text, option, limits); };
    auto* added = app.add_option_function<std::string>(option, read, unit_after(help, limits))->type_name("X");
    return std::isnan(value) ? added : added->default_str(shown(value));
}

CLI::Option* add_body_values(CLI::App& app, const std::string& option, BodyValues& values, const std::string& help,
                             const Limits& limits) {
    const auto read = [&values, option, limits](const std::string& text) {
        values = parse_body_values(text, option, limits);
    };
    auto* added = app.add_option_function<std::string>(option, read, unit_after(help, limits))->type_name("X[,X]");
    return added->default_str(default_text(values));
}

CLI::Option* add_count(CLI::App& app, const std::string& option, int& value, const std::string& help, int least) {
    const auto read = [&value, option, least](const std::string& text) { value = parse_int(text, option, least); };
    return app.add_option_function<std::string>(option, read, unit_after(help, {}))
        ->type_name("N")
        ->default_str(fmt::format("{}", value));
}

CLI::Option* add_option(CLI::App& app, const BoundOption& option) {
    const OptionFacts& facts = *option.facts;
    const OptionValue present = option.get();
    const std::string flag = facts.flag();
    CLI::Option* added = nullptr;
    const auto add = [&](const std::string& help, const std::string& takes, auto value_of) {
        added = app.add_option_function<std::string>(
                       flag, [set = option.set, value_of](const std::string& text) { set(value_of(text)); }, help)
                    ->type_name(takes);
    };
    switch (facts.kind) {
        case OptionKind::number:
            add(unit_after(facts.help, facts.limits), "X", [flag, limits = facts.limits](const std::string& text) {
                return OptionValue(parse_number(text, flag, limits));
            });
            break;
        case OptionKind::count:
            add(unit_after(facts.help, {}), "N", [flag, least = facts.least, most = facts.most](const std::string& text) {
                return OptionValue(parse_count(text, flag, least, most));
            });
            break;
        case OptionKind::path:
            add(facts.help, "DIR", [](const std::string& text) { return OptionValue(text); });
            break;
        case OptionKind::word:
            add(facts.help, joined(facts.words), [](const std::string& text) { return OptionValue(text); });
            added->check(one_of(facts.words));
            break;
        case OptionKind::truth: {
            if (!facts.is_switch) {
                added = app.add_flag_callback(
                    flag, [set = option.set] { set(true); }, facts.help);
                break;
            }
            const std::vector<std::string> words = {"on", "off"};
            add(facts.help, joined(words), [](const std::string& text) { return OptionValue(text == "on"); });
            added->check(one_of(words));
            break;
        }
    }
    return added->default_str(default_text(facts, present))->group(facts.group);
}

CLI::Option* add_numbers(CLI::App& app, const std::string& option, std::vector<double>& values, const std::string& help,
                         const Limits& limits) {
    const auto read = [&values, option, limits](const std::string& text) {
        values.clear();
        for (const std::string_view part : parts_of(text)) values.push_back(parse_number(std::string(part), option, limits));
    };
    auto* added = app.add_option_function<std::string>(option, read, unit_after(help, limits))->type_name("X[,X...]");
    if (!values.empty()) added->default_str(fmt::format("{}", fmt::join(values, ",")));
    return added;
}

CLI::Option* add_counts(CLI::App& app, const std::string& option, std::vector<int>& values, const std::string& help,
                        int least) {
    const auto read = [&values, option, least](const std::string& text) {
        values.clear();
        for (const std::string_view part : parts_of(text)) values.push_back(parse_int(part, option, least));
    };
    return app.add_option_function<std::string>(option, read, unit_after(help, {}))
        ->type_name("N[,N...]")
        ->default_str(fmt::format("{}", fmt::join(values, ",")));
}

}  // namespace abut::apps
