// Bonds under the modified reconstruction, and of bodies that yield.
#include <catch2/catch.hpp>
#include <cmath>

#include "abut/geometry/box.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/statics.hpp"
#include "solid/turning_scenes.hpp"

namespace abut::test {
namespace {

using solid::Kinematics;
using solid::Material;
using solid::Solid;
using solid::SolidOptions;

template <int Dim>
mesh::Mesh<Dim> box_between(double from, double to, int n_along, int n_across, CellShape shape, const char* name) {
    Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Ones();
    lower[0] = from, upper[0] = to;
    std::array<int, Dim> counts;
    counts.fill(n_across);
    counts[0] = n_along;
    return mesh::structured_box<Dim>(lower, upper, counts, shape, name);
}

/// Two boxes that share the plane x = 0, whose meshes do not match.
template <int Dim>
mesh::Mesh<Dim> glued_boxes(CellShape shape) {
    return together(box_between<Dim>(-1.0, 0.0, 3, 3, shape, "left"), box_between<Dim>(0.0, 0.8, 4, 5, shape, "right"));
}

template <int Dim>
std::vector<CellShape> shapes_of_cells() {
    return Dim == 2 ? std::vector{CellShape::quadrangle, CellShape::triangle}
                    : std::vector{CellShape::hexahedron, CellShape::tetrahedron};
}

/// For ever, under the modified reconstruction.
template <int Dim>
SolidOptions<Dim> glued_by_faces(const Material& left, const Material& right) {
    SolidOptions<Dim> options;
    options.materials = {left, right};
    options.bonds = {{.sides = {0, 1}}};
    options.contact.emplace();
    options.law = solid::ContactLaw::reconstruction;
    return options;
}

const Material soft{.young = 1.0, .poisson = 0.3, .density = 1.0}, stiff{2.0, 0.2, 1.0};

/// A floor that presses on all bottom cells, those beside the bond as well.
template <int Dim>
contact::RigidObstacle<Dim> floor_at(double height) {
    return contact::plane_obstacle<Dim>(height * Vector<Dim>::Unit(1), Vector<Dim>::Unit(1), 5.0);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("bonded blocks pass the patch test under the modified reconstruction, to 1e-10",
                       "[solid][bonds][reconstruction]", ((int Dim), Dim), 2, 3) {
    for (const CellShape shape : shapes_of_cells<Dim>()) {
        CAPTURE(Dim, static_cast<int>(shape));
        auto mesh = glued_boxes<Dim>(shape);
        geometry::Box<Dim> box;
        for (const Vector<Dim>& vertex : mesh.vertices) box.extend(vertex);
        mesh::BoundaryGroup outside{"outside", {}};
        for (const std::int32_t f : mesh.boundary_faces)
            for (int axis = 0; axis < Dim; ++axis)
                if (const double x = mesh.face_centroid[f][axis]; x < box.lower[axis] + 1e-9 || x > box.upper[axis] - 1e-9) {
                    outside.faces.push_back(f);
                    break;
                }
        mesh.groups.push_back(outside);
        const auto field = [](const Vector<Dim>& x) -> Vector<Dim> {
            Vector<Dim> u = Vector<Dim>::Zero();
            u[0] = 1e-5 * (0.3 * x[0] + x[1]);
            u[1] = 1e-5 * (0.5 * x[0] - 0.2 * x[1]);
            return u;
        };
        auto options = glued_by_faces<Dim>(soft, soft);
        options.boundary.dirichlet = {
            {.group = "outside", .history = [field](double, const Vector<Dim>& x) { return field(x); }}};
        Solid<Dim> solid(mesh, options);
        const auto solution = solid::solve_statics(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-12});
        CHECK(solution.report.converged);
        const auto exact = sampled(mesh, field);
        double worst = 0.0;
        for (std::size_t i = 0; i < exact.size(); ++i) raise(worst, std::abs(solution.q[i] - exact[i]));
        CHECK(worst < 1e-10 * largest(exact));
    }
}

TEMPLATE_TEST_CASE_SIG("bonds and contact under the modified reconstruction have one V: forces are its slope",
                       "[solid][bonds][reconstruction]", ((int Dim), Dim), 2, 3) {
    for (const CellShape shape : shapes_of_cells<Dim>()) {
        CAPTURE(Dim, static_cast<int>(shape));
        const auto mesh = glued_boxes<Dim>(shape);
        auto options = glued_by_faces<Dim>(soft, stiff);
        options.obstacles = {floor_at<Dim>(0.01)};
        Solid<Dim> solid(mesh, options);
        const std::vector<double> q = random_state(solid.size(), 1, 1e-3);
        std::vector<double> force(solid.size());
        solid.force(q, force);
        CHECK(!solid.contact_at(q).acting_pairs().empty());
        const std::vector<double> direction = random_state(solid.size(), 2, 1.0);
        std::vector<double> forward = q, backward = q;
        double slope = 0.0, size = 0.0;
        const double step = 1e-6;
        for (std::size_t i = 0; i < q.size(); ++i) {
            forward[i] += step * direction[i];
            backward[i] -= step * direction[i];
            slope -= force[i] * direction[i];
            size += std::abs(force[i] * direction[i]);
        }
        const double measured = (solid.potential(forward) - solid.potential(backward)) / (2.0 * step);
        CHECK(std::abs(measured - slope) <= 1e-7 * size);
    }
}

TEMPLATE_TEST_CASE_SIG("bonded blocks that bounce on a floor keep H~ under the modified reconstruction",
                       "[solid][bonds][reconstruction]", ((int Dim), Dim), 2, 3) {
    for (const CellShape shape : shapes_of_cells<Dim>()) {
        CAPTURE(Dim, static_cast<int>(shape));
        auto options = glued_by_faces<Dim>(soft, stiff);
        options.obstacles = {floor_at<Dim>(-0.005)};
        options.kinematics.assign(2, Kinematics::small);
        TurningScene<Dim> scene(glued_boxes<Dim>(shape), options,
                                std::vector<Motion<Dim>>(2, moving<Dim>(-0.02 * Vector<Dim>::Unit(1))), 0.6,
                                options.kinematics);
        scene.run(Dim == 2 ? 300 : 150);
        CHECK(scene.solid.contact().report().active_pairs_max > 0);
        CHECK(scene.solid.contact().report().missed_contacts == 0);
        CHECK(scene.drifts().pseudo_energy <= 1e-13);
    }
}

TEST_CASE("what bonds under the modified reconstruction cannot do is refused", "[solid][bonds][reconstruction]") {
    const auto mesh = glued_boxes<2>(CellShape::triangle);
    auto options = glued_by_faces<2>(soft, soft);
    options.bonds.front().strength = 1.0;
    CHECK_THROWS_WITH(Solid<2>(mesh, options), Catch::Contains("bonds are for ever"));
}

namespace {

/// Of steel in units of its yield strain: E = rho = 1.
const Material yielding{.young = 1.0,
                        .poisson = 0.3,
                        .density = 1.0,
                        .law = solid::MaterialLaw::j2,
                        .flow = {.yield_stress = 2e-3, .hardening = 0.05}};

/// How two halves of a bar that are flung apart, stretching it beyond yield, end.
struct Stretched {
    Drifts drifts;
    double in_cells = 0.0, in_bonds = 0.0, least = 0.0, in_play = 0.0;
};

template <int Dim>
Stretched flung_apart(const mesh::Mesh<Dim>& mesh, Kinematics kinematics, int n_bodies, const solid::Bond& bond = {}) {
    SolidOptions<Dim> options;
    options.materials.assign(static_cast<std::size_t>(n_bodies), yielding);
    if (n_bodies == 2) options.bonds = {bond};
    if (n_bodies == 2) options.bonds.front().sides = {0, 1};
    options.contact.emplace();
    TurningScene<Dim> scene(mesh, options, std::vector<Motion<Dim>>(static_cast<std::size_t>(n_bodies)), 0.6,
                            std::vector(static_cast<std::size_t>(n_bodies), kinematics));
    // Each cell by where it is: the whole is stretched at one rate.
    std::vector<double> p(scene.solid.size(), 0.0);
    const auto points = scene.solid.rest_positions();
    for (std::size_t i = 0; i < points.size(); ++i) p[Dim * i] = scene.solid.masses()[i] * 0.02 * points[i][0];
    dynamics::Memm<Solid<Dim>> memm(scene.solid, std::vector<double>(scene.solid.size(), 0.0), p, scene.memm.dt());
    dynamics::Ledger<Dim> ledger;
    ledger.record(dynamics::measure(memm, scene.solid));
    Stretched result;
    double before = 0.0, momenta = 0.0;
    for (const double value : p) momenta += std::abs(value);
    while (memm.time() < 4.0) {
        memm.step();
        ledger.record(dynamics::measure(memm, scene.solid));
        const double now = scene.solid.dissipated().in_cells;
        result.least = std::min(result.least, now - before);
        before = now;
    }
    result.in_cells = before;
    result.in_bonds = scene.solid.dissipated().in_bonds;
    result.in_play = ledger.largest_energy();
    result.drifts.pseudo_energy = ledger.pseudo_energy_drift() / result.in_play;
    result.drifts.momentum = ledger.momentum_drift() / momenta;
    return result;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("bonded blocks of metal that yield keep H~ + D, and dissipate what one piece does, within 10 %",
                       "[solid][bonds][plasticity]", ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(Kinematics::floating, Kinematics::finite);
    CAPTURE(Dim, static_cast<int>(kinematics));
    const CellShape shape = Dim == 2 ? CellShape::triangle : CellShape::tetrahedron;
    const int n = Dim == 2 ? 6 : 3;
    const auto two = flung_apart<Dim>(
        together(box_between<Dim>(-1.0, 0.0, n, n, shape, "left"), box_between<Dim>(0.0, 1.0, n + 1, n + 1, shape, "right")),
        kinematics, 2);
    const auto one = flung_apart<Dim>(box_between<Dim>(-1.0, 1.0, 2 * n, n, shape, "whole"), kinematics, 1);
    CHECK(two.in_cells > 0.1 * two.in_play);
    CHECK(two.least >= -1e-15 * two.in_play);
    CHECK(two.drifts.pseudo_energy <= 1e-12);
    CHECK(two.drifts.momentum <= 1e-13);
    CHECK(two.in_cells / two.in_play == Approx(one.in_cells / one.in_play).epsilon(0.1));
}

TEMPLATE_TEST_CASE_SIG("bonds of metal that yields open and break as it flows, and H~ + D closes",
                       "[solid][bonds][plasticity]", ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(Kinematics::floating, Kinematics::finite);
    const double fracture_energy = GENERATE(0.0, 1e-5);
    CAPTURE(Dim, static_cast<int>(kinematics), fracture_energy);
    const CellShape shape = Dim == 2 ? CellShape::triangle : CellShape::tetrahedron;
    const int n = Dim == 2 ? 6 : 3;
    const auto two = flung_apart<Dim>(
        together(box_between<Dim>(-1.0, 0.0, n, n, shape, "left"), box_between<Dim>(0.0, 1.0, n + 1, n + 1, shape, "right")),
        kinematics, 2, {.sides = {}, .strength = 1.1 * yielding.flow.yield_stress, .fracture_energy = fracture_energy});
    CHECK(two.in_cells > 0.01 * two.in_play);
    CHECK(two.in_bonds > 0.0);
    CHECK(two.drifts.pseudo_energy <= 1e-12);
    CHECK(two.drifts.momentum <= 1e-13);
}

}  // namespace abut::test
