#pragma once
// A solid on all ranks of the program, and the same on each of them.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/neutral_restart.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/part.hpp"
#include "abut/ranks/partition.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/clocked_run.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/part/share_out.hpp"
#include "abut/solid/solid.hpp"
#include "abut/solid/stepped_run.hpp"
#include "ranks/world.hpp"

namespace abut::test {

[[nodiscard]] inline bool same_bits(std::span<const double> a, std::span<const double> b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

template <int Dim>
ranks::SharedPoints shared_points(const ranks::Communicator& all, const mesh::MeshPart<Dim>& part,
                                  std::span<const solid::Kinematics> kinematics) {
    const solid::PartPoints points = solid::points_of<Dim>(part, kinematics);
    return ranks::shared_points(all, Dim, points.n_points, points.number, points.owner);
}

/// Values of points with these numbers among those by point of the whole (n_points, Dim).
template <int Dim>
std::vector<double> own_values(std::span<const std::int32_t> numbers, std::span<const double> of_all) {
    std::vector<double> values;
    for (const std::int32_t number : numbers)
        for (int k = 0; k < Dim; ++k) values.push_back(of_all[static_cast<std::size_t>(number * Dim + k)]);
    return values;
}

/// The part of a rank, with all that its solid needs.
template <int Dim>
struct SharedSolid {
    mesh::MeshPart<Dim> part;
    ranks::PointRanks points;
    solid::Solid<Dim> solid;

    SharedSolid(const ranks::Communicator& all, const mesh::Mesh<Dim>& whole, const solid::SolidOptions<Dim>& options,
                std::span<const int> owner)
        : SharedSolid(all, solid::part_of<Dim>(whole, owner, all.rank(), options.kinematics), options) {}
    /// Of a part that is made otherwise.
    SharedSolid(const ranks::Communicator& all, mesh::MeshPart<Dim> of_rank, const solid::SolidOptions<Dim>& options)
        : part(std::move(of_rank)),
          points(all, shared_points<Dim>(all, part, options.kinematics)),
          solid(part.mesh, options, points) {}

    /// What this rank has of values by point of the whole (n_points, Dim).
    [[nodiscard]] std::vector<double> own(std::span<const double> of_all) const {
        return own_values<Dim>(points.numbers(), of_all);
    }
};

/// A solid under its own clock, all of it or the part of a rank, whose bodies have these velocities.
template <int Dim>
struct ClockedPart {
    std::optional<mesh::MeshPart<Dim>> part;
    std::optional<ranks::PointRanks> points;
    solid::SteppedRun<Dim> run;
    solid::ClockedRun<Dim> clock;

    ClockedPart(const mesh::Mesh<Dim>& whole, const solid::SolidOptions<Dim>& options, std::span<const Vector<Dim>> velocity,
                solid::LoadImpulse impulse = solid::LoadImpulse::as_given)
        : run(made(std::make_unique<solid::Solid<Dim>>(whole, options), velocity)), clock(run, impulse) {}
    ClockedPart(const ranks::Communicator& all, const mesh::Mesh<Dim>& whole, const solid::SolidOptions<Dim>& options,
                std::span<const int> owner, std::span<const Vector<Dim>> velocity,
                solid::LoadImpulse impulse = solid::LoadImpulse::as_given)
        : part(solid::part_of<Dim>(whole, owner, all.rank(), options.kinematics)),
          points(std::in_place, all, shared_points<Dim>(all, *part, options.kinematics)),
          run(made(std::make_unique<solid::Solid<Dim>>(part->mesh, options, *points), velocity)),
          clock(run, impulse) {}

    /// Those of this rank among values by point of the whole.
    [[nodiscard]] std::vector<double> own(std::span<const double> of_all) const {
        return own_values<Dim>(points->numbers(), of_all);
    }

private:
    static solid::SteppedRun<Dim> made(std::unique_ptr<solid::Solid<Dim>> solid, std::span<const Vector<Dim>> velocity) {
        const std::vector<double> p = solid::uniform_momentum<Dim>(*solid, velocity), q(p.size(), 0.0);
        const double stable = dynamics::stable_step(*solid).dt;
        return {std::move(solid), q, p, std::isinf(stable) ? 0.01 : 0.9 * stable, {.filter = true, .restart = 7}};
    }
};

/// What makes velocities differ from cell to cell.
struct Stir {
    double waves = 0.01;  ///< their amplitude [m/s]
    double spin = 0.0;    ///< of all bodies about the third axis [rad/s]
};

/// What takes the alternating mode out.
struct Remedies {
    bool filter = false;
    int restart = 0;  ///< steps from one to the next; 0: none
};

/// These remedies in a run of a system.
template <class S>
class Remedied {
public:
    Remedied(S& system, const Remedies& remedies) : remedies_(remedies), filter_(system) {
        if (remedies.restart > 0) restart_.emplace(system, dynamics::RestartOptions{.period = remedies.restart});
    }
    template <class Run>
    void set(Run& run) {
        if constexpr (Run::takes_after_step)
            if (remedies_.filter)
                run.set_after_step([this](auto q, double dt, auto before, auto after) { filter_(q, dt, before, after); });
        if constexpr (Run::takes_node_restart)
            if (restart_)
                run.set_node_restart(
                    [this](auto q, double dt, auto before, auto after) { (*restart_)(q, dt, before, after); });
    }
    [[nodiscard]] dynamics::RestartReport report() const {
        return restart_ ? restart_->report() : dynamics::RestartReport{};
    }

private:
    Remedies remedies_;
    dynamics::NeutralFilter<S> filter_;
    std::optional<dynamics::NeutralRestart<S>> restart_;
};

/// Velocities of the bodies, and what else differs from cell to cell.
template <int Dim>
std::vector<double> momentum_of(const solid::Solid<Dim>& solid, std::span<const Vector<Dim>> body_velocity,
                                const Stir& stir) {
    std::vector<double> momentum = solid::uniform_momentum<Dim>(solid, body_velocity);
    for (std::size_t i = 0; i < momentum.size(); ++i) {
        const Vector<Dim>& x = solid.rest_positions()[i / Dim];
        double velocity = stir.waves * std::sin(7.0 * x.sum() + static_cast<double>(i % Dim));
        if (i % Dim == 0) velocity -= stir.spin * x[1];
        if (i % Dim == 1) velocity += stir.spin * x[0];
        momentum[i] += solid.masses()[i / Dim] * velocity;
    }
    return momentum;
}

}  // namespace abut::test
