#include "apps/support/run_scene.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/run/files/checkpoint_folder.hpp"
#include "abut/run/files/frames.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/solid/options/options.hpp"
#include "apps/support/json_lines.hpp"
#include "apps/support/log.hpp"
#include "apps/support/progress.hpp"
#include "apps/support/rank_session.hpp"
#include "apps/support/scene_of_rank.hpp"
#include "apps/support/signals.hpp"
#include "apps/support/standard_streams.hpp"

namespace abut::apps {
namespace {

using oneapi::tbb::global_control;

/// A run that fails says what is left of it.
template <int Dim>
run::RunResult<Dim> simulate_into(run::ResultFiles<Dim>& files, const run::Scene<Dim>& scene, const run::RunOptions& options,
                                  const run::Checkpoint* from, const run::Share<Dim>* share, Messages messages,
                                  JsonLines<Dim>& lines) {
    RunLog<Dim> log;
    ShowProgress<Dim> progress;
    StopOnSignal<Dim> stop;
    run::Observers<Dim> observers{files, stop};
    if (messages == Messages::normal) observers = {log, files, progress, stop};
    if (messages == Messages::json) observers = {lines, files, stop};
    const auto with_rest = [&](const char* what) { return what + files.left_behind(); };
    try {
        return run::simulate<Dim>(scene, options, observers, from, share);
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

/// Kinematics of the bodies, none where all are `small`. What is refused on several ranks is left to the run.
template <int Dim>
std::vector<solid::Kinematics> kinematics_of(const run::Scene<Dim>& scene, const run::RunOptions& options) {
    const auto of_all = run::kinematics_of_all(options.kinematics);
    return of_all ? std::vector(scene.mesh.body_names.size(), *of_all) : scene.solid.kinematics;
}

template <int Dim>
run::Scene<Dim> timed_scene(const MakeScene<Dim>& make_scene, double& seconds) {
    const Stopwatch watch(seconds);
    return scene_of_rank(make_scene);
}

/// A checkpoint that one rank could not read would let it go on from another one.
void require_same_step(const std::optional<run::Checkpoint>& from) {
    if (!rank_session()) return;
    const ranks::Communicator& all = rank_session()->all();
    const double step = from ? static_cast<double>(from->motion.steps) : -1.0, last = all.largest(step),
                 first = -all.largest(-step);
    if (first != last)
        throw BadInput(
            fmt::format("the ranks have read different checkpoints, of steps {} and {}. Give all machines the same "
                        "folder of --out.",
                        first, last));
}

/// The threads of a machine are shared by the ranks on it.
int threads_of(const run::RunOptions& options) {
    const ranks::Session* session = rank_session();
    if (options.threads > 0 || !session) return options.threads;
    return std::max(1, oneapi::tbb::this_task_arena::max_concurrency() / session->ranks_on_this_machine());
}

/// On rank 0, or alone: files, messages and a closing table.
template <int Dim>
void run_and_write(const Program& program, const run::RunOptions& options, const MakeScene<Dim>& make_scene) {
    std::optional<run::ResultFiles<Dim>> files;
    std::optional<run::Checkpoint> from;
    double seconds = 0.0;
    if (!program.note.empty()) spdlog::warn("{}", program.note);
    if (!program.note.empty() && program.messages == Messages::json) json_note(program.note);
    on_all([&] {
        files.emplace(options, program.name, program.series);
        for (const auto& [name, text] : program.beside_checkpoints) files->keep_beside_checkpoints(name, text);
        run::check(options);
        from = last_checkpoint(*files, options);
    });
    require_same_step(from);
    const run::Scene<Dim> scene = timed_scene(make_scene, seconds);
    const StopSignals signals;  // from here on there is something to save
    JsonLines<Dim> lines(program.name);
    const SceneShare<Dim> share(scene.mesh, kinematics_of(scene, options));
    run::RunResult<Dim> result =
        simulate_into(*files, scene, options, from ? &*from : nullptr, share.get(), program.messages, lines);
    if (!result.run.complete)
        spdlog::warn("{}: the run ends after step {}; its files hold what was computed until then{}",
                     name_of_signal(noted_signal()), result.run.steps, how_to_go_on(options));
    result.seconds.mesh = seconds;
    result.seconds.total += seconds;
    files->finish(scene, result);
    if (program.messages == Messages::json) lines.end(result, noted_signal() == 0 ? 0 : exit_code_of(noted_signal()));
    if (program.messages != Messages::normal) return;
    log_warnings(run::warnings_after(result));
    say(run::closing_table(program.name, scene, result) + files->table());
}

/// On the other ranks: the run, and their pieces of frames. Each reads the checkpoint that rank 0 has found for itself.
template <int Dim>
void run_beside(const Program& program, const run::RunOptions& options, const MakeScene<Dim>& make_scene) {
    std::optional<run::Checkpoint> from;
    on_all([&] {
        run::check(options);
        if (options.resume) from = run::CheckpointFolder(options.out / "checkpoints").last().checkpoint;
    });
    require_same_step(from);
    const run::Scene<Dim> scene = scene_of_rank(make_scene);
    const StopSignals signals;  // rank 0 decides
    const SceneShare<Dim> share(scene.mesh, kinematics_of(scene, options));
    run::PieceFiles<Dim> files(options.out, program.series, scene.outputs.fields);
    static_cast<void>(run::simulate<Dim>(scene, options, files, from ? &*from : nullptr, share.get()));
}

}  // namespace

template <int Dim>
void run_scene(const Program& program, const run::RunOptions& given, const MakeScene<Dim>& make_scene) {
    start_ranks(given.ranks);
    const GoOnWithoutReader to_files;
    set_log(program.messages);
    run::RunOptions options = given;
    options.threads = threads_of(given);
    std::optional<global_control> threads;  // for the mesh, too
    if (options.threads > 0)
        threads.emplace(global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
    if (rank_session() && rank_session()->all().rank() > 0)
        run_beside<Dim>(program, options, make_scene);
    else
        run_and_write<Dim>(program, options, make_scene);
}

template void run_scene<2>(const Program&, const run::RunOptions&, const MakeScene<2>&);
template void run_scene<3>(const Program&, const run::RunOptions&, const MakeScene<3>&);

}  // namespace abut::apps
