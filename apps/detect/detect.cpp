#include "apps/detect/detect.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "abut/base/counted.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/run/files/files.hpp"
#include "abut/run/result.hpp"
#include "apps/detect/output.hpp"
#include "apps/detect/report.hpp"
#include "apps/support/csv.hpp"
#include "apps/support/signals.hpp"
#include "apps/support/standard_streams.hpp"

namespace abut::apps {
namespace {

using oneapi::tbb::global_control;

constexpr int most_logged_steps = 20;
constexpr double many_sizes = 10.0;

Verification verified(const Bodies& bodies, const DetectOptions& options, const Nearness& near, const Detection& detection,
                      const StepResult& result) {
    const Requirement requirement{.distance = near.distance,
                                  .depth = near.depth,
                                  .facing_cosine = options.search.facing_cosine,
                                  .within_bodies = options.search.self_contact,
                                  .rings = options.search.self_contact_rings};
    const VerificationLimits limits{options.verify_tests, options.verify_samples, static_cast<std::uint64_t>(options.seed)};
    return verify(bodies.surface.view(), bodies.start, requirement, limits, detection.candidates(), result.overlaps);
}

void log_step(const StepResult& result, int steps) {
    if (steps == 0) return;  // `print` has it
    const int every = std::max(1, steps / most_logged_steps);
    if (result.step % every != 0 && result.step != steps) return;
    spdlog::info(
        "step {}/{}: {}{}, {}{}", result.step, steps, result.searched ? "new list, " : "",
        counted(result.candidates, "candidate"), counted(std::ssize(result.overlaps), "overlap"),
        result.overlaps.empty() ? "" : fmt::format(", {:.6g} m^2, least gap {:.6g} m", result.area, result.gap_min));
}

/// The steps one by one.
class Run {
public:
    Run(Bodies& bodies, const DetectOptions& options, const Motion& motion, DetectReport& report)
        : bodies_(bodies),
          options_(options),
          motion_(motion),
          report_(report),
          detection_(bodies, options, report.near, !motion.only_translates()),
          output_(bodies, options.out, options.write_every) {}

    void all_steps() {
        bool last = false;
        for (int step = 0; !last; ++step) last = one_step(step);
        report_.skin = detection_.skin();
        report_.search = detection_.report();
        report_.seconds.search = detection_.seconds_search();
        report_.seconds.narrow = detection_.seconds_narrow();
        report_.seconds.nearest = detection_.seconds_nearest();
        const Stopwatch watch(report_.seconds.writing);
        if (!options_.no_files) output_.finish();
    }

private:
    /// Whether it was the last one.
    bool one_step(int step) {
        if (step > 0) {
            const Stopwatch watch(report_.seconds.motion);
            motion_.move(bodies_, step);
        }
        const StepResult& result = detection_.find(step);
        log_step(result, motion_.steps());
        report_.decided += result.narrow.decided;
        report_.overlaps_max = std::max(report_.overlaps_max, static_cast<std::int64_t>(result.overlaps.size()));
        if (options_.verify) {
            const Stopwatch watch(report_.seconds.verification);
            report_.verification += verified(bodies_, options_, report_.near, detection_, result);
        }
        const bool at_end = step == motion_.steps(), last = at_end || noted_signal() != 0;
        if (last || (!options_.no_files && output_.writes_pairs(step))) detection_.measure_distances();
        write(result, last);
        if (!last) return false;
        report_.last = result;
        report_.steps = step;
        report_.complete = at_end;
        return true;
    }
    void write(const StepResult& result, bool last) {
        if (options_.no_files) return;
        const Stopwatch watch(report_.seconds.writing);
        output_.add(result, detection_.candidates(), last);
    }

    Bodies& bodies_;
    const DetectOptions& options_;
    const Motion& motion_;
    DetectReport& report_;
    Detection detection_;
    Output output_;
};

/// Boxes that reach far beyond their faces overlap many others: work and memory grow with the square of the ratio and more.
void warn_of_far_reach(const Bodies& bodies, const Nearness& near) {
    const double size = bodies.mean_face_size(), reach = std::max(near.distance, near.depth);
    if (reach > many_sizes * size)
        spdlog::warn(
            "--distance or --depth is {:.3g} m, {:.3g} times the mean size of a face: the search will take long. Give less, "
            "or bound it by --max-pairs",
            reach, reach / size);
}

void throw_if_missed(const Verification& verification) {
    if (verification.passed()) return;
    throw std::runtime_error(fmt::format(
        "--verify: {} pairs are missing among the candidates and {} among the overlaps, {} overlaps are wrong, of "
        "{} required; first: {}. This is a fault of the library: please report it with the meshes.",
        verification.missed_candidates, verification.missed_overlaps, verification.wrong_overlaps, verification.required,
        verification.first_fault));
}

}  // namespace

void detect(const DetectOptions& options) {
    std::optional<global_control> threads;
    if (options.threads > 0)
        threads.emplace(global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
    std::optional<run::FolderLock> lock;
    if (!options.no_files) lock = prepare_output(options.out);
    std::optional<GoOnWithoutReader> to_files;
    if (lock) to_files.emplace();
    DetectTimes seconds;
    Bodies bodies = read_bodies(options, seconds.input);
    if (bodies.names.size() == 1 && !options.search.self_contact)
        spdlog::warn("one body alone has nothing to touch: give another, or --self, or --connected if it has several parts");
    const Motion motion(options, bodies);
    motion.move(bodies, 0);
    const Nearness near = nearness(options, bodies, motion);
    set_depth(bodies, near.depth, near.distance);
    warn_of_far_reach(bodies, near);
    DetectReport report{.bodies = bodies, .near = near, .verified = options.verify, .seconds = seconds};
    std::optional<Run> steps;
    {
        const Stopwatch watch(report.seconds.setup);
        steps.emplace(bodies, options, motion, report);
    }
    const StopSignals signals;
    steps->all_steps();
    if (!report.complete)
        spdlog::warn("{}: ends after step {} of {}", name_of_signal(noted_signal()), report.steps, motion.steps());
    if (!options.no_files) write_json(options.out / "summary.json", summary(report, options));
    print(report, options);
    throw_if_missed(report.verification);
}

}  // namespace abut::apps
