#pragma once
// Private to the sources of the layers.
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "abut/base/fork_join.hpp"

namespace abut {

inline constexpr std::ptrdiff_t parallel_grain = 1024;

/// Threads that work at once here: the arena's slots, unless the host has allowed fewer.
inline std::int32_t thread_limit() {
    const auto allowed = oneapi::tbb::global_control::active_value(oneapi::tbb::global_control::max_allowed_parallelism);
    return static_cast<std::int32_t>(
        std::min<std::size_t>(allowed, static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency())));
}

/// Calls body(begin, end) on parts of [0, n), concurrently when n is worth it. What is computed for one index must not
/// depend on the parts.
template <class Body>
void parallel_ranges(std::ptrdiff_t n, const Body& body, std::ptrdiff_t grain = parallel_grain) {
    if (n <= 2 * grain) {
        body(std::ptrdiff_t{0}, n);
        return;
    }
    const auto in_range = [&](const oneapi::tbb::blocked_range<std::ptrdiff_t>& range) { body(range.begin(), range.end()); };
    ForkJoin loop;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::ptrdiff_t>(0, n, grain), OrderedBody(loop, in_range),
                              oneapi::tbb::static_partitioner{});
}

template <class Body>
void parallel_each(std::ptrdiff_t n, const Body& body, std::ptrdiff_t grain = parallel_grain) {
    parallel_ranges(
        n,
        [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
            for (std::ptrdiff_t i = begin; i < end; ++i) body(i);
        },
        grain);
}

/// Calls body(i) for i in [0, n), concurrently, each by itself: for work that is worth a task, and may be uneven.
template <class Index, class Body, class Partitioner = oneapi::tbb::auto_partitioner>
void parallel_tasks(Index n, const Body& body, const Partitioner& partitioner = {}) {
    ForkJoin loop;
    oneapi::tbb::parallel_for(Index{0}, n, OrderedBody(loop, body), partitioner);
}

/// Calls body(begin, end) on parts of [0, n) of that size, concurrently: as parallel_ranges, for work that may be uneven.
template <class Body>
void parallel_parts(std::size_t n, std::size_t size, const Body& body) {
    parallel_tasks((n + size - 1) / size, [&](std::size_t i) { body(i * size, std::min(n, (i + 1) * size)); });
}

/// Sum of term(i) over [0, n): blocks of fixed size, then the blocks in order, so that the bits depend on n alone.
template <class Value, class Term>
Value ordered_sum(std::ptrdiff_t n, const Value& zero, const Term& term) {
    const auto sum_of_block = [&](std::ptrdiff_t block) {
        Value sum = zero;
        const std::ptrdiff_t end = std::min(n, (block + 1) * parallel_grain);
        for (std::ptrdiff_t i = block * parallel_grain; i < end; ++i) sum += term(i);
        return sum;
    };
    const std::ptrdiff_t n_blocks = (n + parallel_grain - 1) / parallel_grain;
    Value total = zero;
    if (n_blocks <= 2) {
        for (std::ptrdiff_t block = 0; block < n_blocks; ++block) total += sum_of_block(block);
        return total;
    }
    std::vector<Value> sums(static_cast<std::size_t>(n_blocks), zero);
    parallel_tasks(n_blocks, [&](std::ptrdiff_t block) { sums[static_cast<std::size_t>(block)] = sum_of_block(block); });
    for (const Value& sum : sums) total += sum;
    return total;
}

/// The larger of two; NaN if one of them is: a state that has diverged must not pass for a small one.
inline double larger(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

/// Largest value(i) >= 0 over [0, n), 0 for n = 0; NaN if one of them is. Concurrently for n above twice `grain`.
template <class Value>
double largest(std::ptrdiff_t n, const Value& value, std::ptrdiff_t grain = parallel_grain) {
    const auto in_range = [&](const oneapi::tbb::blocked_range<std::ptrdiff_t>& range, double so_far) {
        for (std::ptrdiff_t i = range.begin(); i < range.end(); ++i) so_far = larger(so_far, value(i));
        return so_far;
    };
    const oneapi::tbb::blocked_range<std::ptrdiff_t> all(0, n, grain);
    if (n <= 2 * grain) return in_range(all, 0.0);
    ForkJoin loop;
    return oneapi::tbb::parallel_reduce(all, 0.0, OrderedBody(loop, in_range), larger);
}

}  // namespace abut
