// The table of what scenes may ask of schemes, what runs do, and what the page of integrators says.
#include "abut/run/scheme_capabilities.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <string>

#include "abut/base/error.hpp"
#include "abut/run/simulation.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;
using run::SchemeCapability;

/// A block that falls on a plane and asks for it; several ranks are asked for elsewhere.
run::Scene<2> asking(SchemeCapability capability) {
    run::Scene<2> scene = test::block_on_plane(1e-3);
    if (capability == SchemeCapability::memory) scene.solid.materials[0].mass_damping = 0.1;
    if (capability == SchemeCapability::friction) scene.solid.body_friction = {{{0, 1}, {.coefficient = 0.3}}};
    return scene;
}

}  // namespace

TEST_CASE("schemes refuse what the table says that they do not have, by their name, and run what they have", "[run]") {
    for (const auto& [word, scheme] : run::integrator_words)
        for (const SchemeCapability capability : {SchemeCapability::friction, SchemeCapability::memory}) {
            CAPTURE(word, run::row_of(capability).name);
            run::RunOptions options{.steps = 1, .integrator = scheme};
            if (scheme == run::SolidIntegrator::memm_async) options.law = solid::ContactLaw::reconstruction;
            const auto ask = [&] { static_cast<void>(run::simulate<2>(asking(capability), options)); };
            if (run::has(scheme, capability))
                CHECK_NOTHROW(ask());
            else
                CHECK_THROWS_WITH(ask(), Catch::Contains(std::string("(--integrator ") + word + "): ") &&
                                             Catch::EndsWith(std::string(run::row_of(capability).remedy)));
        }
}

TEST_CASE("docs/integrators.md has the table of what scenes may ask of schemes", "[run]") {
    std::ifstream file(ABUT_SOURCE "/docs/integrators.md");
    std::ostringstream page;
    page << file.rdbuf();
    std::string head = "| |", rows;
    for (const auto& [word, scheme] : run::integrator_words) head += std::string(" `") + word + "` |";
    for (const run::SchemeCapabilityRow& row : run::scheme_capabilities) {
        rows += "| " + std::string(row.name) + " |";
        for (const bool has : row.of) rows += has ? " yes |" : " refused |";
        rows += "\n";
    }
    CHECK_THAT(page.str(), Catch::Contains(head + "\n|---|---|---|---|---|\n" + rows));
}
