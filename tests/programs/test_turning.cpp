#include <catch2/catch.hpp>

#include <filesystem>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

Outcome part(const std::string& name) {
    return run_well("study turning", "--quick --frames 3 --steps 5000 --only " + name, "turning_" + name);
}

}  // namespace

TEST_CASE("bodies that slip and turn keep pseudo-energy and momenta, and lose no contact", "[programs][turning]") {
    const auto outcome = part("slipping,turning");
    CHECK(check_targets(outcome) >= 60);
    CHECK(std::filesystem::exists(outcome.directory / "turning.csv"));
    int touched = 0;
    const auto summary = read_summary(outcome);
    for (const auto& row : summary["levels"]) {
        const auto& run = row["run"];
        INFO(row["name"]);
        CHECK(run["complete"] == true);
        if (run["pair_steps"] > 0) ++touched;
    }
    CHECK(touched == 14);
    const auto folder = outcome.directory / "spinning_discs_memm";
    for (const char* file : {"energy.csv", "bodies.pvd", "frames/bodies_000002.vtu", "frames/bodies_surface_000002.vtp"})
        CHECK(std::filesystem::exists(folder / file));
}

TEST_CASE("stress is uniform across faces of nodes that do not match, and the pressure of round bodies is Hertz's",
          "[programs][turning]") {
    CHECK(check_targets(part("patch,hertz")) >= 10);
}

TEST_CASE("corners and edges rebound, and the advised step holds", "[programs][turning]") {
    CHECK(check_targets(part("edges,steps")) >= 10);
}

TEST_CASE("filter and restart leave pseudo-energy, momentum and angular momentum of bodies that turn",
          "[programs][turning]") {
    const auto outcome =
        run_well("study turning", "--quick --frames 0 --only turning --filter --restart 50", "turning_with_remedies");
    CHECK(check_targets(outcome) >= 29);
    int asked = 0;
    const auto summary = read_summary(outcome);
    for (const auto& row : summary["levels"])
        for (const auto& quantity : row["quantities"])
            if (quantity["name"] == "J~ drift") ++asked;
    CHECK(asked == 2);  // of the free ones: discs and cubes
}

TEST_CASE("a long run between walls keeps pseudo-energy", "[programs][turning]") { CHECK(check_targets(part("long")) >= 2); }
