#include "studies/nodal/run_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/remedies.hpp"
#include "studies/nodal/case_files.hpp"

namespace abut::studies::nodal {
namespace {

constexpr double excess_limit = 10.0;  // a run is over where H - H~ exceeds this part of the largest energy

template <int Dim>
std::vector<double> momenta(const Case<Dim>& one, const P1Bodies<Dim>& bodies) {
    const std::vector<Motion<Dim>> motion = motion_of(one);
    std::vector<double> p(bodies.size());
    for (std::size_t i = 0; i < bodies.masses().size(); ++i) {
        const auto body = static_cast<std::size_t>(bodies.body_of_points()[i]);
        as_vectors<Dim>(std::span<double>(p))[i] = bodies.masses()[i] * motion[body].at(bodies.rest_positions()[i]);
    }
    return p;
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
    Account(const Case<Dim>& one, const std::filesystem::path& folder, P1Bodies<Dim>& bodies, std::int64_t steps,
            int records)
        : bodies_(bodies), is_free_(one.is_free), interval_(std::max<std::int64_t>(1, steps / records)), steps_(steps) {
        if (!folder.empty()) files_.emplace(folder, one, steps);
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
        return std::isfinite(excess_) && (!is_due || excess_ <= excess_limit * ledger_.largest_energy());
    }

    void finish(Figures& figures) {
        const double energy = ledger_.largest_energy();
        figures.scale = {"E0", energy};
        figures.drift = ledger_.pseudo_energy_drift() / energy;
        figures.energy_drift = ledger_.energy_drift() / energy;
        figures.excess = excess_ / energy;
        figures.parasitic = ledger_.parasitic();
        const auto over = [&](double drift, double scale) {
            return !is_free_ ? run::not_given : scale > 0.0 ? drift / scale : 0.0;
        };
        figures.momentum = over(ledger_.momentum_drift(), scales_.linear);
        figures.angular = over(ledger_.angular_momentum_drift(), scales_.angular);
        figures.rest_angular = over(ledger_.rest_angular_momentum_drift(), scales_.angular);
        figures.pseudo_angular = over(ledger_.pseudo_angular_momentum_drift(), scales_.angular);
        const contact::ContactReport& report = bodies_.contact().report();
        figures.compression = report.compression_max;
        figures.missed_contacts = report.missed_contacts;
        figures.events = report.events;
        figures.correction = bodies_.correction_share();
        figures.pair_steps = bodies_.pair_steps();
        if (files_) files_->finish(ledger_, figures);
    }

private:
    template <class Integrator>
    void record(Integrator& scheme) {
        if (ledger_.entries().empty()) scales_ = momentum_scales<Dim>(scheme, bodies_.rest_positions());
        ledger_.record(dynamics::measure(scheme, bodies_));
    }

    P1Bodies<Dim>& bodies_;
    bool is_free_;
    std::int64_t interval_, steps_;
    dynamics::Ledger<Dim> ledger_;
    std::optional<CaseFiles<Dim>> files_;
    MomentumScales scales_;
    double excess_ = 0.0;
};

template <int Dim, class Integrator>
void follow(Integrator& scheme, Account<Dim>& account, std::int64_t steps, const Watch<Dim>& watch, Figures& figures) {
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
CaseResult<Dim> run_case(const Case<Dim>& one, const std::filesystem::path& folder, const Watch<Dim>& watch, int records) {
    CaseResult<Dim> result;
    Figures& figures = result.figures;
    const run::RunOptions& options = one.run;
    const Stopwatch clock(figures.seconds);
    P1Bodies<Dim> bodies(one.scene, one.on_nodes, options.facing);
    figures.dt = options.cfl * bodies.stable_step().dt;
    auto steps = static_cast<std::int64_t>(std::ceil(one.scene.time / figures.dt));
    if (options.steps > 0) steps = std::min<std::int64_t>(steps, options.steps);
    if (const auto edges = bodies.contact().unseen_edges())
        figures.unseen_edges =
            fmt::format("edges of bodies {} and {} may go through each other where they cross: n_1 . n_2 = {:.2f}",
                        edges->edge_1.body, edges->edge_2.body, -edges->facing());
    Account<Dim> account(one, folder, bodies, steps, records);
    const auto run = [&](auto& scheme) {
        dynamics::Remedies remedies(bodies, options.filter, std::max(0, options.restart));  // not given: none
        if constexpr (std::remove_cvref_t<decltype(scheme)>::takes_node_restart) remedies.prepare(scheme);
        follow<Dim>(scheme, account, steps, watch, figures);
        result.velocity = velocities<Dim>(scheme, bodies);
    };
    const std::vector<double> p = momenta(one, bodies);
    if (options.integrator == dynamics::Scheme::memm) {
        dynamics::Memm<P1Bodies<Dim>> scheme(bodies, std::vector<double>(bodies.size(), 0.0), p, figures.dt);
        run(scheme);
    } else {
        dynamics::Leapfrog<P1Bodies<Dim>> scheme(bodies, std::vector<double>(bodies.size(), 0.0), p, figures.dt);
        run(scheme);
    }
    account.finish(figures);
    return result;
}

#define ABUT_INSTANTIATE(Dim) \
    template CaseResult<Dim> run_case<Dim>(const Case<Dim>&, const std::filesystem::path&, const Watch<Dim>&, int);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies::nodal
