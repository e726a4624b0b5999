#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::two_blocks;
using test::WrittenScene;

/// A brick of 2 x 1 m at the origin, and what is given.
std::string brick_and(const std::string& more) {
    return R"toml(dim = 2
[bodies.brick]
shape = "structured_box"
lower = [0, 0]
upper = [2, 1]
counts = [2, 2]
young = 1e6
density = 1000
velocity = [3, 0]
)toml" + more +
           "\n[run]\nsteps = 1\n";
}

template <int Dim>
run::Scene<Dim> scene_of(const std::string& text) {
    const WrittenScene written(text);
    const auto checked = input::check_scene(written.path());
    CAPTURE(input::text_of(checked.faults));
    REQUIRE(checked.faults.empty());
    return input::SceneFile(written.path()).scene<Dim>();
}

std::vector<input::Fault> faults_of(const std::string& text) {
    const WrittenScene written(text);
    return input::check_scene(written.path()).faults;
}

/// Volume times centroid over volume, of each body.
template <int Dim>
std::vector<Vector<Dim>> centroids(const mesh::Mesh<Dim>& mesh) {
    std::vector<Vector<Dim>> sums(mesh.body_names.size(), Vector<Dim>::Zero());
    std::vector<double> volumes(mesh.body_names.size(), 0.0);
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[cell]);
        sums[body] += mesh.cell_measure[cell] * mesh.cell_centroid[cell];
        volumes[body] += mesh.cell_measure[cell];
    }
    for (std::size_t body = 0; body < sums.size(); ++body) sums[body] /= volumes[body];
    return sums;
}

Vector<2> turned(const Vector<2>& x, double angle) {
    return {std::cos(angle) * x.x() - std::sin(angle) * x.y(), std::sin(angle) * x.x() + std::cos(angle) * x.y()};
}

}  // namespace

TEST_CASE("a grid has its copies at their steps, every second course shifted", "[input][patterns]") {
    const auto scene = scene_of<2>(
        brick_and("[[patterns]]\nbody = \"brick\"\ncount = [3, 4]\nstep = [2.1, 1.05]\nshift = [\"105 cm\", 0]\n"));
    const auto middle = centroids(scene.mesh);
    REQUIRE(scene.mesh.n_bodies() == 12);
    std::size_t body = 0;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 3; ++i, ++body) {
            CHECK(scene.mesh.body_names[body] == fmt::format("brick_{}_{}", i, j));
            CHECK(middle[body].isApprox(Vector<2>(1.0 + 2.1 * i + (j % 2 == 1 ? 1.05 : 0.0), 0.5 + 1.05 * j), 1e-14));
            CHECK(scene.velocity[body] == Vector<2>(3.0, 0.0));
        }
}

TEST_CASE("a row goes along its step, in three dimensions as in two", "[input][patterns]") {
    const auto scene = scene_of<3>(R"toml(dim = 3
[bodies.cube]
shape = "structured_box"
lower = [0, 0, 0]
upper = [1, 1, 1]
counts = [2, 2, 2]
young = 1
density = 1
place = [7, 0, 0]
[[patterns]]
body = "cube"
count = 3
step = [0, 1, 2]
shift = [4, 0, 0]
[run]
steps = 1
)toml");
    const auto middle = centroids(scene.mesh);
    REQUIRE(middle.size() == 3);
    CHECK(scene.mesh.body_names[2] == "cube_2");
    CHECK(middle[0].isApprox(Vector<3>(7.5, 0.5, 0.5), 1e-14));
    CHECK(middle[1].isApprox(Vector<3>(11.5, 1.5, 2.5), 1e-14));
    CHECK(middle[2].isApprox(Vector<3>(7.5, 2.5, 4.5), 1e-14));
}

TEST_CASE("a ring turns each copy about its centre, with its velocity", "[input][patterns]") {
    const auto scene =
        scene_of<2>(brick_and("place = [5, -1]\n[[patterns]]\nbody = \"brick\"\ncount = 6\ncentre = [1, 2]\n"));
    const auto middle = centroids(scene.mesh);
    REQUIRE(middle.size() == 6);
    const Vector<2> centre(1.0, 2.0), first(6.0, -0.5);
    for (std::size_t i = 0; i < 6; ++i) {
        const double angle = std::numbers::pi / 3.0 * static_cast<double>(i);
        CHECK(middle[i].isApprox(centre + turned(first - centre, angle), 1e-13));
        CHECK((scene.velocity[i] - turned({3.0, 0.0}, angle)).norm() < 1e-14);
        // A corner of the turned box itself
        const Vector<2> corner = centre + turned(Vector<2>(5.0, -1.0) - centre, angle);
        const auto& vertices = scene.mesh.vertices;
        CHECK(std::ranges::any_of(vertices, [&](const Vector<2>& x) { return (x - corner).norm() < 1e-13; }));
    }
}

TEST_CASE("a ring in space turns about its axis by its angle, after the turn of the body itself", "[input][patterns]") {
    const auto scene = scene_of<3>(R"toml(dim = 3
[bodies.rod]
shape = "structured_box"
lower = [0, 0, 0]
upper = [3, 1, 1]
counts = [3, 2, 2]
young = 1
density = 1
place = [10, 0, 0]
turn = [0, 0, "90 deg"]
velocity = [0, 2, 0]
[[patterns]]
body = "rod"
count = 2
centre = [0, 0, 5]
angle = ["90 deg", 0, 0]
[run]
steps = 1
)toml");
    const auto middle = centroids(scene.mesh);
    REQUIRE(middle.size() == 2);
    CHECK(middle[0].isApprox(Vector<3>(9.5, 1.5, 0.5), 1e-13));  // (x, y) of the rod goes to (-y, x)
    CHECK(middle[1].isApprox(Vector<3>(9.5, 4.5, 6.5), 1e-13));  // (y, z - 5) goes to (-(z - 5), y)
    CHECK((scene.velocity[1] - Vector<3>(0.0, 0.0, 2.0)).norm() < 1e-14);
}

TEST_CASE("places and turns are those of a table", "[input][patterns]") {
    const auto scene =
        scene_of<2>(brick_and("[[patterns]]\nbody = \"brick\"\nplaces = [[0, 0], [10, 0], [\"20 m\", 5]]\nturns = [0, \"90 "
                              "deg\", \"180 deg\"]\n"));
    const auto middle = centroids(scene.mesh);
    REQUIRE(middle.size() == 3);
    CHECK(middle[0].isApprox(Vector<2>(1.0, 0.5), 1e-14));
    CHECK(middle[1].isApprox(Vector<2>(9.5, 1.0), 1e-14));
    CHECK(middle[2].isApprox(Vector<2>(19.0, 4.5), 1e-14));
    CHECK(scene.velocity[1] == Vector<2>(3.0, 0.0));
}

TEST_CASE("a pattern makes bitwise the bodies that tables of their own make", "[input][patterns]") {
    const auto pattern =
        scene_of<2>(brick_and("[[patterns]]\nbody = \"brick\"\ncount = [2, 2]\nstep = [2.1, 1.05]\nshift = [0.3, 0]\n"));
    std::string tables = "dim = 2\n[run]\nsteps = 1\n";
    for (const auto& [name, place] : std::vector<std::pair<std::string, std::string>>{{"brick_0_0", "0, 0"},
                                                                                      {"brick_1_0", "2.1, 0"},
                                                                                      {"brick_0_1", "0.3, 1.05"},
                                                                                      {"brick_1_1", "\"2.1 + 0.3\", 1.05"}})
        tables += fmt::format(
            "[bodies.{}]\nshape = \"structured_box\"\nlower = [0, 0]\nupper = [2, 1]\ncounts = [2, 2]\n"
            "young = 1e6\ndensity = 1000\nvelocity = [3, 0]\nplace = [{}]\n",
            name, place);
    const auto written = scene_of<2>(tables);
    CHECK(pattern.mesh.body_names == written.mesh.body_names);
    CHECK(std::ranges::equal(pattern.mesh.vertices, written.mesh.vertices));
    CHECK(pattern.velocity == written.velocity);
}

TEST_CASE("loads, friction and ignored pairs of a copied body are those of all copies", "[input][patterns]") {
    const auto scene = scene_of<2>(brick_and(R"toml([[patterns]]
body = "brick"
count = 3
step = [2.5, 0]
[obstacles.floor]
shape = "plane"
point = [0, -1]
normal = [0, 1]
[tractions.push]
group = "brick.xmin"
value = [1, 0]
[supports.hold]
group = "brick_1.ymin"
[contact]
ignored_pairs = [["brick", "brick"]]
[[contact.pairs]]
bodies = ["brick", "floor"]
friction = 0.3
)toml"));
    CHECK(scene.solid.boundary.traction.size() == 3);
    CHECK(scene.solid.boundary.traction[2].group == "brick_2.xmin");
    CHECK(scene.solid.boundary.dirichlet.size() == 1);
    CHECK(scene.solid.ignored_pairs.size() == 3);  // of three bodies
    REQUIRE(scene.solid.body_friction.size() == 3);
    for (std::int32_t i = 0; i < 3; ++i)
        CHECK(scene.solid.body_friction[static_cast<std::size_t>(i)].bodies == std::array{i, 3});
}

TEST_CASE("a bond of bricks with each other holds those that lie side by side, and not those that touch with an edge",
          "[input][patterns]") {
    const auto wall = [](const std::string& step, const std::string& shift) {
        return brick_and("[[patterns]]\nbody = \"brick\"\ncount = [3, 4]\nstep = [" + step + ", 1.001]\n" + shift +
                         "[[bonds]]\nbodies = [\"brick\", \"brick\"]\nstrength = 5\n");
    };
    const auto n_bonds = [](const std::string& text) {
        const WrittenScene written(text);
        return input::SceneFile(written.path()).scene<2>().solid.bonds.size();
    };
    CHECK(n_bonds(wall("2.001", "")) == 4 * 2 + 3 * 3);                        // each on the one below
    CHECK(n_bonds(wall("2.001", "shift = [1, 0]\n")) == 4 * 2 + 3 * (3 + 2));  // each on two, but for one end of a course
    const auto faults = faults_of(wall("4", "").replace(wall("4", "").find("1.001"), 5, "3"));
    REQUIRE(faults.size() == 1);
    CHECK(faults.front().text.find("no two of the copies lie side by side") != std::string::npos);
}

TEST_CASE("bodies of a pattern that overlap are one fault, at the pattern", "[input][patterns]") {
    const auto faults = faults_of(brick_and("[[patterns]]\nbody = \"brick\"\ncount = 5\nstep = [1.5, 0]\n"));
    REQUIRE(faults.size() == 1);
    CHECK(faults.front().where.find(".toml:10:") != std::string::npos);
    for (const char* word : {"'brick_0' and 'brick_1' overlap", "0.5 m inside", "with patterns[0]. 3 more pairs"})
        CHECK(faults.front().text.find(word) != std::string::npos);
}

TEST_CASE("cells of all copies are counted before anything is made", "[input][patterns]") {
    const auto faults = faults_of(R"toml(dim = 2
[bodies.brick]
shape = "structured_box"
lower = [0, 0]
upper = [1, 1]
counts = [1000, 1000]
young = 1
density = 1
[[patterns]]
body = "brick"
count = [200, 200]
step = [1, 1]
[run]
steps = 1
)toml");  // 4e10 cells
    REQUIRE(faults.size() == 1);
    CHECK(faults.front().text.find("patterns[0] makes 40000 of it") != std::string::npos);
    CHECK(faults.front().text.find("most_cells") != std::string::npos);
    const auto many = faults_of(brick_and("[[patterns]]\nbody = \"brick\"\ncount = [100000, 100000]\nstep = [1, 1]\n"));
    REQUIRE(many.size() == 1);
    CHECK(many.front().text.find("patterns[0] makes 1e+10 bodies, at most 100000 are made") != std::string::npos);
    const std::string few = "most_cells = 15\n[[patterns]]\nbody = \"brick\"\ncount = 4\nstep = [3, 0]\n";
    CHECK(faults_of(brick_and(few)).size() == 1);  // 16 cells
    CHECK(faults_of(brick_and("most_cells = 16\n" + few.substr(16))).empty());
}
