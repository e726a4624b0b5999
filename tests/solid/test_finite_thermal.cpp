// Runs of bodies of Kinematics::finite whose temperature is given: the work of heat, similarity, contact, and a state that goes on.
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <memory>

#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;
using solid::Material;
using solid::MaterialLaw;

namespace {

constexpr double strain_per_kelvin = 1e-3;

Material run_material(MaterialLaw law) {
    Material material{.young = 1.0, .poisson = 0.3, .density = 1.0, .law = law};
    material.expansion.along_1 = strain_per_kelvin;
    if (law == MaterialLaw::mooney_rivlin) material.second_share = 0.4;
    if (law == MaterialLaw::j2) {
        material.flow.yield_stress = 0.01;
        material.flow.hardening = 0.1;
    }
    return material;
}

Material with_kinematic_hardening(Material material) {
    material.flow.kinematic_hardening = 0.05;
    return material;
}

const std::array<Material, 5> run_materials{run_material(MaterialLaw::st_venant_kirchhoff),
                                            run_material(MaterialLaw::neo_hookean), run_material(MaterialLaw::mooney_rivlin),
                                            run_material(MaterialLaw::j2),
                                            with_kinematic_hardening(run_material(MaterialLaw::j2))};

template <int Dim>
solid::TemperatureRise<Dim> lasting_rise(double rise) {
    return {.value = [rise](double, const Vector<Dim>&) { return rise; }, .varies = false};
}

/// Of place and time, slower than discs and boxes ring; thermal strains are 0.14 at most.
template <int Dim>
solid::TemperatureRise<Dim> swinging(double amplitude) {
    return {.value =
                [amplitude](double t, const Vector<Dim>& x) {
                    return amplitude * (std::sin(0.3 * t) + 0.4 * std::sin(x[0] + x[1]) * std::sin(0.2 * t));
                },
            .varies = true};
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the force on a warm finite body is the slope of its energy, and a step keeps energy and momenta",
                       "[solid][finite][thermal]", ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : boxes<Dim>(2))
        for (const Material& material : run_materials) {
            CAPTURE(name, static_cast<int>(material.law), material.flow.kinematic_hardening);
            auto options = alone<Dim>(material);
            options.materials[0].flow.yield_stress *= 1e3;
            options.temperature_rise = {
                {.value = [](double, const Vector<Dim>& x) { return 100.0 + 80.0 * x[0]; }, .varies = false}};
            solid::Solid<Dim> solid(mesh, options);
            const auto q_0 = turned_state<Dim>(mesh, 0.4, 1, 5e-3), q_1 = turned_state<Dim>(mesh, 0.5, 2, 5e-3);
            CHECK(slope_error<Dim>(solid, q_0) <= 1e-6);
            if (material.law == MaterialLaw::j2) continue;  // of a state alone: a step may flow
            const StepErrors<Dim> errors(solid, q_0, q_1);
            CHECK(errors.energy <= 1e-13);
            CHECK(errors.momentum <= 1e-13);
            CHECK(errors.angular <= 1e-13);
        }
}

TEMPLATE_TEST_CASE_SIG(
    "the work of heat in finite bodies that spin, collide and flow is booked: H~ + D - W and both momenta are kept",
    "[solid][finite][thermal][long]", ((int Dim), Dim), 2, 3) {
    for (const Material& material : run_materials) {
        CAPTURE(static_cast<int>(material.law), material.flow.kinematic_hardening);
        auto options = finite_of<Dim>(material, 2);
        options.temperature_rise = {swinging<Dim>(90.0), swinging<Dim>(-60.0)};
        const auto scene = spinning_collision<Dim>(options);
        const double fall = fall_of_dissipation<Dim>(*scene, steps_of_collision<Dim> / 2, &dynamics::Losses::in_cells);
        check_collision(*scene);
        CHECK(std::abs(scene->solid.work()) > 1e-3 * scene->ledger.largest_energy());
        CHECK((scene->solid.dissipated().in_cells > 0.0) == (material.law == MaterialLaw::j2));
        CHECK(fall <= 1e-15 * scene->ledger.largest_energy());
    }
}

TEST_CASE("warm and cold finite bodies beside floating and small ones keep H~ + D - W", "[solid][finite][thermal]") {
    auto options = finite_of<2>(run_material(MaterialLaw::st_venant_kirchhoff), 2);
    const auto other = GENERATE(Kinematics::floating, Kinematics::finite);
    options.temperature_rise = {swinging<2>(90.0), {}};
    if (other == Kinematics::floating) options.temperature_rise[1] = swinging<2>(40.0);
    const auto scene = spinning_collision<2>(options, other);
    scene->run(300);
    check_collision(*scene);
}

TEST_CASE("a warm body in space moves as a cold one of its size", "[solid][finite][thermal]") {
    // det A W(F A^-1) per volume at rest is W per volume of a body a times as large; so are the jumps if eta is a E, and their cap for areas
    // a^2 as large. It turns and rings.
    constexpr double rise = 250.0, a = 1.0 + strain_per_kelvin * rise;
    for (const Material& material : run_materials) {
        CAPTURE(static_cast<int>(material.law), material.flow.kinematic_hardening);
        const auto run = [&](double size, double density, double eta, double cap, double temperature) {
            const auto mesh = mesh::structured_box<3>(Vector<3>::Zero(), size * Vector<3>(1.0, 0.7, 0.5), {4, 3, 3},
                                                      CellShape::tetrahedron);
            auto options = alone<3>(material);
            options.materials[0].density = density;
            options.materials[0].eta = eta;
            if (material.law == MaterialLaw::j2) options.materials[0].flow.jump_cap = cap;
            options.temperature_rise = {lasting_rise<3>(temperature)};
            solid::Solid<3> solid(mesh, options);
            const auto stretched = sampled<3>(mesh, [&](const Vector<3>& x) -> Vector<3> { return (a / size - 1.0) * x; });
            std::vector<double> p(solid.size());
            const auto noise = random_state(p.size(), 5, 0.02);
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
                const Vector<3> x = a / size * mesh.cell_centroid[static_cast<std::size_t>(c)];
                const Vector<3> v =
                    0.2 * Vector<3>(0.3, -0.5, 0.8).cross(x) + vectors<3>(noise)[static_cast<std::size_t>(c)];
                vectors<3>(p)[static_cast<std::size_t>(c)] = solid.masses()[static_cast<std::size_t>(c)] * v;
            }
            dynamics::Memm<solid::Solid<3>> memm(solid, stretched, p, 0.012);
            for (int step = 0; step < 150; ++step) memm.step();
            std::vector<Vector<3>> found;  // positions, and columns of stresses
            static_cast<void>(solid.potential(std::vector<double>(memm.q().begin(), memm.q().end())));
            double plastic = 0.0;
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
                found.push_back(mesh.cell_centroid[static_cast<std::size_t>(c)] +
                                as_vectors<3>(memm.q())[static_cast<std::size_t>(c)]);
                for (int j = 0; j < 3; ++j) found.push_back(solid.cells().stress(c).col(j));
                raise(plastic, solid.cells().plastic_strain(c));
            }
            CHECK((plastic > 1e-3) == (material.law == MaterialLaw::j2));
            return found;
        };
        const auto hot = run(1.0, a * a * a, a, 0.1 * a * a, rise), cold = run(a, 1.0, 1.0, 0.1, 0.0);
        double off = 0.0;
        for (std::size_t i = 0; i < hot.size(); ++i) raise(off, (hot[i] - cold[i]).norm());
        CHECK(off <= 1e-9);
    }
}

TEST_CASE("a warm body that spins and that nothing holds keeps its size, without stress beyond that of spinning",
          "[solid][finite][thermal]") {
    // In space with F = a Q: only what the spin does, rho omega^2 L^2, is left.
    const Material material = run_material(MaterialLaw::neo_hookean);
    constexpr double rise = 300.0, a = 1.0 + strain_per_kelvin * rise, spin = 1e-3;
    const auto mesh =
        mesh::structured_box<3>(-0.5 * Vector<3>::Ones(), 0.5 * Vector<3>::Ones(), {3, 3, 3}, CellShape::hexahedron);
    auto options = alone<3>(material);
    options.temperature_rise = {lasting_rise<3>(rise)};
    solid::Solid<3> solid(mesh, options);
    std::vector<double> q = sampled<3>(mesh, [&](const Vector<3>&x) -> Vector<3> { return (a - 1.0) * x; }), p(q.size());
    for (std::size_t c = 0; c < q.size() / 3; ++c)
        vectors<3>(p)[c] =
            solid.masses()[c] * a * spin * Vector<3>(0.3, -0.5, 0.8).normalized().cross(mesh.cell_centroid[c]);
    dynamics::Memm<solid::Solid<3>> memm(solid, q, p, 0.5 * dynamics::stable_step(solid).dt);
    while (memm.time() < 1.0 / spin) memm.step();  // a radian
    const std::vector<double> end(memm.q().begin(), memm.q().end());
    static_cast<void>(solid.potential(end));
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) CHECK(solid.cells().stress(c).norm() <= 3.0 * spin * spin);
    CHECK(solid.rotations(end)[0] == Approx(1.0).epsilon(1e-2));
    for (std::int32_t c = 1; c < mesh.n_cells(); ++c) {
        const auto at = [&](std::int32_t k) -> Vector<3> {
            return mesh.cell_centroid[static_cast<std::size_t>(k)] + vectors<3>(end)[static_cast<std::size_t>(k)];
        };
        const double rest = (mesh.cell_centroid[static_cast<std::size_t>(c)] - mesh.cell_centroid[0]).norm();
        CHECK((at(c) - at(0)).norm() == Approx(a * rest).epsilon(1e-5));
    }
}

TEST_CASE("a block of rubber that is warmed between two walls presses with the stress of its law",
          "[solid][finite][thermal]") {
    // From a gap on each side; in the end the stress of the stretches 1.02/a, x and 1/a with sigma_2 = 0. Contact gives way by a part of a cell.
    Material rubber = run_material(MaterialLaw::neo_hookean);
    rubber.damping.mass = 1.0;
    constexpr double half = 0.5, gap = 0.01, rise = 120.0, a = 1.0 + strain_per_kelvin * rise;
    const double lambda = rubber.lambda(), mu = rubber.mu(), x_1 = (half + gap) / half / a, x_3 = 1.0 / a;
    const auto stress = [&](double x, double x_2) {
        return (mu * (x * x - 1.0) + lambda * std::log(x_1 * x_2 * x_3)) / (x_1 * x_2 * x_3);
    };
    double x_2 = 1.0;
    for (double low = 0.7, high = 1.4; high - low > 1e-14; x_2 = 0.5 * (low + high))
        (stress(x_2, x_2) < 0.0 ? low : high) = x_2;
    auto options = finite_of<2>(rubber);
    for (const double side : {-1.0, 1.0})
        options.obstacles.push_back(contact::plane_obstacle<2>({side * (half + gap), 0.0}, {-side, 0.0}, 3.0));
    options.temperature_rise = {{.value =
                                     [](double t, const Vector<2>&) {
                                         const double share = std::min(1.0, t / 20.0);
                                         return rise * share * share * (3.0 - 2.0 * share);
                                     },
                                 .varies = true}};
    const auto mean_stress = [&](int cells) {
        TurningScene<2> scene(mesh::structured_box<2>({-half, -half}, {half, half}, {cells, cells}, CellShape::quadrangle),
                              options, std::vector<Motion<2>>(1), 0.6, Kinematics::finite);
        scene.run_until(45.0);
        CHECK(scene.drifts().pseudo_energy <= 1e-12);
        CHECK(scene.solid.contact().report().missed_contacts == 0);
        static_cast<void>(scene.solid.potential(std::vector<double>(scene.memm.q().begin(), scene.memm.q().end())));
        double sum = 0.0;
        int n = 0;
        for (std::int32_t c = 0; c < scene.mesh.n_cells(); ++c)
            if (scene.mesh.cell_centroid[static_cast<std::size_t>(c)].cwiseAbs().maxCoeff() < 0.2) {
                sum += scene.solid.cells().stress(c)(0, 0);
                ++n;
            }
        return sum / n;
    };
    const double expected = stress(x_1, x_2), coarse = mean_stress(12) / expected - 1.0,
                 fine = mean_stress(20) / expected - 1.0;
    CAPTURE(expected, coarse, fine);
    CHECK(expected < -0.1);
    CHECK(std::abs(fine) <= 0.015);
    CHECK(std::abs(fine) <= 0.65 * std::abs(coarse));  // by the layers of cells at the walls: first order
}

TEST_CASE("a run of a finite body with a temperature goes on from its state with the same bits",
          "[solid][finite][thermal]") {
    const auto mesh = unit_disc(0.5);
    for (const Material& material : run_materials) {
        CAPTURE(static_cast<int>(material.law), material.flow.kinematic_hardening);
        auto options = alone<2>(material);
        options.temperature_rise = {{.value =
                                         [](double t, const Vector<2>& x) {
                                             return 100.0 * std::min(t, 1.5) + 30.0 * x[0];  // constant in the end
                                         },
                                     .varies = true}};
        for (const int steps : {20, 50}) check_that_it_goes_on(mesh, options, steps);
    }
}

TEST_CASE("a temperature that does not vary in time changes no bit by being asked for at every step",
          "[solid][finite][thermal]") {
    const auto mesh = unit_disc(0.5);
    const auto run = [&](bool varies) {
        auto options = alone<2>(with_kinematic_hardening(run_material(MaterialLaw::j2)));
        options.temperature_rise = {
            {.value = [](double, const Vector<2>& x) { return 100.0 + 30.0 * x[0]; }, .varies = varies}};
        solid::Solid<2> solid(mesh, options);
        dynamics::Memm<solid::Solid<2>> memm(solid, std::vector<double>(solid.size(), 0.0),
                                             std::vector<double>(solid.size(), 0.0), 0.05);
        for (int i = 0; i < 40; ++i) memm.step();
        CHECK(solid.dissipated().in_cells > 0.0);
        return std::vector<double>(memm.q().begin(), memm.q().end());
    };
    CHECK(run(true) == run(false));
}
