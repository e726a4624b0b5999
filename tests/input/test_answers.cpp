// Scenes that are made of what another process knows of their mesh.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/answers.hpp"
#include "abut/base/error.hpp"
#include "input/scenes.hpp"

namespace {

using namespace abut;

template <int Dim>
bool same_conditions(const solid::BoundaryConditions<Dim>& a, const solid::BoundaryConditions<Dim>& b) {
    const auto same = [](const auto& p, const auto& q) {
        const Vector<Dim> x = Vector<Dim>::Constant(0.3);
        return p.group == q.group && p.value == q.value && bool(p.history) == bool(q.history) &&
               (!p.history || p.history(0.07, x) == q.history(0.07, x));
    };
    return std::ranges::equal(a.dirichlet, b.dirichlet, same) && std::ranges::equal(a.traction, b.traction, same);
}

template <int Dim>
bool same_obstacles(const run::Scene<Dim>& a, const run::Scene<Dim>& b) {
    return std::ranges::equal(a.solid.obstacles, b.solid.obstacles,
                              [](const auto& p, const auto& q) { return p.faces == q.faces; }) &&
           a.outputs.obstacles == b.outputs.obstacles;
}

template <int Dim>
bool same_pairs(const solid::SolidOptions<Dim>& a, const solid::SolidOptions<Dim>& b) {
    const auto same_bodies = [](const auto& p, const auto& q) { return p.bodies == q.bodies; };
    const auto same_bond = [](const solid::Bond& p, const solid::Bond& q) {
        return p.sides == q.sides && p.strength == q.strength && p.seed == q.seed && p.of_grains == q.of_grains;
    };
    return a.ignored_pairs == b.ignored_pairs && std::ranges::equal(a.body_friction, b.body_friction, same_bodies) &&
           std::ranges::equal(a.interference, b.interference, same_bodies) &&
           std::ranges::equal(a.bonds, b.bonds, same_bond);
}

template <int Dim>
std::vector<std::string> names_of_groups(const mesh::Mesh<Dim>& mesh) {
    std::vector<std::string> names;
    for (const mesh::BoundaryGroup& group : mesh.groups) names.push_back(group.name);
    return names;
}

template <int Dim>
void check_same(const input::SceneFile& file) {
    Answers found;
    const run::Scene<Dim> whole = file.scene<Dim>(found);
    Answers given(std::move(found).kept());
    const run::Scene<Dim> other = file.scene<Dim>(given);
    REQUIRE(whole.mesh.n_cells() > 0);
    CHECK(other.mesh.n_cells() == 0);
    CHECK(other.mesh.vertices.empty());
    CHECK(other.mesh.body_names == whole.mesh.body_names);
    CHECK(names_of_groups(other.mesh) == names_of_groups(whole.mesh));
    CHECK(other.mesh.report.joined_bodies == whole.mesh.report.joined_bodies);
    CHECK(other.velocity == whole.velocity);
    CHECK(other.spin == whole.spin);
    CHECK(other.solid.kinematics == whole.solid.kinematics);
    CHECK(other.solid.materials.size() == whole.solid.materials.size());
    CHECK(other.solid.springs.size() == whole.solid.springs.size());
    CHECK(other.outputs.probes.size() == whole.outputs.probes.size());
    CHECK(same_conditions<Dim>(other.solid.boundary, whole.solid.boundary));
    CHECK(same_obstacles(other, whole));
    CHECK(same_pairs(other.solid, whole.solid));
}

}  // namespace

TEST_CASE("a scene made of answers about its mesh has all of the scene but the cells", "[input][scenes]") {
    // Planes of symmetry, pressures on curved sides, endless planes, bonds of copies, grains, regions that turn
    const std::string name = GENERATE("half_punch", "closing_clip", "bonded_wall", "shattered_disc", "tyred_wheel",
                                      "crushed_lattice", "hertz", "pile", "gears");
    CAPTURE(name);
    const input::SceneFile file(ABUT_SOURCE "/scenes/" + name + ".toml");
    if (file.dimension() == 2)
        check_same<2>(file);
    else
        check_same<3>(file);
}

TEST_CASE("a body of several regions that turns has the velocities of its regions from answers as well", "[input][scenes]") {
    const test::WrittenScene written(test::two_blocks(R"toml([bodies.wheel]
shape = "structured_box"
lower = [5, 0]
upper = [9, 2]
counts = [8, 4]
young = 1
density = 1
spin = 3
[bodies.wheel.heavy]
region = "x < 6"
young = 1
density = 7
)toml"));
    const input::SceneFile file(written.path());
    const run::Scene<2> scene = file.scene<2>();
    REQUIRE(scene.velocity[2] != scene.velocity[3]);
    check_same<2>(file);
}

TEST_CASE("answers to other questions are refused", "[input][scenes]") {
    Answers found;
    CHECK(found.of([] { return 7; }) == 7);
    Answers given(std::move(found).kept());
    CHECK(given.of([]() -> int { throw Misuse("asked"); }) == 7);
    CHECK_THROWS_AS(given.of([] { return 8; }), BadInput);
}
