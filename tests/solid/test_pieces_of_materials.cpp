// One piece of several materials: a mesh that is cut along faces of its cells, the parts bonded for ever.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "abut/mesh/split_body.hpp"
#include "abut/solid/statics.hpp"
#include "solid/dense_stiffness.hpp"
#include "solid/turning_scenes.hpp"

namespace abut::test {
namespace {

using solid::Constraint;
using solid::Kinematics;
using solid::Material;
using solid::Solid;
using solid::SolidOptions;

/// A box from -1 to 1 along x, 0 to 1 across, whose cells with their centroids there are part "core", all others "rest".
template <int Dim>
mesh::Mesh<Dim> piece(CellShape shape, int n, const std::function<bool(const Vector<Dim>&)>& is_core) {
    Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Ones();
    lower[0] = -1.0;
    std::array<int, Dim> counts;
    counts.fill(n);
    counts[0] = 2 * n;
    const auto whole = mesh::structured_box<Dim>(lower, upper, counts, shape, "piece");
    std::vector<std::int32_t> part_of;
    for (const Vector<Dim>& x : whole.cell_centroid) part_of.push_back(is_core(x) ? 0 : 1);
    return mesh::split_body<Dim>(whole, part_of, {"core", "rest"});
}

template <int Dim>
std::vector<CellShape> shapes() {
    return Dim == 2 ? std::vector{CellShape::quadrangle, CellShape::triangle}
                    : std::vector{CellShape::hexahedron, CellShape::tetrahedron};
}

template <int Dim>
SolidOptions<Dim> of_materials(const mesh::Mesh<Dim>& mesh, const Material& core, const Material& rest) {
    SolidOptions<Dim> options;
    options.materials = {core, rest};
    for (const auto& pair : mesh.report.joined_bodies) options.bonds.push_back({.sides = pair});
    return options;
}

/// Largest deviation of the static solution from `field`, which all outer sides are given, over the largest displacement.
template <int Dim>
double worst_in_field(const mesh::Mesh<Dim>& mesh, SolidOptions<Dim> options,
                      const std::function<Vector<Dim>(const Vector<Dim>&)>& field) {
    for (const std::string& side : box_sides(Dim)) {
        solid::DirichletCondition<Dim> held;
        held.group = side;
        held.history = [field](double, const Vector<Dim>& x) { return field(x); };
        options.boundary.dirichlet.push_back(held);
    }
    Solid<Dim> solid(mesh, options);
    const auto solution = solid::solve_statics(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-12});
    CHECK(solution.report.converged);
    const auto exact = sampled(mesh, field);
    double worst = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) raise(worst, std::abs(solution.q[i] - exact[i]));
    return worst / largest(exact);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("two stiffnesses in series and side by side in one piece are exact to 1e-10",
                       "[solid][bonds][pieces]", ((int Dim), Dim), 2, 3) {
    const double ratio = GENERATE(1.0, 4.0, 1000.0), strain = 1e-5;
    for (const CellShape shape : shapes<Dim>()) {
        CAPTURE(Dim, ratio, static_cast<int>(shape));
        {
            // behind each other along x, with no strain across
            const auto mesh = piece<Dim>(shape, 4, [](const Vector<Dim>& x) { return x[0] < 0.0; });
            const auto options = of_materials<Dim>(mesh, {.young = ratio, .poisson = 0.0, .density = 1.0}, {1.0, 0.0, 1.0});
            const std::function<Vector<Dim>(const Vector<Dim>&)> field = [&](const Vector<Dim>& x) -> Vector<Dim> {
                return strain * (x[0] < 0.0 ? x[0] / ratio : x[0]) * Vector<Dim>::UnitX();
            };
            CHECK(worst_in_field<Dim>(mesh, options, field) < 1e-10);
        }
        // beside each other, stretched along x so that nothing pulls across
        const double nu = 0.3;
        const auto mesh = piece<Dim>(shape, 4, [](const Vector<Dim>& x) { return x[1] < 0.5; });
        const auto options = of_materials<Dim>(mesh, {.young = ratio, .poisson = nu, .density = 1.0}, {1.0, nu, 1.0});
        const std::function<Vector<Dim>(const Vector<Dim>&)> field = [&](const Vector<Dim>& x) -> Vector<Dim> {
            Vector<Dim> u = Vector<Dim>::Zero();
            u[0] = strain * x[0];
            u[1] = -strain * nu / (1.0 - nu) * x[1];
            return u;
        };
        CHECK(worst_in_field<Dim>(mesh, options, field) < 1e-10);
    }
}

TEMPLATE_TEST_CASE_SIG(
    "a core of bricks all around which the same material is glued takes any uniform strain exactly, to 1e-10",
    "[solid][bonds][pieces]", ((int Dim), Dim), 2, 3) {
    const Vector<Dim> middle = 0.5 * (Vector<Dim>::Ones() - Vector<Dim>::UnitX());
    const auto mesh = piece<Dim>(Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron, Dim == 2 ? 6 : 4,
                                 [&](const Vector<Dim>& x) { return (x - middle).cwiseAbs().maxCoeff() < 0.26; });
    const Material steel{.young = 1.0, .poisson = 0.3, .density = 1.0};
    const std::function<Vector<Dim>(const Vector<Dim>&)> field = [](const Vector<Dim>& x) -> Vector<Dim> {
        Vector<Dim> u = Vector<Dim>::Zero();
        u[0] = 1e-5 * (x[0] + 0.4 * x[1]);
        u[1] = 1e-5 * (0.7 * x[0] - 0.2 * x[1]);
        return u;
    };
    CHECK(worst_in_field<Dim>(mesh, of_materials<Dim>(mesh, steel, steel), field) < 1e-10);
}

namespace {

/// Lowest frequency of a free body, behind those of rigid motions.
double lowest_of_free(Solid<2>& solid) {
    const auto n = static_cast<Eigen::Index>(solid.size());
    const Eigen::VectorXd root = Eigen::Map<const Eigen::VectorXd>(solid.inverse_mass().data(), n).cwiseSqrt();
    const Eigen::MatrixXd k = root.asDiagonal() * dense_stiffness(solid) * root.asDiagonal();
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues()[3]);
}

}  // namespace

TEST_CASE("a block that is cut into parts of one material bends with the frequency of one piece, within 5 %",
          "[solid][bonds][pieces]") {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating);
    const auto shape = GENERATE(CellShape::triangle, CellShape::quadrangle);
    const int cut = GENERATE(0, 1, 2);
    CAPTURE(static_cast<int>(kinematics), static_cast<int>(shape), cut);
    const auto mesh = piece<2>(shape, 8, [&](const Vector<2>& x) {
        return cut == 0 ? x[0] < 0.0 : cut == 1 ? (x - Vector<2>(0.0, 0.5)).norm() < 0.3 : x[1] < 0.5 + 0.2 * x[0];
    });
    const Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
    auto options = of_materials<2>(mesh, material, material);
    options.kinematics.assign(2, kinematics);
    SolidOptions<2> of_one;
    of_one.materials = {material};
    of_one.kinematics = {kinematics};
    const auto whole = mesh::structured_box<2>({-1.0, 0.0}, {1.0, 1.0}, {16, 8}, shape, "whole");
    Solid<2> parts(mesh, options), one(whole, of_one);
    CHECK(lowest_of_free(parts) == Approx(lowest_of_free(one)).epsilon(0.05));
}

namespace {

/// A strip of one piece on rollers, of stiffness 1 where x < 0 and `ratio` behind: a pulse of displacement 1/2 (1 + cos) runs to x = 0.
std::array<double, 2> reflected_and_transmitted(double ratio, Kinematics kinematics) {
    const double width = 0.5, start = -0.7, height = 0.04;
    const auto whole = mesh::structured_box<2>({-3.0, 0.0}, {3.0, height}, {300, 2}, CellShape::quadrangle, "strip");
    std::vector<std::int32_t> part_of;
    for (const Vector<2>& x : whole.cell_centroid) part_of.push_back(x[0] < 0.0 ? 0 : 1);
    const auto mesh = mesh::split_body<2>(whole, part_of, {"core", "rest"});
    auto options = of_materials<2>(mesh, {.young = 1.0, .poisson = 0.0, .density = 1.0}, {ratio, 0.0, 1.0});
    options.kinematics.assign(2, kinematics);
    if (kinematics == Kinematics::small)
        for (const char* side : {"ymin", "ymax"}) {
            solid::DirichletCondition<2> rollers;
            rollers.group = side;
            rollers.constraint = Constraint::normal;
            options.boundary.dirichlet.push_back(rollers);
        }
    Solid<2> solid(mesh, options);
    std::vector<double> q(solid.size(), 0.0), p(solid.size(), 0.0);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const double s = (mesh.cell_centroid[c][0] - start) / width;
        if (std::abs(s) >= 1.0) continue;
        q[2 * c] = 1e-4 * 0.5 * (1.0 + std::cos(std::numbers::pi * s));
        p[2 * c] = 1e-4 * solid.masses()[c] * 0.5 * std::numbers::pi / width * std::sin(std::numbers::pi * s);
    }
    dynamics::Memm memm(solid, q, p, 0.5 * dynamics::stable_step(solid).dt);
    while (memm.time() < 1.4) memm.step();
    std::array<double, 2> largest{};
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        if (mesh.cell_centroid[c][0] < -1.3) continue;
        double& of_side = largest[static_cast<std::size_t>(mesh.cell_body[c])];
        if (std::abs(memm.q()[2 * c]) > std::abs(of_side)) of_side = memm.q()[2 * c];
    }
    return {largest[0] / 1e-4, largest[1] / 1e-4};
}

}  // namespace

TEST_CASE("a pulse in one piece of stiffnesses 1 and 4 comes back with -1/3 and goes on with 2/3",
          "[solid][bonds][pieces]") {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating);
    CAPTURE(static_cast<int>(kinematics));
    const auto [back, on] = reflected_and_transmitted(4.0, kinematics);
    CHECK(back == Approx(-1.0 / 3.0).epsilon(0.015));
    CHECK(on == Approx(2.0 / 3.0).epsilon(0.015));
    const auto [none, all] = reflected_and_transmitted(1.0, kinematics);
    CHECK(std::abs(none) <= 0.01);
    CHECK(all == Approx(1.0).epsilon(0.015));
}

}  // namespace abut::test
