#include "abut/run/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "abut/base/error.hpp"
#include "abut/run/user_words.hpp"

namespace abut::run {
namespace {

template <class Choice, std::size_t N>
std::string word_of(const std::array<Word<Choice>, N>& words, Choice choice) {
    for (const auto& [word, meant] : words)
        if (meant == choice) return word;
    return "";
}

/// More than any run takes; all of them are counted exactly in doubles and integers.
constexpr double most_steps = 1e15;
/// What a quotient of two times may be off by.
constexpr double rounding = 1e-12;

/// As `check`, with options as command lines have them.
void check_together(const RunOptions& options);

void append(NamedValues& values, const NamedValues& more) { values.insert(values.end(), more.begin(), more.end()); }

}  // namespace

std::string name_of(solid::Kinematics kinematics) {
    for (const auto& [word, meant] : kinematics_words)
        if (kinematics_of_all(meant) == kinematics) return word;
    return "";
}

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

template <int Dim>
RunOptions with_defaults(RunOptions options) {
    if (options.contact.quadrature == 0) options.contact.quadrature = Dim;
    return options;
}

template <int Dim>
int records_interval(std::int64_t steps, int restart) {
    constexpr std::int64_t records = 2000, least = Dim == 2 ? 1 : 10, most = std::numeric_limits<int>::max() / 2;
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
    if (!(dt <= stable_dt) && !options.allow_unstable)
        throw BadInput(
            fmt::format("{}: {:.6g} s is above the stable step of {:.6g} s. Take at most that, or --cfl of at most "
                        "1; --allow-unstable takes it all the same.",
                        by_cfl ? "--cfl" : "--dt", dt, stable_dt),
            {.value = dt, .allowed = stable_dt});
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

void check_together(const RunOptions& options) {
    if (options.filter && options.integrator != SolidIntegrator::memm)
        throw BadInput(fmt::format("--filter neutral: the filter is made for memm, and {} was chosen. Take --filter none.",
                                   name_of(options.integrator)));
    if (options.restart < 0 && options.restart != restart_not_given)
        throw BadInput(fmt::format("--restart: {} steps, 1 or more are allowed, and 0 for no restarts.", options.restart),
                       {.value = static_cast<double>(options.restart), .allowed = 0.0});
    if (options.restart > 0 && options.integrator != SolidIntegrator::memm)
        throw BadInput(fmt::format("--restart {}: restarts are made for memm, and {} was chosen. Leave --restart out.",
                                   options.restart, name_of(options.integrator)));
    if (!(options.checkpoint >= 0.0) || options.checkpoint_steps < 0)
        throw BadInput(
            fmt::format("--checkpoint, --checkpoint-steps: {:g} minutes, {} steps; 0 or more are allowed, and 0 for none.",
                        options.checkpoint, options.checkpoint_steps),
            {.value = options.checkpoint, .allowed = 0.0});
    if (options.rebalance < 0 || !(options.rebalance_above >= 1.0))
        throw BadInput(
            fmt::format(
                "--rebalance, --rebalance-above: {} steps, {:g}; 0 or more steps are allowed, 0 for parts that stay, "
                "and 1 or more times the mean.",
                options.rebalance, options.rebalance_above),
            {.value = options.rebalance_above, .allowed = 1.0});
    if (const auto& [full, none] = options.facing; !(full >= -1.0 && full < none && none <= 0.0))
        throw BadInput(
            fmt::format("--facing-full, --facing-none: pairs of faces fade out from {:g} to {:g}; -1 <= facing_full < "
                        "facing_none <= 0 is needed. -0.6 and -0.2 are the defaults.",
                        full, none),
            {.value = full, .allowed = none});
    const RunOptions by_default;
    if (options.integrator != SolidIntegrator::memm_async &&
        (options.levels != by_default.levels || options.contact_margin != by_default.contact_margin ||
         options.contact_levels != by_default.contact_levels))
        throw BadInput(
            fmt::format("--levels, --contact-margin, --contact-levels: {} takes one step for all cells. Take --integrator "
                        "memm_async, or leave them out.",
                        name_of(options.integrator)));
    if (options.precision == solid::Precision::single_precision && options.integrator != SolidIntegrator::memm &&
        options.integrator != SolidIntegrator::leapfrog)
        throw BadInput(
            fmt::format("--precision single: steps in single precision are made by memm and leapfrog, and {} was "
                        "chosen. Take --precision double.",
                        name_of(options.integrator)));
    if (options.device != solid::StepDevice::host && options.integrator != SolidIntegrator::memm &&
        options.integrator != SolidIntegrator::leapfrog)
        throw BadInput(
            fmt::format("--device {}: steps on a device are made by memm and leapfrog, and {} was chosen. Take "
                        "--device host.",
                        word_of(device_words, options.device), name_of(options.integrator)));
    if (!std::isnan(options.gauge) && options.integrator != SolidIntegrator::bilbao)
        throw BadInput(fmt::format("--gauge: {} has no gauge. Take --integrator bilbao, or leave --gauge out.",
                                   name_of(options.integrator)));
}

}  // namespace

NamedValues model_values(const RunOptions& options) {
    return {{"weights", word_of(weighting_words, options.contact.weighting)},
            {"area", word_of(area_words, options.contact.area)},
            {"neumann", word_of(free_face_words, options.neumann)},
            {"corners", word_of(corner_words, options.corners)}};
}

NamedValues named_values(const RunOptions& options) {
    const auto& contact = options.contact;
    NamedValues values;
    if (std::isnan(options.dt))
        values = {{"cfl", options.cfl}};
    else
        values = {{"dt", options.dt}, {"allow_unstable", options.allow_unstable}};
    values.push_back({"integrator", name_of(options.integrator)});
    if (options.integrator == SolidIntegrator::memm_async)
        append(values, {{"levels", options.levels},
                        {"contact_margin", options.contact_margin},
                        {"contact_levels", options.contact_levels}});
    if (options.integrator == SolidIntegrator::bilbao && !std::isnan(options.gauge))
        values.push_back({"gauge", options.gauge});
    append(values, {{"precision", word_of(precision_words, options.precision)},
                    {"device", word_of(device_words, options.device)},
                    {"filter", word_of(filter_words, options.filter)},
                    {"restart", options.restart},
                    {"kinematics", word_of(kinematics_words, options.kinematics)},
                    {"law", word_of(law_words, options.law)},
                    {"broad_phase", std::string(geometry::name(contact.search.broad_phase))},
                    {"overlap", word_of(overlap_words, contact.overlap)},
                    {"weights", word_of(weighting_words, contact.weighting)},
                    {"area", word_of(area_words, contact.area)},
                    {"events", word_of(event_words, contact.events)},
                    {"quadrature", contact.quadrature},
                    {"facing_cosine", contact.search.facing_cosine},
                    {"compression_limit", contact.compression_limit},
                    {"neumann", word_of(free_face_words, options.neumann)},
                    {"corners", word_of(corner_words, options.corners)},
                    {"out", options.out.string()},
                    {"interval", options.interval},
                    {"frames", options.frames}});
    // Said where it is not the usual.
    const auto append_changed = [&values](const char* name, auto value, auto by_default) {
        if (value != by_default) values.push_back({name, value});
    };
    const contact::ContactOptions plain;
    append_changed("pieces", options.pieces, false);
    append_changed("self_contact", contact.search.self_contact, plain.search.self_contact);
    append_changed("self_contact_rings", contact.search.self_contact_rings, plain.search.self_contact_rings);
    append_changed("candidate_distance", contact.search.distance, plain.search.distance);
    append_changed("largest_motion", contact.search.largest_motion, plain.search.largest_motion);
    append_changed("facing_full", options.facing.full, geometry::FacingFade{}.full);
    append_changed("facing_none", options.facing.none, geometry::FacingFade{}.none);
    append_changed("compression_warning", contact.compression_warning, plain.compression_warning);
    return values;
}

template int records_interval<2>(std::int64_t, int);
template int records_interval<3>(std::int64_t, int);
template RunOptions with_defaults<2>(RunOptions);
template RunOptions with_defaults<3>(RunOptions);

}  // namespace abut::run
