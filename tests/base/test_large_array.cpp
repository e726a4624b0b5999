#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "abut/base/large_array.hpp"

using abut::LargeArray;

TEST_CASE(
    "large arrays begin on a cache line and keep what they hold, small and large, as they grow, are copied and swapped",
    "[base][large]") {
    const auto is_on_cache_line = [](const LargeArray<double>& a) {
        return reinterpret_cast<std::uintptr_t>(a.data()) % 64 == 0;
    };
    for (const std::size_t n : {1, 1000, 262143, 262144, 1000000}) {  // 262,144 doubles are 2 MiB
        LargeArray<double> a(n), b;
        std::iota(a.begin(), a.end(), 1.0);
        for (std::size_t i = 0; i < n; ++i) b.push_back(static_cast<double>(i));
        LargeArray<double> copy = a;
        std::swap(copy, b);
        REQUIRE(copy.size() == n);
        for (const auto* array : {&a, &b, &copy}) CHECK(is_on_cache_line(*array));
        double worst = 0.0;
        for (std::size_t i = 0; i < n; ++i) worst = std::max({worst, std::abs(a[i] - b[i]), std::abs(a[i] - copy[i] - 1.0)});
        CHECK(worst == 0.0);
    }
}

TEST_CASE("an empty large array is given back", "[base][large]") {
    LargeArray<int> a;
    a.assign(3, 7);
    a.clear();
    a.shrink_to_fit();
    CHECK(a.empty());
    CHECK(LargeArray<int>{} == a);
}
