// Mean forces of finite bodies that are made of the forces at both ends of a step.
#include <catch2/catch.hpp>
#include <cmath>

#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;
using solid::MeanForce;

namespace {

template <int Dim>
solid::SolidOptions<Dim> finite_with(MeanForce mean_force) {
    auto options = bodies<Dim>(1);
    options.contact.reset();
    options.kinematics = {Kinematics::finite};
    options.finite.mean_force = mean_force;
    return options;
}

template <int Dim>
std::vector<double> mean_force(solid::Solid<Dim>& solid, const std::vector<double>& q_0, const std::vector<double>& q_1) {
    std::vector<double> force(q_0.size());
    solid.mean_force(q_0, q_1, 0.0, 1.0, force);
    return force;
}

/// A body that spins fast, with noise, for 2,000 steps at 0.6 of 2/omega.
template <int Dim>
Drifts drifts_of_spin(MeanForce mean_force, double velocity = 0.0) {
    TurningScene<Dim> scene(boxes<Dim>()[0].mesh, finite_with<Dim>(mean_force),
                            {moving<Dim>(Vector<Dim>::Constant(velocity), some_spin<Dim>(0.3))}, 0.6, Kinematics::finite,
                            0.01);
    scene.run(2000, 100);
    return scene.drifts();
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the trapezoid is the mean of the forces at both ends", "[solid][finite]", ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : boxes<Dim>()) {
        CAPTURE(name);
        solid::Solid<Dim> solid(mesh, finite_with<Dim>(MeanForce::trapezoid));
        const auto q_0 = turned_state<Dim>(mesh, 0.7, 1, 0.01), q_1 = turned_state<Dim>(mesh, 0.9, 2, 0.01);
        std::vector<double> at_0(q_0.size()), at_1(q_0.size());
        const auto mean = mean_force(solid, q_0, q_1);
        solid.force(q_0, at_0);
        solid.force(q_1, at_1);
        double off = 0.0;
        for (std::size_t i = 0; i < mean.size(); ++i) raise(off, std::abs(mean[i] - 0.5 * (at_0[i] + at_1[i])));
        CHECK(off <= 1e-14 * largest(at_0));
    }
}

TEMPLATE_TEST_CASE_SIG("what a step keeps of its ends is no memory: other steps and looks in between change no bit",
                       "[solid][finite]", ((int Dim), Dim), 2, 3) {
    const auto mean = GENERATE(MeanForce::trapezoid, MeanForce::closed_trapezoid);
    const auto mesh = boxes<Dim>()[0].mesh;
    const auto q_0 = turned_state<Dim>(mesh, 0.7, 1, 0.01), q_1 = turned_state<Dim>(mesh, 0.9, 2, 0.01),
               q_2 = turned_state<Dim>(mesh, 0.8, 3, 0.01);
    const auto fresh = [&](const std::vector<double>& from, const std::vector<double>& to) {
        solid::Solid<Dim> solid(mesh, finite_with<Dim>(mean));
        return mean_force(solid, from, to);
    };
    solid::Solid<Dim> solid(mesh, finite_with<Dim>(mean));
    CHECK(mean_force(solid, q_0, q_1) == fresh(q_0, q_1));
    CHECK(mean_force(solid, q_0, q_2) == fresh(q_0, q_2));  // the same start again: a shorter step
    CHECK(mean_force(solid, q_2, q_1) == fresh(q_2, q_1));  // goes on
    std::vector<double> force(q_0.size());
    static_cast<void>(solid.potential(q_0));
    solid.force(q_2, force);
    CHECK(mean_force(solid, q_1, q_0) == fresh(q_1, q_0));  // goes on after looks elsewhere
    CHECK(mean_force(solid, q_2, q_0) == fresh(q_2, q_0));  // begins anywhere
}

TEMPLATE_TEST_CASE_SIG("the mean of both ends feeds no alternating mode, and the discrete gradient does", "[solid][finite]",
                       ((int Dim), Dim), 2, 3) {
    CHECK(drifts_of_spin<Dim>(MeanForce::trapezoid).parasitic <= 1e-12);  // e changes its sign from its start at 0
    CHECK(drifts_of_spin<Dim>(MeanForce::discrete_gradient).parasitic >= 1e-6);
}

TEMPLATE_TEST_CASE_SIG(
    "the closed trapezoid keeps H~, momentum and J~ of a body that spins with noise; left open, it loses H~",
    "[solid][finite]", ((int Dim), Dim), 2, 3) {
    const Drifts closed = drifts_of_spin<Dim>(MeanForce::closed_trapezoid, 0.1);
    CHECK(closed.pseudo_energy <= 2e-13);
    CHECK(closed.momentum <= 1e-13);
    CHECK(closed.pseudo_moment <= 1e-13);
    CHECK(drifts_of_spin<Dim>(MeanForce::trapezoid, 0.1).pseudo_energy >= 1e-9);
}

TEMPLATE_TEST_CASE_SIG("a held body under the closed trapezoid keeps H~ as well", "[solid][finite]", ((int Dim), Dim), 2,
                       3) {
    auto options = finite_with<Dim>(MeanForce::closed_trapezoid);
    options.boundary.dirichlet.push_back({.group = "xmin"});
    options.acceleration = {Vector<Dim>::Constant(-0.01)};
    TurningScene<Dim> scene(boxes<Dim>()[0].mesh, options, {Motion<Dim>{}}, 0.6, Kinematics::finite, 0.01);
    scene.run(2000, 100);
    CHECK(scene.drifts().pseudo_energy <= 2e-13);
}
