#pragma once
// Private to the layer.
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/run/steps/start.hpp"
#include "abut/run/steps/whole_run.hpp"
#include "abut/run/values/failure.hpp"
#include "abut/run/watch/last_sound.hpp"

namespace abut::run {

/// The last state of a run in which nothing was wrong, and what its observer is told of where something is. Its functions,
/// except `keep`, `state` and `replace`, are calls of all ranks.
template <int Dim>
class Soundness {
public:
    /// All must outlive it.
    Soundness(Start<Dim>& start, const WholeRun<Dim>& whole, Observer<Dim>& observer)
        : start_(start), whole_(whole), observer_(observer) {}

    /// The present state is sound.
    template <class Integrator>
    void keep(const Integrator& integrator) {
        sound_.keep(integrator, start_.result.run.dt);
    }
    [[nodiscard]] const dynamics::IntegratorState& state() const { return sound_.state(); }  ///< of the points of this rank
    void replace(dynamics::IntegratorState state) { sound_.replace(std::move(state)); }

    /// Looks at the last entry of the ledger, with H - H~ of those before it [J], and keeps the state if it is sound. Throws
    /// Diverged where the run is lost, once the observer knows.
    template <class Integrator>
    void judge(const Integrator& integrator, double excess_before) {
        if (!is_alive(excess_before)) refuse(integrator.state());
        if (is_sound()) keep(integrator);
    }

    /// Reports a step that has no end, or cells that cannot leave.
    void tell_of_step(const Error& error);
    /// Reports a body that has gone through itself in this state.
    void tell_of_crossing(const dynamics::IntegratorState& state);

private:
    [[nodiscard]] double scale() const;
    [[nodiscard]] bool is_sound() const;
    [[nodiscard]] bool is_alive(double excess_before) const;
    void refuse(const dynamics::IntegratorState& state);
    struct CellMotions {
        std::vector<Vector<Dim>> displacement, velocity;  // by cell of the whole, on rank 0
    };
    [[nodiscard]] CellMotions motions_in(const dynamics::IntegratorState& own) const;
    void tell(const dynamics::IntegratorState& own_sound, Failure failure);

    Start<Dim>& start_;
    const WholeRun<Dim>& whole_;
    Observer<Dim>& observer_;
    LastSound sound_;
};

}  // namespace abut::run
