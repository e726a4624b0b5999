#pragma once
#include <string>
#include <vector>

namespace abut::test {

/// Something wrong behind the scene of two blocks, whose last line is 18, or set in it, and what the message has to say.
struct WrongScene {
    std::string more;
    std::vector<std::string> set;
    std::string where;               ///< from the end of the name of the file on, or of "--set"
    std::vector<std::string> words;  ///< value, unit, limit, remedy
};

[[nodiscard]] const std::vector<WrongScene>& wrong_scenes();

/// tests/input/wrong_scenes.md: each of them with its message.
[[nodiscard]] std::string page_of_wrong_scenes();

}  // namespace abut::test
