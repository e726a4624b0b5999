// Bodies with faces in common, each with vertices of its own.
#include <catch2/catch.hpp>
#include <numeric>

#include "abut/base/error.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/split_body.hpp"

using namespace abut;
using Catch::Contains;
using mesh::CellShape;
using mesh::SharedVertices;

namespace {

/// Two squares beside each other, of two bodies, with a group on their common edge and one on the right.
mesh::CellSoup<2> two_squares() {
    mesh::CellSoup<2> soup;
    soup.name = "squares";
    soup.vertices = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
    soup.cell_shape = {CellShape::quadrangle, CellShape::quadrangle};
    soup.cell_vertices.append(std::array{0, 1, 4, 3});
    soup.cell_vertices.append(std::array{1, 2, 5, 4});
    soup.cell_body = {0, 1};
    soup.body_names = {"left", "right"};
    soup.group_names = {"between", "end"};
    soup.named_faces = {{{1, 4}, 0}, {{5, 2}, 1}};
    return soup;
}

template <int Dim>
double measure_of(const mesh::Mesh<Dim>& mesh, std::int32_t body) {
    double sum = 0.0;
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell)
        if (mesh.cell_body[cell] == body) sum += mesh.cell_measure[cell];
    return sum;
}

}  // namespace

TEST_CASE("bodies that share vertices are refused, or get vertices of their own and are told to be joined",
          "[mesh][split]") {
    CHECK_THROWS_WITH(mesh::build_mesh<2>(two_squares()), Contains("share vertex"));
    const auto mesh = mesh::build_mesh<2>(two_squares(), {.shared_vertices = SharedVertices::separate});
    CHECK(mesh.vertices.size() == 8);
    CHECK(mesh.n_faces() == 8);
    CHECK(mesh.boundary_faces.size() == 8);
    CHECK(mesh.report.joined_bodies == std::vector<std::array<std::int32_t, 2>>{{0, 1}});
    CHECK(mesh.report.n_coincident_vertices == 0);  // which would be a warning
    CHECK(mesh.group("between").faces.size() == 2);
    CHECK(mesh.group("end").faces.size() == 1);
}

TEST_CASE("bodies that have an edge or a corner in common are not joined", "[mesh][split]") {
    mesh::CellSoup<2> soup;
    soup.name = "corner";
    soup.vertices = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 1}, {2, 2}, {1, 2}};
    soup.cell_shape = {CellShape::quadrangle, CellShape::quadrangle};
    soup.cell_vertices.append(std::array{0, 1, 2, 3});
    soup.cell_vertices.append(std::array{2, 4, 5, 6});
    soup.cell_body = {0, 1};
    soup.body_names = {"below", "above"};
    const auto mesh = mesh::build_mesh<2>(std::move(soup), {.shared_vertices = SharedVertices::separate});
    CHECK(mesh.report.joined_bodies.empty());
    CHECK(mesh.vertices.size() == 8);
    CHECK(mesh.report.n_coincident_vertices == 2);
}

TEST_CASE("a body is cut along faces of its cells, and keeps its measure, its groups and its outer faces", "[mesh][split]") {
    const auto whole = mesh::structured_box<3>({0, 0, 0}, {1, 1, 1}, {4, 3, 2}, CellShape::tetrahedron, "box");
    std::vector<std::int32_t> part_of;
    for (const Vector<3>& x : whole.cell_centroid) part_of.push_back(x[0] < 0.5 ? 0 : x[1] < 0.5 ? 1 : 2);
    const auto split = mesh::split_body<3>(whole, part_of, {"a", "b", "c"});
    CHECK(split.body_names == std::vector<std::string>{"a", "b", "c"});
    CHECK(split.n_cells() == whole.n_cells());
    CHECK(measure_of(split, 0) == Approx(0.5).epsilon(1e-14));
    CHECK(measure_of(split, 0) + measure_of(split, 1) + measure_of(split, 2) == Approx(1.0).epsilon(1e-14));
    CHECK(split.report.joined_bodies == std::vector<std::array<std::int32_t, 2>>{{0, 1}, {0, 2}, {1, 2}});
    double area = 0.0;
    for (const auto& group : split.groups) {
        double of_group = 0.0;
        for (const std::int32_t face : group.faces) of_group += split.face_measure[face];
        CAPTURE(group.name);
        CHECK(of_group == Approx(1.0).epsilon(1e-14));
        area += of_group;
    }
    CHECK(area == Approx(6.0).epsilon(1e-14));
    CHECK_THROWS_WITH(mesh::split_body<3>(whole, part_of, {"a", "b", "c", "d"}), Contains("'d' has 0 cells"));
    CHECK_THROWS_WITH(mesh::split_body<3>(whole, {}, {"a"}), Contains("give one per cell"));
}

TEST_CASE("meshes that are put together keep which of their bodies are joined", "[mesh][split]") {
    const auto squares = mesh::build_mesh<2>(two_squares(), {.shared_vertices = SharedVertices::separate});
    const std::vector meshes{mesh::structured_box<2>({5, 0}, {6, 1}, {2, 2}, CellShape::quadrangle, "box"), squares};
    CHECK(mesh::combine<2>(meshes).report.joined_bodies == std::vector<std::array<std::int32_t, 2>>{{1, 2}});
}
