#pragma once
// Private to the sources of this layer.
#include "abut/solid/material/metal_flow.hpp"

namespace abut::solid {

struct RateLaw;

/// The stress at which a metal flows in one step, as a function of the plastic strain d that the
/// step adds:
///
///     sigma(d) = sigma(alpha + d) + sigma(alpha) (factor(d/dt) - 1)
///
/// alpha being the equivalent plastic strain at its start, sigma(alpha) MetalFlow::stress, and `factor` that of the
/// rate. It does not fall as d grows, and is the slope of `work`: rates that multiply the stress at the start, and not
/// that at the end, make it so.
class FlowStress {
public:
    /// `dt` > 0 [s]: of the step. The metal must outlive it.
    FlowStress(const MetalFlow& metal, double plastic_strain, double dt);

    /// At d = 0 [Pa]: below it nothing flows.
    [[nodiscard]] double at_start() const { return at_start_; }
    struct Value {
        double stress;  ///< [Pa]
        double slope;   ///< per d [Pa]; infinite at d = 0 for some laws
    };
    [[nodiscard]] Value at(double flowed) const;
    /// The integral of the stress from 0 to d [J/m^3].
    [[nodiscard]] double work(double flowed) const;

private:
    const MetalFlow& metal_;
    const RateLaw* rate_law_;  // null where the metal knows no rates
    double plastic_strain_, dt_, at_start_;
};

}  // namespace abut::solid
