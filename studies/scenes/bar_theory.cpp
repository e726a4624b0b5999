// What is known of bars in closed form, and what a history of contact says beside it.
#include <cmath>
#include <functional>
#include <vector>

#include "studies/scenes/bars.hpp"

namespace abut::studies {
namespace {

/// Time after the node at which a gap that is linear in between vanishes. A gap that was not known begins at the node.
double root_after(const ContactHistory& history, std::size_t node) {
    const double from = history.gap[node], to = history.gap[node + 1];
    const double dt = history.time[node + 1] - history.time[node];
    return std::isfinite(from) && std::isfinite(to) ? history.time[node] + dt * from / (from - to) : history.time[node];
}

}  // namespace

double ExactBounce::hit(int impact) const {
    return gravity_ == 0.0 ? height / speed : speed / gravity_ + 0.5 * impact * period;
}

double ExactBounce::pressure_at(double time) const {
    double t = time;
    if (gravity_ != 0.0) {
        t = std::fmod(time, period);
        t = std::min(t, period - t);
    }
    return t <= hit() || t >= hit() + bar_.contact_time() ? 0.0 : pressure(t - hit());
}

double ExactBounce::height_at(double time) const {
    const double release = hit() + bar_.contact_time();
    if (gravity_ == 0.0) return std::max({0.0, height - speed * time, speed * (time - release)});
    // There and back about the middle of the period, when the bar is as high as it gets between two impacts.
    double t = std::fmod(time, period);
    t = std::min(t, period - t);
    if (t <= hit()) return height - 0.5 * gravity_ * t * t;
    return t <= release ? 0.0 : flight(t - release);
}

double ExactBounce::velocity_at(double time) const {
    double t = time, sign = 1.0;
    if (gravity_ != 0.0) {
        t = std::fmod(time, period);
        if (t > 0.5 * period) t = period - t, sign = -1.0;
    }
    const double since = std::clamp(t - hit(), 0.0, bar_.contact_time());
    const double from_wall = bar_.impedance() * since * (speed + 0.5 * gravity_ * since) / bar_.mass();
    return sign * ((gravity_ == 0.0 ? -speed : 0.0) - gravity_ * t + from_wall);
}

double ExactBounce::impulse() const { return 2.0 * bar_.mass() * (speed + gravity_ * bar_.length / bar_.wave_speed()); }

/// Between the impacts the bar vibrates: under its own weight it was pressed by 2 rho g (L - x) when it was released.
double ExactBounce::flight(double since) const {
    const double c = bar_.wave_speed(), length = bar_.length;
    const double path = std::fmod(c * since, 2.0 * length), x = std::min(path, 2.0 * length - path);
    const double vibration = -2.0 * gravity_ / (c * c) * (length * x - 0.5 * x * x);
    return speed * since - 0.5 * gravity_ * since * since + vibration;
}

DispersedImpact dispersed_impact(const Bar& bar, BarBody body, int cells, double courant) {
    // With F(y) = integral of Ai over (-y, infinity), F(0) = 1/3: F = 1/2 at y = 0.409603 =: r, and what is missing of the
    // impulse is the integral of 2 F over (-infinity, 0) less that of 1 - 2 F over (0, r): -2 Ai'(0) - 0.071116 = 0.446523.
    constexpr double late = 0.409603, missing = 0.446523;
    const double h = bar.length / cells, beta = ((body == BarBody::chain ? 1.0 : 4.0) - courant * courant) / 24.0;
    const double spread = std::cbrt(6.0 * beta * h * h * bar.length);
    return {.delay = late * spread / bar.wave_speed(), .loss = missing * spread / bar.length};
}

std::vector<Impact> impacts(const ContactHistory& history, double pause) {
    std::vector<Impact> found;
    for (std::size_t n = 0; n + 1 < history.time.size(); ++n) {
        const bool before = history.gap[n] < 0.0, after = history.gap[n + 1] < 0.0;
        if (!before && !after) continue;
        const double begin = before ? history.time[n] : root_after(history, n);
        if (found.empty() || begin - found.back().end > pause) found.push_back({.begin = begin});
        Impact& present = found.back();
        present.end = after ? history.time[n + 1] : root_after(history, n);
        present.impulse += history.pressure[n] * (history.time[n + 1] - history.time[n]);
        present.speed = history.speed[n + 1];
    }
    if (!found.empty() && history.time.back() - found.back().end < pause) found.pop_back();
    return found;
}

MiddlePressure middle_pressure(const ContactHistory& history, double begin, double duration,
                               const std::function<double(double)>& exact) {
    double whole = 0.0, sum = 0.0, square = 0.0, moment = 0.0, inertia = 0.0;
    const double middle = begin + 0.5 * duration;
    for (std::size_t n = 0; n + 1 < history.time.size(); ++n) {
        const double dt = history.time[n + 1] - history.time[n], t = history.time[n] + 0.5 * dt, p = history.pressure[n];
        if (std::abs(t - middle) > 0.4 * duration) continue;
        whole += dt;
        sum += p * dt;
        square += (p - exact(t)) * (p - exact(t)) * dt;
        moment += p * (t - middle) * dt;
        inertia += (t - middle) * (t - middle) * dt;
    }
    const double mean = sum / whole, rise = 0.5 * duration * moment / inertia;
    return {.mean = mean, .rms = std::sqrt(square / whole), .at_begin = mean - rise, .at_end = mean + rise};
}

}  // namespace abut::studies
