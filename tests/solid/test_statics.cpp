#include <catch2/catch.hpp>

#include <Eigen/Dense>

#include "abut/solid/contact_view.hpp"
#include "abut/solid/statics.hpp"
#include "solid/dense_stiffness.hpp"
#include "solid/scenes.hpp"

namespace abut::test {
namespace {

using solid::Constraint;
using solid::Material;
using solid::Solid;
using solid::SolidOptions;
using solid::StaticOptions;
using solid::StaticSolution;

/// Rollers where each coordinate is least, and a traction t along x at the far end: a bar in tension.
template <int Dim>
SolidOptions<Dim> pulled_bar(const Material& material, double t) {
    SolidOptions<Dim> options;
    options.materials = {material};
    for (const char* side : {"xmin", "ymin", "zmin"})
        if (Dim == 3 || side != std::string("zmin"))
            options.boundary.dirichlet.push_back({.group = side, .constraint = Constraint::normal});
    options.boundary.traction = {{.group = "xmax", .value = t * Vector<Dim>::UnitX()}};
    return options;
}

/// Uniaxial stress: the sides give way by -nu (3D), or -nu/(1-nu) in plane strain.
template <int Dim>
Vector<Dim> stretched(const Material& material, double t, const Vector<Dim>& x) {
    const double nu = material.poisson;
    const double along = t / material.young * (Dim == 3 ? 1.0 : 1.0 - nu * nu);
    const double across = -along * (Dim == 3 ? nu : nu / (1.0 - nu));
    Vector<Dim> u = across * (x + Vector<Dim>::Constant(0.3));  // the rollers stand at -0.3
    u[0] = along * (x[0] + 0.3);
    return u;
}

template <int Dim>
void check_pulled_bar() {
    const Material material{.young = 210e9, .poisson = 0.3, .density = 7800.0};
    const double t = 1e6;
    for (const auto& [name, mesh] : boxes<Dim>()) {
        CAPTURE(Dim, name);
        Solid<Dim> solid(mesh, pulled_bar<Dim>(material, t));
        const StaticSolution solution = solve_statics(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-12});
        CHECK(solution.report.converged);
        const auto exact = sampled(mesh, [&](const Vector<Dim>& x) { return stretched<Dim>(material, t, x); });
        double worst = 0.0;
        for (std::size_t i = 0; i < exact.size(); ++i) raise(worst, std::abs(solution.q[i] - exact[i]));
        CHECK(worst < 1e-10 * largest(exact));
    }
}

TEST_CASE("a bar pulled at its end stretches and thins as Hooke's law says, to 1e-10") {
    check_pulled_bar<2>();
    check_pulled_bar<3>();
}

template <int Dim>
SolidOptions<Dim> loaded_cantilever() {
    SolidOptions<Dim> options;
    options.materials = {{.young = 3.0, .poisson = 0.25, .density = 1.0}};
    options.boundary.dirichlet = {{.group = "xmin"}};
    options.body_load = [](const Vector<Dim>& x) { return Vector<Dim>(std::sin(3.0 * x[1]) * Vector<Dim>::Constant(0.1)); };
    return options;
}

template <int Dim>
void check_against_dense_matrix() {
    for (const auto& [name, mesh] : boxes<Dim>()) {
        CAPTURE(Dim, name);
        Solid<Dim> solid(mesh, loaded_cantilever<Dim>());
        const StaticSolution solution = solve_statics(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-12});
        std::vector<double> load(solid.size());
        solid.force(std::vector<double>(solid.size(), 0.0), load);
        const Eigen::VectorXd expected = dense_stiffness(solid).ldlt().solve(
            Eigen::Map<const Eigen::VectorXd>(load.data(), static_cast<Eigen::Index>(load.size())));
        const Eigen::Map<const Eigen::VectorXd> found(solution.q.data(), expected.size());
        CHECK((found - expected).lpNorm<Eigen::Infinity>() < 1e-9 * expected.lpNorm<Eigen::Infinity>());
    }
}

TEST_CASE("the static solution is that of a decomposition of the dense stiffness matrix") {
    check_against_dense_matrix<2>();
    check_against_dense_matrix<3>();
}

/// A box on rollers at its sides, on a rigid plane at z = -0.3 (y in 2D), with its weight and a traction from above.
template <int Dim>
SolidOptions<Dim> resting_box(double weight_density, double pressure) {
    SolidOptions<Dim> options = reconstructed_bodies<Dim>(1);
    options.acceleration = {-weight_density * Vector<Dim>::Unit(Dim - 1)};
    options.obstacles = {contact::plane_obstacle<Dim>(-0.3 * Vector<Dim>::Unit(Dim - 1), Vector<Dim>::Unit(Dim - 1), 5.0)};
    options.boundary.dirichlet = {{.group = "xmin", .constraint = Constraint::normal},
                                  {.group = "xmax", .constraint = Constraint::normal}};
    if (Dim == 3) options.boundary.dirichlet.push_back({.group = "ymin", .constraint = Constraint::normal});
    options.boundary.traction = {{.group = Dim == 2 ? "ymax" : "zmax", .value = -pressure * Vector<Dim>::Unit(Dim - 1)}};
    return options;
}

template <int Dim>
void check_reaction() {
    for (const auto& [name, mesh] : boxes<Dim>()) {
        CAPTURE(Dim, name);
        Solid<Dim> solid(mesh, resting_box<Dim>(0.01, 0.002));
        const StaticSolution solution = solve_statics(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-11});
        CHECK(solution.report.converged);
        CHECK(solution.report.compression < 0.3);
        const double area = Dim == 2 ? 1.4 : 1.4 * 1.1;
        double reaction = 0.0;
        const auto field = solid.contact_at(solution.q).field();
        for (std::size_t b = 0; b < field.pressure.size(); ++b)
            reaction += field.pressure[b] * mesh.face_measure[mesh.boundary_faces[b]];
        CHECK(reaction == Approx(area * (0.01 * 1.1 + 0.002)).epsilon(1e-9));
    }
}

TEST_CASE("a plane carries what rests on it: reaction equals weight and load to 1e-9") {
    check_reaction<2>();
    check_reaction<3>();
}

/// Two blocks one on the other, held from below and at the sides, pressed by a displacement of the top. The edges of the
/// two contact surfaces meet: to slide a little past each other takes area from the outermost pairs, an effect of the second
/// order in the load, which is therefore small here.
TEST_CASE("two matching blocks pressed onto each other carry one uniform stress, to 1e-9") {
    const auto mesh = together(mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {4, 4}, CellShape::quadrangle, "lower"),
                               mesh::structured_box<2>({0.0, 1.0}, {1.0, 2.0}, {4, 3}, CellShape::quadrangle, "upper"));
    auto options = reconstructed_bodies<2>(2);
    options.materials[1] = {.young = 7.0, .poisson = 0.2, .density = 1.0};
    for (const char* side : {"lower.xmin", "lower.xmax", "upper.xmin", "upper.xmax", "lower.ymin"})
        options.boundary.dirichlet.push_back({.group = side, .constraint = Constraint::normal});
    const double moved = -1e-8;
    options.boundary.dirichlet.push_back({.group = "upper.ymax", .constraint = Constraint::normal, .value = {0.0, moved}});
    Solid<2> solid(mesh, options);
    const StaticSolution solution = solve_statics(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-11});
    REQUIRE(solution.report.converged);
    const double pressure =  // two springs in series, sides held: 1/(lambda + 2 mu) each
        -moved / (1.0 / options.materials[0].wave_modulus() + 1.0 / options.materials[1].wave_modulus());
    std::vector<double> force(solid.size());
    solid.force(solution.q, force);
    double worst = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) raise(worst, std::abs(solid.ccg().stress(c)(1, 1) + pressure));
    CHECK(worst < 1e-9 * pressure);
    const auto field = solid.contact_at(solution.q).field();
    for (const double p : field.pressure) CHECK((p == 0.0 || std::abs(p - pressure) < 1e-9 * pressure));
}

std::string refusal(const mesh::Mesh<2>& mesh, const SolidOptions<2>& options) {
    Solid<2> solid(mesh, options);
    try {
        (void)solve_statics(solid, std::vector<double>(solid.size(), 0.0));
    } catch (const std::exception& error) {
        return error.what();
    }
    return "not refused";
}

TEST_CASE("bodies pressed in deeper than a run allows are refused under both laws, by their names") {
    const auto law = GENERATE(solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential);
    const auto mesh = together(mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {4, 4}, CellShape::quadrangle, "lower"),
                               mesh::structured_box<2>({0.0, 1.0}, {1.0, 2.0}, {4, 3}, CellShape::quadrangle, "upper"));
    auto options = bodies<2>(2);
    options.law = law;
    for (const char* side : {"lower.xmin", "lower.xmax", "upper.xmin", "upper.xmax", "lower.ymin"})
        options.boundary.dirichlet.push_back({.group = side, .constraint = Constraint::normal});
    // A free face is where its cell has no strain at all, in twice the depth: |g|/D is twice the mean strain.
    const double strain = GENERATE(0.02, 0.1), limit = 0.05;
    options.contact->compression_limit = limit;
    options.boundary.dirichlet.push_back(
        {.group = "upper.ymax", .constraint = Constraint::normal, .value = {0.0, -2.0 * strain}});
    Solid<2> solid(mesh, options);
    const auto solve = [&] { return solve_statics(solid, std::vector<double>(solid.size(), 0.0)); };
    if (strain < limit) {
        CHECK(solve().report.compression == Approx(2.0 * strain).epsilon(0.1));
        return;
    }
    try {
        static_cast<void>(solve());
        FAIL("a compression of " << solid.contact().compression() << " is taken");
    } catch (const TooDeep& error) {
        CHECK(error.facts().value > limit);
        CHECK(error.facts().allowed == limit);
        for (const char* part : {"compression_limit", "'lower'", "'upper'"}) CHECK_THAT(error.what(), Catch::Contains(part));
    }
}

TEST_CASE("a body that is free to move as a rigid one is refused by its name and motion") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {4, 4}, CellShape::quadrangle, "block");
    SolidOptions<2> options;
    options.materials = {Material{}};
    CHECK_THAT(refusal(mesh, options), Catch::Contains("body 0 ('block') is free to"));
    options.boundary.dirichlet = {{.group = "xmin", .constraint = Constraint::normal}};
    CHECK_THAT(refusal(mesh, options), Catch::Contains("body 0 ('block') is free to move along (0, 1)") ||
                                           Catch::Contains("body 0 ('block') is free to move along (0, -1)"));
    options.boundary.dirichlet = {{.group = "xmin", .constraint = Constraint::normal},
                                  {.group = "ymin", .constraint = Constraint::normal}};
    CHECK(refusal(mesh, options) == "not refused");
}

TEST_CASE("a second body is held by contact alone: where it touches, and not where it is apart") {
    for (const double gap : {0.0, 0.01}) {
        const auto mesh =
            together(mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {4, 4}, CellShape::quadrangle, "lower"),
                     mesh::structured_box<2>({0.1, 1.0 + gap}, {0.9, 1.5}, {3, 2}, CellShape::quadrangle, "upper"));
        auto options = reconstructed_bodies<2>(2);
        options.acceleration = {Vector<2>::Zero(), Vector<2>(0.0, -0.001)};
        options.boundary.dirichlet = {{.group = "lower.ymin"}, {.group = "upper.xmin", .constraint = Constraint::normal}};
        if (gap == 0.0)
            CHECK(refusal(mesh, options) == "not refused");
        else
            CHECK_THAT(refusal(mesh, options), Catch::Contains("body 1 ('upper') is free to move along (0, "));
    }
}

TEST_CASE("a body that its load pulls off its support is named") {
    const auto mesh = mesh::structured_box<2>({-0.3, -0.3}, {1.1, 0.8}, {4, 4}, CellShape::quadrangle, "block");
    CHECK_THAT(refusal(mesh, resting_box<2>(0.01, -0.2)),
               Catch::Contains("body 0 ('block') is free to move along (0,") && Catch::Contains("its contact has opened"));
}

/// A disc that its weight presses onto a plane, kept from rolling where it is highest.
TEST_CASE("where V has an edge at its minimum no state near it is lower, and all else is in balance") {
    auto mesh = unit_disc(0.15);
    mesh.groups.push_back({"top", {}});
    for (const std::int32_t face : mesh.boundary_faces)
        if (mesh.face_centroid[face].y() > 0.8) mesh.groups.back().faces.push_back(face);
    auto options = reconstructed_bodies<2>(1);
    options.acceleration = {{0.0, -0.02}};
    options.obstacles = {contact::plane_obstacle<2>({0.0, -1.0}, {0.0, 1.0}, 3.0)};
    options.boundary.dirichlet = {{.group = "top", .constraint = Constraint::components, .components = {true, false}}};
    Solid<2> solid(mesh, options);
    std::vector<double> start(solid.size(), 0.0);
    for (std::size_t i = 1; i < start.size(); i += 2) start[i] = -0.005;  // its lowest faces lie above -1
    const StaticSolution solution = solve_statics(solid, start, {.tolerance = 1e-10, .potential_tolerance = 1e-14});
    REQUIRE(solution.report.converged);
    REQUIRE(solution.report.residual > 1e-6);  // or there is no edge, and this test shows nothing
    CHECK(solution.report.residual_elsewhere < 1e-4);
    const double lowest = solid.potential(solution.q);
    for (unsigned seed = 0; seed < 200; ++seed) {
        std::vector<double> near = random_state(solid.size(), seed, seed % 2 == 0 ? 1e-5 : 1e-7);
        for (std::size_t i = 0; i < near.size(); ++i) near[i] += solution.q[i];
        CHECK(solid.potential(near) > lowest);
    }
}

TEST_CASE("static options out of range are refused with value and limit") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {2, 2}, CellShape::quadrangle);
    Solid<2> solid(mesh, pulled_bar<2>({}, 0.1));
    const std::vector<double> start(solid.size(), 0.0);
    CHECK_THROWS_WITH(solve_statics(solid, start, {.tolerance = 0.0}), Catch::Contains("tolerance is 0; it must be > 0"));
    CHECK_THROWS_WITH(solve_statics(solid, start, {.potential_tolerance = -1.0}),
                      Catch::Contains("potential_tolerance is -1; it must be 0 or more"));
    CHECK_THROWS_WITH(solve_statics(solid, start, {.iterations = 0}), Catch::Contains("iterations is 0; at least 1"));
    CHECK_THROWS_WITH(solve_statics(solid, start, {.history = 0}), Catch::Contains("history is 0; at least 1"));
    CHECK_THROWS_WITH(solve_statics(solid, start, {.first_step = -1.0}), Catch::Contains("first_step is -1 m"));
    CHECK_THROWS_WITH(solve_statics(solid, std::vector<double>(3, 0.0)), Catch::Contains("3"));
}

TEST_CASE("a solution that is not as good as asked for says what it reached and why it stopped") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {6, 6}, CellShape::quadrangle);
    Solid<2> solid(mesh, pulled_bar<2>({}, 0.1));
    const std::vector<double> start(solid.size(), 0.0);
    const auto few = solve_statics(solid, start, {.iterations = 5});
    CHECK_FALSE(few.report.converged);
    CHECK(few.report.iterations.size() == 6);
    CHECK(few.report.residual > 1e-8);
    CHECK_THAT(few.report.ending, Catch::Contains("5 iterations were not enough"));
    const auto too_good = solve_statics(solid, start, {.tolerance = 1e-18});
    CHECK_FALSE(too_good.report.converged);
    CHECK(too_good.report.residual < 1e-12);
    CHECK_THAT(too_good.report.ending, Catch::Contains("rounding"));
}

}  // namespace
}  // namespace abut::test
