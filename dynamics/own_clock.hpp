#pragma once
#include <span>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/dynamics/memm.hpp"

namespace abut::dynamics {

namespace detail {
/// Throws BadInput unless d [s] is > 0 and finite.
void check_advance(double d);
/// Throws BadInput for a time out of the step from `node` to `next` [s].
void check_clock_time(double time, double node, double next);
}  // namespace detail

/// Times that a program outside dictates. MEMM keeps its constant step tau, and its nodes: inside a step the path is a
/// straight line that is known before any force, so that q is there at any time. Without loads the nodes have the same
/// bits whatever times are asked for. docs/loads.md, Times that are dictated.
///
///     dynamics::OwnClock clock(memm);
///     clock.advance(d, [&](double s) { impulse += s * load; }, [&] { system.set_load(impulse / memm.dt()); impulse = 0; });
///
/// Steps of the integrator, and changes of its dt, are taken at nodes alone: `left` is a whole step there.
template <System S>
class OwnClock {
public:
    /// At a node. The integrator must outlive the clock.
    explicit OwnClock(Memm<S>& memm) : memm_(memm), node_(memm.time()), time_(memm.time()), tau_(memm.dt()) {}

    [[nodiscard]] double time() const { return time_; }                 ///< [s]
    [[nodiscard]] double since() const { return time_ - node_; }        ///< from the last node [s], >= 0
    [[nodiscard]] double left() const { return node_ + tau_ - time_; }  ///< to the next node [s], > 0

    /// Goes on by d [s], of any length. `piece(s)` is called for each part of d within a step, and tells loads that
    /// they act for s [s]. At each node `node()` is called before the step is taken, whose mean load is known then.
    /// Throws BadInput, and changes nothing, unless d > 0 and finite; Misuse where the integrator was stepped inside a
    /// step of the clock, or its dt was changed there; as Memm::step and the two functions.
    template <class Piece, class Node>
    void advance(double d, const Piece& piece, const Node& node) {
        advance(d, piece, node, [this] { memm_.step(); });
    }
    /// As above, where `step()` takes the step of the integrator.
    template <class Piece, class Node, class Step>
    void advance(double d, const Piece& piece, const Node& node, const Step& step) {
        detail::check_advance(d);
        meet_integrator();
        for (double rest = d; rest > 0.0;) {
            if (rest < left() - nearness * tau_) {
                piece(rest);
                time_ += rest;
                return;
            }
            const double s = left();
            piece(s);
            node();
            step();
            node_ = time_ = memm_.time();
            rest -= s;
            if (rest <= nearness * tau_) rest = 0.0;
        }
    }

    /// q at this time, on the straight path of the step [m].
    [[nodiscard]] std::vector<double> q() {
        meet_integrator();
        std::vector<double> q(memm_.q().begin(), memm_.q().end());
        if (since() > 0.0) {
            const std::span<const double> next = memm_.next_q();
            for (std::size_t i = 0; i < q.size(); ++i) q[i] += since() / tau_ * (next[i] - q[i]);
        }
        return q;
    }

    /// Goes back to a time that it had, with the integrator at the node before it.
    void restore(double time) {
        detail::check_clock_time(time, memm_.time(), memm_.time() + memm_.dt());
        node_ = memm_.time();
        tau_ = memm_.dt();
        time_ = time;
    }

private:
    static constexpr double nearness = 1e-12;  // of tau: so near a node is at it

    /// At a node the integrator may have gone on by itself, or have another step.
    void meet_integrator() {
        const bool same = memm_.time() == node_ && memm_.dt() == tau_;
        if (same) return;
        if (since() > 0.0)
            throw Misuse(
                "OwnClock: the integrator was stepped, or its step changed, inside a step of the clock. Do so at a node, "
                "where "
                "`since` is 0.");
        node_ = time_ = memm_.time();
        tau_ = memm_.dt();
    }

    Memm<S>& memm_;
    double node_, time_, tau_;
};

}  // namespace abut::dynamics
