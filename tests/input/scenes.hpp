#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "abut/input/check.hpp"
#include "abut/input/scene_file.hpp"

namespace abut::test {

/// A scene as a file of its own, for this process alone, removed with the object.
class WrittenScene {
public:
    explicit WrittenScene(const std::string& text) {
        std::filesystem::create_directories(path_.parent_path());
        std::ofstream(path_) << text;
    }
    ~WrittenScene() {
        std::error_code ignored;
        std::filesystem::remove_all(path_.parent_path(), ignored);
    }
    WrittenScene(const WrittenScene&) = delete;
    WrittenScene& operator=(const WrittenScene&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_ = std::filesystem::path(ABUT_INPUT_RESULTS) / std::to_string(getpid()) / "scene.toml";
};

/// Two blocks of two cells 0.5 m apart; `more` goes behind.
/// For three steps, unless `more` has a time.
inline std::string two_blocks(const std::string& more = "") {
    return R"toml(dim = 2
[bodies.left]
shape = "structured_box"
lower = [0, 0]
upper = [1, 1]
counts = [2, 2]
young = 1
density = 1
velocity = [1, 0]
[bodies.right]
shape = "structured_box"
lower = [1.5, 0]
upper = [2.5, 1]
counts = [3, 3]
young = 1
density = 1
[run]
)toml" + (("\n" + more).find("\ntime =") == std::string::npos ? "steps = 3\n" + more : more);
}

}  // namespace abut::test
