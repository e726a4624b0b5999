#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "abut/run/values/checkpoint.hpp"

namespace abut::run {

/// The checkpoints of a run in a folder of their own, the last two of them: step_000000012345.h5.
class CheckpointFolder {
public:
    /// Nothing is made before the first checkpoint comes.
    explicit CheckpointFolder(std::filesystem::path directory) : directory_(std::move(directory)) {}

    /// Later ones go, which a run that goes on from an earlier one has refused. Throws BadInput if it cannot be
    /// written: those before it stay.
    void add(const Checkpoint& checkpoint) const;
    /// A file that whoever goes on needs, beside them: "scene.toml".
    void add_text(const std::string& name, const std::string& text) const;
    /// Such a file; throws BadInput if it cannot be read.
    [[nodiscard]] std::string text(const std::string& name) const;

    /// The last one that can be read, and why each later one cannot. Throws BadInput if there is none.
    struct Found {
        Checkpoint checkpoint;
        std::filesystem::path path;
        std::vector<std::string> refused;
    };
    [[nodiscard]] Found last() const;
    [[nodiscard]] bool is_empty() const { return files().empty(); }
    /// The checkpoints and files of these names beside them, and the folder if nothing else is in it: a run has come to its
    /// end.
    void remove(const std::vector<std::string>& texts) const;

    [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }

private:
    [[nodiscard]] std::vector<std::filesystem::path> files() const;
    void remove_unfinished() const;

    std::filesystem::path directory_;
};

}  // namespace abut::run
