#include "abut/run/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "abut/base/error.hpp"
#include "abut/dynamics/step_options.hpp"
#include "abut/run/option_table.hpp"
#include "abut/run/user_words.hpp"
#include "abut/solid/combinations/combinations.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::run {
namespace {

/// More than any run takes; all of them are counted exactly in doubles and integers.
constexpr double most_steps = 1e15;
/// Largest rounding of a quotient of two times.
constexpr double rounding = 1e-12;

/// As `check`, with options as command lines have them.
void check_together(const RunOptions& options);

}  // namespace

std::string name_of(solid::Kinematics kinematics) { return std::string(solid::properties_of(kinematics).name); }

std::optional<solid::Kinematics> kinematics_of_all(BodyKinematics kinematics) {
    switch (kinematics) {
        case BodyKinematics::scene:
        case BodyKinematics::automatic:
            return std::nullopt;
        case BodyKinematics::small:
            return solid::Kinematics::small;
        case BodyKinematics::floating:
            return solid::Kinematics::floating;
        case BodyKinematics::finite:
            return solid::Kinematics::finite;
        case BodyKinematics::rigid:
            return solid::Kinematics::rigid;
    }
    return std::nullopt;
}

solid::FeatureSet features_of(const RunOptions& options) {
    using solid::Feature;
    solid::FeatureSet features;
    features.add(Feature::local_steps, options.integrator == SolidIntegrator::memm_async);
    features.add(Feature::end_forces,
                 options.integrator == SolidIntegrator::leapfrog || options.integrator == SolidIntegrator::bilbao);
    features.add(Feature::bilbao, options.integrator == SolidIntegrator::bilbao);
    features.add(Feature::pilot, options.kinematics == BodyKinematics::automatic);
    features.add(Feature::settling, options.settle);
    features.add(Feature::pieces, options.pieces);
    features.add(Feature::xdmf, options.format == FrameFormat::xdmf);
    features.add(Feature::output_times, !options.times.empty());
    return features;
}

template <int Dim>
RunOptions with_defaults(RunOptions options) {
    if (options.contact.quadrature == 0) options.contact.quadrature = Dim;
    return options;
}

template <int Dim>
int records_interval(std::int64_t steps, int restart) {
    constexpr std::int64_t records = 2000, enough = 200, most = std::numeric_limits<int>::max() / 2;
    const std::int64_t least = Dim == 2 ? std::clamp<std::int64_t>(steps / enough, 1, 10) : 10;
    int interval = static_cast<int>(std::clamp((steps + records - 1) / records, least, most));
    while (restart > 1 && std::gcd(interval, restart) > 1) ++interval;
    return interval;
}

std::int64_t steps_until(double time, double dt) {
    const double steps = std::ceil(time / dt * (1.0 - rounding));
    if (!(steps >= 1.0 && steps <= most_steps))
        throw BadInput(
            fmt::format(
                "--time, --dt: {:g} s in steps of {:g} s are {:g} steps, 1 to {:g} are allowed. Give another end of the "
                "run with --time or --steps, or another step with --dt or --cfl.",
                time, dt, steps, most_steps),
            {.value = steps, .allowed = most_steps});
    return static_cast<std::int64_t>(steps);
}

double choose_step(const RunOptions& options, double stable_dt) {
    const bool by_cfl = std::isnan(options.dt);
    if (by_cfl && !std::isfinite(stable_dt))
        throw BadInput(
            "--cfl: nothing resists a displacement, as of rigid bodies that touch nothing, and every step is stable. "
            "Give one by --dt, a hundredth of a turn or shorter.");
    const double dt = by_cfl ? options.cfl * stable_dt : options.dt;
    if (!options.allow_unstable)
        dynamics::require_stable(by_cfl ? "--cfl: the step" : "--dt", dt, stable_dt,
                                 "Take at most that, or --cfl of at most 1; --allow-unstable takes it all the same.");
    return dt;
}

void check(const RunOptions& options) {
    try {
        check_together(options);
    } catch (const BadInput& error) {
        throw BadInput(with_keys(error.what()), error.facts());
    }
}

namespace {

/// Whether a choice was made that the scheme does not read: neither the default nor 0, which is none.
bool asks_for(const OptionValue& value, const OptionValue& by_default) {
    return !is_same(value, by_default) && value != OptionValue(std::int64_t{0});
}

void check_scheme(const OptionFacts& option, const OptionValue& value, const OptionValue& by_default,
                  const std::string& scheme) {
    if (option.schemes.empty() || std::ranges::find(option.schemes, scheme) != option.schemes.end() ||
        !asks_for(value, by_default))
        return;
    const bool is_word = option.kind == OptionKind::word;
    throw BadInput(fmt::format(
        "{}{} is for {}, and {} was chosen. Take --integrator {}, or {}.", option.flag(),
        is_word ? " " + abut::text_of(value) : "", fmt::join(option.schemes, " and "), scheme, option.schemes.front(),
        is_word ? option.flag() + " " + abut::text_of(by_default) : "leave " + option.flag() + " out"));
}

void check_together(const RunOptions& options) {
    const RunOptions plain;
    for (const Option<RunOptions>& option : run_options()) {
        const OptionValue value = option.get(options), by_default = option.get(plain);
        OptionFacts as_flag = option;
        as_flag.name = option.flag();
        if (option.name != "cfl") check_value("", as_flag, value, by_default);  // choose_step judges the step of a cfl
        check_scheme(option, value, by_default, name_of(options.integrator));
    }
    solid::require_together("", "", features_of(options));
    if (const auto& [full, none] = options.facing; !(full < none))
        throw BadInput(
            fmt::format("--facing-full, --facing-none: pairs of faces fade out from {:g} to {:g}; -1 <= facing_full < "
                        "facing_none <= 0 is needed. -0.6 and -0.2 are the defaults.",
                        full, none),
            {.value = full, .allowed = none});
}

}  // namespace

template int records_interval<2>(std::int64_t, int);
template int records_interval<3>(std::int64_t, int);
template RunOptions with_defaults<2>(RunOptions);
template RunOptions with_defaults<3>(RunOptions);

}  // namespace abut::run
