#include "abut/run/steps/simulation.hpp"

#include <oneapi/tbb/global_control.h>

#include <optional>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/run/files/run_identity.hpp"
#include "abut/run/steps/of_all_ranks.hpp"
#include "abut/run/steps/pilot.hpp"
#include "abut/run/steps/start.hpp"
#include "abut/run/steps/time_loop.hpp"
#include "abut/run/user_words.hpp"
#include "abut/run/watch/slow_cell.hpp"
#include "abut/solid/body_interference.hpp"
#include "abut/solid/contact_view.hpp"

namespace abut::run {
namespace {

using oneapi::tbb::global_control;

/// As `simulate`, with the messages of all layers as they are.
template <int Dim>
RunResult<Dim> simulated(const Scene<Dim>& scene, const RunOptions& given, Observer<Dim>& observer, const Checkpoint* from,
                         const Share<Dim>& share) {
    check(given);
    dynamics::agreed(share.ranks, [&] { check_features(scene, given, share.ranks); });  // rank 0 knows faces of groups
    RunOptions options = with_defaults<Dim>(with_restart(given, scene));
    std::optional<global_control> threads;
    if (options.threads > 0)
        threads.emplace(global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
    RunSeconds seconds;
    std::optional<Start<Dim>> start;
    {
        const Stopwatch whole(seconds.total);
        {
            const Stopwatch watch(seconds.setup);
            on_first(share.ranks, [&] {
                if (!scene.contact) return;
                auto may_overlap =
                    solid::overlapping_bodies<Dim>(scene.mesh, scene.solid.interference, scene.solid.obstacles.size());
                may_overlap.insert(may_overlap.end(), scene.solid.ignored_pairs.begin(), scene.solid.ignored_pairs.end());
                mesh::check_apart(scene.mesh, scene.remedy_if_overlapping, options.contact.search.broad_phase, may_overlap);
            });
            std::optional<PilotReport> pilot;
            if (options.kinematics == BodyKinematics::automatic) pilot = choose_kinematics(scene, options);
            start.emplace(scene, options, std::move(pilot), share, observer);
        }
        RunResult<Dim>& result = start->result;
        if (options.interval == 0 && from && options.other_end) options.interval = recorded_interval(from->run);
        if (options.interval == 0) options.interval = records_interval<Dim>(result.run.steps, options.restart);
        result.options = options;
        result.contact.asked_law = options.law;
        if (start->solid->contact().reconstruction()) result.options.law = solid::ContactLaw::reconstruction;
        if (start->solid->contact().pair_potential()) result.options.law = solid::ContactLaw::pair_potential;
        result.run.threads = static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism));
        result.seconds.setup = seconds.setup;
        on_first(share.ranks, [&] { require_even_cells(scene, result); });
        take_steps(*start, observer, from);
    }
    start->result.seconds.total = seconds.total;
    return std::move(start->result);
}

}  // namespace

template <int Dim>
RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& options, Observer<Dim>& observer, const Checkpoint* from,
                        const Share<Dim>* share) {
    try {
        return simulated(scene, options, observer, from, share ? *share : Share<Dim>{scene.mesh, dynamics::one_rank()});
    } catch (const Error& error) {
        const std::string text = with_keys(in_user_words(error.what(), {scene.mesh.body_names, scene.outputs.obstacles}));
        if (text == error.what()) throw;
        throw_again(error, text);
    }
}

template RunResult<2> simulate<2>(const Scene<2>&, const RunOptions&, Observer<2>&, const Checkpoint*, const Share<2>*);
template RunResult<3> simulate<3>(const Scene<3>&, const RunOptions&, Observer<3>&, const Checkpoint*, const Share<3>*);

}  // namespace abut::run
