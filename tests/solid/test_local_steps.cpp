// The contact solid with cells that take steps of their own.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "abut/solid/local_steps.hpp"
#include "solid/dense_stiffness.hpp"
#include "solid/integrator_runs.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Solid;

namespace {

/// Two discs whose cells are smaller where they meet.
mesh::Mesh<2> refined_discs(double size, double ratio) {
    const double x = 1.01;
    const auto disc = [&](double side, int variant) {
        const Vector<2> centre(side * x, 0.0), nearest(side * 0.01, 0.0);
        return mesh::disc({.centre = centre,
                           .size = size,
                           .refinement = mesh::Refinement<2>{nearest, size / ratio, 0.8},
                           .variant = variant});
    };
    return together(disc(-1.0, 0), disc(1.0, 1));
}

const auto memm_async = [](auto& solid, auto q, const auto& p, const auto& stable) {
    auto local = solid::local_steps(solid, stable);
    CHECK(local.cells.size() >= 3);
    return dynamics::MemmAsync(solid, std::move(q), p, 0.9 * local.dt, local.steps);
};

}  // namespace

TEST_CASE(
    "local steps on a wall, at rest or moving: energy less its work is exact, and its mean force is what the body gains",
    "[solid][async][obstacle]") {
    const double speed = GENERATE(0.0, 0.05);
    const double skin = GENERATE(0.0, 1e-6);  // of 1e-6: a search in every part of every step
    CAPTURE(speed, skin);
    const auto result = fall(Falling(speed, skin), 4.0, [](auto& solid, auto q, const auto& p, const auto& stable) {
        auto local = solid::local_steps(solid, stable);
        CHECK(local.cells.size() >= 3);
        return dynamics::MemmAsync(solid, std::move(q), p, 0.8 * local.dt, local.steps);
    });
    CHECK(result.imbalance < 1e-12);
    CHECK(result.wall_impulse == Approx(result.body_momentum).epsilon(1e-10));
    if (speed != 0.0) CHECK(result.work > 1e-4);
}

TEST_CASE("local steps refuse conditions with a history, cells whose components are apart, and options out of range",
          "[solid][async][errors]") {
    const auto mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.5}, {4, 2}, CellShape::quadrangle);
    auto options = reconstructed_bodies<2>(1);
    Solid<2> solid(mesh, options);
    std::vector<std::int32_t> level(solid.size(), 0);
    level[1] = 1;
    const std::vector<double> zero(solid.size(), 0.0);
    CHECK_THROWS_WITH(dynamics::MemmAsync(solid, zero, zero, 0.01, {{1, 2}, level}),
                      Catch::Matchers::Contains("components of cell"));
    const auto stable = dynamics::stable_step(solid);
    CHECK_THROWS_WITH(solid::local_steps(solid, stable, {.most_levels = 0}), Catch::Matchers::Contains("1 to 20"));
    CHECK_THROWS_WITH(solid::local_steps(solid, stable, {.contact_margin = -1}), Catch::Matchers::Contains("at least 0"));
    options.boundary.dirichlet.push_back(
        {.group = "ymin", .history = [](double t, const Vector<2>&) { return Vector<2>(0.0, t); }});
    Solid<2> driven(mesh, options);
    CHECK_THROWS_WITH(dynamics::MemmAsync(driven, zero, zero, 0.01, {{1}, std::vector<std::int32_t>(zero.size(), 0)}),
                      Catch::Matchers::Contains("has a history"));
}

TEST_CASE("local steps with constant tractions and prescribed displacements keep the energy", "[solid][async]") {
    const auto mesh = mesh::box<2>(
        {.lower = {0.0, 0.0}, .upper = {1.0, 0.5}, .size = 0.2, .refinement = mesh::Refinement<2>{{0.5, 0.5}, 0.01, 0.3}});
    solid::SolidOptions<2> options;
    options.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0}};
    options.boundary.dirichlet.push_back({.group = "ymin", .value = Vector<2>(0.0, 0.001)});
    options.boundary.traction.push_back({.group = "ymax", .value = Vector<2>(0.01, -0.02)});
    Solid<2> solid(mesh, options);
    const auto local = solid::local_steps(solid, dynamics::stable_step(solid));
    CHECK(local.cells.size() >= 3);
    const std::vector<double> zero(solid.size(), 0.0);
    dynamics::MemmAsync async(solid, zero, zero, 0.8 * local.dt, local.steps);
    dynamics::Ledger<2> ledger;
    for (int i = 0; i < 300; ++i) {
        async.step();
        ledger.record(dynamics::measure(async, solid));
    }
    CHECK(ledger.pseudo_energy_drift() < 1e-12 * ledger.largest_energy());
    CHECK(ledger.largest_energy() > 1e-6);
}

TEST_CASE("local steps: the bulk force of all levels together is that of one level", "[solid][async]") {
    const auto mesh = refined_discs(0.4, 8.0);
    Solid<2> solid(mesh, reconstructed_bodies<2>(2));
    const auto q = random_state(solid.size(), 3, 1e-3), v = random_state(solid.size(), 4, 1e-3);
    const auto local = solid::local_steps(solid, dynamics::stable_step(solid));
    REQUIRE(local.steps.parts.size() >= 3);
    const auto n_levels = static_cast<std::int32_t>(local.steps.parts.size());
    std::vector<double> together(solid.size(), 0.0), expected(solid.size(), 0.0), middle(solid.size()), f(solid.size());
    const double dt = 1e-3;
    auto free = reconstructed_bodies<2>(2);
    free.contact.reset();
    Solid<2> bulk(mesh, free);
    bulk.set_levels(n_levels, local.steps.level);
    const std::vector<double> elapsed(local.steps.parts.size(), 0.0);
    for (std::int32_t level = 0; level < n_levels; ++level)
        bulk.add_impulse(level, {q, v, local.steps.level, elapsed}, 0.0, dt, together);
    for (std::size_t i = 0; i < q.size(); ++i) middle[i] = q[i] + 0.5 * dt * v[i];
    bulk.force(middle, f);
    for (std::size_t i = 0; i < q.size(); ++i) REQUIRE(together[i] == Approx(dt * f[i]).margin(1e-13 * dt * largest(f)));
}

/// The cells on a level and all coarser ones, and some layers about them.
std::vector<char> cells_near(const mesh::Mesh<2>& mesh, const solid::SolidLocalSteps& local, std::int32_t level,
                             int layers) {
    std::vector<char> near;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        near.push_back(local.steps.level[static_cast<std::size_t>(c) * 2] <= level);
    for (int layer = 0; layer < layers; ++layer) {
        const std::vector<char> before = near;
        for (const auto& [c, d] : mesh.face_cells)
            if (d >= 0 && (before[c] || before[d])) near[c] = near[d] = 1;
    }
    return near;
}

/// Of some cells, with the others held [rad/s].
double highest_frequency(const Solid<2>& solid, const Eigen::MatrixXd& k, const std::vector<char>& cells) {
    std::vector<Eigen::Index> own;
    for (std::size_t i = 0; i < solid.size(); ++i)
        if (cells[i / 2]) own.push_back(static_cast<Eigen::Index>(i));
    const auto n = static_cast<Eigen::Index>(own.size());
    Eigen::MatrixXd part(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            part(i, j) = k(own[i], own[j]) * std::sqrt(solid.inverse_mass()[own[i]] * solid.inverse_mass()[own[j]]);
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(part, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
}

TEST_CASE("local steps: levels are stable by themselves, away from resonances, and fine where cells are fine",
          "[solid][async]") {
    const auto mesh = refined_discs(0.4, 8.0);
    Solid<2> solid(mesh, reconstructed_bodies<2>(2));
    const auto stable = dynamics::stable_step(solid);
    const auto local = solid::local_steps(solid, stable);
    REQUIRE(local.cells.size() >= 3);
    CHECK(local.dt == stable.dt * local.steps.parts.back());
    const Eigen::MatrixXd k = dense_stiffness(solid);
    double nearest_to_bound = 0.0;
    for (std::size_t l = 0; l < local.cells.size(); ++l) {
        CHECK(local.cells[l] > 0);
        const double allowed = 0.85 * 2.0 / (local.dt / local.steps.parts[l]);  // 0.85: the margin for contact
        const double omega = highest_frequency(solid, k, cells_near(mesh, local, static_cast<std::int32_t>(l), 2));
        CHECK(omega < allowed);
        CHECK(local.omega_max[l] >= omega);
        CHECK(local.omega_max[l] <= allowed * (1.0 + 1e-14));
        nearest_to_bound = std::max(nearest_to_bound, omega / local.omega_max[l]);
        // Two steps of the next level in one of this: what resonates with it has sqrt(2) times its frequency.
        if (l + 1 == local.cells.size()) continue;
        const double resonant = highest_frequency(solid, k, cells_near(mesh, local, static_cast<std::int32_t>(l), 5));
        CHECK(resonant < std::sqrt(2.0) * allowed);
        CHECK(resonant <= std::sqrt(2.0) * local.omega_max[l]);
    }
    CHECK(nearest_to_bound > 1.0 / 1.1);  // of one level at least: the bound is shown for all of them together
    const auto cell_level = [&](std::int32_t c) { return local.steps.level[static_cast<std::size_t>(c) * 2]; };
    const auto at = [&](const Vector<2>& x) {
        std::int32_t nearest = 0;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            if ((mesh.cell_centroid[c] - x).norm() < (mesh.cell_centroid[nearest] - x).norm()) nearest = c;
        return nearest;
    };
    CHECK(cell_level(at({0.0, 0.0})) >= 2);
    CHECK(cell_level(at({-1.2, 0.0})) == 0);
}

/// Bodies that only fly, with local steps at 0.99 of what is stable: |e|/m over their speed after some steps. All that is
/// not uniform begins as rounding, and a resonance multiplies it at each step.
template <int Dim>
double parasitic_of_flight(const mesh::Mesh<Dim>& mesh, const std::vector<Vector<Dim>>& velocity, int steps,
                           bool one_level) {
    auto flying = reconstructed_bodies<Dim>(mesh.n_bodies());
    flying.contact.reset();
    Solid<Dim> solid(mesh, flying);
    const auto local = solid::local_steps(solid, dynamics::stable_step(solid));
    CHECK((local.cells.size() == 1) == one_level);
    dynamics::MemmAsync async(solid, std::vector<double>(solid.size(), 0.0), solid::uniform_momentum<Dim>(solid, velocity),
                              0.99 * local.dt, local.steps);
    for (int step = 0; step < steps; ++step) async.step();
    return dynamics::measure(async, solid).parasitic / velocity.front().norm();
}

TEST_CASE("local steps: no motion resonates with the steps of coarser cells", "[solid][async]") {
    const double ratio = GENERATE(1.0, 4.0, 8.0);
    CAPTURE(ratio);
    CHECK(parasitic_of_flight<2>(refined_discs(0.15, ratio), disc_velocities, 3000, ratio == 1.0) < 1e-9);
}

TEST_CASE("local steps: tetrahedra of one size have one level, since longer steps of some would resonate",
          "[solid][async]") {
    const auto mesh = mesh::cylinder({.radius = 1.0, .length = 0.5, .size = 1.0 / 6.0});
    CHECK(parasitic_of_flight<3>(mesh, {Vector<3>(0.05, 0.0, 0.0)}, 400, true) < 1e-9);
}

TEST_CASE("local steps: one level is asked for, or no cell can have more", "[solid][async]") {
    const auto mesh = refined_discs(0.4, 8.0);
    Solid<2> solid(mesh, reconstructed_bodies<2>(2));
    const auto stable = dynamics::stable_step(solid);
    const auto one = solid::local_steps(solid, stable, {.most_levels = 1});
    CHECK(one.cells == std::vector<std::int64_t>{mesh.n_cells()});
    CHECK(one.dt == stable.dt);
    CHECK(one.omega_max == std::vector<double>{stable.omega_max});
    // All cells of so coarse a disc are within reach of contact: what is finer than all others is all there is.
    const auto coarse_mesh = two_discs(0.8);
    Solid<2> coarse(coarse_mesh, reconstructed_bodies<2>(2));
    const auto coarse_stable = dynamics::stable_step(coarse);
    const auto finer = solid::local_steps(coarse, coarse_stable, {.contact_levels = 2});
    CHECK(finer.cells.size() == finer.omega_max.size());
    CHECK(finer.cells.front() > 0);
    CHECK(finer.cells.back() > 0);
    CHECK(finer.dt / finer.steps.parts.back() == 0.25 * coarse_stable.dt);
}

TEST_CASE("local steps: cells that contact may reach are a level finer than the same cells without contact, or finest",
          "[solid][async]") {
    const auto mesh = refined_discs(0.4, 8.0);
    Solid<2> solid(mesh, reconstructed_bodies<2>(2));
    auto without = reconstructed_bodies<2>(2);
    without.contact.reset();
    Solid<2> alone(mesh, without);
    // the same steps for both: the margin of contact is in the stable step
    const auto stable = dynamics::stable_step(solid);
    const auto touching = solid::local_steps(solid, stable), free = solid::local_steps(alone, stable);
    REQUIRE(touching.cells.size() == free.cells.size());
    const auto finest = static_cast<std::int32_t>(free.cells.size()) - 1;
    for (const std::int32_t face : mesh.boundary_faces) {
        const auto i = static_cast<std::size_t>(mesh.face_cells[face][0]) * 2;
        REQUIRE(touching.steps.level[i] >= std::min(finest, free.steps.level[i] + 1));
    }
}

TEST_CASE("local steps keep H~ and momentum through an impact, with contact events inside the steps", "[solid][async]") {
    const auto mesh = refined_discs(0.3, 8.0);
    const double time = 6.0;
    const auto local = run<2>(mesh, disc_velocities, time, memm_async);
    const double k_0 = local.entries().front().kinetic;
    CHECK(local.pseudo_energy_drift() < 1e-12 * k_0);
    CHECK(local.momentum_drift() < 1e-14);
    CHECK(local.entries().back().events > 0);
    CHECK(local.energy_excess() < 0.05 * k_0);
}

TEST_CASE("local steps with contact on a finer level than the bulk keep H~, too", "[solid][async]") {
    const auto mesh = two_discs(0.8);
    const auto ledger = run<2>(mesh, disc_velocities, 6.0, [](auto& solid, auto q, const auto& p, const auto& stable) {
        auto local = solid::local_steps(solid, stable, {.contact_levels = 2});
        CHECK(local.cells.size() >= 3);
        return dynamics::MemmAsync(solid, std::move(q), p, 0.9 * local.dt, local.steps);
    });
    const double k_0 = ledger.entries().front().kinetic;
    CHECK(ledger.pseudo_energy_drift() < 1e-12 * k_0);
    CHECK(ledger.momentum_drift() < 1e-14);
}

TEST_CASE("local steps keep H~ through an impact of tetrahedra", "[solid][async]") {
    const auto mesh = two_boxes(4);
    const auto ledger = run<3>(mesh, box_velocities, 1.5, [](auto& solid, auto q, const auto& p, const auto& stable) {
        auto local = solid::local_steps(solid, stable, {.contact_levels = 1});
        return dynamics::MemmAsync(solid, std::move(q), p, 0.9 * local.dt, local.steps);
    });
    CHECK(ledger.pseudo_energy_drift() < 1e-12 * ledger.entries().front().kinetic);
    CHECK(ledger.momentum_drift() < 1e-14);
}
