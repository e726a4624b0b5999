#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;
using Rows = std::vector<nlohmann::json>;

Rows sweep(const std::string& family, const std::string& more = "") {
    const auto outcome = run_well("study extremes", "--quick --only " + family + " " + more, "extremes_" + family);
    CHECK(std::filesystem::exists(outcome.directory / "extremes.csv"));
    return read_summary(outcome)["rows"].get<Rows>();
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string message(const nlohmann::json& row) { return row["message"].get<std::string>(); }

/// The laws that hold whatever the numbers of a scene are.
void check_held(const nlohmann::json& row) {
    INFO(row.dump());
    CHECK(row["outcome"] == "held");
    CHECK(row["finite"] == true);
    CHECK(row["pseudo_energy_drift"].get<double>() <= 1e-10);
    if (!row["momentum_drift"].is_null()) CHECK(row["momentum_drift"].get<double>() <= 1e-10);
    CHECK(row["energy_excess_max"].get<double>() <= 1.0);
    CHECK(row["missed_contacts"] == 0);
    CHECK(row["active_pairs_max"] > 0);
}

}  // namespace

TEST_CASE("a change of units leaves every number without a unit as it is", "[programs][extremes]") {
    for (const auto& row : sweep("units")) {
        check_held(row);
        if (row["deviation"].is_null()) {
            CHECK(contains(row["value"], "SI"));
            continue;
        }
        const bool power_of_two = contains(row["value"], "2^");
        CHECK(row["deviation"].get<double>() <= (power_of_two ? 0.0 : 1e-9));
    }
}

TEST_CASE("a scene behaves far from the origin as at it, except for the rounding of its coordinates",
          "[programs][extremes]") {
    for (const auto& row : sweep("offset")) check_held(row);
}

TEST_CASE("bodies of very different stiffness, density and cells keep energy and momentum", "[programs][extremes]") {
    for (const auto& row : sweep("stiffness,density,refinement,edge,crowd")) check_held(row);
}

TEST_CASE("a corner is not pushed along a flat side, and momentum along rollers is kept, with the filter, too",
          "[programs][extremes]") {
    for (const auto& row : sweep("corner,rollers")) check_held(row);
}

TEST_CASE("the ledger sees how far a bar has turned that spins freely, and it grows by 1/cos of that",
          "[programs][extremes]") {
    for (const auto& row : sweep("spin")) {
        INFO(row.dump());
        CHECK(row["outcome"] == "held");
        CHECK(contains(message(row), "it has grown by"));
    }
}

TEST_CASE("bodies that turn fast, and of very different size and mass, keep energy, momentum and J~",
          "[programs][extremes]") {
    for (const auto& row : sweep("rim,sizes,masses")) {
        if (row["value"] == "floating, rim at 10 c") {
            CHECK(row["outcome"] == "refused");
            CHECK(contains(message(row), "2 is allowed (compression_limit)"));
            continue;
        }
        check_held(row);
        if (row["family"] == "rim") CHECK(row["numbers"]["J~ drift"].get<double>() <= 1e-10);
        if (row["family"] != "rim") CHECK(row["numbers"]["speed of parting"].get<double>() > 0.5);
    }
}

TEST_CASE("blocks that spin freely in frames of their own are not strained by their turns", "[programs][extremes]") {
    const auto rows = sweep("turns");
    CHECK(rows.size() == 8);
    for (const auto& row : rows) {
        INFO(row.dump());
        CHECK(row["outcome"] == "held");
        CHECK(row["numbers"]["largest |G|"].get<double>() <= 0.02);
        CHECK(row["numbers"]["J~ drift"].get<double>() <= 1e-10);
    }
}

TEST_CASE("time steps up to the stable one keep energy and momentum", "[programs][extremes]") {
    for (const auto& row : sweep("cfl")) check_held(row);
}

TEST_CASE("an incompressible body is refused, and an almost incompressible one is not", "[programs][extremes]") {
    const auto rows = sweep("poisson");
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) check_held(rows[i]);
    CHECK(rows.back()["outcome"] == "refused");
    CHECK(contains(message(rows.back()), "below 0.5"));
}

TEST_CASE("an impact is refused by the compression that it makes, with the limit and a remedy", "[programs][extremes]") {
    const auto rows = sweep("speed");
    check_held(rows.front());
    CHECK(rows.back()["outcome"] == "refused");
    for (const char* part : {"times the depth of their cells", "2 is allowed (compression_limit)", "Refine the mesh"})
        CHECK(contains(message(rows.back()), part));
}

TEST_CASE("a plate of one cell is refused where no simplex of centroids spans it, and two cells do",
          "[programs][extremes]") {
    for (const auto& row : sweep("thickness")) {
        const std::string value = row["value"];
        const bool is_flat = value == "2D quadrangle 1" || value == "3D hexahedron 1";
        if (!is_flat) {
            check_held(row);
            continue;
        }
        CHECK(row["outcome"] == "refused");
        CHECK(contains(message(row), "put at least two cells across it"));
    }
}

TEST_CASE("a tip of 23 degrees and less is not seen by default, and it is counted", "[programs][extremes]") {
    for (const auto& row : sweep("wedge")) {
        const std::string value = row["value"];
        const bool is_sharp = value.starts_with("20 ") || value.starts_with("5 ");
        const bool by_default = contains(value, ", -0.2");
        CAPTURE(value);
        CHECK((row["blind_corners"] > 0) == (is_sharp && by_default));
        if (!is_sharp) check_held(row);
        if (is_sharp && by_default) CHECK(contains(message(row), "too sharp for contact to see"));
    }
}

TEST_CASE("beams whose edges cross rebound from each other, from edges of 60 degrees on", "[programs][extremes]") {
    for (const auto& row : sweep("crossing")) {
        check_held(row);
        CHECK(row["numbers"]["speed of body 0 along z"].get<double>() < -0.5);  // it came with 1
        CHECK(row["numbers"]["speed of body 1 along z"].get<double>() > 0.5);
    }
}

TEST_CASE("bodies that bounce or lie for a long time keep their energy", "[programs][extremes]") {
    for (const auto& row : sweep("long,rest")) check_held(row);
}

TEST_CASE("cells that are flat along the contact keep energy and momentum at any aspect", "[programs][extremes]") {
    for (const auto& row : sweep("aspect"))
        if (!contains(row["value"], "10000 along the normal")) check_held(row);
}
