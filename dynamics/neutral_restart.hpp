#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/ranks.hpp"

namespace abut::dynamics {

/// A system that says which of its points make up each body.
template <class S>
concept BodySystem = MomentSystem<S> && requires(const S& system) {
    { system.body_of_points() } -> std::convertible_to<std::span<const std::int32_t>>;  ///< (n), counted from 0
};

struct RestartOptions {
    int period = 50;                ///< steps from one restart to the next
    std::int64_t steps_before = 0;  ///< that the run had taken when it was saved, for it to go on with the same bits
    RestartReport report_before;    ///< what it had reported by then
};

namespace detail {

/// The points of one body, or those of them that a rank has.
struct BodyPoints {
    std::span<const std::int32_t> points;  ///< increasing
    Summands among_all = {};               ///< of several ranks: the numbers of all its points
};

/// The points of each body.
class PointsOfBodies {
public:
    /// Throws BadInput unless there are n bodies' numbers, none below 0; on several ranks, of which it is a call of all,
    /// also where the points of a body do not follow each other.
    PointsOfBodies(std::span<const std::int32_t> body_of_points, std::size_t n, const Ranks& ranks);

    /// Number of bodies of all ranks.
    [[nodiscard]] std::size_t n_bodies() const { return offset_.size() - 1; }
    [[nodiscard]] BodyPoints operator[](std::size_t body) const {
        const std::span<const std::int32_t> all(points_);
        return {all.subspan(offset_[body], offset_[body + 1] - offset_[body]),
                among_all_.empty() ? Summands{} : among_all_[body]};
    }

private:
    void find_among_all(const Ranks& ranks);

    std::vector<std::int32_t> points_;  // body by body
    std::vector<std::size_t> offset_;   // of the first point of each body, and the end
    std::vector<Summands> among_all_;   // by body; empty on one rank
};

/// Throws BadInput for a period below 1 or steps below 0.
void check_restart(const RestartOptions& options);

/// A node of the whole system.
template <int Dim>
struct NodeView {
    std::span<const double> mass;                ///< (n)
    std::span<const Vector<Dim>> rest_position;  ///< (n)
    std::span<const Vector<Dim>> q;              ///< (n)
    std::span<const Vector<Dim>> force;          ///< F(q) (n)
    std::span<Vector<Dim>> p_before;             ///< (n)
    std::span<Vector<Dim>> p_after;              ///< (n)
    MomentArms arms;
    double dt;
    const Ranks& ranks;  ///< of the system
};

/// Restarts one body. A call of all ranks.
template <int Dim>
void restart_body(const BodyPoints& body, const NodeView<Dim>& node, RestartReport& report);

}  // namespace detail

/// Every so many steps of MEMM, takes the alternating mode out of whole bodies, without touching q, H~, nor momentum and
/// angular momentum of any body: those of `moment_arms`, J~ or that about the positions at rest. docs/filter.md:
///
///     p^{n-+1/2} <- r' + sigma k -+ w'/2,   w' = dt F + (1 - theta) e
///
/// p = (p^{n-1/2} + p^{n+1/2})/2 is split into a rigid motion and the rest k, about the positions at rest or about the arms
/// x + dt/4 M^-1 w', with which J~ is sum arm × p. r' is the rigid motion that carries the momentum and the angular momentum
/// of the body; sigma makes H~ what it was: the vibration pays for e, the motion as a whole does not, whether something
/// holds the body or not. theta = 1 takes all of e; it is halved until 1/4 <= sigma^2 <= 1.21. A body in which nothing
/// vibrates is left as it is, and counted; a rigid one is left as it is. One force evaluation per restart; the bits do
/// not depend on the number of threads and ranks.
template <BodySystem S>
class NeutralRestart {
public:
    static constexpr int Dim = S::dimension;

    /// The system must outlive it. Throws BadInput for options out of range, or if not every point has a body. On several
    /// ranks it and every restart are calls of all.
    explicit NeutralRestart(S& system, RestartOptions options = {})
        : system_(system),
          options_(options),
          steps_(options.steps_before),
          bodies_(system.body_of_points(), system.masses().size(), ranks_of(system)),
          is_rigid_(bodies_.n_bodies(), false),
          force_(system.size()),
          report_(options.report_before) {
        detail::check_restart(options);
        if constexpr (ConstrainedSystem<S>)
            if (system.has_constraints()) find_rigid();
    }

    /// To be called after each step, and after a filter (Integrator::set_node_restart).
    void operator()(std::span<const double> q, double dt, std::span<double> p_before, std::span<double> p_after) {
        if (++steps_ % options_.period != 0) return;
        system_.force(q, force_);
        const detail::NodeView<Dim> node{.mass = system_.masses(),
                                         .rest_position = system_.rest_positions(),
                                         .q = as_vectors<Dim>(q),
                                         .force = as_vectors<Dim>(std::span<const double>(force_)),
                                         .p_before = as_vectors<Dim>(p_before),
                                         .p_after = as_vectors<Dim>(p_after),
                                         .arms = system_.moment_arms(),
                                         .dt = dt,
                                         .ranks = ranks_of(system_)};
        ++report_.restarts;
        for (std::size_t body = 0; body < bodies_.n_bodies(); ++body) {
            if (is_rigid_[body]) continue;  // nothing in it vibrates, and it would not stay rigid
            detail::restart_body<Dim>(bodies_[body], node, report_);
        }
    }

    [[nodiscard]] const RestartReport& report() const { return report_; }

private:
    /// A rank may have no points of a body.
    void find_rigid() {
        for (std::size_t body = 0; body < bodies_.n_bodies(); ++body) {
            const auto points = bodies_[body].points;
            const bool here = !points.empty() && system_.is_constrained(points.front());
            is_rigid_[body] = ranks_of(system_).largest(here ? 1.0 : 0.0) > 0.0;
        }
    }

    S& system_;
    RestartOptions options_;
    std::int64_t steps_;
    detail::PointsOfBodies bodies_;
    std::vector<bool> is_rigid_;
    std::vector<double> force_;
    RestartReport report_;
};

}  // namespace abut::dynamics
