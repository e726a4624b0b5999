#include "abut/run/settling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/run/body_names.hpp"
#include "abut/solid/contact_view.hpp"

namespace abut::run {
namespace {

constexpr double cfl = 0.9;           // of the steps to rest
constexpr double settled = 1e-12;     // of the largest peak of the kinetic energy
constexpr std::int64_t window = 500;  // steps: where peaks do not fall by a tenth from one to the next, no more is to be had
constexpr std::int64_t most_rise = 20'000;  // steps without a peak: the bodies fall or slide
constexpr std::int64_t most_steps = 200'000;

/// Loads and obstacles that stay as they are at t = 0.
template <int Dim>
solid::SolidOptions<Dim> frozen(solid::SolidOptions<Dim> options) {
    const auto freeze = [](solid::Field<Dim>& history) {
        if (history) history = [of_time = history](double, const Vector<Dim>& position) { return of_time(0.0, position); };
    };
    for (auto& condition : options.boundary.dirichlet) freeze(condition.history);
    for (auto& condition : options.boundary.traction) freeze(condition.history);
    for (contact::RigidObstacle<Dim>& obstacle : options.obstacles) {
        if (obstacle.path) obstacle.path = [at = obstacle.path(0.0)](double) { return at; };
        if (obstacle.placement) obstacle.placement = [at = obstacle.placement(0.0)](double) { return at; };
    }
    return options;
    for (solid::BodyMoment<Dim>& moment : options.moments)
        if (moment.history) moment.moment = std::exchange(moment.history, {})(0.0);
}

/// Peaks of the kinetic energy, and whether they have come down as far as they can. Single ones say little: a fast vibration
/// makes a low one while a slow one has only begun.
class Peaks {
public:
    /// Takes the next one, at a step; whether it is the last.
    bool is_last(double kinetic, std::int64_t step) {
        largest_ = std::max(largest_, kinetic);
        in_window_ = std::max(in_window_, kinetic);
        if (largest_ == 0.0) return true;
        if (step < begin_ + window) return false;
        begin_ = step;
        const double before = std::exchange(in_window_before_, std::exchange(in_window_, 0.0));
        return in_window_before_ <= settled * largest_ && in_window_before_ > 0.9 * before;
    }

private:
    std::int64_t begin_ = 0;  // of the window
    double largest_ = 0.0;
    double in_window_ = 0.0;
    double in_window_before_ = std::numeric_limits<double>::infinity();
};

/// Largest speed of the points of each body [m/s].
template <int Dim>
std::vector<double> speeds(const solid::Solid<Dim>& solid, std::span<const double> momentum) {
    std::vector<double> of_body(solid.mesh().body_names.size(), 0.0);
    const auto p = as_vectors<Dim>(momentum);
    for (std::size_t i = 0; i < solid.masses().size(); ++i) {
        double& speed = of_body[static_cast<std::size_t>(solid.body_of_points()[i])];
        speed = std::max(speed, p[i].norm() / solid.masses()[i]);
    }
    for (double& speed : of_body) speed = solid.ranks().largest(speed);
    return of_body;
}

template <int Dim>
[[noreturn]] void refuse(const Scene<Dim>& scene, const std::vector<double>& speeds, std::int64_t steps) {
    const auto fastest = std::ranges::max_element(speeds) - speeds.begin();
    throw BadInput(
        fmt::format(
            "--settle: bodies do not come to rest under the loads of t = 0: after {} steps {} still moves with {:.3g} "
            "m/s. It falls, slides or rolls: hold it by supports, springs or friction, put it nearer to where it "
            "rests, or leave --settle out.",
            steps, quoted_name(scene, static_cast<std::int32_t>(fastest)), speeds[static_cast<std::size_t>(fastest)]),
        {.value = speeds[static_cast<std::size_t>(fastest)], .allowed = 0.0});
}

}  // namespace

template <int Dim>
Settled settle(const Scene<Dim>& scene, const solid::SolidOptions<Dim>& options, const Share<Dim>& share,
               std::vector<double> q, double stable_dt) {
    Settled result;
    solid::Solid<Dim> solid(share.part, frozen(options), share.ranks);
    const std::vector<double> at_rest(q.size(), 0.0);
    dynamics::Memm<solid::Solid<Dim>> motion(solid, std::move(q), at_rest, cfl * stable_dt);
    Peaks peaks;
    double before = 0.0, last = 0.0;  // of two steps: a swing from step to step is no peak
    std::int64_t peak_at = 0;
    for (bool is_last = false; !is_last;) {
        try {
            motion.step();
        } catch (const Error& error) {
            throw_again(error, fmt::format("--settle: step {} to rest under the loads of t = 0: {}", motion.steps() + 1,
                                           error.what()));
        }
        const double now = motion.kinetic_energy(), kinetic = 0.5 * (now + std::exchange(last, now));
        if (motion.steps() > most_steps || motion.steps() - peak_at > most_rise)
            refuse(scene, speeds(solid, motion.p_after()), motion.steps());
        if (kinetic > before) {
            before = kinetic;
            continue;
        }
        is_last = peaks.is_last(before, motion.steps());
        if (is_last) result.report.speed = std::ranges::max(speeds(solid, motion.p_after()));
        motion.bring_to_rest();
        ++result.report.rests;
        before = last = 0.0;
        peak_at = motion.steps();
    }
    result.report.steps = motion.steps();
    result.report.dissipated = solid.contact().report().friction_dissipated;
    result.q.assign(motion.q().begin(), motion.q().end());
    solid.begin_run();
    result.solid = solid.state();
    return result;
}

template Settled settle<2>(const Scene<2>&, const solid::SolidOptions<2>&, const Share<2>&, std::vector<double>, double);
template Settled settle<3>(const Scene<3>&, const solid::SolidOptions<3>&, const Share<3>&, std::vector<double>, double);

}  // namespace abut::run
