#include "apps/support/log.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace abut::apps {

void log_warnings(const std::vector<run::Warning>& warnings, const std::string& run) {
    const std::string prefix = run.empty() ? "" : run + ": ";
    for (const run::Warning& warning : warnings)
        spdlog::log(warning.severity == run::Severity::note ? spdlog::level::info : spdlog::level::warn, "{}{}", prefix,
                    warning.text);
}

std::vector<run::Warning> only(std::vector<run::Warning> warnings, std::initializer_list<run::WarningKind> kinds) {
    std::erase_if(warnings, [&](const run::Warning& warning) {
        return std::find(kinds.begin(), kinds.end(), warning.kind) == kinds.end();
    });
    return warnings;
}

template <int Dim>
void RunLog<Dim>::begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) {
    spdlog::info("{} cells, {} boundary faces; {} steps of {:.4g} s", scene.mesh.n_cells(), scene.mesh.boundary_faces.size(),
                 result.steps, result.dt);
    if (result.pilot) spdlog::info("kinematics: {}", run::text_of(*result.pilot, scene.mesh.body_names));
    log_warnings(run::warnings_before(scene, result));
}

template <int Dim>
void RunLog<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, const run::RunResult<Dim>& result) {
    if (warned_) return;
    const auto warnings = run::warnings_during(entry.step, result);
    warned_ = !warnings.empty();
    log_warnings(warnings);
}

template class RunLog<2>;
template class RunLog<3>;

}  // namespace abut::apps
