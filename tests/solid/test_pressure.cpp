// Pressures on bodies that turn: they turn with the body, or with its faces, and what is in balance stays so.
#include <catch2/catch.hpp>
#include <cmath>

#include "abut/solid/cell_view.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

/// Against the outward normals of a round body about the origin, whose corners are on a circle.
solid::SolidOptions<2> pressed_disc(const std::function<double(double)>& pressure, bool follows = true) {
    auto options = bodies<2>(1);
    options.contact.reset();
    options.boundary.traction = {
        {.group = "boundary",
         .history = [=](double time, const Vector<2>& x) -> Vector<2> { return -pressure(time) * x.normalized(); },
         .follows = follows}};
    return options;
}

template <int Dim>
solid::SolidOptions<Dim> pressed_box(double pressure) {
    auto options = bodies<Dim>(1);
    options.contact.reset();
    for (const std::string& side : box_sides(Dim)) {
        const Vector<Dim> normal = (side.ends_with("max") ? 1.0 : -1.0) * Vector<Dim>::Unit(side[0] - 'x');
        options.boundary.traction.push_back({.group = side, .value = -pressure * normal, .follows = true});
    }
    return options;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("an equal pressure all round gives a body that spins and rings no momentum and no moment",
                       "[solid][pressure]", ((int Dim), Dim), 2, 3) {
    const Kinematics kinematics = GENERATE(Kinematics::floating, Kinematics::finite, Kinematics::rigid);
    CAPTURE(int(kinematics));
    for (const auto& [name, mesh] : boxes<Dim>(2)) {
        CAPTURE(name);
        TurningScene<Dim> scene(mesh, pressed_box<Dim>(0.01), {moving<Dim>(Vector<Dim>::Zero(), some_spin<Dim>(0.1))},
                                kinematics == Kinematics::rigid ? -0.05 : 0.6, kinematics,
                                kinematics == Kinematics::rigid ? 0.0 : 1e-3);
        scene.run(200);
        const Drifts drifts = scene.drifts();
        CHECK(drifts.pseudo_energy <= 1e-12);
        CHECK(drifts.momentum <= 1e-12);
        CHECK(drifts.pseudo_moment <= 1e-12);
    }
}

TEST_CASE("a disc at rest under pressure does not spin up", "[solid][pressure]") {
    const Kinematics kinematics = GENERATE(Kinematics::floating, Kinematics::finite);
    CAPTURE(int(kinematics));
    const auto run = [&](bool follows) {
        TurningScene<2> scene(unit_disc(0.3), pressed_disc([](double) { return 0.01; }, follows), {moving<2>({0.0, 0.0})},
                              0.6, kinematics);
        while (scene.memm.time() < 60.0) scene.memm.step();
        const double speed = 0.01, mass = 3.0;  // p/(rho c), about
        return std::array{scene.solid.rotations(scene.memm.q())[0], scene.pseudo_moment().norm() / (mass * speed)};
    };
    const auto [angle, moment] = run(true);
    CHECK(moment <= 1e-12);
    CHECK(angle <= 1e-5);         // of what rings inside
    CHECK(run(false)[0] > 1e-3);  // forces that stay as they are make it: the disc stands on its head
}

TEST_CASE("under a pressure that grows slowly all of a disc is at -p, its rim included where strains are small",
          "[solid][pressure]") {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    CAPTURE(int(kinematics));
    const double pressure = 1e-3, time = 40.0;  // the disc rings once in about 5
    TurningScene<2> scene(unit_disc(kinematics == Kinematics::finite ? 0.125 : 0.25), pressed_disc([=](double t) {
                              const double share = std::min(1.0, t / time);
                              return pressure * share * share * (3.0 - 2.0 * share);
                          }),
                          {moving<2>({0.0, 0.0})}, 0.6, kinematics);
    scene.run_until(time + 1.0);
    static_cast<void>(scene.solid.potential(scene.memm.q()));
    double worst = 0.0, area = 0.0;
    Matrix<2> mean = Matrix<2>::Zero();
    for (std::int32_t c = 0; c < scene.mesh.n_cells(); ++c)
        if (scene.mesh.cell_centroid[c].norm() < 0.5) {
            mean += scene.mesh.cell_measure[c] * scene.solid.cells().stress(c);
            area += scene.mesh.cell_measure[c];
        }
    const double mean_off = (mean / area + pressure * Matrix<2>::Identity()).norm() / pressure;
    CAPTURE(mean_off);
    for (std::int32_t c = 0; c < scene.mesh.n_cells(); ++c)
        if (kinematics != Kinematics::finite || scene.mesh.cell_centroid[c].norm() < 0.5)
            raise(worst, (scene.solid.cells().stress(c) + pressure * Matrix<2>::Identity()).norm() / pressure);
    CHECK(worst <= 0.02);
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
}

TEST_CASE("a pressure on a finite body acts on the area that its face has", "[solid][pressure]") {
    // A square that is pressed on one side moves as its mass says, and turns when its side does.
    auto options = bodies<2>(1);
    options.contact.reset();
    options.boundary.traction = {{.group = "xmin", .value = {1e-4, 0.0}, .follows = true}};
    const auto mesh = mesh::structured_box<2>({-0.5, -0.5}, {0.5, 0.5}, {4, 4}, CellShape::triangle);
    const double spin = 0.1, time = 0.5 * M_PI / spin;
    TurningScene<2> scene(mesh, options, {moving<2>({0.0, 0.0}, AxialVector<2>(spin))}, 0.6, Kinematics::finite);
    scene.run_until(time);
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
    Vector<2> impulse = Vector<2>::Zero();
    for (const auto& body : solid::body_motions<2>(scene.memm, scene.solid)) impulse += body.mass * body.velocity;
    CHECK(impulse[0] == Approx(1e-4 / spin).epsilon(0.03));  // the integral of (cos, sin)(spin t)
    CHECK(impulse[1] == Approx(1e-4 / spin).epsilon(0.03));
}

TEST_CASE("an equal pressure all round a finite body does no work along a closed path, and turns nothing in any state",
          "[solid][pressure]") {
    for (const auto& [name, mesh] : boxes<2>(3)) {
        CAPTURE(name);
        auto options = pressed_box<2>(0.01);
        options.kinematics = {Kinematics::finite};
        solid::Solid<2> solid(mesh, options);
        auto free = options;
        free.boundary.traction.clear();
        solid::Solid<2> bare(mesh, free);
        std::vector<std::vector<double>> path;
        for (unsigned state = 0; state < 4; ++state) path.push_back(turned_state<2>(mesh, 0.4 * state, state, 0.02));
        path.push_back(path.front());
        double of_steps = 0.0;
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
            const double before = solid.work();
            std::vector<double> force(solid.size()), of_cells(solid.size());
            solid.mean_force(path[i], path[i + 1], static_cast<double>(i), 1.0, force);
            of_steps += std::abs(solid.work() - before);
            bare.mean_force(path[i], path[i + 1], static_cast<double>(i), 1.0, of_cells);
            Vector<2> sum = Vector<2>::Zero();
            double turning = 0.0, size = 0.0;
            for (std::size_t c = 0; c < solid.rest_positions().size(); ++c) {
                const Vector<2> push = vectors<2>(force)[c] - vectors<2>(of_cells)[c];
                const Vector<2> arm =
                    solid.rest_positions()[c] + 0.5 * (vectors<2>(path[i])[c] + vectors<2>(path[i + 1])[c]);
                sum += push;
                turning += moment<2>(arm, push)[0];
                size += push.norm();
            }
            CHECK(sum.norm() <= 1e-13 * size);
            CHECK(std::abs(turning) <= 1e-13 * size);
        }
        CHECK(std::abs(solid.work()) <= 1e-12 * of_steps);
    }
}
