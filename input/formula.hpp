#pragma once
// Private to the layer.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "abut/base/unit.hpp"
#include "abut/base/vector.hpp"

namespace abut::input {

/// Variables on which a formula may depend.
enum class Variables { none, time, time_and_plane, time_and_space };

/// A number that formulas know by its name.
struct NamedNumber {
    std::string name;
    std::string where;  ///< Fault::where
    double value = 0.0;
    bool used = false;                        ///< by a formula
    std::optional<Unit::Powers> dimension{};  ///< not known of one that has no unit
};

/// Throws BadInput for a name that no formula could use, such as "t", "pi" or "a-b".
void check_name_of_number(const std::string& name);

/// A number, or an expression of muParser in t [s] and x, y, z [m], with pi and named numbers. Calls from several
/// threads wait for each other.
class Formula {
public:
    Formula() = default;
    explicit Formula(double value) : value_(value) {}
    /// Throws BadInput saying what is wrong with the text: a name that is not known here, bad syntax, no finite number
    /// where it depends on nothing. Marks the named numbers that it uses.
    Formula(const std::string& text, Variables variables, std::vector<NamedNumber>& numbers);

    [[nodiscard]] double operator()(double time, const Vector<3>& position) const;
    [[nodiscard]] bool varies() const { return expression_ != nullptr; }
    [[nodiscard]] double value() const { return value_; }  ///< where it does not vary

private:
    class Expression;
    double value_ = 0.0;
    std::shared_ptr<Expression> expression_;  // null: `value_`
};

/// The dimension of a formula that depends on nothing, told from how its value scales when metre, kilogram and second
/// do. Nothing where that cannot be told: it uses no number, or one without a unit, or it is 0. Angles are numbers in
/// formulas. Throws BadInput for a value that scales as no unit does, such as a sum of a length and a plain number.
[[nodiscard]] std::optional<Unit::Powers> dimension_of(const std::string& formula, std::vector<NamedNumber> numbers);

}  // namespace abut::input
