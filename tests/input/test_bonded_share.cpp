// How much of what was to be glued is glued.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/bond_text.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/run/words/warnings.hpp"
#include "input/scenes.hpp"

using namespace abut;
using test::WrittenScene;

namespace {

/// A unit block with four faces on top, and one with five below it that `place` puts there.
std::string two_squares(const std::string& place, const std::string& sides = "bodies = [\"a\", \"b\"]") {
    const auto block = [](const std::string& name, const std::string& counts) {
        return "[bodies." + name + "]\nshape = \"structured_box\"\nlower = [0, 0]\nupper = [1, 1]\ncounts = [" + counts +
               "]\nyoung = 1e7\ndensity = 1000\n";
    };
    return "dim = 2\n" + block("a", "4, 4") + block("b", "5, 5") + "velocity = [0, 0.1]\n" + place + "\n[[bonds]]\n" +
           sides + "\n[run]\nsteps = 2\n";
}

struct Glued {
    run::RunResult<2> result;
    std::vector<run::Warning> warnings;  // of missing glue
    std::string summary;
};
Glued glued(const std::string& text) {
    const WrittenScene file(text);
    const input::SceneFile scene_file(file.path());
    const run::Scene<2> scene = scene_file.scene<2>();
    Glued glued{.result = run::simulate<2>(scene, scene_file.options()), .warnings = {}, .summary = {}};
    glued.warnings = run::warnings_before(scene, glued.result);
    std::erase_if(glued.warnings, [](const run::Warning& w) { return w.kind != run::WarningKind::missing_bond; });
    glued.summary = run::summary_json("test", scene, glued.result);
    return glued;
}

}  // namespace

TEST_CASE("of a block turned by 0.05 the faces up to 0.02 above the other one are glued: 0.4 of it, which is warned of",
          "[input][bonds]") {
    // Faces are glued up to a tenth of the smaller one, 0.02 m. Along the sides, of faces of 0.25 and 0.2 m, pieces of overlaps end at 0.2,
    // 0.25, 0.4, 0.5, ...: in the middles of the first three the gap is 0.1, 0.225 and 0.325 times tan 0.05, in that of the next
    // 0.45 tan 0.05 > 0.02.
    const Glued turned = glued(two_squares("place = [0, 1.000001]\nturn = 0.05"));
    REQUIRE(turned.result.bonds.coverage.size() == 1);
    const solid::BondCoverage& bond = turned.result.bonds.coverage.front();
    CHECK(bond.share() == Approx(0.4).epsilon(2e-3));
    CHECK(bond.area == Approx(0.4).epsilon(2e-3));
    CHECK(bond.opposite == Approx(1.0).epsilon(2e-3));
    CHECK(bond.largest_gap > 0.25 * std::tan(0.05));  // the third piece reaches from 0.25 to 0.4
    CHECK(bond.largest_gap < 0.4 * std::tan(0.05));
    REQUIRE(turned.warnings.size() == 1);
    CHECK(turned.warnings.front().value == bond.share());
    CHECK_THAT(turned.warnings.front().text, Catch::Contains("'a' and 'b'") && Catch::Contains("0.99 is needed"));
    CHECK_THAT(turned.summary, Catch::Contains("\"largest_gap\"") && Catch::Contains("\"share_of_smaller_side\""));
    const WrittenScene file(two_squares("place = [0, 1.000001]\nturn = 0.05"));
    const input::CheckedScene checked = input::check_scene(file.path());
    REQUIRE(checked.estimate);
    CHECK(checked.estimate->bonds == run::bonded_text<2>(turned.result.bonds.coverage));
    CHECK(std::ranges::any_of(checked.warnings,
                              [](const std::string& text) { return text.find("the bond of") != std::string::npos; }));
}

TEST_CASE("a block that stands out by 0.4 is glued by all that lies opposite, 0.6 of its side, and nothing is warned of",
          "[input][bonds]") {
    const std::string sides = GENERATE(as<std::string>(), "bodies = [\"a\", \"b\"]", "groups = [\"a.ymax\", \"b.ymin\"]");
    const Glued partly = glued(two_squares("place = [0.4, 1]", sides));
    const solid::BondCoverage& bond = partly.result.bonds.coverage.front();
    CHECK(bond.area == Approx(0.6).epsilon(1e-12));
    CHECK(bond.share() == Approx(1.0).epsilon(1e-12));
    CHECK(bond.share_of_side() == Approx(0.6).epsilon(1e-12));
    CHECK(bond.largest_gap <= 1e-12);
    CHECK(partly.warnings.empty());
}

TEST_CASE("a gap of 0.01 m that is glued over is told", "[input][bonds]") {
    const Glued apart = glued(two_squares("place = [0, 1.01]"));
    const solid::BondCoverage& bond = apart.result.bonds.coverage.front();
    CHECK(bond.share() == Approx(1.0).epsilon(1e-12));
    CHECK(bond.share_of_side() == Approx(1.0).epsilon(1e-12));
    CHECK(bond.largest_gap == Approx(0.01).epsilon(1e-9));
    CHECK_THAT(run::bonded_text<2>(apart.result.bonds.coverage), Catch::Contains("largest gap 0.01 m"));
    CHECK(apart.warnings.empty());
}

TEST_CASE("parts of one piece are bonded by all that they have in common", "[input][bonds]") {
    const auto result = glued(
                            "dim = 2\n[bodies.wheel]\nshape = \"fan_disc\"\nradius = 1\nsectors = 12\nyoung = 1e7\ndensity "
                            "= 1000\n[bodies.wheel.left]\n"
                            "region = \"x < 0\"\n[run]\nsteps = 1\n")
                            .result;
    REQUIRE(result.bonds.coverage.size() == 1);
    CHECK(result.bonds.coverage.front().share() == 1.0);
    CHECK(result.bonds.coverage.front().share_of_side() == 1.0);
}

TEST_CASE("a thin layer that is glued on has no more opposite than the side that is glued", "[input][bonds]") {
    // Its far side looks against the normal of the block's top, too, 0.05 m above it, and is none of the bond's.
    std::string text = two_squares("place = [0, 1]");
    text.replace(text.find("upper = [1, 1]\ncounts = [5, 5]"), std::string("upper = [1, 1]\ncounts = [5, 5]").size(),
                 "upper = [1, 0.05]\ncounts = [5, 2]");
    const solid::BondCoverage bond = glued(text).result.bonds.coverage.front();
    CHECK(bond.opposite == Approx(1.0).epsilon(1e-12));
    CHECK(bond.share() == Approx(1.0).epsilon(1e-12));
}
