#include "mesh/laws.hpp"

using namespace abut;
using namespace abut::mesh;

TEST_CASE("every face has two sides, or one on the boundary, and is numbered by its first cell", "[mesh][topology]") {
    for (const bool reorder : {true, false}) {
        for (const CellShape shape : test::shapes_2d) test::check_two_sides(test::small_box(shape, {.reorder = reorder}));
        for (const CellShape shape : test::shapes_3d) test::check_two_sides(test::small_box_3d(shape, {.reorder = reorder}));
    }
    test::check_two_sides(cylinder({.size = 0.3}));
}

TEST_CASE("the local faces of a shape are counter-clockwise from outside and close it", "[mesh][topology]") {
    for (const CellShape shape : test::shapes_3d) {
        const auto corners = test::corners_of(shape);
        CHECK(static_cast<int>(corners.size()) == n_vertices(shape));
        CHECK(dimension(shape) == 3);
        Vector<3> middle = Vector<3>::Zero(), sum = Vector<3>::Zero();
        for (const auto& corner : corners) middle += corner / static_cast<double>(corners.size());
        for (int face = 0; face < n_faces(shape); ++face) {
            const auto local = face_vertices(shape, face);
            const auto at = [&](std::size_t i) { return corners[static_cast<std::size_t>(local[i % local.size()])]; };
            Vector<3> area = Vector<3>::Zero();
            for (std::size_t i = 0; i < local.size(); ++i) area += 0.5 * (at(i) - middle).cross(at(i + 1) - middle);
            CHECK(area.dot(at(0) - middle) > 0.0);
            sum += area;
        }
        CHECK(sum.norm() < 1e-15);
    }
}

TEST_CASE("a box has Euler's number of faces", "[mesh][topology]") {
    // Hexahedra n x m x k: (n+1) m k + n (m+1) k + n m (k+1) faces, 2 (n m + m k + k n) of them on the boundary.
    const auto mesh = test::small_box_3d(CellShape::hexahedron);
    CHECK(mesh.n_faces() == 5 * 3 * 5 + 4 * 4 * 5 + 4 * 3 * 6);
    CHECK(mesh.boundary_faces.size() == 2 * (4 * 3 + 3 * 5 + 5 * 4));
    // Plane mesh: vertices - edges + cells = 1.
    const auto plane = test::small_box(CellShape::triangle);
    CHECK(static_cast<std::int32_t>(plane.vertices.size()) - plane.n_faces() + plane.n_cells() == 1);
}

TEST_CASE("named faces become groups of boundary faces, in any order of their vertices", "[mesh][topology]") {
    for (const CellShape shape : test::shapes_3d) {
        const auto mesh = test::small_box_3d(shape);
        std::size_t n_named = 0;
        for (const auto& group : mesh.groups) {
            n_named += group.faces.size();
            CHECK(std::is_sorted(group.faces.begin(), group.faces.end()));
        }
        CHECK(n_named == mesh.boundary_faces.size());
        double area = 0.0;
        for (const std::int32_t face : mesh.group("ymax").faces) {
            CHECK((mesh.face_normal[static_cast<std::size_t>(face)] - Vector<3>(0, 1, 0)).norm() < 1e-14);
            area += mesh.face_measure[static_cast<std::size_t>(face)];
        }
        CHECK(area == Approx(2.0 * 3.0));
    }
    auto soup = test::soup_of(test::small_box(CellShape::quadrangle));
    for (auto& named : soup.named_faces) std::reverse(named.vertices.begin(), named.vertices.end());
    CHECK(build_mesh(soup).group("xmin").faces.size() == 3);
}

TEST_CASE("a group that does not exist is named beside those that do", "[mesh][topology]") {
    CHECK_THROWS_WITH(test::small_box(CellShape::triangle).group("left"),
                      "box: there is no boundary group 'left'. The mesh has 'xmin', 'xmax', 'ymin', 'ymax'.");
}

TEST_CASE("a hexahedron, prism, pyramid and tetrahedron meet conformingly", "[mesh][topology]") {
    // Cube 0..7, pyramid (apex 8) on its x = 1 face, prism on its y = 1 face, tetrahedron on the prism's upper triangle.
    CellSoup<3> soup;
    soup.name = "mixed";
    soup.vertices = test::corners_of(CellShape::hexahedron);
    soup.vertices.insert(soup.vertices.end(), {{2, 0.5, 0.5}, {0, 2, 0}, {0, 2, 1}, {0, 1.5, 2}});
    const auto add = [&](CellShape shape, std::vector<std::int32_t> vertices) {
        soup.cell_shape.push_back(shape);
        soup.cell_vertices.append(vertices);
        soup.cell_body.push_back(0);
    };
    soup.body_names = {"all"};
    add(CellShape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
    add(CellShape::pyramid, {1, 2, 6, 5, 8});
    add(CellShape::prism, {3, 2, 9, 7, 6, 10});
    add(CellShape::tetrahedron, {7, 6, 10, 11});
    const auto mesh = build_mesh(soup);
    test::check_two_sides(mesh);
    test::check_closed_cells(mesh);
    CHECK(mesh.n_faces() - static_cast<int>(mesh.boundary_faces.size()) == 3);
    CHECK(test::total_measure(mesh) == Approx(1.0 + 1.0 / 3 + 0.5 + 1.0 / 6));
}
