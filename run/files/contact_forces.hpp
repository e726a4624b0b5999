#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/run/values/forward.hpp"
#include "abut/solid/contact/contact_results.hpp"

namespace abut::run {

/// Contact between two bodies, or a body and an obstacle, since the rows before.
template <int Dim>
struct ForceRow {
    std::int64_t step = 0;
    double time = 0.0;                           ///< [s]
    std::int32_t body_1 = 0;                     ///< bodies, then obstacles behind them
    std::int32_t body_2 = 0;                     ///< the same
    Vector<Dim> force{};                         ///< on body 2, the mean since the rows before [N]
    double normal_force = 0.0;                   ///< the sum over all faces of what presses them together, the mean [N]
    Vector<Dim> friction = Vector<Dim>::Zero();  ///< part of `force` that is friction [N]
    double rubbing_force = 0.0;                  ///< part of `normal_force` where there is friction [N]
    /// Velocity of body 2 past body 1 [m/s]: the mean over faces with friction, weighted with the force that presses on
    /// them.
    Vector<Dim> slip_velocity = Vector<Dim>::Zero();
};

/// Forces of contact of a run: a row for each pair that touched since the last rows, every `Outputs::interval` steps
/// and at the end. Force times interval, summed over all rows, is the change of momentum that contact made, to
/// round-off; not so of Bilbao's scheme, whose steps take more than the force.
template <int Dim>
class ContactForces {
public:
    ContactForces() = default;
    ContactForces(const Scene<Dim>& scene, const RunResult<Dim>& result);

    [[nodiscard]] bool wants_look(std::int64_t step) const;
    /// To be called at the start, too, where there are no rows.
    [[nodiscard]] std::vector<ForceRow<Dim>> rows(const Moment<Dim>& now);
    /// Memory of a checkpoint.
    static auto fields(auto& self) { return std::tie(self.time_, self.last_); }

private:
    std::int64_t interval_ = 1;
    std::int64_t n_steps_ = 0;
    double time_ = std::numeric_limits<double>::quiet_NaN();  // of the last rows, or of the start [s]
    std::map<std::pair<std::int32_t, std::int32_t>, solid::BodyImpulse<Dim>> last_;
};

}  // namespace abut::run
