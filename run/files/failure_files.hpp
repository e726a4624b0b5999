#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "abut/run/values/failure.hpp"

namespace abut::run {

/// Names of what is left of a run that failed: NAME.csv, NAME.svg.
inline constexpr std::string_view failure_name = "failed";
/// The series for ParaView of such a run.
[[nodiscard]] inline std::string failure_series(const std::string& series) { return series + "_failed"; }

/// Pictures of the bodies until a run has failed.
inline constexpr std::string_view failure_page = "failed.html";

/// Leaves in a folder the last sound state of a run that has failed, as a series of one frame for ParaView (displacement,
/// velocity and, where there is a lost state, the speed in it), and the place where it failed: a table of the cells (body,
/// cell, x, y, z, speed) and a picture of them. Returns a sentence about these files for the message of the error. Throws
/// BadInput or MeshError if one cannot be written.
template <int Dim>
[[nodiscard]] std::string write_failure(const std::filesystem::path& directory, const std::string& series,
                                        const Failure& failure, const Sight<Dim>& sound);

}  // namespace abut::run
