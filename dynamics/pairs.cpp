#include "abut/dynamics/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics::detail {
namespace {

constexpr double counted_change = 0.1;  // of the step
constexpr std::int64_t many_changes = 10;
constexpr double safe_part = 0.25;  // of the stable step 2/omega: omega d = 0.5

}  // namespace

void StepChanges::count(double d) {
    if (counted_ == 0.0) counted_ = d;
    if (std::abs(d - counted_) > counted_change * counted_) {
        ++report_.changes;
        counted_ = d;
    }
    report_.longest = std::max(report_.longest, d);
    report_.may_grow = report_.changes > many_changes && report_.longest > safe_part * stable_step_;
}

void check_stable_step(double stable_step) {
    if (!(stable_step > 0.0))
        throw BadInput("Pairs: the stable step is " + number(stable_step) +
                           " s; give 2/omega of the highest mode, or infinity where it is not known.",
                       {.value = stable_step, .allowed = 0.0});
}

void check_held(std::span<const double> of_scheme, double dt) {
    if (of_scheme.size() != 1 || !(of_scheme.front() >= 0.0) || !std::isfinite(of_scheme.front()))
        throw BadInput("Pairs: a saved state has " + std::to_string(of_scheme.size()) +
                       " lengths of a path that is held back; one is needed, >= 0. Restore it under Pairs.");
    const double held = of_scheme.front();
    if (held > 0.0 && dt != held)
        throw BadInput("Pairs: a saved state holds back a path of " + number(held) + " s, and its dt is " + number(dt) +
                           " s, which must be the same. Restore a state as Pairs has saved it.",
                       {.value = dt, .allowed = held});
}

void refuse_pairs(const char* what) {
    throw BadInput(std::string("Pairs: the system has ") + what +
                   ". Take Memm with OwnClock; a solid has its own, solid::ClockedRun.");
}

}  // namespace abut::dynamics::detail
