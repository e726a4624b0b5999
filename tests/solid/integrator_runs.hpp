#pragma once
// Runs of a solid through an impact, under the scheme that `make` makes.
#include <catch2/catch.hpp>

#include <utility>
#include <vector>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/scenes.hpp"

namespace abut::test {

/// A run from rest in the reference shape except for uniform velocities.
template <int Dim, class Make>
dynamics::Ledger<Dim> run(const mesh::Mesh<Dim>& mesh, const std::vector<Vector<Dim>>& velocity, double time,
                          const Make& make, std::vector<double>* end = nullptr) {
    solid::Solid<Dim> solid(mesh, reconstructed_bodies<Dim>(mesh.n_bodies()));
    const auto stable = dynamics::stable_step(solid);
    auto integrator =
        make(solid, std::vector<double>(solid.size(), 0.0), solid::uniform_momentum<Dim>(solid, velocity), stable);
    dynamics::Ledger<Dim> ledger;
    ledger.record(dynamics::measure(integrator, solid));
    while (integrator.time() < time - 0.5 * integrator.dt()) {
        integrator.step();
        ledger.record(dynamics::measure(integrator, solid));
    }
    CHECK(solid.contact().report().missed_contacts == 0);
    CHECK(solid.contact().report().active_pairs_max > 0);
    if (end) end->assign(integrator.q().begin(), integrator.q().end());
    return ledger;
}

/// A block that falls on a wall; the wall may move.
struct Falling {
    mesh::Mesh<2> mesh = mesh::box<2>({.lower = {0.0, 0.05},
                                       .upper = {1.0, 0.55},
                                       .size = 0.2,
                                       .refinement = mesh::Refinement<2>{{0.5, 0.05}, 0.015, 0.4}});
    solid::SolidOptions<2> options = reconstructed_bodies<2>(1);

    explicit Falling(double wall_speed, double skin = 0.0) {
        options.contact->search.skin = skin;
        options.acceleration = {Vector<2>(0.0, -0.02)};
        options.obstacles = {contact::plane_obstacle<2>(Vector<2>::Zero(), Vector<2>::UnitY(), 10.0)};
        if (wall_speed != 0.0) options.obstacles[0].path = [wall_speed](double t) { return Vector<2>(0.0, wall_speed * t); };
    }
};

/// Drift of the energy less the work, over the largest energy, through an impact; also the impulse of the wall.
struct FallResult {
    double imbalance;
    double wall_impulse;
    double body_momentum;  // upwards, gained against gravity
    double work;
};
template <class Make>
FallResult fall(const Falling& scene, double time, const Make& make) {
    solid::Solid<2> solid(scene.mesh, scene.options);
    const auto p = solid::uniform_momentum<2>(solid, std::vector<Vector<2>>{{0.0, -0.1}});
    auto integrator = make(solid, std::vector<double>(solid.size(), 0.0), p, dynamics::stable_step(solid));
    dynamics::Ledger<2> ledger;
    ledger.record(dynamics::measure(integrator, solid));
    double impulse = 0.0;
    while (integrator.time() < time) {
        integrator.step();
        impulse -= solid.contact().obstacle_force(0).y() * integrator.dt();
        ledger.record(dynamics::measure(integrator, solid));
    }
    CHECK(impulse > 0.0);
    CHECK(solid.contact().report().active_pairs == 0);  // it has bounced off
    const auto& start = ledger.entries().front();
    const auto& end = ledger.entries().back();
    const double weight = 0.5 * 0.02;
    return {ledger.pseudo_energy_drift() / ledger.largest_energy(), impulse,
            end.linear_momentum.y() - start.linear_momentum.y() + weight * end.time, solid.work()};
}

}  // namespace abut::test
