#pragma once
// Private to the sources of run.
#include <filesystem>
#include <optional>

#include "abut/run/values/run_comparison.hpp"

namespace abut::run {

/// Compares the first checkpoints that two folders of checkpoints have of the same step: positions, momenta and what the
/// scheme remembers, number by number. States of loads, materials and contact hold counts of searches, which may differ
/// between runs that are the same: whether they are bitwise identical is told, and is no difference of the runs.
/// Nothing where neither folder has a checkpoint.
/// A checkpoint that cannot be read is not compared, and a remark tells why.
[[nodiscard]] std::optional<PartComparison> compare_checkpoints(const std::filesystem::path& first,
                                                                const std::filesystem::path& second, double tolerance);

}  // namespace abut::run
