#include "apps/support/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "abut/base/error.hpp"
#include "abut/base/unit.hpp"

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
    throw BadInput(
        fmt::format("{}: {}; {}.{}{}", option, what, allowed(limits), *limits.remedy == '\0' ? "" : " ", limits.remedy));
}

/// Number of "0.005" or "5 ms", in the unit of the limits.
double number_of(const std::string& text, const std::string& option, const Limits& limits) {
    if (const auto with_unit = value_with_unit(text); with_unit && !with_unit->is_formula) try {
            return converted(with_unit->value, unit_for(with_unit->unit, limits.unit), unit_of(limits.unit));
        } catch (const BadInput& error) {
            throw BadInput(fmt::format("{} is '{}': {}", option, text, error.what()));
        }
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || end != text.c_str() + text.size()) refuse(option, fmt::format("'{}' is no number", text), limits);
    return value;
}

BodyValues parse_body_values(const std::string& text, const std::string& option, const Limits& limits) {
    const auto comma = text.find(',');
    if (comma == std::string::npos) {
        const double value = parse_number(text, option, limits);
        return {value, value};
    }
    if (text.find(',', comma + 1) != std::string::npos)
        throw BadInput(fmt::format(
            "{}: '{}' holds more than two values; give one for both bodies, or two separated by a comma.", option, text));
    return {parse_number(text.substr(0, comma), option, limits), parse_number(text.substr(comma + 1), option, limits)};
}

constexpr std::int64_t many = std::numeric_limits<int>::max();

std::int64_t parse_count(std::string_view text, const std::string& option, std::int64_t least, std::int64_t most = many) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least || value > most)
        throw BadInput(
            fmt::format("{}: '{}' is not allowed; it must be a whole number {}.", option, text,
                        most >= many ? fmt::format("of at least {}", least) : fmt::format("from {} to {}", least, most)));
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

/// Parts that commas separate.
std::vector<std::string_view> parts_of(std::string_view text) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
        end = text.find(',', begin);
        parts.push_back(text.substr(begin, end - begin));
    }
    return parts;
}

std::vector<double> parse_numbers(std::string_view text, const std::string& option, const Limits& limits) {
    std::vector<double> values;
    for (const std::string_view part : parts_of(text)) values.push_back(parse_number(std::string(part), option, limits));
    return values;
}

std::vector<double> parse_increasing(std::string_view text, const std::string& option, const Limits& limits) {
    std::vector<double> values = parse_numbers(text, option, limits);
    if (const std::string fault = fault_in(limits, values); !fault.empty()) throw BadInput(option + ": " + fault);
    return values;
}

/// An option of a table, without default and heading.
Flag add_of_kind(CommandParser& parser, const BoundOption& option) {
    const OptionFacts& facts = *option.facts;
    const std::string flag = facts.flag();
    const auto add = [&](const std::string& help, const std::string& takes, auto value_of) {
        const auto read = [set = option.set, value_of](const std::string& text) { set(value_of(text)); };
        return parser.text(flag, read, help).takes(takes);
    };
    const auto add_words = [&](const std::vector<std::string>& words, auto value_of) {
        return add(facts.help, joined(words), value_of).one_of(words);
    };
    switch (facts.kind) {
        case OptionKind::number:
            return add(unit_after(facts.help, facts.limits), "X", [flag, limits = facts.limits](const std::string& text) {
                return OptionValue(parse_number(text, flag, limits));
            });
        case OptionKind::numbers:
            return add(unit_after(facts.help, facts.limits), "X[,X...]",
                       [flag, limits = facts.limits](const std::string& text) {
                           return OptionValue(parse_increasing(text, flag, limits));
                       });
        case OptionKind::count:
            return add(unit_after(facts.help, {}), "N",
                       [flag, least = facts.least, most = facts.most](const std::string& text) {
                           return OptionValue(parse_count(text, flag, least, most));
                       });
        case OptionKind::path:
            return add(facts.help, "DIR", [](const std::string& text) { return OptionValue(text); });
        case OptionKind::word:
            return add_words(facts.words, [](const std::string& text) { return OptionValue(text); });
        case OptionKind::truth:
            break;
    }
    if (facts.is_switch) return add_words({"on", "off"}, [](const std::string& text) { return OptionValue(text == "on"); });
    return parser.flag(
        flag, [set = option.set] { set(true); }, facts.help);
}

}  // namespace

std::string joined(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, "|")); }

std::string shown(double value) { return fmt::format("{:g}", value); }

double parse_number(const std::string& text, const std::string& option, const Limits& limits) {
    const double value = number_of(text, option, limits);
    if (!limits.allow(value)) refuse(option, with_unit(value, limits) + " is not allowed", limits);
    return value;
}

Flag add_number(CommandParser& parser, const std::string& option, double& value, const std::string& help,
                const Limits& limits) {
    const auto read = [&value, option, limits](const std::string& text) { value = parse_number(text, option, limits); };
    Flag added = parser.text(option, read, unit_after(help, limits)).takes("X");
    return std::isnan(value) ? added : added.by_default(shown(value));
}

Flag add_body_values(CommandParser& parser, const std::string& option, BodyValues& values, const std::string& help,
                     const Limits& limits) {
    const auto read = [&values, option, limits](const std::string& text) {
        values = parse_body_values(text, option, limits);
    };
    Flag added = parser.text(option, read, unit_after(help, limits)).takes("X[,X]");
    return added.by_default(default_text(values));
}

Flag add_count(CommandParser& parser, const std::string& option, int& value, const std::string& help, int least) {
    const auto read = [&value, option, least](const std::string& text) { value = parse_int(text, option, least); };
    return parser.text(option, read, unit_after(help, {})).takes("N").by_default(fmt::format("{}", value));
}

Flag add_count(CommandParser& parser, const std::string& option, std::int64_t& value, const std::string& help, int least) {
    const auto read = [&value, option, least](const std::string& text) {
        value = parse_count(text, option, least, std::numeric_limits<std::int64_t>::max());
    };
    return parser.text(option, read, unit_after(help, {})).takes("N").by_default(fmt::format("{}", value));
}

Flag add_out(CommandParser& parser, std::filesystem::path& folder) {
    return parser.path("--out", folder, "folder of all results; made if it is not there")
        .takes("DIR")
        .by_default(folder.string())
        .group("Output");
}

Flag add_option(CommandParser& parser, const BoundOption& option) {
    const OptionFacts& facts = *option.facts;
    return add_of_kind(parser, option).by_default(default_text(facts, option.get())).group(facts.group);
}

Flag add_word(CommandParser& parser, const std::string& option, const std::function<void(const std::string&)>& choose,
              const std::string& help, const std::vector<std::string>& words, const std::string& by_default) {
    return parser.text(option, choose, help).one_of(words).takes(joined(words)).by_default(by_default);
}

Flag add_numbers(CommandParser& parser, const std::string& option, std::vector<double>& values, const std::string& help,
                 const Limits& limits) {
    const auto read = [&values, option, limits](const std::string& text) { values = parse_numbers(text, option, limits); };
    Flag added = parser.text(option, read, unit_after(help, limits)).takes("X[,X...]");
    if (!values.empty()) added.by_default(fmt::format("{}", fmt::join(values, ",")));
    return added;
}

Flag add_counts(CommandParser& parser, const std::string& option, std::vector<int>& values, const std::string& help,
                int least) {
    const auto read = [&values, option, least](const std::string& text) {
        values.clear();
        for (const std::string_view part : parts_of(text)) values.push_back(parse_int(part, option, least));
    };
    return parser.text(option, read, unit_after(help, {}))
        .takes("N[,N...]")
        .by_default(fmt::format("{}", fmt::join(values, ",")));
}

}  // namespace abut::apps
