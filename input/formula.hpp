#pragma once
// Private to the layer.
#include <memory>
#include <string>

#include "abut/base/vector.hpp"

namespace abut::input {

/// What a formula may depend on.
enum class Variables { none, time, time_and_plane, time_and_space };

/// A number, or an expression of muParser in t [s] and x, y, z [m], with pi. Calls from several threads wait for each
/// other.
class Formula {
public:
    Formula() = default;
    explicit Formula(double value) : value_(value) {}
    /// Throws BadInput saying what is wrong with the text: a name that is not known here, bad syntax, no finite number
    /// where it depends on nothing.
    Formula(const std::string& text, Variables variables);

    [[nodiscard]] double operator()(double time, const Vector<3>& position) const;
    [[nodiscard]] bool varies() const { return expression_ != nullptr; }
    [[nodiscard]] double value() const { return value_; }  ///< where it does not vary

private:
    class Expression;
    double value_ = 0.0;
    std::shared_ptr<Expression> expression_;  // null: `value_`
};

}  // namespace abut::input
