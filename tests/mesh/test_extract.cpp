// Some bodies of a mesh as a mesh: all arrays agree with a mesh that was built of these bodies alone.
#include <catch2/catch.hpp>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/extract.hpp"
#include "abut/mesh/shapes/shapes.hpp"

using namespace abut;
using Catch::Contains;

namespace {

template <int Dim>
mesh::Mesh<Dim> some_box(int number) {
    Vector<Dim> lower = Vector<Dim>::Constant(2.0 * number), upper = Vector<Dim>::Constant(2.0 * number + 1.0);
    upper[0] += 0.1 * number;
    std::array<int, Dim> counts;
    counts.fill(2);
    counts[0] += number;
    const auto shape = Dim == 2 ? (number % 2 == 0 ? mesh::CellShape::triangle : mesh::CellShape::quadrangle)
                                : (number % 2 == 0 ? mesh::CellShape::tetrahedron : mesh::CellShape::prism);
    return mesh::structured_box<Dim>(lower, upper, counts, shape, "box" + std::to_string(number));
}

template <int Dim>
mesh::Mesh<Dim> boxes(const std::vector<int>& numbers) {
    std::vector<mesh::Mesh<Dim>> meshes;
    for (const int number : numbers) meshes.push_back(some_box<Dim>(number));
    return mesh::combine<Dim>(meshes);
}

void check_same(const mesh::Rows& a, const mesh::Rows& b) {
    CHECK(a.offsets == b.offsets);
    CHECK(a.values == b.values);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("bodies taken out of a mesh are the mesh of these bodies", "[mesh][extract]", ((int Dim), Dim), 2,
                       3) {
    const auto mesh = boxes<Dim>({0, 1, 2, 3});
    for (const std::vector<std::int32_t>& bodies :
         {std::vector<std::int32_t>{0}, {3}, {1, 2}, {0, 3}, {0, 1, 2, 3}, std::vector<std::int32_t>{}}) {
        const auto part = mesh::extract_bodies<Dim>(mesh, bodies);
        CHECK(part.n_bodies() == static_cast<std::int32_t>(bodies.size()));
        if (bodies.empty()) {
            CHECK(part.n_cells() == 0);
            CHECK(part.n_faces() == 0);
            CHECK(part.groups.empty());
            continue;
        }
        const auto alone = boxes<Dim>({bodies.begin(), bodies.end()});
        CHECK(part.vertices == alone.vertices);
        CHECK(part.cell_shape == alone.cell_shape);
        check_same(part.cell_vertices, alone.cell_vertices);
        check_same(part.cell_faces, alone.cell_faces);
        check_same(part.face_vertices, alone.face_vertices);
        CHECK(part.cell_body == alone.cell_body);
        CHECK(part.face_cells == alone.face_cells);
        CHECK(part.boundary_faces == alone.boundary_faces);
        CHECK(part.cell_measure == alone.cell_measure);
        CHECK(part.cell_centroid == alone.cell_centroid);
        CHECK(part.face_normal == alone.face_normal);
        CHECK(part.face_centroid == alone.face_centroid);
        for (std::size_t i = 0; i < bodies.size(); ++i)
            CHECK(part.body_names[i] == mesh.body_names[static_cast<std::size_t>(bodies[i])]);
        REQUIRE(part.groups.size() == alone.groups.size());
        for (std::size_t g = 0; g < part.groups.size(); ++g) CHECK(part.groups[g].faces == alone.groups[g].faces);
        std::size_t at = 0;  // labels are those of the whole mesh
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            if (std::ranges::find(bodies, mesh.cell_body[c]) != bodies.end())
                CHECK(part.cell_label[at++] == mesh.cell_label[c]);
    }
}

TEST_CASE("bodies out of order, given twice or unknown are refused", "[mesh][extract]") {
    const auto mesh = boxes<2>({0, 1, 2});
    for (const std::vector<std::int32_t>& bodies : {std::vector<std::int32_t>{1, 0}, {1, 1}, {-1}, {0, 3}})
        CHECK_THROWS_WITH(mesh::extract_bodies<2>(mesh, bodies), Contains("increasing order"));
}
