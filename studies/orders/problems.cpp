#include "studies/orders/problems.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace abut::studies::orders {
namespace {

/// A problem of one run.
template <class Law>
Problem<Law> problem_of(KnownMotion<Law> motion, double gauge, int n_bonds) {
    return {std::move(motion.system), {std::move(motion.run)}, motion.time, gauge, n_bonds, 400, true};
}

}  // namespace

Problem<dynamics::LineSpring> duffing() { return problem_of(duffing_motion(), 1.0, 1); }

Problem<dynamics::Attraction> kepler() { return problem_of(kepler_motion(), 3.0, 1); }

Problem<dynamics::LineSpring> chain() { return problem_of(chain_motion(), 1.0, 17); }

Problem<dynamics::LineSpring> bounce() {
    constexpr double time = 12.0;
    Problem<dynamics::LineSpring> problem{bounce_motion(1.0, time).system, {}, time, 1.0, 1, 400, false};
    for (int j = 0; j < 40; ++j) problem.runs.push_back(bounce_motion(1.0 + 0.013 * j, time).run);
    return problem;
}

Problem<dynamics::LineSpring> bar() {
    constexpr std::int32_t n = 200;
    constexpr double time = 120.0, centre = 40.0, width = 8.0;  // cells; c = 1
    Run run;
    for (std::int32_t i = 0; i < n; ++i)
        for (const double t : {0.0, time}) {
            const double s = (i - centre - t) / width, u = std::exp(-s * s);
            (t == 0.0 ? run.q : run.end_q).push_back(u);
            (t == 0.0 ? run.p : run.end_p).push_back(2.0 * s / width * u);
        }
    return {row_of(n, {.stiffness = 1.0}), {run}, time, 1.0, n + 1, 150, false};
}

}  // namespace abut::studies::orders
