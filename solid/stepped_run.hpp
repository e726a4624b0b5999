#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/remedies.hpp"
#include "abut/solid/change.hpp"
#include "abut/solid/run_remedies.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

/// A solid under MEMM whose steps a program asks for one by one, as Python and C do. On several ranks its functions are
/// calls of all of them, with the points of each. run::simulate makes runs from their first step to the last.
template <int Dim>
class SteppedRun {
public:
    using Memm = dynamics::Memm<Solid<Dim>>;

    /// From displacements and momenta of the points (n_points, Dim) [m], [kg m/s]. Throws as Memm and Remedies.
    SteppedRun(std::unique_ptr<Solid<Dim>> solid, std::vector<double> q, std::span<const double> p, double dt,
               const RunRemedies& remedies);
    SteppedRun(const SteppedRun&) = delete;
    SteppedRun& operator=(const SteppedRun&) = delete;

    /// Throws as Memm::step, with step and time in front of the message.
    void step();
    /// The steps that follow have this dt [s]. Returns a warning at the first change by more than 5 % after a step, which
    /// names `clock`, what its caller calls the remedy (ClockedRun); else nothing. Throws as Memm::set_step.
    [[nodiscard]] std::string set_step(double dt, dynamics::StepChange change,
                                       const std::string& clock = "solid::ClockedRun");
    /// Adds the present state to the ledger. Throws Diverged where its energy is not finite.
    void record();

    /// Goes back to a state of this run (run_state), with what restarts had reported then: what follows has the same
    /// bits. The ledger keeps its entries. Throws as go_on_from.
    void restore(const RunState& state, const dynamics::RestartReport& restarts);

    /// Goes on with another solid, whose mesh has fewer cells or other numbers: change.hpp, which says what it throws, and
    /// nothing has changed then. The one before is gone.
    Left<Dim> change(std::unique_ptr<Solid<Dim>> after, std::span<const std::int32_t> old_cells);

    [[nodiscard]] Solid<Dim>& solid() { return *solid_; }
    [[nodiscard]] const Solid<Dim>& solid() const { return *solid_; }
    [[nodiscard]] Memm& memm() { return *memm_; }
    [[nodiscard]] const Memm& memm() const { return *memm_; }
    [[nodiscard]] const dynamics::Ledger<Dim>& ledger() const { return ledger_; }
    [[nodiscard]] dynamics::RestartReport restarts() const { return remedies_->report(); }

private:
    [[nodiscard]] std::string at_step(std::int64_t step, const char* what) const;

    RunRemedies given_;
    std::unique_ptr<Solid<Dim>> solid_;
    std::optional<Memm> memm_;
    std::optional<dynamics::Remedies<Solid<Dim>>> remedies_;
    dynamics::Ledger<Dim> ledger_;
    bool has_warned_ = false;  // of a step that changes
};

}  // namespace abut::solid
