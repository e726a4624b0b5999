#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace abut::run {

/// Makes a folder one of results, to which files of these names are to be written: those of an earlier run are removed.
/// A file of the user stays: where no run has claimed the folder before (.abut.results says so) and a name is taken,
/// throws BadInput naming the file.
void claim_results(const std::filesystem::path& directory, const std::vector<std::string>& names);

/// Whether a run has claimed the folder.
[[nodiscard]] bool holds_results(const std::filesystem::path& directory);

/// claim_results for what ResultFiles may leave: summary.json, report.html, animation.html, energy.csv, its picture,
/// probes.csv, forces.csv, the script for ParaView, the lists and frames of `series`, and what is left of a run that
/// failed. Everything else stays.
void remove_earlier_results(const std::filesystem::path& directory, const std::string& series);

/// The series of pairs in contact beside that of cells.
[[nodiscard]] inline std::string pairs_series(const std::string& series) { return series + "_pairs"; }

/// The series of obstacles beside that of cells.
[[nodiscard]] inline std::string obstacles_series(const std::string& series) { return series + "_obstacles"; }

/// Removes what a run that failed has left of its failure (write_failure). Throws BadInput naming the file.
void remove_failure(const std::filesystem::path& directory, const std::string& series);

/// Removes files of these names, and what they are called while they are written. Throws BadInput naming the file.
void remove_files(const std::filesystem::path& directory, const std::vector<std::string>& names);

/// Writes a file beside its place, then moves it there: it is never seen half-written. Throws BadInput.
void write_whole(const std::filesystem::path& path, const std::string& text);

/// Throws BadInput naming the file.
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Throws BadInput: the folder of --out cannot be written to, why, and what to do.
[[noreturn]] void refuse_directory(const std::filesystem::path& directory, const std::string& reason);

/// A name as it stands in a table of comma-separated values: commas, quotation marks and control characters would break
/// it, and become underscores; as_cell.
[[nodiscard]] std::string in_csv(std::string name);

/// Message for a file that cannot be written.
[[nodiscard]] std::string cannot_be_written(const std::filesystem::path& path, const std::string& reason = "");

}  // namespace abut::run
