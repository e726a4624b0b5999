#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
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

TEST_CASE("check of a run above 100,000 steps names two ways to fewer, whose numbers runs of it have", "[input][check]") {
    const auto steps_of = [](const std::vector<std::string>& set) {
        const WrittenScene file(two_blocks());
        return input::check_scene(file.path(), {.set = set}).estimate->steps;
    };
    const std::string law = "contact.law=pair_potential";
    const std::vector<std::string> fine{law, "run.time=1e5", "bodies.left.counts=[8, 8]", "bodies.right.counts=[8, 8]"};
    const std::vector<std::string> coarse{law, "run.time=1e5", "bodies.left.counts=[4, 4]", "bodies.right.counts=[4, 4]"};
    const std::string text = said(fine);
    CAPTURE(text);
    double larger = 0.0, heavier = 0.0;
    const auto at = text.find("fewer by");
    REQUIRE(at != std::string::npos);
    REQUIRE(std::sscanf(text.c_str() + at,
                        "fewer by cells twice as large: %lf steps, in 1/8 of the time; 100 times the density, where inertia "
                        "does not matter: %lf steps",
                        &larger, &heavier) == 2);
    CHECK(std::abs(larger / static_cast<double>(steps_of(coarse)) - 1.0) <= 0.1);
    std::vector<std::string> dense = fine;
    for (const char* body : {"left", "right"}) dense.push_back(std::string("bodies.") + body + ".density=100");
    CHECK(std::abs(heavier / static_cast<double>(steps_of(dense)) - 1.0) <= 0.06);
    CHECK(said({law, "run.time=10"}).find("fewer by") == std::string::npos);
}
