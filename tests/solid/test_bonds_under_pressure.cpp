// Bonds that are sheared while their sides press on each other.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <vector>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/bond/bond_law.hpp"
#include "abut/solid/bond/pressed_sides.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/contact/bonds_of_faces.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/turning_scenes.hpp"

namespace abut::test {
namespace {

using solid::Kinematics;

constexpr double bar_length = 1.0, width = 0.25, press = 0.02, strength = 0.0015, fracture_energy = 3e-6;
/// Of what bonds take in each step in which they open: to this fit_to_law closes it, so that all of it is as near.
constexpr double by_law = 1e-3;

/// Edge of the cells of a bar over its length, which is the time that a wave takes through a cell over that through the bar.
template <int Dim>
constexpr double cell = width / bar_length / (Dim == 2 ? 5 : 3);

/// Two equal bars along x whose ends are bonded at x = 0.
template <int Dim>
mesh::Mesh<Dim> bonded_bars() {
    Vector<Dim> lower = Vector<Dim>::Constant(-0.5 * width), upper = Vector<Dim>::Constant(0.5 * width);
    std::array<int, Dim> counts;
    counts.fill(Dim == 2 ? 5 : 3);
    counts[0] *= 4;
    const CellShape shape = Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron;
    const auto bar = [&](double from, const char* name) {
        lower[0] = from;
        upper[0] = from + bar_length;
        return mesh::structured_box<Dim>(lower, upper, counts, shape, name);
    };
    return together(bar(-bar_length, "left"), bar(0.0, "right"));
}

enum class BondOfBars { none, springs, grains };

/// They run into each other at `speed`, E, rho and the speed of their waves being 1, and pass each other at `pass`. Their bond
/// takes `energy` [J/m^2].
template <int Dim>
TurningScene<Dim> sheared(BondOfBars bond, double pass, Kinematics kinematics = Kinematics::floating, double speed = press,
                          double poisson = 0.0, double energy = fracture_energy) {
    solid::SolidOptions<Dim> options;
    options.materials.assign(2, {.young = 1.0, .poisson = poisson, .density = 1.0});
    if (bond != BondOfBars::none)
        options.bonds = {
            {.sides = {0, 1}, .strength = strength, .fracture_energy = energy, .of_grains = bond == BondOfBars::grains}};
    options.contact.emplace();
    const Vector<Dim> velocity = speed * Vector<Dim>::Unit(0) + pass * Vector<Dim>::Unit(1);
    return TurningScene<Dim>(bonded_bars<Dim>(), options, {moving<Dim>(velocity), moving<Dim>(Vector<Dim>(-velocity))}, 0.6,
                             {kinematics, kinematics});
}

/// Mean velocity of a bar [-].
template <int Dim>
Vector<Dim> velocity_of(const TurningScene<Dim>& scene, std::int32_t bar) {
    Vector<Dim> momentum = Vector<Dim>::Zero();
    double mass = 0.0;
    for (std::size_t i = 0; i < scene.solid.masses().size(); ++i) {
        if (scene.mesh.cell_body[i] != bar) continue;
        momentum += scene.view().momentum(static_cast<std::ptrdiff_t>(i));
        mass += scene.solid.masses()[i];
    }
    return momentum / mass;
}

/// Along the bars [-].
template <int Dim>
double speed_of(const TurningScene<Dim>& scene, std::int32_t bar) {
    return velocity_of(scene, bar)[0];
}

/// Two blocks four times as wide as they are long, which friction hardly turns: they run into each other at `press`, and
/// pass each other at 0.03.
template <int Dim>
TurningScene<Dim> rubbed(BondOfBars bond, Kinematics kinematics) {
    constexpr double length = 1.0, across = 4.0, pass = 0.03;
    std::array<int, Dim> counts;
    counts.fill(Dim == 2 ? 8 : 4);
    counts[1] *= 4;
    const CellShape shape = Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron;
    const auto block = [&](double from, const char* name) {
        Vector<Dim> lower = Vector<Dim>::Constant(-0.5 * length), upper = -lower;
        lower[0] = from;
        upper[0] = from + length;
        lower[1] = -0.5 * across;
        upper[1] = 0.5 * across;
        return mesh::structured_box<Dim>(lower, upper, counts, shape, name);
    };
    solid::SolidOptions<Dim> options;
    options.materials.assign(2, {.young = 1.0, .poisson = 0.0, .density = 1.0});
    if (bond != BondOfBars::none)
        options.bonds = {
            {.sides = {0, 1}, .strength = 0.002, .fracture_energy = 4e-6, .of_grains = bond == BondOfBars::grains}};
    options.contact.emplace();
    options.friction.coefficient = 0.3;
    const Vector<Dim> velocity = press * Vector<Dim>::Unit(0) + pass * Vector<Dim>::Unit(1);
    return TurningScene<Dim>(together(block(-length, "left"), block(0.0, "right")), options,
                             {moving<Dim>(velocity), moving<Dim>(Vector<Dim>(-velocity))}, 0.6, {kinematics, kinematics});
}

template <int Dim>
double bonded_area() {
    return std::pow(width, Dim - 1);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "a bond that is sheared under 13 times its strength of pressure takes its fracture energy, within 0.1 %, and its bars "
    "rebound as bars without a bond, within 2 %",
    "[solid][bonds]", ((int Dim), Dim), 2, 3) {
    const auto bond = GENERATE(BondOfBars::springs, BondOfBars::grains);
    CAPTURE(Dim, static_cast<int>(bond));
    const double pass = 0.006, energy = fracture_energy * bonded_area<Dim>();
    auto scene = sheared<Dim>(bond, pass);
    scene.run_until(1.5);  // the wave that parts the ends is back at 2
    CHECK(scene.solid.bonds().broken_share() == 1.0);
    CHECK(scene.solid.dissipated().in_bonds == Approx(energy).epsilon(by_law));
    CHECK(std::abs(scene.solid.bonds().beyond_fracture_energy()) <= by_law * energy);
    scene.run_until(3.0);
    CHECK(scene.solid.dissipated().in_bonds == Approx(energy).epsilon(by_law));
    CHECK(scene.solid.contact().report().missed_contacts == 0);
    auto without = sheared<Dim>(BondOfBars::none, pass);
    without.run_until(3.0);
    // In one dimension the pressure rho c v turns the speed round in 2 L/c. Sides that part earlier by what a wave takes
    // through three quarters of a cell of each bar leave 1.5 cells/L of the speed out.
    CHECK(speed_of(scene, 0) < -(1.0 - 1.5 * cell<Dim>)*press);
    // G is 0.75 % of the energy of these speeds: 0.4 % of them. The rest is less than half a cell's time, 2.5 % or more.
    CHECK(speed_of(scene, 0) == Approx(speed_of(without, 0)).epsilon(0.02));
    CHECK(speed_of(scene, 1) == Approx(speed_of(without, 1)).epsilon(0.02));
    const Drifts drifts = scene.drifts();
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.momentum <= 1e-13);
    CHECK(drifts.pseudo_moment <= 1e-13);
}

TEMPLATE_TEST_CASE_SIG("blocks whose bond breaks under pressure are pressed and rubbed on as blocks without a bond are",
                       "[solid][bonds]", ((int Dim), Dim), 2, 3) {
    const auto bond = GENERATE(BondOfBars::springs, BondOfBars::grains);
    const auto kinematics =
        bond == BondOfBars::grains ? Kinematics::floating : GENERATE(Kinematics::floating, Kinematics::finite);
    CAPTURE(Dim, static_cast<int>(bond), static_cast<int>(kinematics));
    auto scene = rubbed<Dim>(bond, kinematics);
    scene.run_until(0.5);
    REQUIRE(scene.solid.bonds().broken_share() == 1.0);
    auto without = rubbed<Dim>(BondOfBars::none, kinematics);
    without.run_until(0.5);
    const auto lost = [](TurningScene<Dim>& of) {  // until the wave that parts them is back at 2
        const double start = of.memm.time();
        const Vector<Dim> before = velocity_of(of, 0);
        of.run_until(1.5);
        return Vector<Dim>((before - velocity_of(of, 0)) / (of.memm.time() - start));
    };
    // A block of length and density 1 that runs at v into its mirror image is pressed by p = rho c v = v. They slide off each
    // other by 1.5 % of their width, and the front of a wave overshoots by 18 % for half a cell: by 1.1 % or more of a time
    // of 1 as this begins and as it ends.
    const Vector<Dim> force = lost(scene), force_without = lost(without);
    CHECK(force[0] == Approx(press).epsilon(0.04));
    CHECK(force[1] == Approx(0.3 * force[0]).epsilon(0.03));
    CHECK(force[1] / force[0] == Approx(force_without[1] / force_without[0]).epsilon(0.01));
    // Contact of finite bodies is half as stiff as their bonds: half of the pressure is missing until a wave is through half a
    // cell, 3 % of this time or more.
    CHECK(force[0] == Approx(force_without[0]).epsilon(kinematics == Kinematics::finite ? 0.025 : 0.003));
    CHECK(scene.solid.contact().report().friction_dissipated > 0.0);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
    const Drifts drifts = scene.drifts();
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.momentum <= 1e-13);
    if (kinematics == Kinematics::floating) CHECK(drifts.pseudo_moment <= 1e-13);
}

TEMPLATE_TEST_CASE_SIG(
    "sides that break under pressure, and slide off each other, keep the balance to 1e-12, and the balance closes to 1e-12",
    "[solid][bonds]", ((int Dim), Dim), 2, 3) {
    const auto bond = GENERATE(BondOfBars::springs, BondOfBars::grains);
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating);
    CAPTURE(Dim, static_cast<int>(bond), static_cast<int>(kinematics));
    auto scene = sheared<Dim>(bond, 0.03, kinematics);
    scene.run_until(4.0);
    CHECK(scene.solid.bonds().broken_share() > 0.0);
    if (kinematics != Kinematics::small) {  // edges of small bodies bear no shear
        CHECK(scene.solid.bonds().broken_share() == 1.0);
        CHECK(scene.solid.contact().report().active_pairs_max > 0);
        CHECK(std::abs(scene.solid.bonds().beyond_fracture_energy()) <= by_law * fracture_energy * bonded_area<Dim>());
        auto without = sheared<Dim>(BondOfBars::none, 0.03, kinematics);
        without.run_until(4.0);
        CHECK(speed_of(scene, 0) == Approx(speed_of(without, 0)).epsilon(0.02));  // as above
        CHECK(speed_of(scene, 1) == Approx(speed_of(without, 1)).epsilon(0.02));
    }
    CHECK(speed_of(scene, 0) < -0.7 * press);
    CHECK(speed_of(scene, 1) > 0.7 * press);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
    const Drifts drifts = scene.drifts();
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.momentum <= 1e-13);
    if (kinematics != Kinematics::small) CHECK(drifts.pseudo_moment <= 1e-13);
}

TEMPLATE_TEST_CASE_SIG(
    "a run that stops while contact presses on the sides of broken places goes on with the same forces, bit by bit",
    "[solid][bonds]", ((int Dim), Dim), 2, 3) {
    const auto bond = GENERATE(BondOfBars::springs, BondOfBars::grains);
    CAPTURE(Dim, static_cast<int>(bond));
    auto whole = sheared<Dim>(bond, 0.006);
    whole.run_until(1.3);
    REQUIRE(whole.solid.bonds().broken_share() == 1.0);
    auto other = sheared<Dim>(bond, 0.006);
    other.solid.restore(whole.solid.state(), whole.memm.q());
    std::vector<double> expected(whole.solid.size()), found(expected);
    whole.solid.force(whole.memm.q(), expected);
    other.solid.force(whole.memm.q(), found);
    CHECK(largest(expected) > 0.1 * press * bonded_area<Dim>() / whole.solid.bonds().places().size());
    CHECK(found == expected);
}

TEST_CASE(
    "a bond of grains takes its fracture energy straight and in shear, each where half cells hold less at its strength",
    "[solid][bonds]") {
    const double poisson = GENERATE(0.0, 0.3), h = cell<2> * bar_length, area = bonded_area<2>();
    CAPTURE(poisson);
    // Half cells in series have the stiffness (lambda + 2 mu)/(2 h) straight and mu/(2 h) along the face, and hold
    // strength^2/2 over that.
    const double p_wave = (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), mu = 0.5 / (1.0 + poisson);
    const double straight = strength * strength * h / p_wave, along = strength * strength * h / mu;
    const auto moved = [&](BondOfBars bond, double pull, double pass, double energy) {
        auto scene = sheared<2>(bond, pass, Kinematics::floating, -pull, poisson, energy);
        scene.run_until(1.9);
        REQUIRE(scene.solid.bonds().broken_share() == 1.0);
        CHECK(scene.drifts().pseudo_energy <= 1e-12);
        const double taken = scene.solid.dissipated().in_bonds;
        CHECK(scene.solid.bonds().beyond_fracture_energy() == Approx(taken - energy * area).margin(1e-12 * energy * area));
        return taken / area;
    };
    CHECK_THROWS_WITH(moved(BondOfBars::grains, 0.003, 0.0, 0.999 * straight), Catch::Contains("would take these at once"));
    const double between = 0.75 * straight + 0.25 * along;
    CHECK(moved(BondOfBars::grains, 0.003, 0.0, between) == Approx(between).epsilon(by_law));
    CHECK(moved(BondOfBars::springs, 0.0, 0.003, between) == Approx(between).epsilon(by_law));  // as stiff in all directions
    CHECK(moved(BondOfBars::grains, 0.0, 0.003, 1.25 * along) == Approx(1.25 * along).epsilon(by_law));
    // Places lose what they hold as the step begins in which they reach their strength: up to 5 % below it, 10 % of energy.
    const double in_shear = moved(BondOfBars::grains, 0.0, 0.003, between);
    CHECK(in_shear <= along);
    CHECK(in_shear >= 0.9 * along);
}

TEST_CASE("sides press on each other along a step with the mean of its pressure, and no energy is lost as they part",
          "[solid][bonds]") {
    // By hand: from -2 to 1 the pressed part goes from -2 to 0, and half of its square from 2 to 0.
    const solid::PressedSides parting = solid::pressed_along(-2.0, 1.0);
    CHECK(parting.mean == -1.0);
    CHECK(parting.gradient == Approx(-2.0 / 3.0).epsilon(1e-15));
    CHECK(parting.slope == Approx(2.0 / 3.0).epsilon(1e-15));
    const solid::PressedSides pressed = solid::pressed_along(-2.0, -1.0), apart = solid::pressed_along(1.0, 2.0);
    CHECK(pressed.gradient == -1.5);
    CHECK(pressed.slope == 1.0);
    CHECK(apart.gradient == 0.0);
    CHECK(apart.slope == 0.0);
}

TEST_CASE("contact takes over what sides press with, at most what their bonds have lost, and a tenth of it at least",
          "[solid][bonds]") {
    CHECK(solid::handed_over_part(2.0, 3.0) == 1.0);
    CHECK(solid::handed_over_part(2.0, 2.0) == 1.0);
    CHECK(solid::handed_over_part(2.0, 1.0) == 0.5);
    CHECK(solid::handed_over_part(2.0, 0.1) == 0.1);
    CHECK(solid::handed_over_part(2.0, -1.0) == 0.1);
}

namespace {

/// Bonds between faces of which each covers but a part of the other: faces 0 and 1 of body 0, of measure 1, and 2 and 3 of
/// body 1, of 0.75 and 1.25.
struct PartialBonds {
    struct Place {
        std::array<std::size_t, 2> numbers;
        std::array<std::int32_t, 2> bodies;
        std::array<double, 2> measures;
        double area;
    };
    std::vector<Place> all{
        {{0, 2}, {0, 1}, {1.0, 0.75}, 0.75}, {{0, 3}, {0, 1}, {1.0, 1.25}, 0.25}, {{1, 3}, {0, 1}, {1.0, 1.25}, 1.0}};
    std::vector<bool> broken;

    [[nodiscard]] const std::vector<Place>& places() const { return all; }
    [[nodiscard]] bool is_broken(std::size_t place) const { return broken[place]; }
    [[nodiscard]] double pressed_energy(std::size_t place) const {
        return broken[place] ? std::array{4.0, 8.0, 6.0}[place] : 0.0;
    }
};

}  // namespace

TEST_CASE("faces that broke under pressure begin with the energy of their place, neighbours with the lesser mean of both",
          "[solid][bonds]") {
    using contact::Face;
    PartialBonds bonds{.broken = {true, true, true}};
    const solid::BondsOfFaces<PartialBonds> of_faces(bonds);
    const auto between = [&](int of_first, int of_second) {
        const double energy = of_faces.energy_at_first({Face{of_first}, Face{of_second}}, {0, 1});
        CHECK(of_faces.energy_at_first({Face{of_second}, Face{of_first}}, {1, 0}) == energy);
        return energy;
    };
    CHECK(between(0, 2) == 4.0);
    CHECK(between(0, 3) == 8.0);
    CHECK(between(1, 3) == 6.0);
    CHECK(between(1, 2) == 4.0);                                               // the lesser of 6 and 4
    CHECK(between(1, 7) == 0.0);                                               // the second was never bonded
    CHECK(of_faces.pressed_energy(Face{0}, 1) == 5.0);                         // (0.75 x 4 + 0.25 x 8)/1
    CHECK(of_faces.pressed_energy(Face{3}, 0) == Approx(6.4).epsilon(1e-15));  // (0.25 x 8 + 1 x 6)/1.25
    bonds.broken = {true, false, true};
    CHECK(of_faces.pressed_energy(Face{0}, Face{3}) == 0.0);  // it holds
    CHECK(of_faces.pressed_energy(Face{0}, 1) == 4.0);
    CHECK(of_faces.pressed_energy(Face{3}, 0) == 6.0);
}

TEST_CASE("a face is covered by its bonds where all of them hold and overlap all of it, and joined to a body by any",
          "[solid][bonds]") {
    using contact::Face;
    PartialBonds bonds{.broken = {false, false, false}};
    const solid::BondsOfFaces<PartialBonds> of_faces(bonds);
    for (const int face : {0, 1, 2, 3}) CHECK(of_faces.covers(Face{face}));
    CHECK_FALSE(of_faces.covers(Face{7}));
    CHECK(of_faces.joins(Face{3}, 0));
    CHECK_FALSE(of_faces.joins(Face{3}, 1));
    bonds.all[2].area = 0.9;
    for (const int face : {1, 3}) CHECK_FALSE(of_faces.covers(Face{face}));
    for (const int face : {0, 2}) CHECK(of_faces.covers(Face{face}));
    bonds.broken[1] = true;
    CHECK_FALSE(of_faces.covers(Face{0}));
    CHECK(of_faces.joins(Face{0}, 1));  // by the other place
    bonds.broken[0] = true;
    CHECK_FALSE(of_faces.joins(Face{0}, 1));
}

}  // namespace abut::test
