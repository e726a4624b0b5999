#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <string>

#include "abut/input/grammar.hpp"
#include "abut/run/user_words.hpp"

TEST_CASE("the document shows the grammar that scenes are read by", "[input][grammar]") {
    std::ifstream file(ABUT_SOURCE "/docs/scenes.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK(text.find(abut::input::grammar()) != std::string::npos);
}

TEST_CASE("what messages call an option by is a key of that table", "[input][grammar]") {
    const std::string grammar = abut::input::grammar();
    for (const auto& [table, key] : abut::run::option_keys()) {
        CAPTURE(table, key);
        const auto begin = grammar.find("### [" + std::string(table) + "]\n");
        REQUIRE(begin != std::string::npos);
        const auto found = grammar.find("| `" + std::string(key) + "` |", begin);
        CHECK(found < grammar.find("### [", begin + 1));
    }
}
