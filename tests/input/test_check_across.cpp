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

TEST_CASE("check tells what a finite body of few cells across bears where contact presses on it, and of no other body",
          "[input][check]") {
    const std::string finite = "bodies.left.kinematics=finite";
    const auto shares = [&](const char* counts, const char* share) {
        CAPTURE(counts);
        return said({finite, std::string("bodies.left.counts=") + counts}).find(share) != std::string::npos;
    };
    CHECK(said({finite}).find("body 'left', which is finite, has at most 2 cells across") != std::string::npos);
    CHECK(said({finite}).find("bears less than 0.81 of its force") != std::string::npos);
    // scripts/pressed_blocks; an even number of cells may be one less
    CHECK(shares("[4, 4]", "bears 0.56 to 0.89 of its force"));
    CHECK(shares("[6, 6]", "bears 0.81 to 0.95 of its force"));
    CHECK(shares("[8, 8]", "bears 0.87 to 0.98 of its force"));
    CHECK(shares("[9, 9]", "bears 0.93 to 0.99 of its force"));
    CHECK(shares("[14, 14]", "bears 0.97 to 0.99 of its force"));
    for (const std::vector<std::string>& set : {std::vector<std::string>{},
                                                {finite, "bodies.left.counts=[18, 18]"},
                                                {finite, "contact.enabled=false"},
                                                {"bodies.left.kinematics=floating"}})
        CHECK(said(set).find("of its force") == std::string::npos);
}
