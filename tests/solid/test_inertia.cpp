// Moments of inertia of bodies whose mass is in points, and where these are.
#include <catch2/catch.hpp>
#include <cmath>

#include "abut/solid/body_inertia.hpp"
#include "abut/solid/cell_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

template <int Dim>
solid::SolidOptions<Dim> alone(Kinematics kinematics) {
    auto options = bodies<Dim>(1);
    options.contact.reset();
    options.kinematics = {kinematics};
    return options;
}

/// Of a box with density 1 about its centre, by axis.
template <int Dim>
AxialVector<Dim> inertia_of_box(const Vector<Dim>& sides) {
    const double mass = sides.prod();
    AxialVector<Dim> inertia;
    if constexpr (Dim == 2)
        inertia[0] = mass * sides.squaredNorm() / 12.0;
    else
        for (int k = 0; k < 3; ++k) inertia[k] = mass * (sides.squaredNorm() - sides[k] * sides[k]) / 12.0;
    return inertia;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "a floating body has its moments of inertia on any mesh, and one that is small or finite tells what it lacks",
    "[solid][inertia]", ((int Dim), Dim), 2, 3) {
    Vector<Dim> sides = Vector<Dim>::Constant(1.1);
    sides[0] = 1.4;
    const AxialVector<Dim> expected = inertia_of_box<Dim>(sides);
    for (const auto& [name, mesh] : boxes<Dim>(2)) {
        CAPTURE(name);
        const solid::Solid<Dim> floating(mesh, alone<Dim>(Kinematics::floating)), small(mesh, alone<Dim>(Kinematics::small));
        // Angular momentum of a spin about each axis.
        for (int k = 0; k < expected.size(); ++k) {
            const AxialVector<Dim> spin = AxialVector<Dim>::Unit(k);
            std::vector<Vector<Dim>> velocity;
            for (const Vector<Dim>& x : mesh.cell_centroid) velocity.push_back(dynamics::turning_velocity<Dim>(spin, x));
            const std::vector<double> p = floating.cells().to_p(velocity);
            AxialVector<Dim> angular = AxialVector<Dim>::Zero();
            Vector<Dim> momentum = Vector<Dim>::Zero(), centre = Vector<Dim>::Zero();
            double mass = 0.0;
            for (std::size_t i = 0; i < floating.masses().size(); ++i) {
                mass += floating.masses()[i];
                centre += floating.masses()[i] * floating.rest_positions()[i];
                momentum += vectors<Dim>(p)[i];
                angular += moment<Dim>(floating.rest_positions()[i], vectors<Dim>(p)[i]);
            }
            angular -= moment<Dim>(Vector<Dim>(centre / mass), momentum);
            CHECK((angular - expected[k] * spin).norm() <= 1e-12 * expected[k]);
        }
        const auto of_floating = solid::inertia_of_bodies(floating, mesh), of_small = solid::inertia_of_bodies(small, mesh);
        AxialVector<Dim> sorted = expected;
        std::ranges::sort(sorted);
        CHECK((of_floating[0].exact - sorted).norm() <= 1e-12 * sorted.norm());
        CHECK((of_floating[0].share - AxialVector<Dim>::Ones()).norm() <= 1e-12);
        CHECK(of_small[0].least() < 0.97);
    }
}

TEST_CASE("n x n square cells at their centres have 1 - 1/n^2 of the moment of inertia of a square", "[solid][inertia]") {
    const int n = GENERATE(2, 4, 8);
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::finite);
    const auto mesh = mesh::structured_box<2>({1.0, 5.0}, {3.0, 7.0}, {n, n}, CellShape::quadrangle);
    const auto inertia = solid::inertia_of_bodies(solid::Solid<2>(mesh, alone<2>(kinematics)), mesh);
    CHECK(inertia[0].exact[0] == Approx(4.0 * 8.0 / 12.0).epsilon(1e-12));
    CHECK(inertia[0].share[0] == Approx(1.0 - 1.0 / (n * n)).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG(
    "points beside the centroids leave affine motions exact: no stress where a body turns, one where it stretches",
    "[solid][inertia]", ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : boxes<Dim>(2)) {
        CAPTURE(name);
        solid::Solid<Dim> solid(mesh, alone<Dim>(Kinematics::floating));
        const Matrix<Dim> turn = turned_by<Dim>(1.0);
        Matrix<Dim> stretch = Matrix<Dim>::Identity();
        stretch(0, 0) += 1e-3;
        const Vector<Dim> shift = Vector<Dim>::Constant(20.0);
        std::vector<Vector<Dim>> of_cells;
        for (const Vector<Dim>& x : mesh.cell_centroid) of_cells.push_back(turn * stretch * x + shift - x);
        const std::vector<double> q = solid.cells().to_q(of_cells);
        const auto back = solid.cells().displacement(q);
        static_cast<void>(solid.potential(q));
        const auto& material = solid.options().materials[0];
        Matrix<Dim> stress = material.lambda() * 1e-3 * Matrix<Dim>::Identity();
        stress(0, 0) += 2.0 * material.mu() * 1e-3;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            CHECK((back[c] - of_cells[c]).norm() <= 1e-12 * 20.0);
            bool free = false;  // such a cell is at sigma n = 0 instead
            for (const std::int32_t f : mesh.cell_faces[c]) free = free || mesh.face_cells[f][1] < 0;
            const Matrix<Dim> found = turn.transpose() * solid.cells().stress(c) * turn;
            if (!free) CHECK((found - stress).norm() <= 1e-10 * stress.norm());
        }
        for (Vector<Dim>& u : of_cells) u = Vector<Dim>::Zero();
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            of_cells[c] = turn * mesh.cell_centroid[c] + shift - mesh.cell_centroid[c];
        CHECK(solid.potential(solid.cells().to_q(of_cells)) <= 1e-22);
    }
}

TEST_CASE("a coarse heavy top precesses as a rigid one does", "[solid][inertia]") {
    // The gyroscope of docs/validation: a cube that spins about x, held at the middle of one side under gravity along z.
    const auto precession = [](Kinematics kinematics) {
        const int n = 2;
        const auto mesh = mesh::structured_box<3>({0.0, -0.5, -0.5}, {1.0, 0.5, 0.5}, {n, n, n}, CellShape::hexahedron);
        auto options = alone<3>(kinematics);
        options.materials = {{.young = 50.0, .poisson = 0.3, .density = 1.0}};
        options.acceleration = {{0.0, 0.0, -0.002}};
        options.springs = {
            {.first = {}, .second = {.body = 0, .position = {0.0, 0.0, 0.0}, .radius = 0.3}, .stiffness = 20.0}};
        solid::Solid<3> solid(mesh, options);
        std::vector<Vector<3>> velocity;  // spin and the steady precession of a rigid top, about the pivot
        for (const Vector<3>& x : mesh.cell_centroid) velocity.push_back(AxialVector<3>(0.3, 0.0, 0.02).cross(x));
        dynamics::Memm memm(solid, std::vector<double>(solid.size(), 0.0), solid.cells().to_p(velocity), 0.02);
        while (memm.time() < 10.0) memm.step();
        const auto q = solid.cells().displacement(memm.q());
        Vector<3> along = Vector<3>::Zero();  // from the near cells to the far ones
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            along += (mesh.cell_centroid[c][0] > 0.5 ? 1.0 : -1.0) * (mesh.cell_centroid[c] + q[c]);
        return std::atan2(along[1], along[0]);
    };
    const double rigid = precession(Kinematics::rigid);
    CHECK(std::abs(rigid) > 0.1);
    CHECK(precession(Kinematics::floating) == Approx(rigid).epsilon(0.01));
}
