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
    std::ifstream file(ABUT_SOURCE "/tests/input/wrong_scenes.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK(text == test::page_of_wrong_scenes());  // test_input "[.page]" writes it
}

TEST_CASE("writes the page of wrong scenes", "[.page]") {
    std::ofstream(ABUT_SOURCE "/tests/input/wrong_scenes.md") << test::page_of_wrong_scenes();
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
    const auto checked = input::check_scene(file.path(), {.set = {"contact.skin=-1"}});
    std::vector<std::string> places;
    const std::size_t name = file.path().string().size();
    for (const auto& fault : checked.faults)
        places.push_back(fault.where.starts_with("--") ? fault.where : fault.where.substr(name));
    CHECK(places == std::vector<std::string>{":19:1", ":21:1", ":22:15", ":23:11", "--set contact.skin=-1"});
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

TEST_CASE("long texts, and keys and lists nested 65 deep, are refused with their place, in a short message",
          "[input][faults]") {
    const auto text_of_faults = [](const std::string& more, const std::vector<std::string>& set) {
        const WrittenScene file(two_blocks(more));
        return input::text_of(input::check_scene(file.path(), {.set = set}).faults);
    };
    const auto is_short_with = [](const std::string& text, const char* part) {
        return text.size() < 2000 && text.find(part) != std::string::npos;
    };
    const std::string formula(2000, '1'), brackets = std::string(65, '(') + "1" + std::string(64, ')');
    CHECK(is_short_with(text_of_faults("cfl = \"" + formula + "\"", {}), ".toml:19:"));
    CHECK(is_short_with(text_of_faults("", {"run.cfl=" + formula}), "run.cfl"));
    CHECK(is_short_with(text_of_faults("cfl = \"" + brackets + "\"", {}), ".toml:19:"));

    const auto repeated = [](const char* part, int n) {
        std::string text;
        for (int i = 0; i < n; ++i) text += part;
        return text;
    };
    for (const int n : {64, 65}) {
        const std::string key = repeated("a.", n) + "a", list = "a = " + repeated("[", n) + repeated("]", n);
        for (const std::string& more : {key + " = 1", "[" + repeated("a.", n - 1) + "a]", list}) {
            CAPTURE(n, more);
            const std::string text = text_of_faults(more, {});
            CHECK(text.find(".toml:19:") != std::string::npos);
            CHECK(is_short_with(text, "nested more than 64 deep") == (n > 64));
        }
        CHECK(is_short_with(text_of_faults("", {key + "=1"}), "nested more than 64 deep") == (n > 64));
    }
}

TEST_CASE("dots and brackets in texts and comments are no depth", "[input][faults]") {
    const std::string many = std::string(200, '.') + std::string(200, '[');
    const WrittenScene file(two_blocks("# " + many + "\n[obstacles.\"" + many + "\"]\nshape = 'x" + many +
                                       "'\n[output]\nout = \"\"\"a\n" + many + "\"\"\"\n"));
    const std::string text = input::text_of(input::check_scene(file.path()).faults);
    CHECK(text.find("nested") == std::string::npos);
    CHECK(text.find("none of its words") != std::string::npos);
}

TEST_CASE("words of other programs are known for keys", "[input][faults]") {
    struct Wrong {
        const char* more;
        const char* text;
    };
    for (const Wrong& wrong :
         {Wrong{"[materials.a]\nE = 1\nnu = 0.3\nrho = 1", "materials.a.E is an unknown key. Did you mean 'young'?"},
          {"[materials.a]\nE = 1\nnu = 0.3\nrho = 1", "materials.a.nu is an unknown key. Did you mean 'poisson'?"},
          {"[materials.a]\nE = 1\nnu = 0.3\nrho = 1", "materials.a.rho is an unknown key. Did you mean 'density'?"},
          {"t_end = 1", "run.t_end is an unknown key. Did you mean 'time'?"},
          {"[bodies.third]\nmesh = 'part.msh'\nsize = 1", "bodies.third.size is an unknown key. It goes with `surface`"},
          {"[bodies.third]\nmesh = 'part.msh'\nzzzzzz = 1", "bodies.third.zzzzzz is an unknown key. `abut keys` lists"},
          {"[contact]\nmu = 0.3", "contact.mu is an unknown key. Friction is contact.friction = 0.3 for all"},
          {"[materials.a]\nfriction = 0.3", "materials.a.friction is an unknown key. Friction is contact.friction = 0.3"}}) {
        const WrittenScene file(two_blocks(wrong.more));
        CHECK(input::text_of(input::check_scene(file.path()).faults).find(wrong.text) != std::string::npos);
    }
}

TEST_CASE("a name with a control character is refused, and one that is no UTF-8 is no TOML", "[input][faults]") {
    const std::string block = "\nshape = 'disc'\nradius = 0.1\nsize = 0.1\nplace = [0, 3]\nyoung = 1\ndensity = 1\n";
    const WrittenScene control(two_blocks("[bodies.\"a\\nb\"]" + block));
    CHECK(input::text_of(input::check_scene(control.path()).faults).find("control character") != std::string::npos);
    // Displayed it would read like another name: "left", behind a mark of U+202E.
    const WrittenScene turned(two_blocks("[bodies.\"\\u202Etfel\"]" + block));
    CHECK(input::text_of(input::check_scene(turned.path()).faults).find("turns the direction") != std::string::npos);
    const WrittenScene bytes(two_blocks("[bodies.\"K\xF6rper\"]" + block));
    const std::string text = input::text_of(input::check_scene(bytes.path()).faults);
    CHECK(text.find(".toml:19:") != std::string::npos);
    CHECK(text.find("this is no TOML") != std::string::npos);
}

TEST_CASE("check says what a run refuses before its first step, and what it warns of", "[input][check]") {
    const std::string tip =
        "[bodies.tip]\nshape = \"fan_disc\"\nradius = 0.4\nsectors = 3\nplace = [5, 5]\nyoung = 1\ndensity = 1\n";
    const WrittenScene sharp(two_blocks("[contact]\nlaw = \"reconstruction\"\n[laboratory]\nfacing_cosine = -0.9\n" + tip));
    const auto checked = input::check_scene(sharp.path());
    REQUIRE(checked.estimate);
    CHECK(std::ranges::any_of(checked.warnings, [](const std::string& text) {
        return text.find("laboratory.facing_cosine (--lab facing_cosine)") != std::string::npos;
    }));
    CHECK(checked.estimate->cell_of_step.find("of body '") != std::string::npos);
}

TEST_CASE("check refuses times of frames after the end of the run, by number and remedy", "[input][check]") {
    const WrittenScene late(two_blocks("[output]\ntimes = [0.05, 7]"));
    const auto checked = input::check_scene(late.path());
    REQUIRE(checked.faults.size() == 1);
    CHECK_THAT(input::text_of(checked.faults),
               Catch::Contains("output.times (--times): number 2 is 7 s, and the run ends at") &&
                   Catch::Contains("give a later end"));
}

TEST_CASE("the cell that sets the step is the smallest one, over the median", "[input][check]") {
    // Squares of 1/2, 1/3 and 1/10, of which those of 1/3 are in the middle.
    const WrittenScene file(
        two_blocks("[bodies.fine]\nshape = \"structured_box\"\nlower = [5, 0]\nupper = [5.4, 0.2]\ncounts = [4, 2]\nyoung = "
                   "1\ndensity = 1\n"));
    const auto checked = input::check_scene(file.path());
    REQUIRE(checked.estimate);
    CHECK(checked.estimate->cell_of_step.find("of body 'fine'") != std::string::npos);
    CHECK(checked.estimate->cell_of_step.find("0.3 of the median") != std::string::npos);
    CHECK(checked.warnings.empty());
}

TEST_CASE("a cell ten times as fast as most is warned of, since all cells take its step", "[input][check]") {
    const auto warned = [](const char* upper) {
        const WrittenScene file(
            two_blocks(std::string("[bodies.fine]\nshape = \"structured_box\"\nlower = [5, 0]\nupper = ") + upper +
                       "\ncounts = [4, 2]\nyoung = 1\ndensity = 1\n"));
        return std::ranges::any_of(input::check_scene(file.path()).warnings, [](const std::string& text) {
            return text.find("of body 'fine'") != std::string::npos && text.find("of more even size") != std::string::npos;
        });
    };
    CHECK(warned("[5.1, 0.05]"));         // squares of 0.025, and most of a third
    CHECK_FALSE(warned("[5.16, 0.08]"));  // of 0.04
}
