#include <catch2/catch.hpp>

#include "abut/contact/pairs/pair.hpp"
#include "abut/contact/pairs/pair_list.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;
using contact::InterfaceWeighting;

namespace {

/// Two unit tiles face to face; face 0 looks up, face 1 down.
template <int Dim>
contact::Surface<Dim> two_tiles(double stiffness_1, double stiffness_2) {
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.1, stiffness_1, 0);
    surface.append(tile<Dim>(0.01 * up<Dim>(), -up<Dim>(), 0.5), 0.2, stiffness_2, 1);
    return surface;
}

template <int Dim>
contact::ContactPair<Dim> pair_of(const contact::Surface<Dim>& surface, std::int32_t face_1, std::int32_t face_2,
                                  InterfaceWeighting weighting) {
    contact::PairList<Dim> list;
    list.append(surface.view(), face_1, face_2, weighting);
    return list.pairs()[0];
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the softer side of a pair takes the larger share: theta_1 = k_2 / (k_1 + k_2)", "[contact][weights]",
                       ((int Dim), Dim), 2, 3) {
    const auto surface = two_tiles<Dim>(1.0, 3.0);
    const auto pair = pair_of(surface, 0, 1, InterfaceWeighting::stiffness);
    CHECK(pair.theta_1 == Approx(0.75).epsilon(1e-15));
    CHECK(pair.theta_1 + pair.theta_2 == 1.0);
    CHECK(pair_of(surface, 0, 1, InterfaceWeighting::half).theta_1 == 0.5);
}

TEMPLATE_TEST_CASE_SIG("equal stiffness shares a pair equally, whatever the weights", "[contact][weights]", ((int Dim), Dim),
                       2, 3) {
    const InterfaceWeighting weighting = GENERATE(InterfaceWeighting::half, InterfaceWeighting::stiffness);
    const auto pair = pair_of(two_tiles<Dim>(7.0, 7.0), 0, 1, weighting);
    CHECK(pair.theta_1 == 0.5);
    CHECK(pair.theta_2 == 0.5);
}

TEMPLATE_TEST_CASE_SIG(
    "against a rigid face the deformable one takes the whole correction, on either side and with either weights",
    "[contact][weights]", ((int Dim), Dim), 2, 3) {
    const InterfaceWeighting weighting = GENERATE(InterfaceWeighting::half, InterfaceWeighting::stiffness);
    const auto rigid_second = pair_of(two_tiles<Dim>(1.0, rigid), 0, 1, weighting);
    CHECK(rigid_second.theta_1 == 1.0);
    CHECK(rigid_second.theta_2 == 0.0);
    const auto rigid_first = pair_of(two_tiles<Dim>(rigid, 1.0), 0, 1, weighting);
    CHECK(rigid_first.theta_1 == 0.0);
    CHECK(rigid_first.theta_2 == 1.0);
    const auto nearly = pair_of(two_tiles<Dim>(1.0, 1e15), 0, 1, InterfaceWeighting::stiffness);
    CHECK(nearly.theta_1 == Approx(1.0).epsilon(1e-14));
}

TEMPLATE_TEST_CASE_SIG("swapping the faces of a pair negates its normal and changes nothing else", "[contact][pairs]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(5);
    for (int trial = 0; trial < 50; ++trial) {
        const auto surface = random_surface<Dim>(random, 1);
        const auto u = random_displacement(random, surface, 0.5);
        contact::PairList<Dim> list;
        list.append(surface.view(), 0, 1, InterfaceWeighting::stiffness);
        list.append(surface.view(), 1, 0, InterfaceWeighting::stiffness);
        const auto& forward = list.pairs()[0];
        const auto& backward = list.pairs()[1];
        const auto at = list.position(surface.view(), forward, u[0], u[1]);
        const auto swapped = list.position(surface.view(), backward, u[1], u[0]);
        CHECK((forward.frame.normal() + backward.frame.normal()).norm() < 1e-15);
        CHECK(forward.frame.normal().norm() == Approx(1.0).epsilon(1e-15));
        CHECK(forward.theta_1 == Approx(backward.theta_2).epsilon(1e-15));
        CHECK(forward.admission_depth == backward.admission_depth);
        CHECK(at.gap == Approx(swapped.gap).margin(1e-15));
        const auto shared = list.overlap(forward, at.tangential_offset, geometry::AreaMethod::fast);
        const auto shared_back = list.overlap(backward, swapped.tangential_offset, geometry::AreaMethod::fast);
        CHECK(shared.area == Approx(shared_back.area).margin(1e-14));
        // Moving face 2 one way is moving face 1 the other way.
        CHECK((forward.frame.lift(shared.area_gradient) + backward.frame.lift(shared_back.area_gradient)).norm() < 1e-12);
    }
}

TEMPLATE_TEST_CASE_SIG(
    "of faces of one size, far from sharp edges, the pair normal is halfway; an obstacle's face gives its own",
    "[contact][pairs]", ((int Dim), Dim), 2, 3) {
    const double angle = 0.4;
    const Vector<Dim> tilted = -(std::cos(angle) * up<Dim>() + std::sin(angle) * axis<Dim>(0));
    const Vector<Dim> halfway = std::cos(0.5 * angle) * up<Dim>() + std::sin(0.5 * angle) * axis<Dim>(0);
    for (const double stiffness : {1.0, rigid}) {
        contact::Surface<Dim> surface;
        surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.1, 1.0, 0);
        surface.append(tile<Dim>(up<Dim>(), tilted, 0.5), 0.1, stiffness, 1);
        const Vector<Dim> expected = stiffness == rigid ? Vector<Dim>(-tilted) : halfway;
        CHECK((pair_of(surface, 0, 1, InterfaceWeighting::half).frame.normal() - expected).norm() < 1e-15);
    }
}

TEMPLATE_TEST_CASE_SIG(
    "the much larger of two elastic faces gives the normal, near sharp edges, too: the gap is the height of "
    "the smaller one's centroid over it",
    "[contact][pairs]", ((int Dim), Dim), 2, 3) {
    const double angle = 0.4, height = 0.01, size = GENERATE(0.66, 0.71, 1.0, 1.4, 1.5);  // of the tilted face
    const Vector<Dim> tilted = -(std::cos(angle) * up<Dim>() + std::sin(angle) * axis<Dim>(0));
    const Vector<Dim> halfway = std::cos(0.5 * angle) * up<Dim>() + std::sin(0.5 * angle) * axis<Dim>(0);
    const Vector<Dim> between = height * up<Dim>() + 0.4 * axis<Dim>(0);  // of the centroids
    const bool near_edge = GENERATE(false, true);
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.1, 1.0, 0);
    surface.append(tile<Dim>(between, tilted, 0.5 * size), 0.1, 1.0, 1);
    if (near_edge) surface.steps_to_sharp_edge = {0, 0};
    const Vector<Dim> expected = size < 0.69 ? up<Dim>() : size > 1.45 ? Vector<Dim>(-tilted) : halfway;
    contact::PairList<Dim> list;
    list.append(surface.view(), 0, 1, InterfaceWeighting::half);
    const auto& pair = list.pairs()[0];
    CHECK((pair.frame.normal() - expected).norm() < 1e-15);
    const Vector<Dim> zero = Vector<Dim>::Zero();
    CHECK(list.position(surface.view(), pair, zero, zero).gap == Approx(between.dot(expected)).epsilon(1e-14));
    const auto swapped = pair_of(surface, 1, 0, InterfaceWeighting::half);
    CHECK((swapped.frame.normal() + pair.frame.normal()).norm() < 1e-15);
    if (near_edge && size < 0.69) {  // farther from an edge, but small
        surface.steps_to_sharp_edge = {0, 3};
        CHECK((pair_of(surface, 0, 1, InterfaceWeighting::half).frame.normal() - up<Dim>()).norm() < 1e-15);
    }
}

TEMPLATE_TEST_CASE_SIG("faces look at each other from 101.6 degrees between their normals on", "[contact][pairs]",
                       ((int Dim), Dim), 2, 3) {
    const double degrees = GENERATE(0.0, 90.0, 101.4, 101.6, 180.0);
    const double angle = degrees * std::numbers::pi / 180.0;
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.1, 1.0, 0);
    surface.append(tile<Dim>(up<Dim>(), std::cos(angle) * up<Dim>() + std::sin(angle) * axis<Dim>(0), 0.5), 0.1, 1.0, 1);
    CHECK(contact::are_facing<Dim>(surface.view(), 0, 1, contact::ContactOptions{}.search.facing_cosine) ==
          (degrees > 101.5));
    CHECK(contact::are_facing<Dim>(surface.view(), 1, 0, contact::ContactOptions{}.search.facing_cosine) ==
          (degrees > 101.5));
}

TEMPLATE_TEST_CASE_SIG("a gap is what lies between the centroids along the normal, at rest and displaced",
                       "[contact][pairs]", ((int Dim), Dim), 2, 3) {
    const auto surface = two_tiles<Dim>(1.0, 1.0);
    contact::PairList<Dim> list;
    list.append(surface.view(), 0, 1, InterfaceWeighting::half);
    const Vector<Dim> zero = Vector<Dim>::Zero();
    const Vector<Dim> sideways = 0.25 * axis<Dim>(0);
    CHECK(list.position(surface.view(), list.pairs()[0], zero, zero).gap == Approx(0.01).epsilon(1e-14));
    CHECK(list.position(surface.view(), list.pairs()[0], zero, sideways - 0.03 * up<Dim>()).gap ==
          Approx(-0.02).epsilon(1e-14));
    const auto at = list.position(surface.view(), list.pairs()[0], zero, sideways);
    CHECK(at.tangential_offset.norm() == Approx(0.25).epsilon(1e-15));
    CHECK(list.overlap(list.pairs()[0], at.tangential_offset, geometry::AreaMethod::fast).area ==
          Approx(0.75).epsilon(1e-15));
}
