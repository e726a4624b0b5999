// Options of a table on a command line.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "apps/support/command_line.hpp"
#include "support/dummy_options.hpp"

namespace {

using namespace abut;
using Catch::Contains;

void add_soil(apps::CommandParser& parser, test::Soil& soil) {
    for (const Option<test::Soil>& option : test::soil_options()) apps::add_option(parser, bound(option, soil));
}

test::Soil parsed(const std::string& line) {
    apps::CommandParser parser;
    test::Soil soil;
    add_soil(parser, soil);
    parser.parse(line);
    return soil;
}

}  // namespace

TEST_CASE("every option of a table is a flag that help explains with unit, words and default", "[programs][options]") {
    apps::CommandParser program;
    test::Soil soil;
    soil.layers = 4;
    add_soil(program.add_command("dig", "digs"), soil);
    const apps::Command command = program.commands().at(0);
    const auto check = [&](const char* flag, const char* takes, const char* text) {
        CAPTURE(flag);
        const auto option = std::ranges::find(command.options, flag, &apps::CommandOption::name);
        REQUIRE(option != command.options.end());
        CHECK(option->value == takes);
        CHECK(option->meaning == text);
        CHECK(option->group == "Soil");
    };
    check("--soil-stiffness", "X", "of the soil [Pa] (default 2.5)");
    check("--soil-layers", "N", "layers of the soil [-] (default 4)");  // the present value
    check("--is-wet", "", "it has rained (default off)");
    check("--drains", "on|off", "water leaves (default on)");
    check("--grain", "fine|coarse", "size of the grains (default coarse)");
    check("--map", "DIR", "where it lies (default nowhere)");
    check("--depths", "X[,X...]", "of its layers [m]");
}

TEST_CASE("flags of options reach their members", "[programs][options]") {
    const test::Soil soil =
        parsed("--soil-stiffness 1.5 --soil-layers 9 --is-wet --drains off --grain fine --map here --depths 0.5,2");
    CHECK(soil.stiffness == 1.5);
    CHECK(soil.layers == 9);
    CHECK(soil.is_wet);
    CHECK_FALSE(soil.drains);
    CHECK(soil.grain == test::Grain::fine);
    CHECK(soil.map == "here");
    CHECK(soil.depths == std::vector{0.5, 2.0});
}

TEST_CASE("a flag takes the units of its dimension, and names them where another one is given", "[programs][options]") {
    CHECK(parsed("--soil-stiffness 3kPa").stiffness == 3000.0);
    CHECK(parsed("--soil-stiffness 2.5N/mm^2").stiffness == 2.5e6);
    CHECK(parsed("--depths 500mm,2").depths == std::vector{0.5, 2.0});
    CHECK_THROWS_WITH(parsed("--soil-stiffness 3mm"),
                      Contains("--soil-stiffness is '3mm'") && Contains("unit of a length") && Contains("kPa, MPa, GPa"));
    CHECK_THROWS_WITH(parsed("--soil-stiffness 3kpa"), Contains("Did you mean 'kPa'?"));
    CHECK_THROWS_WITH(parsed("--soil-stiffness -3kPa"), Contains("-3000 Pa is not allowed"));
}

TEST_CASE("a flag refuses what the table does not allow", "[programs][options]") {
    CHECK_THROWS_WITH(parsed("--soil-stiffness 0"), Contains("0 Pa is not allowed") && Contains("above 0 Pa"));
    CHECK_THROWS_WITH(parsed("--soil-layers 10"), Contains("from 1 to 9"));
    CHECK_THROWS_WITH(parsed("--grain fien"), Contains("fine, coarse"));
    CHECK_THROWS_WITH(parsed("--depths 1,3,2"), Contains("--depths: number 3 is 2 m, after 3 m"));
    CHECK_THROWS_WITH(parsed("--depths 0,1"), Contains("0 m is not allowed"));
    CHECK_THROWS_WITH(parsed("--depths 1,"), Contains("'' is no number"));
    CHECK_THROWS_WITH(parsed("--drains maybe"), Contains("on, off"));
}
