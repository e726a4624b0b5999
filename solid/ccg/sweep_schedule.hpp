#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "abut/base/parallel.hpp"

namespace abut::solid {

/// An order in which several sweeps over the chunks of a mesh can run together, each task as soon as what it reads is there,
/// so that what one sweep writes is still in cache when the next one reads it. Chunks follow the layers of the mesh: what a
/// chunk needs of another sweep lies mostly close by.
///
/// A task is (stage, chunk). Stage 0 needs nothing; a task of stage s needs the tasks (s - 1, j) for j in needs(s, chunk).
/// The order changes no result: every task writes its own elements only.
template <int Stages>
class SweepSchedule {
public:
    SweepSchedule() = default;

    /// needs[s - 1][k]: chunks of stage s - 1 that task (s, k) reads, for s = 1 .. Stages - 1.
    SweepSchedule(std::int32_t n_chunks, const std::array<std::vector<std::vector<std::int32_t>>, Stages - 1>& needs)
        : n_chunks_(n_chunks) {
        spans_[0].resize(static_cast<std::size_t>(n_chunks));
        for (std::int32_t k = 0; k < n_chunks; ++k) spans_[0][k] = {k, k};
        for (int s = 1; s < Stages; ++s)
            for (std::int32_t k = 0; k < n_chunks; ++k) {
                Span span{k, k};
                for (const std::int32_t j : needs[s - 1][k]) {
                    span.first = std::min(span.first, spans_[s - 1][j].first);
                    span.last = std::max(span.last, spans_[s - 1][j].last);
                }
                spans_[s].push_back(span);
            }
    }

    /// Calls task(stage, chunk) for every task. Each thread takes a run of chunks through all stages as far as they do not
    /// need another thread's; the rest follows stage by stage. Allocates where the number of threads differs from before.
    template <class Work>
    void run(const Work& work) {
        const std::int32_t n_parts = std::clamp<std::int32_t>(thread_limit(), 1, std::max(1, n_chunks_ / chunks_a_part));
        if (std::ssize(parts_) != n_parts) share_out(n_parts);
        const auto run_part = [&](std::int32_t part) {
            for (const Task& task : parts_[static_cast<std::size_t>(part)]) work(task.stage, task.chunk);
        };
        if (n_parts == 1) return run_part(0);
        parallel_tasks(n_parts, run_part, oneapi::tbb::static_partitioner{});
        for (int s = 1; s < Stages; ++s) parallel_tasks(rest_[s].size(), [&](std::size_t i) { work(s, rest_[s][i]); });
    }

private:
    static constexpr std::int32_t chunks_a_part = 8;  // fewer are not worth a thread of their own

    struct Task {
        int stage;
        std::int32_t chunk;
    };
    struct Span {  // of stage 0 that a task depends on through all stages
        std::int32_t first;
        std::int32_t last;
    };

    static bool is_inside(Span span, std::int32_t begin, std::int32_t end) { return span.first >= begin && span.last < end; }

    /// A part has the tasks of its chunks that depend on these chunks only, each when the last of them is through stage 0.
    void share_out(std::int32_t n_parts) {
        parts_.assign(static_cast<std::size_t>(n_parts), {});
        for (auto& chunks : rest_) chunks.clear();
        for (std::int32_t part = 0; part < n_parts; ++part) {
            const auto begin = static_cast<std::int32_t>(std::int64_t{n_chunks_} * part / n_parts);
            const auto end = static_cast<std::int32_t>(std::int64_t{n_chunks_} * (part + 1) / n_parts);
            std::vector<Task>& tasks = parts_[static_cast<std::size_t>(part)];
            for (int s = 0; s < Stages; ++s)
                for (std::int32_t k = begin; k < end; ++k)
                    if (is_inside(spans_[s][k], begin, end))
                        tasks.push_back({s, k});
                    else
                        rest_[s].push_back(k);
            std::ranges::sort(tasks, {}, [&](const Task& task) {
                return std::tuple(spans_[task.stage][task.chunk].last, task.stage, task.chunk);
            });
        }
    }

    std::int32_t n_chunks_ = 0;
    std::array<std::vector<Span>, Stages> spans_;
    std::vector<std::vector<Task>> parts_;
    std::array<std::vector<std::int32_t>, Stages> rest_;
};

}  // namespace abut::solid
