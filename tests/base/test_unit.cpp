#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/unit.hpp"

using namespace abut;

namespace {

/// A text such as "25 mm" as a number in `unit`.
double read(const std::string& text, const std::string& unit) {
    const auto split = value_with_unit(text);
    REQUIRE(split);
    return converted(split->value, unit_for(split->unit, unit), unit_of(unit));
}

std::string message(const std::string& text, const std::string& unit) {
    try {
        static_cast<void>(read(text, unit));
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("values with decimal units are the doubles of their decimal numbers in SI, bit for bit", "[base][unit]") {
    CHECK(read("210 GPa", "Pa") == 210e9);
    CHECK(read("7.85 g/cm^3", "kg/m^3") == 7850.0);
    CHECK(read("7.85g/cm3", "kg/m^3") == 7850.0);
    CHECK(read("25 mm", "m") == 0.025);
    CHECK(read("-3 m/s", "m/s") == -3.0);
    CHECK(read("+.5e1 km", "m") == 5000.0);
    CHECK(read("10 mm/s\u00B2", "m/s^2") == 0.01);
    CHECK(read("0.3 \u00B5s", "s") == 0.3e-6);
    CHECK(read("0.3 \u03BCs", "s") == 0.3e-6);
    CHECK(read("12 N/mm^2", "Pa") == 12e6);
    CHECK(read("12 N*mm^-2", "Pa") == 12e6);
    CHECK(read("2 kN\u00B7m", "N m") == 2000.0);
    CHECK(read("3 m/s/s", "m/s^2") == 3.0);
    CHECK(read("1.3 bar", "Pa") == 1.3e5);
    CHECK(read("1 kg/l", "kg/m^3") == 1000.0);
    CHECK(read("2.5 t/m^3", "kg/m^3") == 2500.0);
    CHECK(read("7 MB", "MB") == 7.0);
}

TEST_CASE("other units have the factors that define them", "[base][unit]") {
    using std::numbers::pi;
    CHECK(read("30 deg/s", "rad/s") == Approx(pi / 6.0).epsilon(1e-15));
    CHECK(read("90 \u00B0", "rad") == Approx(pi / 2.0).epsilon(1e-15));
    CHECK(read("1200 rpm", "rad/s") == Approx(40.0 * pi).epsilon(1e-15));
    CHECK(read("20 rev/s", "rad/s") == Approx(40.0 * pi).epsilon(1e-15));
    CHECK(read("72 km/h", "m/s") == 20.0);
    CHECK(read("90 s", "min") == 1.5);
    CHECK(read("2 h", "min") == 120.0);
    CHECK(read("1 in", "m") == 0.0254);
    CHECK(read("1 ft", "m") == 0.3048);
    CHECK(read("1 lb", "kg") == 0.45359237);
    CHECK(read("1 lbf", "N") == Approx(4.4482216152605).epsilon(1e-15));
    CHECK(read("1 psi", "Pa") == Approx(6894.757293168361).epsilon(1e-15));
    CHECK(read("1 lb/ft^3", "kg/m^3") == Approx(16.018463373960142).epsilon(1e-15));
    CHECK(read("1 lbf/in^2", "psi") == Approx(1.0).epsilon(1e-15));
}

TEST_CASE("a value goes to another unit and back, and units multiply as their parts do", "[base][unit]") {
    for (const std::string& name : unit_names()) {
        CAPTURE(name);
        const Unit unit = unit_of(name), squared = unit_of(name + "^2"), inverse = unit_of("s/" + name + "/s");
        const Unit si{.powers = unit.powers};
        const double there = converted("1", unit, si), back = converted("1", si, unit);
        CHECK(there * back == Approx(1.0).epsilon(1e-15));
        CHECK(converted("1", squared, {.powers = squared.powers}) == Approx(there * there).epsilon(1e-15));
        CHECK(converted("1", inverse, {.powers = inverse.powers}) * there == Approx(1.0).epsilon(1e-15));
        for (std::size_t i = 0; i < unit.powers.size(); ++i) {
            CHECK(squared.powers[i] == 2 * unit.powers[i]);
            CHECK(inverse.powers[i] == -unit.powers[i]);
        }
    }
    for (const auto& [text, same] : std::vector<std::pair<std::string, std::string>>{
             {"N", "kg m/s^2"}, {"Pa", "N/m^2"}, {"J", "N m"}, {"psi", "lbf/in^2"}, {"bar", "hN/m/mm"}}) {
        CAPTURE(text);
        CHECK(unit_of(text).powers == unit_of(same).powers);
        CHECK(converted("1", unit_of(text), unit_of(same)) == Approx(1.0).epsilon(1e-15));
    }
}

TEST_CASE("prefixes multiply by their powers of ten, and a name goes before a prefix", "[base][unit]") {
    const std::vector<std::pair<std::string, double>> factors{{"p", 1e-12}, {"n", 1e-9}, {"u", 1e-6}, {"m", 1e-3},
                                                              {"c", 1e-2},  {"d", 1e-1}, {"h", 1e2},  {"k", 1e3},
                                                              {"M", 1e6},   {"G", 1e9},  {"T", 1e12}};
    for (const auto& [prefix, factor] : factors) CHECK(read("1 " + prefix + "Pa", "Pa") == factor);
    CHECK(read("1 min", "s") == 60.0);  // no milli-inch
    CHECK(read("1 ft", "m") == 0.3048);
    CHECK_THROWS_AS(unit_of("kin"), BadInput);
    CHECK_THROWS_AS(unit_of("mrpm"), BadInput);
}

TEST_CASE("what is no value with a unit is left to formulas", "[base][unit]") {
    for (const char* text : {"", "1", "-2e3", "2*pi", "(1+2)", "(1+2)*3", "sin(1)", "(t < 1) ? 2 : 3", "mm", "1 + 2", "1/2",
                             "pi/6", "(1", "1e3", "."})
        CHECK_FALSE(value_with_unit(text));
    const auto formula = value_with_unit(" (2*(3 + 4))  mm/s ");
    REQUIRE(formula);
    CHECK(formula->is_formula);
    CHECK(formula->value == "2*(3 + 4)");
    CHECK(formula->unit == "mm/s");
    const auto number = value_with_unit("1e3mm");
    REQUIRE(number);
    CHECK(number->value == "1e3");
    CHECK(number->unit == "mm");
}

TEST_CASE("a unit that is not known, cannot be read or is of another dimension is refused in words that help",
          "[base][unit]") {
    CHECK(message("1 Gpa", "Pa") == "the unit 'Gpa' is not known. Did you mean 'GPa'?");
    CHECK(message("1 mpa", "Pa") == "the unit 'mpa' is not known. Did you mean 'MPa' or 'mPa'?");
    CHECK(message("1 degrees", "rad") == "the unit 'degrees' is not known. Did you mean 'deg'?");
    CHECK(message("1 furlong", "m").find("Known are m, g, t, s, min, h, rad, deg") != std::string::npos);
    CHECK(message("2 mm", "Pa") ==
          "'mm' is the unit of a length, Pa (also kPa, MPa, GPa, N/mm^2, bar, psi) is needed. A number without a unit is in "
          "Pa.");
    CHECK(message("2 Hz", "rad/s").find("is the unit of a frequency, rad/s (also deg/s") != std::string::npos);
    CHECK(message("2 m^2 kg", "m") ==
          "'m^2 kg' is the unit of m^2 kg, m (also mm, um, cm, km, in, ft) is needed. A number without "
          "a unit is in m.");
    CHECK(message("2 mm", "") == "'mm' is the unit of a length, and this value has none. Leave it out.");
    CHECK(message("1 J/kg m", "J").find("products in front") != std::string::npos);
    CHECK(message("1 m//s", "m/s").find("a name such as mm is needed at '/s'") != std::string::npos);
    CHECK(message("1 m/", "m").find("ends with /") != std::string::npos);
    CHECK(message("1 m^x", "m").find("a power is a whole number") != std::string::npos);
    CHECK(message("1 m^10", "m").find("at most 9") != std::string::npos);
    CHECK(message("25 mm * 2", "m").find("in parentheses") != std::string::npos);
    CHECK(message("1 " + std::string(5000, 'm'), "m").size() < 400);
}

TEST_CASE("units that messages name are known, and of the dimension that they are named for", "[base][unit]") {
    for (const char* unit : {"m", "kg", "s", "rad", "B", "m/s", "m/s^2", "rad/s", "Hz", "N", "Pa", "kg/m^3", "J", "N/m",
                             "N s/m", "N m s", "m^2", "m^3"}) {
        std::string list = usual_units(unit);
        CHECK_FALSE(list.empty());
        while (!list.empty()) {
            const auto comma = list.find(", ");
            const std::string one = list.substr(0, comma);
            CAPTURE(unit, one);
            CHECK(unit_of(one).powers == unit_of(unit).powers);
            list = comma == std::string::npos ? "" : list.substr(comma + 2);
        }
    }
}

TEST_CASE("numbers of any length and size are read, beyond doubles as infinite or 0", "[base][unit]") {
    CHECK(read("1e400 m", "m") == std::numeric_limits<double>::infinity());
    CHECK(read("-1e400 m", "m") == -std::numeric_limits<double>::infinity());
    CHECK(read("1e-400 km", "m") == 0.0);
    CHECK(read("1e99999999999999999999 m", "m") == std::numeric_limits<double>::infinity());
    CHECK(read(std::string(400, '1') + "e-400 m", "m") == Approx(0.1111111111).epsilon(1e-9));
}

TEST_CASE("a formula is converted by one factor, and keeps its parentheses", "[base][unit]") {
    CHECK(converted_formula("1 + t", unit_of("mm"), unit_of("m")) == "(1 + t)/1e3");
    CHECK(converted_formula("t", unit_of("GPa"), unit_of("Pa")) == "(t)*1e9");
    CHECK(converted_formula("t", unit_of("km/h"), unit_of("m/s")) == "(t)*1e1/36");
    CHECK(converted_formula("t", unit_of("m"), unit_of("m")) == "(t)");
}

TEST_CASE("any text is a value with a unit, none, or refused: nothing else happens", "[base][unit]") {
    const std::string letters = "mkgsNPa0123456789.-+eE()^*/ \u00B5\u00B0\u00B2 \t%";
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> letter(0, letters.size() - 1), length(0, 9);
    int n_read = 0;
    for (int i = 0; i < 20000; ++i) {
        std::string text;
        for (std::size_t n = length(random); n > 0; --n) text += letters[letter(random)];
        CAPTURE(text);
        const auto split = value_with_unit(text);
        if (!split) continue;
        CHECK_FALSE(split->unit.empty());
        try {
            const Unit unit = unit_of(split->unit);
            if (!split->is_formula) CHECK_FALSE(std::isnan(converted(split->value, unit, {.powers = unit.powers})));
            ++n_read;
        } catch (const BadInput& error) {
            CHECK(std::string(error.what()).size() < 400);
        }
    }
    CHECK(n_read > 100);
}
