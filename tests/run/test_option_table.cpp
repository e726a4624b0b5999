#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/option_table.hpp"
#include "abut/run/option_table.hpp"
#include "abut/solid/options/option_words.hpp"
#include "support/dummy_options.hpp"

using namespace abut;

namespace {

using Catch::Contains;

/// Another value than the default that the option allows.
OptionValue another(const OptionFacts& option, const OptionValue& by_default) {
    switch (option.kind) {
        case OptionKind::truth:
            return !std::get<bool>(by_default);
        case OptionKind::count:
            return std::get<std::int64_t>(by_default) == option.most ? option.least : option.most;
        case OptionKind::number: {
            const double above = option.limits.above, below = option.limits.below;
            return std::isfinite(above) && std::isfinite(below) ? 0.75 * above + 0.25 * below
                                                                : (std::isfinite(above) ? above : 0.0) + 7.25;
        }
        case OptionKind::numbers:
            return std::vector{option.limits.above + 1.5, option.limits.above + 2.0};
        case OptionKind::word:
            return text_of(by_default) == option.words.front() ? option.words.back() : option.words.front();
        case OptionKind::path:
            return std::string("somewhere");
    }
    return {};
}

template <class Owner>
void check_members(const OptionList<Owner>& options) {
    std::set<std::string> names;
    for (const Option<Owner>& option : options) {
        CAPTURE(option.name);
        CHECK(names.insert(option.name).second);
        CHECK_FALSE(option.help.empty());
        const Owner plain{};
        const OptionValue value = another(option, option.get(plain));
        REQUIRE(allows(option, value));
        Owner changed{};
        option.set(changed, value);
        CHECK(is_same(option.get(changed), value));
        for (const Option<Owner>& other : options)  // one member each
            if (other.name != option.name) CHECK(is_same(other.get(changed), other.get(plain)));
    }
}

std::vector<std::string> names_in(const run::NamedValues& values) {
    std::vector<std::string> names;
    for (const run::NamedValue& value : values) names.push_back(value.name);
    return names;
}

}  // namespace

TEST_CASE("every option of a table has a name, a help and a member of its own", "[run][options]") {
    check_members(run::run_options());
    check_members(contact::search_options());
    check_members(contact::contact_options());
    check_members(contact::nodal_options());
    check_members(test::soil_options());
}

TEST_CASE("defaults of options are allowed, or stand for a value that is not given and say what is taken",
          "[run][options]") {
    const run::RunOptions plain;
    for (const auto& option : run::run_options()) {
        CAPTURE(option.name);
        const bool is_told = !option.by_default.empty() || option.help.find("by default") != std::string::npos;
        CHECK((allows(option, option.get(plain)) || is_told || option.name == "time"));
    }
}

TEST_CASE("an option names laws and schemes by their words", "[run][options]") {
    for (const auto& option : run::run_options()) {
        CAPTURE(option.name);
        for (const std::string& law : option.laws)
            CHECK(std::ranges::any_of(solid::law_words, [&](const auto& word) { return word.word == law; }));
        for (const std::string& scheme : option.schemes)
            CHECK(std::ranges::any_of(run::integrator_words, [&](const auto& word) { return word.word == scheme; }));
    }
}

TEST_CASE("options of contact and of contact on nodes are the same where both have them", "[run][options]") {
    const contact::ContactOptions of_faces;
    const contact::NodalOptions of_nodes;
    for (const auto& option : contact::nodal_options())
        for (const auto& twin : contact::contact_options())
            if (twin.name == option.name) {
                CAPTURE(option.name);
                CHECK(option.get(of_nodes) == twin.get(of_faces));
                CHECK(allowed_values(option) == allowed_values(twin));
                CHECK(option.help == twin.help);
            }
}

TEST_CASE("a value that a table does not allow is refused with its name, the value, the limits and the default",
          "[run][options]") {
    test::Soil soil;
    const auto refused = [&] { check_options("soil: ", test::soil_options(), soil); };
    CHECK_NOTHROW(refused());
    soil.stiffness = -1.0;
    CHECK_THROWS_WITH(refused(), "soil: soil_stiffness is -1 Pa; above 0 Pa is needed, 2.5 is the default.");
    soil = {.layers = 10};
    CHECK_THROWS_WITH(refused(), "soil: soil_layers is 10; 1 to 9 is needed, 3 is the default.");
    soil = {.grain = static_cast<test::Grain>(5)};
    CHECK_THROWS_WITH(refused(), "soil: grain is 5; 0 (fine) and 1 (coarse) are allowed.");
    soil = {.depths = {0.5, 2.0, 1.0}};
    CHECK_THROWS_WITH(refused(), "soil: depths: number 3 is 1 m, after 2 m. Give them in increasing order, each once.");
    soil = {.depths = {1.0, 1.0}};
    CHECK_THROWS_WITH(refused(), "soil: depths: number 2 is 1 m, after 1 m. Give them in increasing order, each once.");
    soil = {.depths = {-1.0, 1.0}};
    CHECK_THROWS_WITH(refused(), "soil: depths: number 1 is -1 m; above 0 m is needed.");
    soil = {.depths = {1.0, std::numeric_limits<double>::infinity()}};
    CHECK_THROWS_WITH(refused(), "soil: depths: number 2 is inf m; above 0 m is needed.");
}

TEST_CASE("limits of numbers are open or closed as they say, and infinity is allowed where they say so", "[run][options]") {
    const double infinity = std::numeric_limits<double>::infinity();
    const auto allows = [](const Limits& limits, double value) { return limits.allow(value); };
    CHECK_FALSE(allows({.above = 0.0}, 0.0));
    CHECK(allows({.above = 0.0, .zero = true}, 0.0));
    CHECK(allows({.above = -1.0, .below = 0.0, .from = true}, -1.0));
    CHECK_FALSE(allows({.above = -1.0, .below = 0.0, .from = true}, 0.0));
    CHECK(allows({.above = -1.0, .below = 0.0, .closed = true}, 0.0));
    CHECK_FALSE(allows({.above = 0.0}, infinity));
    CHECK(allows({.above = 0.0, .endless = true}, infinity));
    CHECK_FALSE(allows({.above = 0.0, .endless = true}, -infinity));
    CHECK_FALSE(allows({.endless = true}, std::numeric_limits<double>::quiet_NaN()));
    CHECK(text_of(Limits{.unit = "m", .above = 0.0, .zero = true}) == "0 m or above");
    CHECK(text_of(Limits{.above = -1.0, .below = 0.0, .closed = true}) == "above -1, at most 0");
}

TEST_CASE("a summary names options always, where they are changed, or with their scheme", "[run][options]") {
    test::Soil soil;
    const auto names = [&](const char* scheme) { return names_in(run::named_values(test::soil_options(), soil, scheme)); };
    CHECK(names("leapfrog") == std::vector<std::string>{"soil_stiffness", "drains", "grain"});
    CHECK(names("memm") == std::vector<std::string>{"soil_stiffness", "soil_layers", "drains", "grain"});
    soil.is_wet = true;
    CHECK(names("leapfrog") == std::vector<std::string>{"soil_stiffness", "is_wet", "drains", "grain"});
    soil.depths = {0.5, 2.0};
    CHECK(run::named_values(test::soil_options(), soil, "leapfrog").back().value == run::Value(std::vector{0.5, 2.0}));
    soil.depths.clear();
    const run::NamedValues values = run::named_values(test::soil_options(), soil, "memm");
    CHECK(values[0].value == run::Value(2.5));
    CHECK(values[1].value == run::Value(std::int64_t{3}));
    CHECK(values[3].value == run::Value(std::string("on")));
    CHECK(values[4].value == run::Value(std::string("coarse")));
}

TEST_CASE("a run refuses every option that its scheme does not read, and says which scheme does", "[run][options]") {
    for (const auto& option : run::run_options()) {
        if (option.schemes.empty()) continue;
        CAPTURE(option.name);
        run::RunOptions options;
        option.set(options, another(option, option.get(options)));
        for (const auto& [word, scheme] : run::integrator_words) {
            options.integrator = scheme;
            if (std::ranges::find(option.schemes, word) != option.schemes.end())
                CHECK_NOTHROW(run::check(options));
            else
                CHECK_THROWS_WITH(run::check(options), Contains(option.table + "." + option.scene_key()) &&
                                                           Contains("--integrator " + option.schemes.front()));
        }
    }
}
