#pragma once
// Private to the layer.
#include <cstddef>
#include <vector>

#include "abut/run/observer.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/steps/share.hpp"
#include "abut/run/values/settling_report.hpp"

namespace abut::run {

/// Bodies at rest under the loads of t = 0.
struct Settled {
    std::vector<double> q;         ///< displacements of the points of this rank (n_points, Dim) [m]
    std::vector<std::byte> solid;  ///< what pairs and faces remember: Solid::state of a run that begins here
    SettlingReport report;
};

/// Brings bodies to rest by kinetic damping: they move from `q` on under the scene's own laws, friction included, with loads
/// and obstacles as they are at t = 0, and whenever their kinetic energy has passed a peak all velocities are set to 0. Once
/// the peaks are below 1e-12 of the largest one it goes on as long as they fall, to round-off.
/// `stable_dt`: the stable step of the solid [s]. `observer` of rank 0 is told how far it is. On several ranks all call
/// this.
///
/// Throws BadInput for a body that nothing holds and loads push, before anything moves, and, with the fastest body, its
/// speed and how it moves, where bodies do not come to rest: they fall, slide or roll; and std::runtime_error where the
/// observer asks to stop.
template <int Dim>
[[nodiscard]] Settled settle(const Scene<Dim>& scene, const solid::SolidOptions<Dim>& options, const Share<Dim>& share,
                             std::vector<double> q, double stable_dt, Observer<Dim>& observer);

}  // namespace abut::run
