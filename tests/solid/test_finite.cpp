// Bodies of Kinematics::finite without contact: exact steps, patches, small limit, spins.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "abut/base/error.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/statics.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

template <int Dim>
solid::SolidOptions<Dim> apart(std::vector<Kinematics> kinematics) {
    auto options = bodies<Dim>(static_cast<int>(kinematics.size()));
    options.contact.reset();
    options.kinematics = std::move(kinematics);
    return options;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a step of a finite body does the work of its forces, and gives no momentum and no moment",
                       "[solid][finite]", ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : boxes<Dim>())
        for (const double turn : {0.0, 0.1, 2.0}) {
            CAPTURE(name, turn);
            solid::Solid<Dim> solid(mesh, apart<Dim>({Kinematics::finite}));
            const auto q_0 = turned_state<Dim>(mesh, 0.7, 1, 0.01), q_1 = turned_state<Dim>(mesh, 0.7 + turn, 2, 0.01);
            const StepErrors<Dim> errors(solid, q_0, q_1);
            // Displacements of about 1, which round at epsilon, and strains of 0.01: forces round at 100 epsilon, each twice.
            constexpr double rounding = 100.0 * std::numeric_limits<double>::epsilon();
            CHECK(errors.energy <= rounding);
            CHECK(errors.momentum <= rounding / std::sqrt(static_cast<double>(mesh.n_cells())));
            CHECK(errors.angular <= rounding / std::sqrt(static_cast<double>(mesh.n_cells())));
        }
}

TEMPLATE_TEST_CASE_SIG("forces on finite bodies are minus the gradient of their energy", "[solid][finite]", ((int Dim), Dim),
                       2, 3) {
    for (const auto& [name, mesh] : boxes<Dim>()) {
        CAPTURE(name);
        solid::Solid<Dim> solid(mesh, apart<Dim>({Kinematics::finite}));
        CHECK(slope_error<Dim>(solid, turned_state<Dim>(mesh, 0.7, 1, 0.01)) <= 1e-8);
    }
}

TEMPLATE_TEST_CASE_SIG("the energy of a finite body does not know how it is turned, and vanishes where it is rigid",
                       "[solid][finite]", ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : boxes<Dim>()) {
        CAPTURE(name);
        solid::Solid<Dim> solid(mesh, apart<Dim>({Kinematics::finite}));
        const auto q = turned_state<Dim>(mesh, 0.0, 1, 0.01);
        const double energy = solid.potential(q);
        for (const double angle : {0.5, 1.5, 3.0}) {
            auto turned = q;
            for (std::size_t i = 0; i < turned.size() / Dim; ++i) {
                const Vector<Dim> x = mesh.cell_centroid[i] + vectors<Dim>(q)[i];
                vectors<Dim>(turned)[i] = turned_by<Dim>(angle) * x - mesh.cell_centroid[i];
            }
            CHECK(std::abs(solid.potential(turned) - energy) <= 1e-13 * energy);
            CHECK(solid.potential(turned_state<Dim>(mesh, angle, 1, 0.0)) <= 1e-28);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("finite bodies beside others leave these as they are", "[solid][finite]", ((int Dim), Dim), 2, 3) {
    const auto mesh = mesh::combine<Dim>(std::vector<mesh::Mesh<Dim>>{boxes<Dim>()[0].mesh, boxes<Dim>()[1].mesh,
                                                                      boxes<Dim>()[1].mesh, boxes<Dim>()[0].mesh});
    const auto forces = [&](Kinematics second) {
        const auto options = apart<Dim>({Kinematics::small, second, Kinematics::floating, Kinematics::finite});
        solid::Solid<Dim> solid(mesh, options), again(mesh, options);
        const auto q_0 = turned_state<Dim>(mesh, 0.7, 1, 0.01), q_1 = turned_state<Dim>(mesh, 0.8, 2, 0.01);
        std::vector<double> force(q_0.size());
        solid.mean_force(q_0, q_1, 0.0, 1.0, force);
        CHECK(StepErrors<Dim>(again, q_0, q_1).energy <= 1e-14);
        return force;
    };
    const auto with_finite = forces(Kinematics::finite), without = forces(Kinematics::floating);
    double of_second = 0.0;
    for (std::size_t i = 0; i < without.size(); ++i)
        if (mesh.cell_body[i / Dim] == 1)
            raise(of_second, std::abs(with_finite[i] - without[i]));
        else
            CHECK(with_finite[i] == without[i]);
    CHECK(of_second > 1e-3 * largest(without));
}

TEST_CASE("a patch under uniform stretch is in balance, and has the energy of a bar", "[solid][finite]") {
    const double stretch = GENERATE(0.7, 0.9, 1.2, 1.5), nu = 0.3, plane = nu / (1.0 - nu);
    const double lateral = std::sqrt(1.0 + plane * (1.0 - stretch * stretch));
    const CellShape shape = GENERATE(CellShape::triangle, CellShape::quadrangle);
    CAPTURE(stretch, int(shape));
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.75}, {8, 6}, shape);
    const Matrix<2> f = turned_by<2>(1.1) * Vector<2>(stretch, lateral).asDiagonal();
    const auto field = [&](const Vector<2>& x) -> Vector<2> { return f * x - x; };
    solid::BoundaryConditions<2> conditions;
    for (const char* side : {"xmin", "xmax"}) {
        solid::DirichletCondition<2> condition;
        condition.group = side;
        condition.history = [&](double, const Vector<2>& x) { return field(x); };
        conditions.dirichlet.push_back(condition);
    }
    const std::vector<solid::Material> materials{{.young = 1.0, .poisson = nu}};
    const std::vector<Kinematics> finite{Kinematics::finite};
    solid::Ccg<2> ccg(mesh, materials, conditions, finite);
    const auto u = sampled<2>(mesh, field);
    std::vector<Vector<2>> gradient(mesh.cell_centroid.size());
    ccg.gradient(vectors<2>(u), ccg.load_at(0.0, 0.0), {}, gradient);
    double left = 0.0;
    for (const Vector<2>& of_cell : gradient) raise(left, of_cell.norm());
    CHECK(left <= 1e-14);
    const double exact = 0.75 * std::pow(stretch * stretch - 1.0, 2) / (8.0 * (1.0 - nu * nu));
    CHECK(std::abs(ccg.potential(vectors<2>(u), ccg.load_at(0.0, 0.0), {}) - exact) <= 1e-14 * exact + 1e-16);
    // sigma = F S F^T/det F: along the bar S = E/(1 - nu^2) (l^2 - 1)/2, and nothing across
    const Vector<2> along = turned_by<2>(1.1).col(0);
    const double traction = 0.5 * (stretch * stretch - 1.0) / (1.0 - nu * nu) * stretch / lateral;
    for (const std::int32_t c : {0, 20, 47}) CHECK((ccg.stress(c) - traction * along * along.transpose()).norm() <= 2e-14);
}

TEMPLATE_TEST_CASE_SIG("small displacements of a finite body are those of linear elasticity", "[solid][finite]",
                       ((int Dim), Dim), 2, 3) {
    // Clamped but for two opposite sides: at corners with two free faces both take another extrapolation.
    Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Ones();
    std::array<std::int32_t, Dim> cells;
    cells.fill(4);
    const auto mesh =
        mesh::structured_box<Dim>(lower, upper, cells, Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron);
    const auto forces = [&](Kinematics kinematics, const std::vector<double>& q) {
        auto options = apart<Dim>({kinematics});
        for (const std::string& side : box_sides(Dim))
            if (side[0] != 'y') {
                solid::DirichletCondition<Dim> condition;
                condition.group = side;
                options.boundary.dirichlet.push_back(condition);
            }
        solid::Solid<Dim> solid(mesh, options);
        std::vector<double> force(q.size()), product(q.size());
        solid.force(q, force);
        solid.stiffness_product(q, product);
        return std::pair(force, product);
    };
    double before = 0.0;
    for (const double size : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const auto q = random_state(static_cast<std::size_t>(Dim * mesh.n_cells()), 1, size);
        const auto [finite, finite_stiffness] = forces(Kinematics::finite, q);
        const auto [small, stiffness] = forces(Kinematics::small, q);
        double difference = 0.0, of_stiffness = 0.0;
        for (std::size_t i = 0; i < q.size(); ++i) {
            raise(difference, std::abs(finite[i] - small[i]) / largest(small));
            raise(of_stiffness, std::abs(finite_stiffness[i] - stiffness[i]) / largest(stiffness));
        }
        CHECK(of_stiffness <= 1e-6);
        CHECK(difference > 0.0);
        CHECK(difference <= 100.0 * size);
        if (before > 0.0) CHECK(std::abs(before / difference - 10.0) <= 0.5);
        before = difference;
    }
}

TEMPLATE_TEST_CASE_SIG("a spinning finite body keeps H~ and J~", "[solid][finite]", ((int Dim), Dim), 2, 3) {
    const double noise = GENERATE(0.0, 1e-3), spin = 0.1;
    CAPTURE(noise);
    auto options = apart<Dim>({Kinematics::finite});
    const auto& mesh = [] {
        if constexpr (Dim == 2)
            return mesh::structured_box<2>({-0.5, -0.5}, {0.5, 0.5}, {8, 8}, CellShape::triangle);
        else
            return mesh::structured_box<3>({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, {2, 3, 2}, CellShape::tetrahedron);
    }();
    AxialVector<Dim> turning = AxialVector<Dim>::Zero();
    turning[turning.size() - 1] = spin;
    TurningScene<Dim> scene(mesh, options, {moving<Dim>(Vector<Dim>::Zero(), turning)}, 0.6, Kinematics::finite, noise);
    scene.run_until(3.0 * 2.0 * M_PI / spin);
    const Drifts drifts = scene.drifts();
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.pseudo_moment <= 1e-13);
    CHECK(drifts.momentum <= 1e-13);
    CHECK(drifts.energy_excess <= 1e-2);
    if (noise == 0.0) CHECK(scene.stretch() <= 2.0 * spin * spin);
}

TEMPLATE_TEST_CASE_SIG("finite bodies that spin collide, and keep H~, momentum and J~", "[solid][finite]", ((int Dim), Dim),
                       2, 3) {
    const Kinematics other = GENERATE(Kinematics::finite, Kinematics::floating, Kinematics::rigid);
    CAPTURE(int(other));
    const auto scene = spinning_collision<Dim>(bodies<Dim>(2), other);
    scene->run(steps_of_collision<Dim>);
    check_collision<Dim>(*scene);
    CHECK(scene->drifts().energy_excess <= 1e-2);
}

TEST_CASE("a cantilever bends as the elastica does", "[solid][finite]") {
    // E I theta'' = -P cos(theta), theta(0) = 0, theta'(L) = 0; alpha = P L^2/(E I). w/L of Bisshopp and Drucker, Quart. Appl.
    // Math. 3 (1945) 272-275, and Mattiasson, Int. J. Numer. Meth. Eng. 17 (1981) 145-153.
    const auto [alpha, deflection] = GENERATE(std::pair(1.0, 0.30172), std::pair(2.0, 0.49346), std::pair(5.0, 0.71379));
    const double height = 0.1, nu = 0.3;
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, height}, {40, 4}, CellShape::triangle);
    auto options = apart<2>({Kinematics::finite});
    solid::DirichletCondition<2> clamp;
    clamp.group = "xmin";
    options.boundary.dirichlet.push_back(clamp);
    // The load is on the last cells; what lies beyond their centroid hangs on it.
    const double first = 1.0 - 1.0 / 40.0, length = 1.0 - 0.5 / 40.0,
                 bending = std::pow(height, 3) / (12.0 * (1.0 - nu * nu));
    const double load = alpha * bending / (length * length);
    options.body_load = [=](const Vector<2>& x) -> Vector<2> {
        return Vector<2>(0.0, x[0] > first ? load / (height / 40.0) : 0.0);
    };
    solid::Solid<2> solid(mesh, options);
    const auto found = solid::solve_statics<2>(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-6});
    REQUIRE(found.report.converged);
    double tip = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (mesh.cell_centroid[c][0] > first) tip += mesh.cell_measure[c] / (height / 40.0) * vectors<2>(found.q)[c][1];
    CAPTURE(alpha, tip / length, found.report.evaluations);
    CHECK(std::abs(tip / length / deflection - 1.0) <= 0.02);
}

TEST_CASE("a finite body that collapses is refused by the name of the cell, and says how near it came before",
          "[solid][finite]") {
    // The ends of a bar run into each other, with a speed that is linear along it.
    const auto mesh = mesh::structured_box<2>({-1.0, -0.25}, {1.0, 0.25}, {16, 4}, CellShape::triangle);
    const auto run = [&](double speed, double yield_stress = 0.0) {
        auto options = apart<2>({Kinematics::finite});
        if (yield_stress > 0.0) options.materials[0].law = solid::MaterialLaw::j2;
        options.materials[0].flow.yield_stress = yield_stress;
        solid::Solid<2> solid(mesh, options);
        std::vector<double> p;
        for (std::size_t c = 0; c < mesh.cell_centroid.size(); ++c) {
            p.push_back(-speed * mesh.cell_centroid[c][0] * solid.masses()[c]);
            p.push_back(0.0);
        }
        dynamics::Memm memm(solid, std::vector<double>(p.size(), 0.0), p, 0.4 * dynamics::stable_step(solid).dt);
        while (memm.time() < 4.0) memm.step();
        return solid.cells().finite_extremes();
    };
    const auto slow = run(0.05), faster = run(0.2);
    CHECK(slow.determinant < 1.0);
    CHECK(faster.determinant < slow.determinant);
    CHECK(faster.determinant > 0.1);
    CHECK(slow.strain > 0.0);
    CHECK(slow.strain < faster.strain);
    CHECK_THROWS_WITH(run(2.0),
                      Catch::Contains("Kinematics::finite") && Catch::Contains("collapsed") && Catch::Contains("cell "));
    CHECK_THROWS_AS(run(2.0), Diverged);
    CHECK_THROWS_WITH(run(2.0), !Catch::Contains("cfl"));
    CHECK_THROWS_WITH(run(2.0, 0.01), Catch::Contains("plastic strain of") && Catch::Contains("take a lower cfl first"));
}

TEST_CASE("what a finite body does not know is refused by name", "[solid][finite]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {3, 3}, CellShape::quadrangle);
    auto options = apart<2>({Kinematics::finite});
    SECTION("rollers") {
        solid::DirichletCondition<2> roller;
        roller.group = "xmin";
        roller.constraint = solid::Constraint::normal;
        options.boundary.dirichlet.push_back(roller);
        CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Catch::Contains("Kinematics::finite") && Catch::Contains("xmin"));
    }
    SECTION("clamps that move") {
        solid::DirichletCondition<2> clamp;
        clamp.group = "ymin";
        clamp.history = [](double t, const Vector<2>&) -> Vector<2> { return Vector<2>(t, 0.0); };
        options.boundary.dirichlet.push_back(clamp);
        CHECK_THROWS_WITH(solid::Solid<2>(mesh, options),
                          Catch::Contains("Kinematics::finite") && Catch::Contains("varies"));
    }
    SECTION("tractions that follow and are no pressure") {
        options.boundary.traction.push_back({.group = "ymax", .value = {1.0, 0.0}, .history = {}, .follows = true});
        solid::Solid<2> solid(mesh, options);
        std::vector<double> force(solid.size());
        CHECK_THROWS_WITH(
            solid.force(std::vector<double>(solid.size(), 0.0), force),
            Catch::Contains("Kinematics::finite") && Catch::Contains("follows") && Catch::Contains("pressure"));
    }
    SECTION("local steps") {
        solid::Solid<2> solid(mesh, options);
        CHECK_THROWS_WITH(solid.set_levels(1, std::vector<std::int32_t>(solid.size(), 0)),
                          Catch::Contains("Kinematics::finite"));
    }
}
