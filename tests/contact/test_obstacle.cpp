#include <catch2/catch.hpp>

#include "abut/contact/surface/obstacle_side.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;

TEMPLATE_TEST_CASE_SIG("a plane obstacle is a flat face of the wanted size that looks along its normal",
                       "[contact][obstacle]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 20; ++trial) {
        const Vector<Dim> point = random_vector<Dim>(random, 5.0);
        const Vector<Dim> normal = random_vector<Dim>(random, 2.0);
        const double half = uniform(random, 0.1, 100.0);
        contact::Surface<Dim> surface;
        contact::append(surface, contact::plane_obstacle<Dim>(point, normal, half), 4);
        REQUIRE(surface.size() == 1);
        CHECK_NOTHROW(contact::check(surface.view()));
        CHECK((surface.normal[0] - normal.normalized()).norm() < 1e-14);
        CHECK((surface.centroid[0] - point).norm() < 1e-13 * half + 1e-14);
        CHECK(surface.area[0] == Approx(std::pow(2.0 * half, Dim - 1)).epsilon(1e-13));
        CHECK(surface.cell_depth[0] == 0.0);
        CHECK(surface.body[0] == 4);
        CHECK(surface.view().is_rigid(0));
    }
}

TEMPLATE_TEST_CASE_SIG("a plane obstacle without a direction or a size is refused", "[contact][obstacle]", ((int Dim), Dim),
                       2, 3) {
    const Vector<Dim> origin = Vector<Dim>::Zero();
    CHECK_THROWS_AS(contact::plane_obstacle<Dim>(origin, origin, 1.0), BadInput);
    CHECK_THROWS_AS(contact::plane_obstacle<Dim>(origin, up<Dim>(), 0.0), BadInput);
    CHECK_THROWS_AS(contact::plane_obstacle<Dim>(origin, up<Dim>(), -1.0), BadInput);
    CHECK_THROWS_AS(contact::plane_obstacle<Dim>(origin, up<Dim>(), std::nan("")), BadInput);
}

TEMPLATE_TEST_CASE_SIG("an obstacle pushes a face out to its own plane: the correction of a covered face is -g n",
                       "[contact][obstacle]", ((int Dim), Dim), 2, 3) {
    const double pressed = 0.03;
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), -up<Dim>(), 0.5), 0.2, 2.0, 0);
    contact::append(surface, contact::plane_obstacle<Dim>(pressed * up<Dim>(), up<Dim>(), 7.0), 1);
    Mover<Dim> mover(surface, {});
    mover.search(at_rest(surface));
    REQUIRE(mover.move_to(at_rest(surface)));
    CHECK((mover.contact.last().mean_correction[contact::ListedFace{0}] - pressed * up<Dim>()).norm() < 1e-15);
    CHECK(mover.contact.last().mean_correction[contact::ListedFace{1}].isZero(0.0));
    CHECK((mover.contact.last().mean_gradient[contact::ListedFace{0}] +
           mover.contact.last().mean_gradient[contact::ListedFace{1}])
              .norm() < 1e-15);
}

TEMPLATE_TEST_CASE_SIG("an endless plane is one face around a circle of its reach about the foot of its middle",
                       "[contact][obstacle]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(5);
    for (int trial = 0; trial < 20; ++trial) {
        const Vector<Dim> point = random_vector<Dim>(random, 5.0), middle = random_vector<Dim>(random, 5.0);
        const Vector<Dim> normal = random_vector<Dim>(random, 2.0), n = normal.normalized();
        const double reach = uniform(random, 10.0, 1000.0);
        contact::Surface<Dim> surface;
        contact::append(surface, contact::endless_plane_obstacle<Dim>(point, normal, middle, reach), 0);
        REQUIRE(surface.size() == 1);
        CHECK_NOTHROW(contact::check(surface.view()));
        CHECK((surface.normal[0] - n).norm() < 1e-13);
        const Vector<Dim> foot = middle - n.dot(middle - point) * n;
        CHECK((surface.centroid[0] - foot).norm() < 1e-12 * reach);
        for (const Vector<Dim>& corner : surface.vertices) CHECK(std::abs(n.dot(corner - point)) < 1e-13 * reach);
        CHECK(surface.area[0] == Approx(Dim == 2 ? 2.0 * reach : 3.0 * std::sqrt(3.0) * reach * reach).epsilon(1e-12));
    }
}

TEST_CASE("a point is in front of an obstacle or behind it by the nearest of its faces", "[contact][obstacle]") {
    // A step: a tread from (-1, 0) to (0, 0), a riser down to (0, -1), and ground from there. The outside is above.
    const std::vector<std::vector<Vector<2>>> step{
        {{0.0, 0.0}, {-1.0, 0.0}}, {{0.0, -1.0}, {0.0, 0.0}}, {{1.0, -1.0}, {0.0, -1.0}}};
    const auto side = [&](double x, double y) { return contact::side_of<2>(step, Vector<2>(x, y)); };
    CHECK(side(-0.5, 0.3) == Approx(0.3));
    CHECK(side(-0.5, -0.2) == Approx(-0.2));
    CHECK(side(0.2, -0.4) == Approx(0.2));
    CHECK(side(0.3, 0.4) == Approx(0.5));  // beyond its edge
    CHECK(side(-0.1, -0.9) == Approx(-0.1));
    CHECK(side(0.5, -1.5) == Approx(-0.5));
    CHECK(side(-3.0, 0.1) > 0.0);  // beside the tread
    CHECK(std::isinf(contact::side_of<2>({}, Vector<2>(0.0, 0.0))));

    std::vector<std::vector<Vector<3>>> tetrahedron{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                                                    {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                                                    {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                                    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    CHECK(contact::side_of<3>(tetrahedron, Vector<3>(0.1, 0.1, 0.05)) == Approx(-0.05));
    CHECK(contact::side_of<3>(tetrahedron, Vector<3>(0.2, 0.2, -0.3)) == Approx(0.3));
    CHECK(contact::side_of<3>(tetrahedron, Vector<3>(2.0, 0.0, 0.0)) == Approx(1.0));    // beyond a corner
    CHECK(contact::side_of<3>(tetrahedron, Vector<3>(-0.3, -0.4, 0.5)) == Approx(0.5));  // beyond an edge
    for (auto& face : tetrahedron) std::reverse(face.begin(), face.end());
    CHECK(contact::side_of<3>(tetrahedron, Vector<3>(2.0, 0.0, 0.0)) == Approx(-1.0));
}
