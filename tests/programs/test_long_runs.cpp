#include <catch2/catch.hpp>

#include <sstream>

#include "programs/program.hpp"

using namespace abut::test::programs;

TEST_CASE("long runs of bodies that turn keep H~, momentum and J~ to round-off, with and without filter and restart",
          "[programs]") {
    const auto outcome = run_program("study long_runs", "--only rattle --steps 5000", "");
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.error.empty());
    std::istringstream lines(outcome.out);
    std::string line;
    std::getline(lines, line);  // the head
    int runs = 0;
    for (; std::getline(lines, line); ++runs) {
        CAPTURE(line);
        std::istringstream words(line);
        std::string scene, remedy;
        double value, excess, end, parasitic, drift, momentum, spin, events;
        REQUIRE(words >> scene >> value >> remedy >> excess >> end >> parasitic >> drift >> momentum >> spin >> events);
        CHECK(events > 0.0);
        CHECK(drift < 1e-11);
        CHECK(momentum < 1e-13);
        CHECK(spin < 1e-13);
    }
    CHECK(runs == 8);
}

TEST_CASE("the bar with filter and restart goes on where it explodes without", "[programs]") {
    const auto outcome = run_program("study long_runs", "--only bar --steps 120000", "");
    REQUIRE(outcome.exit_code == 0);
    std::istringstream lines(outcome.out);
    std::string line;
    std::getline(lines, line);  // the head
    int runs = 0, exploded = 0;
    for (; std::getline(lines, line); ++runs) {
        CAPTURE(line);
        std::istringstream words(line);
        std::string scene, remedy;
        double courant;
        REQUIRE(words >> scene >> courant >> remedy);
        const bool explodes = line.find("explodes") != std::string::npos;
        exploded += explodes ? 1 : 0;
        if (courant == 0.9 && remedy == "off") CHECK(explodes);
        if (remedy != "off") CHECK_FALSE(explodes);
    }
    CHECK(runs == 12);
    CHECK(exploded >= 1);
}
