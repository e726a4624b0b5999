#include <catch2/catch.hpp>
#include <string>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

/// The last error of a method on a problem, which has the shortest steps.
double last_error(const Outcome& outcome, const std::string& problem, const std::string& method) {
    return read_table(outcome, problem + ".csv").column(method).back();
}

}  // namespace

TEST_CASE(
    "every scheme has its order on three smooth systems, on a mesh none is better than its cells, and steps that land "
    "at contacts are",
    "[programs][orders]") {
    const auto outcome = run_well("study orders", "--halvings 5", "orders", "PATH=/nowhere");
    CHECK(check_targets(outcome) == 3 * 8 + 2);
    CHECK(last_error(outcome, "bounce", "blanes_moan_4_landed") < last_error(outcome, "bounce", "blanes_moan_4"));
    CHECK(last_error(outcome, "bar", "blanes_moan_6") == Approx(last_error(outcome, "bar", "memm")).epsilon(0.02));
}
