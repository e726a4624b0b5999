#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "abut/mesh/io/read_surface.hpp"
#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

Outcome part(const std::string& name) {
    return run_well("study kinematics", "--quick --frames 3 --only " + name, "kinematics_" + name);
}

/// A target that is known to be missed (docs/kinematics.md), and what holds instead.
struct KnownMiss {
    std::string row;  ///< how its name begins
    std::string quantity;
    double holds;
};

/// Checks all other targets; their number.
int check_targets_except(const Outcome& outcome, const std::vector<KnownMiss>& known) {
    int n = 0;
    const auto summary = read_summary(outcome);
    for (const auto& level : summary["levels"])
        for (const auto& quantity : level["quantities"]) {
            if (!quantity.contains("met")) continue;
            const auto row = level["name"].get<std::string>();
            const auto is_known = [&](const KnownMiss& miss) {
                return row.starts_with(miss.row) && quantity["name"] == miss.quantity;
            };
            CAPTURE(row, quantity.dump());
            if (const auto miss = std::ranges::find_if(known, is_known); miss != known.end()) {
                CHECK(quantity["error"].get<double>() <= miss->holds);
            } else {
                CHECK(quantity["met"].get<bool>());
                ++n;
            }
        }
    return n;
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
    for (const char* file :
         {"energy.csv", "summary.json", "bodies.pvd", "frames/bodies_000002.vtu", "frames/bodies_surface_000002.vtp"})
        CHECK(std::filesystem::exists(outcome.directory / "square_floating" / file));
}

TEST_CASE("rigid tops meet their closed forms", "[programs][kinematics]") { CHECK(check_targets(part("tops")) >= 20); }

TEST_CASE("a square that spins meets a wall when geometry says, and a bar that is struck keeps its length",
          "[programs][kinematics]") {
    CHECK(check_targets_except(part("wall,bar"), {{"bar, small", "H~ drift", 1e-11}}) >= 35);
}

TEST_CASE("what tumbles, slides and bounces keeps pseudo-energy and loses no contact", "[programs][kinematics]") {
    const auto outcome = part("tumble,chute,ball");
    const std::vector<KnownMiss> slides{{"disc on a chute, 30 degrees", "spin times radius over speed", 1e-5}};
    CHECK(check_targets_except(outcome, slides) >= 80);
    const auto summary = read_summary(outcome);
    for (const auto& row : summary["levels"]) {
        INFO(row["name"]);
        CHECK(row["run"]["pair_steps"] > 0);
    }
    const auto shown =
        abut::mesh::read_surface(outcome.directory / "tumbling_cuboid_rigid" / "frames/bodies_surface_000001.vtp");
    REQUIRE(shown.displacement.size() == shown.vertices.size());
    double longest = 0.0, change = 0.0;
    for (std::size_t i = 1; i < shown.vertices.size(); ++i) {
        const abut::Vector<3> rest = shown.vertices[i] - shown.vertices[0],
                              moved = shown.displacement[i] - shown.displacement[0];
        longest = std::max(longest, moved.norm());
        change = std::max(change, std::abs((rest + moved).norm() - rest.norm()));
    }
    CHECK(longest > 0.1);  // it has turned
    CHECK(change < 1e-12);
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

TEST_CASE("gears turn and load each other as their teeth are counted", "[programs][kinematics]") {
    const auto outcome = part("gears");
    CHECK(check_targets(outcome) >= 20);
    const auto summary = read_summary(outcome);
    for (const auto& row : summary["levels"]) CHECK(row["run"]["pair_steps"] > 1000);
    CHECK(std::filesystem::exists(outcome.directory / "gears_floating" / "bodies.pvd"));
}

TEST_CASE("a rotor that hits plates on springs balances work and impulses", "[programs][kinematics]") {
    const auto outcome = part("rotor");
    CHECK(check_targets(outcome) >= 48);
    const auto summary = read_summary(outcome);
    for (const auto& row : summary["levels"]) {
        INFO(row["name"]);
        CHECK(row["run"]["pair_steps"] > 500);
        CHECK(value_of(summary, row["name"], "half periods seen") >= 4.0);
    }
}

TEST_CASE("of five rigid spheres the last one takes the velocity, and where they touch they share it as springs do",
          "[programs][kinematics]") {
    const auto outcome = part("spheres");
    CHECK(check_targets(outcome) >= 30);
    const auto summary = read_summary(outcome);
    const std::string last = "velocity of sphere 5, over that of the first before";
    CHECK(value_of(summary, "spheres, rigid, one after the other", last) == Approx(1.0).margin(1e-6));
    CHECK(value_of(summary, "spheres, rigid, nearly touching", last) < 0.97);
}
