#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "abut/input/grammar.hpp"
#include "abut/input/materials.hpp"
#include "abut/run/option_table.hpp"
#include "abut/run/user_words.hpp"
#include "abut/solid/combinations/combinations.hpp"
#include "abut/solid/kinematics/properties.hpp"

TEST_CASE("the document shows the grammar that scenes are read by", "[input][grammar]") {
    std::ifstream file(ABUT_SOURCE "/docs/scenes.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK(text.find(abut::input::grammar()) != std::string::npos);
}

TEST_CASE("the document shows the materials that scenes know by name", "[input][grammar][materials]") {
    std::ifstream file(ABUT_SOURCE "/docs/scenes.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK(text.find(abut::input::table_of_materials()) != std::string::npos);
}

TEST_CASE("the document shows what each kinematics is", "[input][grammar][kinematics]") {
    using Of = abut::solid::KinematicsProperties;
    const auto flag = [](bool Of::*member) { return [=](const Of& of) { return std::string(of.*member ? "yes" : ""); }; };
    const std::vector<std::pair<std::string, std::function<std::string(const Of&)>>> rows{
        {"deforms", flag(&Of::deforms)},
        {"turns by any angle", flag(&Of::turns)},
        {"has a frame of its own, in which strains are linear", flag(&Of::has_frame)},
        {"has finite strains, whose forces are not linear", flag(&Of::finite_strains)},
        {"more layers of neighbours that a part of it needs", [](const Of& of) { return std::to_string(of.more_layers); }},
        {"part of 2/omega_max that is stable without contact",
         [](const Of& of) { return fmt::format("{:.3g}", of.step_margin); }}};
    std::string table = "| |";
    for (const Of& of : abut::solid::kinematics_properties) table += " `" + std::string(of.name) + "` |";
    table += "\n|---|---|---|---|---|\n";
    for (const auto& [name, value] : rows) {
        table += "| " + name + " |";
        for (const Of& of : abut::solid::kinematics_properties) table += value(of).empty() ? " |" : " " + value(of) + " |";
        table += "\n";
    }
    std::ifstream file(ABUT_SOURCE "/docs/kinematics.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CAPTURE(table);
    CHECK(text.find(table) != std::string::npos);
}

TEST_CASE("docs/limits.md has the table of features that do not go together", "[input][grammar]") {
    std::ifstream file(ABUT_SOURCE "/docs/limits.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string table = abut::run::with_keys(abut::run::in_user_words(abut::solid::combinations_table()));
    CAPTURE(table);
    CHECK(text.find(table) != std::string::npos);
}

TEST_CASE("every option that scenes have is a key of its table, and messages call it so", "[input][grammar]") {
    const std::string grammar = abut::input::grammar();
    for (const auto& option : abut::run::run_options()) {
        if (!option.places.scene) continue;
        const std::string& table = option.table;
        const std::string on_command_line =
            option.depth == abut::OptionDepth::laboratory ? "--lab " + option.scene_key() : option.flag();
        CAPTURE(table, option.name);
        const auto begin = grammar.find("### [" + table + "]\n");
        REQUIRE(begin != std::string::npos);
        const auto found = grammar.find("| `" + option.scene_key() + "` |", begin);
        CHECK(found < grammar.find("### [", begin + 1));
        if (option.kind != abut::OptionKind::path)
            CHECK(abut::run::with_keys(option.flag()) == table + "." + option.scene_key() + " (" + on_command_line + ")");
    }
}
