#pragma once
#include <cstdint>
#include <tuple>

#include "abut/base/vector.hpp"
#include "abut/dynamics/point_system.hpp"

namespace abut::dynamics {

/// Losses of a run with points that leave it: as it was before, less as it is after. What stays keeps H~ with work and
/// dissipation, momentum and J~; with these accounts the run as a whole does.
template <int Dim>
struct Left {
    std::int32_t cells = 0;
    double mass = 0.0;                                                            ///< [kg]
    Vector<Dim> momentum = Vector<Dim>::Zero();                                   ///< of p = (p^- + p^+)/2 [kg m/s]
    AngularMomentum<Dim> rest_angular_momentum = AngularMomentum<Dim>::Zero();    ///< about positions at rest [kg m^2/s]
    AngularMomentum<Dim> pseudo_angular_momentum = AngularMomentum<Dim>::Zero();  ///< J~ [kg m^2/s]
    double kinetic = 0.0;                                                         ///< 1/2 p^- . M^-1 p^+ [J]
    /// V, which has no sign: faces behind become free, and may touch. What faces stored that stuck is not in it:
    /// friction books it as dissipated [J]
    double potential = 0.0;

    static auto fields(auto& self) {
        return std::tie(self.cells, self.mass, self.momentum, self.rest_angular_momentum, self.pseudo_angular_momentum,
                        self.kinetic, self.potential);
    }
    [[nodiscard]] double energy() const { return kinetic + potential; }  ///< of H~ + D - W [J]
    Left& operator+=(const Left& other) {
        cells += other.cells;
        mass += other.mass;
        momentum += other.momentum;
        rest_angular_momentum += other.rest_angular_momentum;
        pseudo_angular_momentum += other.pseudo_angular_momentum;
        kinetic += other.kinetic;
        potential += other.potential;
        return *this;
    }
};

}  // namespace abut::dynamics
