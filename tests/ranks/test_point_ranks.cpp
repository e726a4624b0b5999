#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/vector.hpp"
#include "abut/dynamics/highest_mode.hpp"
#include "abut/dynamics/mass.hpp"
#include "abut/dynamics/sum_over.hpp"
#include "abut/ranks/point_ranks.hpp"
#include "ranks/world.hpp"

using namespace abut;
using namespace abut::ranks;

namespace {

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Sums of these depend on the order.
double term(std::int64_t i) {
    return std::sin(1.0 + 0.37 * static_cast<double>(i)) * std::pow(10.0, static_cast<double>(i % 7));
}

SharedPoints points_of(const Communicator& all, std::int32_t n, int empty_rank = -1) {
    SharedPoints points{.dimension = 3, .n_points = n, .numbers = test::scattered(n, all.rank(), all.size(), empty_rank)};
    points.n_entries = points.numbers.size();
    for (std::size_t i = 0; i < points.numbers.size(); ++i) points.position.push_back(static_cast<std::int32_t>(i));
    return points;
}

}  // namespace

TEST_CASE("a sum over ranks has the bits of the same sum on one rank", "[ranks]") {
    const Communicator all = test::world();
    const std::int32_t n = GENERATE(0, 1, 1023, 1025, 20'000);
    const int empty_rank = GENERATE(-1, 0);
    if (empty_rank == 0 && all.size() == 1) return;
    const PointRanks ranks(all, points_of(all, n, empty_rank));
    const auto numbers = ranks.numbers();
    for (const std::int32_t per_point : {1, 3}) {
        const double expected = ordered_sum(std::ptrdiff_t{per_point} * n, 0.0, term);
        const auto n_here = static_cast<std::ptrdiff_t>(numbers.size()) * per_point;
        const auto here = [&](std::ptrdiff_t i) {
            return term(std::int64_t{per_point} * numbers[i / per_point] + i % per_point);
        };
        for (int repeated = 0; repeated < 2; ++repeated)
            CHECK(same_bits(dynamics::sum_over(ranks, {.per_point = per_point}, n_here, 0.0, here), expected));
    }
    const auto vector_term = [](std::int64_t i) { return Vector<3>(term(i), term(i + 1), term(2 * i)); };
    const Vector<3> zero = Vector<3>::Zero();
    const Vector<3> expected = ordered_sum(n, zero, vector_term);
    const Vector<3> sum =
        dynamics::sum_over(ranks, {}, std::ssize(numbers), zero, [&](std::ptrdiff_t i) { return vector_term(numbers[i]); });
    for (int j = 0; j < 3; ++j) CHECK(same_bits(sum[j], expected[j]));
}

TEST_CASE("a sum over some of the points begins its blocks with them", "[ranks]") {
    const Communicator all = test::world();
    const std::int32_t n = 9000, first = 1500, last = 8000;
    const PointRanks ranks(all, points_of(all, n));
    std::vector<double> terms;
    for (const std::int32_t number : ranks.numbers())
        if (number >= first && number < last) terms.push_back(term(number));
    double total = 0.0;
    ranks.sum({.first = first, .last = last}, terms, std::span(&total, 1));
    CHECK(same_bits(total, ordered_sum(last - first, 0.0, [&](std::ptrdiff_t i) { return term(first + i); })));
}

TEST_CASE("a fold over ranks adds one term after the other", "[ranks]") {
    const Communicator all = test::world();
    const std::int32_t n = 3000;
    const auto scattered = test::scattered(n, all.rank(), all.size());
    const std::vector<std::int64_t> numbers(scattered.begin(), scattered.end());
    std::vector<double> terms;
    for (const std::int64_t number : numbers) terms.push_back(term(number));
    double expected = 0.125;
    for (std::int32_t i = 0; i < n; ++i) expected += term(i);
    const PointRanks ranks(all, points_of(all, n));
    CHECK(same_bits(ranks.fold(0.125, numbers, terms), expected));
}

TEST_CASE("values that are collected come in the order of the points", "[ranks]") {
    const Communicator all = test::world();
    const std::int32_t n = 500;
    const PointRanks ranks(all, points_of(all, n));
    std::vector<double> values;
    for (const std::int32_t number : ranks.numbers()) values.insert(values.end(), {term(number), -term(number)});
    const std::vector<double> all_values = ranks.collect(values, 2);
    REQUIRE(all_values.size() == (all.rank() == 0 ? 2 * static_cast<std::size_t>(n) : 0));
    for (std::size_t i = 0; i < all_values.size(); ++i)
        CHECK(all_values[i] == (i % 2 == 0 ? 1.0 : -1.0) * term(static_cast<std::int64_t>(i / 2)));
    std::size_t n_gathered = 0;
    for (const double value : ranks.gather(values)) n_gathered += std::isfinite(value) ? 1 : 0;
    CHECK(n_gathered == 2 * static_cast<std::size_t>(n));
}

TEST_CASE("one rank answers with the bits of several, and gives back what it is given", "[ranks]") {
    const Communicator all = test::world();
    const std::int32_t n = 5000;
    const PointRanks several(all, points_of(all, n));
    const dynamics::OneRank one(n, 3);
    CHECK(one.is_one());
    CHECK_FALSE(several.is_one());
    std::vector<double> whole, here;  // two values per point
    std::vector<std::int64_t> keys(static_cast<std::size_t>(n)), keys_here;
    for (std::int32_t i = 0; i < n; ++i) {
        whole.insert(whole.end(), {term(i), -term(3 * i)});
        keys[static_cast<std::size_t>(i)] = (7919 * std::int64_t{i}) % n;  // in another order than the points
        CHECK(one.number_of(static_cast<std::size_t>(i)) == i);
        CHECK(one.point_with(i) == i);
    }
    for (std::size_t i = 0; i < several.numbers().size(); ++i) {
        const std::int32_t number = several.numbers()[i];
        here.insert(here.end(), {term(number), -term(3 * number)});
        keys_here.push_back(keys[static_cast<std::size_t>(number)]);
        CHECK(several.number_of(i) == number);
        CHECK(several.point_with(number) == static_cast<std::int32_t>(i));
    }
    CHECK(several.point_with(n) == -1);

    std::vector<double> sum(2), sum_of_one(2), first_here, first;
    several.sum({.width = 2}, here, sum);
    one.sum({.width = 2}, whole, sum_of_one);
    for (std::size_t k = 0; k < sum.size(); ++k) CHECK(same_bits(sum[k], sum_of_one[k]));
    for (std::size_t i = 0; i < here.size(); i += 2) first_here.push_back(here[i]);
    for (std::size_t i = 0; i < whole.size(); i += 2) first.push_back(whole[i]);
    CHECK(same_bits(several.fold(0.125, keys_here, first_here), one.fold(0.125, keys, first)));
    const std::vector<double> collected = several.collect(here, 2);
    if (all.rank() == 0) CHECK(collected == one.collect(whole, 2));
    CHECK(one.gather(whole) == whole);
    CHECK(one.largest(-3.0) == -3.0);
    one.agree(nullptr);
    CHECK_THROWS_WITH(one.agree(std::make_exception_ptr(BadInput("its own"))), "its own");
}

TEST_CASE("what is made for one rank alone is refused by its name where it is used on several", "[ranks]") {
    const Communicator all = test::world();
    const PointRanks several(all, points_of(all, 10));
    CHECK_NOTHROW(dynamics::refuse_ranks(dynamics::one_rank(), {{"a lonely load"}}));
    CHECK_NOTHROW(dynamics::refuse_ranks(several, {{"a lonely load", false}}));
    CHECK_THROWS_WITH(dynamics::refuse_ranks(several, {{"another one", false}, {"a lonely load", true}}),
                      Catch::StartsWith("a lonely load: not made for a run on several ranks"));
}

TEST_CASE("products and the highest mode of a system over ranks have the bits of those on one", "[ranks]") {
    const Communicator all = test::world();
    const std::int32_t n = 700;
    const PointRanks ranks(all, points_of(all, n));
    std::vector<double> a, b, inverse_mass, a_all, b_all, inverse_all;
    for (std::int64_t i = 0; i < 3 * n; ++i) {
        a_all.push_back(term(i));
        b_all.push_back(term(3 * i + 1));
        inverse_all.push_back(0.5 + 1e-3 * static_cast<double>(i % 11));
    }
    for (const std::int32_t number : ranks.numbers())
        for (int j = 0; j < 3; ++j) {
            a.push_back(a_all[3 * number + j]);
            b.push_back(b_all[3 * number + j]);
            inverse_mass.push_back(inverse_all[3 * number + j]);
        }
    CHECK(same_bits(dynamics::mass_product_over(ranks, a, inverse_mass, b),
                    dynamics::mass_product(a_all, inverse_all, b_all)));
    CHECK(same_bits(dynamics::dot_product_over(ranks, a, b), dynamics::dot_product(a_all, b_all)));

    // Springs to the ground: the product needs no neighbours.
    const auto product = [](std::span<const std::int32_t> numbers) {
        return [numbers](std::span<const double> x, std::span<double> k_x) {
            for (std::size_t i = 0; i < x.size(); ++i)
                k_x[i] = (1.0 + 1.0 / (1.0 + (numbers.empty() ? static_cast<std::int32_t>(i / 3) : numbers[i / 3]))) * x[i];
        };
    };
    const auto whole = dynamics::highest_mode(inverse_all, product({}));
    const auto shared = dynamics::highest_mode(inverse_mass, product(ranks.numbers()), ranks);
    CHECK(same_bits(whole.quotient, shared.quotient));
    CHECK(whole.iterations == shared.iterations);
}

TEST_CASE("points that do not fit together are refused on all ranks", "[ranks]") {
    const Communicator all = test::world();
    SharedPoints twice = points_of(all, 50);
    if (all.rank() == 0) twice.numbers.push_back(twice.numbers.back());
    CHECK_THROWS_AS(PointRanks(all, twice), BadInput);
    SharedPoints missing = points_of(all, 50);
    missing.n_points = 51;
    CHECK_THROWS_AS(PointRanks(all, missing), BadInput);
    SharedPoints short_of_places = points_of(all, 50);
    if (all.rank() == 0) short_of_places.position.pop_back();
    CHECK_THROWS_AS(PointRanks(all, short_of_places), BadInput);
    if (all.size() > 1) {
        SharedPoints other_number = points_of(all, 50);
        if (all.rank() == 0) other_number.n_points = 60;
        CHECK_THROWS_AS(PointRanks(all, other_number), BadInput);
    }
    SharedPoints stranger = points_of(all, 50);
    if (all.rank() == all.size() - 1) stranger.copies = {0}, stranger.owner = {0}, stranger.copied_point = {5000};
    CHECK_THROWS_AS(PointRanks(all, stranger), BadInput);
}

TEST_CASE("bytes of all ranks come to all, rank after rank, whatever their number", "[ranks]") {
    const Communicator all = test::world();
    const PointRanks ranks(all, points_of(all, 10));
    CHECK(ranks.n_ranks() == all.size());
    for (int round = 0; round < 3; ++round) {
        const auto size_of = [&](int rank) { return round == 2 ? 0 : (rank * 37 + 100'000 * round) % 70'001; };
        const auto byte_of = [&](int rank, int i) { return static_cast<std::byte>((rank + 1) * i + round); };
        std::vector<std::byte> mine, expected;
        for (int i = 0; i < size_of(all.rank()); ++i) mine.push_back(byte_of(all.rank(), i));
        for (int rank = 0; rank < all.size(); ++rank)
            for (int i = 0; i < size_of(rank); ++i) expected.push_back(byte_of(rank, i));
        const auto found = ranks.gather_bytes(mine);
        CHECK(std::vector<std::byte>(found.begin(), found.end()) == expected);
    }
}
