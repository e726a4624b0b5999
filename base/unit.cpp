#include "abut/base/unit.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/text.hpp"

namespace abut {
namespace {

using Powers = Unit::Powers;

constexpr double pi = std::numbers::pi;
constexpr int most_power = 9;           // of a unit
constexpr int most_tens = 1000;         // of a number and its unit: beyond it there is no double
constexpr std::size_t most_shown = 40;  // of a unit in a message [bytes]

struct NamedUnit {
    std::string_view name;
    Powers powers;
    int tens;
    double times;
    double over;
    bool takes_prefix;
};
constexpr Powers metre{1, 0, 0, 0, 0}, kilogram{0, 1, 0, 0, 0}, second{0, 0, 1, 0, 0}, radian{0, 0, 0, 1, 0},
    byte{0, 0, 0, 0, 1}, frequency{0, 0, -1, 0, 0}, force{1, 1, -2, 0, 0}, stress{-1, 1, -2, 0, 0}, energy{2, 1, -2, 0, 0},
    volume{3, 0, 0, 0, 0}, turning{0, 0, -1, 1, 0};
/// The yard of 1959 is 0.9144 m and its pound 0.45359237 kg; a standard gravity is 9.80665 m/s^2.
constexpr std::array named_units = std::to_array<NamedUnit>({{"m", metre, 0, 1.0, 1.0, true},
                                                             {"g", kilogram, -3, 1.0, 1.0, true},
                                                             {"t", kilogram, 3, 1.0, 1.0, false},
                                                             {"s", second, 0, 1.0, 1.0, true},
                                                             {"min", second, 1, 6.0, 1.0, false},
                                                             {"h", second, 2, 36.0, 1.0, false},
                                                             {"rad", radian, 0, 1.0, 1.0, true},
                                                             {"deg", radian, 0, pi, 180.0, false},
                                                             {"\u00B0", radian, 0, pi, 180.0, false},
                                                             {"rev", radian, 0, 2.0 * pi, 1.0, false},
                                                             {"rpm", turning, 0, pi, 30.0, false},
                                                             {"Hz", frequency, 0, 1.0, 1.0, true},
                                                             {"N", force, 0, 1.0, 1.0, true},
                                                             {"Pa", stress, 0, 1.0, 1.0, true},
                                                             {"bar", stress, 5, 1.0, 1.0, true},
                                                             {"J", energy, 0, 1.0, 1.0, true},
                                                             {"l", volume, -3, 1.0, 1.0, true},
                                                             {"in", metre, -4, 254.0, 1.0, false},
                                                             {"ft", metre, -4, 3048.0, 1.0, false},
                                                             {"lb", kilogram, -8, 45359237.0, 1.0, false},
                                                             {"lbf", force, -13, 44482216152605.0, 1.0, false},
                                                             {"psi", stress, -5, 44482216152605.0, 254.0 * 254.0, false},
                                                             {"B", byte, 0, 1.0, 1.0, true}});

/// Prefixes; those that are meant more often come first.
constexpr std::array prefixes = std::to_array<std::pair<std::string_view, int>>({{"k", 3},
                                                                                 {"M", 6},
                                                                                 {"G", 9},
                                                                                 {"m", -3},
                                                                                 {"c", -2},
                                                                                 {"u", -6},
                                                                                 {"\u00B5", -6},  // micro sign
                                                                                 {"\u03BC", -6},  // Greek mu
                                                                                 {"n", -9},
                                                                                 {"T", 12},
                                                                                 {"h", 2},
                                                                                 {"d", -1},
                                                                                 {"p", -12}});

struct NamedDimension {
    const char* name;
    const char* unit;
    const char* usual;  ///< other units of it
};
constexpr std::array dimensions =
    std::to_array<NamedDimension>({{"a length", "m", "mm, um, cm, km, in, ft"},
                                   {"a mass", "kg", "g, t, lb"},
                                   {"a time", "s", "ms, us, min, h"},
                                   {"an angle", "rad", "deg, rev"},
                                   {"a number of bytes", "B", "kB, MB, GB"},
                                   {"a velocity", "m/s", "mm/s, km/s, km/h"},
                                   {"an acceleration", "m/s^2", "mm/s^2, km/s^2"},
                                   {"an angular velocity", "rad/s", "deg/s, rpm, rev/s"},
                                   {"a frequency", "Hz", "kHz, MHz"},
                                   {"a force", "N", "kN, MN, lbf"},
                                   {"a stress or a pressure", "Pa", "kPa, MPa, GPa, N/mm^2, bar, psi"},
                                   {"a density", "kg/m^3", "g/cm^3, t/m^3, kg/l, lb/ft^3"},
                                   {"an energy or a moment", "J", "mJ, kJ, N m, N mm, kN m"},
                                   {"a stiffness", "N/m", "kN/m, N/mm, lbf/in"},
                                   {"a damping", "N s/m", "kN s/m, N s/mm"},
                                   {"a damping of turns", "N m s", "kN m s, N mm s"},
                                   {"an area", "m^2", "mm^2, cm^2, in^2"},
                                   {"a volume", "m^3", "mm^3, cm^3, l, ft^3"}});

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The number of bytes of °, µ (both) or a letter at the beginning; 0: there is none.
std::size_t letter_at_front(std::string_view text) {
    if (text.empty()) return 0;
    if (is_letter(text.front())) return 1;
    for (const std::string_view sign : {"\u00B0", "\u00B5", "\u03BC"})
        if (text.starts_with(sign)) return sign.size();
    return 0;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

Unit of(const NamedUnit& named, int prefix) { return {named.powers, named.tens + prefix, named.times, named.over}; }

std::optional<Unit> find_unit(std::string_view name) {
    for (const NamedUnit& named : named_units)
        if (named.name == name) return of(named, 0);
    for (const auto& [prefix, tens] : prefixes)
        for (const NamedUnit& named : named_units)
            if (named.takes_prefix && name == std::string(prefix) + std::string(named.name)) return of(named, tens);
    return std::nullopt;
}

std::string in_small_letters(std::string_view word) {
    std::string small(word);
    for (char& c : small)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return small;
}

/// Names with the letters of this one, small or capital.
std::string alike(std::string_view name) {
    std::string found;
    const auto look_at = [&](const std::string& known) {
        if (in_small_letters(known) == in_small_letters(name)) found += (found.empty() ? "'" : " or '") + known + "'";
    };
    for (const NamedUnit& named : named_units) look_at(std::string(named.name));
    for (const auto& [prefix, tens] : prefixes)
        for (const NamedUnit& named : named_units)
            if (named.takes_prefix) look_at(std::string(prefix) + std::string(named.name));
    return found;
}

/// Words that stand for a name.
std::string meant(std::string_view name) {
    using Pair = std::pair<std::string_view, const char*>;
    constexpr std::array words = std::to_array<Pair>(
        {{"degree", "deg"}, {"degrees", "deg"}, {"radian", "rad"},  {"radians", "rad"}, {"turn", "rev"}, {"turns", "rev"},
         {"meter", "m"},    {"meters", "m"},    {"metre", "m"},     {"metres", "m"},    {"sec", "s"},    {"second", "s"},
         {"seconds", "s"},  {"minute", "min"},  {"minutes", "min"}, {"hour", "h"},      {"hours", "h"},  {"inch", "in"},
         {"inches", "in"},  {"foot", "ft"},     {"feet", "ft"},     {"kph", "km/h"},    {"kmh", "km/h"}, {"newton", "N"},
         {"pascal", "Pa"},  {"gram", "g"},      {"kilogram", "kg"}, {"ton", "t"},       {"tonne", "t"},  {"litre", "l"},
         {"liter", "l"},    {"lbs", "lb"},      {"micron", "um"}});
    for (const auto& [word, unit] : words)
        if (word == in_small_letters(name)) return "'" + std::string(unit) + "'";
    return alike(name);
}

[[noreturn]] void refuse_name(std::string_view name) {
    const std::string start = "the unit '" + shortened(as_utf8(name), most_shown) + "' is not known.";
    const std::string near = meant(name);
    if (!near.empty()) throw BadInput(start + " Did you mean " + near + "?");
    std::string known;
    for (const std::string& one : unit_names()) known += (known.empty() ? "" : ", ") + one;
    throw BadInput(start + " Known are " + known +
                   ", with prefixes from p to T (mm, kN), products (N m), quotients (m/s) and powers "
                   "(m^2) of them.");
}

/// Reads a unit from its text, factor by factor.
class Units {
public:
    explicit Units(std::string_view text) : text_(text), left_(trimmed(text)) {}

    [[nodiscard]] Unit read() {
        Unit unit;
        bool below = false;
        while (!left_.empty()) {
            multiply(unit, below ? -1 : 1);
            const bool was_below = below;
            below = take_joint();
            if (was_below && !below && !left_.empty())
                refuse(
                    "what stands behind / may belong above or below it: put products in front, \"N m/s\", or write each /, "
                    "\"J/kg/m\"");
        }
        return unit;
    }

private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw BadInput("the unit '" + shortened(as_utf8(text_), most_shown) + "' cannot be read: " + why + ".");
    }
    void skip_spaces() { left_ = trimmed(left_); }

    /// A name with its power.
    void multiply(Unit& product, int sign) {
        std::size_t length = 0;
        while (const std::size_t letter = letter_at_front(left_.substr(length))) length += letter;
        if (length == 0)
            refuse("a name such as mm is needed at '" + shortened(as_utf8(left_), most_shown) +
                   "'. A formula with a unit stands in parentheses, \"(2*25) mm\"");
        const std::string_view name = left_.substr(0, length);
        const auto unit = find_unit(name);
        if (!unit) refuse_name(name);
        left_.remove_prefix(length);
        const int power = sign * take_power();
        for (std::size_t i = 0; i < unit->powers.size(); ++i) product.powers[i] += power * unit->powers[i];
        product.tens += power * unit->tens;
        for (int i = 0; i < std::abs(power); ++i) {
            product.times *= power > 0 ? unit->times : unit->over;
            product.over *= power > 0 ? unit->over : unit->times;
        }
    }

    /// "^-2", "2" or a superscript; 1 where there is none.
    [[nodiscard]] int take_power() {
        constexpr std::array<std::string_view, 3> above{"\u00B9", "\u00B2", "\u00B3"};
        for (std::size_t i = 0; i < above.size(); ++i)
            if (left_.starts_with(above[i])) {
                left_.remove_prefix(above[i].size());
                return static_cast<int>(i) + 1;
            }
        const bool is_marked = left_.starts_with('^');
        if (is_marked) left_.remove_prefix(1);
        const bool is_negative = is_marked && left_.starts_with('-');
        if (is_negative) left_.remove_prefix(1);
        if (left_.empty() || !is_digit(left_.front())) {
            if (is_marked) refuse("a power is a whole number, as in \"m^2\"");
            return 1;
        }
        int power = 0;
        while (!left_.empty() && is_digit(left_.front())) {
            power = std::min(10 * power + (left_.front() - '0'), most_power + 1);
            left_.remove_prefix(1);
        }
        if (power > most_power) refuse("a power is at most " + std::to_string(most_power));
        return is_negative ? -power : power;
    }

    /// Takes what stands between two factors; true: the next one is below a stroke.
    [[nodiscard]] bool take_joint() {
        skip_spaces();
        const bool is_stroke = left_.starts_with('/');
        for (const std::string_view joint : {"/", "*", "\u00B7"})
            if (left_.starts_with(joint)) {
                left_.remove_prefix(joint.size());
                skip_spaces();
                if (left_.empty()) refuse("it ends with " + std::string(joint));
                break;
            }
        return is_stroke;
    }

    std::string_view text_;
    std::string_view left_;
};

/// Bytes of a decimal number at the beginning; 0: there is none.
std::size_t number_length(std::string_view text) {
    std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    const std::size_t begin = at;
    const auto skip_digits = [&] {
        while (at < text.size() && is_digit(text[at])) ++at;
    };
    skip_digits();
    std::size_t n_digits = at - begin;
    if (at < text.size() && text[at] == '.') {
        ++at;
        skip_digits();
        n_digits = at - begin - 1;
    }
    if (n_digits == 0) return 0;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        std::size_t digit = at + 1;
        if (digit < text.size() && (text[digit] == '-' || text[digit] == '+')) ++digit;
        if (digit < text.size() && is_digit(text[digit])) {
            at = digit;
            skip_digits();
        }
    }
    return at;
}

/// Bytes up to the parenthesis that closes the first one; 0: there is none.
std::size_t parentheses_length(std::string_view text) {
    int open = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '(') ++open;
        if (text[i] == ')' && --open == 0) return i + 1;
        if (open == 0) return 0;
    }
    return 0;
}

/// "12e3" with another power of ten.
double shifted(std::string_view number, int tens) {
    if (number.starts_with('+')) number.remove_prefix(1);
    const std::size_t mark = number.find_first_of("eE");
    std::string digits(number.substr(0, mark));
    int exponent = 0;
    if (mark != std::string_view::npos) {
        std::string_view text = number.substr(mark + 1);
        const bool is_negative = text.starts_with('-');
        if (is_negative || text.starts_with('+')) text.remove_prefix(1);
        for (const char c : text) exponent = std::min(10 * exponent + (c - '0'), 1000000);
        if (is_negative) exponent = -exponent;
    }
    digits += "e" + std::to_string(exponent + tens);
    double value = 0.0;
    if (std::from_chars(digits.data(), digits.data() + digits.size(), value).ec == std::errc{}) return value;
    const bool is_small = exponent + tens < 0;
    return is_small ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), digits.starts_with('-') ? -1.0 : 1.0);
}

}  // namespace

std::vector<std::string> unit_names() {
    std::vector<std::string> names;
    names.reserve(named_units.size());
    for (const NamedUnit& named : named_units) names.emplace_back(named.name);
    return names;
}

Unit unit_of(const std::string& text) {
    const Unit unit = Units(text).read();
    if (std::abs(unit.tens) <= most_tens) return unit;
    throw BadInput("the unit '" + shortened(as_utf8(text), most_shown) + "' is beyond the range of numbers.");
}

std::optional<ValueWithUnit> value_with_unit(std::string_view text) {
    text = trimmed(text);
    const bool is_formula = text.starts_with('(');
    const std::size_t length = is_formula ? parentheses_length(text) : number_length(text);
    if (length == 0) return std::nullopt;
    const std::string_view unit = trimmed(text.substr(length));
    if (letter_at_front(unit) == 0) return std::nullopt;
    const std::string_view value = is_formula ? text.substr(1, length - 2) : text.substr(0, length);
    return ValueWithUnit{std::string(value), is_formula, std::string(unit)};
}

double converted(const std::string& number, const Unit& from, const Unit& to) {
    const double times = from.times * to.over, over = from.over * to.times;
    const int tens = from.tens - to.tens;
    if (times == over) return shifted(number, tens);
    const double scaled = shifted(number, 0) * times / over;
    return tens < 0 ? scaled / std::pow(10.0, -tens) : scaled * std::pow(10.0, tens);
}

std::string converted_formula(const std::string& formula, const Unit& from, const Unit& to) {
    const int tens = from.tens - to.tens;
    const double times = from.times * to.over, over = from.over * to.times;
    std::string text = "(" + formula + ")";
    if (tens != 0) text += (tens > 0 ? "*1e" : "/1e") + std::to_string(std::abs(tens));
    if (times != 1.0) text += "*" + exact_number(times);
    if (over != 1.0) text += "/" + exact_number(over);
    return text;
}

std::string dimension_name(const Powers& powers) {
    for (const NamedDimension& one : dimensions)
        if (unit_of(one.unit).powers == powers) return one.name;
    constexpr std::array<const char*, 5> base{"m", "kg", "s", "rad", "B"};
    std::string text;
    for (std::size_t i = 0; i < base.size(); ++i) {
        if (powers[i] == 0) continue;
        text += (text.empty() ? "" : " ") + std::string(base[i]);
        if (powers[i] != 1) text += "^" + std::to_string(powers[i]);
    }
    return text.empty() ? "a plain number" : text;
}

std::string usual_units(const std::string& unit) {
    const Powers powers = unit_of(unit).powers;
    for (const NamedDimension& one : dimensions)
        if (unit_of(one.unit).powers == powers) return one.usual;
    return "";
}

Unit unit_for(const std::string& text, const std::string& wanted) {
    const Unit unit = unit_of(text);
    if (unit.powers == unit_of(wanted).powers) return unit;
    const std::string start = "'" + shortened(as_utf8(text), most_shown) + "' is the unit of " + dimension_name(unit.powers);
    if (wanted.empty()) throw BadInput(start + ", and this value has none. Leave it out.");
    const std::string usual = usual_units(wanted);
    throw BadInput(start + ", " + wanted + (usual.empty() ? "" : " (also " + usual + ")") +
                   " is needed. A number without a unit is in " + wanted + ".");
}

}  // namespace abut
