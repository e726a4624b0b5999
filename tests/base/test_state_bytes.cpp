#include <catch2/catch.hpp>

#include "abut/base/error.hpp"
#include "abut/base/state_bytes.hpp"

using namespace abut;
using Catch::Matchers::Contains;

namespace {

std::vector<std::byte> example() {
    StateWriter state("example", 3);
    state.put(1.5);
    state.put(std::int32_t{-7});
    state.put(std::string("two words"));
    return std::move(state).finish();
}

}  // namespace

TEST_CASE("what is written is read in the same order", "[base][state]") {
    const auto bytes = example();
    StateReader state(bytes, "example", 3);
    CHECK(state.get<double>() == 1.5);
    CHECK(state.get<std::int32_t>() == -7);
    CHECK(state.left() > 0);
    CHECK_THROWS_AS(state.finish(), BadInput);
    CHECK(state.get_text() == "two words");
    CHECK_NOTHROW(state.finish());
    CHECK_THROWS_WITH(state.get<double>(), Contains("ends too early"));
}

TEST_CASE("every change of a byte, and every end before the end, is refused", "[base][state]") {
    const auto bytes = example();
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        auto damaged = bytes;
        damaged[i] ^= std::byte{1};
        CHECK_THROWS_AS(StateReader(damaged, "example", 3), BadInput);
        CHECK_THROWS_AS(StateReader(std::span(bytes).first(i), "example", 3), BadInput);
    }
}

TEST_CASE("a state of another kind or version is refused by name", "[base][state]") {
    const auto bytes = example();
    CHECK_THROWS_WITH(StateReader(bytes, "other", 3), Contains("it is one of example"));
    CHECK_THROWS_WITH(StateReader(bytes, "example", 4), Contains("version 3, 4 is needed"));
}

TEST_CASE("the checksum is that of FNV-1a", "[base][state]") {
    // Published test vectors: the empty text, "a", "foobar".
    const auto of = [](const std::string& text) {
        Checksum checksum;
        checksum.add(std::as_bytes(std::span(text)));
        return checksum.value();
    };
    CHECK(of("") == 0xcbf29ce484222325u);
    CHECK(of("a") == 0xaf63dc4c8601ec8cu);
    CHECK(of("foobar") == 0x85944171f73967e8u);
}
