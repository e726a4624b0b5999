#pragma once
// Private to the sources of run.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "abut/run/drawing/markup.hpp"

namespace abut::run {

/// Steps of a run and of its tables.
struct SampledRun {
    std::int64_t steps = 0;
    std::int64_t interval = 1;  ///< steps between rows
    double dt = 0.0;            ///< [s]
};

/// Forces of a table as ForceFile writes it, over time: a figure for each of the few pairs that press each other the
/// most; means over a thousandth of the run where there are more rows. Nothing where nobody touches. Throws BadInput if the
/// file cannot be read.
[[nodiscard]] Markup force_pictures(const std::filesystem::path& table, const SampledRun& run);

/// Displacement and, where there is stress, von Mises stress of the first few probes of a table as ProbeFile writes it, over
/// time. Of a table of very many rows some are left out, equally far apart. Throws as force_pictures.
[[nodiscard]] Markup probe_pictures(const std::filesystem::path& table, const std::vector<std::string>& probes);

}  // namespace abut::run
