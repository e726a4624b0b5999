#include "apps/support/run_scene.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <spdlog/spdlog.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "abut/base/stopwatch.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/run/result_files.hpp"
#include "abut/run/simulation.hpp"
#include "abut/run/summary.hpp"
#include "apps/support/json_lines.hpp"
#include "apps/support/log.hpp"
#include "apps/support/progress.hpp"
#include "apps/support/signals.hpp"

namespace abut::apps {
namespace {

using oneapi::tbb::global_control;

/// A run that fails says what is left of it.
template <int Dim>
run::RunResult<Dim> simulate_into(run::ResultFiles<Dim>& files, const run::Scene<Dim>& scene, const run::RunOptions& options,
                                  const run::Checkpoint* from, Messages messages, JsonLines<Dim>& lines) {
    RunLog<Dim> log;
    ShowProgress<Dim> progress;
    StopOnSignal<Dim> stop;
    run::Observers<Dim> observers{files, stop};
    if (messages == Messages::normal) observers = {log, files, progress, stop};
    if (messages == Messages::json) observers = {lines, files, stop};
    const auto with_rest = [&](const char* what) { return what + files.left_behind(); };
    try {
        return run::simulate<Dim>(scene, options, observers, from);
    } catch (const Error& error) {
        throw_again(error, with_rest(error.what()));
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(with_rest(error.what()));
    }
}

/// With a word about those that are of no use; nothing unless the run goes on.
template <int Dim>
std::optional<run::Checkpoint> last_checkpoint(const run::ResultFiles<Dim>& files, const run::RunOptions& options) {
    if (!options.resume) return {};
    auto found = files.last_checkpoint();
    for (const std::string& why : found.refused) spdlog::warn("{}", why);
    spdlog::info("{}: goes on after step {}", found.path.string(), found.checkpoint.motion.steps);
    return std::move(found.checkpoint);
}

std::string how_to_go_on(const run::RunOptions& options) {
    if (options.checkpoint == 0.0 && options.checkpoint_steps == 0) return "";
    return ", and --resume goes on from there (abut restart " + options.out.string() + " with a scene in TOML)";
}

template <int Dim>
run::Scene<Dim> timed_scene(const std::function<run::Scene<Dim>()>& make_scene, double& seconds) {
    const Stopwatch watch(seconds);
    return make_scene();
}

}  // namespace

template <int Dim>
void run_scene(const Program& program, const run::RunOptions& options, const std::function<run::Scene<Dim>()>& make_scene) {
    set_log(program.messages);
    std::optional<global_control> threads;  // for the mesh, too
    if (options.threads > 0)
        threads.emplace(global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));

    run::ResultFiles<Dim> files(options, program.name, program.series);
    for (const auto& [name, text] : program.beside_checkpoints) files.keep_beside_checkpoints(name, text);
    run::check(options);
    const std::optional<run::Checkpoint> from = last_checkpoint(files, options);
    double seconds = 0.0;
    const run::Scene<Dim> scene = timed_scene(make_scene, seconds);
    const StopSignals signals;  // from here on there is something to save
    JsonLines<Dim> lines(program.name);
    run::RunResult<Dim> result = simulate_into(files, scene, options, from ? &*from : nullptr, program.messages, lines);
    if (!result.complete)
        spdlog::warn("{}: the run ends after step {}; its files hold what was computed until then{}",
                     name_of_signal(noted_signal()), result.steps, how_to_go_on(options));
    result.seconds.mesh = seconds;
    result.seconds.total += seconds;
    files.finish(scene, result);
    if (program.messages == Messages::json) lines.end(result, noted_signal() == 0 ? 0 : exit_code_of(noted_signal()));
    if (program.messages != Messages::normal) return;
    log_warnings(run::warnings_after(result));
    fmt::print("{}{}", run::closing_table(program.name, scene, result), files.table());
}

template void run_scene<2>(const Program&, const run::RunOptions&, const std::function<run::Scene<2>()>&);
template void run_scene<3>(const Program&, const run::RunOptions&, const std::function<run::Scene<3>()>&);

}  // namespace abut::apps
