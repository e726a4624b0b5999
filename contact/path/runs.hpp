#pragma once
// Private to the layer.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/contact/shared_work.hpp"

namespace abut::contact {

inline constexpr std::size_t run_length = 64;

[[nodiscard]] inline std::size_t number_of_runs(const IndexRange& range) {
    return (range.size() + run_length - 1) / run_length;
}

/// Calls body(begin, end, work) for runs of a range, concurrently, run i with the work area work[i]. What it does for one
/// index must not depend on the runs.
template <class Work, class Body>
void for_each_run(const IndexRange& range, std::vector<Work>& work, const Body& body) {
    const std::size_t n_runs = number_of_runs(range);
    if (work.size() < n_runs) work.resize(n_runs);
    const auto run = [&](std::size_t i) {
        const std::size_t begin = range.begin + i * run_length;
        body(begin, std::min(range.end, begin + run_length), work[i]);
    };
    if (n_runs <= 2)
        for (std::size_t i = 0; i < n_runs; ++i) run(i);
    else
        parallel_tasks(n_runs, run);
}

/// Adds both ends to the cuts of an interval and sorts them.
inline void sort_and_close(std::vector<double>& cuts, double begin, double end) {
    cuts.push_back(begin);
    cuts.push_back(end);
    std::sort(cuts.begin(), cuts.end());
}

}  // namespace abut::contact
