#include "abut/dynamics/neutral_restart.hpp"

#include <catch2/catch.hpp>
#include <memory>

#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;

namespace {

template <int Dim>
std::unique_ptr<Scene<Dim>> impact() {
    if constexpr (Dim == 2)
        return std::make_unique<Scene<2>>(two_discs(0.8), reconstructed_bodies<2>(2), disc_velocities, -0.9);
    else
        return std::make_unique<Scene<3>>(two_boxes(4), reconstructed_bodies<3>(2), box_velocities, -0.9);
}

/// What a body has of momentum and, about the positions at rest, angular momentum, at the node; and the kinetic part of its
/// H~.
template <int Dim>
struct Body {
    double kinetic = 0.0;
    Vector<Dim> momentum = Vector<Dim>::Zero();
    Vector<3> angular = Vector<3>::Zero();
};

template <int Dim>
std::array<Body<Dim>, 2> two_bodies(const Scene<Dim>& scene, std::span<const double> p_before,
                                    std::span<const double> p_after) {
    std::array<Body<Dim>, 2> bodies;
    const auto before = as_vectors<Dim>(p_before), after = as_vectors<Dim>(p_after);
    for (std::int32_t c = 0; c < scene.mesh.n_cells(); ++c) {
        const Vector<3> x = in_3d<Dim>(scene.mesh.cell_centroid[c]), p = in_3d<Dim>(0.5 * (before[c] + after[c]));
        Body<Dim>& body = bodies[static_cast<std::size_t>(scene.mesh.cell_body[c])];
        body.kinetic += 0.5 * before[c].dot(after[c]) / scene.solid.masses()[c];
        body.momentum += p.template head<Dim>();
        body.angular += x.cross(p);
    }
    return bodies;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "restarts of bodies that run into each other leave H~, momentum and spin of each as they are, and clear e of all cells",
    "[solid][restart]", ((int Dim), Dim), 2, 3) {
    const auto scene = impact<Dim>();
    dynamics::NeutralRestart restart(scene->solid, {.period = 10});
    double kinetic = 0.0, momentum = 0.0, angular = 0.0;
    scene->memm.set_node_restart([&](auto q, double dt, auto p_before, auto p_after) {
        const auto before = two_bodies(*scene, p_before, p_after);
        restart(q, dt, p_before, p_after);
        const auto after = two_bodies(*scene, p_before, p_after);
        for (const std::size_t body : {0, 1}) {
            raise(kinetic, std::abs(after[body].kinetic - before[body].kinetic));
            raise(momentum, (after[body].momentum - before[body].momentum).norm());
            raise(angular, (after[body].angular - before[body].angular).norm());
        }
    });
    const auto plain = impact<Dim>();
    plain->run_until(12.0, 10);
    scene->run_until(12.0, 10);
    const double m_v = solid::body_motions<Dim>(scene->memm, scene->solid)[0].mass * 0.05;
    CHECK(restart.report().restarts > 5);
    CHECK(restart.report().paid != 0.0);
    CHECK(kinetic < 1e-14 * scene->kinetic_start());
    CHECK(momentum < 1e-14 * m_v);
    CHECK(angular < 3e-14 * m_v);
    CHECK(scene->ledger.pseudo_energy_drift() < 1e-11 * scene->kinetic_start());
    CHECK(scene->ledger.momentum_drift() < 1e-12 * m_v);
    // The bodies have parted: what is left of e stays for ever.
    REQUIRE(scene->ledger.entries().back().active_pairs == 0);
    CHECK(plain->ledger.entries().back().parasitic > 1e-4);
    CHECK(scene->ledger.entries().back().parasitic < 1e-12);
}

TEST_CASE("a restart keeps the momentum of a body that a face drives: only its vibration pays", "[solid][restart]") {
    auto options = reconstructed_bodies<2>(1);
    const Vector<2> velocity(0.3, 0.1);
    options.boundary.dirichlet = {
        {.group = "xmin", .history = [&](double t, const Vector<2>&) -> Vector<2> { return t * velocity; }}};
    Scene<2> scene(mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.6}, {8, 5}, CellShape::quadrangle, "box"), options,
                   {Vector<2>(0.8 * velocity)});
    dynamics::NeutralRestart restart(scene.solid, {.period = 10});
    std::mt19937 random(2);
    scene.memm.set_after_step([&](auto, double, auto, auto p_after) {
        for (double& p : p_after) p += 1e-5 * std::uniform_real_distribution<double>(-1.0, 1.0)(random);
    });
    double kept = 0.0;
    std::vector<double> e(scene.solid.size());
    scene.memm.set_node_restart([&](auto q, double dt, auto p_before, auto p_after) {
        const auto total = [&] {
            Vector<2> sum = Vector<2>::Zero();
            for (const auto& p : {as_vectors<2>(p_before), as_vectors<2>(p_after)})
                for (const Vector<2>& p_c : p) sum += 0.5 * p_c;
            return sum;
        };
        const Vector<2> before = total();
        restart(q, dt, p_before, p_after);
        raise(kept, (total() - before).norm());
    });
    for (int step = 0; step < 100; ++step) scene.memm.step();
    scene.memm.parasitic_momentum(e);
    CHECK(restart.report().restarts == 10);
    CHECK(restart.report().skipped == 0);
    CHECK(kept < 1e-15);
    CHECK(largest(e) < 1e-15);
}
