#include "abut/input/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/text.hpp"
#include "abut/input/nearest_word.hpp"

namespace abut::input {

namespace {

constexpr std::array<const char*, 4> names{"t", "x", "y", "z"};

/// Calls muParser, whose errors are none of the standard library: nothing of them leaves this file.
template <class Call>
auto with_parser(const Call& call) {
    try {
        return call();
    } catch (const mu::ParserError& error) {
        throw BadInput(fmt::format("as a formula it cannot be read: {}", error.GetMsg()));
    }
}

}  // namespace

class Formula::Expression {
public:
    Expression(const std::string& text, const std::vector<NamedNumber>& numbers) {
        numbers_.reserve(numbers.size());  // they stay where they are
        with_parser([&] {
            for (std::size_t i = 0; i < names.size(); ++i) parser_.DefineVar(names[i], &values_[i]);
            for (const NamedNumber& number : numbers) {
                numbers_.push_back(number.value);
                parser_.DefineVar(number.name, &numbers_.back());
            }
            parser_.DefineConst("pi", std::numbers::pi);
            parser_.SetExpr(text);
        });
    }
    [[nodiscard]] double evaluate(double time, const Vector<3>& position) {
        const std::lock_guard lock(mutex_);
        values_ = {time, position.x(), position.y(), position.z()};
        return with_parser([&] { return parser_.Eval(); });
    }
    /// Also names that mean nothing.
    [[nodiscard]] std::vector<std::string> used_names() {
        std::vector<std::string> used;
        with_parser([&] {
            for (const auto& [name, value] : parser_.GetUsedVar()) used.push_back(name);
        });
        return used;
    }

private:
    std::array<double, 4> values_{};
    std::vector<double> numbers_;
    mu::Parser parser_;
    std::mutex mutex_;
};

namespace {

std::vector<std::string> names_of(Variables variables) {
    const std::ptrdiff_t n = variables == Variables::none             ? 0
                             : variables == Variables::time           ? 1
                             : variables == Variables::time_and_plane ? 3
                                                                      : 4;
    return {names.begin(), names.begin() + n};
}

}  // namespace

void check_name_of_number(const std::string& name) {
    std::vector<NamedNumber> number{{.name = name}};
    bool good = std::ranges::find(names, name) == names.end();
    try {
        static_cast<void>(Formula(name, Variables::none, number));
    } catch (const BadInput&) {
        good = false;
    }
    if (!good || !number.front().used)
        throw BadInput("its name cannot stand in a formula. Take letters, digits and _, and none of t, x, y, z and pi.");
}

Formula::Formula(const std::string& text, Variables variables, std::vector<NamedNumber>& numbers) {
    const auto expression = std::make_shared<Expression>(text, numbers);
    auto known = names_of(variables);
    bool varies = false;
    for (const std::string& name : expression->used_names()) {
        if (std::ranges::find(known, name) != known.end()) {
            varies = true;
            continue;
        }
        const auto number = std::ranges::find(numbers, name, &NamedNumber::name);
        if (number != numbers.end()) {
            number->used = true;
            continue;
        }
        for (const NamedNumber& other : numbers) known.push_back(other.name);
        throw BadInput(fmt::format("a formula knows no name '{}' here.{}", shortened(name, 80), hint(name, known)));
    }
    value_ = expression->evaluate(0.0, Vector<3>::Zero());
    if (varies)
        expression_ = expression;
    else if (!std::isfinite(value_))
        throw BadInput(fmt::format("as a formula it is {}, not finite.", value_));
}

namespace {

/// The power of one base unit, `i`, in the dimension of a formula; `value` is its value. Scales are powers of 4: of
/// most formulas the values scale without rounding.
int power_of(std::size_t i, double value, const std::string& formula, const std::vector<NamedNumber>& numbers) {
    const auto power_at = [&](int exponent) {
        std::vector<NamedNumber> scaled = numbers;
        for (NamedNumber& number : scaled)
            if (number.dimension) number.value = std::ldexp(number.value, exponent * (*number.dimension)[i]);
        const double ratio = Formula(formula, Variables::none, scaled).value() / value;
        return std::log2(ratio) / exponent;
    };
    const double power = power_at(2), other = power_at(4);
    constexpr double tolerance = 1e-9;
    if (std::abs(power - std::round(power)) < tolerance && std::abs(other - power) < tolerance)
        return static_cast<int>(std::round(power));
    throw BadInput(
        "it mixes dimensions, as a sum of a length and a plain number does. Numbers in formulas have no unit: give one that "
        "has a name in [values], such as gap = \"5 mm\".");
}

}  // namespace

std::optional<Unit::Powers> dimension_of(const std::string& formula, std::vector<NamedNumber> numbers) {
    if (std::ranges::none_of(numbers, [](const NamedNumber& number) { return number.dimension.has_value(); }))
        return std::nullopt;
    for (NamedNumber& number : numbers) number.used = false;
    const double value = Formula(formula, Variables::none, numbers).value();
    if (value == 0.0 || std::ranges::none_of(numbers, &NamedNumber::used)) return std::nullopt;
    if (std::ranges::any_of(numbers, [](const NamedNumber& number) { return number.used && !number.dimension; }))
        return std::nullopt;
    Unit::Powers powers{};
    for (const std::size_t i : {0, 1, 2, 4}) powers[i] = power_of(i, value, formula, numbers);
    return powers;
}

double Formula::operator()(double time, const Vector<3>& position) const {
    return expression_ ? expression_->evaluate(time, position) : value_;
}

}  // namespace abut::input
