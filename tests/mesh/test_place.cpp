#include <array>
#include <catch2/catch.hpp>
#include <limits>
#include <numbers>

#include "abut/base/error.hpp"
#include "abut/base/rotation.hpp"
#include "abut/mesh/place.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "mesh/laws.hpp"

namespace {

using namespace abut;
using namespace abut::mesh;

}  // namespace

TEST_CASE("a box that is turned by a quarter and moved is the box of the turned corners", "[mesh][place]") {
    auto placed = structured_box<2>({0.0, 0.0}, {2.0, 1.0}, {2, 1}, CellShape::quadrangle);
    place<2>(placed, rotation_in_plane(0.5 * std::numbers::pi), {3.0, 0.0});
    const auto expected = structured_box<2>({2.0, 0.0}, {3.0, 2.0}, {1, 2}, CellShape::quadrangle);
    REQUIRE(placed.n_cells() == expected.n_cells());
    for (const Vector<2>& x : expected.cell_centroid) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vector<2>& y : placed.cell_centroid) nearest = std::min(nearest, (x - y).norm());
        CHECK(nearest < 1e-15);
    }
    CHECK(placed.group("xmax").faces.size() == 1);  // as it was called before
    const auto top = static_cast<std::size_t>(placed.group("xmax").faces[0]);
    CHECK((placed.face_normal[top] - Vector<2>(0.0, 1.0)).norm() < 1e-15);
}

TEST_CASE("a mesh that is turned about a skew axis keeps the laws of a mesh", "[mesh][place]") {
    auto mesh = structured_box<3>({0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}, {2, 2, 2}, CellShape::tetrahedron);
    place<3>(mesh, rotation_about(Vector<3>(1.0, 2.0, -1.0).normalized(), 0.7), {5.0, -1.0, 2.0});
    test::check_closed_cells(mesh);
    test::check_two_sides(mesh);
}

TEST_CASE("a turn that is no rotation is refused, and so is an offset that is not finite", "[mesh][place]") {
    auto mesh = fan_disc({0.0, 0.0}, 1.0, 6);
    const Matrix<2> one = Matrix<2>::Identity();
    CHECK_THROWS_AS(place<2>(mesh, 1.001 * one, Vector<2>::Zero()), BadInput);
    CHECK_THROWS_AS(place<2>(mesh, Matrix<2>(Vector<2>(1.0, -1.0).asDiagonal()), Vector<2>::Zero()), BadInput);
    CHECK_THROWS_AS(place<2>(mesh, one, Vector<2>(0.0, std::numeric_limits<double>::quiet_NaN())), BadInput);
}
