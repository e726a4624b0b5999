#include <catch2/catch.hpp>

#include <memory>

#include "abut/dynamics/filter.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;

namespace {

template <int Dim>
std::unique_ptr<Scene<Dim>> impact(double cfl) {
    if constexpr (Dim == 2)
        return std::make_unique<Scene<2>>(two_discs(0.8), reconstructed_bodies<2>(2), disc_velocities, -cfl);
    else
        return std::make_unique<Scene<3>>(two_boxes(4), reconstructed_bodies<3>(2), box_velocities, -cfl);
}

/// What the filter must not change: the kinetic part of H~ (it does not touch q), momentum, and the angular momentum about
/// the positions at rest, which is that of linear strain.
template <int Dim>
struct Invariants {
    double kinetic = 0.0;
    Vector<Dim> momentum = Vector<Dim>::Zero();
    Vector<3> angular = Vector<3>::Zero();

    Invariants(const Scene<Dim>& scene, std::span<const double> p_before, std::span<const double> p_after) {
        const auto before = as_vectors<Dim>(p_before), after = as_vectors<Dim>(p_after);
        for (std::int32_t c = 0; c < scene.mesh.n_cells(); ++c) {
            kinetic += 0.5 * before[c].dot(after[c]) / scene.solid.masses()[c];
            momentum += after[c];
            angular += in_3d<Dim>(scene.mesh.cell_centroid[c]).cross(in_3d<Dim>(after[c]));
        }
    }
};

template <int Dim = 2>
Vector<Dim> total(std::span<const double> momentum) {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const Vector<Dim>& p : as_vectors<Dim>(momentum)) sum += p;
    return sum;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the neutral filter changes neither H~ nor momentum nor angular momentum", "[solid][filter]",
                       ((int Dim), Dim), 2, 3) {
    const auto scene = impact<Dim>(0.9);
    dynamics::NeutralFilter filter(scene->solid);
    double kinetic = 0.0, momentum = 0.0, angular = 0.0, changed = 0.0;
    scene->memm.set_after_step([&](auto q, double dt, auto p_before, auto p_after) {
        const std::vector<double> unfiltered(p_after.begin(), p_after.end());
        const Invariants<Dim> before(*scene, p_before, p_after);
        filter(q, dt, p_before, p_after);
        const Invariants<Dim> after(*scene, p_before, p_after);
        raise(kinetic, std::abs(after.kinetic - before.kinetic));
        raise(momentum, (after.momentum - before.momentum).norm());
        raise(angular, (after.angular - before.angular).norm());
        for (std::size_t i = 0; i < unfiltered.size(); ++i)
            raise(changed, std::abs(unfiltered[i] - p_after[i]) * scene->solid.inverse_mass()[i]);
    });
    scene->run_until(8.0, 10);
    const double m_v = solid::body_motions<Dim>(scene->memm, scene->solid)[0].mass * 0.05;
    CHECK(changed > 1e-4);
    CHECK(kinetic < 1e-14 * scene->kinetic_start());
    CHECK(momentum < 1e-14 * m_v);
    CHECK(angular < 1e-14 * m_v);
    CHECK(scene->ledger.pseudo_energy_drift() < 1e-11 * scene->kinetic_start());
    CHECK(scene->ledger.momentum_drift() < 1e-12 * m_v);
}

TEMPLATE_TEST_CASE_SIG("the neutral filter makes the parasitic mode of an impact smaller", "[solid][filter]",
                       ((int Dim), Dim), 2, 3) {
    const auto plain = impact<Dim>(0.9), filtered = impact<Dim>(0.9);
    dynamics::NeutralFilter filter(filtered->solid);
    filtered->memm.set_after_step([&](auto q, double dt, auto p_before, auto p_after) { filter(q, dt, p_before, p_after); });
    plain->run_until(12.0, 10);
    filtered->run_until(12.0, 10);
    // What is left when the bodies have parted: that stays for ever.
    CHECK(filtered->ledger.entries().back().parasitic < 0.5 * plain->ledger.entries().back().parasitic);
    CHECK(filtered->ledger.energy_excess() < plain->ledger.energy_excess());
}

TEST_CASE("the neutral filter keeps H~ of a body on a wall, and its momentum along the wall", "[solid][filter]") {
    auto options = reconstructed_bodies<2>(1);
    options.obstacles = {contact::plane_obstacle<2>({-1.02, 0.0}, {1.0, 0.1}, 4.0)};
    Scene<2> scene(unit_disc(0.25), options, {Vector<2>(-0.1, 0.02)});
    dynamics::NeutralFilter filter(scene.solid);
    const Vector<2> normal = Vector<2>(1.0, 0.1).normalized(), along(-normal[1], normal[0]);
    double across = 0.0, along_wall = 0.0;  // what the filter adds to momentum
    scene.memm.set_after_step([&](auto q, double dt, auto p_before, auto p_after) {
        const Vector<2> before = total(p_after);
        filter(q, dt, p_before, p_after);
        const Vector<2> added = total(p_after) - before;
        raise(across, std::abs(added.dot(normal)));
        raise(along_wall, std::abs(added.dot(along)));
        for (const auto& patch : scene.solid.contact_patches()) {
            REQUIRE_FALSE(patch.holds.empty());
            for (const auto& hold : patch.holds) CHECK((hold.direction.cwiseAbs() - normal).norm() < 1e-12);
        }
    });
    scene.run_until(8.0);
    CHECK(across > 1e-6);
    CHECK(along_wall < 1e-14);
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-11 * scene.kinetic_start());
}

TEMPLATE_TEST_CASE_SIG("the neutral filter leaves momentum along rollers alone, through any number of impacts",
                       "[solid][filter]", ((int Dim), Dim), 2, 3) {
    // Two blocks that run into each other along their rollers.
    Vector<Dim> size = Vector<Dim>::Constant(0.8);
    size[0] = 1.0;
    Vector<Dim> gap = Vector<Dim>::Zero();
    gap[0] = 1.01;
    gap[Dim - 1] = 0.0;
    auto options = reconstructed_bodies<Dim>(2);
    const std::string lower = Dim == 2 ? ".ymin" : ".zmin";
    for (const std::string body : {"left", "right"}) {
        solid::DirichletCondition<Dim> rollers;
        rollers.group = body + lower;
        rollers.constraint = solid::Constraint::normal;
        options.boundary.dirichlet.push_back(rollers);
    }
    const auto mesh = together(
        mesh::box<Dim>({.lower = Vector<Dim>::Zero(), .upper = size, .size = Dim == 2 ? 0.25 : 0.4, .name = "left"}),
        mesh::box<Dim>({.lower = gap, .upper = gap + 0.9 * size, .size = Dim == 2 ? 0.2 : 0.35, .name = "right"}));
    Scene<Dim> scene(mesh, options, {0.05 * Vector<Dim>::Unit(0), -0.05 * Vector<Dim>::Unit(0)});
    dynamics::NeutralFilter filter(scene.solid);
    scene.memm.set_after_step([&](auto q, double dt, auto p_before, auto p_after) { filter(q, dt, p_before, p_after); });
    const double start = total<Dim>(scene.memm.p_after())[0];
    double drift = 0.0;
    for (int step = 0; step < 400; ++step) {
        scene.memm.step();
        raise(drift, std::abs(total<Dim>(scene.memm.p_after())[0] - start));
    }
    CHECK(scene.solid.contact().report().active_pairs_max > 0);
    CHECK(drift < 1e-13);
}

TEST_CASE("a strength of zero filters nothing", "[solid][filter]") {
    const auto plain = impact<2>(0.9), filtered = impact<2>(0.9);
    dynamics::NeutralFilter filter(filtered->solid, 0.0);
    filtered->memm.set_after_step([&](auto q, double dt, auto p_before, auto p_after) { filter(q, dt, p_before, p_after); });
    plain->run(150, 150);
    filtered->run(150, 150);
    CHECK(std::equal(plain->memm.q().begin(), plain->memm.q().end(), filtered->memm.q().begin()));
}

TEMPLATE_TEST_CASE_SIG(
    "the neutral filter keeps H~ and momentum whatever the boundary reconstruction, down to patches of one or two cells",
    "[solid][filter]", ((int Dim), Dim), 2, 3) {
    auto options = reconstructed_bodies<Dim>(2);
    options.boundary.free_face_rule =
        GENERATE(solid::FreeFaceRule::local_equilibrium, solid::FreeFaceRule::extrapolate, solid::FreeFaceRule::adjacent);
    const auto scene = [&] {
        if constexpr (Dim == 2)
            return std::make_unique<Scene<2>>(two_discs(0.8), options, disc_velocities);
        else
            return std::make_unique<Scene<3>>(two_boxes(4), options, box_velocities);
    }();
    dynamics::NeutralFilter filter(scene->solid);
    std::size_t smallest = 1000;
    scene->memm.set_after_step([&](auto q, double dt, auto p_before, auto p_after) {
        for (const auto& patch : scene->solid.contact_patches()) smallest = std::min(smallest, patch.points.size());
        filter(q, dt, p_before, p_after);
    });
    scene->run_until(4.0, 10);
    CHECK(scene->ledger.pseudo_energy_drift() < 1e-11 * scene->kinetic_start());
    CHECK(scene->ledger.momentum_drift() < 1e-12);
    if (options.boundary.free_face_rule == solid::FreeFaceRule::adjacent) CHECK(smallest <= 4);
}
