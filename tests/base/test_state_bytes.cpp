#include <catch2/catch.hpp>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/state_bytes.hpp"
#include "abut/base/state_fields.hpp"
#include "abut/base/vector.hpp"

using namespace abut;
using Catch::Matchers::Contains;

namespace {

enum class Reason : std::uint8_t { strain, stress };

struct Part {
    std::string name{};
    Vector<2> place = Vector<2>::Zero();
    bool is_known = false;
    Reason reason = Reason::strain;

    static auto fields(auto& self) { return std::tie(self.name, self.place, self.is_known, self.reason); }
    bool operator==(const Part&) const = default;
};

struct Whole {
    std::vector<Part> parts{};
    std::vector<double> numbers{};
    std::vector<std::vector<std::array<double, 3>>> paths{};
    std::map<std::pair<std::int32_t, std::int32_t>, Part> of_pair{};
    std::optional<Part> there{}, missing{};

    static auto fields(auto& self) {
        return std::tie(self.parts, self.numbers, self.paths, self.of_pair, self.there, self.missing);
    }
    bool operator==(const Whole&) const = default;
};

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

TEST_CASE("the fields of a value are saved and restored as one list, nothing of the value before is left", "[base][state]") {
    const Part part{.name = "left", .place = {1.5, -2.0}, .is_known = true, .reason = Reason::stress};
    const Whole whole{.parts = {part, {}},
                      .numbers = {0.1, -0.0},
                      .paths = {{}, {{1.0, 2.0, 3.0}}},
                      .of_pair = {{{1, 2}, part}},
                      .there = part};
    StateWriter state("whole", 1);
    put_value(state, whole);
    const std::vector<std::byte> bytes = std::move(state).finish();
    Whole other{.parts = {part, part, part}, .of_pair = {{{7, 8}, part}}, .missing = part};
    StateReader reader(bytes, "whole", 1);
    get_value(reader, other);
    CHECK_NOTHROW(reader.finish());
    CHECK(other == whole);
}

TEST_CASE("a vector that claims more than the state has is refused before its memory is asked for", "[base][state]") {
    StateWriter state("whole", 1);
    state.put(std::uint64_t{1} << 60);
    const std::vector<std::byte> bytes = std::move(state).finish();
    std::vector<double> numbers;
    std::vector<Part> parts;
    StateReader of_numbers(bytes, "whole", 1), of_parts(bytes, "whole", 1);
    CHECK_THROWS_WITH(get_value(of_numbers, numbers), Contains("ends too early"));
    CHECK_THROWS_WITH(get_value(of_parts, parts), Contains("ends too early"));
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
