#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>

#include "abut/base/error.hpp"
#include "abut/ranks/exchange.hpp"
#include "ranks/world.hpp"

using namespace abut;
using namespace abut::ranks;

namespace {

/// Each rank has ten entries and wants the last two of the rank before it and the first of the one behind, in a ring.
struct Ring {
    Communicator all = test::world();
    int before = (all.rank() + all.size() - 1) % all.size();
    int behind = (all.rank() + 1) % all.size();
    Exchange exchange{all, 13, std::vector<std::int32_t>{11, 10, 12}, std::vector<int>{before, before, behind},
                      std::vector<std::int32_t>{9, 8, 0}};
};

double value(int rank, int entry, int component) { return 1000.0 * rank + 10.0 * entry + component; }

}  // namespace

TEST_CASE("an exchange brings the entries of other ranks to where they are wanted", "[ranks]") {
    const Ring ring;
    for (const int width : {1, 3, 9, 3}) {
        std::vector<double> values(static_cast<std::size_t>(13 * width), -1.0);
        for (int i = 0; i < 10; ++i)
            for (int j = 0; j < width; ++j) values[static_cast<std::size_t>(i * width + j)] = value(ring.all.rank(), i, j);
        ring.exchange.fill(values, width);
        for (int j = 0; j < width; ++j) {
            CHECK(values[static_cast<std::size_t>(10 * width + j)] == value(ring.before, 8, j));
            CHECK(values[static_cast<std::size_t>(11 * width + j)] == value(ring.before, 9, j));
            CHECK(values[static_cast<std::size_t>(12 * width + j)] == value(ring.behind, 0, j));
            CHECK(values[static_cast<std::size_t>(5 * width + j)] == value(ring.all.rank(), 5, j));
        }
    }
    CHECK(ring.exchange.counts().sent == 3);
    CHECK(ring.exchange.counts().received == 3);
    CHECK(ring.exchange.counts().neighbours_to == (ring.all.size() > 2 ? 2 : 1));
}

TEST_CASE("ranks without neighbours take no part in an exchange", "[ranks]") {
    const Communicator all = test::world();
    const bool wants = all.rank() == all.size() - 1 && all.size() > 1;  // of rank 0
    std::vector<std::int32_t> wanted, number;
    std::vector<int> owner;
    if (wants) wanted = {1}, owner = {0}, number = {0};
    const Exchange exchange(all, 2, wanted, owner, number);
    std::vector<double> values{100.0 + all.rank(), -1.0};
    exchange.fill(values, 1);
    CHECK(values[1] == (wants ? 100.0 : -1.0));
}

TEST_CASE("an entry that no rank has is refused on all ranks", "[ranks]") {
    const Communicator all = test::world();
    const bool wrong = all.rank() == all.size() - 1;
    const std::vector<std::int32_t> wanted{1}, number{wrong ? 7 : 0};
    CHECK_THROWS_AS(Exchange(all, 2, wanted, std::vector<int>{0}, number), BadInput);
    CHECK_THROWS_AS(Exchange(all, 2, wanted, std::vector<int>{wrong ? all.size() : 0}, std::vector<std::int32_t>{0}),
                    BadInput);
}

TEST_CASE("copies that have no place of their own are refused on all ranks", "[ranks]") {
    const Communicator all = test::world();
    const bool wrong = all.rank() == all.size() - 1;
    const std::vector<int> owner{0, 0};
    const std::vector<std::int32_t> number{0, 0};
    const auto exchange_of = [&](std::vector<std::int32_t> wanted) { Exchange(all, 3, wanted, owner, number); };
    CHECK_NOTHROW(exchange_of({1, 2}));
    CHECK_THROWS_AS(exchange_of({1, wrong ? 3 : 2}), BadInput);
    CHECK_THROWS_AS(exchange_of({1, wrong ? 1 : 2}), BadInput);
    CHECK_THROWS_AS(exchange_of(wrong ? std::vector<std::int32_t>{1} : std::vector<std::int32_t>{1, 2}), BadInput);
}

TEST_CASE("the error of one rank is thrown on all of them, of the same type and with its facts", "[ranks]") {
    const Communicator all = test::world();
    const int guilty = all.size() - 1;
    CHECK_NOTHROW(all.agree(nullptr));
    std::exception_ptr error;
    if (all.rank() == guilty) error = std::make_exception_ptr(TooDeep("too deep by 3 mm", {.face_2 = 7, .value = 3e-3}));
    try {
        all.agree(error);
        FAIL_CHECK("no error");
    } catch (const TooDeep& e) {
        const std::string prefix = all.rank() == guilty ? "" : "on rank " + std::to_string(guilty) + ": ";
        CHECK(std::string(e.what()) == prefix + "too deep by 3 mm");
        CHECK(e.facts().face_1 == ErrorFacts::none);
        CHECK(e.facts().face_2 == 7);
        CHECK(e.facts().value == 3e-3);
        CHECK(std::isnan(e.facts().allowed));
    }
    if (all.rank() == guilty) error = std::make_exception_ptr(std::length_error("not one of ours"));
    CHECK_THROWS_WITH(all.agree(error), Catch::EndsWith("not one of ours"));
    CHECK(all.largest(all.rank()) == all.size() - 1);
    CHECK(std::isnan(all.largest(all.rank() == guilty ? std::nan("") : 1.0)));
}
