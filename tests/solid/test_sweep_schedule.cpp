#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <random>

#include "abut/solid/ccg/sweep_schedule.hpp"

using namespace abut;

namespace {

inline constexpr int stages = 4;
using Needs = std::array<std::vector<std::vector<std::int32_t>>, stages - 1>;

/// Chunks need some of those near them and, now and then, one far away or none at all.
Needs random_needs(std::mt19937& random, std::int32_t n_chunks) {
    Needs needs;
    std::uniform_int_distribution<std::int32_t> any(0, n_chunks - 1), near(-2, 2), number(0, 3), rare(0, 30);
    for (auto& stage : needs)
        for (std::int32_t k = 0; k < n_chunks; ++k) {
            auto& row = stage.emplace_back();
            for (std::int32_t i = number(random); i > 0; --i) row.push_back(std::clamp(k + near(random), 0, n_chunks - 1));
            if (rare(random) == 0) row.push_back(any(random));
        }
    return needs;
}

}  // namespace

TEST_CASE("a sweep schedule runs every task once, each after what it needs, on any number of threads", "[solid][schedule]") {
    std::mt19937 random(3);
    for (const std::int32_t n_chunks : {1, 2, 7, 16, 33, 100}) {
        const Needs needs = random_needs(random, n_chunks);
        solid::SweepSchedule<stages> schedule(n_chunks, needs);
        for (int repetition = 0; repetition < 20; ++repetition)
            for (const int threads : {1, 2, 4}) {  // one schedule sees them change
                const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                                          static_cast<std::size_t>(threads));
                oneapi::tbb::task_arena arena(threads);
                std::vector<std::atomic<int>> runs(static_cast<std::size_t>(stages * n_chunks));
                std::atomic<int> too_early = 0;
                const auto at = [&](int stage, std::int32_t chunk) -> std::atomic<int>& {
                    return runs[static_cast<std::size_t>(stage * n_chunks + chunk)];
                };
                arena.execute([&] {
                    schedule.run([&](int stage, std::int32_t chunk) {
                        if (stage > 0)
                            for (const std::int32_t needed :
                                 needs[static_cast<std::size_t>(stage - 1)][static_cast<std::size_t>(chunk)])
                                if (at(stage - 1, needed) != 1) ++too_early;
                        ++at(stage, chunk);
                    });
                });
                CHECK(too_early == 0);
                CHECK(std::all_of(runs.begin(), runs.end(), [](const auto& n) { return n == 1; }));
            }
    }
}
