#pragma once
// Private to the sources of run.
#include <filesystem>

#include "abut/run/values/run_comparison.hpp"

namespace abut::run {

/// Compares two tables of comma-separated values row by row, in one pass. Of the values only differences that are larger
/// than all before them are kept. Rows belong together by their number. They end to where a step or a text differs, as the
/// names of two bodies: what follows is about other things. Columns that both have are compared, by their headings. A last
/// line without its end is half-written, and left out. Throws BadInput naming a file that cannot be read.
[[nodiscard]] PartComparison compare_tables(const std::filesystem::path& first, const std::filesystem::path& second,
                                            double tolerance);

}  // namespace abut::run
