#include "apps/support/log.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "apps/support/terminal.hpp"

#include "abut/base/counted.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"

namespace abut::apps {
namespace {

constexpr std::size_t time_width = 11;  // "[12:34:56] " before each line of the log

/// As long lines as the terminal has, those that follow beneath the text of the first.
std::string beside_time(const std::string& text) {
    const auto width = terminal_width(STDOUT_FILENO);
    if (!width || *width < 3 * time_width) return text;
    std::string lines = wrapped(text, *width - time_width);
    for (std::size_t end = lines.find('\n'); end != std::string::npos; end = lines.find('\n', end + 1))
        lines.insert(end + 1, time_width, ' ');
    return lines;
}

}  // namespace

void log_warnings(const std::vector<run::Warning>& warnings, const std::string& run) {
    const std::string prefix = run.empty() ? "" : run + ": ";
    for (const run::Warning& warning : warnings) {
        const bool is_note = warning.severity == run::Severity::note;
        spdlog::log(is_note ? spdlog::level::info : spdlog::level::warn, "{}",
                    beside_time(prefix + (is_note ? "note: " : "warning: ") + warning.text));
    }
}

std::vector<run::Warning> only(std::vector<run::Warning> warnings, std::initializer_list<run::WarningKind> kinds) {
    std::erase_if(warnings, [&](const run::Warning& warning) {
        return std::find(kinds.begin(), kinds.end(), warning.kind) == kinds.end();
    });
    return warnings;
}

template <int Dim>
void RunLog<Dim>::begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) {
    spdlog::info("{}, {}; {} of {:.4g} s", counted(scene.mesh.n_cells(), "cell"),
                 counted(std::ssize(scene.mesh.boundary_faces), "boundary face"), counted(result.run.steps, "step"),
                 result.run.dt);
    if (result.run.pilot) spdlog::info("kinematics: {}", run::text_of(*result.run.pilot, scene.mesh.body_names));
    log_warnings(run::warnings_before(scene, result));
}

template <int Dim>
void RunLog<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, const run::RunResult<Dim>& result) {
    const auto warnings = run::warnings_during(entry.step, result);
    std::vector<run::Warning> fresh;
    std::size_t sightings = 0;
    for (const run::Warning& warning : warnings)
        if (warning.kind == run::WarningKind::compression) {
            if (!std::exchange(warned_of_compression_, true)) fresh.push_back(warning);
        } else if (++sightings > sightings_said_) {
            fresh.push_back(warning);
        }
    sightings_said_ = sightings;
    log_warnings(fresh);
}

template class RunLog<2>;
template class RunLog<3>;

}  // namespace abut::apps
