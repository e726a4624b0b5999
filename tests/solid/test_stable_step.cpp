#include <catch2/catch.hpp>

#include "solid/dense_stiffness.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;

TEMPLATE_TEST_CASE_SIG("the stable step lies below 2/omega_max of the dense eigenvalue problem, by no more than 5 %",
                       "[solid][stable_step]", ((int Dim), Dim), 2, 3) {
    std::vector<NamedMesh<Dim>> meshes = boxes<Dim>(2);
    meshes.push_back({"round", round_body<Dim>(Dim == 2 ? 0.4 : 0.8)});
    for (const auto& [name, mesh] : meshes) {
        INFO(name);
        solid::SolidOptions<Dim> options;
        options.materials = {{.young = 2.0, .poisson = 0.3, .density = 1.5}};
        solid::Solid<Dim> solid(mesh, options);
        const double omega = highest_frequency(solid);
        const auto step = dynamics::stable_step(solid);
        CHECK(step.change <= dynamics::settled_change);
        CHECK(step.dt <= 2.0 / omega);
        CHECK(step.dt >= 0.95 * 2.0 / omega);
    }
}

TEST_CASE("with contact the stable step is 0.85 of that of the free body", "[solid][stable_step]") {
    const auto mesh = unit_disc(0.4);
    auto options = reconstructed_bodies<2>(1);
    solid::Solid<2> touching(mesh, options);
    options.contact.reset();
    solid::Solid<2> free(mesh, options);
    CHECK(dynamics::stable_step(touching).dt == Approx(0.85 * dynamics::stable_step(free).dt).epsilon(1e-14));
}

TEST_CASE("the stable step is the same however often it is asked for, and scales with h sqrt(rho/E)",
          "[solid][stable_step]") {
    const auto mesh = unit_disc(0.4);
    auto options = reconstructed_bodies<2>(1);
    solid::Solid<2> solid(mesh, options);
    const double dt = dynamics::stable_step(solid).dt;
    CHECK(dynamics::stable_step(solid).dt == dt);
    options.materials[0].young *= 4.0;
    solid::Solid<2> stiffer(mesh, options);
    CHECK(dynamics::stable_step(stiffer).dt == Approx(0.5 * dt).epsilon(1e-12));
    options.materials[0].density *= 4.0;
    solid::Solid<2> heavier(mesh, options);
    CHECK(dynamics::stable_step(heavier).dt == Approx(dt).epsilon(1e-12));
}
