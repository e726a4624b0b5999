#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

Outcome run_scheme(const std::string& integrator, const std::string& more = "") {
    return run_well("abut", slip("--set values.size=0.25 --frames 0 --integrator " + integrator + " " + more), integrator);
}

/// Cells that are so many times smaller where the discs meet.
std::string refined(int times) {
    std::string options;
    for (const auto& [body, sign] : {std::pair("left", ""), std::pair("right", "-")})
        options += fmt::format(
            "--set 'bodies.{0}.refinement={{point=[\"{1}radius*apart_x/apart\",\"{1}radius*offset/apart\"],"
            "size=\"size/{2}\",distance=\"radius/2\"}}' ",
            body, sign, times);
    return options;
}

/// Of the velocities along the line of the centres where the discs first touch, offset by 0.8 over 2.02.
double restitution(const nlohmann::json& summary) {
    const double y = 0.8 / 2.02, x = std::sqrt(1.0 - y * y);
    const auto closing = [&](const char* when) {
        const auto &left = summary["bodies"][0][when], &right = summary["bodies"][1][when];
        return x * (right[0].get<double>() - left[0].get<double>()) + y * (right[1].get<double>() - left[1].get<double>());
    };
    return -closing("velocity_final") / closing("velocity_initial");
}

double energy_error(const nlohmann::json& summary) {
    return summary["energy_drift"].get<double>() / summary["kinetic_initial"].get<double>();
}

}  // namespace

TEST_CASE("each scheme of --integrator keeps the energy that it promises to keep, and momentum", "[programs]") {
    const std::string integrator = GENERATE("memm", "memm_async", "leapfrog", "bilbao");
    const auto outcome = run_scheme(integrator);
    const auto summary = read_summary(outcome);
    if (integrator == "leapfrog") {
        CHECK(relative_drift(outcome) > 1e-6);
        CHECK(summary["parasitic_max"].get<double>() < 1e-14);
    } else {
        CHECK(relative_drift(outcome) <= 1e-11);
    }
    CHECK(energy_error(summary) < 0.05);
    CHECK(summary["momentum_drift_max"].get<double>() < 1e-12);
    CHECK(summary["missed_contacts"] == 0);
    CHECK(summary["active_pairs_max"] > 0);
    CHECK(summary["options"]["integrator"] == integrator);
}

TEST_CASE("all schemes agree on how the bodies part", "[programs]") {
    const auto reference = read_summary(run_scheme("memm", "--cfl 0.1"));
    for (const std::string integrator : {"memm", "memm_async", "leapfrog", "bilbao"}) {
        CAPTURE(integrator);
        const auto summary = read_summary(run_scheme(integrator));
        CHECK(restitution(summary) == Approx(restitution(reference)).margin(0.01));
        for (int i = 0; i < 2; ++i)
            CHECK(summary["bodies"][0]["velocity_final"][i].get<double>() ==
                  Approx(reference["bodies"][0]["velocity_final"][i].get<double>()).margin(0.02 * 0.05));
    }
}

TEST_CASE("on a mesh refined where the bodies touch, local steps keep the energy with fewer forces of cells", "[programs]") {
    const std::string options = refined(10) + "--set values.size=0.08 --time 2 --frames 0 --integrator ";
    const auto uniform = run_well("abut", slip(options + "memm"), "uniform");
    const auto local = run_well("abut", slip(options + "memm_async"), "local");
    const auto all = read_summary(uniform), few = read_summary(local);
    CHECK(few["level_cells"].size() >= 3);
    CHECK(all["level_cells"].empty());
    CHECK(few["finest_dt"].get<double>() == Approx(all["finest_dt"].get<double>()).epsilon(1e-14));
    CHECK(few["dt"].get<double>() >= 3.99 * few["finest_dt"].get<double>());
    CHECK(few["force_evaluations"].get<double>() < 0.5 * all["force_evaluations"].get<double>());
    CHECK(relative_drift(local) <= 1e-11);
    CHECK(relative_drift(uniform) <= 1e-11);
    CHECK(few["events"] > 0);
}

TEST_CASE("local steps give the same bits for any number of threads and any broad phase", "[programs]") {
    const std::string options = refined(6) + "--time 2 --lab contact_levels=1 ";
    const auto reference = run_scheme("memm_async", options + "--threads 1");
    const std::string other = GENERATE("--threads 2", "--threads 4", "--lab broad_phase=fcl");
    CAPTURE(other);
    const auto outcome = run_scheme("memm_async", options + other);
    CHECK(read_text(reference.directory / "energy.csv") == read_text(outcome.directory / "energy.csv"));
}

TEST_CASE("a body that falls from rest runs under every scheme", "[programs]") {
    const std::string integrator = GENERATE("memm", "memm_async", "leapfrog", "bilbao");
    CAPTURE(integrator);
    const auto outcome =
        run_well("study bouncing_strip",
                 "--cells 20 --filter none --time 2.5 --frames 0 --interval 10 --integrator " + integrator, "strip");
    const auto summary = read_summary(outcome);
    CHECK(summary["impulse_first"].get<double>() == Approx(266.667).epsilon(0.02));
    if (integrator != "leapfrog") CHECK(relative_drift(outcome) <= 1e-11);
}

TEST_CASE("single precision is said in the summary, misses no contact, and parts the bodies as double does", "[programs]") {
    const std::string integrator = GENERATE("memm", "leapfrog");
    const auto of_double = read_summary(run_scheme(integrator));
    const auto outcome = run_scheme(integrator, "--lab precision=single");
    const auto summary = read_summary(outcome);
    CHECK(of_double["options"]["precision"] == "double");
    CHECK(summary["options"]["precision"] == "single");
    CHECK(summary["missed_contacts"] == 0);
    CHECK(summary["active_pairs_max"] > 0);
    CHECK(restitution(summary) == Approx(restitution(of_double)).margin(1e-4));
    CHECK(restitution(summary) != restitution(of_double));
    CHECK(summary["momentum_drift_max"].get<double>() < 1e-5);  // docs/trade.md, Single precision
    if (integrator == "memm") CHECK(relative_drift(outcome) < 1e-5);
}

TEST_CASE("a run in single precision has the same bits for any number of threads", "[programs]") {
    const auto energies = [](const char* threads) {
        const std::string options =
            std::string("--set values.size=0.25 --frames 0 --lab precision=single --threads ") + threads;
        return read_text(run_well("abut", slip_3d(options), "threads").directory / "energy.csv");
    };
    CHECK(energies("1") == energies("2"));
}
