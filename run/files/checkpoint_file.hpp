#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "abut/run/values/checkpoint.hpp"

namespace abut::run {

/// Writes a checkpoint as HDF5, docs/checkpoints.md: beside its place, to the disc, then moved there, so that no
/// half-written one is ever seen. Throws BadInput if it cannot be written; nothing is left of it then.
void write_checkpoint(const Checkpoint& checkpoint, const std::filesystem::path& path);

/// Throws BadInput for a file that is not there, damaged, no checkpoint, or of another version of the format. Nothing is
/// asked of HDF5 before the checksum of the file has been found right.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace abut::run
