#include "mesh/laws.hpp"

#include <limits>

#include "abut/mesh/topology.hpp"

using namespace abut;
using namespace abut::mesh;
using Catch::Matchers::Contains;

namespace {

/// Two triangles of the unit square.
CellSoup<2> square() {
    CellSoup<2> soup;
    soup.name = "square.msh";
    soup.vertices = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    soup.cell_shape = {CellShape::triangle, CellShape::triangle};
    soup.cell_vertices.append(std::array{0, 1, 2});
    soup.cell_vertices.append(std::array{0, 2, 3});
    soup.cell_body = {0, 0};
    soup.body_names = {"square"};
    return soup;
}

template <int Dim>
std::string complaint(CellSoup<Dim> soup, const MeshOptions& options = {}) {
    try {
        (void)build_mesh(std::move(soup), options);
    } catch (const MeshError& error) {
        return error.what();
    }
    return "nothing";
}

}  // namespace

TEST_CASE("sound input raises nothing", "[mesh][quality]") { CHECK(complaint(square()) == "nothing"); }

TEST_CASE("an empty mesh is refused", "[mesh][quality]") {
    CellSoup<3> soup;
    soup.name = "a.msh";
    CHECK_THAT(complaint(soup), Contains("a.msh: the mesh is empty: it has 0 cells of dimension 3, at least 1 is needed."));
}

TEST_CASE("an index out of range names cell, index and limit", "[mesh][quality]") {
    auto soup = square();
    soup.cell_vertices.values[4] = 7;
    CHECK_THAT(complaint(soup), Contains("square.msh: cell 1 has the vertex 7, 0 to 3 are allowed."));
    soup.cell_vertices.values[4] = -1;
    CHECK_THAT(complaint(soup), Contains("cell 1 has the vertex -1"));
}

TEST_CASE("labels of the input appear in messages", "[mesh][quality]") {
    auto soup = square();
    soup.cell_label = {101, 102};
    soup.vertex_label = {11, 12, 13, 14};
    soup.cell_vertices.values[4] = 0;
    CHECK_THAT(complaint(soup), Contains("square.msh: cell 102 has the vertex 11 twice."));
}

TEST_CASE("a coordinate that is no number is refused", "[mesh][quality]") {
    auto soup = square();
    soup.vertices[2].y() = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(complaint(soup), Contains("square.msh: vertex 2 has the y coordinate nan, a finite number is needed."));
    soup.vertices[2].y() = std::numeric_limits<double>::infinity();
    CHECK_THAT(complaint(soup), Contains("vertex 2 has the y coordinate inf"));
}

TEST_CASE("a flat cell is refused", "[mesh][quality]") {
    auto soup = square();
    soup.vertices[3] = {0.5, 0.5};
    CHECK_THAT(complaint(soup), Contains("square.msh: cell 1 (triangle) is flat: its measure is"));
}

TEST_CASE("a face without measure is refused", "[mesh][quality]") {
    // Two corners of a quadrangle coincide; its area does not vanish.
    const auto soup = test::one_cell<2>(CellShape::quadrangle, {{0, 0}, {1, 0}, {1, 1}, {1, 1}});
    CHECK_THAT(complaint(soup), Contains("one.msh: face (2, 3) of cell 0 is degenerate: its measure is 0 m^1"));
}

TEST_CASE("in 3D, too, a face without measure is refused", "[mesh][quality]") {
    // Two corners below and the two above them coincide: the hexahedron has the volume of a prism, and one face of its
    // six none.
    auto corners = test::corners_of(CellShape::hexahedron);
    corners[1] = corners[0];
    corners[5] = corners[4];
    const auto collapsed = complaint(test::one_cell<3>(CellShape::hexahedron, corners));
    CHECK_THAT(collapsed, Contains("one.msh: face (0, 1, 5, 4) of cell 0 is degenerate: its measure is 0 m^2, more than ") &&
                              Contains(" is needed. Merge coinciding vertices"));
}

TEST_CASE("a body without cells, and bodies or groups of one name are refused", "[mesh][quality]") {
    auto soup = square();
    soup.body_names = {"square", "ghost"};
    CHECK_THAT(complaint(soup), Contains("square.msh: body 'ghost' has 0 cells of dimension 2, at least 1 is needed."));
    soup = square();
    for (const Vector<2>& x : {Vector<2>(5, 0), Vector<2>(6, 0), Vector<2>(6, 1)}) soup.vertices.push_back(x);
    soup.cell_shape.push_back(CellShape::triangle);
    soup.cell_vertices.append(std::array{4, 5, 6});
    soup.cell_body.push_back(1);
    soup.body_names = {"square", "square"};
    CHECK_THAT(complaint(soup), Contains("square.msh: 2 bodies are called 'square', each needs a name of its own."));
    soup = square();
    soup.group_names = {"a", "b", "a"};
    CHECK_THAT(complaint(soup), Contains("square.msh: 2 boundary groups are called 'a', each needs a name of its own."));
}

TEST_CASE("rows refuse to count beyond 32 bits", "[mesh][quality]") {
    Rows rows;
    rows.append(std::array{1, 2});
    const std::span<const std::int32_t> too_long(rows.values.data(), std::size_t{1} << 31);
    CHECK_THROWS_WITH(rows.append(too_long),
                      "Rows: 2 values and 2147483648 more, at most 2147483647 are allowed. Coarsen the mesh.");
    CHECK(rows.size() == 1);
    CHECK_THROWS_WITH((structured_box<3>({0, 0, 0}, {1, 1, 1}, {10000, 10000, 10000}, CellShape::hexahedron)),
                      Contains("box: its sizes make about 1e+12 cells, at most 50000000 are made. Lower the counts"));
}

TEST_CASE("neighbours that run differently around their common face are refused", "[mesh][quality]") {
    // The second hexahedron crosses over between two corners of the common face.
    auto soup = test::one_cell<3>(CellShape::hexahedron, test::corners_of(CellShape::hexahedron));
    for (const Vector<3>& x : {Vector<3>(2, 0, 0), Vector<3>(2, 1, 0), Vector<3>(2, 0, 1), Vector<3>(2, 1, 1)})
        soup.vertices.push_back(x);
    soup.cell_shape.push_back(CellShape::hexahedron);
    soup.cell_body.push_back(0);
    auto good = soup;
    good.cell_vertices.append(std::array{1, 8, 9, 2, 5, 10, 11, 6});
    CHECK(complaint(good) == "nothing");
    for (const auto& bow_tie : {std::array{1, 8, 9, 2, 6, 11, 10, 5}, std::array{2, 9, 8, 1, 5, 10, 11, 6}}) {
        auto bad = soup;
        bad.cell_vertices.append(bow_tie);
        CHECK_THAT(complaint(bad), !Contains("nothing"));
        // What topology alone says, before any measure.
        bad.cell_label = {0, 1};
        bad.vertex_label.resize(bad.vertices.size());
        std::iota(bad.vertex_label.begin(), bad.vertex_label.end(), 0);
        CHECK_THROWS_WITH(find_faces(bad), Contains("run differently around their common face: (") &&
                                               Contains("its edges must be the same."));
    }
}

TEST_CASE("a face of three cells is refused", "[mesh][quality]") {
    auto soup = square();
    soup.vertices.push_back({2, 0});
    soup.cell_shape.push_back(CellShape::triangle);
    soup.cell_vertices.append(std::array{0, 4, 2});
    soup.cell_body.push_back(0);
    CHECK_THAT(complaint(soup), Contains("square.msh: face with vertices (") && Contains("belongs to 3 cells") &&
                                    Contains("at most 2 are allowed."));
}

TEST_CASE("a cell given twice is refused", "[mesh][quality]") {
    auto soup = test::one_cell<3>(CellShape::tetrahedron, test::corners_of(CellShape::tetrahedron));
    soup.cell_shape.push_back(CellShape::tetrahedron);
    soup.cell_vertices.append(std::array{0, 1, 2, 3});
    soup.cell_body.push_back(0);
    CHECK_THAT(complaint(soup),
               Contains("one.msh: cells ") && Contains("lie on the same side of their common face with vertices (0, 1, 3)"));
    auto plane = test::one_cell<2>(CellShape::triangle, {{0, 0}, {1, 0}, {0, 1}});
    plane.cell_shape.push_back(CellShape::triangle);
    plane.cell_vertices.append(std::array{0, 1, 2});
    plane.cell_body.push_back(0);
    CHECK_THAT(complaint(plane), Contains("lie on the same side of their common face with vertices (0, 1)"));
}

TEST_CASE("a non-planar face is refused with distance, limit and remedy", "[mesh][quality]") {
    // One corner of the top lifted by 4e-3: the four vertices lie 1e-3 on either side of their best plane.
    auto corners = test::corners_of(CellShape::hexahedron);
    corners[6].z() += 4e-3;
    const auto message = complaint(test::one_cell<3>(CellShape::hexahedron, corners));
    CHECK_THAT(message, Contains("one.msh: face (4, 5, 6, 7) of cell 0 is not planar: a vertex lies 0.00") &&
                            Contains("m off its plane, 1e-06 m is allowed.") &&
                            Contains("Have such cells cut into tetrahedra (non_planar = \"split\"), or raise "
                                     "planarity_tolerance, now 1e-06 of the size of a face, above 0.00"));
    CHECK(complaint(test::one_cell<3>(CellShape::hexahedron, corners), {.planarity_tolerance = 0.01}) == "nothing");
}

TEST_CASE("noise of 2e-9 of a face and of coordinates in single precision is planar", "[mesh][quality]") {
    const auto with_noise = [](double noise) {
        auto corners = test::corners_of(CellShape::hexahedron);
        double sign = 1.0;
        for (auto& x : corners) x += (sign = -sign) * noise * Vector<3>(1, -0.7, 0.4);
        return complaint(test::one_cell<3>(CellShape::hexahedron, corners));
    };
    CHECK(with_noise(2e-9) == "nothing");
    CHECK(with_noise(6e-8) == "nothing");
    CHECK_THAT(with_noise(1e-5), Contains("is not planar"));
}

TEST_CASE("cells inside out are turned and counted, and the mesh is that of cells the right way round", "[mesh][quality]") {
    const auto check = []<int Dim>(const Mesh<Dim>& right) {
        CellSoup<Dim> soup;
        soup.name = "a.msh";
        soup.vertices = right.vertices;
        soup.cell_shape = right.cell_shape;
        soup.cell_body = right.cell_body;
        soup.body_names = right.body_names;
        std::int32_t n_turned = 0;
        for (std::int32_t cell = 0; cell < right.n_cells(); ++cell) {
            std::vector<std::int32_t> v(right.cell_vertices[cell].begin(), right.cell_vertices[cell].end());
            const auto shape = right.cell_shape[static_cast<std::size_t>(cell)];
            if (cell % 3 != 1) {  // the others stay
                ++n_turned;
                if (shape == CellShape::hexahedron || shape == CellShape::prism)
                    std::rotate(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
                else
                    std::swap(v[1], v[shape == CellShape::quadrangle || shape == CellShape::pyramid ? 3 : 2]);
            }
            soup.cell_vertices.append(v);
        }
        const auto mended = build_mesh(std::move(soup), {.reorder = false});
        CHECK(mended.report.n_turned_cells == n_turned);
        CHECK(right.report.n_turned_cells == 0);
        CHECK(mended.face_cells == right.face_cells);
        for (std::size_t c = 0; c < right.cell_measure.size(); ++c)
            REQUIRE(mended.cell_measure[c] == Approx(right.cell_measure[c]).epsilon(1e-13));
        test::check_closed_cells(mended);
    };
    for (const CellShape shape : test::shapes_2d) check(test::small_box(shape));
    for (const CellShape shape : test::shapes_3d) check(test::small_box_3d(shape));
}

TEST_CASE("a face that is not convex is refused", "[mesh][quality]") {
    // An arrow head, extruded.
    std::vector<Vector<3>> corners;
    for (const double z : {0.0, 1.0})
        for (const Vector<2>& p : {Vector<2>(0, 0), Vector<2>(1, -1), Vector<2>(0.1, 1), Vector<2>(0.05, 0.05)})
            corners.push_back({p.x(), p.y(), z});
    CHECK_THAT(complaint(test::one_cell<3>(CellShape::hexahedron, corners)), Contains("of cell 0 is not convex."));
}

TEST_CASE("a quadrangle whose edges cross is refused", "[mesh][quality]") {
    // Edges 12 and 30 cross; the larger lobe makes the area positive.
    CHECK_THAT(complaint(test::one_cell<2>(CellShape::quadrangle, {{0, 0}, {2, 0}, {0.9, 1.2}, {1.1, 1.2}})),
               Contains("one.msh: cell 0 is folded"));
}

TEST_CASE("a named face inside the body is refused", "[mesh][quality]") {
    auto soup = square();
    soup.group_names = {"inside"};
    soup.named_faces = {{{2, 0}, 0}};
    CHECK_THAT(complaint(soup),
               Contains("square.msh: face (2, 0) of group 'inside' is not a boundary face of any cell.") ||
                   Contains("square.msh: face (0, 2) of group 'inside' is not a boundary face of any cell."));
    soup.vertices.push_back({5, 5});
    soup.named_faces = {{{0, 4}, 0}};
    CHECK_THAT(complaint(soup), Contains("face with a vertex that no cell has of group 'inside' is not a boundary face"));
    soup.named_faces = {{{0, 9}, 0}};
    CHECK_THAT(complaint(soup), Contains("named face 0 has the vertex 9"));
    soup.named_faces = {{{0, 1}, 3}};
    CHECK_THAT(complaint(soup), Contains("named face 0 belongs to group 3, but there are 1 group names."));
}

TEST_CASE("bodies that share a vertex are refused", "[mesh][quality]") {
    auto soup = square();
    soup.body_names = {"left", "right"};
    soup.cell_body = {0, 1};
    CHECK_THAT(complaint(soup), Contains("square.msh: bodies 'left' and 'right' share vertex 0 (cells 0|1)."));
}

TEST_CASE("arrays of wrong size, cells of wrong dimension and unnamed bodies are refused", "[mesh][quality]") {
    auto soup = square();
    soup.cell_body.pop_back();
    CHECK_THAT(complaint(soup), Contains("2 cell shapes, but 2 rows of vertices, 1 bodies"));
    soup = square();
    soup.cell_shape[1] = CellShape::tetrahedron;
    CHECK_THAT(complaint(soup), Contains("cell 1 is no cell of dimension 2."));
    soup = square();
    soup.cell_shape[1] = CellShape::quadrangle;
    CHECK_THAT(complaint(soup), Contains("cell 1 has 3 vertices, a quadrangle has 4."));
    soup = square();
    soup.cell_body[1] = 1;
    CHECK_THAT(complaint(soup), Contains("cell 1 belongs to body 1, but there are 1 body names."));
    soup = square();
    soup.vertex_label = {1};
    CHECK_THAT(complaint(soup), Contains("4 vertices but 1 vertex labels."));
}

TEST_CASE("vertices that no cell uses are dropped and counted", "[mesh][quality]") {
    auto soup = square();
    soup.vertices.insert(soup.vertices.begin(), {9, 9});
    for (auto& vertex : soup.cell_vertices.values) ++vertex;
    for (const bool reorder : {true, false}) {
        const auto mesh = build_mesh(soup, {.reorder = reorder});
        CHECK(mesh.vertices.size() == 4);
        CHECK(mesh.report.n_unused_vertices == 1);
        CHECK(test::total_measure(mesh) == Approx(1.0));
    }
}
