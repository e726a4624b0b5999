#include "mesh/laws.hpp"

using namespace abut;
using namespace abut::mesh;

namespace {

/// A box whose inner vertices are shaken, so that the quadrangles between them are warped; its surface stays plane.
CellSoup<3> shaken_box(CellShape shape, double amplitude) {
    auto soup = test::soup_of(test::small_box_3d(shape));
    std::mt19937 random(7);
    for (auto& x : soup.vertices) {
        const Vector<3> shift = amplitude * Vector<3>(random() / 4294967295.0 - 0.5, random() / 4294967295.0 - 0.5,
                                                      random() / 4294967295.0 - 0.5);
        const bool inside = x.x() > 0.01 && x.x() < 1.99 && x.y() > 0.01 && x.y() < 0.99 && x.z() > 0.01 && x.z() < 2.99;
        if (inside) x += shift;
    }
    return soup;
}

}  // namespace

TEST_CASE("cutting cells with warped faces conserves the volume and conforms", "[mesh][split]") {
    for (const CellShape shape : {CellShape::hexahedron, CellShape::prism, CellShape::pyramid}) {
        const auto soup = shaken_box(shape, 0.05);
        REQUIRE_THROWS_WITH(
            build_mesh(soup),
            Catch::Contains("is not planar: a vertex lies ") &&
                Catch::Contains(" m is allowed. Have such cells cut into tetrahedra (non_planar = \"split\"), or raise "
                                "planarity_tolerance, now 1e-06 of the size of a face"));
        const auto mesh = build_mesh(soup, {.non_planar = NonPlanarFaces::split});
        CHECK(test::total_measure(mesh) == Approx(6.0).epsilon(1e-13));
        test::check_two_sides(mesh);
        test::check_closed_cells(mesh);
        // Conforming: the only faces with one cell are those of the box's surface, 2 (2 + 3 + 6) = 22 m^2.
        double surface = 0.0;
        for (const std::int32_t face : mesh.boundary_faces) surface += mesh.face_measure[static_cast<std::size_t>(face)];
        CHECK(surface == Approx(22.0).epsilon(1e-13));
        CHECK(mesh.report.n_non_planar_faces > 0);
        CHECK(mesh.report.n_cut_cells > 0);
        CHECK(mesh.report.worst_planarity > 1e-4);
        for (const auto& group : {"xmin", "xmax"}) {
            double area = 0.0;
            for (const std::int32_t face : mesh.group(group).faces)
                area += mesh.face_measure[static_cast<std::size_t>(face)];
            CHECK(area == Approx(3.0).epsilon(1e-13));
        }
    }
}

TEST_CASE("a hexahedron with one warped face becomes six tetrahedra of its volume", "[mesh][split]") {
    auto corners = test::corners_of(CellShape::hexahedron);
    corners[6].z() += 0.3;  // the top, cut along 4-6, gains two prisms of base 1/2 and mean height 0.1: 0.1 in all
    const auto mesh = build_mesh(test::one_cell<3>(CellShape::hexahedron, corners), {.non_planar = NonPlanarFaces::split});
    CHECK(mesh.n_cells() == 6);
    CHECK(test::total_measure(mesh) == Approx(1.1).epsilon(1e-14));
    CHECK(mesh.report.n_cut_cells == 1);
    CHECK(mesh.report.n_non_planar_faces == 1);
    CHECK(mesh.report.worst_face_cell == 0);
    for (const auto label : mesh.cell_label) CHECK(label == 0);
}

TEST_CASE("plane faces are left alone, whatever the option", "[mesh][split]") {
    const auto plain = test::small_box_3d(CellShape::hexahedron);
    const auto split = test::small_box_3d(CellShape::hexahedron, {.non_planar = NonPlanarFaces::split});
    CHECK(test::same_bits(plain, split));
    CHECK(split.report.n_cut_cells == 0);
    CHECK(split.report.worst_planarity < 1e-14);
}

TEST_CASE("only cells linked to a warped face through quadrangles are cut", "[mesh][split]") {
    // Two separate cubes, one of them warped.
    auto corners = test::corners_of(CellShape::hexahedron);
    auto soup = test::one_cell<3>(CellShape::hexahedron, corners);
    corners[6].z() += 0.1;
    for (auto& corner : corners) soup.vertices.push_back(corner + Vector<3>(5, 0, 0));
    soup.cell_shape.push_back(CellShape::hexahedron);
    soup.cell_vertices.append(std::array{8, 9, 10, 11, 12, 13, 14, 15});
    soup.cell_body.push_back(0);
    const auto mesh = build_mesh(soup, {.non_planar = NonPlanarFaces::split});
    CHECK(mesh.n_cells() == 7);
    CHECK(mesh.report.n_cut_cells == 1);
    CHECK(mesh.report.worst_face_cell == 1);
}
