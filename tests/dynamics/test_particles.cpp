#include <catch2/catch.hpp>

#include "dynamics/schemes.hpp"

using namespace abut;
using namespace abut::test;

TEST_CASE("particles without levels are all on level 0: the impulse is that of every bond and of the load",
          "[dynamics][particles]") {
    const Values load{0.5, -2.0, 1.0}, q{0.1, 0.3, -0.2};
    const auto make = [&] { return Chain({1.0, 1.0, 1.0}, {{-1, 0, {2.0}}, {0, 1, {3.0}}, {1, 2, {1.0}}}, load); };
    const Values at_rest(3, 0.0), elapsed{0.0};
    const std::vector<std::int32_t> level(3, 0);
    const double dt = 0.1;
    Chain chain = make();
    Values impulse(3, 0.0), force(3);
    chain.add_impulse(0, {q, at_rest, level, elapsed}, 0.0, dt, impulse);
    chain.force(q, force);
    for (std::size_t i = 0; i < 3; ++i) CHECK(impulse[i] == Approx(dt * force[i]).epsilon(1e-14));
    Chain levelled = make();
    levelled.set_levels(1, level);
    Values same(3, 0.0);
    levelled.add_impulse(0, {q, at_rest, level, elapsed}, 0.0, dt, same);
    CHECK(same == impulse);
}

TEST_CASE("particles refuse arrays and bonds that do not fit", "[dynamics][particles][errors]") {
    using Catch::Matchers::Contains;
    CHECK_THROWS_WITH(ElasticString({1.0, 1.0, 1.0}, {}), Contains("give 2 masses per particle"));
    CHECK_THROWS_WITH(Chain({1.0, 1.0}, {}, {0.5}), Contains("as many loads or none"));
    CHECK_THROWS_WITH(Chain({1.0, 1.0}, {{0, 2, {1.0}}}), Contains("a bond joins 0 and 2"));
}
