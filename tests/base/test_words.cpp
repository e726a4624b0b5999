#include <array>
#include <catch2/catch.hpp>
#include <limits>
#include <string>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/base/given_value.hpp"
#include "abut/base/nearest_word.hpp"

using namespace abut;

TEST_CASE("a count of one has its noun in the singular, all others in the plural", "[base]") {
    CHECK(counted(1, "face") == "1 face");
    CHECK(counted(0, "face") == "0 faces");
    CHECK(counted(2, "more body") == "2 more bodies");
    CHECK(counted(3, "boundary") == "3 boundaries");
    CHECK(counted(2, "day") == "2 days");
    CHECK(counted(2, "box") == "2 boxes");
    CHECK(counted(2, "mesh face") == "2 mesh faces");
    CHECK(counted(1, "cell is", "cells are") == "1 cell is");
    CHECK(counted(7, "cell is", "cells are") == "7 cells are");
}

TEST_CASE("the nearest word is the one with the fewest letters changed, and none beyond a third of them", "[base]") {
    const std::vector<std::string> known{"run", "restart", "check"};
    CHECK(nearest_word("rnu", known) == "run");
    CHECK(nearest_word("chekc", known) == "check");
    CHECK_FALSE(nearest_word("ball.toml", known));
    CHECK_FALSE(nearest_word("run", {}));
}

TEST_CASE("a value beyond its limits is refused with its name, the value, the limits, their unit and the remedy",
          "[option]") {
    const Limits limits{.unit = "Pa", .above = 0.0, .remedy = "Steel has 2.1e11 Pa."};
    CHECK(fault_of("young", limits, 1.0).empty());
    for (const double value :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        CAPTURE(value);
        CHECK_THAT(fault_of("young", limits, value),
                   Catch::StartsWith("young is ") && Catch::EndsWith(" Pa; above 0 Pa is needed. Steel has 2.1e11 Pa."));
        CHECK_THROWS_AS(require_allowed("young", limits, value), BadInput);
    }
}

TEST_CASE("a word that is none of a list is answered with all of them, and with the one that is near", "[option]") {
    const std::array<Word<int>, 2> words{{{"keep", 1}, {"restart", 2}}};
    CHECK(choice_called(words, "change", "restart") == 2);
    CHECK_THROWS_WITH(choice_called(words, "change", "restrat"),
                      "change is 'restrat', which is none of 'keep', 'restart'. Did you mean 'restart'?");
    CHECK_THROWS_WITH(choice_called(words, "change", "x"), "change is 'x', which is none of 'keep', 'restart'.");
}
