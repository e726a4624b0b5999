#pragma once
#include <string>
#include <vector>

namespace abut::run {

/// Names of bodies and obstacles in a scene.
struct SceneNames {
    std::vector<std::string> bodies{};
    std::vector<std::string> obstacles{};
};

/// A message of a lower layer in the words of people who write scenes: names of C++ become keys
/// (SolidOptions::acceleration is `gravity`), and numbers of bodies and obstacles their names, as far as these are
/// given. What has been said in these words already stays as it is.
[[nodiscard]] std::string in_user_words(std::string text, const SceneNames& names = {});

/// Options of a command line become keys, with the option behind them: --cfl is `run.cfl (--cfl)`, and --filter neutral
/// `run.filter = "neutral" (--filter neutral)`. Options that are in parentheses already stay as they are.
[[nodiscard]] std::string with_keys(const std::string& text);

}  // namespace abut::run
