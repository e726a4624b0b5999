#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Units of values that people write: "210 GPa", "7.85 g/cm^3", "(2*pi/3) rad/s".
namespace abut {

/// A unit as 10^tens times/over m^a kg^b s^c rad^d B^e. Angles count as a dimension, so that a frequency [Hz] is no angular
/// velocity [rad/s]: these differ by 2 pi.
struct Unit {
    using Powers = std::array<int, 5>;

    Powers powers{};  ///< of m, kg, s, rad and B
    int tens = 0;
    double times = 1.0;
    double over = 1.0;
};

/// A unit of the table of names and prefixes, or a product "N m", quotient "m/s" and power "m^2", "m2", "m²" of them;
/// empty: none. Throws BadInput for a name that is not known, with the nearest one that is, and for what cannot be
/// read.
[[nodiscard]] Unit unit_of(const std::string& text);

/// A value with a unit, in the two parts that a text has.
struct ValueWithUnit {
    std::string value;  ///< a number, or a formula without the parentheses around it
    bool is_formula = false;
    std::string unit;
};

/// Nothing for a text that is not a number, or a formula in parentheses, and letters behind it.
[[nodiscard]] std::optional<ValueWithUnit> value_with_unit(std::string_view text);

/// Value of the number in another unit. Where the two differ by a power of ten it is the double that is nearest to the
/// decimal number: "25" in mm is 0.025 m. Infinite beyond the range of numbers. The dimensions must be equal.
[[nodiscard]] double converted(const std::string& number, const Unit& from, const Unit& to);
/// A formula for what the formula is in another unit.
[[nodiscard]] std::string converted_formula(const std::string& formula, const Unit& from, const Unit& to);

/// "a length", "a stress or a pressure"; of what has no name its dimension, "m^2 kg".
[[nodiscard]] std::string dimension_name(const Unit::Powers& powers);
/// Usual units of the dimension that `unit` has, beside itself: "mm, cm, km, in, ft"; empty where none is usual.
[[nodiscard]] std::string usual_units(const std::string& unit);

/// The unit of a value for an option or a key that has the unit `wanted`. Throws BadInput where its dimension is
/// another one, saying which it is and which units are usual.
[[nodiscard]] Unit unit_for(const std::string& text, const std::string& wanted);

/// Names of units, without prefixes.
[[nodiscard]] std::vector<std::string> unit_names();

}  // namespace abut
