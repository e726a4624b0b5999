// Bodies that are bonded, whose meshes do not match.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "abut/geometry/box.hpp"
#include "abut/solid/bond/bond_law.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/contact_view.hpp"
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

/// Two boxes side by side along x that share the plane x = 0, with groups per body: "left xmin" and the like.
template <int Dim>
mesh::Mesh<Dim> side_by_side(int n_left, int n_right, CellShape shape, const Vector<Dim>& lower, const Vector<Dim>& upper) {
    const auto counts_of = [&](int n, double length) {
        std::array<int, Dim> counts;
        counts.fill(n);
        counts[0] = std::max(1, static_cast<int>(std::lround(n * length / (upper[1] - lower[1]))));
        return counts;
    };
    Vector<Dim> left_end = upper, right_begin = lower;
    left_end[0] = right_begin[0] = 0.0;
    return together(mesh::structured_box<Dim>(lower, left_end, counts_of(n_left, -lower[0]), shape, "left"),
                    mesh::structured_box<Dim>(right_begin, upper, counts_of(n_right, upper[0]), shape, "right"));
}

template <int Dim>
std::vector<NamedMesh<Dim>> blocks() {
    Vector<Dim> lower = Vector<Dim>::Constant(-0.5), upper = Vector<Dim>::Constant(0.5);
    lower[0] = -1.0;
    upper[0] = 0.7;
    std::vector<NamedMesh<Dim>> meshes;
    for (const CellShape shape : Dim == 2 ? std::vector{CellShape::quadrangle, CellShape::triangle}
                                          : std::vector{CellShape::hexahedron, CellShape::tetrahedron})
        meshes.push_back({"shape " + std::to_string(static_cast<int>(shape)), side_by_side<Dim>(3, 5, shape, lower, upper)});
    return meshes;
}

/// For long runs: of triangles or tetrahedra.
template <int Dim>
mesh::Mesh<Dim> coarse_blocks() {
    Vector<Dim> lower = Vector<Dim>::Constant(-0.5), upper = Vector<Dim>::Constant(0.5);
    lower[0] = -1.0;
    upper[0] = 0.7;
    const CellShape shape = Dim == 2 ? CellShape::triangle : CellShape::tetrahedron;
    return side_by_side<Dim>(Dim == 2 ? 3 : 2, Dim == 2 ? 5 : 3, shape, lower, upper);
}

/// With groups xmin, xmax, ... of the outer sides of all bodies together.
template <int Dim>
mesh::Mesh<Dim> with_sides(mesh::Mesh<Dim> mesh) {
    geometry::Box<Dim> box;
    for (const Vector<Dim>& vertex : mesh.vertices) box.extend(vertex);
    const std::vector<std::string> sides = box_sides(Dim);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const auto axis = static_cast<std::ptrdiff_t>(i / 2);
        const double end = i % 2 == 0 ? box.lower[axis] : box.upper[axis];
        mesh::BoundaryGroup group{sides[i], {}};
        for (const std::int32_t f : mesh.boundary_faces)
            if (std::abs(mesh.face_centroid[f][axis] - end) < 1e-9) group.faces.push_back(f);
        mesh.groups.push_back(group);
    }
    return mesh;
}

template <int Dim>
solid::DirichletCondition<Dim> support(const std::string& group, Constraint constraint = Constraint::full) {
    solid::DirichletCondition<Dim> support;
    support.group = group;
    support.constraint = constraint;
    return support;
}

template <int Dim>
SolidOptions<Dim> bonded(const Material& left, const Material& right) {
    SolidOptions<Dim> options;
    options.materials = {left, right};
    options.bonds = {{.sides = {0, 1}}};
    return options;
}

double worst_of(const std::vector<double>& values, const std::vector<double>& expected) {
    double worst = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) raise(worst, std::abs(values[i] - expected[i]));
    return worst;
}

const Material steel{.young = 210e9, .poisson = 0.3, .density = 7800.0};

}  // namespace

TEMPLATE_TEST_CASE_SIG("bonded blocks whose meshes do not match pass the patch test in tension and shear, to 1e-10",
                       "[solid][bonds]", ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : blocks<Dim>()) {
        CAPTURE(Dim, name);
        for (const bool shear : {false, true}) {
            CAPTURE(shear);
            SolidOptions<Dim> options = bonded<Dim>(steel, steel);
            const double strain = 1e-5;
            const auto field = [&](const Vector<Dim>& x) -> Vector<Dim> {
                Vector<Dim> u = Vector<Dim>::Zero();
                u[0] = strain * (shear ? 0.3 * x[0] + x[1] : x[0]);
                u[1] = strain * (shear ? 0.5 * x[0] : -0.2 * x[1]);
                return u;
            };
            for (const std::string& side : box_sides(Dim)) {
                solid::DirichletCondition<Dim> held;
                held.group = side;
                held.history = [field](double, const Vector<Dim>& x) { return field(x); };
                options.boundary.dirichlet.push_back(held);
            }
            const mesh::Mesh<Dim> open = with_sides(mesh);
            Solid<Dim> solid(open, options);
            const auto solution = solid::solve_statics(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-12});
            CHECK(solution.report.converged);
            const auto exact = sampled(mesh, field);
            CHECK(worst_of(solution.q, exact) < 1e-10 * largest(exact));
        }
    }
}

TEMPLATE_TEST_CASE_SIG("a bar of two bonded pieces of different stiffness is stretched as both in series, to 1e-10",
                       "[solid][bonds]", ((int Dim), Dim), 2, 3) {
    const double ratio = GENERATE(1.0, 4.0);
    // Of no lateral strain, so that both pieces take the same field across.
    const Material left{.young = 210e9, .poisson = 0.0, .density = 7800.0}, right{ratio * 210e9, 0.0, 7800.0};
    const double t = 1e6;
    for (const auto& [name, mesh] : blocks<Dim>()) {
        CAPTURE(Dim, name, ratio);
        SolidOptions<Dim> options = bonded<Dim>(left, right);
        const mesh::Mesh<Dim> open = with_sides(mesh);
        for (const char* side : {"xmin", "ymin", "zmin"})
            if (Dim == 3 || side != std::string("zmin"))
                options.boundary.dirichlet.push_back(support<Dim>(side, Constraint::normal));
        solid::TractionCondition<Dim> pull;
        pull.group = "xmax";
        pull.value = t * Vector<Dim>::UnitX();
        options.boundary.traction = {pull};
        Solid<Dim> solid(open, options);
        const auto solution = solid::solve_statics(solid, std::vector<double>(solid.size(), 0.0), {.tolerance = 1e-12});
        CHECK(solution.report.converged);
        const auto exact = sampled(mesh, [&](const Vector<Dim>& x) -> Vector<Dim> {
            const double along = t / left.young * (x[0] < 0.0 ? x[0] + 1.0 : 1.0 + x[0] / ratio);
            return along * Vector<Dim>::UnitX();
        });
        CHECK(worst_of(solution.q, exact) < 1e-10 * largest(exact));
    }
}

namespace {

/// A strip on rollers with a bond across it: a pulse of displacement, 1/2 (1 + cos(pi s)) of length 1, runs to it from the left.
/// What the start sends to the other side, since waves of this length are slower by 0.2 % on this mesh, stays away.
struct Pulse {
    double reflected;  // largest displacement that runs back, that of the pulse being 1
    double transmitted;
};

Pulse pulse_across_bond(double ratio, int rows_left, int rows_right) {
    const double width = 0.5, start = -0.7, height = 0.06, h_left = height / rows_left, h_right = height / rows_right;
    const auto mesh = with_sides(together(
        mesh::structured_box<2>({-3.0, 0.0}, {0.0, height}, {static_cast<int>(std::lround(3.0 / h_left)), rows_left},
                                CellShape::quadrangle, "left"),
        mesh::structured_box<2>({0.0, 0.0}, {3.0, height}, {static_cast<int>(std::lround(3.0 / h_right)), rows_right},
                                CellShape::quadrangle, "right")));
    auto options = bonded<2>({.young = 1.0, .poisson = 0.0, .density = 1.0}, {ratio, 0.0, 1.0});
    for (const char* side : {"ymin", "ymax"}) options.boundary.dirichlet.push_back(support<2>(side, Constraint::normal));
    Solid<2> solid(mesh, options);
    const auto shape = [&](double x) {
        const double s = (x - start) / width;
        return std::abs(s) < 1.0 ? 0.5 * (1.0 + std::cos(std::numbers::pi * s)) : 0.0;
    };
    std::vector<double> q(solid.size(), 0.0), p(solid.size(), 0.0);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const double x = mesh.cell_centroid[c][0], s = (x - start) / width;
        q[2 * c] = shape(x);
        p[2 * c] =
            std::abs(s) < 1.0 ? solid.masses()[c] * 0.5 * std::numbers::pi / width * std::sin(std::numbers::pi * s) : 0.0;
    }
    dynamics::Memm memm(solid, q, p, 0.5 * dynamics::stable_step(solid).dt);
    while (memm.time() < 1.4) memm.step();  // what runs back is at x = -0.7 then
    Pulse pulse{0.0, 0.0};
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        if (mesh.cell_centroid[c][0] < -1.3) continue;
        double& largest = mesh.cell_body[c] == 0 ? pulse.reflected : pulse.transmitted;
        if (std::abs(memm.q()[2 * c]) > std::abs(largest)) largest = memm.q()[2 * c];
    }
    return pulse;
}

/// The lowest frequency of K x = omega^2 M x behind those of rigid motions.
template <int Dim>
double lowest_frequency(Solid<Dim>& solid, int n_rigid = 0) {
    const auto n = static_cast<Eigen::Index>(solid.size());
    const Eigen::VectorXd root = Eigen::Map<const Eigen::VectorXd>(solid.inverse_mass().data(), n).cwiseSqrt();
    const Eigen::MatrixXd k = root.asDiagonal() * dense_stiffness(solid) * root.asDiagonal();
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues()[n_rigid]);
}

SolidOptions<2> clamped(int n_bodies) {
    SolidOptions<2> options;
    options.materials.assign(static_cast<std::size_t>(n_bodies), {.young = 1.0, .poisson = 0.3, .density = 1.0});
    options.boundary.dirichlet = {support<2>("xmin")};
    return options;
}

}  // namespace

TEST_CASE("a wave crosses a bond of equal materials with less than 0.5 % of reflection, of stiffness 1:4 with -1/3",
          "[solid][bonds]") {
    const Pulse equal = pulse_across_bond(1.0, 3, 4);
    CHECK(std::abs(equal.reflected) <= 0.005);
    CHECK(equal.transmitted == Approx(1.0).epsilon(0.01));
    const Pulse stiffer = pulse_across_bond(4.0, 3, 2);
    CHECK(stiffer.reflected == Approx(-1.0 / 3.0).epsilon(0.01));
    CHECK(stiffer.transmitted == Approx(2.0 / 3.0).epsilon(0.01));
}

TEST_CASE("a cantilever of two bonded pieces bends with the frequency of one piece, within 1 %", "[solid][bonds]") {
    const auto piece = [](double x_0, double x_1, double y_0, double y_1, int n, const char* name) {
        return mesh::structured_box<2>(
            {x_0, y_0}, {x_1, y_1},
            {static_cast<int>(std::lround(n * (x_1 - x_0))), std::max(1, static_cast<int>(std::lround(n * (y_1 - y_0))))},
            CellShape::quadrangle, name);
    };
    const auto whole = piece(-3.0, 3.0, 0.0, 1.0, 6, "whole");
    Solid<2> one(whole, clamped(1));
    const double expected = lowest_frequency(one);
    SECTION("behind each other") {
        const auto mesh = with_sides(together(piece(-3.0, 0.0, 0.0, 1.0, 6, "left"), piece(0.0, 3.0, 0.0, 1.0, 7, "right")));
        auto options = clamped(2);
        options.bonds = {{.sides = {0, 1}}};
        Solid<2> two(mesh, options);
        CHECK(lowest_frequency(two) == Approx(expected).epsilon(0.01));
    }
    SECTION("on each other") {
        const auto mesh =
            with_sides(together(piece(-3.0, 3.0, 0.0, 0.5, 6, "lower"), piece(-3.0, 3.0, 0.5, 1.0, 8, "upper")));
        auto options = clamped(2);
        options.bonds = {{.sides = {0, 1}}};
        Solid<2> two(mesh, options);
        CHECK(lowest_frequency(two) == Approx(expected).epsilon(0.01));
    }
}

TEST_CASE("a free beam of two bonded pieces that may turn bends with the frequency of one piece, within 3 %",
          "[solid][bonds]") {
    const auto kinematics = GENERATE(Kinematics::floating, Kinematics::finite);
    const auto piece = [](double y_0, double y_1, double x_0, double x_1, int n, const char* name) {
        return mesh::structured_box<2>(
            {x_0, y_0}, {x_1, y_1},
            {static_cast<int>(std::lround(n * (x_1 - x_0))), static_cast<int>(std::lround(n * (y_1 - y_0)))},
            CellShape::triangle, name);
    };
    const auto frequency = [&](const mesh::Mesh<2>& mesh, std::vector<solid::Bond> bonds) {
        SolidOptions<2> options;
        options.materials.assign(static_cast<std::size_t>(mesh.n_bodies()), {.young = 1.0, .poisson = 0.3, .density = 1.0});
        options.kinematics.assign(options.materials.size(), kinematics);
        options.bonds = std::move(bonds);
        Solid<2> solid(mesh, options);
        return lowest_frequency(solid, 3);
    };
    const double expected = frequency(piece(0.0, 1.0, -2.0, 2.0, 6, "whole"), {});
    CHECK(frequency(together(piece(0.0, 1.0, -2.0, 0.0, 6, "left"), piece(0.0, 1.0, 0.0, 2.0, 7, "right")),
                    {{.sides = {0, 1}}}) == Approx(expected).epsilon(0.03));
    CHECK(frequency(together(piece(0.0, 0.5, -2.0, 2.0, 6, "lower"), piece(0.5, 1.0, -2.0, 2.0, 8, "upper")),
                    {{.sides = {0, 1}}}) == Approx(expected).epsilon(0.03));
}

TEMPLATE_TEST_CASE_SIG("forces of bonded bodies are the slope of V, and K is symmetric", "[solid][bonds]", ((int Dim), Dim),
                       2, 3) {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    const bool stands = GENERATE(false, true);  // on a floor, which presses on cells that are bonded as well
    const auto mesh = coarse_blocks<Dim>();
    auto options = bonded<Dim>({.young = 1.0, .poisson = 0.3, .density = 1.0}, {2.0, 0.2, 1.0});
    options.kinematics.assign(2, kinematics);
    options.contact.emplace();
    const double depth = 0.01;
    if (stands)
        options.obstacles = {contact::plane_obstacle<Dim>((depth - 0.5) * Vector<Dim>::Unit(1), Vector<Dim>::Unit(1), 3.0)};
    Solid<Dim> solid(mesh, options);
    const std::vector<double> q = random_state(solid.size(), 1, 1e-3);
    std::vector<double> force(solid.size());
    solid.force(q, force);
    for (unsigned seed = 2; seed < 5; ++seed) {
        const std::vector<double> direction = random_state(solid.size(), seed, 1.0);
        const bool is_quadratic = kinematics == Kinematics::small && !stands;
        const double step = is_quadratic ? 1e-3 : 1e-6;
        std::vector<double> forward = q, backward = q;
        double slope = 0.0, size = 0.0;
        for (std::size_t i = 0; i < q.size(); ++i) {
            forward[i] += step * direction[i];
            backward[i] -= step * direction[i];
            slope -= force[i] * direction[i];
            size += std::abs(force[i] * direction[i]);
        }
        const double measured = (solid.potential(forward) - solid.potential(backward)) / (2.0 * step);
        CAPTURE(Dim, static_cast<int>(kinematics), stands, seed);
        CHECK(std::abs(measured - slope) <= (is_quadratic ? 1e-10 : 1e-6) * size);
    }
    if (stands) {
        CHECK(!solid.contact_at(q).acting_pairs().empty());
        return;
    }
    const Eigen::MatrixXd k = dense_stiffness(solid);
    CHECK((k - k.transpose()).cwiseAbs().maxCoeff() <=
          (kinematics == Kinematics::finite ? 1e-6 : 1e-12) * k.cwiseAbs().maxCoeff());
}

TEMPLATE_TEST_CASE_SIG("bonded blocks keep H~ and momentum, and turn with J~ and H~ to rounding", "[solid][bonds]",
                       ((int Dim), Dim), 2, 3) {
    const auto kinematics =
        GENERATE(std::vector{Kinematics::small, Kinematics::small}, std::vector{Kinematics::floating, Kinematics::floating},
                 std::vector{Kinematics::finite, Kinematics::finite}, std::vector{Kinematics::floating, Kinematics::finite});
    const bool turns = kinematics[0] != Kinematics::small;
    const double spin = turns ? 0.05 : 0.0, turned = Dim == 2 ? 5.0 : 0.5;
    auto options = bonded<Dim>({.young = 1.0, .poisson = 0.3, .density = 1.0}, {2.0, 0.2, 1.0});
    options.contact.emplace();
    TurningScene<Dim> scene(coarse_blocks<Dim>(), options,
                            std::vector<Motion<Dim>>(2, {.velocity = 0.01 * Vector<Dim>::Unit(1)}), 0.6, kinematics, 1e-4);
    // All points about the common centre of mass.
    std::vector<double> p(scene.solid.size());
    double mass = 0.0;
    Vector<Dim> centre = Vector<Dim>::Zero();
    const auto points = scene.solid.rest_positions();
    for (std::size_t i = 0; i < points.size(); ++i) {
        mass += scene.solid.masses()[i];
        centre += scene.solid.masses()[i] * points[i];
    }
    centre /= mass;
    for (std::size_t i = 0; i < points.size(); ++i)
        vectors<Dim>(p)[i] =
            scene.solid.masses()[i] *
            (0.01 * Vector<Dim>::Unit(1) + dynamics::turning_velocity<Dim>(some_spin<Dim>(spin), points[i] - centre));
    dynamics::Memm<Solid<Dim>> memm(scene.solid, std::vector<double>(scene.solid.size(), 0.0), p, scene.memm.dt());
    dynamics::Ledger<Dim> ledger;
    const auto moment_of = [&] {
        return dynamics::pseudo_angular_momentum<Dim>(dynamics::RunView<Dim>{memm}, memm.dt(), points, scene.solid.masses());
    };
    const AxialVector<Dim> moment_start = moment_of();
    double moment_drift = 0.0, moments = 0.0, momenta = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        moments += moment<Dim>(points[i], vectors<Dim>(p)[i]).norm();
        momenta += vectors<Dim>(p)[i].norm();
    }
    const double end = turns ? turned * 2.0 * std::numbers::pi / some_spin<Dim>(spin).norm() : 10.0;
    ledger.record(dynamics::measure(memm, scene.solid));
    for (int i = 0; memm.time() < end; ++i) {
        memm.step();
        if (i % 20 != 0) continue;
        ledger.record(dynamics::measure(memm, scene.solid));
        raise(moment_drift, (moment_of() - moment_start).norm());
    }
    CAPTURE(Dim, static_cast<int>(kinematics[0]), static_cast<int>(kinematics[1]), memm.steps());
    CHECK(ledger.pseudo_energy_drift() / ledger.largest_energy() <= 1e-13);
    CHECK(ledger.momentum_drift() / momenta <= 1e-13);
    CHECK(moment_drift / moments <= 1e-13);
    CHECK(scene.solid.contact().report().active_pairs_max == 0);
}

namespace {

/// Two blocks that fly apart, bonded with this strength.
template <int Dim>
TurningScene<Dim> parting(double strength, const std::vector<Kinematics>& kinematics, double speed = 0.05) {
    auto options = bonded<Dim>({.young = 1.0, .poisson = 0.3, .density = 1.0}, {2.0, 0.2, 1.0});
    options.bonds.front().strength = strength;
    options.contact.emplace();
    return TurningScene<Dim>(
        coarse_blocks<Dim>(), options,
        {moving<Dim>(-speed * Vector<Dim>::Unit(0)), moving<Dim>(speed * Vector<Dim>::Unit(0), some_spin<Dim>(0.02))}, 0.6,
        kinematics);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a bond that breaks dissipates what V loses, and the balance closes to 1e-12", "[solid][bonds]",
                       ((int Dim), Dim), 2, 3) {
    const auto kinematics =
        GENERATE(std::vector{Kinematics::small, Kinematics::small}, std::vector{Kinematics::floating, Kinematics::floating},
                 std::vector{Kinematics::finite, Kinematics::floating});
    CAPTURE(Dim, static_cast<int>(kinematics[0]), static_cast<int>(kinematics[1]));
    auto scene = parting<Dim>(0.02, kinematics);
    double dissipated = 0.0, least = 0.0;
    for (int i = 0; i < 400; ++i) {
        scene.run(1, 1);
        const double now = scene.solid.dissipated().in_bonds;
        least = std::min(least, now - dissipated);
        dissipated = now;
    }
    CHECK(scene.solid.bonds().broken_share() == 1.0);
    CHECK(dissipated > 1e-4 * scene.ledger.largest_energy());
    CHECK(least >= -1e-15 * scene.ledger.largest_energy());
    const Drifts drifts = scene.drifts();
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.momentum <= 1e-13);
    if (kinematics[0] != Kinematics::small) CHECK(drifts.pseudo_moment <= 1e-13);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
}

TEST_CASE("a bond that is stronger than what pulls at it holds", "[solid][bonds]") {
    auto scene = parting<2>(1.0, {Kinematics::floating, Kinematics::floating});
    scene.run(400);
    CHECK(scene.solid.bonds().broken_share() == 0.0);
    CHECK(scene.solid.dissipated().in_bonds == 0.0);
}

TEMPLATE_TEST_CASE_SIG("a bond that opens takes its fracture energy per area, whatever the mesh, and no less in any step",
                       "[solid][bonds]", ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    const double energy = 3e-4;
    for (const auto& [name, mesh] : blocks<Dim>()) {
        if (kinematics == Kinematics::finite &&
            mesh.cell_shape[0] != (Dim == 2 ? CellShape::triangle : CellShape::tetrahedron))
            continue;
        CAPTURE(Dim, static_cast<int>(kinematics), name);
        auto options = bonded<Dim>({.young = 1.0, .poisson = 0.3, .density = 1.0}, {2.0, 0.2, 1.0});
        options.bonds.front().strength = 0.01;
        options.bonds.front().fracture_energy = energy;
        options.contact.emplace();
        TurningScene<Dim> scene(mesh, options,
                                {moving<Dim>(-0.04 * Vector<Dim>::Unit(0)), moving<Dim>(0.04 * Vector<Dim>::Unit(0))}, -0.01,
                                {kinematics, kinematics});
        double dissipated = 0.0, least = 0.0;
        bool any_open = false;
        for (int i = 0; i < 600 && scene.solid.bonds().broken_share() < 1.0; ++i) {
            scene.run(1, 1);
            any_open = any_open || (scene.solid.bonds().share(0) > 0.0 && scene.solid.bonds().share(0) < 1.0);
            const double now = scene.solid.dissipated().in_bonds;
            least = std::min(least, now - dissipated);
            dissipated = now;
        }
        CHECK(any_open);
        CHECK(scene.solid.bonds().broken_share() == 1.0);
        double area = 0.0;
        for (const auto& place : scene.solid.bonds().places()) area += place.area;
        CHECK(area == Approx(1.0).epsilon(1e-12));
        // At the rim of bricks of small bodies half cells hold more than G along the face, and give it at once.
        CHECK(dissipated == Approx(energy * area).epsilon(kinematics == Kinematics::small ? 0.05 : 0.01));
        CHECK(least >= -1e-15 * scene.ledger.largest_energy());
        const Drifts drifts = scene.drifts();
        CHECK(drifts.pseudo_energy <= 1e-12);
        CHECK(drifts.momentum <= 1e-13);
        if (kinematics != Kinematics::small) CHECK(drifts.pseudo_moment <= 1e-13);
    }
}

TEST_CASE("a bond bears its strength at most as it opens, and less and less", "[solid][bonds]") {
    // By hand: kappa = 4, sigma_c = 2, G = 3: w_f = 3; a trial traction of 6 is t + 4 w with t = 2 (1 - w/3): w = 1.2, t = 1.2.
    CHECK(solid::share_of_bond(2.0, 3.0, 1.9, 4.0) == 1.0);
    CHECK(6.0 * solid::share_of_bond(2.0, 3.0, 6.0, 4.0) == Approx(1.2).epsilon(1e-14));
    CHECK(solid::share_of_bond(2.0, 3.0, 12.0, 4.0) == 0.0);
    CHECK(solid::share_of_bond(2.0, 0.0, 2.1, 4.0) == 0.0);
}

TEST_CASE("the opening of a bond belongs to its share, and its mean share to what its law takes", "[solid][bonds]") {
    // As above: a share of 0.2 is an opening of 1.2 of 3.
    CHECK(solid::opening_of_bond(2.0, 3.0, 0.2, 4.0) == Approx(0.4).epsilon(1e-14));
    CHECK(solid::opening_of_bond(2.0, 3.0, 1.0, 4.0) == 0.0);
    CHECK(solid::opening_of_bond(2.0, 3.0, 0.0, 4.0) == 1.0);
    CHECK(solid::share_of_opening(2.0, 3.0, 0.4, 4.0) == Approx(0.2).epsilon(1e-14));
    CHECK(solid::share_of_opening(2.0, 3.0, 0.0, 4.0) == 1.0);
    CHECK(solid::share_of_opening(2.0, 3.0, 1.0, 4.0) == 0.0);
    // By hand: from 1 to m at 1 J/m^2 and from m to 0.2 at 4 J/m^2 it loses 0.2 + 3 m.
    CHECK(solid::middle_share(1.0, 0.2, 1.0, 4.0, 2.0) == Approx(0.6).epsilon(1e-14));
    CHECK(solid::middle_share(1.0, 0.2, 1.0, 4.0, 0.1) == 0.2);
    CHECK(solid::middle_share(1.0, 0.2, 1.0, 4.0, 10.0) == 1.0);
    CHECK(solid::middle_share(1.0, 0.2, 4.0, 1.0, 2.0) == 0.6);
}

TEST_CASE("bodies whose bond is broken touch each other", "[solid][bonds]") {
    const auto mesh = blocks<2>().front().mesh;
    auto options = bonded<2>({.young = 1.0, .poisson = 0.3, .density = 1.0}, {1.0, 0.3, 1.0});
    options.bonds.front().strength = 0.01;
    options.contact.emplace();
    options.acceleration = {{0.0, 0.0}, {-0.002, 0.0}};  // brings the right one back
    options.kinematics = {Kinematics::small, Kinematics::small};
    Scene<2> scene(mesh, options, {{-0.02, 0.0}, {0.02, 0.0}}, -0.6);
    scene.run_until(80.0);
    CHECK(scene.solid.bonds().broken_share() == 1.0);
    CHECK(scene.solid.contact().report().active_pairs_max > 0);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
    CHECK(scene.ledger.pseudo_energy_drift() <= 1e-12 * scene.ledger.largest_energy());
}

TEST_CASE("a saved state goes on with the bonds that were broken, bit by bit", "[solid][bonds]") {
    auto whole = parting<2>(0.02, {Kinematics::floating, Kinematics::floating});
    int steps = 0;
    while (whole.solid.bonds().broken_share() == 0.0) {
        whole.run(1);
        REQUIRE(++steps < 400);
    }
    auto other = parting<2>(0.02, {Kinematics::floating, Kinematics::floating});
    other.solid.restore(whole.solid.state(), whole.memm.q());
    CHECK(other.solid.bonds().broken_share() == whole.solid.bonds().broken_share());
    CHECK(other.solid.dissipated().in_bonds == whole.solid.dissipated().in_bonds);
    std::vector<double> expected(whole.solid.size()), found(expected);
    whole.solid.force(whole.memm.q(), expected);
    other.solid.force(whole.memm.q(), found);
    CHECK(found == expected);
}

TEST_CASE("bonds that cannot be made are refused with the reason", "[solid][bonds]") {
    const auto mesh = with_sides(blocks<2>().front().mesh);
    const auto message = [&](const auto& change) {
        auto options = bonded<2>(steel, steel);
        change(options);
        try {
            Solid<2>(mesh, options);
        } catch (const BadInput& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    using Catch::Contains;
    CHECK_THAT(message([](auto& options) {
                   options.bonds.front().strength = 1e8;
                   options.bonds.front().fracture_energy = 1e3;  // J/m^2; half cells of 0.2 m hold more
               }),
               Contains("has a fracture energy of 1000 J/m^2") && Contains("times smaller"));
    CHECK_THAT(message([](auto& options) {
                   options.bonds = {{.sides = {0, 0}}};
               }),
               Contains("both sides of a bond are body 'left'"));
    CHECK_THAT(message([](auto& options) { options.bonds = {{.sides = {0, 99}}}; }), Contains("side 99"));
    CHECK_THAT(message([](auto& options) { options.bonds.front().strength = 0.0; }),
               Contains("its strength is 0 Pa; above 0 Pa is needed"));
    CHECK_THAT(message([](auto& options) {
                   options.kinematics = {Kinematics::small, Kinematics::rigid};
               }),
               Contains("'right' is rigid and is bonded"));
    CHECK_THAT(message([](auto& options) {
                   options.materials[1].law = solid::MaterialLaw::j2;
                   options.materials[1].flow.yield_stress = 1e-3;
               }),
               Contains("'right' is bonded to another small one and yields") && Contains("Kinematics::floating"));
    CHECK_THAT(message([](auto& options) { options.boundary.dirichlet = {support<2>("left.xmax")}; }),
               Contains("held by a support"));
    const auto apart = together(mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {2, 2}, CellShape::quadrangle, "left"),
                                mesh::structured_box<2>({2.0, 0.0}, {3.0, 1.0}, {2, 2}, CellShape::quadrangle, "right"));
    CHECK_THROWS_WITH(Solid<2>(apart, bonded<2>(steel, steel)), Contains("no face of one lies on one of the other"));
}

}  // namespace abut::test
