#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/mesh_bytes.hpp"
#include "abut/mesh/part.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/without_cells.hpp"

using namespace abut;
using namespace abut::mesh;

namespace {

template <int Dim>
Mesh<Dim> two_boxes() {
    const CellShape shape = Dim == 2 ? CellShape::triangle : CellShape::tetrahedron;
    Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Ones(), shift = Vector<Dim>::Zero();
    std::array<int, Dim> counts{};
    counts.fill(4);
    upper[0] = 4.0, counts[0] = 16;
    shift[1] = 2.0;
    const std::array parts{structured_box<Dim>(lower, upper, counts, shape, "low"),
                           structured_box<Dim>(lower + shift, upper + shift, counts, shape, "high")};
    return combine<Dim>(parts);
}

/// By where they lie along x.
template <int Dim>
std::vector<int> slices(const Mesh<Dim>& mesh, int n) {
    std::vector<int> owner;
    for (const Vector<Dim>& x : mesh.cell_centroid) owner.push_back(std::min(n - 1, static_cast<int>(x[0] / 4.0 * n)));
    return owner;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a part has its own cells with all of their faces, as the whole mesh has them", "[mesh][part]",
                       ((int Dim), Dim), 2, 3) {
    const Mesh<Dim> whole = two_boxes<Dim>();
    const std::vector<int> owner = slices(whole, 3);
    std::int32_t n_own = 0, n_boundary = 0;
    for (int rank = 0; rank < 3; ++rank) {
        const MeshPart<Dim> part = part_of<Dim>(whole, owner, rank, 2);
        const Mesh<Dim>& mesh = part.mesh;
        CHECK(part.n_cells == whole.n_cells());
        REQUIRE(std::ssize(part.cell_number) == mesh.n_cells());
        CHECK(std::ranges::is_sorted(part.cell_number));
        CHECK(mesh.body_names == whole.body_names);
        CHECK(mesh.groups.size() == whole.groups.size());
        CHECK(std::ranges::is_sorted(mesh.face_cells, {}, [](const auto& cells) { return cells[0]; }));
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            const std::int32_t number = part.cell_number[static_cast<std::size_t>(c)];
            CHECK(part.cell_owner[static_cast<std::size_t>(c)] == owner[static_cast<std::size_t>(number)]);
            CHECK(mesh.cell_centroid[static_cast<std::size_t>(c)] == whole.cell_centroid[static_cast<std::size_t>(number)]);
            REQUIRE(mesh.cell_faces[c].size() == whole.cell_faces[number].size());
            // The faces close the cell: area vectors that point out of it sum to zero, and its volume is theirs.
            Vector<Dim> sum = Vector<Dim>::Zero();
            double volume = 0.0;
            for (const std::int32_t f : mesh.cell_faces[c]) {
                const double sign = mesh.face_cells[f][0] == c ? 1.0 : -1.0;
                CHECK((mesh.face_cells[f][0] == c || mesh.face_cells[f][1] == c));
                const Vector<Dim> area = sign * mesh.face_measure[f] * mesh.face_normal[f];
                sum += area;
                volume += area.dot(mesh.face_centroid[f]) / Dim;
            }
            CHECK(sum.norm() < 1e-14);
            CHECK(volume == Approx(mesh.cell_measure[static_cast<std::size_t>(c)]).epsilon(1e-12));
            if (part.cell_owner[static_cast<std::size_t>(c)] != rank) continue;
            ++n_own;
            for (std::size_t i = 0; i < mesh.cell_faces[c].size(); ++i) {
                const bool is_boundary = mesh.is_boundary(mesh.cell_faces[c][i]);
                CHECK(is_boundary == whole.is_boundary(whole.cell_faces[number][i]));
                n_boundary += is_boundary;
            }
        }
    }
    CHECK(n_own == whole.n_cells());
    CHECK(n_boundary == std::ssize(whole.boundary_faces));
}

TEMPLATE_TEST_CASE_SIG("of some bodies each part has the whole, a rank without other cells too", "[mesh][part]",
                       ((int Dim), Dim), 2, 3) {
    const Mesh<Dim> whole = two_boxes<Dim>();
    const std::vector<int> owner = slices(whole, 3);
    for (int rank = 0; rank < 4; ++rank) {  // the last one owns nothing
        const MeshPart<Dim> with = part_of<Dim>(whole, owner, rank, 1, std::vector<std::int32_t>{1});
        const MeshPart<Dim> without = part_of<Dim>(whole, owner, rank, 1);
        const auto n_cells = [](const Mesh<Dim>& mesh, int body) { return std::ranges::count(mesh.cell_body, body); };
        const auto n_boundary = [](const Mesh<Dim>& mesh, int body) {
            return std::ranges::count_if(mesh.boundary_faces,
                                         [&](int f) { return mesh.cell_body[mesh.face_cells[f][0]] == body; });
        };
        CHECK(n_cells(with.mesh, 1) == n_cells(whole, 1));
        CHECK(n_boundary(with.mesh, 1) == n_boundary(whole, 1));
        CHECK(n_cells(with.mesh, 0) == n_cells(without.mesh, 0));
        CHECK(n_boundary(with.mesh, 0) == n_boundary(without.mesh, 0));
        for (std::size_t c = 0; c < with.cell_number.size(); ++c)
            CHECK(with.cell_owner[c] == owner[static_cast<std::size_t>(with.cell_number[c])]);
    }
}

TEST_CASE("copies lie as many layers deep as were asked for", "[mesh][part]") {
    // Squares in a row: a layer is one square.
    const Mesh<2> whole = structured_box<2>({0.0, 0.0}, {20.0, 1.0}, {20, 1}, CellShape::quadrangle);
    const std::vector<int> owner = [&] {
        std::vector<int> of_cells;
        for (const Vector<2>& x : whole.cell_centroid) of_cells.push_back(x[0] < 10.0 ? 0 : 1);
        return of_cells;
    }();
    for (const int layers : {1, 3, 8, 100})
        CHECK(part_of<2>(whole, owner, 0, layers).mesh.n_cells() == std::min(20, 10 + layers));
    CHECK(part_of<2>(whole, owner, 7).mesh.n_cells() == 0);  // a rank without cells
}

TEST_CASE("cells that share a vertex with own ones are copies, also where a body is pinched", "[mesh][part]") {
    // Two triangles with one vertex in common, no face.
    CellSoup<2> soup{.name = "bow", .vertices = {{0, 0}, {-1, 1}, {-1, -1}, {1, -1}, {1, 1}}};
    soup.cell_shape = {CellShape::triangle, CellShape::triangle};
    soup.cell_vertices.append(std::array<std::int32_t, 3>{0, 1, 2});
    soup.cell_vertices.append(std::array<std::int32_t, 3>{0, 3, 4});
    soup.cell_body = {0, 0};
    soup.body_names = {"bow"};
    const Mesh<2> whole = build_mesh<2>(soup);
    const std::vector<int> owner{0, 1};
    CHECK(part_of<2>(whole, owner, 0).mesh.n_cells() == 2);
    CHECK(part_of<2>(whole, owner, 1).mesh.n_cells() == 2);
}

TEMPLATE_TEST_CASE_SIG("a part is the same after its way as bytes", "[mesh][part]", ((int Dim), Dim), 2, 3) {
    const Mesh<Dim> whole = two_boxes<Dim>();
    const MeshPart<Dim> part = part_of<Dim>(whole, slices(whole, 3), 1);
    const std::vector<std::byte> bytes = bytes_of(part);
    const MeshPart<Dim> read = part_in<Dim>(bytes);
    CHECK(read.n_cells == whole.n_cells());
    CHECK(read.cell_number == part.cell_number);
    CHECK(read.cell_owner == part.cell_owner);
    CHECK(read.mesh.name == part.mesh.name);
    CHECK(read.mesh.vertices == part.mesh.vertices);
    CHECK(read.mesh.cell_shape == part.mesh.cell_shape);
    CHECK(read.mesh.cell_vertices.values == part.mesh.cell_vertices.values);
    CHECK(read.mesh.cell_faces.offsets == part.mesh.cell_faces.offsets);
    CHECK(read.mesh.cell_faces.values == part.mesh.cell_faces.values);
    CHECK(read.mesh.cell_body == part.mesh.cell_body);
    CHECK(read.mesh.cell_measure == part.mesh.cell_measure);
    CHECK(read.mesh.cell_centroid == part.mesh.cell_centroid);
    CHECK(read.mesh.face_vertices.values == part.mesh.face_vertices.values);
    CHECK(read.mesh.face_cells == part.mesh.face_cells);
    CHECK(read.mesh.face_measure == part.mesh.face_measure);
    CHECK(read.mesh.face_centroid == part.mesh.face_centroid);
    CHECK(read.mesh.face_normal == part.mesh.face_normal);
    CHECK(read.mesh.boundary_faces == part.mesh.boundary_faces);
    CHECK(read.mesh.body_names == part.mesh.body_names);
    CHECK(read.mesh.cell_label == part.mesh.cell_label);
    CHECK(read.mesh.vertex_label == part.mesh.vertex_label);
    CHECK(std::ranges::equal(read.mesh.groups, part.mesh.groups,
                             [](const auto& a, const auto& b) { return a.name == b.name && a.faces == b.faces; }));
    CHECK(bytes_of(read) == bytes);
    CHECK_THROWS_AS(mesh_in<Dim>(bytes), BadInput);
    CHECK_THROWS_AS(part_in<Dim>(std::span(bytes).first(bytes.size() / 2)), BadInput);
}

TEST_CASE("parts of unusable input are refused", "[mesh][part]") {
    const Mesh<2> whole = structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {3, 3}, CellShape::quadrangle);
    const std::vector<int> owner(9, 0), few(8, 0);
    CHECK_THROWS_AS(part_of<2>(whole, few, 0), BadInput);
    CHECK_THROWS_AS(part_of<2>(whole, owner, 0, 0), BadInput);
    CHECK_THROWS_AS(part_of<2>(whole, owner, 0, 1, std::vector<std::int32_t>{7}), BadInput);
    CellSoup<2> soup{.name = "mixed", .vertices = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0.5}}};
    soup.cell_shape = {CellShape::quadrangle, CellShape::triangle};
    soup.cell_vertices.append(std::array<std::int32_t, 4>{0, 1, 2, 3});
    soup.cell_vertices.append(std::array<std::int32_t, 3>{1, 4, 2});
    soup.cell_body = {0, 0};
    soup.body_names = {"body"};
    const Mesh<2> mixed = build_mesh<2>(soup);
    CHECK_THROWS_AS(part_of<2>(mixed, std::vector<int>{0, 1}, 0), BadInput);
}

TEMPLATE_TEST_CASE_SIG("a mesh without some cells has the others, and closes where they were", "[mesh][part]",
                       ((int Dim), Dim), 2, 3) {
    const Mesh<Dim> whole = two_boxes<Dim>();
    const std::vector<std::int32_t> gone{whole.n_cells() - 1, 7, 0};
    const auto [mesh, old_cells] = without_cells<Dim>(whole, gone);
    REQUIRE(mesh.n_cells() == whole.n_cells() - 3);
    CHECK(mesh.body_names == whole.body_names);
    double volume = 0.0, lost = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const std::int32_t old = old_cells[static_cast<std::size_t>(c)];
        CHECK(std::ranges::find(gone, old) == gone.end());
        CHECK(mesh.cell_label[c] == whole.cell_label[old]);
        CHECK(mesh.cell_centroid[c] == whole.cell_centroid[old]);
        volume += mesh.cell_measure[c];
        for (std::size_t k = 0; k < mesh.cell_vertices[c].size(); ++k)
            CHECK(mesh.vertices[mesh.cell_vertices[c][k]] == whole.vertices[whole.cell_vertices[old][k]]);
    }
    for (const std::int32_t c : gone) lost += whole.cell_measure[c];
    double before = 0.0;
    for (const double measure : whole.cell_measure) before += measure;
    CHECK(volume + lost == Approx(before).epsilon(1e-13));
    // By Gauss, of the surface alone: the volume, and area vectors that sum to zero.
    double enclosed = 0.0;
    Vector<Dim> sum = Vector<Dim>::Zero();
    std::size_t in_groups = 0, known = 0;
    for (const std::int32_t f : mesh.boundary_faces) {
        const Vector<Dim> area = mesh.face_measure[f] * mesh.face_normal[f];
        enclosed += mesh.face_centroid[f].dot(area) / Dim;
        sum += area;
    }
    CHECK(enclosed == Approx(volume).epsilon(1e-12));
    CHECK(sum.norm() < 1e-12);
    // Groups have lost the faces of these cells, and have got none.
    for (const BoundaryGroup& group : mesh.groups) in_groups += group.faces.size();
    for (const BoundaryGroup& group : whole.groups)
        for (const std::int32_t f : group.faces)
            known += std::ranges::find(gone, whole.face_cells[f][0]) == gone.end() ? 1 : 0;
    CHECK(in_groups == known);
    CHECK(mesh.groups.size() == whole.groups.size());
}

TEST_CASE("cells that cannot be taken out are refused", "[mesh][part]") {
    const Mesh<2> mesh = two_boxes<2>();
    CHECK_THROWS_WITH(without_cells<2>(mesh, std::vector{mesh.n_cells()}), Catch::Contains("does not exist"));
    CHECK_THROWS_WITH(without_cells<2>(mesh, std::vector{3, 3}), Catch::Contains("given twice"));
    std::vector<std::int32_t> body;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (mesh.cell_body[c] == 0) body.push_back(c);
    CHECK_THROWS_WITH(without_cells<2>(mesh, body), Catch::Contains("all cells of body 'low'"));
}

TEMPLATE_TEST_CASE_SIG("vertices and faces of a mesh that has lost cells are told by their numbers in the whole one",
                       "[mesh][part]", ((int Dim), Dim), 2, 3) {
    const Mesh<Dim> whole = two_boxes<Dim>();
    std::vector<std::int32_t> gone;
    for (std::int32_t c = 0; c < whole.n_cells(); c += 7) gone.push_back(c);
    const auto [rest, old_cells] = without_cells(whole, gone);
    CHECK(rest.has_lost_cells);
    CHECK_FALSE(whole.has_lost_cells);
    CHECK_FALSE(without_cells<Dim>(whole, {}).mesh.has_lost_cells);
    const std::vector<std::int32_t> vertices = old_vertices(whole, rest, old_cells),
                                    faces = old_faces(whole, rest, old_cells);
    REQUIRE(vertices.size() == rest.vertices.size());
    REQUIRE(faces.size() == rest.face_measure.size());
    for (std::size_t v = 0; v < vertices.size(); ++v)
        REQUIRE(rest.vertices[v] == whole.vertices[static_cast<std::size_t>(vertices[v])]);
    for (std::size_t f = 0; f < faces.size(); ++f)
        REQUIRE(rest.face_centroid[f] == whole.face_centroid[static_cast<std::size_t>(faces[f])]);
}
