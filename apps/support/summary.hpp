#pragma once
#include <nlohmann/json.hpp>

#include "apps/support/run.hpp"

namespace abut::examples {

/// summary.json: units are SI, drifts absolute and the largest of all records, "options" what was used.
template <int Dim>
[[nodiscard]] nlohmann::ordered_json summary(const Program& program, const Scene<Dim>& scene, const RunOptions& options,
                                             const RunResult<Dim>& result);

/// The table that closes a run.
template <int Dim>
void print_table(const Program& program, const Scene<Dim>& scene, const RunOptions& options, const RunResult<Dim>& result);

}  // namespace abut::examples
