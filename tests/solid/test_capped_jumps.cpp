// Jumps between cells of metal bodies, whose stabilisation yields.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;
using solid::Material;
using solid::MaterialLaw;

namespace {

constexpr double no_cap = 1e9;

Material perfect(double poisson, double yield_stress, double jump_cap = 0.0) {
    Material material{
        .young = 1.0, .poisson = poisson, .density = 1.0, .law = MaterialLaw::j2, .flow = {.yield_stress = yield_stress}};
    material.flow.jump_cap = jump_cap;
    return material;
}

/// An eighth of a hollow sphere from radius 1 to 2 of tetrahedra: `n` along each edge of a spherical triangle. Groups: inner, and the
/// planes x, y, z.
mesh::Mesh<3> hollow_sphere(int layers, int n) {
    mesh::CellSoup<3> soup{.name = "hollow sphere", .body_names = {"sphere"}, .group_names = {"inner", "x", "y", "z"}};
    const auto in_layer = [&](int i, int j) { return i * (n + 1) - i * (i - 1) / 2 + j; };
    const int n_layer = in_layer(n, 0) + 1;
    for (int k = 0; k <= layers; ++k)
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n - i; ++j) {
                // Steps of equal angle, so that triangles are nearly alike
                const auto at = [&](int m) { return std::sin(0.5 * std::numbers::pi * m / n); };
                const Vector<3> direction = Vector<3>(at(i), at(j), at(n - i - j)).normalized();
                soup.vertices.push_back((1.0 + static_cast<double>(k) / layers) * direction);
            }
    const auto add = [&](std::array<int, 3> triangle, int layer) {
        std::ranges::sort(triangle);  // diagonals by number: those of neighbours match
        std::array<int, 6> v;
        for (int m = 0; m < 3; ++m) v[m] = layer * n_layer + triangle[m], v[3 + m] = v[m] + n_layer;
        for (const auto& cell :
             {std::array{v[0], v[1], v[2], v[5]}, std::array{v[0], v[1], v[4], v[5]}, std::array{v[0], v[3], v[4], v[5]}}) {
            soup.cell_shape.push_back(CellShape::tetrahedron);
            soup.cell_vertices.append(cell);
            soup.cell_body.push_back(0);
            for (int left_out = 0; left_out < 4; ++left_out) {
                std::vector<std::int32_t> face;
                for (int m = 0; m < 4; ++m)
                    if (m != left_out) face.push_back(cell[m]);
                const auto all = [&](const auto& holds) {
                    return std::ranges::all_of(face, [&](std::int32_t p) { return holds(soup.vertices[p]); });
                };
                if (all([](const Vector<3>& x) { return x.norm() < 1.0 + 1e-9; })) soup.named_faces.push_back({face, 0});
                for (int axis = 0; axis < 3; ++axis)
                    if (all([&](const Vector<3>& x) { return std::abs(x[axis]) < 1e-9; }))
                        soup.named_faces.push_back({face, 1 + axis});
            }
        }
    };
    for (int layer = 0; layer < layers; ++layer)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n - i; ++j) {
                add({in_layer(i, j), in_layer(i + 1, j), in_layer(i, j + 1)}, layer);
                if (j + 1 < n - i) add({in_layer(i + 1, j), in_layer(i + 1, j + 1), in_layer(i, j + 1)}, layer);
            }
    return mesh::build_mesh<3>(std::move(soup));
}

/// What a body bears while it is moved at a steady rate until it flows all over, over its limit: means of the last part of the path,
/// and of the one before.
struct Flow {
    double load = 0.0, earlier = 0.0;
    double balance = 0.0;  // of H~ + D - W
    double fall = 0.0;     // of what jumps dissipate
    double share = 0.0;    // of all that is dissipated, in jumps

    /// `path`: what times the limit is the work, at the end of `duration`. The parts begin and end at these shares of it.
    Flow(TurningScene<3>& scene, double limit, double path, double duration, const std::array<double, 3>& ends) {
        const auto work_until = [&](double t) {
            fall = std::max(fall, fall_of_dissipation<3>(scene, static_cast<int>((t - scene.memm.time()) / scene.memm.dt()),
                                                         &dynamics::Losses::in_jumps));
            return std::pair{scene.solid.work(), path * scene.memm.time() / duration};
        };
        const auto first = work_until(ends[0] * duration), second = work_until(ends[1] * duration),
                   third = work_until(ends[2] * duration);
        earlier = (second.first - first.first) / (second.second - first.second) / limit;
        load = (third.first - second.first) / (third.second - second.second) / limit;
        scene.ledger.record(dynamics::measure(scene.memm, scene.solid));
        balance = scene.drifts().pseudo_energy;
        share = scene.solid.dissipated().in_jumps / scene.solid.dissipated().total();
    }
};

/// A thick sphere, the pressure inside over the limit 2 sigma_y ln 2, until 10 times the elastic expansion.
Flow sphere(const Material& material) {
    constexpr double duration = 60.0;
    const auto mesh = hollow_sphere(6, 6);
    const double limit = 2.0 * material.flow.yield_stress * std::log(2.0);
    // 5.6 of the yield stress over E at nu = 0.3 is what an elastic sphere expands by at the limit pressure.
    const double elastic = limit * (0.5 * (1.0 + material.poisson) * 8.0 + (1.0 - 2.0 * material.poisson)) / 7.0;
    const double last = 10.0 * elastic;
    auto options = alone<3>(material);
    options.boundary.dirichlet = {{.group = "inner", .history = [=](double t, const Vector<3>& x) -> Vector<3> {
                                       return last * t / duration * x.normalized();
                                   }}};
    for (const char* plane : {"x", "y", "z"})
        options.boundary.dirichlet.push_back({.group = plane, .constraint = solid::Constraint::normal});
    TurningScene<3> scene(mesh, options, {moving<3>(Vector<3>::Zero())}, 0.9, Kinematics::small);
    double area = 0.0;  // what the faces inside displace per radial motion
    for (const std::int32_t f : mesh.group("inner").faces)
        area -= mesh.face_measure[f] * mesh.face_normal[f].dot(mesh.face_centroid[f].normalized());
    return {scene, limit, area * last, duration, {0.3, 0.6, 1.0}};
}

/// A square bar, a = 1, whose clamped ends turn, the torque over the limit sigma_y/sqrt(3) a^3/3, until 7 times what an elastic bar
/// needs for it.
Flow torsion(const Material& material, CellShape shape, int n) {
    constexpr double length = 3.0, rigidity = 0.1406, duration = 100.0;
    const auto mesh = mesh::structured_box<3>({-0.5, -0.5, 0.0}, {0.5, 0.5, length}, {n, n, 3 * n}, shape);
    const double limit = material.flow.yield_stress / std::numbers::sqrt3 / 3.0;
    const double last = 7.0 * limit * length / (rigidity * material.mu());
    auto options = alone<3>(material);
    const auto turned = [=](double t, const Vector<3>& x) -> Vector<3> {
        return last * t / duration * (x.z() > 0.5 * length ? 0.5 : -0.5) * Vector<3>(-x.y(), x.x(), 0.0);
    };
    options.boundary.dirichlet = {{.group = "zmin", .history = turned}, {.group = "zmax", .history = turned}};
    TurningScene<3> scene(mesh, options, {moving<3>(Vector<3>::Zero())}, 0.9, Kinematics::small);
    return {scene, limit, last, duration, {0.4, 0.7, 1.0}};
}

}  // namespace

TEST_CASE("a thick sphere of metal expands at its limit load, and no harder as it goes on, for nu 0.3 and 0.49",
          "[solid][material]") {
    for (const double poisson : {0.3, 0.49}) {
        const Flow flow = sphere(perfect(poisson, 1e-4));
        CAPTURE(poisson, flow.earlier, flow.load, flow.share);
        CHECK(std::abs(flow.load - 1.0) <= 0.02);
        CHECK(std::abs(flow.earlier - 1.0) <= 0.02);
        CHECK(flow.balance <= 1e-12);
        CHECK(flow.fall <= 0.0);
        CHECK((flow.share > 0.0 && flow.share <= 0.05));
    }
    // What the cap is for: jumps that stay elastic harden without end where flow keeps the volume.
    const Flow elastic = sphere(perfect(0.49, 1e-4, no_cap));
    CAPTURE(elastic.earlier, elastic.load);
    CHECK(elastic.load > 1.08);
    CHECK(elastic.load > elastic.earlier + 0.03);
}

TEST_CASE("a square bar of metal is turned by its limit torque, of bricks and of tetrahedra", "[solid][material]") {
    for (const auto& [shape, n] : {std::pair{CellShape::hexahedron, 6}, std::pair{CellShape::tetrahedron, 4}}) {
        const Flow flow = torsion(perfect(0.3, 1e-4), shape, n);
        CAPTURE(static_cast<int>(shape), flow.earlier, flow.load, flow.share);
        CHECK(std::abs(flow.load - 1.0) <= 0.03);
        CHECK(flow.load <= flow.earlier + 0.02);
        CHECK(flow.balance <= 1e-12);
        CHECK(flow.fall <= 0.0);
        CHECK((flow.share > 0.0 && flow.share <= 0.05));
    }
}

TEMPLATE_TEST_CASE_SIG(
    "jumps that yield dissipate in each step, keep H~ + D, momentum and J~, and feed no alternating mode, whatever the "
    "kinematics",
    "[solid][material]", ((int Dim), Dim), 2, 3) {
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating, Kinematics::finite})
        for (const auto& [name, mesh] : boxes<Dim>()) {
            CAPTURE(name, static_cast<int>(kinematics));
            const bool is_finite = kinematics == Kinematics::finite;
            const Motion<Dim> spinning{Vector<Dim>::Constant(0.003),
                                       some_spin<Dim>(kinematics == Kinematics::small ? 0.0 : 0.02)};
            TurningScene<Dim> scene(mesh, alone<Dim>(perfect(0.3, 1e-3)), {spinning}, is_finite ? 0.5 : 0.9, kinematics,
                                    0.01);
            const double fall = fall_of_dissipation<Dim>(scene, 300, &dynamics::Losses::in_jumps);
            const Drifts drifts = scene.drifts();
            CHECK(scene.solid.dissipated().in_jumps > 0.005 * scene.ledger.largest_energy());
            CHECK(fall <= 0.0);
            CHECK(drifts.pseudo_energy <= 1e-13);
            CHECK(drifts.momentum <= 1e-13);
            if (kinematics != Kinematics::small) CHECK(drifts.pseudo_moment <= 1e-13);
            if (kinematics == Kinematics::small) CHECK(drifts.parasitic <= 1e-13);
        }
}

TEMPLATE_TEST_CASE_SIG("what lasts of the jumps of a finite body turns with it: its energy does not know the turn",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : boxes<Dim>()) {
        CAPTURE(name);
        TurningScene<Dim> scene(mesh, alone<Dim>(perfect(0.3, 1e-3)), {moving<Dim>(Vector<Dim>::Zero())}, 0.5,
                                Kinematics::finite, 0.02);
        scene.run(60);
        REQUIRE(scene.solid.dissipated().in_jumps > 0.0);
        std::vector<double> q(scene.memm.q().begin(), scene.memm.q().end()), turned = q;
        const Matrix<Dim> turn = turned_by<Dim>(1.1);
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            const Vector<Dim>& rest = scene.solid.rest_positions()[static_cast<std::size_t>(c)];
            vectors<Dim>(turned)[c] = turn * (rest + vectors<Dim>(q)[c]) - rest;
        }
        const double energy = scene.solid.potential(q);
        CHECK(scene.solid.potential(turned) == Approx(energy).epsilon(1e-10));
        CHECK(slope_error<Dim>(scene.solid, turned) <= 1e-6);
    }
}

TEMPLATE_TEST_CASE_SIG("a run whose jumps have yielded goes on from its state with the same bits", "[solid][material]",
                       ((int Dim), Dim), 2, 3) {
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating, Kinematics::finite})
        for (const auto& [name, mesh] : boxes<Dim>()) {
            CAPTURE(name, static_cast<int>(kinematics));
            const auto made = [&] {
                return std::make_unique<TurningScene<Dim>>(mesh, alone<Dim>(perfect(0.3, 1e-3)),
                                                           std::vector{moving<Dim>(Vector<Dim>::Zero())}, 0.5, kinematics,
                                                           0.02);
            };
            const auto whole = made(), first = made(), second = made();
            whole->run(80);
            first->run(40);
            CHECK(first->solid.dissipated().in_jumps > 0.0);
            second->memm.restore(first->memm.state());
            second->solid.restore(first->solid.state(), second->memm.q());
            second->run(40);
            CHECK(std::ranges::equal(second->memm.q(), whole->memm.q()));
            CHECK(second->solid.dissipated().in_jumps == whole->solid.dissipated().in_jumps);
            CHECK(second->solid.dissipated().total() == whole->solid.dissipated().total());
        }
}

TEST_CASE("a box that a load pulls slowly stretches as uniaxial hardening says, also where the load acts",
          "[solid][material]") {
    constexpr int Dim = 3;
    constexpr double hardening = 0.05, most = 1.3e-3, duration = 200.0;
    Material material = perfect(0.3, 1e-3);
    material.flow.hardening = hardening;
    material.damping.mass = 0.5;
    for (const auto& [name, mesh] : boxes<Dim>()) {
        CAPTURE(name);
        auto options = alone<Dim>(material);
        options.boundary.dirichlet = {{.group = "xmin", .constraint = solid::Constraint::normal}};
        options.boundary.traction = {{.group = "xmax", .history = [](double t, const Vector<Dim>&) -> Vector<Dim> {
                                          return most * std::min(1.0, t / duration) * Vector<Dim>::Unit(0);
                                      }}};
        TurningScene<Dim> scene(mesh, options, {moving<Dim>(Vector<Dim>::Zero())}, 0.9, Kinematics::small);
        scene.run_until(1.3 * duration);
        double products = 0.0, squares = 0.0, mean = 0.0;  // of a line through the displacements
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            mean += mesh.cell_centroid[static_cast<std::size_t>(c)][0] / mesh.n_cells();
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            const double x = mesh.cell_centroid[static_cast<std::size_t>(c)][0] - mean;
            products += x * scene.memm.q()[static_cast<std::size_t>(Dim * c)];
            squares += x * x;
        }
        CHECK(products / squares == Approx(most + (most - material.flow.yield_stress) / hardening).epsilon(0.03));
        CHECK(scene.drifts().pseudo_energy <= 1e-12);
    }
}
