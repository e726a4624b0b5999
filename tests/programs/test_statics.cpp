#include <catch2/catch.hpp>
#include <filesystem>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

double error_of(const Outcome& outcome, std::size_t level, const std::string& name) {
    return study_quantity(outcome, level, name).error;
}

}  // namespace

TEST_CASE("two blocks pass the contact patch test to 1e-10 where the method is exact, in 2D and 3D", "[programs]") {
    for (const char* dim : {"2", "3"}) {
        const auto outcome =
            run_well("study contact_patch", std::string("--mesh matching --dim ") + dim, std::string("patch_") + dim);
        CHECK(check_targets(outcome) == 3 * 3);
    }
}

TEST_CASE("the curve of the contact patch test has a row a choice: the errors of the stress on all kinds of sides",
          "[programs]") {
    const auto outcome = run_well("study contact_patch", "--mesh matching", "patch_curve");
    const auto table = read_table(outcome, "stress.csv");
    REQUIRE(table.rows.size() == 2 * 3);  // weights, Neumann choices
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        CHECK(table.column("choice")[row] == static_cast<double>(row));
        for (std::size_t sides = 0; sides < 6; ++sides)
            CHECK(table.rows[row][1 + sides] == study_quantity(outcome, 6 * row + sides, "stress, largest error").value);
    }
    CHECK(std::filesystem::exists(outcome.directory / "stress.gp"));
}

TEST_CASE("what a block with an edge in the contact loses grows with the load, not with its mesh", "[programs]") {
    const auto light = run_well("study contact_patch", "--mesh non-matching --strain 1e-8", "patch_light");
    const auto heavy = run_well("study contact_patch", "--mesh non-matching --strain 1e-6", "patch_heavy");
    const double ratio = error_of(heavy, 0, "stress, largest error") / error_of(light, 0, "stress, largest error");
    CHECK(read_summary(heavy)["levels"][0]["name"].get<std::string>().starts_with("non-matching, stiffness, local_equil"));
    CHECK(ratio == Approx(100.0).epsilon(0.1));
}

TEST_CASE("a cylinder on a block, on its equal and on a rigid plane meets Hertz at 5 faces in the contact", "[programs]") {
    for (const std::string support : {"block", "equal", "rigid_plane"}) {
        CAPTURE(support);
        const auto outcome = run_well("study hertz", "--faces 5 --support " + support, "hertz_" + support);
        CHECK(check_targets(outcome) == 3);
        const auto profile = read_table(outcome, "pressure_5.csv");
        CHECK(profile.rows.size() >= 12);
        CHECK(std::filesystem::exists(outcome.directory / "pressure.gp"));
    }
}

TEST_CASE("a cylinder meets Hertz at 10 faces in the contact, closer than at 5", "[programs]") {
    const auto outcome = run_well("study hertz", "--faces 5,10 --support rigid_plane", "hertz_ten");
    CHECK(check_targets(outcome) == 6);
    CHECK(error_of(outcome, 1, "pressure, error in L2") < error_of(outcome, 0, "pressure, error in L2"));
}

TEST_CASE("the weights of halves give a worse traction than those by stiffness where cells differ in size", "[programs]") {
    const auto halves = run_well("study hertz", "--faces 5 --ratio 0.4 --weighting half", "hertz_half");
    const auto stiffness = run_well("study hertz", "--faces 5 --ratio 0.4 --weighting stiffness", "hertz_stiffness");
    const std::string traction = "traction of the cells, error in L2";
    CHECK(error_of(stiffness, 0, traction) < 0.5 * error_of(halves, 0, traction));
}

TEST_CASE("hertz refuses levels without a face in the contact", "[programs]") {
    const auto outcome = run_program("study hertz", "--faces 0.5", "hertz_none");
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.error.find("--faces: 0.5 faces in the contact radius, 1 to 1000 are allowed") != std::string::npos);
}
