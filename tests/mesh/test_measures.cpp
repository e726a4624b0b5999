#include "mesh/laws.hpp"

using namespace abut;
using namespace abut::mesh;

TEST_CASE("cells of a box fill it exactly, whatever their shape", "[mesh][measures]") {
    for (const CellShape shape : test::shapes_2d)
        CHECK(test::total_measure(test::small_box(shape)) == Approx(2.0).epsilon(1e-14));
    for (const CellShape shape : test::shapes_3d)
        CHECK(test::total_measure(test::small_box_3d(shape)) == Approx(6.0).epsilon(1e-14));
}

TEST_CASE("every cell is closed and obeys the divergence theorem", "[mesh][measures]") {
    for (const CellShape shape : test::shapes_2d) test::check_closed_cells(test::small_box(shape));
    for (const CellShape shape : test::shapes_3d) test::check_closed_cells(test::small_box_3d(shape));
    test::check_closed_cells(cylinder({.size = 0.3}));
    test::check_closed_cells(disc({.size = 0.2}));
}

TEST_CASE("measure and centroid of one cell are those of the formula", "[mesh][measures]") {
    // Centroids: tetrahedron 1/4 of the sum, prism 1/3 in plan and 1/2 up, pyramid 1/4 of the height, hexahedron the middle.
    struct Expected {
        CellShape shape;
        double measure;
        Vector<3> centroid;
    };
    const auto expected = GENERATE(values<Expected>({{CellShape::tetrahedron, 1.0 / 6, {0.25, 0.25, 0.25}},
                                                     {CellShape::prism, 0.5, {1.0 / 3, 1.0 / 3, 0.5}},
                                                     {CellShape::pyramid, 1.0 / 3, {0.5, 0.5, 0.25}},
                                                     {CellShape::hexahedron, 1.0, {0.5, 0.5, 0.5}}}));
    const Vector<3> far(1000.0, -2000.0, 500.0);
    auto corners = test::corners_of(expected.shape);
    const auto mesh = build_mesh(test::one_cell<3>(expected.shape, corners));
    CHECK(mesh.cell_measure[0] == Approx(expected.measure).epsilon(1e-14));
    CHECK((mesh.cell_centroid[0] - expected.centroid).norm() < 1e-15);
    for (auto& corner : corners) corner += far;
    const auto moved = build_mesh(test::one_cell<3>(expected.shape, corners));
    CHECK(moved.cell_measure[0] == Approx(expected.measure).epsilon(1e-12));
    CHECK((moved.cell_centroid[0] - far - expected.centroid).norm() < 1e-12);
}

TEST_CASE("a trapezium has its area and its centroid", "[mesh][measures]") {
    // Parallel sides a = 3 (below), b = 1, height 1, symmetric about x = 1.5: area 2, centroid at (a + 2b) / (3 (a + b)).
    const auto mesh = build_mesh(test::one_cell<2>(CellShape::quadrangle, {{0, 0}, {3, 0}, {2, 1}, {1, 1}}));
    CHECK(mesh.cell_measure[0] == Approx(2.0).epsilon(1e-15));
    CHECK((mesh.cell_centroid[0] - Vector<2>(1.5, 5.0 / 12)).norm() < 1e-15);
}

TEST_CASE("regular cells have an aspect ratio of one", "[mesh][quality]") {
    const double r3 = std::sqrt(3.0);
    CHECK(quality(build_mesh(test::one_cell<2>(CellShape::triangle, {{0, 0}, {1, 0}, {0.5, r3 / 2}}))).worst_aspect_ratio ==
          Approx(1.0));
    CHECK(
        quality(build_mesh(test::one_cell<2>(CellShape::quadrangle, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}))).worst_aspect_ratio ==
        Approx(1.0));
    const std::vector<Vector<3>> tetrahedron = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    CHECK(quality(build_mesh(test::one_cell<3>(CellShape::tetrahedron,
                                               {tetrahedron[0], tetrahedron[2], tetrahedron[1], tetrahedron[3]})))
              .worst_aspect_ratio == Approx(1.0));
    CHECK(quality(build_mesh(test::one_cell<3>(CellShape::hexahedron, test::corners_of(CellShape::hexahedron))))
              .worst_aspect_ratio == Approx(1.0));
    const std::vector<Vector<3>> prism = {{0, 0, 0}, {1, 0, 0}, {0.5, r3 / 2, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, r3 / 2, 1}};
    CHECK(quality(build_mesh(test::one_cell<3>(CellShape::prism, prism))).worst_aspect_ratio == Approx(1.0));
    const std::vector<Vector<3>> pyramid = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, std::sqrt(0.5)}};
    CHECK(quality(build_mesh(test::one_cell<3>(CellShape::pyramid, pyramid))).worst_aspect_ratio == Approx(1.0));
}

TEST_CASE("quality counts shapes and finds the extreme cells", "[mesh][quality]") {
    // 2 x 1 x 3 cut into 4 x 3 x 5: bricks of 0.5 x 1/3 x 0.6, pyramids of a sixth of that.
    const auto q = quality(test::small_box_3d(CellShape::pyramid));
    CHECK(q.n_cells_of[static_cast<std::size_t>(CellShape::pyramid)] == 360);
    CHECK(q.n_cells_of[static_cast<std::size_t>(CellShape::hexahedron)] == 0);
    CHECK(q.smallest_measure == Approx(0.1 / 6).epsilon(1e-13));
    CHECK(q.largest_measure == Approx(0.1 / 6).epsilon(1e-13));
    CHECK(q.worst_aspect_ratio > 1.0);
}
