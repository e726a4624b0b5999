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
#include "abut/input/nearest_word.hpp"

namespace abut::input {

namespace {

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
    explicit Expression(const std::string& text) {
        with_parser([&] {
            for (std::size_t i = 0; i < names.size(); ++i) parser_.DefineVar(names[i], &values_[i]);
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

    static constexpr std::array<const char*, 4> names{"t", "x", "y", "z"};

private:
    std::array<double, 4> values_{};
    mu::Parser parser_;
    std::mutex mutex_;
};

namespace {

std::vector<std::string> names_of(Variables variables, const std::array<const char*, 4>& names) {
    const std::ptrdiff_t n = variables == Variables::none             ? 0
                             : variables == Variables::time           ? 1
                             : variables == Variables::time_and_plane ? 3
                                                                      : 4;
    return {names.begin(), names.begin() + n};
}

}  // namespace

Formula::Formula(const std::string& text, Variables variables) {
    const auto expression = std::make_shared<Expression>(text);
    const auto known = names_of(variables, Expression::names);
    bool varies = false;
    for (const std::string& name : expression->used_names()) {
        varies = true;
        if (std::ranges::find(known, name) != known.end()) continue;
        throw BadInput(fmt::format("a formula knows no name '{}' here.{}", name, hint(name, known)));
    }
    value_ = expression->evaluate(0.0, Vector<3>::Zero());
    if (varies)
        expression_ = expression;
    else if (!std::isfinite(value_))
        throw BadInput(fmt::format("as a formula it is {}, not finite.", value_));
}

double Formula::operator()(double time, const Vector<3>& position) const {
    return expression_ ? expression_->evaluate(time, position) : value_;
}

}  // namespace abut::input
