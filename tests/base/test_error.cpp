#include <catch2/catch.hpp>

#include <cmath>

#include "abut/base/error.hpp"

using namespace abut;

TEST_CASE("an error keeps its kind, its facts and its text through its base", "[base][error]") {
    try {
        throw TooDeep("faces 3 and 7", {.face_1 = 3, .face_2 = 7, .value = 2.5, .allowed = 2.0});
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::too_deep);
        CHECK(error.facts().face_1 == 3);
        CHECK(error.facts().face_2 == 7);
        CHECK(error.facts().cell == ErrorFacts::none);
        CHECK(error.facts().value == 2.5);
        CHECK(error.facts().allowed == 2.0);
        CHECK(error.what() == std::string("faces 3 and 7"));
    }
    CHECK(std::isnan(BadInput("mesh").facts().value));
}

TEST_CASE("each kind of error has its type and its name", "[base][error]") {
    CHECK(BadInput("").kind() == ErrorKind::bad_input);
    CHECK(Misuse("").kind() == ErrorKind::misuse);
    CHECK(Diverged("").kind() == ErrorKind::diverged);
    CHECK(TooDeep("").kind() == ErrorKind::too_deep);
    CHECK(LimitExceeded("").kind() == ErrorKind::limit_exceeded);
    CHECK(name(ErrorKind::limit_exceeded) == std::string("limit exceeded"));
    CHECK_THROWS_AS(throw BadInput("text"), std::runtime_error);
}
