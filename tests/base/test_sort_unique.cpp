#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <set>

#include "abut/base/sort_unique.hpp"

using namespace abut;

TEST_CASE("values come increasing and once, few or many, near each other or far apart", "[base][sort]") {
    const std::size_t n = GENERATE(0u, 1u, 2u, 1000u, 1001u, 20'000u);
    const auto [least, most] = GENERATE(
        std::pair{0, 0}, std::pair{0, 63}, std::pair{-64, 64}, std::pair{-100'000, 100'000}, std::pair{17, 1'000'017},
        std::pair{std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()});
    CAPTURE(n, least, most);
    std::mt19937 random(1);
    std::uniform_int_distribution<std::int32_t> value(least, most);
    std::vector<std::int32_t> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(i == 0 ? most : i == 1 ? least : value(random));
    const std::set<std::int32_t> expected(values.begin(), values.end());
    sort_unique(values);
    CHECK(std::ranges::equal(values, expected));
}
