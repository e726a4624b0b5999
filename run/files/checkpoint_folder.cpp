#include "abut/run/files/checkpoint_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

#include "abut/base/error.hpp"
#include "abut/base/input_file.hpp"
#include "abut/run/files/checkpoint_file.hpp"
#include "abut/run/files/files.hpp"

namespace abut::run {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kept = 2;

}  // namespace

/// Files of the checkpoints, the last step first.
std::vector<fs::path> CheckpointFolder::files() const {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(directory_, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with("step_") && name.ends_with(".h5")) files.push_back(entry->path());
    }
    std::ranges::sort(files, std::ranges::greater{});
    return files;
}

void CheckpointFolder::add(const Checkpoint& checkpoint) const {
    std::error_code error;
    fs::create_directories(directory_, error);
    if (error) refuse_directory(directory_, error.message());
    remove_unfinished();
    const fs::path path = directory_ / fmt::format("step_{:012}.h5", checkpoint.motion.steps);
    write_checkpoint(checkpoint, path);
    const std::vector<fs::path> all = files();
    const auto now = static_cast<std::size_t>(std::ranges::find(all, path) - all.begin());
    for (std::size_t i = 0; i < all.size(); ++i)
        if (i < now || i >= now + kept) fs::remove(all[i], error);  // one too many harms nobody
}

/// Removes files of a run that was killed while it wrote.
void CheckpointFolder::remove_unfinished() const {
    std::error_code error;
    std::vector<fs::path> unfinished;
    for (fs::directory_iterator entry(directory_, error), end; !error && entry != end; entry.increment(error))
        if (entry->path().extension() == ".partial") unfinished.push_back(entry->path());
    for (const fs::path& path : unfinished) fs::remove(path, error);
}

void CheckpointFolder::add_text(const std::string& name, const std::string& text) const {
    std::error_code error;
    fs::create_directories(directory_, error);
    if (error) refuse_directory(directory_, error.message());
    write_whole(directory_ / name, text);
}

CheckpointFolder::Found CheckpointFolder::last() const {
    std::vector<std::string> refused;
    for (const fs::path& path : files()) {
        try {
            return {read_checkpoint(path), path, refused};
        } catch (const BadInput& error) {
            refused.emplace_back(error.what());
        }
    }
    std::string text = fmt::format(
        "{}: no checkpoint that a run can go on from. A run that has ended well keeps none, one with --checkpoint 0 writes "
        "none. Give the folder of --out of a run that was stopped, or run from the start.",
        directory_.string());
    for (const std::string& why : refused) text += "\n  " + why;
    throw BadInput(text);
}

std::string CheckpointFolder::text(const std::string& name) const {
    try {
        return file_bytes(directory_ / name);
    } catch (const BadInput& error) {
        throw BadInput(
            fmt::format("{} Programs other than abut go on with --resume beside the options of the run that was stopped.",
                        error.what()));
    }
}

void CheckpointFolder::remove(const std::vector<std::string>& texts) const {
    remove_unfinished();
    std::vector<fs::path> all = files();
    for (const std::string& name : texts) all.push_back(directory_ / name);
    for (const fs::path& path : all) {
        std::error_code error;
        fs::remove(path, error);
        if (error)
            throw BadInput(fmt::format("{}: a file of checkpoints that nobody needs cannot be removed: {}. Remove it.",
                                       path.string(), error.message()));
    }
    std::error_code not_empty;
    fs::remove(directory_, not_empty);
}

}  // namespace abut::run
