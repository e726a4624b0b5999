#pragma once
// Private to the layer.
#include <utility>

#include "abut/dynamics/gathered_state.hpp"
#include "abut/dynamics/integrator.hpp"
#include "abut/run/steps/of_all_ranks.hpp"
#include "abut/run/steps/start.hpp"
#include "abut/run/values/sight.hpp"

namespace abut::run {

/// The whole of a run, for its observers: they are on rank 0, which brings together what they want to see. On one rank it
/// is the run itself. All functions are calls of all ranks.
template <int Dim>
class WholeRun {
public:
    /// `start` must outlive it, and may take another part.
    explicit WholeRun(Start<Dim>& start) : start_(start) {}

    template <class Body>
    void on_first(const Body& body) const {
        run::on_first(ranks(), body);
    }

    /// With the points of all ranks, on rank 0.
    [[nodiscard]] dynamics::IntegratorState of(dynamics::IntegratorState state) const {
        return dynamics::collected<Dim>(ranks(), std::move(state));
    }

    /// Calls see(sight) with what is to be seen in a state of this rank's points, on rank 0.
    template <class See>
    void show(const dynamics::RunView<Dim>& own, const See& see, Evaluated evaluated = Evaluated::no) const {
        show(own, *start_.solid, see, evaluated);
    }
    /// Shows a state of another solid of this rank.
    template <class See>
    void show(const dynamics::RunView<Dim>& own, solid::Solid<Dim>& solid, const See& see,
              Evaluated evaluated = Evaluated::no) const {
        const Sight<Dim> sight = sight_of<Dim>(own, solid, start_.present().mesh, evaluated);
        on_first([&] { see(sight); });
    }

private:
    [[nodiscard]] const dynamics::Ranks& ranks() const { return start_.solid->ranks(); }

    Start<Dim>& start_;
};

}  // namespace abut::run
