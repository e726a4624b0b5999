#pragma once
// Runs of `detect`, and what they read.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "programs/program.hpp"

namespace abut::test::programs {

/// A square of the side 1 with its lower corner at (x, y, z), two triangles, facing up or down, as .obj.
inline void write_square(const std::filesystem::path& path, double x, double y, double z, bool up) {
    std::ofstream file(path);
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        file << fmt::format("v {} {} {}\n", x + i, y + j, z);
    file << (up ? "f 1 2 3\nf 1 3 4\n" : "f 3 2 1\nf 4 3 1\n");
}

/// Two unit squares that face each other, the upper one `gap` higher and moved by 0.25 along x.
class Squares {
public:
    Squares(const std::string& name, double gap) : folder_(name) {
        write_square(folder_.path() / "lower.obj", 0.0, 0.0, 0.0, true);
        write_square(folder_.path() / "upper.obj", 0.25, 0.0, gap, false);
    }
    [[nodiscard]] std::string arguments() const {
        return fmt::format("'{0}/lower.obj' '{0}/upper.obj' ", folder_.path().string());
    }
    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

private:
    Folder folder_;
};

inline Outcome detect(const std::string& arguments, const std::string& folder) {
    return run_well("abut", "detect " + arguments, folder);
}

inline nlohmann::json last_step(const Outcome& outcome) { return read_summary(outcome)["last_step"]; }

}  // namespace abut::test::programs
