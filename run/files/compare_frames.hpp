#pragma once
// Private to the sources of run.
#include <filesystem>

#include "abut/run/values/run_comparison.hpp"

namespace abut::run {

/// Compares the frames that two lists of ParaView name (.pvd) by their numbers: times, then all values of .vtu and .vtp
/// files. The first value that differs is that of the first frame, of this the first field. Without a tolerance largest
/// values of fields are those of the frames that are not the same byte by byte. Frames in pieces are not compared, which a
/// remark tells. Throws BadInput or MeshError naming a file that is damaged, or that a list names and that is not there.
[[nodiscard]] PartComparison compare_frames(const std::filesystem::path& first, const std::filesystem::path& second,
                                            double tolerance);

}  // namespace abut::run
