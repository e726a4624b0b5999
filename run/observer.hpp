#pragma once
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/run/values/forward.hpp"

namespace abut::run {

/// Looks on while a scene is run; by itself nothing. An exception that it throws ends the run; a run that it asks to stop
/// ends well, earlier. Where several ranks run a scene, that of rank 0 is called, and sees all of it, but no solid: `look`
/// and `look_at_time` are left out. It is asked once per step what it wants, `asks_to_stop` and all that begins with
/// `wants_`. Of the others `piece` alone is called.
template <int Dim>
class Observer {
public:
    virtual ~Observer() = default;
    /// While bodies are brought to rest (RunOptions::settle), before `begin`: steps so far and the largest speed of a
    /// body's points [m/s], now and then. `asks_to_stop` is asked with it: true ends the run by an error, as there is
    /// nothing to go on from.
    virtual void settling(std::int64_t /*step*/, double /*speed*/) {}
    /// All is set up, no step is taken.
    virtual void begin(const Scene<Dim>&, const RunResult<Dim>&) {}
    /// An entry of the ledger: at the start, every `interval` steps and at the end. It is in `result.ledger` already.
    virtual void record(const dynamics::LedgerEntry<Dim>&, const RunResult<Dim>&) {}
    /// State at the start and after each step: after `record`, before anything is asked of it.
    virtual void note(const Moment<Dim>&) {}
    /// True if `see` has something to do at the start (0) or after this step: else it is not called. On several ranks the
    /// values of all cells are brought together for it, on rank 0.
    [[nodiscard]] virtual bool wants_sight(std::int64_t /*step*/) const { return false; }
    virtual void see(const Sight<Dim>&) {}
    /// At each of RunOptions::times, before `see` and `look` at the node after it: bodies are on the path of the step, with
    /// its velocity. Loads, obstacles and what materials and friction remember are those of the time.
    virtual void see_at_time(const Sight<Dim>&) {}

    // The solid itself: where one rank has all of it

    virtual void look(const dynamics::RunView<Dim>&, solid::Solid<Dim>&) {}  ///< at the start and after each step
    /// True if `look` has something to do at the start (0) or after this step: else it is not called.
    [[nodiscard]] virtual bool wants_look(std::int64_t /*step*/) const { return true; }
    /// As `see_at_time`. Inside of a step the solid is another one than that of the run, which went there from the node
    /// before.
    virtual void look_at_time(const dynamics::RunView<Dim>&, solid::Solid<Dim>&) {}
    /// Cells have left after this step, before its record: from now on the solid is another one, whose cell i is cell
    /// first_cells[i] of the scene's mesh, increasing, whose cells have their vertices and faces in the same order
    /// (mesh::old_vertices, mesh::old_faces). After `resume` where some had left before.
    virtual void cells_left(const solid::Solid<Dim>&, std::span<const std::int32_t> /*first_cells*/) {}
    virtual void end(const Sight<Dim>&) {}  ///< the last state: all steps are taken, or it was asked to stop
    virtual void progress(std::int64_t /*step*/, double /*time*/) {}  ///< at the start and after each step, before `see`
    /// Asked at the start and after each step but the last: true makes it the last one, which is recorded in any case.
    [[nodiscard]] virtual bool asks_to_stop() const { return false; }
    /// A step could not be ended, or the run has diverged: nothing follows but the error, whatever is thrown here. The last
    /// sound state is shown; where Failure::not_evaluated says why not, displacements and velocities of the cells alone.
    virtual void fail(const Failure&, const Sight<Dim>& /*sound*/) {}

    // Frames in pieces: each rank looks at its own cells, and nothing is brought together

    /// The number of the frame of which each rank is to have its piece at the start (0) or after this step; -1: of
    /// none. Asked of the observer of rank 0 alone.
    [[nodiscard]] virtual std::int64_t wants_piece(std::int64_t /*step*/) const { return -1; }
    virtual void piece(const FramePiece<Dim>&) {}  ///< of this rank, on each; must not call what all ranks call together
    virtual void all_pieces(const FramePiece<Dim>&) {}  ///< on rank 0, with its own, once `piece` has ended on all of them

    // Runs that survive: docs/checkpoints.md

    /// Asked after each step, before `see`: whether somebody keeps a checkpoint of it; `stops`: it is the last one for now.
    [[nodiscard]] virtual bool wants_checkpoint(std::int64_t /*step*/, bool /*stops*/) const { return false; }
    virtual void keep(const Checkpoint&) {}  ///< a checkpoint, wherever one is wanted
    /// Writes all that `resume` needs, for a checkpoint.
    virtual void save(StateWriter&) {}
    /// In place of `begin`, where a run goes on after a checkpoint: `result` has the entries of the ledger until then,
    /// `state` holds what `save` has put there.
    virtual void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader&) { begin(scene, result); }
};

/// Several observers as one; they are called in the order given, and must outlive it. Any of them may ask to stop.
///
///     run::Observers<2> all{files, progress};
template <int Dim>
class Observers : public Observer<Dim> {
public:
    Observers(std::initializer_list<std::reference_wrapper<Observer<Dim>>> observers) : observers_(observers) {}
    void add(Observer<Dim>& observer) { observers_.push_back(observer); }

    void settling(std::int64_t step, double speed) override;
    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override;
    void record(const dynamics::LedgerEntry<Dim>& entry, const RunResult<Dim>& result) override;
    void note(const Moment<Dim>& moment) override;
    [[nodiscard]] bool wants_sight(std::int64_t step) const override;
    void see(const Sight<Dim>& sight) override;
    void see_at_time(const Sight<Dim>& sight) override;
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override;
    [[nodiscard]] bool wants_look(std::int64_t step) const override;
    void look_at_time(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override;
    void cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) override;
    void end(const Sight<Dim>& sight) override;
    void progress(std::int64_t step, double time) override;
    [[nodiscard]] bool asks_to_stop() const override;
    void fail(const Failure& failure, const Sight<Dim>& sound) override;
    [[nodiscard]] std::int64_t wants_piece(std::int64_t step) const override;  ///< one of them may want pieces
    void piece(const FramePiece<Dim>& piece) override;
    void all_pieces(const FramePiece<Dim>& piece) override;
    [[nodiscard]] bool wants_checkpoint(std::int64_t step, bool stops) const override;
    void keep(const Checkpoint& checkpoint) override;
    void save(StateWriter& state) override;
    void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) override;

private:
    std::vector<std::reference_wrapper<Observer<Dim>>> observers_;
};

}  // namespace abut::run
