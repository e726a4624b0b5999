#include "abut/base/option.hpp"

#include <algorithm>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut {
namespace {

/// "0 (half) and 1 (stiffness)", "0 (automatic) to 4 (brute_force)"
std::string numbered(const std::vector<std::string>& words) {
    const auto at = [&](std::size_t i) { return std::to_string(i) + " (" + words[i] + ")"; };
    return at(0) + (words.size() == 2 ? " and " : " to ") + at(words.size() - 1);
}

/// "above 0 kg/m^3", "a finite number"
std::string number_allowed(const Limits& limits) {
    const std::string text = text_of(limits);
    return text.empty() ? "a finite number" : text;
}

double as_number(const OptionValue& value) {
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* count = std::get_if<std::int64_t>(&value)) return static_cast<double>(*count);
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

bool Limits::allow(double value) const {
    if (zero && value == 0.0) return true;
    if (endless && value == std::numeric_limits<double>::infinity()) return true;
    return std::isfinite(value) && (value > above || (from && value == above)) &&
           (value < below || (closed && value == below));
}

std::string with_unit_of(const Limits& limits, double value) {
    return number(value) + (*limits.unit == '\0' ? "" : " ") + limits.unit;
}

std::string text_of(const Limits& limits) {
    std::string text;
    if (std::isfinite(limits.above)) {
        const std::string least = with_unit_of(limits, limits.above);
        text = limits.from || (limits.zero && limits.above == 0.0) ? least + " or above" : "above " + least;
    }
    if (std::isfinite(limits.below))
        text += (text.empty() ? "" : ", ") + std::string(limits.closed ? "at most " : "below ") +
                with_unit_of(limits, limits.below);
    return text;
}

std::string OptionFacts::flag() const {
    std::string text = "--" + name;
    std::ranges::replace(text, '_', '-');
    return text;
}

bool allows(const OptionFacts& option, const OptionValue& value) {
    switch (option.kind) {
        case OptionKind::number:
            return option.limits.allow(std::get<double>(value));
        case OptionKind::numbers:
            return fault_in(option.limits, std::get<std::vector<double>>(value)).empty();
        case OptionKind::count:
            return std::get<std::int64_t>(value) >= option.least && std::get<std::int64_t>(value) <= option.most;
        case OptionKind::word:
            return std::ranges::find(option.words, std::get<std::string>(value)) != option.words.end();
        case OptionKind::truth:
        case OptionKind::path:
            return true;
    }
    return true;
}

std::string fault_in(const Limits& limits, std::span<const double> numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::string found = "number " + std::to_string(i + 1) + " is " + with_unit_of(limits, numbers[i]);
        if (!limits.allow(numbers[i])) return found + "; " + number_allowed(limits) + " is needed.";
        if (i > 0 && numbers[i] <= numbers[i - 1])
            return found + ", after " + with_unit_of(limits, numbers[i - 1]) + ". Give them in increasing order, each once.";
    }
    return "";
}

std::string allowed_values(const OptionFacts& option) {
    switch (option.kind) {
        case OptionKind::number:
            return number_allowed(option.limits);
        case OptionKind::numbers:
            return "a list that increases, of each " + number_allowed(option.limits);
        case OptionKind::count:
            return std::to_string(option.least) +
                   (option.most >= std::numeric_limits<int>::max() ? " or more" : " to " + std::to_string(option.most));
        case OptionKind::word:
            return numbered(option.words);
        case OptionKind::truth:
            return "true and false";
        case OptionKind::path:
            return "a path";
    }
    return "";
}

std::string text_of(const OptionValue& value) {
    if (const auto* number_held = std::get_if<double>(&value)) return number(*number_held);
    if (const auto* count = std::get_if<std::int64_t>(&value)) return std::to_string(*count);
    if (const auto* truth = std::get_if<bool>(&value)) return *truth ? "on" : "off";
    if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
        std::string text;
        for (const double one : *numbers) text += (text.empty() ? "" : ",") + number(one);
        return text;
    }
    return std::get<std::string>(value);
}

std::string default_text(const OptionFacts& option, const OptionValue& by_default) {
    const auto* value = std::get_if<double>(&by_default);
    const bool is_endless = value && !std::isfinite(*value);
    const bool is_told = text_of(by_default).empty() || !allows(option, by_default) || is_endless;
    if (is_told && !option.by_default.empty()) return option.by_default;
    return is_endless ? "" : text_of(by_default);
}

bool is_same(const OptionValue& a, const OptionValue& b) {
    const auto *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
    return a == b || (x && y && std::isnan(*x) && std::isnan(*y));
}

void check_value(const std::string& whose, const OptionFacts& option, const OptionValue& value,
                 const OptionValue& by_default) {
    if (option.of_build || allows(option, value) || is_same(value, by_default)) return;
    if (option.kind == OptionKind::numbers)
        throw BadInput(whose + option.name + ": " + fault_in(option.limits, std::get<std::vector<double>>(value)));
    const std::string unit = *option.limits.unit == '\0' ? "" : " " + std::string(option.limits.unit);
    const std::string text = whose + option.name + " is " + text_of(value) + unit + "; " + allowed_values(option);
    if (option.kind == OptionKind::word) throw BadInput(text + " are allowed.");
    const std::string usual = default_text(option, by_default);
    throw BadInput(text + " is needed" + (usual.empty() ? "." : ", " + usual + " is the default."),
                   {.value = as_number(value)});
}

}  // namespace abut
