#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "abut/base/counted.hpp"
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
