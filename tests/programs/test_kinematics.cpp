#include <catch2/catch.hpp>
#include <filesystem>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

Outcome part(const std::string& name) {
    return run_well("kinematics", "--quick --frames 3 --only " + name, "kinematics_" + name);
}

/// What the row of this name says of a quantity.
double value_of(const nlohmann::json& summary, const std::string& row, const std::string& quantity) {
    for (const auto& level : summary["levels"])
        for (const auto& one : level["quantities"])
            if (level["name"] == row && one["name"] == quantity) return one["value"].get<double>();
    throw std::runtime_error("no '" + quantity + "' of '" + row + "'");
}

}  // namespace

TEST_CASE("blocks that spin freely in floating frames keep their size, and small ones fly apart", "[programs][kinematics]") {
    const auto outcome = part("free");
    CHECK(check_targets(outcome) >= 40);
    CHECK(std::filesystem::exists(outcome.directory / "kinematics.csv"));
    const std::string stretch = "largest change of a distance, over that at rest";
    const auto summary = read_summary(outcome);
    CHECK(value_of(summary, "square, small", stretch) > 10.0);
    CHECK(value_of(summary, "square, floating", stretch) < 0.02);
    for (const char* file : {"energy.csv", "summary.json", "bodies.pvd", "bodies_000002.vtu", "bodies_surface_000002.vtp"})
        CHECK(std::filesystem::exists(outcome.directory / "square_floating" / file));
}

TEST_CASE("rigid tops meet their closed forms", "[programs][kinematics]") { CHECK(check_targets(part("tops")) >= 20); }

TEST_CASE("a square that spins meets a wall when geometry says, and a bar that is struck keeps its length",
          "[programs][kinematics]") {
    CHECK(check_targets(part("wall,bar")) >= 35);
}

TEST_CASE("what tumbles, slides and bounces keeps pseudo-energy and loses no contact", "[programs][kinematics]") {
    const auto outcome = part("tumble,chute,ball");
    CHECK(check_targets(outcome) >= 80);
    for (const auto& row : read_summary(outcome)["levels"]) {
        INFO(row["name"]);
        CHECK(row["run"]["pair_steps"] > 0);
    }
}

TEST_CASE("in a cradle of rigid discs the last one takes the velocity", "[programs][kinematics]") {
    const auto outcome = part("cradle");
    CHECK(check_targets(outcome) >= 25);
    CHECK(value_of(read_summary(outcome), "cradle, rigid, one after the other",
                   "velocity of disc 5, over that of the first before") == Approx(1.0).margin(1e-6));
}

TEST_CASE("a pile of rigid and elastic polygons keeps pseudo-energy, restarted or not", "[programs][kinematics]") {
    const auto outcome = part("pile");
    CHECK(check_targets(outcome) >= 14);
    CHECK(read_summary(outcome)["levels"][0]["run"]["pair_steps"] > 0);
}
