#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "apps/support/preset.hpp"
#include "programs/program.hpp"
#include "studies/trade/ladder.hpp"
#include "studies/trade/round_bodies.hpp"

namespace {

using namespace abut;
using namespace abut::studies;
using namespace abut::test::programs;
using Rows = std::vector<nlohmann::json>;

/// The bar of 50 cells over the ladder, once for all cases.
const Outcome& climb_of_bar() {
    static const Outcome outcome = run_well(
        "study trade", "--only bar --levels 1 --settings products --also \"--cfl 0.5\" --also \"--skin 1e9\"", "trade_bar");
    return outcome;
}

Rows rows_of(const Outcome& outcome) { return read_summary(outcome)["rows"].get<Rows>(); }

Rows finished_rows_of(const Outcome& outcome) {
    Rows rows = rows_of(outcome);
    std::erase_if(rows, [](const nlohmann::json& row) { return row.contains("message"); });
    return rows;
}

bool has(const std::string& setting, const char* words) { return setting.find(words) != std::string::npos; }

const nlohmann::json& row_of(const Rows& rows, const std::string& setting) {
    const auto row = std::ranges::find_if(rows, [&](const auto& one) { return one["setting"] == setting; });
    REQUIRE(row != rows.end());
    return *row;
}

nlohmann::json options_used(const std::string& arguments) {
    const std::string small = "--set values.size=0.3 --steps 1 --frames 0 ";
    return read_summary(run_well("abut", slip(small + arguments), "preset"))["options"];
}

}  // namespace

TEST_CASE("a ladder holds each setting once, the defaults first", "[programs][trade]") {
    using trade::Extent, trade::Motion;
    for (const Extent extent : {Extent::each, Extent::kinematics, Extent::products})
        for (const Motion motion : {Motion::at_rest, Motion::translating, Motion::turning}) {
            const auto settings = trade::ladder(extent, motion);
            CHECK(settings.front().empty());
            CHECK(std::set(settings.begin(), settings.end()).size() == settings.size());
            for (const auto& setting : settings) {
                INFO(setting);
                run::RunOptions run;
                CHECK_NOTHROW(apps::apply_words(setting, run));
                if (motion == Motion::at_rest) CHECK_FALSE((has(setting, "--cfl") || has(setting, "--kinematics")));
            }
            const auto rigid = std::ranges::count(settings, "--kinematics rigid");
            CHECK(rigid == (motion == Motion::at_rest ? 0 : 1));
        }
}

TEST_CASE("every choice of the ladder is in the table, and one that a program would refuse is in it with the reason",
          "[programs][trade]") {
    const Rows rows = rows_of(climb_of_bar());
    const auto settings = trade::ladder(trade::Extent::products, trade::Motion::translating);
    CHECK(rows.size() == settings.size() + 2);
    for (const auto& setting : settings) {
        INFO(setting);
        const auto& row = row_of(rows, setting);
        if (has(setting, "--kinematics"))  // the bar lies on rollers
            CHECK(
                (has(row["message"], "(group 'xmin') is ") && has(row["message"], " and has a prescribed displacement: ")));
        else
            CHECK(row.contains("errors"));
    }
    CHECK(row_of(rows, "")["model"] == "small + reconstruction");
    CHECK(row_of(rows, "--law pair_potential")["model"] == "small + pair potential");
    CHECK(row_of(rows, "--cfl 0.5").contains("errors"));
    for (const char* file : {"trade.csv", "pareto.gp"}) CHECK(std::filesystem::exists(climb_of_bar().directory / file));
    const auto refused = rows_of(
        run_well("study trade", "--only bar --levels 1 --also \"--filter neutral --integrator leapfrog\"", "trade_refused"));
    const std::string message = row_of(refused, "--filter neutral --integrator leapfrog")["message"];
    CHECK(message.find("--filter neutral) is for memm") != std::string::npos);
}

TEST_CASE("pseudo-energy is exact where overlap moves and events are cut, and only there", "[programs][trade]") {
    for (const auto& row : finished_rows_of(climb_of_bar())) {
        const std::string setting = row["setting"];
        INFO(setting);
        if (has(setting, "--integrator leapfrog")) continue;  // its own energy is H
        const double drift = row["errors"]["drift"];
        // A bar on a large wall: overlap never changes, so that a single point integrates exactly and frozen is moving.
        if (has(setting, "--events off") && !has(setting, "--integrator bilbao"))
            CHECK(drift > 1e-8);
        else if (has(setting, "--precision single"))
            CHECK((drift > 1e-11 && drift < 1e-6));  // unit roundoff 6e-8
        else
            CHECK(drift < 1e-11);
        CHECK(row["energy_excess_max"].get<double>() < 0.1);
    }
}

TEST_CASE("on a front are the runs that no other one beats in time and error", "[programs][trade]") {
    const Rows rows = finished_rows_of(climb_of_bar());
    for (const char* measure : {"drift", "energy", "restitution", "pressure"})
        for (const auto& row : rows) {
            const double seconds = row["seconds"], error = row["errors"][measure];
            const bool beaten = std::ranges::any_of(rows, [&](const auto& other) {
                const double other_seconds = other["seconds"], other_error = other["errors"][measure];
                return other_seconds <= seconds && other_error <= error && (other_seconds < seconds || other_error < error);
            });
            const auto fronts = row["on_front"].get<std::set<std::string>>();
            INFO(measure << ": " << row["setting"]);
            CHECK(fronts.contains(measure) == !beaten);
        }
}

TEST_CASE("a setting that no program would take is refused before anything is run, with its words", "[programs][trade]") {
    for (const char* words : {"--no-such-option", "--cfl 2", "--help"}) {
        const auto outcome = run_program("study trade", std::string("--only bar --also \"") + words + "\"", "trade_bad");
        INFO(outcome.error);
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.error.find(std::string("'") + words + "'") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(outcome.directory / "trade.csv"));
    }
}

TEST_CASE("a run that takes longer than its limit is stopped and says so", "[programs][trade]") {
    const Rows rows = rows_of(run_well("study trade", "--only bar --levels 1 --limit 1e-9", "trade_limit"));
    for (const auto& row : rows) {
        INFO(row["setting"]);
        if (has(row["setting"], "--kinematics")) continue;  // refused before its first step
        CHECK(has(row["message"], "--limit of 1e-09 s per run is over"));
    }
}

TEST_CASE("a preset is the options that it names, and options beside it win wherever they stand", "[programs][trade]") {
    auto without_folder = [](nlohmann::json options) {
        options.erase("out");
        return options;
    };
    CHECK(without_folder(options_used("--preset balanced")) == without_folder(options_used("")));
    const auto fast = options_used("--preset fast");
    CHECK(fast != options_used(""));
    const auto after = options_used("--preset fast --cfl 0.4 --lab events=on"),
               before = options_used("--cfl 0.4 --lab events=on --preset fast");
    CHECK(without_folder(after) == without_folder(before));
    CHECK(after["cfl"] == 0.4);
    CHECK(after["events"] == "on");
    CHECK(options_used("--preset exact")["filter"] == "neutral");
}

TEST_CASE("a preset says nothing of kinematics, and goes with each of them", "[programs][trade]") {
    for (const auto& [name, preset] : apps::presets) {
        INFO(name);
        const auto alone = options_used("--preset " + name);
        CHECK(alone["kinematics"] == "scene");
        CHECK(alone["law"] == "reconstruction");
        for (const std::string kinematics : {"floating", "rigid"})
            CHECK(options_used("--law automatic --kinematics " + kinematics + " --preset " + name)["kinematics"] ==
                  kinematics);
    }
}

TEST_CASE(
    "discs that have turned by 1 rad leave as finite strains say where they float, and no energy shows where they do not",
    "[programs][trade]") {
    const trade::Problem problem = trade::turn_problem({10}, 20);
    const trade::Reference reference = problem.reference();
    const auto solve = [&](const std::string& setting) {
        run::RunOptions run = problem.base;
        apps::apply_words(setting, run);
        return problem.solve(run, 10, reference, trade::no_limit);
    };
    // Linear strains in a frame and finite ones differ by terms of the order of the strains: the speed over that of waves.
    const double strain = 0.02;
    CHECK(solve("").velocity < strain);
    CHECK(solve("--kinematics small --law pair_potential").velocity > 10.0 * strain);
    for (const char* setting : {"", "--kinematics small --law pair_potential", "--kinematics rigid"}) {
        const trade::Outcome outcome = solve(setting);
        INFO(setting);
        CHECK(outcome.drift < 1e-13);
        CHECK(outcome.excess < 1e-2);
        CHECK(outcome.parasitic < 1.0);
        CHECK(outcome.momentum < 1e-13);
        CHECK(outcome.missed_contacts == 0);
        if (outcome.pseudo_angular > 1e-13) CHECK(has(setting, "small"));  // as it turns
    }
}

TEST_CASE("discs that do not turn leave small bodies, those that float and finite elements alike", "[programs][trade]") {
    const trade::Problem problem = trade::slip_problem(2, {8}, 16);
    const auto on_nodes = trade::nodal_ladder(problem.motion).front();
    const trade::Reference reference = problem.reference();
    const double strain = 0.05;
    for (const char* setting : {"", "--law pair_potential", "--kinematics floating"}) {
        run::RunOptions run = problem.base;
        apps::apply_words(setting, run);
        INFO(setting);
        CHECK(problem.solve(run, 8, reference, trade::no_limit).velocity < strain);
    }
    CHECK(problem.solve_on_nodes(on_nodes.run, 8, reference, trade::no_limit).velocity < strain);
}
