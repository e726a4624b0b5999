#pragma once
// Private to the layer.
#include <cstddef>
#include <utility>
#include <vector>

#include "abut/dynamics/integrator.hpp"
#include "abut/run/steps/of_all_ranks.hpp"
#include "abut/run/steps/start.hpp"

namespace abut::run {

/// The whole of a run, for its observers: they are on rank 0, and the other ranks take part where the whole is brought
/// together. On one rank it is the run itself. All functions except `seen` are calls of all ranks.
template <int Dim>
class WholeRun {
public:
    /// `start` must outlive it, and may take another part.
    explicit WholeRun(Start<Dim>& start) : start_(start) {}

    /// Solid of all cells, on rank 0.
    [[nodiscard]] solid::Solid<Dim>& seen() const { return start_.whole ? *start_.whole : *start_.solid; }

    template <class Body>
    void on_first(const Body& body) const {
        run::on_first(ranks(), body);
    }

    /// With the points of all ranks, on rank 0.
    [[nodiscard]] dynamics::IntegratorState of(dynamics::IntegratorState state) const {
        return collected<Dim>(ranks(), std::move(state));
    }

    /// Calls see(run, solid) with the present state of the whole, on rank 0.
    template <class Integrator, class See>
    void show(const Integrator& integrator, const See& see) const {
        if (ranks().is_one()) return see(dynamics::RunView<Dim>(integrator), *start_.solid);
        show_state(integrator.state(), see);
    }
    /// Calls it with another state, of the points of this rank and near the present one.
    template <class See>
    void show_state(const dynamics::IntegratorState& own, const See& see) const {
        if (ranks().is_one()) return see(dynamics::RunView<Dim>(own), *start_.solid);
        const dynamics::IntegratorState state = of(own);
        const std::vector<std::byte> memory = start_.solid->state();
        on_first([&] {
            start_.whole->restore(memory, state.q);
            see(dynamics::RunView<Dim>(state), *start_.whole);
        });
    }

    /// In `show`: faces stand where contact has moved them in the last evaluation. On one rank that was at the record
    /// before; the whole that rank 0 sees was only restored.
    void evaluate(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) const {
        if (!ranks().is_one()) static_cast<void>(solid.potential(run.q));
    }

private:
    [[nodiscard]] const dynamics::Ranks& ranks() const { return start_.solid->ranks(); }

    Start<Dim>& start_;
};

}  // namespace abut::run
