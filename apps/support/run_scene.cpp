#include "apps/support/run_scene.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <spdlog/spdlog.h>

#include <optional>
#include <stdexcept>
#include <string>

#include "abut/base/stopwatch.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/run/result_files.hpp"
#include "abut/run/simulation.hpp"
#include "abut/run/summary.hpp"
#include "apps/support/log.hpp"
#include "apps/support/progress.hpp"
#include "apps/support/signals.hpp"

namespace abut::apps {
namespace {

using oneapi::tbb::global_control;

/// A run that fails says what is left of it.
template <int Dim>
run::RunResult<Dim> simulate_into(run::ResultFiles<Dim>& files, const run::Scene<Dim>& scene,
                                  const run::RunOptions& options) {
    RunLog<Dim> log;
    ShowProgress<Dim> progress;
    StopOnSignal<Dim> stop;
    run::Observers<Dim> observers{log, files, progress, stop};
    const auto with_rest = [&](const char* what) {
        return what + std::string(files.has_begun() ? " energy.csv.partial holds the records so far." : "");
    };
    try {
        return run::simulate<Dim>(scene, options, observers);
    } catch (const Error& error) {
        throw_again(error, with_rest(error.what()));
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(with_rest(error.what()));
    }
}

template <int Dim>
run::Scene<Dim> timed_scene(const std::function<run::Scene<Dim>()>& make_scene, double& seconds) {
    const Stopwatch watch(seconds);
    return make_scene();
}

}  // namespace

template <int Dim>
void run_scene(const Program& program, const run::RunOptions& options, const std::function<run::Scene<Dim>()>& make_scene) {
    std::optional<global_control> threads;  // for the mesh, too
    if (options.threads > 0)
        threads.emplace(global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));

    run::ResultFiles<Dim> files(options, program.name, program.series);
    run::check(options);
    double seconds = 0.0;
    const run::Scene<Dim> scene = timed_scene(make_scene, seconds);
    const StopSignals signals;  // from here on there is something to save
    run::RunResult<Dim> result = simulate_into(files, scene, options);
    if (!result.complete)
        spdlog::warn("{}: the run ends after step {}; its files hold what was computed until then",
                     name_of_signal(noted_signal()), result.steps);
    result.seconds.mesh = seconds;
    result.seconds.total += seconds;
    files.finish(scene, result);
    log_warnings(run::warnings_after(result));
    fmt::print("{}{}", run::closing_table(program.name, scene, result), files.table());
}

template void run_scene<2>(const Program&, const run::RunOptions&, const std::function<run::Scene<2>()>&);
template void run_scene<3>(const Program&, const run::RunOptions&, const std::function<run::Scene<3>()>&);

}  // namespace abut::apps
