// Scenes of the project whose bodies break.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>

#include "abut/dynamics/ledger.hpp"
#include "abut/input/scene_file.hpp"
#include "abut/run/observer.hpp"
#include "abut/run/steps/simulation.hpp"
#include "support/keep.hpp"

namespace {

using namespace abut;

input::SceneFile scene_file(const std::string& name, const std::string& set = {}) {
    input::Overrides overrides;
    if (!set.empty()) overrides.set = {set};
    return input::SceneFile(std::filesystem::path(ABUT_SOURCE "/scenes") / (name + ".toml"), overrides);
}

template <int Dim>
run::RunResult<Dim> result_of(const std::string& name) {
    const input::SceneFile file = scene_file(name);
    return run::simulate<Dim>(file.scene<Dim>(), file.options());
}

/// Every run with break-up keeps this: pseudo-energy with what is dissipated and done from outside, contacts, and mass.
template <int Dim>
void check_balance(const run::RunResult<Dim>& result, double mass) {
    CHECK(result.ledger.pseudo_energy_drift() <= 1e-12 * result.ledger.largest_energy());
    CHECK(result.contact.missed_contacts == 0);
    CHECK(result.dissipated.in_bonds > 0.0);
    double of_fragments = 0.0;
    for (const auto& fragment : result.fragments) of_fragments += fragment.mass;
    CHECK(of_fragments == Approx(mass).epsilon(1e-11));  // meshes in files have twelve digits
}

}  // namespace

TEST_CASE("a ring that is blown apart has more fragments than Grady's energy makes, and no more than three times as many",
          "[input][scenes][fracture][long]") {
    // The ring is a spring of its radius: (p R/thickness) sin(t) is its rate as the pressure ends at 0.22 s.
    const double rate = 0.2 * std::sin(0.22), energy = 3.3e-6, thickness = 0.03;
    const double by_grady = 2.0 * std::numbers::pi / std::cbrt(24.0 * energy / (rate * rate));
    const auto result = result_of<2>("expanding_ring");
    // Its cells are straight: a ring of 628 corners.
    check_balance(result, 628.0 * std::sin(2.0 * std::numbers::pi / 628.0) * thickness);
    CHECK(static_cast<double>(result.fragments.size()) >= by_grady);
    CHECK(static_cast<double>(result.fragments.size()) <= 3.0 * by_grady);
}

TEST_CASE("a beam that is hit in its middle breaks into halves, and the crack takes its fracture energy",
          "[input][scenes][fracture][long]") {
    const double length = 0.4, height = 0.04, density = 1000.0, energy = 20.0, half_a_grain = 0.015;
    const auto result = result_of<2>("broken_beam");
    check_balance(result, length * height * density);
    REQUIRE(result.fragments.size() == 2);
    CHECK(result.fragments[0].mass == Approx(0.5 * length * height * density).margin(half_a_grain * height * density));
    CHECK(result.dissipated.in_bonds >= energy * height);
    CHECK(result.dissipated.in_bonds <= std::sqrt(2.0) * energy * height);  // of a crack that goes to and fro at 45 degrees
}

TEST_CASE("a plate spalls as deep as its striker is thick, and the piece has the speed of one dimension within 4 %",
          "[input][scenes][fracture][long]") {
    // The opening w obeys w' = 2 (tension - strength (1 - w/w_f)), and strength (1 - w/w_f) pulls at the piece.
    const double speed = 0.02, strength = 0.0075, energy = 8e-6, thickness = 0.3, width = 0.3;
    const double w_f = 2.0 * energy / strength, growth = 2.0 * strength / w_f;
    const double duration = std::log(1.0 + growth * w_f / (speed - 2.0 * strength)) / growth;
    const double of_piece = speed - 0.5 * (speed * duration - w_f) / thickness;
    const auto result = result_of<3>("spalling_plate");
    check_balance(result, 3.0 * thickness * width * width);
    REQUIRE(result.fragments.size() == 2);
    CHECK(result.fragments[1].mass == Approx(thickness * width * width).epsilon(1e-12));
    CHECK(result.fragments[1].velocity[0] == Approx(of_piece).epsilon(0.04));
    CHECK(result.ledger.momentum_drift() <= 1e-13 * speed * thickness * width * width);
}

TEST_CASE(
    "a ball that goes through a plate keeps a speed between those of one that takes its plug along and throws it ahead",
    "[input][scenes][fracture]") {
    const double speed = 20.0, plug = 0.1 * 0.03 * 2400.0;  // as wide as the ball
    const input::SceneFile file = scene_file("pierced_plate");
    const run::Scene<2> scene = file.scene<2>();
    const auto result = run::simulate<2>(scene, file.options());
    check_balance(result, 1.2 * 0.03 * 2400.0);
    const auto ball = std::ranges::find(scene.mesh.body_names, "ball") - scene.mesh.body_names.begin();
    const auto& end = result.end[static_cast<std::size_t>(ball)];
    CHECK(end.velocity[0] < speed * end.mass / (end.mass + plug));
    CHECK(end.velocity[0] > speed * (end.mass - plug) / (end.mass + plug));
    CHECK(result.ledger.momentum_drift() <= 1e-13 * speed * end.mass);
}

TEST_CASE("a disc that shatters on a floor keeps its energy with what breaks, rubs and falls",
          "[input][scenes][fracture][long]") {
    const auto result = result_of<2>("shattered_disc");
    const double radius = 0.1;
    double mass = 0.0;
    for (const auto& fragment : result.fragments) mass += fragment.mass;
    check_balance(result, mass);
    CHECK(mass == Approx(std::numbers::pi * radius * radius * 2500.0).epsilon(0.01));  // its rim is a polygon
    CHECK(result.fragments.size() >= 20);
    CHECK(result.ledger.entries().back().losses.by_friction > 0.0);
}

TEST_CASE("a wall whose mortar breaks is bitwise the same on one thread, and after a start from its state",
          "[input][scenes][fracture]") {
    const input::SceneFile file = scene_file("bonded_wall", "run.time=\"30 ms\"");
    const run::Scene<2> scene = file.scene<2>();
    run::RunOptions options = file.options();
    run::Observer<2> nobody;
    const auto whole = run::simulate<2>(scene, options, nobody);
    check_balance(whole, 28.0 * 0.239 * 0.07 * 1800.0);
    REQUIRE(whole.fragments.size() > 1);
    const auto check_same = [&](const run::RunResult<2>& other) {
        REQUIRE(other.ledger.entries().size() == whole.ledger.entries().size());
        CHECK(dynamics::ledger_values(other.ledger.entries().back()) ==
              dynamics::ledger_values(whole.ledger.entries().back()));
        REQUIRE(other.fragments.size() == whole.fragments.size());
        for (std::size_t i = 0; i < whole.fragments.size(); ++i)
            CHECK(other.fragments[i].velocity == whole.fragments[i].velocity);
    };
    test::Keep<2> keep(whole.steps / 2);
    options.threads = 1;
    check_same(run::simulate<2>(scene, options, keep));
    REQUIRE(keep.kept);
    options.threads = 2;
    check_same(run::simulate<2>(scene, options, nobody, &*keep.kept));
}
