#pragma once
#include <filesystem>

#include "abut/run/values/run_comparison.hpp"

namespace abut::run {

/// Compares the results that two runs have left in their folders: settings and figures of summary.json, tables (.csv),
/// frames of VTU and VTP files, and checkpoints. Of a run that is under way or broke off what is there is compared.
///
/// A number is the same where every bit is; with a tolerance where it differs by at most `tolerance` times the largest
/// value of its column or field in either run. Fractions and texts of summary.json are not compared then.
/// Seconds, threads, version, folder and counts of searches may differ between runs that are the same, and are left out.
/// Throws BadInput for a folder that is no folder of results, and for runs of different dimensions.
[[nodiscard]] RunComparison compare_runs(const std::filesystem::path& first, const std::filesystem::path& second,
                                         double tolerance = 0.0);

}  // namespace abut::run
