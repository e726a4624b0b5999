#include <catch2/catch.hpp>
#include <string>

#include "abut/input/keys.hpp"
#include "abut/input/option_keys.hpp"
#include "support/dummy_options.hpp"

using namespace abut;

namespace {

struct Ground {
    test::Soil soil;
};

input::Keys<Ground> ground_keys() {
    return input::keys_of_options<Ground>(test::soil_options(), "soil",
                                          [](Ground& ground) -> test::Soil& { return ground.soil; });
}

/// What a table of these lines makes, and its faults.
struct Read {
    Ground ground;
    std::vector<input::Fault> faults;
};
Read read(const std::string& lines) {
    input::Reader reader;
    Read result;
    for (std::size_t begin = 0; begin < lines.size();) {
        const std::size_t end = lines.find('\n', begin);
        input::read_table(result.ground, input::read_override(lines.substr(begin, end - begin)), "soil", ground_keys(),
                          reader);
        begin = end == std::string::npos ? lines.size() : end + 1;
    }
    result.faults = reader.faults();
    return result;
}

}  // namespace

TEST_CASE("every option of a table is a key with its kind, unit, default and help", "[input][options]") {
    const auto keys = ground_keys();
    REQUIRE(keys.size() == 7);
    const auto check = [](const input::Key<Ground>& key, const char* name, const char* value, const char* unit,
                          const char* by_default) {
        CHECK(key.name == name);
        CHECK(key.value == value);
        CHECK(key.unit == unit);
        CHECK(key.by_default == by_default);
        CHECK_FALSE(key.help.empty());
    };
    check(keys[0], "soil_stiffness", "number", "Pa", "2.5");
    check(keys[1], "layers", "whole number", "", "3");
    check(keys[2], "is_wet", "true, false", "", "false");
    check(keys[3], "drains", "true, false", "", "true");
    check(keys[4], "grain", "fine, coarse", "", "coarse");
    check(keys[5], "map", "path", "", "nowhere");
    check(keys[6], "depths", "list of numbers", "m", "");
}

TEST_CASE("keys of options reach their members", "[input][options]") {
    const auto [ground, faults] =
        read("soil_stiffness=1.5\nlayers=9\nis_wet=true\ndrains=false\ngrain='fine'\nmap='here'\ndepths=[0.5, 2]");
    CHECK(faults.empty());
    CHECK(ground.soil.stiffness == 1.5);
    CHECK(ground.soil.layers == 9);
    CHECK(ground.soil.is_wet);
    CHECK_FALSE(ground.soil.drains);
    CHECK(ground.soil.grain == test::Grain::fine);
    CHECK(ground.soil.map == "here");
    CHECK(ground.soil.depths == std::vector{0.5, 2.0});
}

TEST_CASE("a key of an option refuses what the table does not allow", "[input][options]") {
    const auto fault = [](const std::string& line) { return read(line).faults.at(0).text; };
    CHECK(fault("soil_stiffness=0") == "soil.soil_stiffness is 0 Pa; above 0 Pa is needed.");
    CHECK(fault("depths=[2, 1]") == "soil.depths, number 2 is 1 m, after 2 m. Give them in increasing order, each once.");
    CHECK(fault("layers=10") == "soil.layers is 10, 1 to 9 is needed.");
    CHECK(fault("grain='fien'").find("'fine'") != std::string::npos);
    CHECK(fault("drains='off'").find("true or false") != std::string::npos);
    CHECK(fault("layer=3").find("Did you mean 'layers'?") != std::string::npos);
}
