#include <catch2/catch.hpp>

#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "abut/base/parallel.hpp"

using namespace abut;

TEST_CASE("each part of a range, and each task, is done once, whatever their number", "[base]") {
    const std::size_t n = GENERATE(0, 1, 2, 7, 2048, 2049, 10'000);
    std::vector<std::atomic<int>> done(n);
    const auto once = [&] {
        for (auto& count : done)
            if (count.exchange(0) != 1) return false;
        return true;
    };
    parallel_ranges(static_cast<std::ptrdiff_t>(n), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        for (auto i = begin; i < end; ++i) ++done[static_cast<std::size_t>(i)];
    });
    CHECK(once());
    parallel_each(static_cast<std::ptrdiff_t>(n), [&](std::ptrdiff_t i) { ++done[static_cast<std::size_t>(i)]; });
    CHECK(once());
    parallel_tasks(n, [&](std::size_t i) { ++done[i]; });
    CHECK(once());
    std::atomic<std::size_t> too_long = 0;
    parallel_parts(n, 3, [&](std::size_t begin, std::size_t end) {
        if (end - begin > 3) too_long = end - begin;
        for (std::size_t i = begin; i < end; ++i) ++done[i];
    });
    CHECK(once());
    CHECK(too_long == 0);
}

TEST_CASE("what a loop writes is there when it has ended, and what was written before is seen by its tasks", "[base]") {
    std::vector<double> values(20'000);
    for (int round = 0; round < 20; ++round) {
        std::iota(values.begin(), values.end(), round);
        parallel_each(std::ssize(values), [&](std::ptrdiff_t i) { values[static_cast<std::size_t>(i)] *= 2.0; });
        const double n = 20'000.0, expected = n * (n - 1.0) + 2.0 * n * round;
        CHECK(ordered_sum(std::ssize(values), 0.0, [&](std::ptrdiff_t i) { return values[static_cast<std::size_t>(i)]; }) ==
              expected);
        CHECK(largest(std::ssize(values), [&](std::ptrdiff_t i) { return values[static_cast<std::size_t>(i)]; }) ==
              2.0 * (n - 1.0 + round));
    }
    values[777] = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(largest(std::ssize(values), [&](std::ptrdiff_t i) { return values[static_cast<std::size_t>(i)]; })));
}
