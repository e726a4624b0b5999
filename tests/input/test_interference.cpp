// Scenes in which bodies overlap at the start on purpose.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/summary.hpp"
#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::WrittenScene;

/// Two blocks that overlap by 0.1 m, of cells of 0.5 m, and what is given.
std::string pressed_blocks(const std::string& more) {
    return R"toml(dim = 2
[bodies.left]
shape = "structured_box"
lower = [0, 0]
upper = [1.1, 1]
counts = [2, 2]
young = 1
density = 1
[bodies.right]
shape = "structured_box"
lower = [1, 0]
upper = [2, 1]
counts = [3, 3]
young = 1
density = 1
)toml" + more;
}
constexpr const char* resolved = R"toml([[contact.pairs]]
bodies = ["left", "right"]
interference = "resolve"
interference_time = "1000 ms"
)toml";

bool any_says(const std::vector<input::Fault>& faults, const std::string& words) {
    return std::ranges::any_of(faults,
                               [&](const input::Fault& fault) { return fault.text.find(words) != std::string::npos; });
}

}  // namespace

TEST_CASE("bodies that overlap on purpose are run, and all others that overlap are an error", "[input][interference]") {
    const auto faults_of = [](const std::string& more) {
        const WrittenScene written(pressed_blocks(more + "[run]\nsteps = 40\n"));
        return input::check_scene(written.path()).faults;
    };
    CHECK(any_says(faults_of(""), "'left' and 'right' overlap at the start"));
    CHECK(
        any_says(faults_of("[[contact.pairs]]\nbodies = [\"left\", \"right\"]\nfriction = 0.1\n"), "overlap at the start"));
    CHECK(faults_of(resolved).empty());
    CHECK(any_says(faults_of("[[contact.pairs]]\nbodies = [\"left\", \"right\"]\ninterference = \"resolve\"\n"),
                   "needs interference_time"));
    CHECK(any_says(faults_of("[[contact.pairs]]\nbodies = [\"left\", \"right\"]\ninterference_time = 1\n"),
                   "has no effect without interference"));
    CHECK(any_says(faults_of(std::string("[contact]\nignored_pairs = [[\"left\", \"right\"]]\n") + resolved),
                   "have an interference and never touch"));
    CHECK(any_says(faults_of(std::string("[contact]\nlaw = \"reconstruction\"\n") + resolved), "interference"));
}

TEST_CASE("an overlap on purpose leaves friction as it is unless the pair has its own, and is in the summary",
          "[input][interference]") {
    const auto scene_of = [](const std::string& more) {
        const WrittenScene written(pressed_blocks(more + "[run]\nsteps = 200\n"));
        return input::SceneFile(written.path()).scene<2>();
    };
    const auto plain = scene_of(resolved);
    REQUIRE(plain.solid.interference.size() == 1);
    CHECK(plain.solid.interference[0].bodies == std::array{0, 1});
    CHECK(plain.solid.interference[0].time == 1.0);
    CHECK(plain.solid.body_friction.empty());
    CHECK(scene_of(std::string(resolved) + "friction = 0\n").solid.body_friction.size() == 1);
    const auto by_groups = scene_of(
        "[[contact.pairs]]\ngroups = [\"left.xmax\", \"right.xmin\"]\ninterference = \"resolve\"\ninterference_time = 1\n");
    CHECK(by_groups.solid.interference[0].bodies == std::array{3, 6});
    run::RunOptions options;
    options.steps = 200;
    const auto result = run::simulate<2>(by_groups, options);
    REQUIRE(result.contact.overlaps.size() == 1);
    CHECK(result.contact.overlaps[0] == Approx(0.1).epsilon(1e-12));
    CHECK(result.contact.report.missed_contacts == 0);
    CHECK(result.ledger.pseudo_energy_drift() < 1e-12 * result.energy.scale.value);
    CHECK(run::summary_json("abut", by_groups, result).find("'left.xmax'") != std::string::npos);
}

TEST_CASE("an obstacle may overlap a body on purpose", "[input][interference]") {
    const std::string plane = R"toml([obstacles.floor]
shape = "plane"
point = [0, 0.05]
normal = [0, 1]
)toml";
    const auto faults_of = [&](const std::string& more) {
        const WrittenScene written(test::two_blocks("[contact]\nenabled = true\n" + plane + more));
        return input::check_scene(written.path()).faults;
    };
    CHECK(any_says(faults_of(""), "overlap at the start"));
    CHECK(
        faults_of("[[contact.pairs]]\nbodies = [\"left\", \"floor\"]\ninterference = \"resolve\"\ninterference_time = 1\n"
                  "[[contact.pairs]]\nbodies = [\"right\", \"floor\"]\ninterference = \"resolve\"\ninterference_time = 1\n")
            .empty());
}
