#include "studies/nodal/impact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/neutral_restart.hpp"
#include "studies/nodal/impact_files.hpp"

namespace abut::studies::nodal {
namespace {

template <int Dim>
std::vector<double> momenta(const Impact<Dim>& impact, const P1Bodies<Dim>& bodies) {
    std::vector<double> p(bodies.size());
    for (std::size_t i = 0; i < bodies.masses().size(); ++i) {
        const auto& motion = impact.motion[static_cast<std::size_t>(bodies.body_of_points()[i])];
        as_vectors<Dim>(std::span<double>(p))[i] = bodies.masses()[i] * motion.at(bodies.rest_positions()[i]);
    }
    return p;
}

/// Sum of m |v| [kg m/s].
template <int Dim>
double size_of(std::span<const double> p) {
    double sum = 0.0;
    for (const Vector<Dim>& one : as_vectors<Dim>(p)) sum += one.norm();
    return sum;
}

/// Sum of |x × p| [kg m^2/s].
template <int Dim>
double moment_size(const dynamics::RunView<Dim>& run, const P1Bodies<Dim>& bodies) {
    const auto u = as_vectors<Dim>(run.q);
    double sum = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i)
        sum += moment<Dim>(bodies.rest_positions()[i] + u[i], run.momentum(static_cast<std::ptrdiff_t>(i))).norm();
    return sum;
}

template <int Dim>
std::vector<Vector<Dim>> velocities(const dynamics::RunView<Dim>& run, const P1Bodies<Dim>& bodies) {
    const auto n = static_cast<std::size_t>(bodies.mesh().n_bodies());
    std::vector<Vector<Dim>> velocity(n, Vector<Dim>::Zero());
    std::vector<double> mass(n, 0.0);
    for (std::size_t i = 0; i < bodies.masses().size(); ++i) {
        const auto body = static_cast<std::size_t>(bodies.body_of_points()[i]);
        velocity[body] += run.momentum(static_cast<std::ptrdiff_t>(i));
        mass[body] += bodies.masses()[i];
    }
    for (std::size_t body = 0; body < n; ++body) velocity[body] /= mass[body];
    return velocity;
}

/// Figures of a run as it goes.
template <int Dim>
class Account {
public:
    Account(const Impact<Dim>& impact, const ImpactOptions& options, P1Bodies<Dim>& bodies, std::int64_t steps)
        : options_(options), bodies_(bodies), interval_(std::max<std::int64_t>(1, steps / options.records)), steps_(steps) {
        if (!options.out.empty()) files_.emplace(options, impact, steps);
    }

    /// Whether the run may go on.
    template <class Integrator>
    bool look(Integrator& scheme, const Watch<Dim>& watch) {
        excess_ = std::max(excess_, scheme.energy_excess());
        const bool is_due = scheme.steps() % interval_ == 0 || scheme.steps() == steps_;
        if (is_due) record(scheme);
        const dynamics::RunView<Dim> view(scheme);
        if (files_) files_->look(view, bodies_);
        if (watch && is_due) watch(view, bodies_);
        // A scene may begin at rest, without energy: what it has is known where it is recorded.
        return std::isfinite(excess_) && (!is_due || excess_ <= options_.excess_limit * ledger_.largest_energy());
    }

    void finish(ImpactFigures& figures) {
        const double energy = ledger_.largest_energy();
        figures.largest_energy = energy;
        figures.drift = ledger_.pseudo_energy_drift() / energy;
        figures.energy_drift = ledger_.energy_drift() / energy;
        figures.excess = excess_ / energy;
        figures.parasitic = ledger_.parasitic();
        figures.momentum = momentum_scale_ > 0.0 ? ledger_.momentum_drift() / momentum_scale_ : 0.0;
        if (turning_scale_ > 0.0) {
            figures.angular = ledger_.angular_momentum_drift() / turning_scale_;
            figures.rest_angular = ledger_.rest_angular_momentum_drift() / turning_scale_;
            figures.pseudo_angular = turning_drift_ / turning_scale_;
        }
        const contact::ContactReport& report = bodies_.contact().report();
        figures.compression = report.compression_max;
        figures.missed_contacts = report.missed_contacts;
        figures.events = report.events;
        figures.correction = bodies_.correction_share();
        figures.pair_steps = bodies_.pair_steps();
        if (files_) files_->finish(figures);
    }

private:
    template <class Integrator>
    void record(Integrator& scheme) {
        const auto entry = dynamics::measure(scheme, bodies_);
        const AxialVector<Dim> turning =
            dynamics::pseudo_angular_momentum<Dim>(scheme, scheme.dt(), bodies_.rest_positions(), bodies_.masses());
        if (ledger_.entries().empty()) {
            turning_0_ = turning;
            turning_scale_ = moment_size<Dim>(scheme, bodies_);
            momentum_scale_ = 0.5 * (size_of<Dim>(scheme.p_before()) + size_of<Dim>(scheme.p_after()));
        }
        turning_drift_ = std::max(turning_drift_, (turning - turning_0_).norm());
        ledger_.record(entry);
        if (files_) files_->record(entry, turning);
    }

    const ImpactOptions& options_;
    P1Bodies<Dim>& bodies_;
    std::int64_t interval_, steps_;
    dynamics::Ledger<Dim> ledger_;
    std::optional<ImpactFiles<Dim>> files_;
    AxialVector<Dim> turning_0_ = AxialVector<Dim>::Zero();
    double turning_drift_ = 0.0, turning_scale_ = 0.0, momentum_scale_ = 0.0, excess_ = 0.0;
};

template <int Dim, class Integrator>
void follow(Integrator& scheme, Account<Dim>& account, std::int64_t steps, const Watch<Dim>& watch, ImpactFigures& figures) {
    try {
        bool goes_on = account.look(scheme, watch);
        while (goes_on && scheme.steps() < steps) {
            {
                const Stopwatch clock(figures.seconds_of_steps);
                scheme.step();
            }
            goes_on = account.look(scheme, watch);
        }
        figures.is_complete = goes_on;
        if (!goes_on) figures.ending = "H - H~ grows beyond all measure";
    } catch (const Error& error) {
        figures.ending = error.what();
    }
    figures.steps = scheme.steps();
}

}  // namespace

template <int Dim>
Vector<Dim> RigidMotion<Dim>::at(const Vector<Dim>& x) const {
    return velocity + dynamics::turning_velocity<Dim>(spin, x - centre);
}

template <int Dim>
ImpactResult<Dim> run_impact(const Impact<Dim>& impact, const ImpactOptions& options, const Watch<Dim>& watch) {
    ImpactResult<Dim> result;
    ImpactFigures& figures = result.figures;
    const Stopwatch clock(figures.seconds);
    P1Bodies<Dim> bodies(impact.scene);
    figures.dt = options.cfl * bodies.stable_step().dt;
    auto steps = static_cast<std::int64_t>(std::ceil(impact.time / figures.dt));
    if (options.steps > 0) steps = std::min(steps, options.steps);
    if (const auto edges = bodies.contact().unseen_edges())
        figures.unseen_edges =
            fmt::format("edges of bodies {} and {} may go through each other where they cross: n_1 . n_2 = {:.2f}",
                        edges->edge_1.body, edges->edge_2.body, -edges->facing());
    Account<Dim> account(impact, options, bodies, steps);
    const auto run = [&](auto& scheme) {
        dynamics::NeutralFilter<P1Bodies<Dim>> filter(bodies);
        if (options.filter) scheme.set_after_step(filter);
        dynamics::NeutralRestart<P1Bodies<Dim>> restart(bodies, {.period = std::max(1, options.restart)});
        if constexpr (std::remove_reference_t<decltype(scheme)>::takes_node_restart)
            if (options.restart > 0)
                scheme.set_node_restart([&](auto q, double dt, auto before, auto after) { restart(q, dt, before, after); });
        follow<Dim>(scheme, account, steps, watch, figures);
        result.velocity = velocities<Dim>(scheme, bodies);
        result.q.assign(scheme.q().begin(), scheme.q().end());
    };
    const std::vector<double> p = momenta(impact, bodies);
    if (options.scheme == Scheme::memm) {
        dynamics::Memm<P1Bodies<Dim>> scheme(bodies, std::vector<double>(bodies.size(), 0.0), p, figures.dt);
        run(scheme);
    } else {
        dynamics::Leapfrog<P1Bodies<Dim>> scheme(bodies, std::vector<double>(bodies.size(), 0.0), p, figures.dt);
        run(scheme);
    }
    account.finish(figures);
    return result;
}

#define ABUT_INSTANTIATE(Dim)         \
    template struct RigidMotion<Dim>; \
    template ImpactResult<Dim> run_impact<Dim>(const Impact<Dim>&, const ImpactOptions&, const Watch<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies::nodal
