#pragma once
#include <filesystem>
#include <string>

namespace abut::apps {

/// Content of a folder of results: of a run that has ended what its summary.json says, of one that is under way or broke off
/// how far energy.csv.partial has come; and the files. Throws BadInput if neither is there, or if the summary is none.
[[nodiscard]] std::string results_info(const std::filesystem::path& folder);

}  // namespace abut::apps
