#pragma once
// Private to the layer.
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>

#include "abut/base/state_bytes.hpp"
#include "abut/run/steps/start.hpp"
#include "abut/run/steps/whole_run.hpp"
#include "abut/run/watch/fine_motion.hpp"
#include "abut/run/watch/friction_watch.hpp"
#include "abut/run/watch/obstacle_watch.hpp"
#include "abut/run/watch/self_watch.hpp"
#include "abut/run/watch/surface_watch.hpp"

namespace abut::run {

/// Watches of a run: each looks when it is due, and what they find is in Start::result. The constructor and
/// functions that take the run are calls of all ranks.
template <int Dim>
class Watches {
public:
    /// Both must outlive it.
    Watches(Start<Dim>& start, const WholeRun<Dim>& whole);

    /// Cells have left: they watch the rest of the scene from now on.
    void take_rest();

    // At records

    /// How far bodies have turned, and how fully they rub.
    void record(const dynamics::LedgerEntry<Dim>& entry, std::span<const double> q);
    /// Looks, where one is due, for bodies past a rim and together with themselves, and for motion from cell to cell. Throws
    /// Diverged where a body has gone through itself.
    void look_around(const dynamics::RunView<Dim>& run);

    // At the surfaces

    [[nodiscard]] bool is_look_due(std::int64_t step) const { return surfaces_->is_due(step); }
    void look_at_surfaces(const dynamics::RunView<Dim>& run);
    /// The last state, on rank 0.
    void end(const Sight<Dim>& sight, const contact::ContactReport& contact);
    /// After the run.
    void take_figures() const;

    /// Memory of all watches and of the accounts of the result: that of a checkpoint.
    static auto fields(auto& self) {
        auto& result = self.start_.result;
        return std::tie(result.energy.accounts, result.contact.sliding, *self.surfaces_, result.watch.sightings,
                        result.watch.turned, self.friction_, result.energy.fine_max);
    }

private:
    [[nodiscard]] bool is_sighting_due(std::int64_t step) const;
    void look_at_obstacles(std::span<const double> q, double time);
    void look_for_crossings(const dynamics::RunView<Dim>& run);
    void look_at_fine_motion(const dynamics::RunView<Dim>& run);
    void record_turned(std::span<const double> q);

    Start<Dim>& start_;
    const WholeRun<Dim>& whole_;
    ObstacleWatch<Dim> obstacles_;
    FrictionWatch<Dim> friction_;
    std::optional<SelfWatch<Dim>> self_;          // always there
    std::optional<SurfaceWatch<Dim>> surfaces_;   // always there, on rank 0
    std::optional<FineMotion<Dim>> fine_motion_;  // on rank 0, from the first look on
};

}  // namespace abut::run
