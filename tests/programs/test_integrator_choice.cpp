#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

Outcome run_scheme(const std::string& integrator, const std::string& more = "") {
    return run_well("slipping_cylinders", "--size 0.25 --frames 0 --integrator " + integrator + " " + more, integrator);
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
        CHECK(summary["restitution"].get<double>() == Approx(reference["restitution"].get<double>()).margin(0.01));
        for (int i = 0; i < 2; ++i)
            CHECK(summary["bodies"][0]["velocity_final"][i].get<double>() ==
                  Approx(reference["bodies"][0]["velocity_final"][i].get<double>()).margin(0.02 * 0.05));
    }
}

TEST_CASE("the restitution is that of the velocities along the line of centres", "[programs]") {
    const auto summary = read_summary(run_scheme("memm", "--offset 0.5 --gap 0.1"));
    const double y = 0.5 / 2.1, x = std::sqrt(1.0 - y * y);
    const auto closing = [&](const char* when) {
        const auto& a = summary["bodies"][0][when];
        const auto& b = summary["bodies"][1][when];
        return x * (b[0].get<double>() - a[0].get<double>()) + y * (b[1].get<double>() - a[1].get<double>());
    };
    CHECK(summary["restitution"].get<double>() ==
          Approx(-closing("velocity_final") / closing("velocity_initial")).epsilon(1e-12));
}

TEST_CASE("on a mesh refined where the bodies touch, local steps keep the energy with fewer forces of cells", "[programs]") {
    const std::string refined = "--size 0.08 --refine 10 --time 2 --frames 0 --integrator ";
    const auto uniform = run_well("slipping_cylinders", refined + "memm", "uniform");
    const auto local = run_well("slipping_cylinders", refined + "memm_async", "local");
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
    const std::string refined = "--refine 6 --time 2 --contact-levels 1 ";
    const auto reference = run_scheme("memm_async", refined + "--threads 1");
    const std::string other = GENERATE("--threads 2", "--threads 4", "--broad-phase fcl");
    CAPTURE(other);
    const auto outcome = run_scheme("memm_async", refined + other);
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
    const auto outcome = run_scheme(integrator, "--precision single");
    const auto summary = read_summary(outcome);
    CHECK(of_double["options"]["precision"] == "double");
    CHECK(summary["options"]["precision"] == "single");
    CHECK(summary["missed_contacts"] == 0);
    CHECK(summary["active_pairs_max"] > 0);
    CHECK(summary["restitution"].get<double>() == Approx(of_double["restitution"].get<double>()).margin(1e-4));
    CHECK(summary["restitution"] != of_double["restitution"]);
    CHECK(summary["momentum_drift_max"].get<double>() < 1e-5);  // docs/trade.md, Single precision
    if (integrator == "memm") CHECK(relative_drift(outcome) < 1e-5);
}

TEST_CASE("a run in single precision has the same bits for any number of threads", "[programs]") {
    const auto energies = [](const char* threads) {
        return read_text(run_scheme("memm", std::string("--dim 3 --precision single --threads ") + threads).directory /
                         "energy.csv");
    };
    CHECK(energies("1") == energies("2"));
}
