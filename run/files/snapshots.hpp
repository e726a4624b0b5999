#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "abut/run/files/snapshot.hpp"
#include "abut/run/values/forward.hpp"

namespace abut::run {

/// Pictures of the bodies in a report: the snapshots that were taken, in order of time.
struct BodyPictures {
    BodyPolygons polygons;
    std::vector<Snapshot> snapshots;
};

/// Takes snapshots of a run: at the start, in the middle, near the largest force of contact and at the end. For the
/// third the forces of contact are looked at in about 60 records, and a snapshot replaces the one before where they are
/// larger by a twentieth. What it keeps is proportional to the cells in 2D, to the boundary in 3D; between snapshots it
/// does nothing.
template <int Dim>
class Snapshots {
public:
    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result);
    void record(const dynamics::LedgerEntry<Dim>& entry);
    /// Looks at the forces of contact where they are due.
    void note(const Moment<Dim>& now);
    [[nodiscard]] bool wants_sight(std::int64_t step) const { return step == wanted_step_; }
    void see(const Sight<Dim>& sight);
    void cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells);
    void end(const Sight<Dim>& sight);  ///< the last state
    /// The last sound state of a run that has failed stands for the end.
    void fail(const Sight<Dim>& sound);
    /// Memory of a checkpoint: `begin` comes first.
    static auto fields(auto& self) {
        return std::tie(self.last_impulse_, self.last_time_, self.start_, self.middle_, self.largest_);
    }

    /// Pictures taken so far.
    [[nodiscard]] BodyPictures pictures() const;

private:
    std::optional<SnapshotMaker<Dim>> maker_;  // once the run has begun
    std::int64_t middle_step_ = 0;
    std::int64_t every_ = 1;  // steps between looks at forces
    bool in_contact_ = false;
    double last_impulse_ = 0.0;  // of all contacts [N s], at the last look
    double last_time_ = 0.0;
    std::int64_t wanted_step_ = -1;  // of the next snapshot
    double force_ = 0.0;             // there, or since the last look [N]
    bool is_largest_ = false;
    std::optional<Snapshot> start_, middle_, largest_, end_;
};

}  // namespace abut::run
