// Bodies that are cut into grains, break, and fly on as fragments.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/mesh/grains.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/split_body.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/fragments.hpp"
#include "solid/turning_scenes.hpp"

namespace abut::test {
namespace {

using solid::Kinematics;

template <int Dim>
mesh::Mesh<Dim> in_grains(const mesh::Mesh<Dim>& whole, double size) {
    const auto grains = mesh::grains_of<Dim>(whole, {.size = size});
    std::vector<std::string> names;
    for (std::int32_t i = 0; i <= *std::ranges::max_element(grains); ++i) names.push_back(std::to_string(i + 1));
    return mesh::split_body<Dim>(whole, grains, std::move(names));
}

/// A box of triangles or tetrahedra in grains about a third of its side large.
template <int Dim>
mesh::Mesh<Dim> box_of_grains() {
    return in_grains<Dim>(mesh::box<Dim>({.size = Dim == 2 ? 0.06 : 0.15}), Dim == 2 ? 0.33 : 0.5);
}

template <int Dim>
solid::SolidOptions<Dim> of_grains(const mesh::Mesh<Dim>& mesh, const solid::Bond& bond) {
    solid::SolidOptions<Dim> options;
    options.materials.assign(static_cast<std::size_t>(mesh.n_bodies()), {.young = 1.0, .poisson = 0.25, .density = 1.0});
    for (const auto& sides : mesh.report.joined_bodies) {
        options.bonds.push_back(bond);
        options.bonds.back().sides = sides;
    }
    options.contact.emplace();
    return options;
}

/// Grains that fly apart from the middle of the box, each as a whole, while all of it turns.
template <int Dim>
std::vector<Motion<Dim>> flung_apart(const mesh::Mesh<Dim>& mesh, double rate) {
    const auto n = static_cast<std::size_t>(mesh.n_bodies());
    std::vector<Vector<Dim>> centre(n, Vector<Dim>::Zero());
    std::vector<double> measure(n, 0.0);
    for (std::size_t cell = 0; cell < mesh.cell_measure.size(); ++cell) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[cell]);
        centre[body] += mesh.cell_measure[cell] * mesh.cell_centroid[cell];
        measure[body] += mesh.cell_measure[cell];
    }
    const AxialVector<Dim> spin = some_spin<Dim>(0.2 * rate);
    std::vector<Motion<Dim>> motions;
    for (std::size_t body = 0; body < n; ++body) {
        const Vector<Dim> arm = centre[body] / measure[body] - Vector<Dim>::Constant(0.5);
        motions.push_back(moving<Dim>(rate * arm + dynamics::turning_velocity<Dim>(spin, arm), spin));
    }
    return motions;
}

/// A ring of radius 1 around the origin, of quadrangles, `n_across` of them from side to side.
mesh::Mesh<2> ring(int n_around, int n_across, double thickness) {
    mesh::CellSoup<2> soup;
    soup.name = "ring";
    soup.body_names = {"ring"};
    for (int i = 0; i < n_around; ++i)
        for (int j = 0; j <= n_across; ++j) {
            const double angle = 2.0 * std::numbers::pi * i / n_around,
                         radius = 1.0 + thickness * (1.0 * j / n_across - 0.5);
            soup.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        }
    const auto vertex = [&](int i, int j) { return (i % n_around) * (n_across + 1) + j; };
    for (int i = 0; i < n_around; ++i)
        for (int j = 0; j < n_across; ++j) {
            soup.cell_shape.push_back(mesh::CellShape::quadrangle);
            soup.cell_vertices.append(std::array{vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)});
            soup.cell_body.push_back(0);
        }
    return mesh::build_mesh(std::move(soup));
}

/// Fragments of a ring that expands at this rate, after no more of them come off.
std::size_t n_fragments_of_ring(double rate, double energy, double strength) {
    const auto mesh = in_grains<2>(ring(628, 3, 0.03), 0.03);
    auto options =
        of_grains<2>(mesh, {.sides = {}, .strength = strength, .fracture_energy = energy, .weibull_modulus = 15.0});
    for (auto& material : options.materials) material.poisson = 0.0;
    options.kinematics.assign(options.materials.size(), Kinematics::floating);
    solid::Solid<2> solid(mesh, options);
    std::vector<double> momentum(solid.size());
    const auto p = as_vectors<2>(std::span<double>(momentum));
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = solid.masses()[i] * rate * solid.rest_positions()[i].normalized();
    dynamics::Memm<solid::Solid<2>> memm(solid, std::vector<double>(solid.size(), 0.0), momentum,
                                         0.9 * dynamics::stable_step(solid).dt);
    while (memm.time() < 0.06 / rate) memm.step();
    const auto fragment = solid::fragment_of_bodies<2>(solid);
    return static_cast<std::size_t>(*std::ranges::max_element(fragment)) + 1;
}

}  // namespace

TEST_CASE("an expanding ring breaks into at least as many fragments as Grady's energy says, and up to three times as many",
          "[solid][fracture][long]") {
    // D. E. Grady (1982): a length s takes its fracture energy from the kinetic energy of its expansion about its middle,
    // s^3 = 24 G/(rho rate^2).
    const double energy = 3.3e-6, strength = 5.8e-3;  // E G/strength^2 is ten cells
    const double rate = GENERATE(0.1, 0.2, 0.4, 0.8);
    const double by_grady = 2.0 * std::numbers::pi / std::cbrt(24.0 * energy / (rate * rate));
    const auto n = static_cast<double>(n_fragments_of_ring(rate, energy, strength));
    CAPTURE(rate, by_grady, n);
    CHECK(n >= by_grady);
    CHECK(n <= 3.0 * by_grady);
}

TEMPLATE_TEST_CASE_SIG("a body that is flung apart takes its fracture energy per broken area and keeps all that it should",
                       "[solid][fracture]", ((int Dim), Dim), 2, 3) {
    const double energy = Dim == 2 ? 1.5e-4 : 3e-4;
    const auto mesh = box_of_grains<Dim>();
    REQUIRE(mesh.n_bodies() > 5);
    const auto options = of_grains<Dim>(mesh, {.sides = {}, .strength = 0.01, .fracture_energy = energy});
    TurningScene<Dim> scene(mesh, options, flung_apart<Dim>(mesh, 0.15), 0.9);
    double dissipated = 0.0, least = 0.0;
    for (int i = 0; i < (Dim == 2 ? 400 : 200); ++i) {
        scene.run(1, 1);
        const double now = scene.solid.dissipated().in_bonds;
        least = std::min(least, now - dissipated);
        dissipated = now;
    }
    double broken = 0.0, opened = 0.0;
    const auto bonds = scene.solid.bonds();
    for (std::size_t p = 0; p < bonds.places().size(); ++p) {
        if (bonds.is_broken(p)) broken += bonds.places()[p].area;
        if (bonds.share(p) < 1.0) opened += bonds.places()[p].area;
    }
    CHECK(bonds.broken_share() > 0.5);
    // A place that has opened in part has taken a part of its energy.
    CHECK(dissipated >= 0.98 * energy * broken);
    CHECK(dissipated <= 1.02 * energy * opened);
    CHECK(least >= -1e-15 * scene.ledger.largest_energy());
    const Drifts drifts = scene.drifts();
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.momentum <= 1e-13);
    CHECK(drifts.pseudo_moment <= 1e-13);
}

TEMPLATE_TEST_CASE_SIG("fragments are the grains that bonds hold together, with their mass, momentum and spin",
                       "[solid][fracture]", ((int Dim), Dim), 2, 3) {
    const auto mesh = box_of_grains<Dim>();
    const auto options = of_grains<Dim>(mesh, {.sides = {}, .strength = 1e-3});
    const AxialVector<Dim> spin = some_spin<Dim>(0.02);
    TurningScene<Dim> scene(mesh, options, flung_apart<Dim>(mesh, 0.1), 0.9);
    const auto before = solid::fragments<Dim>(scene.view(), scene.solid);
    REQUIRE(before.size() == 1);
    CHECK(std::ssize(before.front().bodies) == mesh.n_bodies());
    CHECK(before.front().n_cells == mesh.n_cells());
    CHECK(before.front().mass == Approx(1.0).epsilon(1e-12));
    CHECK((before.front().centre - Vector<Dim>::Constant(0.5)).norm() < 1e-12);
    CHECK((before.front().spin - spin).norm() < 1e-12);
    scene.run(300, 300);
    CHECK(scene.solid.bonds().broken_share() == 1.0);
    const auto after = solid::fragments<Dim>(scene.view(), scene.solid);
    REQUIRE(std::ssize(after) == mesh.n_bodies());
    const auto motions = solid::body_motions<Dim>(scene.view(), scene.solid);
    Vector<Dim> momentum = Vector<Dim>::Zero(), at_start = before.front().mass * before.front().velocity;
    for (std::size_t body = 0; body < after.size(); ++body) {
        CHECK(after[body].bodies == std::vector{static_cast<std::int32_t>(body)});
        CHECK(after[body].mass == motions[body].mass);
        CHECK((after[body].velocity - motions[body].velocity).norm() == 0.0);
        momentum += after[body].mass * after[body].velocity;
    }
    CHECK((momentum - at_start).norm() < 1e-13);
}

TEST_CASE("bodies that never had a bond are in no fragment", "[solid][fracture]") {
    const auto box = box_of_grains<2>();
    auto far = mesh::box<2>({.lower = {2.0, 0.0}, .upper = {3.0, 1.0}, .size = 0.3, .name = "far"});
    const std::vector<mesh::Mesh<2>> both{far, box};
    const auto mesh = mesh::combine<2>(both);
    auto options = of_grains<2>(mesh, {});
    options.bonds.clear();
    for (auto sides : box.report.joined_bodies)
        options.bonds.push_back({.sides = {sides[0] + 1, sides[1] + 1}, .strength = 1.0});
    const solid::Solid<2> solid(mesh, options);
    const auto fragment = solid::fragment_of_bodies<2>(solid);
    CHECK(fragment.front() == -1);
    CHECK(std::all_of(fragment.begin() + 1, fragment.end(), [](std::int32_t number) { return number == 0; }));
}

TEST_CASE("a bar of grains that strikes a wall stops when the wave is back, within 5 %", "[solid][fracture]") {
    // In one dimension: L/c after it has touched the wall; nu is 0.
    const double length = 2.0, gap = 0.005, speed = 0.01;
    const auto [kinematics, allowed] = GENERATE(std::pair(Kinematics::floating, 0.025), std::pair(Kinematics::finite, 0.05));
    const auto whole = mesh::box<2>({.upper = {length, 0.5}, .size = 0.05});
    const auto mesh = in_grains<2>(whole, 0.25);
    auto options = of_grains<2>(mesh, {.sides = {}, .strength = 1e3});
    for (auto& material : options.materials) material.poisson = 0.0;
    options.obstacles = {contact::plane_obstacle<2>({-gap, 0.25}, {1.0, 0.0}, 5.0)};
    const std::vector<Motion<2>> motions(static_cast<std::size_t>(mesh.n_bodies()), moving<2>({-speed, 0.0}));
    TurningScene<2> scene(mesh, options, motions, 0.9, kinematics);
    double before = 0.0, now = -speed * length * 0.5;
    while (now < 0.0 && scene.memm.time() < 4.0) {
        scene.run(1, 1);
        before = std::exchange(now, scene.ledger.entries().back().linear_momentum[0]);
    }
    const double stopped = scene.memm.time() - scene.memm.dt() * now / (now - before);
    const double over_theory = (stopped - gap / speed) / length;
    CAPTURE(static_cast<int>(kinematics), over_theory);
    CHECK(over_theory == Approx(1.0).margin(allowed));
    CHECK(scene.solid.bonds().broken_share() == 0.0);
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
}

TEST_CASE("strengths are drawn from the Weibull distribution that is asked for", "[solid][fracture]") {
    const auto mesh = box_of_grains<2>();
    const auto strengths_of = [&](double modulus, std::uint32_t seed) {
        auto options = of_grains<2>(mesh, {.sides = {}, .strength = 2.0, .weibull_modulus = modulus, .seed = seed});
        options.contact.reset();
        const solid::Solid<2> solid(mesh, options);
        std::vector<double> strengths;
        for (const auto& place : solid.bonds().places()) strengths.push_back(place.strength);
        return strengths;
    };
    CHECK(std::ranges::all_of(strengths_of(std::numeric_limits<double>::infinity(), 0),
                              [](double strength) { return strength == 2.0; }));
    CHECK(strengths_of(4.0, 1) == strengths_of(4.0, 1));
    CHECK(strengths_of(4.0, 1) != strengths_of(4.0, 2));
    // Kolmogorov and Smirnov: of 1,000 samples one is farther from the distribution than 1.95/sqrt(n).
    for (const double modulus : {1.0, 4.0, 20.0}) {
        CAPTURE(modulus);
        std::vector<double> strengths;
        for (std::uint32_t seed = 0; seed < 10; ++seed)
            for (const double strength : strengths_of(modulus, seed)) strengths.push_back(strength);
        std::ranges::sort(strengths);
        const auto n = static_cast<double>(strengths.size());
        double farthest = 0.0;
        for (std::size_t i = 0; i < strengths.size(); ++i) {
            const double below = 1.0 - std::exp(-std::pow(strengths[i] / 2.0, modulus));
            farthest = std::max(
                {farthest, std::abs(below - static_cast<double>(i) / n), std::abs(below - static_cast<double>(i + 1) / n)});
        }
        CHECK(n > 300);
        CHECK(farthest < 1.95 / std::sqrt(n));
    }
    CHECK_THROWS_WITH(strengths_of(0.0, 0), Catch::Contains("Weibull modulus of 0; > 0 is needed"));
}

}  // namespace abut::test
