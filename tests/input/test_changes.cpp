#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "abut/input/changes.hpp"
#include "abut/input/fault.hpp"
#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::WrittenScene;

std::vector<std::string> changes(const std::string& before, const std::string& now) {
    const WrittenScene first(before);
    const std::filesystem::path copy = first.path().parent_path() / "before.toml";
    std::filesystem::copy_file(first.path(), copy, std::filesystem::copy_options::overwrite_existing);
    std::ofstream(first.path()) << now;
    return input::changed_keys(copy, first.path());
}

}  // namespace

TEST_CASE("keys that differ between two scenes are named with both values, order and comments are no difference",
          "[input][changes]") {
    CHECK(changes("a = 1\n[b]\nc = 'x'\nd = [1, 2]\n", "# other\n[b]\nd = [1, 2]\nc = 'x'\n[\"\"]\n") ==
          std::vector<std::string>{"a is not there any more, it was the number 1", " is new: a table"});
    CHECK(changes("[b]\nc = 'x'\nd = [1, 2]\n", "[b]\nd = [1, 3]\nc = 'y'\ne = true\n") ==
          std::vector<std::string>{"b.c is the text 'y' now, it was the text 'x'",
                                   "b.d is a list of 2 now with other values", "b.e is new: true"});
    CHECK(changes("[b]\nc = 1\n", "b.c = 1 # the same\n").empty());
    CHECK_THROWS_AS(changes("a = 1", "a = "), input::SceneError);
}
