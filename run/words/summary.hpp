#pragma once
#include <string>

#include "abut/run/values/forward.hpp"

namespace abut::run {

/// The text of summary.json: units are SI, drifts absolute and the largest of all records, "options" what was used.
/// `program` is what it calls the run.
template <int Dim>
[[nodiscard]] std::string summary_json(const std::string& program, const Scene<Dim>& scene, const RunResult<Dim>& result);

/// The lines that close a run on a terminal: the verdict, then the figures that people look at first. All others are in the
/// summary. Each line ends with a line feed.
template <int Dim>
[[nodiscard]] std::string closing_table(const std::string& program, const Scene<Dim>& scene, const RunResult<Dim>& result);

}  // namespace abut::run
