#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::two_blocks;
using test::WrittenScene;

/// Outwards of a closed outline or surface: sum of n . (x - middle) over its faces, each of which has one sign.
int outward(const std::vector<Vector<2>>& face, const Vector<2>& middle) {
    const Vector<2> along = face[1] - face[0];
    return Vector<2>(along.y(), -along.x()).dot(face[0] - middle) > 0.0 ? 1 : -1;
}
int outward(const std::vector<Vector<3>>& face, const Vector<3>& middle) {
    return (face[1] - face[0]).cross(face[2] - face[0]).dot(face[0] - middle) > 0.0 ? 1 : -1;
}

}  // namespace

TEST_CASE("obstacles face outwards, or inwards where bodies are inside, and follow their paths", "[input][scenes]") {
    const WrittenScene written(two_blocks(R"toml([obstacles.stone]
shape = "polygon"
corners = [[0, -3], [0, -2], [1, -2]]
path = ["0.1*sin(t)", "t^2"]
[obstacles.room]
shape = "box"
lower = [-9, -9]
upper = [9, 9]
inside = true
velocity = [2, 0]
[obstacles.floor]
shape = "plane"
point = [0, -1]
normal = [0, 2]
half_width = 4
)toml"));
    const auto obstacles = input::SceneFile(written.path()).scene<2>().solid.obstacles;
    REQUIRE(obstacles.size() == 3);
    CHECK(obstacles[0].faces.size() == 3);
    for (const auto& face : obstacles[0].faces) CHECK(outward(face, Vector<2>(0.3, -2.3)) == 1);  // given clockwise
    CHECK(obstacles[1].faces.size() == 4);
    for (const auto& face : obstacles[1].faces) CHECK(outward(face, Vector<2>::Zero()) == -1);
    CHECK((obstacles[0].path(0.5) - Vector<2>(0.1 * std::sin(0.5), 0.25)).norm() < 1e-16);
    CHECK(obstacles[1].path(1.5) == Vector<2>(3.0, 0.0));
    CHECK_FALSE(obstacles[2].path);
    CHECK(outward(obstacles[2].faces[0], Vector<2>(0.0, -2.0)) == 1);
    CHECK((obstacles[2].faces[0][1] - obstacles[2].faces[0][0]).norm() == Approx(8.0));
}

TEST_CASE("the faces of an obstacle in space face outwards, of a room inwards", "[input][scenes]") {
    const WrittenScene written(R"toml(dim = 3
bodies.ball = {shape = "sphere", radius = 1, size = 1, young = 1, density = 1}
obstacles.stone = {shape = "box", lower = [2, 0, 0], upper = [3, 1, 2]}
obstacles.room = {shape = "box", lower = [-4, -4, -4], upper = [4, 4, 4], inside = true}
run.steps = 1
)toml");
    const auto obstacles = input::SceneFile(written.path()).scene<3>().solid.obstacles;
    REQUIRE(obstacles.size() == 2);
    CHECK(obstacles[0].faces.size() == 6);
    for (const auto& face : obstacles[0].faces) CHECK(outward(face, Vector<3>(2.5, 0.5, 1.0)) == 1);
    for (const auto& face : obstacles[1].faces) CHECK(outward(face, Vector<3>::Zero()) == -1);
}

TEST_CASE("an obstacle turns about its pivot, or about its middle, while it moves", "[input][scenes]") {
    const WrittenScene written(two_blocks(R"toml([obstacles.paddle]
shape = "box"
lower = [-1, 0]
upper = [1, 2]
place = [0, 5]
turn = "pi/2"
rotation = "pi/2*t"
pivot = [3, 5]
velocity = [0, 1]
[obstacles.wheel]
shape = "polygon"
corners = [[0, -3], [0, -2], [1, -2]]
spin = 2
)toml"));
    const auto obstacles = input::SceneFile(written.path()).scene<2>().solid.obstacles;
    REQUIRE(obstacles.size() == 2);
    // At rest the paddle is turned by a quarter about its origin: x from -2 to 0, y from 4 to 6.
    double left = 0.0, top = 0.0;
    for (const auto& face : obstacles[0].faces)
        for (const auto& corner : face) left = std::min(left, corner.x()), top = std::max(top, corner.y());
    CHECK(left == Approx(-2.0));
    CHECK(top == Approx(6.0));
    CHECK((obstacles[0].placement(1.0)(Vector<2>(-2.0, 5.0)) - Vector<2>(3.0, 1.0)).norm() < 1e-14);
    const Vector<2> middle(0.5, -2.5);
    CHECK((obstacles[1].placement(0.3)(middle) - middle).norm() < 1e-14);
    CHECK(obstacles[1].placement(0.3).turn(1, 0) == Approx(std::sin(0.6)));
}

TEST_CASE("an obstacle of a surface file faces outwards, scaled, turned and placed", "[input][scenes]") {
    const WrittenScene written(fmt::format(R"toml(dim = 3
bodies.ball = {{shape = "sphere", radius = 1, size = 1, place = [0, 0, 9], young = 1, density = 1}}
obstacles.stone = {{surface = "{0}/scenes/ball.stl", unit = "cm", place = [0, 0, 5]}}
obstacles.shell = {{surface = "{0}/scenes/ball.stl", scale = 1, place = [0, 0, 9], inside = true, rotation = [0, "t", 0]}}
run.steps = 1
)toml",
                                           ABUT_SOURCE));
    const auto obstacles = input::SceneFile(written.path()).scene<3>().solid.obstacles;
    REQUIRE(obstacles.size() == 2);
    REQUIRE(obstacles[0].faces.size() == 80);
    for (const auto& face : obstacles[0].faces) {
        CHECK(outward(face, Vector<3>(0.0, 0.0, 5.0)) == 1);
        CHECK((face[0] - Vector<3>(0.0, 0.0, 5.0)).norm() == Approx(1.0).epsilon(1e-3));  // 100 mm in the file
    }
    for (const auto& face : obstacles[1].faces) CHECK(outward(face, Vector<3>(0.0, 0.0, 9.0)) == -1);
    CHECK(obstacles[1].placement(0.25).turn(0, 2) == Approx(std::sin(0.25)));
}

TEST_CASE("in space a body in a closed obstacle, across its skin, or outside of a hollow one overlaps it",
          "[input][obstacles]") {
    const auto faults = [](const std::string& obstacle) {
        const WrittenScene written(fmt::format(R"toml(dim = 3
energy_scale = 1
[bodies.block]
shape = "structured_box"
lower = [-1, -1, -1]
upper = [1, 1, 1]
counts = [2, 2, 2]
young = 1
density = 1
[run]
steps = 1
[obstacles.stone]
surface = "{}/scenes/ball.stl"   # of radius 100
{}
)toml",
                                               ABUT_SOURCE, obstacle));
        return input::text_of(input::check_scene(written.path()).faults);
    };
    const double corner = std::sqrt(3.0);
    CHECK(faults("scale = 0.05").find("the whole body is inside of it") != std::string::npos);  // of radius 5
    CHECK(faults("scale = 0.05\nplace = [5, 0, 0]").find("m inside a cell") != std::string::npos);
    CHECK(faults("scale = 0.005").find("m inside a cell") != std::string::npos);  // the other way round
    CHECK(faults("scale = 0.05\nplace = [9, 0, 0]\ninside = true").find("outside of its room") != std::string::npos);
    CHECK(faults("scale = 0.05\ninside = true").empty());
    CHECK(faults(fmt::format("scale = 0.01\nplace = [{0}, {0}, {0}]", 1.001 * (1.0 + 1.0 / corner))).empty());
    CHECK(faults("scale = 0.05\nplace = [5, 0, 0]\npath = [9, 0, \"t\"]").empty());  // it starts elsewhere
}

TEST_CASE("a body that touches an obstacle, is behind one with a rim, or in a hollow one, does not overlap it",
          "[input][obstacles]") {
    for (const char* obstacle :
         {"shape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]",                                      // they stand on it
          "shape = \"plane\"\npoint = [0, 3]\nnormal = [0, 1]\nhalf_width = 9",                      // far behind it
          "shape = \"plane\"\npoint = [0, 3]\nnormal = [0, 1]\nvelocity = [0, -1]",                  // it comes from behind
          "shape = \"plane\"\npoint = [0.5, 0.5]\nnormal = [0, 1]\nplace = [5, 0]\nhalf_width = 1",  // beside them
          "shape = \"box\"\nlower = [0, 0]\nupper = [2.5, 1]\ninside = true",                        // they fill it
          "shape = \"box\"\nlower = [1, 0]\nupper = [1.5, 1]",                                       // it fills the gap
          "shape = \"polygon\"\ncorners = [[-2, -1], [4, -1], [4, 3], [3, 3], [3, 0], [-1, 0], [-1, 3], [-2, 3]]",
          "shape = \"box\"\nlower = [0, 0]\nupper = [1, 1]\npath = [9, \"t\"]"}) {  // elsewhere at the start
        CAPTURE(obstacle);
        const WrittenScene written(two_blocks(std::string("[obstacles.one]\n") + obstacle));
        const auto checked = input::check_scene(written.path());
        CAPTURE(input::text_of(checked.faults));
        CHECK(checked.faults.empty());
    }
}

TEST_CASE("a plane without a half width has no end, and turns about its point", "[input][obstacles]") {
    const WrittenScene written(R"toml(dim = 3
bodies.cube = {shape = "structured_box", lower = [3, 0, 0.1], upper = [3.2, 0.2, 0.3], counts = [2, 2, 2], young = 1, density = 1}
obstacles.floor = {shape = "plane", point = [7, -5, 0], normal = [0, 0, 3]}
obstacles.slope = {shape = "plane", point = [0, 0, -1], normal = [-1, 0, 1], place = [0, 0, -4], spin = [0, 0, 1]}
run.steps = 1
)toml");
    const auto obstacles = input::SceneFile(written.path()).scene<3>().solid.obstacles;
    const double size = 0.2 * std::sqrt(3.0);
    for (const auto& obstacle : obstacles) {
        REQUIRE(obstacle.faces.size() == 1);  // no seam
        CHECK(obstacle.faces[0].size() == 3);
    }
    // It holds what is a thousand sizes of the scene away from the body, in every direction.
    for (int i = 0; i < 12; ++i) {
        const Vector<3> away(std::cos(0.5236 * i), std::sin(0.5236 * i), 0.0);
        const auto& corners = obstacles[0].faces[0];
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(corners[k].z() == 0.0);
            const Vector<3> edge = corners[(k + 1) % 3] - corners[k];
            CHECK(edge.cross(Vector<3>(Vector<3>(3.1, 0.1, 0.0) + 1000.0 * size * away - corners[k])).z() > 0.0);
        }
    }
    CHECK((obstacles[1].placement(0.7)(Vector<3>(0.0, 0.0, -5.0)) - Vector<3>(0.0, 0.0, -5.0)).norm() < 1e-14);
}

TEST_CASE("a body behind a plane without end is a fault that says which normal to give", "[input][obstacles]") {
    const auto faults = [](const std::string& more) {
        const WrittenScene written(two_blocks("[obstacles.floor]\nshape = \"plane\"\n" + more));
        return input::text_of(input::check_scene(written.path()).faults);
    };
    const std::string found = faults("point = [0, 0]\nnormal = [0, -1]");
    for (const char* words : {"body 'left' is behind obstacle 'floor'", "body 'right'", "normal = [0, 1]", "ignored_pairs"})
        CHECK(found.find(words) != std::string::npos);
    CHECK(faults("point = [0, 0]\nnormal = [0, 1]").empty());
    CHECK(faults("point = [1.25, 0]\nnormal = [1, 0]").find("body 'right'") ==
          std::string::npos);  // one of them is in front
    CHECK(faults("point = [0, 0]\nnormal = [0, -1]\n[contact]\nignored_pairs = [[\"left\", \"floor\"], [\"right\", "
                 "\"floor\"]]")
              .empty());
}

TEST_CASE("a surface that looks to both sides is no obstacle", "[input][obstacles]") {
    const auto faults = [](const std::string& obj) {
        const auto file = std::filesystem::temp_directory_path() / ("both_sides_" + std::to_string(getpid()) + ".obj");
        std::ofstream(file) << obj;
        const WrittenScene written(fmt::format(R"toml(dim = 3
bodies.cube = {{shape = "structured_box", lower = [0, 0, 5], upper = [1, 1, 6], counts = [2, 2, 2], young = 1, density = 1}}
obstacles.stone = {{surface = "{}"}}
run.steps = 1
)toml",
                                               file.string()));
        const std::string text = input::text_of(input::check_scene(written.path()).faults);
        std::filesystem::remove(file);
        return text;
    };
    const auto tetrahedron = [](double x, int first, bool turned) {
        std::string text;
        for (const auto& [y, z] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1)})
            text += fmt::format("v {} {} {}\n", x, y, z);
        text += fmt::format("v {} 0 0\n", x + 1.0);
        for (const auto& [a, b, c] : {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{0, 3, 2}, std::array{1, 2, 3}})
            text += fmt::format("f {} {} {}\n", first + a, first + (turned ? c : b), first + (turned ? b : c));
        return text;
    };
    CHECK(faults(tetrahedron(0.0, 1, false) + tetrahedron(4.0, 5, false)).empty());
    CHECK(faults(tetrahedron(0.0, 1, true) + tetrahedron(4.0, 5, true)).empty());  // all of it the other way round
    const std::string found = faults(tetrahedron(0.0, 1, false) + tetrahedron(8.0, 5, false) + tetrahedron(4.0, 9, true));
    CHECK(found.find("looks inwards") != std::string::npos);
    // Two triangles of an open sheet that disagree along their edge.
    CHECK(faults("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\n").find("different sides") != std::string::npos);
    CHECK(faults("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n").empty());
}
