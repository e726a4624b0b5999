#include "abut/mesh/unjoined_faces.hpp"
#include "mesh/meshes.hpp"

using namespace abut;
using namespace abut::mesh;

namespace {

/// Two boxes, one on top of the other, of n[0] and n[1] cells a side; as one body, without a vertex in common, or as two.
template <int Dim>
Mesh<Dim> stacked(const std::array<CellShape, 2>& shape, const std::array<int, 2>& n, double gap, bool as_one_body) {
    const auto box = [&](std::size_t i) {
        Vector<Dim> at = Vector<Dim>::Zero();
        at[Dim - 1] = i == 0 ? 0.0 : 1.0 + gap;
        std::array<int, Dim> cells;
        cells.fill(n[i]);
        return structured_box<Dim>(at, at + Vector<Dim>::Ones(), cells, shape[i], i == 0 ? "low" : "high");
    };
    const std::vector<Mesh<Dim>> both = {box(0), box(1)};
    const Mesh<Dim> two = combine<Dim>(both);
    if (!as_one_body) return two;
    CellSoup<Dim> soup = test::soup_of(two);
    soup.body_names = {"pile"};
    std::ranges::fill(soup.cell_body, 0);
    return build_mesh(soup);
}

}  // namespace

TEST_CASE("faces of one body that lie on each other and are not joined are found", "[mesh][unjoined]") {
    const auto found = [](const std::array<int, 2>& n, double gap, bool as_one_body) {
        return find_unjoined_faces(stacked<2>({CellShape::quadrangle, CellShape::quadrangle}, n, gap, as_one_body));
    };
    CHECK(found({4, 3}, 0.0, true).n_faces == 4 + 3);  // cells that do not match
    CHECK(found({4, 4}, 0.0, true).n_faces == 4 + 4);  // vertices that were not merged
    CHECK(found({4, 3}, 1e-9, true).n_faces == 7);
    CHECK(found({4, 3}, 1e-3, true).n_faces == 0);
    CHECK(found({4, 3}, 0.0, false).n_faces == 0);  // two bodies
    const UnjoinedFaces pile = found({4, 3}, 0.0, true);
    CHECK(pile.body == "pile");
    CHECK(pile.place[1] == Approx(1.0));
}

TEST_CASE("faces that something else holds together are joined", "[mesh][unjoined]") {
    const Mesh<2> pile = stacked<2>({CellShape::quadrangle, CellShape::quadrangle}, {2, 2}, 0.0, true);
    std::vector<std::array<std::int32_t, 2>> bonded;
    for (const std::int32_t low : pile.boundary_faces)
        for (const std::int32_t high : pile.boundary_faces)
            if (low != high && pile.face_centroid[low] == pile.face_centroid[high]) bonded.push_back({high, low});
    REQUIRE(bonded.size() == 2 * 2);  // two pairs, in both orders
    CHECK(find_unjoined_faces(pile).n_faces == 4);
    CHECK(find_unjoined_faces<2>(pile, bonded).n_faces == 0);
    CHECK(find_unjoined_faces<2>(pile, std::span(bonded).first(1)).n_faces == 2);
}

TEST_CASE("in space faces that share a part of their area are found, whatever their shapes", "[mesh][unjoined]") {
    const auto found = [](CellShape low, CellShape high, const std::array<int, 2>& n) {
        return find_unjoined_faces(stacked<3>({low, high}, n, 0.0, true)).n_faces;
    };
    CHECK(found(CellShape::hexahedron, CellShape::hexahedron, {2, 3}) == 4 + 9);
    CHECK(found(CellShape::tetrahedron, CellShape::hexahedron, {2, 2}) == 8 + 4);
    CHECK(found(CellShape::tetrahedron, CellShape::tetrahedron, {2, 3}) == 8 + 18);
}

TEST_CASE("meshes whose cells match have no unjoined faces", "[mesh][unjoined]") {
    for (const CellShape shape : test::shapes_2d) CHECK(find_unjoined_faces(test::small_box(shape)).n_faces == 0);
    for (const CellShape shape : test::shapes_3d) CHECK(find_unjoined_faces(test::small_box_3d(shape)).n_faces == 0);
    CHECK(find_unjoined_faces(cylinder({.size = 0.4})).n_faces == 0);
}
