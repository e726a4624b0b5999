#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "input/scenes.hpp"

using namespace abut;
using test::two_blocks;
using test::WrittenScene;

namespace {

/// Two blocks of 2 and 3 cells across, or as set.
std::string said(const std::vector<std::string>& set) {
    const WrittenScene file(two_blocks());
    const input::CheckedScene checked = input::check_scene(file.path(), {.set = set});
    CAPTURE(input::text_of(checked.faults));
    REQUIRE(checked.estimate);
    return input::text_of(*checked.estimate);
}

}  // namespace

TEST_CASE("check tells how many cells are across the body that has the fewest", "[input][check]") {
    CHECK(said({}).find("cells across    at most 2 in 'left'") != std::string::npos);
    CHECK(said({"bodies.left.counts=[9, 9]"}).find("cells across    at most 4 in 'right'") != std::string::npos);
    CHECK(said({"bodies.left.kinematics=rigid"}).find("cells across    at most 4 in 'right'") != std::string::npos);
}
