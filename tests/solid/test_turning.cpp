// Bodies in floating frames: what turns keeps energy, momentum and angular momentum, and does not grow.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/neutral_restart.hpp"
#include "abut/dynamics/point_system.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

using std::numbers::pi;

template <int Dim>
mesh::Mesh<Dim> block(int cells = 4) {
    std::array<int, Dim> counts;
    counts.fill(cells);
    Vector<Dim> upper = Vector<Dim>::Constant(0.5);
    upper[0] = 0.7;
    return mesh::structured_box<Dim>(-upper, upper, counts, Dim == 2 ? CellShape::triangle : CellShape::tetrahedron);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a free block that spins for 20 turns keeps H~, momentum and J~, and its size", "[solid][turning]",
                       ((int Dim), Dim), 2, 3) {
    const double noise = GENERATE(0.0, 1e-3);
    auto options = bodies<Dim>(1);
    options.contact.reset();
    const double spin = 0.1;
    TurningScene<Dim> scene(block<Dim>(), options, {{.velocity = Vector<Dim>::Constant(0.02), .spin = some_spin<Dim>(spin)}},
                            0.8, Kinematics::floating, noise);
    scene.run_until(20.0 * 2.0 * pi / spin);
    const Drifts drifts = scene.drifts();
    CAPTURE(noise, scene.memm.steps(), scene.stretch());
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.pseudo_moment <= 1e-13);
    CHECK(drifts.momentum <= 1e-13);
    CHECK(drifts.energy_excess <= 1e-3);
    if (noise == 0.0) CHECK(scene.stretch() <= 2.0 * spin * spin);  // the centrifugal stretch of E = rho = 1
}

TEMPLATE_TEST_CASE_SIG("a uniform strain of a body that turns has the energy of that strain alone, whatever its cells",
                       "[solid][turning]", ((int Dim), Dim), 2, 3) {
    const bool simplices = GENERATE(true, false);
    const CellShape shape = Dim == 2 ? (simplices ? CellShape::triangle : CellShape::quadrangle)
                                     : (simplices ? CellShape::tetrahedron : CellShape::hexahedron);
    std::array<int, Dim> counts;
    counts.fill(3);
    const auto linear = [](double first, double last) {
        Vector<Dim> values;
        for (int i = 0; i < Dim; ++i) values[i] = first + (last - first) * i / (Dim - 1);
        return values;
    };
    const Vector<Dim> upper = linear(0.4, 0.9);
    const auto mesh = mesh::structured_box<Dim>(-upper, upper, counts, shape);
    solid::SolidOptions<Dim> options;
    options.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0}};
    options.boundary.free_face_rule = solid::FreeFaceRule::extrapolate;
    options.kinematics = {Kinematics::floating};
    solid::Solid<Dim> body(mesh, options);
    const Matrix<Dim> strain = linear(-0.01, 0.02).asDiagonal();  // along axes of inertia, which then only turn
    const Matrix<Dim> turned = turned_by<Dim>(1.0) * (Matrix<Dim>::Identity() + strain);
    std::vector<double> u;
    for (const Vector<Dim>& x : body.rest_positions()) {
        const Vector<Dim> moved = turned * x - x;
        u.insert(u.end(), moved.data(), moved.data() + Dim);
    }
    const solid::Material& material = options.materials[0];
    const double volume = (2.0 * upper).prod();
    const double energy =
        volume * (0.5 * material.lambda() * std::pow(strain.trace(), 2) + material.mu() * strain.squaredNorm());
    CHECK(body.potential(u) == Approx(energy).epsilon(1e-12));
}

TEST_CASE("discs that spin and collide keep H~, momentum and J~", "[solid][turning]") {
    TurningScene<2> scene(two_discs(0.8), bodies<2>(2),
                          {{{0.05, 0.0}, some_spin<2>(0.1)}, {{-0.05, 0.0}, some_spin<2>(0.05)}}, 0.6);
    scene.run_until(30.0);
    check_collision(scene);
}

TEST_CASE("boxes of tetrahedra that collide keep H~, momentum and J~", "[solid][turning]") {
    TurningScene<3> scene(two_boxes(4), bodies<3>(2),
                          {{.velocity = {0.02, 0.01, 0.05}}, {{-0.02, 0.0, -0.05}, some_spin<3>(0.1)}}, 0.6);
    scene.run_until(30.0);
    check_collision(scene);
}

TEMPLATE_TEST_CASE_SIG("blocks of simplices eight cells thick keep H~, momentum and J~ as they collide, off their middles",
                       "[solid][turning]", ((int Dim), Dim), 2, 3) {
    const auto made_of = [](const Vector<Dim>& lower, int cells, const char* name) {
        std::array<int, Dim> counts;
        counts.fill(cells);
        return mesh::structured_box<Dim>(lower, lower + Vector<Dim>::Ones(), counts,
                                         Dim == 2 ? CellShape::triangle : CellShape::tetrahedron, name);
    };
    Vector<Dim> above = Vector<Dim>::Constant(0.3);
    above[Dim - 1] = 1.01;
    const Vector<Dim> falling = -0.05 * Vector<Dim>::Unit(Dim - 1);
    TurningScene<Dim> scene(together(made_of(Vector<Dim>::Zero(), 8, "lower"), made_of(above, 9, "upper")), bodies<Dim>(2),
                            {moving<Dim>(Vector<Dim>::Zero()), moving<Dim>(falling, some_spin<Dim>(0.05))}, 0.6);
    scene.run_until(Dim == 2 ? 10.0 : 1.0);
    check_collision(scene);
}
