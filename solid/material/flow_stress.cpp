#include "abut/solid/material/flow_stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace abut::solid {

/// By how much a rate of plastic strain r [1/s] raises the stress of a metal, over that stress.
struct RateLaw {
    bool (*is_given)(const MetalFlow&);
    double (*rise)(const MetalFlow&, double rate);      ///< factor - 1 [-], 0 at rate 0
    double (*slope)(const MetalFlow&, double rate);     ///< [s]
    double (*integral)(const MetalFlow&, double rate);  ///< of `rise` from 0 [1/s]
};

namespace {

/// The part of a table that begins at or before alpha, and the integral of the rise up to it.
struct Segment {
    const HardeningPoint* point;
    const HardeningPoint* next;  // null behind the last
    double work;

    [[nodiscard]] double slope() const {
        return next ? (next->stress - point->stress) / (next->plastic_strain - point->plastic_strain) : 0.0;
    }
};

Segment segment_at(const std::vector<HardeningPoint>& table, double alpha) {
    Segment segment{table.data(), nullptr, 0.0};
    const double first = table.front().stress;
    for (std::size_t i = 1; i < table.size(); ++i) {
        segment.next = &table[i];
        if (table[i].plastic_strain > alpha) return segment;
        segment.work += (0.5 * (table[i - 1].stress + table[i].stress) - first) *
                        (table[i].plastic_strain - table[i - 1].plastic_strain);
        segment.point = segment.next;
    }
    segment.next = nullptr;
    return segment;
}

// Ways to harden: what they add to the yield stress as a function of the equivalent plastic strain alpha. `rise` [Pa]
// is 0 at alpha = 0, `slope` [Pa] its derivative, `work` [J/m^3] its integral from 0.

struct LinearHardening {
    static bool is_given(const MetalFlow& of) { return of.hardening > 0.0; }
    static double rise(const MetalFlow& of, double alpha) { return of.hardening * alpha; }
    static double slope(const MetalFlow& of, double) { return of.hardening; }
    static double work(const MetalFlow& of, double alpha) { return 0.5 * of.hardening * alpha * alpha; }
};

struct VoceHardening {
    static bool is_given(const MetalFlow& of) { return of.saturation > 0.0; }
    static double rise(const MetalFlow& of, double alpha) {
        return -of.saturation * std::expm1(-of.saturation_rate * alpha);
    }
    static double slope(const MetalFlow& of, double alpha) {
        return of.saturation * of.saturation_rate * std::exp(-of.saturation_rate * alpha);
    }
    static double work(const MetalFlow& of, double alpha) {
        return of.saturation * (alpha + std::expm1(-of.saturation_rate * alpha) / of.saturation_rate);
    }
};

/// Hardening of Ludwik, and of Johnson and Cook.
struct PowerHardening {
    static bool is_given(const MetalFlow& of) { return of.power_hardening > 0.0; }
    static double rise(const MetalFlow& of, double alpha) { return of.power_hardening * std::pow(alpha, of.power_exponent); }
    static double slope(const MetalFlow& of, double alpha) {
        return of.power_hardening * of.power_exponent * std::pow(alpha, of.power_exponent - 1.0);
    }
    static double work(const MetalFlow& of, double alpha) {
        return of.power_hardening * std::pow(alpha, of.power_exponent + 1.0) / (of.power_exponent + 1.0);
    }
};

struct TableHardening {
    static bool is_given(const MetalFlow& of) { return !of.table.empty(); }
    static double rise(const MetalFlow& of, double alpha) {
        const Segment segment = segment_at(of.table, alpha);
        return segment.point->stress - of.table.front().stress + segment.slope() * (alpha - segment.point->plastic_strain);
    }
    static double slope(const MetalFlow& of, double alpha) { return segment_at(of.table, alpha).slope(); }
    static double work(const MetalFlow& of, double alpha) {
        const Segment segment = segment_at(of.table, alpha);
        const double beyond = alpha - segment.point->plastic_strain;
        return segment.work + (segment.point->stress - of.table.front().stress + 0.5 * segment.slope() * beyond) * beyond;
    }
};

/// All of them; they add up. A list of types, which the compiler sees through: each cell that flows asks several times
/// in a step. docs/method.md, Metal that yields.
using HardeningLaws = std::tuple<LinearHardening, VoceHardening, PowerHardening, TableHardening>;

/// part(law) of each that is given.
template <class Part>
double sum(const MetalFlow& metal, const Part& part) {
    return std::apply([&](auto... law) { return (0.0 + ... + (law.is_given(metal) ? part(law) : 0.0)); }, HardeningLaws{});
}

double over_reference(const MetalFlow& of, double rate) { return rate / of.johnson_cook_rate; }

/// All of them; a metal has at most one.
constexpr std::array rate_laws{
    // Cowper and Symonds: (r/D)^(1/q)
    RateLaw{[](const MetalFlow& of) { return of.cowper_symonds_rate > 0.0; },
            [](const MetalFlow& of, double rate) {
                return std::pow(rate / of.cowper_symonds_rate, 1.0 / of.cowper_symonds_exponent);
            },
            [](const MetalFlow& of, double rate) {
                const double exponent = 1.0 / of.cowper_symonds_exponent;
                return exponent / of.cowper_symonds_rate * std::pow(rate / of.cowper_symonds_rate, exponent - 1.0);
            },
            [](const MetalFlow& of, double rate) {
                const double exponent = 1.0 / of.cowper_symonds_exponent;
                return rate * std::pow(rate / of.cowper_symonds_rate, exponent) / (exponent + 1.0);
            }},
    // Johnson and Cook: C ln(r/r_0), 0 below r_0
    RateLaw{[](const MetalFlow& of) { return of.johnson_cook_rate > 0.0; },
            [](const MetalFlow& of, double rate) {
                return of.johnson_cook_factor * std::log(std::max(1.0, over_reference(of, rate)));
            },
            [](const MetalFlow& of, double rate) {
                return over_reference(of, rate) > 1.0 ? of.johnson_cook_factor / rate : 0.0;
            },
            [](const MetalFlow& of, double rate) {
                const double over = std::max(1.0, over_reference(of, rate));
                return of.johnson_cook_factor * of.johnson_cook_rate * (over * std::log(over) - over + 1.0);
            }}};

const RateLaw* rate_law(const MetalFlow& metal) {
    for (const RateLaw& law : rate_laws)
        if (law.is_given(metal)) return &law;
    return nullptr;
}

}  // namespace

double MetalFlow::stress(double plastic_strain) const {
    return yield_stress + sum(*this, [&](auto law) { return law.rise(*this, plastic_strain); });
}

double MetalFlow::slope(double plastic_strain) const {
    return sum(*this, [&](auto law) { return law.slope(*this, plastic_strain); });
}

double MetalFlow::work(double plastic_strain) const {
    return yield_stress * plastic_strain + sum(*this, [&](auto law) { return law.work(*this, plastic_strain); });
}

double MetalFlow::rate_factor(double rate) const {
    const RateLaw* law = rate_law(*this);
    return law ? 1.0 + law->rise(*this, rate) : 1.0;
}

FlowStress::FlowStress(const MetalFlow& metal, double plastic_strain, double dt)
    : metal_(metal),
      rate_law_(rate_law(metal)),
      plastic_strain_(plastic_strain),
      dt_(dt),
      at_start_(metal.stress(plastic_strain)) {}

auto FlowStress::at(double flowed) const -> Value {
    const double reached = plastic_strain_ + flowed;
    Value value{metal_.stress(reached), metal_.slope(reached)};
    if (rate_law_) {
        value.stress += at_start_ * rate_law_->rise(metal_, flowed / dt_);
        value.slope += at_start_ * rate_law_->slope(metal_, flowed / dt_) / dt_;
    }
    return value;
}

double FlowStress::work(double flowed) const {
    double work = metal_.work(plastic_strain_ + flowed) - metal_.work(plastic_strain_);
    if (rate_law_) work += at_start_ * dt_ * rate_law_->integral(metal_, flowed / dt_);
    return work;
}

}  // namespace abut::solid
