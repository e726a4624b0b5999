// Sharp tips of bodies and obstacles in the plane.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "abut/contact/surface/blind_corners.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

/// A triangle of this height with its tip down, of n rows of triangles.
mesh::Mesh<2> wedge(double angle, double height, int n, const Vector<2>& tip) {
    mesh::CellSoup<2> soup;
    soup.name = "wedge";
    soup.body_names = {"wedge"};
    const auto node = [](int row, int i) { return row * (row + 1) / 2 + i; };
    for (int row = 0; row <= n; ++row)
        for (int i = 0; i <= row; ++i) {
            const double y = height * row / n, width = 2.0 * y * std::tan(0.5 * angle);
            soup.vertices.push_back(tip + Vector<2>(row == 0 ? 0.0 : width * (double(i) / row - 0.5), y));
        }
    const auto append = [&](std::vector<std::int32_t> corners) {
        soup.cell_shape.push_back(CellShape::triangle);
        soup.cell_vertices.append(corners);
        soup.cell_body.push_back(0);
    };
    for (int row = 0; row < n; ++row)
        for (int i = 0; i <= row; ++i) {
            append({node(row, i), node(row + 1, i + 1), node(row + 1, i)});
            if (i < row) append({node(row, i), node(row, i + 1), node(row + 1, i + 1)});
        }
    return mesh::build_mesh<2>(std::move(soup));
}
mesh::Mesh<2> block(const Vector<2>& lower, const Vector<2>& upper) {
    return mesh::structured_box<2>(lower, upper, {12, 4}, CellShape::triangle, "block");
}

}  // namespace

TEST_CASE("a cell at a corner of 60 degrees or more has affine traces in a thick part, and one at a sharper tip has none",
          "[solid][tips]") {
    const auto [degrees, is_affine] =
        GENERATE(std::pair(10.0, false), std::pair(59.0, false), std::pair(61.0, true), std::pair(90.0, true));
    CAPTURE(degrees);
    const auto mesh = wedge(degrees * std::numbers::pi / 180.0, 1.0, 8, Vector<2>::Zero());
    const std::vector<solid::Material> material{{.young = 1.0, .poisson = 0.3, .density = 1.0}};
    const auto lowest = std::ranges::min_element(mesh.cell_centroid, {}, [](const Vector<2>& x) { return x[1]; });
    solid::BoundaryConditions<2> conditions;
    conditions.thick_cells = {static_cast<std::int32_t>(lowest - mesh.cell_centroid.begin())};
    solid::Ccg<2> thick(mesh, material, conditions), thin(mesh, material, {});
    const auto u = random_vectors<2>(static_cast<std::size_t>(mesh.n_cells()), 3);
    CHECK((thick.potential(u, {}, {}) != thin.potential(u, {}, {})) == is_affine);
}

TEST_CASE("tips of all angles part from a block that they strike, whatever the kinematics, and keep H~, momentum and J~",
          "[solid][tips]") {
    const double degrees = GENERATE(10.0, 25.0, 45.0, 59.0), speed = 0.02;
    const auto kinematics = GENERATE(Kinematics::floating, Kinematics::finite, Kinematics::rigid);
    CAPTURE(degrees, kinematics);
    auto options = bodies<2>(2);
    options.law = solid::ContactLaw::pair_potential;
    TurningScene<2> scene(
        together(block({-0.75, -0.5}, {0.75, 0.0}), wedge(degrees * std::numbers::pi / 180.0, 1.0, 12, {0.03, 0.2 * speed})),
        options, {moving<2>({0.0, 0.0}), moving<2>({0.0, -speed})}, 0.6, {Kinematics::floating, kinematics});
    CHECK(scene.solid.contact().blind_corners().empty());
    scene.run_until(6.0);
    check_collision(scene);
    const auto motions = solid::body_motions<2>(scene.memm, scene.solid);
    CHECK(motions[1].velocity[1] - motions[0].velocity[1] > 0.1 * speed);  // -1 where they go through each other
    CHECK(scene.drifts().energy_excess <= 1e-2);
}

TEST_CASE("a block that falls on the rigid tip of an obstacle rebounds, and a tip that falls on a rigid plane",
          "[solid][tips]") {
    const double degrees = GENERATE(10.0, 30.0, 50.0), angle = degrees * std::numbers::pi / 180.0, speed = 0.02;
    const bool tip_is_rigid = GENERATE(true, false);
    CAPTURE(degrees, tip_is_rigid);
    auto options = bodies<2>(1);
    options.law = solid::ContactLaw::pair_potential;
    contact::RigidObstacle<2> obstacle;
    if (tip_is_rigid) {
        const Vector<2> tip(0.03, 0.0), right(0.03 + std::tan(0.5 * angle), -1.0), left(0.03 - std::tan(0.5 * angle), -1.0);
        obstacle.faces = {{right, tip}, {tip, left}, {left, right}};
    } else {
        obstacle = contact::plane_obstacle<2>({0.0, 0.0}, {0.0, 1.0}, 2.0);
    }
    options.obstacles = {obstacle};
    const double gap = 0.2 * speed;
    TurningScene<2> scene(tip_is_rigid ? block({-0.75, gap}, {0.75, 0.5 + gap}) : wedge(angle, 1.0, 12, {0.0, gap}), options,
                          {moving<2>({0.0, -speed})}, 0.6, Kinematics::floating);
    scene.run_until(6.0);
    const auto body = solid::body_motions<2>(scene.memm, scene.solid)[0];
    CHECK(body.velocity[1] > 0.1 * speed);
    const Drifts drifts = scene.drifts();
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
}
