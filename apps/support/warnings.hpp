#pragma once
#include <string>

#include "apps/support/run.hpp"

namespace abut::examples {

/// Warns of corners that contact will not see: known before the first step.
template <int Dim>
void warn_of_corners(const RunResult<Dim>& result);

/// Warns of faces that were pressed in deep.
template <int Dim>
void warn_of_compression(const RunResult<Dim>& result, const std::string& run = "");

/// Warns of what happened in contact and does not show in H~. `run` says which one of several it was: "100 cells".
/// docs/limits.md, docs/validation.md.
template <int Dim>
void warn_of_contact(const RunResult<Dim>& result, const std::string& run = "");

}  // namespace abut::examples
