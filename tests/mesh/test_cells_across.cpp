#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "abut/mesh/cells_across.hpp"
#include "abut/mesh/shapes/shapes.hpp"

using namespace abut;

TEST_CASE("cells across a body are those of its thinnest direction, rounded up to an even number, in all shapes", "[mesh]") {
    for (const int n : {1, 2, 3, 4, 7, 8}) {
        const int even = n + n % 2;
        for (const auto shape : {mesh::CellShape::quadrangle, mesh::CellShape::triangle}) {
            const auto plate = mesh::structured_box<2>({0.0, 0.0}, {3.0, 1.0}, {20, n}, shape, "plate");
            CHECK(mesh::cells_across(plate) == std::vector<int>{even});
        }
        for (const auto shape : {mesh::CellShape::hexahedron, mesh::CellShape::tetrahedron}) {
            const auto bar = mesh::structured_box<3>({0.0, 0.0, 0.0}, {2.0, 2.0, 1.0}, {9, 9, n}, shape, "bar");
            CHECK(mesh::cells_across(bar) == std::vector<int>{even});
        }
    }
}

TEST_CASE("each body has its own number of cells across", "[mesh]") {
    const std::array bodies{mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {4, 4}, mesh::CellShape::quadrangle, "left"),
                            mesh::structured_box<2>({2.0, 0.0}, {3.0, 1.0}, {10, 10}, mesh::CellShape::quadrangle, "right")};
    CHECK(mesh::cells_across(mesh::combine<2>(bodies)) == std::vector<int>{4, 10});
}
