// Cells beyond limits of strain and stress, and what is left around a cell that leaves.
#include <catch2/catch.hpp>
#include <cmath>

#include "abut/base/decompositions.hpp"
#include "abut/base/error.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/erosion.hpp"
#include "solid/changing_run.hpp"

namespace abut::test {
namespace {

using solid::ErosionLimits;
using solid::LeavingReason;

template <int Dim>
mesh::Mesh<Dim> box_of(const std::array<int, Dim>& n, CellShape shape) {
    Vector<Dim> upper;
    for (int i = 0; i < Dim; ++i) upper[i] = n[static_cast<std::size_t>(i)];
    return mesh::structured_box<Dim>(Vector<Dim>::Zero(), upper, n, shape, "block");
}

template <int Dim>
SolidOptions<Dim> plain_elastic(Kinematics kinematics) {
    SolidOptions<Dim> options;
    options.materials = {{.young = 2.0, .poisson = 0.25, .density = 1.0}};
    options.kinematics = {kinematics};
    return options;
}

/// Far from the boundary.
template <int Dim>
bool is_inside(const mesh::Mesh<Dim>& mesh, std::int32_t cell, double upper) {
    const Vector<Dim>& x = mesh.cell_centroid[static_cast<std::size_t>(cell)];
    return x.minCoeff() > 2.0 && x.maxCoeff() < upper - 2.0;
}

/// Cells inside of a block of `n` cells a side that leave where the whole has the displacement gradient `g`.
template <int Dim>
std::vector<LeavingReason> reasons_inside(const Matrix<Dim>& g, Kinematics kinematics, CellShape shape,
                                          const ErosionLimits& limits) {
    constexpr int n = 6;
    std::array<int, Dim> counts;
    counts.fill(n);
    const mesh::Mesh<Dim> mesh = box_of<Dim>(counts, shape);
    SolidOptions<Dim> options = plain_elastic<Dim>(kinematics);
    options.erosion = {limits};
    Solid<Dim> solid(mesh, options);
    std::vector<Vector<Dim>> u;
    for (const Vector<Dim>& x : mesh.cell_centroid) u.push_back(g * x);
    static_cast<void>(solid.potential(solid.cells().to_q(u)));
    std::vector<LeavingReason> reasons;
    for (const solid::LeavingCell& one : solid::cells_beyond_limits(solid))
        if (is_inside(mesh, one.cell, n)) reasons.push_back(one.reason);
    return reasons;
}

template <int Dim>
Matrix<Dim> tested_gradient() {
    Matrix<Dim> g = Matrix<Dim>::Zero();
    g(0, 0) = 0.01;
    g(0, 1) = 0.006;
    g(1, 0) = -0.002;
    g(1, 1) = -0.003;
    if constexpr (Dim == 3) g(1, 2) = 0.004, g(2, 0) = 0.003;
    return g;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("cells leave where their largest principal strain or stress reaches the limit, and not before",
                       "[solid][erosion]", ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    const auto shape = GENERATE_COPY(Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron,
                                     Dim == 2 ? CellShape::triangle : CellShape::tetrahedron);
    CAPTURE(static_cast<int>(kinematics), static_cast<int>(shape));
    Matrix<Dim> g = tested_gradient<Dim>();
    if (kinematics == Kinematics::floating) g = 0.5 * (g + g.transpose());  // without a turn of its frame
    const Matrix<Dim> f = Matrix<Dim>::Identity() + g, green = 0.5 * (f.transpose() * f - Matrix<Dim>::Identity()),
                      linear = 0.5 * (g + g.transpose());
    const bool is_finite = kinematics == Kinematics::finite;
    const double lambda = 0.8, mu = 0.8;  // of E = 2 and nu = 1/4
    const Matrix<Dim>& measure = is_finite ? green : linear;
    Matrix<Dim> stress = lambda * measure.trace() * Matrix<Dim>::Identity() + 2.0 * mu * measure;
    if (is_finite) stress = f * stress * f.transpose() / f.determinant();
    const double largest = symmetric_eigenvalues(measure)[Dim - 1];
    const double strain = is_finite ? std::sqrt(1.0 + 2.0 * largest) - 1.0 : largest;
    const double tension = std::max(symmetric_eigenvalues(stress)[Dim - 1], Dim == 2 ? 0.25 * stress.trace() : 0.0);
    constexpr double near = 1e-9;
    const auto inside = [&](const ErosionLimits& limits) { return reasons_inside<Dim>(g, kinematics, shape, limits); };
    const std::size_t all = inside({.strain = 1e-6}).size();
    REQUIRE(all >= 4);
    CHECK(inside({.strain = (1.0 - near) * strain}) == std::vector(all, LeavingReason::strain));
    CHECK(inside({.strain = (1.0 + near) * strain}).empty());
    CHECK(inside({.stress = (1.0 - near) * tension}) == std::vector(all, LeavingReason::stress));
    CHECK(inside({.stress = (1.0 + near) * tension}).empty());
    CHECK(inside({.plastic_strain = 1e-9}).empty());
}

TEST_CASE("cells leave by the plastic strain that they show", "[solid][erosion]") {
    SolidOptions<2> options = of_metal<2>(Kinematics::finite);
    options.erosion.assign(2, {.plastic_strain = 1e-3});
    const mesh::Mesh<2> mesh = stacked<2>();
    Solid<2> solid(mesh, options);
    dynamics::Memm memm(solid, std::vector<double>(solid.size(), 0.0), momentum_of(solid, thrown<2>()),
                        0.7 * dynamics::stable_step(solid).dt);
    std::size_t most = 0;
    for (int step = 0; step < 150; ++step) {
        memm.step();
        std::vector<std::int32_t> expected, found;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            if (solid.cells().plastic_strain(c) >= 1e-3) expected.push_back(c);
        for (const solid::LeavingCell& one : solid::cells_beyond_limits(solid)) {
            CHECK(one.reason == LeavingReason::plastic_strain);
            found.push_back(one.cell);
        }
        CHECK(found == expected);
        most = std::max(most, found.size());
    }
    CHECK(most > 0);
}

TEMPLATE_TEST_CASE_SIG("across a gap that cells have left nothing is reconstructed, and halves keep their momentum",
                       "[solid][erosion]", ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::finite);
    const auto shape = GENERATE_COPY(Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron,
                                     Dim == 2 ? CellShape::triangle : CellShape::tetrahedron);
    CAPTURE(static_cast<int>(kinematics), static_cast<int>(shape));
    constexpr int n = Dim == 2 ? 21 : 11;
    std::array<int, Dim> counts;
    counts.fill(3);
    counts[0] = n;
    const mesh::Mesh<Dim> mesh = box_of<Dim>(counts, shape);
    const auto is_left = [](const Vector<Dim>& x) { return x[0] < 0.5 * n; };
    ChangingRun<Dim> run(mesh, plain_elastic<Dim>(kinematics),
                         {moving<Dim>(0.01 * Vector<Dim>::Unit(0), AxialVector<Dim>::Constant(0.002))});
    run.run(20);
    std::vector<std::int32_t> gap;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (std::abs(mesh.cell_centroid[static_cast<std::size_t>(c)][0] - 0.5 * n) < 0.5) gap.push_back(c);
    run.change(mesh_without(mesh, gap));
    const auto& centroid = run.mesh().cell_centroid;
    int crossing = 0;
    for (const auto& stencil : run.solid().ccg().stencils()) {
        int n_left = 0, n_used = 0;
        for (int j = 0; j <= Dim; ++j)
            if (stencil.weights[static_cast<std::size_t>(j)] != 0.0) {
                ++n_used;
                n_left += is_left(centroid[static_cast<std::size_t>(stencil.cells[static_cast<std::size_t>(j)])]) ? 1 : 0;
            }
        crossing += n_left != 0 && n_left != n_used ? 1 : 0;
    }
    CHECK(crossing == 0);
    const auto momentum = [&] {
        Vector<Dim> sum = Vector<Dim>::Zero();
        const auto velocity = run.solid().cells().velocity(run.memm().p_after());
        for (std::size_t c = 0; c < centroid.size(); ++c)
            if (is_left(centroid[c])) sum += run.mesh().cell_measure[c] * velocity[c];
        return sum;
    };
    const Vector<Dim> before = momentum();
    run.run(200);
    // The closure of a finite body, by which its energy is exact, is one for all of its pieces.
    CHECK((momentum() - before).norm() <= (kinematics == Kinematics::finite ? 1e-4 : 1e-14) * before.norm());
}

TEST_CASE("what is too thin to be reconstructed is a remnant: cells that are alone, and rows of bricks",
          "[solid][erosion]") {
    const auto remnants = [](CellShape shape, const auto& leaves) {
        const mesh::Mesh<2> mesh = box_of<2>({8, 6}, shape);
        const Solid<2> solid(mesh, plain_elastic<2>(Kinematics::small));
        std::vector<std::int32_t> leaving;
        std::vector<double> places;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            if (leaves(mesh.cell_centroid[static_cast<std::size_t>(c)])) leaving.push_back(c);
        for (const std::int32_t c : solid::remnants<2>(solid, leaving))
            places.push_back(mesh.cell_centroid[static_cast<std::size_t>(c)].x());
        return places;
    };
    const auto at = [](double x) { return [x](const Vector<2>& place) { return std::abs(place.x() - x) < 0.5; }; };
    CHECK(remnants(CellShape::quadrangle, at(4.5)).empty());
    CHECK(remnants(CellShape::quadrangle, at(1.5)) == std::vector(6, 0.5));
    CHECK(remnants(CellShape::triangle, at(1.5)).empty());  // a row of triangles bends
    // Around one cell at a corner.
    const auto around = [](const Vector<2>& x) { return x.norm() > 1.0 && x.x() < 2.0 && x.y() < 2.0; };
    CHECK(remnants(CellShape::quadrangle, around) == std::vector{0.5});
}

TEST_CASE("limits of erosion are refused by name where they are none, and of bodies that do not deform",
          "[solid][erosion][errors]") {
    const auto said = [](const SolidOptions<2>& options) {
        const mesh::Mesh<2> mesh = box_of<2>({3, 3}, CellShape::quadrangle);
        try {
            const Solid<2> solid(mesh, options);
        } catch (const BadInput& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    SolidOptions<2> options = plain_elastic<2>(Kinematics::small);
    options.erosion = {{.strain = 0.1}};
    CHECK(said(options).empty());
    options.erosion = {{.strain = 0.1}, {}};
    CHECK_THAT(said(options), Catch::Contains("are given for 2 bodies of 1"));
    options.erosion = {{.stress = -1.0}};
    CHECK_THAT(said(options), Catch::Contains("of body 'block': stress is -1 Pa; above 0 Pa is needed"));
    options.erosion = {{.strain = 0.1}};
    options.kinematics = {Kinematics::rigid};
    CHECK_THAT(said(options), Catch::Contains("is rigid and has limits of erosion"));
}

}  // namespace abut::test
