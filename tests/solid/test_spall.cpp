// A bar that a wave tears where one dimension says, in the plane and in space.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/split_body.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/fragments.hpp"
#include "abut/solid/solid.hpp"
#include "solid/turning_scenes.hpp"

namespace abut::test {
namespace {

/// A pulse of pressure that runs along a bar with E = rho = 1 to its free end, and the plane that it tears.
struct Spall {
    double length = 1.5, depth = 0.25;  ///< of the bar; of the plane below its end
    double begin = 0.2, width = 0.6;    ///< of the pulse at t = 0
    double peak = 0.01;                 ///< pressure, and velocity
    double strength = 0.006, energy = 4e-6;
    bool is_square = false;    ///< the pulse: of the peak over all of its width
    bool has_corners = false;  ///< the crack: every second row of cells is torn one cell further

    [[nodiscard]] double plane() const { return length - depth; }
    [[nodiscard]] double pulse(double x) const {
        const double s = (x - begin) / width;
        return s > 0.0 && s < 1.0 ? peak * (is_square ? 1.0 : std::pow(std::sin(std::numbers::pi * s), 2)) : 0.0;
    }
    /// Displacement of the pulse, which runs without changing: its strain is -pulse(x).
    [[nodiscard]] double displacement(double x) const {
        const double s = std::clamp((x - begin) / width, 0.0, 1.0), turn = 2.0 * std::numbers::pi;
        return -peak * width * (is_square ? s : 0.5 * s - std::sin(turn * s) / (2.0 * turn));
    }
    /// Tension at the plane if it held: the pulse itself, and what comes back from the free end.
    [[nodiscard]] double tension(double t) const { return pulse(length + depth - t) - pulse(plane() - t); }
};

/// Time at which the plane is open, and velocity of the piece in front of it.
struct Torn {
    double time = 0.0, velocity = 0.0;
};

/// By d'Alembert: the opening w sends waves into both sides, w' = 2 (tension - t(w)), with t(w) = strength (1 - w/w_f).
Torn torn_in_one_dimension(const Spall& spall) {
    const double end_of_opening = 2.0 * spall.energy / spall.strength, dt = 1e-5;
    double time = 0.0, opening = 0.0, momentum = 0.0;
    bool opens = false;
    while (opening < end_of_opening) {
        const double free = spall.tension(time + 0.5 * dt);
        opens = opens || free > spall.strength;
        const double rate = 2.0 / (1.0 - spall.strength * dt / end_of_opening);  // of the middle of the step
        const double change = opens ? dt * rate * (free - spall.strength * (1.0 - opening / end_of_opening)) : 0.0;
        momentum -= dt * free - 0.5 * change;
        opening += change;
        time += dt;
    }
    return {time, momentum / spall.depth};
}

/// A bar of bricks, or of triangles or tetrahedra, as two grains that meet in the plane.
template <int Dim>
mesh::Mesh<Dim> bar_of_two_grains(const Spall& spall, double size, CellShape shape) {
    std::array<int, Dim> counts;
    counts.fill(3);
    counts[0] = static_cast<int>(std::lround(spall.length / size));
    Vector<Dim> upper = Vector<Dim>::Constant(3.0 * size);
    upper[0] = spall.length;
    const auto whole = mesh::structured_box<Dim>(Vector<Dim>::Zero(), upper, counts, shape);
    std::vector<std::int32_t> grains;
    for (const Vector<Dim>& x : whole.cell_centroid) {
        const bool is_further = spall.has_corners && std::lround(x[1] / size - 0.5) % 2 == 1;
        grains.push_back(x[0] > spall.plane() + (is_further ? size : 0.0) ? 1 : 0);
    }
    return mesh::split_body<Dim>(whole, grains, {"1", "2"});
}

template <int Dim>
solid::SolidOptions<Dim> options_of(const mesh::Mesh<Dim>& mesh, const Spall& spall) {
    solid::SolidOptions<Dim> options;
    options.materials.assign(2, {.young = 1.0, .poisson = 0.0, .density = 1.0});
    options.kinematics.assign(2, solid::Kinematics::floating);
    options.bonds.push_back({.sides = mesh.report.joined_bodies.front(),
                             .strength = spall.strength,
                             .fracture_energy = spall.energy,
                             .of_grains = true});
    options.contact.emplace();
    return options;
}

template <int Dim>
struct Bar {
    mesh::Mesh<Dim> mesh;
    solid::Solid<Dim> solid;
    dynamics::Memm<solid::Solid<Dim>> memm;

    Bar(const Spall& spall, double size, CellShape shape)
        : mesh(bar_of_two_grains<Dim>(spall, size, shape)), solid(mesh, options_of<Dim>(mesh, spall)), memm(start(spall)) {}

    dynamics::Memm<solid::Solid<Dim>> start(const Spall& spall) {
        std::vector<double> displacement(solid.size(), 0.0), momentum(solid.size(), 0.0);
        const auto q = as_vectors<Dim>(std::span<double>(displacement)), p = as_vectors<Dim>(std::span<double>(momentum));
        for (std::size_t i = 0; i < q.size(); ++i) {
            q[i][0] = spall.displacement(solid.rest_positions()[i][0]);
            p[i][0] = solid.masses()[i] * spall.pulse(solid.rest_positions()[i][0]);
        }
        return {solid, displacement, momentum, 0.9 * dynamics::stable_step(solid).dt};
    }
};

template <int Dim>
dynamics::Ledger<Dim> ledger_until_torn(Bar<Dim>& bar) {
    dynamics::Ledger<Dim> ledger;
    ledger.record(dynamics::measure(bar.memm, bar.solid));
    while (bar.solid.bonds().broken_share() < 1.0) {
        REQUIRE(bar.memm.time() < 2.0);
        bar.memm.step();
        ledger.record(dynamics::measure(bar.memm, bar.solid));
    }
    return ledger;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "a wave tears a bar when one dimension says, with the fracture energy, and the piece has the speed, within 1 %",
    "[solid][fracture]", ((int Dim), Dim), 2, 3) {
    const Spall spall;
    const Torn torn = torn_in_one_dimension(spall);
    const bool of_simplices = GENERATE(false, true);
    const double size = 0.0125, area = std::pow(3.0 * size, Dim - 1);
    const CellShape flat = of_simplices ? CellShape::triangle : CellShape::quadrangle;
    const CellShape in_space = of_simplices ? CellShape::tetrahedron : CellShape::hexahedron;
    CAPTURE(of_simplices, torn.time, torn.velocity);
    Bar<Dim> bar(spall, size, Dim == 2 ? flat : in_space);
    const dynamics::Ledger<Dim> ledger = ledger_until_torn(bar);
    const auto fragments = solid::fragments<Dim>(dynamics::RunView<Dim>(bar.memm), bar.solid);
    REQUIRE(fragments.size() == 2);
    CHECK(bar.memm.time() == Approx(torn.time).epsilon(0.01));
    CHECK(fragments.back().velocity[0] == Approx(torn.velocity).epsilon(0.01));
    CHECK(bar.solid.dissipated().in_bonds == Approx(spall.energy * area).epsilon(0.01));
    CHECK(ledger.pseudo_energy_drift() <= 1e-12 * ledger.largest_energy());
    CHECK(ledger.momentum_drift() <= 1e-13 * spall.peak * spall.width * area);
}

TEMPLATE_TEST_CASE_SIG(
    "a plane that a square pulse tears within few steps takes its fracture energy, with corners as well, within 0.1 %",
    "[solid][fracture]", ((int Dim), Dim), 2, 3) {
    const double size = 0.0125;
    const bool has_corners = GENERATE(false, true);
    const double cells = GENERATE(1.1, 2.2, 4.4);  // E G/strength^2 over the size of a cell
    Spall spall{.begin = 0.3, .width = 0.5, .strength = 0.0085, .is_square = true, .has_corners = has_corners};
    spall.energy = cells * size * spall.strength * spall.strength;
    Bar<Dim> bar(spall, size, Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron);
    const dynamics::Ledger<Dim> ledger = ledger_until_torn(bar);
    double area = 0.0;
    for (const auto& place : bar.solid.bonds().places()) area += place.area;
    const double beyond = bar.solid.dissipated().in_bonds - spall.energy * area;
    CAPTURE(Dim, has_corners, cells, beyond / (spall.energy * area));
    CHECK(bar.solid.bonds().beyond_fracture_energy() == Approx(beyond).margin(1e-12 * spall.energy * area));
    CHECK(std::abs(beyond) <= 1e-3 * spall.energy * area);
    CHECK(ledger.pseudo_energy_drift() <= 1e-12 * ledger.largest_energy());
}

}  // namespace abut::test
