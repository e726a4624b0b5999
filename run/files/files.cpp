#include "abut/run/files/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <system_error>

#include "abut/base/error.hpp"
#include "abut/base/text.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/run/files/animation.hpp"
#include "abut/run/files/failure_files.hpp"
#include "abut/run/files/paraview_script.hpp"

namespace abut::run {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> plain_results = {"summary.json",       "report.html", "energy.csv", "energy.svg",
                                                paraview_script_name, "probes.csv",  "forces.csv", animation_name};

bool take(std::string_view& text, std::string_view start) {
    if (!text.starts_with(start)) return false;
    text.remove_prefix(start.size());
    return true;
}

/// Drops the name of a series, and of those beside it, and a dot in front: what a file is called while it is written.
/// Says whether it is that of the cells.
bool take_series(std::string_view& name, std::string_view series, bool& is_of_cells) {
    take(name, ".");
    if (!take(name, series)) return false;
    is_of_cells = !take(name, "_surface") && !take(name, pairs_series("")) && !take(name, obstacles_series(""));
    return true;
}

/// <series>.pvd, .xmf, .h5, .h5.journal, and .pvd of those beside it.
bool is_list(std::string_view name, std::string_view series) {
    bool cells = false;
    if (!take_series(name, series, cells)) return false;
    return name == ".pvd" || name == ".part.pvd" || name == ".xmf" || name == ".xmf.partial" ||
           (cells && (name == ".h5" || name == ".h5.journal" || name == ".h5.journal.partial"));
}

/// <series>_000012.vtu, and .vtp of those beside it; of frames in pieces <series>_000012.pvtu and <series>_000012_3.vtu.
bool is_frame(std::string_view name, std::string_view series) {
    bool cells = false;
    if (!take_series(name, series, cells) || !take(name, "_")) return false;
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    if (digits < 6) return false;
    name.remove_prefix(digits);
    if (take(name, "_")) {  // a piece of it
        const std::size_t of_piece = std::min(name.find_first_not_of("0123456789"), name.size());
        if (of_piece == 0) return false;
        name.remove_prefix(of_piece);
        take(name, ".part");
        return name == (cells ? ".vtu" : ".vtp");
    }
    take(name, ".part");
    return cells ? name == ".vtu" || name == ".pvtu" : name == ".vtp" || name == ".pvtp";
}

void remove_result(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error)
        throw BadInput(
            fmt::format("{}: the result of an earlier run cannot be removed: {}. Choose another folder with --out.",
                        path.string(), error.message()));
}

/// Names of the files in a folder that belong to a series, which `belongs` tells.
template <class Belongs>
std::vector<std::string> names_in(const fs::path& directory, const std::string& series, const Belongs& belongs) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error))
        if (const std::string name = entry->path().filename().string(); belongs(name, series)) names.push_back(name);
    if (error) refuse_directory(directory, error.message());
    return names;
}

/// The lists and frames of a series that are there, from the folder of results.
std::vector<std::string> files_of_series(const fs::path& directory, const std::string& series) {
    std::vector<std::string> names = names_in(directory, series, is_list);
    if (const fs::path frames = directory / mesh::frames_folder; fs::is_directory(frames))
        for (const std::string& name : names_in(frames, series, is_frame))
            names.push_back((fs::path(mesh::frames_folder) / name).string());
    return names;
}

std::vector<std::string> files_of_failure(const fs::path& directory, const std::string& series) {
    const std::string name(failure_name);
    std::vector<std::string> names = files_of_series(directory, failure_series(series));
    names.insert(names.end(), {name + ".csv", name + ".svg", std::string(failure_page)});
    return names;
}

/// Says that a folder is one of results.
constexpr const char* mark = ".abut.results";

}  // namespace

void remove_earlier_results(const fs::path& directory, const std::string& series) {
    std::vector<std::string> names = plain_results;
    for (const auto& more : {files_of_series(directory, series), files_of_failure(directory, series)})
        names.insert(names.end(), more.begin(), more.end());
    claim_results(directory, names);
}

void remove_failure(const fs::path& directory, const std::string& series) {
    remove_files(directory, files_of_failure(directory, series));
}

bool holds_results(const fs::path& directory) { return fs::exists(directory / mark); }

void claim_results(const fs::path& directory, const std::vector<std::string>& names) {
    if (!holds_results(directory)) {
        for (const std::string& name : names)
            if (std::error_code error; fs::exists(fs::symlink_status(directory / name, error)))
                throw BadInput(
                    fmt::format("--out {}: {} is there, and the folder holds no results of Abut: a run would write over it. "
                                "Choose another folder with --out, or move the file away.",
                                directory.string(), name));
        write_whole(directory / mark, "The results of a run of Abut are in this folder: the next run here replaces them.\n");
    }
    remove_files(directory, names);
}

void remove_files(const fs::path& directory, const std::vector<std::string>& names) {
    for (const fs::path name : names) {
        const std::string file = name.filename().string(), stem = name.stem().string(),
                          extension = name.extension().string();
        for (const std::string& present : {file, file + ".partial", stem + ".partial" + extension})
            remove_result(directory / name.parent_path() / present);
    }
    std::error_code in_use;
    fs::remove(directory / mesh::frames_folder, in_use);  // where nothing is left in it
}

void write_whole(const fs::path& path, const std::string& text) {
    fs::path partial = path;
    partial += ".partial";
    std::ofstream file(partial, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw BadInput(cannot_be_written(partial));
    move_file(partial, path);
}

void move_file(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) throw BadInput(cannot_be_written(to, error.message()));
}

void refuse_directory(const fs::path& directory, const std::string& reason) {
    throw BadInput(
        fmt::format("--out {}: the folder cannot be written to: {}. Choose another folder or change its permissions.",
                    directory.string(), reason));
}

std::string in_csv(std::string name) {
    std::ranges::replace_if(
        name,
        [](char c) {
            return c == ',' || c == '"' || has_control_character({&c, 1});
        },
        '_');
    return as_cell(name);
}

std::string cannot_be_written(const fs::path& path, const std::string& reason) {
    return fmt::format(
        "{}: cannot be written{}{}. Check permissions and free space of its folder, and the limit of "
        "file sizes (ulimit -f).",
        path.string(), reason.empty() ? "" : ": ", reason);
}

}  // namespace abut::run
