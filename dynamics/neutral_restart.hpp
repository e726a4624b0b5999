#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/dynamics/ledger.hpp"

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

/// The points of each body, as a list of lists.
struct BodyPoints {
    std::vector<std::int32_t> points;    ///< body by body, increasing
    std::vector<std::ptrdiff_t> offset;  ///< of the first point of each body, and the end (n_bodies + 1)
};
/// Throws BadInput unless there are n bodies' numbers, none below 0.
[[nodiscard]] BodyPoints points_of_bodies(std::span<const std::int32_t> body_of_points, std::size_t n);
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
};

/// Restarts one body.
template <int Dim>
void restart_body(std::span<const std::int32_t> points, const NodeView<Dim>& node, RestartReport& report);

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
/// vibrates is left as it is, and counted; a rigid one is left as it is. One force evaluation a restart; the bits do not depend on the number of threads.
template <BodySystem S>
class NeutralRestart {
public:
    static constexpr int Dim = S::dimension;

    /// The system must outlive it. Throws BadInput for options out of range, or if not every point has a body.
    explicit NeutralRestart(S& system, RestartOptions options = {})
        : system_(system),
          options_(options),
          steps_(options.steps_before),
          bodies_(detail::points_of_bodies(system.body_of_points(), system.masses().size())),
          force_(system.size()),
          report_(options.report_before) {
        detail::check_restart(options);
        refuse_ranks(ranks_of(system), "neutral restart");
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
                                         .dt = dt};
        ++report_.restarts;
        const std::span<const std::int32_t> points(bodies_.points);
        for (std::size_t body = 0; body + 1 < bodies_.offset.size(); ++body) {
            const auto begin = static_cast<std::size_t>(bodies_.offset[body]);
            const auto end = static_cast<std::size_t>(bodies_.offset[body + 1]);
            if constexpr (ConstrainedSystem<S>)
                if (system_.is_constrained(points[begin])) continue;  // nothing in it vibrates, and it would not stay rigid
            detail::restart_body<Dim>(points.subspan(begin, end - begin), node, report_);
        }
    }

    [[nodiscard]] const RestartReport& report() const { return report_; }

private:
    S& system_;
    RestartOptions options_;
    std::int64_t steps_;
    detail::BodyPoints bodies_;
    std::vector<double> force_;
    RestartReport report_;
};

}  // namespace abut::dynamics
