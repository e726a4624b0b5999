#include <array>
#include <catch2/catch.hpp>

#include "abut/mesh/edge_lengths.hpp"
#include "abut/mesh/shapes/shapes.hpp"

using namespace abut;

TEST_CASE("edges of boxes have the lengths of their cells, each body its own", "[mesh]") {
    const std::array bodies{mesh::structured_box<2>({0.0, 0.0}, {1.0, 2.0}, {4, 4}, mesh::CellShape::quadrangle, "left"),
                            mesh::structured_box<2>({2.0, 0.0}, {3.0, 1.0}, {10, 10}, mesh::CellShape::quadrangle, "right")};
    const auto lengths = mesh::edge_lengths(mesh::combine<2>(bodies));
    CHECK(lengths[0].least == Approx(0.25));
    CHECK(lengths[0].largest == Approx(0.5));
    CHECK(lengths[0].mean == Approx(0.375));  // as many along x as along y
    CHECK(lengths[1].mean == Approx(0.1));
    const auto bar =
        mesh::structured_box<3>({0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}, {4, 4, 4}, mesh::CellShape::hexahedron, "bar");
    CHECK(mesh::edge_lengths(bar)[0].least == Approx(0.5));
    CHECK(mesh::edge_lengths(bar)[0].largest == Approx(0.5));
}
