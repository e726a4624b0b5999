// Limits beyond which cells of bodies leave.
#include <catch2/catch.hpp>

#include "abut/run/steps/simulation.hpp"
#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::two_blocks;
using test::WrittenScene;

}  // namespace

TEST_CASE("limits of erosion go to the body that has them, and scenes without any have none", "[input][erosion]") {
    const WrittenScene written(two_blocks("[bodies.left.erosion]\nstrain = 0.3\nstress = \"5 MPa\""));
    const auto checked = input::check_scene(written.path());
    CAPTURE(input::text_of(checked.faults));
    REQUIRE(checked.faults.empty());
    const auto limits = input::SceneFile(written.path()).scene<2>().solid.erosion;
    REQUIRE(limits.size() == 2);
    CHECK(limits[0].strain == 0.3);
    CHECK(limits[0].stress == 5e6);
    CHECK(limits[0].plastic_strain == solid::ErosionLimits::none);
    CHECK_FALSE(limits[1].any());
    const WrittenScene without(two_blocks());
    CHECK(input::SceneFile(without.path()).scene<2>().solid.erosion.empty());
}

TEST_CASE("erosion is refused before the run with what it does not go with", "[input][erosion]") {
    const auto faults = [](const std::string& more) {
        const WrittenScene written(two_blocks(more));
        return input::text_of(input::check_scene(written.path()).faults);
    };
    const std::string limit = "\n[bodies.left.erosion]\nstrain = 0.3";
    CHECK(faults(limit).empty());
    CHECK_THAT(faults("integrator = \"leapfrog\"" + limit),
               Catch::Contains("cells leave the run (erosion)") && Catch::Contains("Take the scheme memm"));
    CHECK_THAT(faults("[laboratory]\nprecision = \"single\"" + limit),
               Catch::Contains("steps there do not look at strains"));
    CHECK_THAT(faults("[output]\npieces = true" + limit), Catch::Contains("not made for a run on several ranks"));
}
