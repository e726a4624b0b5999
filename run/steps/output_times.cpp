#include "abut/run/steps/output_times.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "abut/base/error.hpp"
#include "abut/run/options.hpp"
#include "abut/solid/combinations/combinations.hpp"

namespace abut::run {
namespace {

constexpr double rounding_of_end = 1e-12;

void check_time(std::span<const double> times, std::size_t i, double end) {
    const double time = times[i];
    if (!(time >= 0.0) || !std::isfinite(time))
        throw BadInput(fmt::format("output.times: number {} is {:.6g} s; finite times from 0 s on are needed.", i + 1, time),
                       {.value = time, .allowed = 0.0});
    if (i > 0 && time <= times[i - 1])
        throw BadInput(
            fmt::format("output.times: number {} is {:.6g} s, after {:.6g} s. Give them in increasing order, each "
                        "once.",
                        i + 1, time, times[i - 1]),
            {.value = time, .allowed = times[i - 1]});
    if (time > (1.0 + rounding_of_end) * end)
        throw BadInput(
            fmt::format("output.times: number {} is {:.6g} s, and the run ends at {:.6g} s. Leave it out, or give "
                        "a later end.",
                        i + 1, time, end),
            {.value = time, .allowed = end});
}

}  // namespace

void check_output_times(std::span<const double> times, const RunOptions& options, double end) {
    if (times.empty()) return;
    solid::require_together("", "", features_of(options) | solid::FeatureSet{solid::Feature::output_times});
    for (std::size_t i = 0; i < times.size(); ++i) check_time(times, i, end);
}

}  // namespace abut::run
