#pragma once
// A scene on all ranks beside the whole of it on the first one: a reference that is computed once, however many ranks there are.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "ranks/shared_solid.hpp"
#include "ranks/world.hpp"

namespace abut::test {

/// A run from rest positions, and all that can be seen of it.
template <int Dim, template <class> class Scheme>
class SeenRun {
public:
    SeenRun(solid::Solid<Dim>& solid, const std::vector<double>& p_0, double dt, const Remedies& remedies)
        : solid_(solid), run_(solid, std::vector<double>(solid.size(), 0.0), p_0, dt), remedied_(solid, remedies) {
        remedied_.set(run_);
    }
    void step() { run_.step(); }

    /// Displacements by point, then momenta.
    [[nodiscard]] std::vector<double> motion() const {
        std::vector<double> values(run_.q().begin(), run_.q().end());
        values.insert(values.end(), run_.p_after().begin(), run_.p_after().end());
        return values;
    }
    [[nodiscard]] std::vector<double> entry() {
        const auto values = dynamics::ledger_values(dynamics::measure(run_, solid_, remedied_.report()));
        return {values.begin(), values.end()};
    }
    [[nodiscard]] std::vector<std::byte> state() const { return solid_.state(); }
    [[nodiscard]] std::vector<double> counts() const {
        const contact::ContactReport report = solid_.contact().report();
        return {static_cast<double>(report.events), static_cast<double>(report.candidates),
                static_cast<double>(report.rebuilds), static_cast<double>(report.missed_contacts)};
    }
    /// Impulses between bodies, forces on obstacles, and the work of loads.
    [[nodiscard]] std::vector<double> forces() const {
        std::vector<double> values{solid_.work()};
        const auto add = [&](const Vector<Dim>& force) { values.insert(values.end(), force.data(), force.data() + Dim); };
        for (std::size_t i = 0; i < solid_.options().obstacles.size(); ++i) add(solid_.contact().obstacle_force(i));
        for (const auto& between : solid_.contact().impulses()) add(between.impulse);
        return values;
    }
    [[nodiscard]] std::vector<double> turns() const { return solid_.rotations(run_.q()); }
    [[nodiscard]] std::vector<double> local_turns() const { return solid_.local_rotations(run_.q()); }

private:
    solid::Solid<Dim>& solid_;
    Scheme<solid::Solid<Dim>> run_;
    Remedied<solid::Solid<Dim>> remedied_;
};

/// Runs the scene on all ranks and, on the first one, the whole of it beside: all that can be seen of the two has the same bits
/// in each step. Returns contact's figures at the end.
template <int Dim, template <class> class Scheme = dynamics::Memm>
contact::ContactReport check_same_bits(const ranks::Communicator& all, const mesh::Mesh<Dim>& whole,
                                       const solid::SolidOptions<Dim>& options, std::span<const Vector<Dim>> body_velocity,
                                       int steps, std::span<const int> owner, const Stir& stir = {},
                                       const Remedies& remedies = {}) {
    std::optional<solid::Solid<Dim>> alone;
    on_first(all, [&] { alone.emplace(whole, options); });
    SharedSolid<Dim> shared(all, whole, options, owner);
    const auto stable = dynamics::stable_step(shared.solid);
    if (alone) {
        CHECK(dynamics::stable_step(*alone).dt == stable.dt);
        CHECK(dynamics::stable_step(*alone).omega_max == stable.omega_max);
    }
    const std::vector<double> p_0 = momentum_of<Dim>(shared.solid, body_velocity, stir);
    const double dt = std::isinf(stable.dt) ? 0.01 : 0.9 * stable.dt;  // nothing resists free rigid bodies
    std::optional<SeenRun<Dim, Scheme>> run;
    on_first(all, [&] { run.emplace(*alone, momentum_of<Dim>(*alone, body_velocity, stir), dt, remedies); });
    SeenRun<Dim, Scheme> run_here(shared.solid, p_0, dt, remedies);
    using Run = SeenRun<Dim, Scheme>;
    const auto expected = [&](auto value) {
        return of_first<decltype((*run.*value)())>(all, [&] { return (*run.*value)(); });
    };
    const auto same_motion = [&] {
        const std::vector<double> of_one = expected(&Run::motion);
        const std::span<const double> values(of_one);
        std::vector<double> own = shared.own(values.first(values.size() / 2));
        const std::vector<double> momenta = shared.own(values.last(values.size() / 2));
        own.insert(own.end(), momenta.begin(), momenta.end());
        return same_bits(own, run_here.motion());
    };
    const auto same = [&](auto value) {
        const auto here = (run_here.*value)();  // a call of all ranks
        const auto of_one = expected(value);
        return std::ranges::equal(std::as_bytes(std::span(here)), std::as_bytes(std::span(of_one)));
    };
    for (int step = 0; step <= steps; ++step) {
        CAPTURE(all.rank(), step);
        if (step > 0) {
            on_first(all, [&] { run->step(); });
            run_here.step();
        }
        REQUIRE(everywhere(all, same_motion()));
        if (step % 10 != 0 && step != steps) continue;
        REQUIRE(everywhere(all, same(&Run::entry)));
    }
    REQUIRE(everywhere(all, same(&Run::state)));
    REQUIRE(everywhere(all, same(&Run::counts)));
    REQUIRE(everywhere(all, same(&Run::forces)));
    REQUIRE(everywhere(all, same(&Run::turns)));
    REQUIRE(everywhere(all, same(&Run::local_turns)));
    if (!options.moments.empty()) CHECK(shared.solid.work() != 0.0);  // they act
    return shared.solid.contact().report();
}

}  // namespace abut::test
