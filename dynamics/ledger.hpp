#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/dynamics/integrator.hpp"
#include "abut/dynamics/left.hpp"
#include "abut/dynamics/losses.hpp"
#include "abut/dynamics/point_system.hpp"

namespace abut::dynamics {

/// Counts that a system with contact gives to its ledger.
struct ContactCounts {
    std::int64_t active_pairs = 0;  ///< in the last step
    std::int64_t events = 0;        ///< so far
    // Of friction; all 0 without any.
    double dissipated = 0.0;          ///< D so far [J]
    double friction_energy = 0.0;     ///< E, held by faces that stick: a part of V [J]
    std::int64_t sticking_faces = 0;  ///< in the last step
    std::int64_t sliding_faces = 0;   ///< the same
};

/// Report of neutral restarts so far; all zero without any. dynamics/neutral_restart.hpp
struct RestartReport {
    std::int64_t restarts = 0;   ///< steps after which bodies were restarted
    std::int64_t shortened = 0;  ///< bodies of which only a part of e could be taken, since too little vibrates
    std::int64_t skipped = 0;    ///< bodies of which nothing could be taken
    double paid = 0.0;           ///< energy that the vibration of the bodies has paid for that, less what it has got [J]
};

/// The state of a run at one step. Energies come together, since H~ alone does not prove a good solution (docs/method.md,
/// Time): H~ with H, the parasitic mode and the number of events.
template <int Dim>
struct LedgerEntry {
    std::int64_t step;
    double time;                                 ///< [s]
    double pseudo_energy;                        ///< what the scheme conserves; of MEMM H~ = 1/2 p^- . M^-1 p^+ + V [J]
    double energy;                               ///< H = 1/2 p . M^-1 p + V with p = (p^- + p^+)/2 [J]
    double kinetic;                              ///< 1/2 p . M^-1 p [J]
    double potential;                            ///< V, less the work of constant loads [J]
    double work;                                 ///< done from outside so far [J]
    Vector<Dim> linear_momentum;                 ///< [kg m/s]
    AngularMomentum<Dim> angular_momentum;       ///< sum x_i × p_i about the origin [kg m^2/s]
    AngularMomentum<Dim> rest_angular_momentum;  ///< with the positions at rest: what linear elasticity conserves
    double parasitic;                            ///< largest |e_i| / m_i [m/s]
    std::int64_t active_pairs;                   ///< in the last step
    std::int64_t events;                         ///< so far
    double restart_jumps;                        ///< what restarts with another step have added to H~ so far [J]
    double rotation;                             ///< of the body that has turned farthest [rad]
    RestartReport restarts;                      ///< so far
    /// J~, which MEMM conserves where bodies may turn [kg m^2/s]: see `pseudo_angular_momentum`
    AngularMomentum<Dim> pseudo_angular_momentum;
    double dissipated;            ///< by friction, materials and bonds so far [J]
    double friction_energy;       ///< part of `potential` that friction holds [J]
    std::int64_t sticking_faces;  ///< in the last step
    std::int64_t sliding_faces;   ///< the same
    Losses losses;                ///< `dissipated` by kind
    Left<Dim> eroded;             ///< that cells have taken along which have left so far

    /// Energy that H~ has received since the start: work and jumps of restarts, less dissipation by friction and
    /// materials, and less what cells that left took along [J].
    [[nodiscard]] double received() const { return work + restart_jumps - dissipated - eroded.energy(); }
};

/// Names of the columns of an entry, in its order; vectors by component (linear_momentum_x, ...).
template <int Dim>
[[nodiscard]] std::vector<std::string> ledger_columns();
/// The entry as numbers in the order of `ledger_columns`.
template <int Dim>
[[nodiscard]] std::vector<double> ledger_values(const LedgerEntry<Dim>& entry);
/// The other way round. Throws BadInput for another number of values than columns.
template <int Dim>
[[nodiscard]] LedgerEntry<Dim> ledger_entry(std::span<const double> values);

/// The state of an integrator of moving points as ledger and output read it, whatever the scheme. A view, valid until the
/// next step.
template <int Dim>
class RunView {
public:
    template <class Scheme, PointSystem S>
    RunView(const Integrator<Scheme, S>& integrator) requires(S::dimension == Dim)  // implicit: a view
        : steps(integrator.steps()),
          time(integrator.time()),
          q(integrator.q()),
          p_before(integrator.p_before()),
          p_after(integrator.p_after()),
          ranks(integrator.ranks()) {}
    /// View of a state, which must outlive the view, with all points of its system.
    explicit RunView(const IntegratorState& state)
        : steps(state.steps),
          time(state.time),
          q(state.q),
          p_before(state.p_before),
          p_after(state.p_after),
          ranks(one_rank()) {}

    std::int64_t steps;
    double time;                       ///< [s]
    std::span<const double> q;         ///< (n, Dim) [m]
    std::span<const double> p_before;  ///< p^{n-1/2} [kg m/s]
    std::span<const double> p_after;   ///< p^{n+1/2}
    const Ranks& ranks;                ///< whose points these are a part of
    /// p^n = (p^{n-1/2} + p^{n+1/2})/2 of a point [kg m/s]
    [[nodiscard]] Vector<Dim> momentum(std::ptrdiff_t i) const {
        return 0.5 * (as_vectors<Dim>(p_before)[i] + as_vectors<Dim>(p_after)[i]);
    }
};

/// J~ = sum x^n × p^n - dt/4 sum v^{n-1/2} × p^{n+1/2} [kg m^2/s], v = M^-1 p: the angular momentum that MEMM conserves with
/// steps of dt, exactly, where mean forces have no moment about the positions at the middle of a step
/// (MomentArms::mid_step).
template <int Dim>
[[nodiscard]] AngularMomentum<Dim> pseudo_angular_momentum(const RunView<Dim>& run, double dt,
                                                           std::span<const Vector<Dim>> rest_position,
                                                           std::span<const double> mass);

namespace detail {
/// Fills what the motion of the points alone decides; e is the parasitic momentum.
template <int Dim>
void add_motion(LedgerEntry<Dim>& entry, const RunView<Dim>& run, std::span<const double> e,
                std::span<const Vector<Dim>> rest_position, std::span<const double> mass);
/// 0 without any, NaN if one is.
[[nodiscard]] double largest_angle(std::span<const double> angles);
}  // namespace detail

/// Measures the present state; costs about two force evaluations, or one where the system has `potential_and_force`.
/// `system` is that of the integrator; `restarts` are those of the run, if it has any, and `eroded` what has left it.
template <class Scheme, PointSystem S>
[[nodiscard]] LedgerEntry<S::dimension> measure(Integrator<Scheme, S>& integrator, S& system,
                                                const RestartReport& restarts = {}, const Left<S::dimension>& eroded = {}) {
    constexpr int Dim = S::dimension;
    LedgerEntry<Dim> entry{};
    entry.eroded = eroded;
    std::vector<double> e(integrator.q().size());
    entry.potential = integrator.potential_and_parasitic_momentum(e);
    entry.kinetic = integrator.kinetic_energy();
    entry.energy = entry.kinetic + entry.potential;
    entry.pseudo_energy = integrator.pseudo_energy(entry.potential);
    entry.restart_jumps = integrator.restart_jumps();
    entry.restarts = restarts;
    if constexpr (requires { system.work(); }) entry.work = system.work();
    double friction = 0.0;
    if constexpr (requires { system.contact_counts(); }) {
        const ContactCounts counts = system.contact_counts();
        entry.active_pairs = counts.active_pairs;
        entry.events = counts.events;
        friction = counts.dissipated;
        entry.friction_energy = counts.friction_energy;
        entry.sticking_faces = counts.sticking_faces;
        entry.sliding_faces = counts.sliding_faces;
    }
    if constexpr (requires { system.dissipated(); }) entry.losses = system.dissipated();
    entry.losses.by_friction = friction;
    entry.dissipated = entry.losses.total();
    if constexpr (requires { system.rotations(integrator.q()); })
        entry.rotation = detail::largest_angle(system.rotations(integrator.q()));
    detail::add_motion<Dim>(entry, integrator, e, system.rest_positions(), system.masses());
    entry.pseudo_angular_momentum =
        pseudo_angular_momentum<Dim>(integrator, integrator.dt(), system.rest_positions(), system.masses());
    return entry;
}

/// Largest deviations of a run from its first entry.
template <int Dim>
class Ledger {
public:
    void record(const LedgerEntry<Dim>& entry);

    [[nodiscard]] const std::vector<LedgerEntry<Dim>>& entries() const { return entries_; }
    /// max |H~ - H~0 - LedgerEntry::received|, H~ being the pseudo-energy of the scheme [J]
    [[nodiscard]] double pseudo_energy_drift() const { return pseudo_energy_drift_; }
    /// max |H - H0 - work + dissipated + eroded| [J]: the true error
    [[nodiscard]] double energy_drift() const { return energy_drift_; }
    /// max (H - H~), H~ being the pseudo-energy of the scheme [J]
    [[nodiscard]] double energy_excess() const { return energy_excess_; }
    /// Largest |e_i| / m_i [m/s]
    [[nodiscard]] double parasitic() const { return parasitic_; }
    /// max |P + eroded - P0| [kg m/s]; forces from outside are not taken out.
    [[nodiscard]] double momentum_drift() const { return momentum_drift_; }
    /// max |L + eroded - L0| about the origin [kg m^2/s], what cells took along that left being that of J~; moments from
    /// outside are not taken out.
    [[nodiscard]] double angular_momentum_drift() const { return angular_momentum_drift_; }
    /// As `angular_momentum_drift`, with positions at rest [kg m^2/s].
    [[nodiscard]] double rest_angular_momentum_drift() const { return rest_angular_momentum_drift_; }
    /// As `angular_momentum_drift`, of J~ [kg m^2/s].
    [[nodiscard]] double pseudo_angular_momentum_drift() const { return pseudo_angular_momentum_drift_; }
    /// How far any body had turned at most [rad].
    [[nodiscard]] double rotation() const { return rotation_; }
    /// Largest of |H|, kinetic energy and |V| in the run [J]: what drifts of loaded runs are quoted on.
    [[nodiscard]] double largest_energy() const { return largest_energy_; }

private:
    std::vector<LedgerEntry<Dim>> entries_;
    double pseudo_energy_drift_ = 0.0;
    double energy_drift_ = 0.0;
    double energy_excess_ = 0.0;
    double parasitic_ = 0.0;
    double momentum_drift_ = 0.0;
    double angular_momentum_drift_ = 0.0;
    double rest_angular_momentum_drift_ = 0.0;
    double pseudo_angular_momentum_drift_ = 0.0;
    double rotation_ = 0.0;
    double largest_energy_ = 0.0;
};

}  // namespace abut::dynamics
