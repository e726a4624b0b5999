#include "abut/input/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "abut/base/given_value.hpp"
#include "abut/input/nearest_word.hpp"

namespace abut::input {
namespace {

/// " [m/s]"
std::string in_brackets(const Limits& limits) { return *limits.unit == '\0' ? "" : fmt::format(" [{}]", limits.unit); }

/// For a formula with a unit behind it that has none, "2*pi rad"; empty for others.
std::string hint_of_parentheses(const std::string& text) {
    if (value_with_unit(text)) return "";
    for (auto space = text.find(' '); space != std::string::npos; space = text.find(' ', space + 1)) try {
            const std::string unit = text.substr(space + 1);
            if (unit_of(unit).powers == Unit::Powers{}) continue;
            return fmt::format(". A formula with a unit stands in parentheses, \"({}) {}\".", text.substr(0, space), unit);
        } catch (const BadInput&) {
        }
    return "";
}

/// "bodies.left.place, component 2"
std::string of_item(const std::string& key, std::size_t index) { return fmt::format("{}, component {}", key, index + 1); }

}  // namespace

void Reader::require_dimension(const std::string& formula, const Unit::Powers& wanted, const std::string& remedy) const {
    const auto dimension = dimension_of(formula, numbers);
    constexpr std::size_t angle = 3;
    Unit::Powers without_angle = wanted;
    without_angle[angle] = 0;
    if (!dimension || *dimension == without_angle) return;
    throw BadInput(fmt::format("by the units of its values it is {}, {} is needed. {}", dimension_name(*dimension),
                               dimension_name(wanted), remedy));
}

Formula Reader::formula_of(const std::string& text, const std::string& wanted, Variables variables) {
    const auto with_unit = value_with_unit(text);
    if (!with_unit) {
        Formula formula(text, variables, numbers);
        if (!formula.varies()) require_dimension(text, unit_of(wanted).powers, "Check the formula and its [values].");
        return formula;
    }
    return in_unit(*with_unit, unit_for(with_unit->unit, wanted), unit_of(wanted), variables);
}

Formula Reader::in_unit(const ValueWithUnit& value, const Unit& from, const Unit& to, Variables variables) {
    if (!value.is_formula) {
        const double number = converted(value.value, from, to);
        if (!std::isfinite(number)) throw BadInput("it is beyond the range of numbers.");
        return Formula(number);
    }
    Formula formula(converted_formula(value.value, from, to), variables, numbers);
    if (!formula.varies())
        require_dimension(value.value, {}, "Leave out the unit behind it: that of its values counts already.");
    return formula;
}

std::optional<Reader::Measured> Reader::measured(const Node& node, const std::string& key) {
    if (node.type != Node::Type::text) {
        const auto value = number(node, key, {});
        return value ? std::optional(Measured{*value, std::nullopt}) : std::nullopt;
    }
    try {
        const auto with_unit = value_with_unit(node.text);
        if (!with_unit) {
            const double value = Formula(node.text, Variables::none, numbers).value();
            return Measured{value, dimension_of(node.text, numbers)};
        }
        const Unit from = unit_of(with_unit->unit);
        return Measured{in_unit(*with_unit, from, {.powers = from.powers}, Variables::none).value(), from.powers};
    } catch (const BadInput& error) {
        fault(node, fmt::format("{} is {}, a number is needed: {}", key, description(node), error.what()));
        return std::nullopt;
    }
}

void Reader::fault(const Node& node, std::string text) { faults_.push_back({node.where, std::move(text)}); }

void Reader::wrong_type(const Node& node, const std::string& key, const std::string& wanted) {
    fault(node, fmt::format("{} is {}, {} is needed.", key, description(node), wanted));
}

std::optional<Formula> Reader::formula(const Node& node, const std::string& key, const Limits& limits, Variables variables) {
    if (node.type == Node::Type::whole) return Formula(static_cast<double>(node.whole));
    if (node.type == Node::Type::number) return Formula(node.number);
    if (node.type != Node::Type::text) {
        wrong_type(node, key, fmt::format("a number{}", in_brackets(limits)));
        return std::nullopt;
    }
    if (variables == Variables::time_and_space && dimension == 2) variables = Variables::time_and_plane;
    try {
        return formula_of(node.text, limits.unit, variables);
    } catch (const BadInput& error) {
        fault(node, fmt::format("{} is {}, a number{} is needed: {}{}", key, description(node), in_brackets(limits),
                                error.what(), hint_of_parentheses(node.text)));
        return std::nullopt;
    }
}

std::optional<double> Reader::number(const Node& node, const std::string& key, const Limits& limits) {
    const auto value = formula(node, key, limits, Variables::none);
    if (!value) return std::nullopt;
    std::string wrong = fault_of(key, limits, value->value());
    if (wrong.empty()) return value->value();
    fault(node, std::move(wrong));
    return std::nullopt;
}

std::optional<int> Reader::count(const Node& node, const std::string& key, int least, int most) {
    if (node.type != Node::Type::whole) {
        wrong_type(node, key, "a whole number");
        return std::nullopt;
    }
    if (node.whole >= least && node.whole <= most) return static_cast<int>(node.whole);
    fault(node, fmt::format("{} is {}, {} is needed.", key, node.whole,
                            most == std::numeric_limits<int>::max() ? fmt::format("{} or more", least)
                                                                    : fmt::format("{} to {}", least, most)));
    return std::nullopt;
}

std::optional<bool> Reader::truth(const Node& node, const std::string& key) {
    if (node.type == Node::Type::truth) return node.truth;
    wrong_type(node, key, "true or false");
    return std::nullopt;
}

std::optional<std::string> Reader::text(const Node& node, const std::string& key) {
    if (node.type == Node::Type::text && !node.text.empty()) return node.text;
    wrong_type(node, key, "a text");
    return std::nullopt;
}

std::optional<std::size_t> Reader::word(const Node& node, const std::string& key, const std::vector<std::string>& words) {
    const auto given = text(node, key);
    if (!given) return std::nullopt;
    const auto found = std::ranges::find(words, *given);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    fault(node, fmt::format("{} is '{}', which is none of its words.{}", key, *given, hint(*given, words)));
    return std::nullopt;
}

bool Reader::has_components(const Node& node, const std::string& key, const std::string& of_what) {
    const std::size_t n = node.items.size();
    const bool fits = dimension == 0 ? n == 2 || n == 3 : n == static_cast<std::size_t>(dimension);
    if (node.type == Node::Type::array && fits) return true;
    wrong_type(node, key, fmt::format("a list of {} {}", dimension == 0 ? "2 or 3" : std::to_string(dimension), of_what));
    return false;
}

std::optional<FieldSettings> Reader::field(const Node& node, const std::string& key, const Limits& limits,
                                           Variables variables) {
    if (!has_components(node, key, "numbers" + in_brackets(limits))) return std::nullopt;
    FieldSettings field;
    bool good = true;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
        const auto component = formula(node.items[i], of_item(key, i), limits, variables);
        if (component && !component->varies() && !limits.allow(component->value()))
            fault(node.items[i], fmt::format("{} is {}, a finite number is needed.", of_item(key, i), component->value()));
        else if (component) {
            field[i] = *component;
            continue;
        }
        good = false;
    }
    return good ? std::optional(field) : std::nullopt;
}

std::optional<Vector<3>> Reader::vector(const Node& node, const std::string& key, const Limits& limits) {
    const auto components = field(node, key, limits, Variables::none);
    if (!components) return std::nullopt;
    return Vector<3>((*components)[0].value(), (*components)[1].value(), (*components)[2].value());
}

bool Reader::is_in_plane(const Node& node) const {
    return dimension == 2 || (dimension == 0 && node.type != Node::Type::array);
}

std::optional<Vector<3>> Reader::axial(const Node& node, const std::string& key, const Limits& limits) {
    if (!is_in_plane(node)) return vector(node, key, limits);
    const auto about_z = number(node, key, limits);
    return about_z ? std::optional(Vector<3>(0.0, 0.0, *about_z)) : std::nullopt;
}

std::optional<FieldSettings> Reader::axial_field(const Node& node, const std::string& key, const Limits& limits) {
    if (!is_in_plane(node)) return field(node, key, limits, Variables::time);
    const auto about_z = formula(node, key, limits, Variables::time);
    return about_z ? std::optional(FieldSettings{Formula(), Formula(), *about_z}) : std::nullopt;
}

std::optional<std::array<int, 3>> Reader::counts(const Node& node, const std::string& key) {
    if (!has_components(node, key, "whole numbers")) return std::nullopt;
    std::array<int, 3> counts{};
    bool good = true;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
        const auto value = count(node.items[i], of_item(key, i), 1, std::numeric_limits<int>::max());
        counts[i] = value.value_or(0);
        good = good && value;
    }
    return good ? std::optional(counts) : std::nullopt;
}

std::optional<std::vector<Vector<3>>> Reader::points(const Node& node, const std::string& key, const Limits& limits) {
    if (node.type != Node::Type::array || node.items.size() < 3) {
        wrong_type(node, key, "a list of 3 points or more" + in_brackets(limits));
        return std::nullopt;
    }
    std::vector<Vector<3>> points;
    for (std::size_t i = 0; i < node.items.size(); ++i)
        if (const auto point = vector(node.items[i], fmt::format("{}, point {}", key, i + 1), limits))
            points.push_back(*point);
    return points.size() == node.items.size() ? std::optional(points) : std::nullopt;
}

std::optional<std::vector<double>> Reader::increasing(const Node& node, const std::string& key, const Limits& limits) {
    if (node.type != Node::Type::array || node.items.empty()) {
        wrong_type(node, key, "a list of numbers" + in_brackets(limits));
        return std::nullopt;
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
        const std::string name = fmt::format("{}, number {}", key, i + 1);
        const auto value = number(node.items[i], name, limits);
        if (!value) return std::nullopt;
        if (i > 0 && *value <= numbers.back()) {
            fault(node.items[i], fmt::format("{} is {}, after {}. Give them in increasing order, each once.", name,
                                             with_unit_of(limits, *value), with_unit_of(limits, numbers.back())));
            return std::nullopt;
        }
        numbers.push_back(*value);
    }
    return numbers;
}

std::optional<std::vector<std::size_t>> Reader::words(const Node& node, const std::string& key,
                                                      const std::vector<std::string>& words) {
    if (node.type != Node::Type::array || node.items.empty()) {
        wrong_type(node, key, fmt::format("a list of words such as [\"{}\"]", words.front()));
        return std::nullopt;
    }
    std::vector<std::size_t> indices;
    for (const Node& item : node.items)
        if (const auto index = word(item, key, words)) indices.push_back(*index);
    return indices.size() == node.items.size() ? std::optional(indices) : std::nullopt;
}

std::optional<std::vector<IgnoredPair>> Reader::pairs(const Node& node, const std::string& key) {
    const auto is_pair = [](const Node& item) {
        return item.type == Node::Type::array && item.items.size() == 2 &&
               std::ranges::all_of(item.items, [](const Node& name) { return name.type == Node::Type::text; });
    };
    if (node.type != Node::Type::array || !std::ranges::all_of(node.items, is_pair)) {
        wrong_type(node, key, "a list of pairs of names such as [[\"left\", \"right\"]]");
        return std::nullopt;
    }
    std::vector<IgnoredPair> pairs;
    for (const Node& item : node.items) pairs.push_back({{item.items[0].text, item.items[1].text}, item.where});
    return pairs;
}

std::optional<std::array<bool, 3>> Reader::components(const Node& node, const std::string& key) {
    std::vector<std::string> names{"x", "y", "z"};
    if (dimension == 2) names.pop_back();
    const auto chosen = words(node, key, names);
    if (!chosen) return std::nullopt;
    std::array<bool, 3> components{};
    for (const std::size_t index : *chosen) components[index] = true;
    return components;
}

bool Reader::is_table(const Node& node, const std::string& key) {
    if (node.type == Node::Type::table) return true;
    wrong_type(node, key, "a table");
    return false;
}

}  // namespace abut::input
