#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "apps/support/preset.hpp"
#include "programs/program.hpp"
#include "studies/trade/ladder.hpp"

namespace {

using namespace abut;
using namespace abut::studies;
using namespace abut::test::programs;
using Rows = std::vector<nlohmann::json>;

/// The bar of 50 cells over the ladder, once for all cases.
const Outcome& climb_of_bar() {
    static const Outcome outcome = run_well(
        "trade", "--only bar --levels 1 --settings products --also \"--cfl 0.5\" --also \"--skin 1e9\"", "trade_bar");
    return outcome;
}

Rows rows_of(const Outcome& outcome) { return read_summary(outcome)["rows"].get<Rows>(); }

const nlohmann::json& row_of(const Rows& rows, const std::string& setting) {
    const auto row = std::ranges::find_if(rows, [&](const auto& one) { return one["setting"] == setting; });
    REQUIRE(row != rows.end());
    return *row;
}

nlohmann::json options_used(const std::string& arguments) {
    const std::string small = "--size 0.3 --steps 1 --frames 0 ";
    return read_summary(run_well("slipping_cylinders", small + arguments, "preset"))["options"];
}

}  // namespace

TEST_CASE("a ladder holds each setting once, the defaults first", "[programs][trade]") {
    for (const trade::Extent extent : {trade::Extent::each, trade::Extent::products})
        for (const bool at_rest : {false, true}) {
            const auto settings = trade::ladder(extent, at_rest);
            CHECK(settings.front().empty());
            CHECK(std::set(settings.begin(), settings.end()).size() == settings.size());
            for (const auto& setting : settings) {
                INFO(setting);
                run::RunOptions run;
                CHECK_NOTHROW(apps::apply_words(setting, run));
                if (at_rest) CHECK(setting.find("--cfl") == std::string::npos);
            }
        }
}

TEST_CASE("every choice of the ladder is in the table, and one that a program would refuse is in it with the reason",
          "[programs][trade]") {
    const Rows rows = rows_of(climb_of_bar());
    const auto settings = trade::ladder(trade::Extent::products, false);
    CHECK(rows.size() == settings.size() + 2);
    for (const auto& setting : settings) CHECK(row_of(rows, setting).contains("errors"));
    CHECK(row_of(rows, "--cfl 0.5").contains("errors"));
    for (const char* file : {"trade.csv", "pareto.gp"}) CHECK(std::filesystem::exists(climb_of_bar().directory / file));
    const auto refused = rows_of(
        run_well("trade", "--only bar --levels 1 --also \"--filter neutral --integrator leapfrog\"", "trade_refused"));
    const std::string message = row_of(refused, "--filter neutral --integrator leapfrog")["message"];
    CHECK(message.find("the filter is made for memm") != std::string::npos);
}

TEST_CASE("pseudo-energy is exact where overlap moves and events are cut, and only there", "[programs][trade]") {
    for (const auto& row : rows_of(climb_of_bar())) {
        const std::string setting = row["setting"];
        INFO(setting);
        const auto has = [&](const char* words) { return setting.find(words) != std::string::npos; };
        if (has("--integrator leapfrog")) continue;  // its own energy is H
        const double drift = row["errors"]["drift"];
        // A bar on a large wall: overlap never changes, so that a single point integrates exactly and frozen is moving.
        if (has("--events off") && !has("--integrator bilbao"))
            CHECK(drift > 1e-8);
        else
            CHECK(drift < 1e-11);
        CHECK(row["energy_excess_max"].get<double>() < 0.1);
    }
}

TEST_CASE("on a front are the runs that no other one beats in time and error", "[programs][trade]") {
    const Rows rows = rows_of(climb_of_bar());
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
        const auto outcome = run_program("trade", std::string("--only bar --also \"") + words + "\"", "trade_bad");
        INFO(outcome.error);
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.error.find(std::string("'") + words + "'") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(outcome.directory / "trade.csv"));
    }
}

TEST_CASE("a run that takes longer than its limit is stopped and says so", "[programs][trade]") {
    for (const auto& row : rows_of(run_well("trade", "--only bar --levels 1 --limit 1e-9", "trade_limit")))
        CHECK(row["message"].get<std::string>().find("--limit of 1e-09 s per run is over") != std::string::npos);
}

TEST_CASE("a preset is the options that it names, and options beside it win wherever they stand", "[programs][trade]") {
    auto without_folder = [](nlohmann::json options) {
        options.erase("out");
        return options;
    };
    CHECK(without_folder(options_used("--preset balanced")) == without_folder(options_used("")));
    const auto fast = options_used("--preset fast");
    CHECK(fast != options_used(""));
    const auto after = options_used("--preset fast --cfl 0.4 --events on"),
               before = options_used("--cfl 0.4 --events on --preset fast");
    CHECK(without_folder(after) == without_folder(before));
    CHECK(after["cfl"] == 0.4);
    CHECK(after["events"] == "on");
    CHECK(options_used("--preset exact")["filter"] == "neutral");
}
