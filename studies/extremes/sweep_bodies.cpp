#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/extremes/families.hpp"
#include "studies/extremes/scenes.hpp"

namespace abut::studies::extremes {
namespace {

constexpr int steps_of_ratios = 3000;  // of the stiffer or lighter body: enough for many of its crossings in contact

Trial<2> meeting_of_discs(const char* family, const std::string& value, const Meeting<2>& meeting,
                          const run::RunOptions& run) {
    return {
        .family = family, .value = value, .speed = meeting.speed, .make = [meeting] { return discs(meeting); }, .run = run};
}

/// Blocks where the time of the impact must be known: flat sides touch when the gap is closed, discs of straight faces a
/// little later.
const std::array<Block<2>, 2> squares{{{.cells = {7, 7}}, {.cells = {5, 5}}}};

/// The gap is closed within a few steps of the faster body, whose wave speed is `ratio` times that of the other.
run::RunOptions short_run(Meeting<2>& meeting, double ratio, const run::RunOptions& run) {
    meeting.gap /= std::max(ratio, 1.0);
    run::RunOptions options = run;
    options.steps = steps_of_ratios;
    return options;
}

}  // namespace

void sweep_stiffness(const SweepOptions& options, const Sink& sink) {
    for (const double ratio : thinned({1.0, 1e2, 1e4, 1e6, 1e9, 1e12}, options.quick)) {
        Meeting<2> meeting{.young = {1.0, ratio}, .aside = 0.3};
        const run::RunOptions run = short_run(meeting, std::sqrt(ratio), options.run);
        sink(attempt(meeting_of_blocks<2>("stiffness", fmt::format("E_2/E_1 = {:g}", ratio), meeting, squares, run)));
        // The denser the stiffer: waves are equally fast in both, and the run sees the whole impact.
        Meeting<2> matched{.young = {1.0, ratio}, .density = {1.0, ratio}, .aside = 0.3};
        const std::string value = fmt::format("E_2/E_1 = rho_2/rho_1 = {:g}", ratio);
        sink(attempt(meeting_of_discs("stiffness", value, matched, options.run)));
    }
}

void sweep_density(const SweepOptions& options, const Sink& sink) {
    for (const double ratio : thinned({1.0, 1e3, 1e6, 1e9}, options.quick)) {
        Meeting<2> meeting{.density = {1.0, ratio}, .aside = 0.3};
        sink(attempt(meeting_of_discs("density", fmt::format("rho_2/rho_1 = {:g}", ratio), meeting, options.run)));
        Meeting<2> light{.density = {1.0, 1.0 / ratio}, .aside = 0.3};
        const run::RunOptions run = short_run(light, std::sqrt(ratio), options.run);
        sink(attempt(meeting_of_blocks<2>("density", fmt::format("rho_2/rho_1 = {:g}", 1.0 / ratio), light, squares, run)));
    }
}

void sweep_poisson(const SweepOptions& options, const Sink& sink) {
    for (const double nu : thinned({0.0, 0.3, 0.45, 0.49, 0.499, 0.4999, 0.5}, options.quick)) {
        Meeting<2> meeting{.poisson = nu, .aside = 0.3};
        sink(attempt(meeting_of_discs("poisson", fmt::format("nu = {:g}", nu), meeting, options.run)));
    }
}

void sweep_speed(const SweepOptions& options, const Sink& sink) {
    for (const double speed : thinned({1e-6, 1e-4, 1e-2, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 3.0}, options.quick)) {
        // The time to the impact does not depend on the speed.
        Meeting<2> meeting{.speed = speed, .gap = 0.4 * speed, .aside = 0.3};
        sink(attempt(meeting_of_blocks<2>("speed", fmt::format("v = {:g} c", speed), meeting, squares, options.run)));
    }
}

void sweep_cfl(const SweepOptions& options, const Sink& sink) {
    for (const bool filter : {false, true})
        for (const double cfl : thinned({0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999}, options.quick)) {
            run::RunOptions run = options.run;
            run.cfl = cfl;
            run.filter = filter;
            const std::string value = fmt::format("{:g}{}", cfl, filter ? ", with the filter" : "");
            sink(attempt(meeting_of_discs("cfl", value, {.aside = 0.3}, run)));
        }
}

}  // namespace abut::studies::extremes
