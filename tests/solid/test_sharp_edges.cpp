// Sharp edges and corners of bodies in space.
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "abut/base/rotation.hpp"
#include "abut/contact/surface/blind_corners.hpp"
#include "abut/contact/surface/unseen_edges.hpp"
#include "abut/mesh/place.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A beam of prisms along x, its section a triangle of this height with the sharp edge down, of n rows of triangles; `length` in
/// `pieces`, the middle of the edge at 0.
mesh::Mesh<3> edged_beam(double angle, double height, int n, double length, int pieces) {
    mesh::CellSoup<3> soup;
    soup.name = "beam";
    soup.body_names = {"beam"};
    const int section = (n + 1) * (n + 2) / 2;
    const auto node = [&](int piece, int row, int i) { return piece * section + row * (row + 1) / 2 + i; };
    for (int piece = 0; piece <= pieces; ++piece)
        for (int row = 0; row <= n; ++row)
            for (int i = 0; i <= row; ++i) {
                const double z = height * row / n, width = 2.0 * z * std::tan(0.5 * angle);
                soup.vertices.push_back(
                    {length * (double(piece) / pieces - 0.5), row == 0 ? 0.0 : width * (double(i) / row - 0.5), z});
            }
    const auto append = [&](int piece, std::array<std::array<int, 2>, 3> corners) {
        std::vector<std::int32_t> vertices;
        for (const int side : {0, 1})
            for (const auto& [row, i] : corners) vertices.push_back(node(piece + side, row, i));
        soup.cell_shape.push_back(CellShape::prism);
        soup.cell_vertices.append(vertices);
        soup.cell_body.push_back(0);
    };
    for (int piece = 0; piece < pieces; ++piece)
        for (int row = 0; row < n; ++row)
            for (int i = 0; i <= row; ++i) {
                append(piece, {{{row, i}, {row + 1, i}, {row + 1, i + 1}}});
                if (i < row) append(piece, {{{row, i}, {row + 1, i + 1}, {row, i + 1}}});
            }
    return mesh::build_mesh<3>(std::move(soup));
}
/// Turned by half a turn about y + x: along y, the sharp edge up, just below the origin.
mesh::Mesh<3> crossed(mesh::Mesh<3> beam, double gap) {
    mesh::place<3>(beam, {{0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}}, {0.0, 0.0, -gap});
    return beam;
}

/// A tetrahedron of this height that stands on its corner at `tip`: the other corners are on a cone of this angle. Halved `times`
/// times, into 8 tetrahedra each time.
mesh::Mesh<3> cornered(double angle, double height, int times, const Vector<3>& tip) {
    mesh::CellSoup<3> soup;
    soup.name = "spike";
    soup.body_names = {"spike"};
    soup.vertices.push_back(tip);
    for (int i = 0; i < 3; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / 3.0, radius = height * std::tan(0.5 * angle);
        soup.vertices.push_back(tip + Vector<3>(radius * std::cos(turn), radius * std::sin(turn), height));
    }
    using Cell = std::array<std::int32_t, 4>;
    std::vector<Cell> cells{{1, 2, 3, 0}};
    for (int time = 0; time < times; ++time) {
        std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
        const auto middle = [&](std::int32_t a, std::int32_t b) {
            const auto [found, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(soup.vertices.size()));
            if (is_new) soup.vertices.push_back(0.5 * (soup.vertices[a] + soup.vertices[b]));
            return found->second;
        };
        std::vector<Cell> halves;
        for (const auto& [a, b, c, d] : cells) {
            const std::int32_t ab = middle(a, b), ac = middle(a, c), ad = middle(a, d), bc = middle(b, c), bd = middle(b, d),
                               cd = middle(c, d);
            for (const Cell& cell : {Cell{a, ab, ac, ad}, Cell{ab, b, bc, bd}, Cell{ac, bc, c, cd}, Cell{ad, bd, cd, d},
                                     Cell{ab, ac, ad, bd}, Cell{ab, bc, ac, bd}, Cell{ac, cd, ad, bd}, Cell{ac, bc, cd, bd}})
                halves.push_back(cell);
        }
        cells = std::move(halves);
    }
    for (Cell cell : cells) {
        const auto x = [&](int i) { return soup.vertices[cell[i]]; };
        if ((x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0)) < 0.0) std::swap(cell[0], cell[1]);
        soup.cell_shape.push_back(CellShape::tetrahedron);
        soup.cell_vertices.append(std::vector<std::int32_t>(cell.begin(), cell.end()));
        soup.cell_body.push_back(0);
    }
    return mesh::build_mesh<3>(std::move(soup));
}

struct Found {
    Vector<3> velocity;  // of the upper body against the lower one, over the speed at the start
    double depth;        // largest |g|/D
};

/// Runs until the bodies, the upper one coming down, have parted.
Found collide(TurningScene<3>& scene, double speed) {
    double depth = 0.0;
    while (scene.memm.time() < 1.5 / speed * 0.04 + 6.0) {
        scene.run(1);
        raise(depth, scene.solid.contact().compression());
    }
    const auto motions = solid::body_motions<3>(scene.memm, scene.solid);
    return {(motions[1].velocity - motions[0].velocity) / speed, depth};
}

TurningScene<3> crossing_beams(double lower, double upper, double across, double speed,
                               const std::vector<Kinematics>& kinematics, double cfl = 0.6) {
    auto options = bodies<3>(2);
    options.law = solid::ContactLaw::pair_potential;
    mesh::Mesh<3> above = edged_beam(upper * degree, 0.5, 3, 2.0, 8);
    mesh::place<3>(above, rotation_about(Vector<3>::UnitZ(), (90.0 - across) * degree), Vector<3>::Zero());
    return TurningScene<3>(together(crossed(edged_beam(lower * degree, 0.5, 3, 2.0, 9), 0.2 * speed), above), options,
                           {moving<3>({0.0, 0.0, 0.0}), moving<3>({0.0, 0.0, -speed})}, cfl, kinematics);
}

}  // namespace

// Without a bevel, edges of 45 degrees and less go through each other, those of 60 come back with 0.4 to 0.6 of their speed.
TEST_CASE("edges of 20 to 120 degrees that cross at 20 to 90 degrees part, and keep H~, momentum and J~", "[solid][sharp]") {
    const auto [lower, upper] = GENERATE(table<double, double>(
        {{20.0, 20.0}, {45.0, 45.0}, {60.0, 60.0}, {90.0, 30.0}, {70.0, 45.0}, {75.0, 60.0}, {120.0, 20.0}, {100.0, 20.0}}));
    const double across = GENERATE(90.0, 50.0, 20.0), speed = GENERATE(0.005, 0.02);
    CAPTURE(lower, upper, across, speed);
    TurningScene<3> scene = crossing_beams(lower, upper, across, speed, {Kinematics::floating, Kinematics::floating});
    CHECK_FALSE(scene.solid.contact().unseen_edges());
    const Found found = collide(scene, speed);
    check_collision(scene);
    CHECK(found.velocity[2] > 0.6);
    CHECK(std::abs(found.velocity[0]) + std::abs(found.velocity[1]) <= 0.05);
    CHECK(found.depth <= 0.5);
    CHECK(scene.drifts().energy_excess <= 0.03);
    CHECK(scene.drifts().parasitic <= speed);
}

TEST_CASE("sharp edges of finite, rigid and small bodies part as well", "[solid][sharp]") {
    const auto [upper, cfl] =
        GENERATE(table<Kinematics, double>({{Kinematics::finite, 0.3}, {Kinematics::rigid, 0.6}, {Kinematics::small, 0.6}}));
    const double angle = GENERATE(20.0, 45.0), speed = 0.02;
    CAPTURE(upper, angle);
    TurningScene<3> scene = crossing_beams(90.0, angle, 90.0, speed, {Kinematics::floating, upper}, cfl);
    const Found found = collide(scene, speed);
    CHECK(found.velocity[2] > 0.4);  // -1 where they go through each other
    CHECK(found.depth <= 0.5);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
    CHECK(scene.drifts().energy_excess <= 5e-3);
}

TEST_CASE("corners of 15 to 60 degrees that come down on a flat side part from it, straight and aside", "[solid][sharp]") {
    const auto [angle, aside] = GENERATE(table<double, double>({{15.0, 0.0}, {25.0, 1.0}, {40.0, 0.0}, {60.0, 1.0}}));
    const double speed = 0.02;
    CAPTURE(angle, aside);
    auto options = bodies<3>(2);
    options.law = solid::ContactLaw::pair_potential;
    TurningScene<3> scene(
        together(mesh::structured_box<3>({-0.75, -0.75, -0.5}, {0.75, 0.75, 0.0}, {9, 9, 3}, CellShape::hexahedron, "block"),
                 cornered(angle * degree, 1.0, 2, {0.03, 0.02, 0.2 * speed})),
        options, {moving<3>({0.0, 0.0, 0.0}), moving<3>({aside * speed, 0.0, -speed})}, 0.6);
    CHECK(scene.solid.contact().blind_corners().empty());
    const Found found = collide(scene, speed);
    check_collision(scene);
    CHECK(found.velocity[2] > 0.8);
    CHECK(found.velocity[0] == Approx(aside).margin(0.02));
    CHECK(found.depth <= 0.5);
    CHECK(scene.drifts().energy_excess <= 1e-3);
}
