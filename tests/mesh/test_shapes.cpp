#include "mesh/laws.hpp"

#include <clocale>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>

#include "abut/mesh/shapes/gear.hpp"

using namespace abut;
using namespace abut::mesh;
using Catch::Matchers::Contains;
constexpr double pi = std::numbers::pi;

namespace {

template <int Dim>
double group_area(const Mesh<Dim>& mesh, const std::string& group) {
    double area = 0.0;
    for (const std::int32_t face : mesh.group(group).faces) area += mesh.face_measure[static_cast<std::size_t>(face)];
    return area;
}

/// Boundary vertices of `a` that coincide with one of `b`, after `b` is moved by `shift`.
template <int Dim>
int n_common_boundary_vertices(const Mesh<Dim>& a, const Mesh<Dim>& b, const Vector<Dim>& shift) {
    int n = 0;
    for (const std::int32_t face : a.boundary_faces)
        for (const std::int32_t other : b.boundary_faces) {
            const auto& x = a.vertices[static_cast<std::size_t>(a.face_vertices[face][0])];
            const auto& y = b.vertices[static_cast<std::size_t>(b.face_vertices[other][0])];
            n += (x - y - shift).norm() < 1e-6;
        }
    return n;
}

}  // namespace

TEST_CASE("disc, cylinder and sphere approach their formulas as h^2", "[mesh][shapes]") {
    double disc_error = 0.0, cylinder_error = 0.0, sphere_error = 0.0;
    for (const double h : {0.4, 0.2}) {
        const double disc_now = 1.0 - test::total_measure(disc({.radius = 2, .size = 2 * h})) / (4 * pi);
        const double cylinder_now =
            1.0 - test::total_measure(cylinder({.radius = 2, .length = 3, .size = 2 * h})) / (12 * pi);
        const double sphere_now = 1.0 - test::total_measure(sphere({.radius = 2, .size = 2 * h})) / (32 * pi / 3);
        if (h < 0.3) {
            CHECK(disc_error / disc_now == Approx(4.0).epsilon(0.3));
            CHECK(cylinder_error / cylinder_now == Approx(4.0).epsilon(0.3));
            CHECK(sphere_error / sphere_now == Approx(4.0).epsilon(0.4));
        }
        disc_error = disc_now;
        cylinder_error = cylinder_now;
        sphere_error = sphere_now;
    }
    CHECK(disc_error > 0.0);
    CHECK(disc_error < 0.01);
}

TEST_CASE("the groups of a cylinder have its areas and normals", "[mesh][shapes]") {
    const auto mesh = cylinder({.centre = {1, 2, 3}, .radius = 0.5, .length = 2, .size = 0.1, .variant = 1});
    CHECK(group_area(mesh, "side") == Approx(2 * pi * 0.5 * 2).epsilon(0.02));
    CHECK(group_area(mesh, "top") == Approx(pi * 0.25).epsilon(0.02));
    CHECK(group_area(mesh, "bottom") == Approx(pi * 0.25).epsilon(0.02));
    for (const auto face : mesh.group("top").faces) {
        CHECK(mesh.face_normal[static_cast<std::size_t>(face)].z() == Approx(1.0));
        CHECK(mesh.face_centroid[static_cast<std::size_t>(face)].z() == Approx(4.0));
    }
    for (const auto face : mesh.group("bottom").faces)
        CHECK(mesh.face_normal[static_cast<std::size_t>(face)].z() == Approx(-1.0));
    CHECK(mesh.body_names == std::vector<std::string>{"cylinder"});
}

TEST_CASE("an unstructured box is filled exactly and its sides are named", "[mesh][shapes]") {
    const auto plane = box<2>({.lower = {1, 2}, .upper = {3, 3}, .size = 0.2});
    CHECK(test::total_measure(plane) == Approx(2.0).epsilon(1e-13));
    CHECK(group_area(plane, "ymin") == Approx(2.0));
    for (const auto face : plane.group("xmax").faces)
        CHECK(plane.face_normal[static_cast<std::size_t>(face)].x() == Approx(1.0));
    const auto solid = box<3>({.lower = {0, 0, 0}, .upper = {1, 2, 3}, .size = 0.5});
    CHECK(test::total_measure(solid) == Approx(6.0).epsilon(1e-13));
    for (const auto& [name, area] :
         {std::pair{"xmin", 6.0}, {"xmax", 6.0}, {"ymin", 3.0}, {"ymax", 3.0}, {"zmin", 2.0}, {"zmax", 2.0}})
        CHECK(group_area(solid, name) == Approx(area));
    test::check_two_sides(solid);
}

TEST_CASE("cells have the wanted size, and are smaller where refinement is asked for", "[mesh][shapes]") {
    const auto even = disc({.size = 0.1});
    CHECK(even.groups[0].faces.size() == Approx(2 * pi / 0.1).epsilon(0.05));
    const Refinement<2> refinement{.point = {0, -1}, .size = 0.01, .distance = 0.5};
    for (const int variant : {0, 1}) {
        const auto mesh = disc({.size = 0.1, .refinement = refinement, .variant = variant});
        double smallest = 1.0;
        Vector<2> where = Vector<2>::Zero();
        for (std::int32_t face : mesh.boundary_faces)
            if (mesh.face_measure[static_cast<std::size_t>(face)] < smallest) {
                smallest = mesh.face_measure[static_cast<std::size_t>(face)];
                where = mesh.face_centroid[static_cast<std::size_t>(face)];
            }
        CHECK(smallest == Approx(0.01).epsilon(0.3));
        CHECK((where - refinement.point).norm() < 0.05);
    }
    const auto patch = disc({.size = 0.1, .refinement = Refinement<2>{{0, -1}, 0.01, 0.5, 0.3}});
    double length = 0.0;
    int n_faces = 0;
    for (const std::int32_t face : patch.boundary_faces)
        if ((patch.face_centroid[static_cast<std::size_t>(face)] - Vector<2>(0, -1)).norm() < 0.3) {
            length += patch.face_measure[static_cast<std::size_t>(face)];
            ++n_faces;
        }
    CHECK(length / n_faces == Approx(0.01).epsilon(0.1));
    const auto solid = cylinder({.size = 0.3, .refinement = Refinement<3>{{1, 0, 0}, 0.05, 0.5}, .variant = 1});
    const auto smallest = quality(solid).smallest_cell;
    CHECK((solid.cell_centroid[static_cast<std::size_t>(smallest)] - Vector<3>(1, 0, 0)).norm() < 0.3);
}

TEST_CASE("a part has the same mesh in any unit of length, and anywhere", "[mesh][shapes]") {
    const double unit = GENERATE(1e-9, 1e9, 0x1p-30, 0x1p30);
    const auto refined = [](double u) { return Refinement<2>{u * Vector<2>(0, -1), 0.05 * u, 0.5 * u, 0.1 * u}; };
    const auto check_scaled = [unit]<int Dim>(const Mesh<Dim>& scaled, const Mesh<Dim>& plain) {
        REQUIRE(scaled.vertices.size() == plain.vertices.size());
        CHECK(scaled.cell_vertices.values == plain.cell_vertices.values);
        const bool is_exact = std::log2(unit) == std::floor(std::log2(unit));
        double worst = 0.0;
        for (std::size_t i = 0; i < plain.vertices.size(); ++i)
            worst = std::max(worst, (scaled.vertices[i] / unit - plain.vertices[i]).norm());
        CHECK(worst <= (is_exact ? 0.0 : 1e-12));
    };
    const auto disc_in = [&](double u) { return disc({.radius = u, .size = 0.3 * u, .refinement = refined(u)}); };
    check_scaled(disc_in(unit), disc_in(1.0));
    const auto sphere_in = [](double u) { return sphere({.radius = u, .size = 0.7 * u}); };
    check_scaled(sphere_in(unit), sphere_in(1.0));
    const auto cylinder_in = [](double u) { return cylinder({.radius = u, .length = 2 * u, .size = 0.8 * u}); };
    check_scaled(cylinder_in(unit), cylinder_in(1.0));
    const auto box_in = [](double u) { return box<3>({.lower = {0, u, 0}, .upper = {u, 2 * u, 3 * u}, .size = u}); };
    check_scaled(box_in(unit), box_in(1.0));
    const Vector<2> corner(1e6, -1e6);
    const auto far = box<2>({.lower = corner, .upper = corner + Vector<2>(1, 2), .size = 0.3});
    const auto near = box<2>({.lower = {0, 0}, .upper = {1, 2}, .size = 0.3});
    CHECK(far.cell_vertices.values == near.cell_vertices.values);
    CHECK(test::total_measure(far) == Approx(2.0).epsilon(1e-9));
}

TEST_CASE("equal parts of different variants do not match", "[mesh][shapes]") {
    const auto one = disc({.size = 0.1}), two = disc({.centre = {0, 3}, .size = 0.1, .variant = 1});
    CHECK(n_common_boundary_vertices<2>(one, one, Vector<2>::Zero()) > 50);
    CHECK(n_common_boundary_vertices<2>(one, two, Vector<2>(0, -3)) == 0);
    const auto a = cylinder({.size = 0.3}), b = cylinder({.size = 0.3, .variant = 1});
    CHECK(n_common_boundary_vertices<3>(a, b, Vector<3>::Zero()) == 0);
    // Boxes always share their corners, and nothing else.
    std::vector<Mesh<2>> boxes;
    for (const int variant : {0, 1, 2, 7, 20}) boxes.push_back(box<2>({.size = 0.2, .variant = variant}));
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) CHECK(n_common_boundary_vertices<2>(boxes[i], boxes[j], Vector<2>::Zero()) == 4);
    const auto solid = box<3>({.size = 0.34}), other = box<3>({.size = 0.34, .variant = 3});
    int n_common = 0;
    for (const auto& x : solid.vertices)
        for (const auto& y : other.vertices) n_common += (x - y).norm() < 1e-6;
    CHECK(n_common == 8);
}

TEST_CASE("a variant has as many cells as another, to a few percent", "[mesh][shapes]") {
    const auto n = box<2>({.upper = {0.15, 0.1}, .size = 0.003}).n_cells();
    const auto n_solid = box<3>({.size = 0.1}).n_cells();
    for (const int variant : {1, 2, 20}) {
        CAPTURE(variant);
        CHECK(box<2>({.upper = {0.15, 0.1}, .size = 0.003, .variant = variant}).n_cells() == Approx(n).epsilon(0.04));
        CHECK(box<3>({.size = 0.1, .variant = variant}).n_cells() == Approx(n_solid).epsilon(0.08));
    }
}

TEST_CASE("a shape with more cells than it may have is refused before anything is made", "[mesh][shapes]") {
    CHECK_THROWS_WITH(gear({.cells = 2'000'000'000}),
                      Contains("gear: its sizes make about ") && Contains(" cells, at most 50000000 are made. Lower "
                                                                          "cells_per_tooth or the number of teeth, or raise "
                                                                          "most_cells"));
    CHECK_THROWS_WITH(structured_box<2>({0, 0}, {1, 1}, {100, 100}, CellShape::triangle, "box", {.most_cells = 19'999.0}),
                      Contains("box: its sizes make about 20000 cells, at most 19999 are made."));
    CHECK(structured_box<2>({0, 0}, {1, 1}, {10, 10}, CellShape::triangle, "box", {.most_cells = 200.0}).n_cells() == 200);
    CHECK_THROWS_WITH(disc({.size = 0.01}, {.most_cells = 1000.0}), Contains("at most 1000 are made. Raise size"));
    // The estimate of a gear is what it gets.
    const auto made = gear({.cells = 8}).n_cells();
    CHECK_THROWS_AS(gear({.cells = 8}, {.most_cells = 0.9 * made}), MeshError);
    CHECK_NOTHROW(gear({.cells = 8}, {.most_cells = 1.1 * made}));
}

TEST_CASE("a fan is a regular polygon of cells that are all neighbours on the boundary", "[mesh][shapes]") {
    const int n = GENERATE(3, 7, 40);
    const auto mesh = fan_disc({1, 2}, 0.5, n, 0.3);
    CHECK(mesh.n_cells() == n);
    CHECK(mesh.group("boundary").faces.size() == static_cast<std::size_t>(n));
    CHECK(mesh.n_faces() == 2 * n);
    CHECK(test::total_measure(mesh) == Approx(0.5 * n * 0.25 * std::sin(2 * pi / n)).epsilon(1e-14));
    test::check_closed_cells(mesh);
}

TEST_CASE("impossible shapes are refused by name, value and limit", "[mesh][shapes]") {
    CHECK_THROWS_WITH(disc({.radius = -1}), Contains("disc: radius is -1 m, a finite length above 0 is needed."));
    CHECK_THROWS_WITH(disc({.size = 0}), Contains("disc: size is 0 m"));
    CHECK_THROWS_WITH(disc({.variant = -1}), Contains("disc: variant is -1"));
    CHECK_THROWS_WITH(sphere({.refinement = Refinement<3>{{0, 0, 0}, 0, 1}}), Contains("sphere: refinement.size is 0 m"));
    CHECK_THROWS_WITH(cylinder({.length = 0, .name = "shaft"}), Contains("shaft: length is 0 m"));
    CHECK_THROWS_WITH(box<2>({.upper = {1, -1}}), Contains("box: shortest side is -1 m"));
    CHECK_THROWS_WITH((structured_box<2>({0, 0}, {1, 1}, {2, 0}, CellShape::triangle)),
                      Contains("box: counts[1] is 0, at least 1 is needed."));
    CHECK_THROWS_WITH((structured_box<2>({0, 0}, {1, 1}, {2, 2}, CellShape::prism)),
                      Contains("a prism cannot fill a box of dimension 2"));
    CHECK_THROWS_WITH((structured_box<2>({0, 0}, {1, -1}, {2, 2}, CellShape::triangle)),
                      Contains("the box is -1 m long along y"));
    CHECK_THROWS_WITH(fan_disc({0, 0}, 1, 2), Contains("n_sectors is 2, at least 3 is needed."));
    CHECK_THROWS_WITH(fan_disc({0, 0}, 1, 268435456),
                      Contains("disc: its sizes make about 2.68435e+08 cells, at most 50000000 are made."));
    CHECK_THROWS_WITH(fan_disc({0, 0}, 0, 5), Contains("radius is 0 m"));
}

TEST_CASE("sizes and places that make no mesh are refused before Gmsh tries", "[mesh][shapes]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(disc({.centre = {0, nan}}),
                      Contains("disc: the y coordinate of centre is nan, a finite number is needed."));
    CHECK_THROWS_WITH(box<2>({.lower = {nan, 0}}), Contains("box: the x coordinate of lower is nan"));
    CHECK_THROWS_WITH(sphere({.refinement = Refinement<3>{{0, 0, nan}, 0.01, 1}}),
                      Contains("sphere: the z coordinate of refinement.point is nan"));
    CHECK_THROWS_WITH(disc({.size = 0.1, .refinement = Refinement<2>{{0, -1}, 0.2, 0.5}}),
                      Contains("disc: refinement.size is 0.2 m, at most size = 0.1 m is allowed. Lower it"));
    CHECK_THROWS_WITH(disc({.size = 0.1, .refinement = Refinement<2>{{0, -1}, 0.01, 0.5, -0.1}}),
                      Contains("disc: refinement.uniform is -0.1 m, a finite length of 0 or more is needed"));
    CHECK_THROWS_WITH(cylinder({.size = 1e-4}),
                      Contains("cylinder: its sizes make about 1.44513e+13 cells, at most 10000000 are made. Raise size"));
    CHECK_THROWS_WITH(disc({.size = 1e-6}), Contains("at most 10000000 are made."));
    CHECK_THROWS_WITH(sphere({.size = 0.1, .refinement = Refinement<3>{{0, 0, 1}, 1e-3, 1e3}}),
                      Contains("at most 10000000 are made."));
}

TEST_CASE("meshing leaves the locale of the program as it was", "[mesh][shapes]") {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const std::string locale : {"C", "C.UTF-8"}) {
        std::setlocale(LC_ALL, locale.c_str());
        (void)disc({.size = 0.5});
        CHECK(std::setlocale(LC_ALL, nullptr) == locale);
    }
    std::setlocale(LC_ALL, before.c_str());
}

TEST_CASE("parts may be made in several threads at once", "[mesh][shapes]") {
    const auto alone = disc({.size = 0.2});
    std::vector<Mesh<2>> made(4);
    std::vector<std::thread> threads;
    for (auto& mesh : made) threads.emplace_back([&mesh] { mesh = disc({.size = 0.2}); });
    for (auto& thread : threads) thread.join();
    for (const auto& mesh : made) CHECK(test::same_bits(alone, mesh));
}
