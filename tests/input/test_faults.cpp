#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "input/scenes.hpp"
#include "input/wrong_scenes.hpp"

namespace {

using namespace abut;
using test::two_blocks;
using test::WrittenScene;
using test::wrong_scenes;
using test::WrongScene;

}  // namespace

TEST_CASE("every wrong scene gets a message that says where, what, how much is allowed and what to do", "[input][faults]") {
    for (const WrongScene& wrong : wrong_scenes()) {
        CAPTURE(wrong.more, wrong.set);
        const WrittenScene file(two_blocks(wrong.more));
        const input::CheckedScene checked = input::check_scene(file.path(), {.set = wrong.set});
        CHECK_FALSE(checked.estimate);
        CAPTURE(input::text_of(checked.faults));
        CHECK(std::ranges::any_of(checked.faults, [&](const input::Fault& fault) {
            const bool says_all = std::ranges::all_of(
                wrong.words, [&](const std::string& word) { return fault.text.find(word) != std::string::npos; });
            return says_all && fault.where.find(wrong.where) != std::string::npos;
        }));
        CHECK(checked.faults.size() == 1);  // none that only follows from it
    }
    CHECK(wrong_scenes().size() >= 60);
}

TEST_CASE("the page of wrong scenes has the messages that they get", "[input][faults]") {
    std::ifstream file(ABUT_SOURCE "/docs/wrong_scenes.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK(text == test::page_of_wrong_scenes());  // test_input "[.page]" writes it
}

TEST_CASE("writes the page of wrong scenes", "[.page]") {
    std::ofstream(ABUT_SOURCE "/docs/wrong_scenes.md") << test::page_of_wrong_scenes();
}

TEST_CASE("all faults of a scene come at once, those of meshes and groups too", "[input][faults]") {
    const WrittenScene file(two_blocks(R"toml(cfl = 2
[contact]
skinn = 1
[supports.end]
group = "right.ymas"
[supports.held]
group = "left.xmin"
[obstacles.floor]
shape = "plane"
)toml"));
    const auto checked = input::check_scene(file.path(), {.set = {"bodies.left.density=-1"}});
    const std::string text = input::text_of(checked.faults);
    CAPTURE(text);
    for (const char* word : {"run.cfl", "contact.skinn", "right.ymas", "floor.point", "floor.normal", "density is -1"})
        CHECK(text.find(word) != std::string::npos);
    CHECK(text.find("supports.held") == std::string::npos);  // its body has no mesh: nothing is known of its groups
    CHECK(checked.faults.size() == 6);
}

TEST_CASE("faults come in the order of the file, those of the command line last", "[input][faults]") {
    const WrittenScene file(two_blocks("cfl = 2\n[output]\nfarmes = 3\n[bodies.right.x]\n[supports.a]\ngroup = \"b\""));
    const auto checked = input::check_scene(file.path(), {.set = {"run.dt=0"}});
    std::vector<std::string> places;
    const std::size_t name = file.path().string().size();
    for (const auto& fault : checked.faults)
        places.push_back(fault.where.starts_with("--") ? fault.where : fault.where.substr(name));
    CHECK(places == std::vector<std::string>{":19:1", ":21:1", ":22:15", ":23:11", "--set run.dt=0"});
    const std::vector<input::Fault> mixed{
        {"--set a=1", ""}, {"a.toml", ""}, {"a.toml:10:1", ""}, {"a.toml:9:7", ""}, {"a.toml:9:3", ""}};
    std::vector<std::string> sorted;
    for (const auto& fault : input::in_order(mixed)) sorted.push_back(fault.where);
    CHECK(sorted == std::vector<std::string>{"a.toml:9:3", "a.toml:9:7", "a.toml:10:1", "a.toml", "--set a=1"});
}

TEST_CASE("a scene with a fault is not run: reading throws all of them", "[input][faults]") {
    const WrittenScene file(two_blocks("cfk = 1"));
    CHECK_THROWS_AS(input::SceneFile(file.path()), input::SceneError);
    CHECK_THROWS_AS(input::SceneFile(file.path().parent_path() / "none.toml"), input::SceneError);
    CHECK_THROWS_AS(input::SceneFile(file.path().parent_path()), input::SceneError);
    const input::Overrides good{.set = {"bodies.right.place=[-1, 0]"}};
    const WrittenScene apart(two_blocks());
    const input::SceneFile overlapping(apart.path(), good);  // keys are right, places are not
    CHECK_THROWS_AS(overlapping.scene<2>(), input::SceneError);
    CHECK_THROWS_AS(overlapping.scene<3>(), Misuse);
}
