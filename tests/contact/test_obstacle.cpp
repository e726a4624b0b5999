#include <catch2/catch.hpp>

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
