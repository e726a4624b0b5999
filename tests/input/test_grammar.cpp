#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <string>

#include "abut/input/grammar.hpp"

TEST_CASE("the document shows the grammar that scenes are read by", "[input][grammar]") {
    std::ifstream file(ABUT_SOURCE "/docs/scenes.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK(text.find(abut::input::grammar()) != std::string::npos);
}
