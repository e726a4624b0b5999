#include <catch2/catch.hpp>

#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;

namespace {

inline constexpr double depth = 0.3;  // of the cells behind either face, so D = 0.6

/// Body 0: a tile that looks up. Body 1: a tile above it that looks down. Both 1 wide, faces on one plane at rest.
template <int Dim>
contact::Surface<Dim> two_tiles() {
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), depth, 1.0, 0);
    surface.append(tile<Dim>(Vector<Dim>::Zero(), -up<Dim>(), 0.5), depth, 1.0, 1);
    return surface;
}

/// Body 1 at a gap and a sideways shift, body 0 at rest.
template <int Dim>
std::vector<Vector<Dim>> at(double gap, double shift) {
    return {Vector<Dim>::Zero(), gap * up<Dim>() + shift * axis<Dim>(0)};
}

contact::ContactOptions wide_skin() {
    contact::ContactOptions options;
    options.search.skin = 10.0;  // one list for all the moves below
    options.compression_limit = 100.0;
    return options;
}

template <int Dim>
bool pushes(const Mover<Dim>& mover) {
    for (const Vector<Dim>& gradient : mover.contact.last().mean_gradient)
        if (!gradient.isZero(0.0)) return true;
    return false;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a pair within the depth of its cells at the start is a contact", "[contact][admission]",
                       ((int Dim), Dim), 2, 3) {
    Mover<Dim> mover(two_tiles<Dim>(), wide_skin());
    mover.search(at<Dim>(-0.1, 0.0));
    CHECK(mover.move_to(at<Dim>(-0.1, 0.1)));
    CHECK(pushes(mover));
    CHECK(mover.contact.report().inadmissible_overlaps == 0);
    CHECK(mover.contact.report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("a pair deeper than its cells at the start is no contact", "[contact][admission]", ((int Dim), Dim),
                       2, 3) {
    Mover<Dim> mover(two_tiles<Dim>(), wide_skin());
    mover.search(at<Dim>(-0.7, 0.0));
    CHECK_FALSE(mover.move_to(at<Dim>(-0.65, 0.1)));
    CHECK_FALSE(pushes(mover));
    CHECK(mover.contact.report().inadmissible_overlaps == 1);
    // Not even when it comes up to less than D: only free of overlap may it change.
    CHECK_FALSE(mover.move_to(at<Dim>(-0.1, 0.1)));
    CHECK_FALSE(mover.move_to(at<Dim>(-0.2, 0.1)));
    CHECK(mover.contact.report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("the far side of a body is no contact of its near side", "[contact][admission]", ((int Dim), Dim), 2,
                       3) {
    // A slab of thickness 1: its top and its bottom "face" each other with g = -1, deeper than D = 0.6.
    contact::Surface<Dim> slab;
    slab.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), depth, 1.0, 0);
    slab.append(tile<Dim>(-up<Dim>(), -up<Dim>(), 0.5), depth, 1.0, 0);
    contact::ContactOptions options = wide_skin();
    options.search.self_contact = true;
    Mover<Dim> mover(slab, options);
    mover.search(at_rest(slab));
    REQUIRE(mover.contact.report().candidates == 1);
    CHECK_FALSE(mover.move_to(at_rest(slab)));
    CHECK_FALSE(pushes(mover));
    CHECK(mover.contact.report().inadmissible_overlaps == 1);
}

TEMPLATE_TEST_CASE_SIG("a body does not touch itself unless self-contact is asked for", "[contact][admission]",
                       ((int Dim), Dim), 2, 3) {
    auto surface = two_tiles<Dim>();
    surface.body[1] = 0;
    contact::ContactOptions options = wide_skin();
    options.search.self_contact = GENERATE(false, true);
    options.search.self_contact_rings = 0;  // the two share their corners
    Mover<Dim> mover(surface, options);
    mover.search(at<Dim>(-0.1, 0.0));
    CHECK((mover.contact.report().candidates == 1) == options.search.self_contact);
    CHECK(mover.move_to(at<Dim>(-0.1, 0.0)) == options.search.self_contact);
}

TEMPLATE_TEST_CASE_SIG("a pair that slides off an edge and comes back is the same contact", "[contact][admission]",
                       ((int Dim), Dim), 2, 3) {
    Mover<Dim> mover(two_tiles<Dim>(), wide_skin());
    mover.search(at<Dim>(0.1, 0.0));
    CHECK(mover.move_to(at<Dim>(-0.1, 0.0)));
    CHECK(mover.move_to(at<Dim>(-0.1, 0.9)));
    CHECK(mover.move_to(at<Dim>(-0.1, 1.2)));        // leaves during the step
    CHECK_FALSE(mover.move_to(at<Dim>(-0.1, 1.3)));  // A = 0, g < 0
    CHECK(mover.move_to(at<Dim>(-0.1, 0.8)));
    CHECK(pushes(mover));
    CHECK(mover.contact.report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("a pair that slides off an edge, sinks below its depth and comes back is no contact",
                       "[contact][admission]", ((int Dim), Dim), 2, 3) {
    Mover<Dim> mover(two_tiles<Dim>(), wide_skin());
    mover.search(at<Dim>(-0.1, 0.0));
    CHECK(mover.move_to(at<Dim>(-0.1, 1.2)));
    CHECK_FALSE(mover.move_to(at<Dim>(-0.9, 1.2)));
    CHECK_FALSE(mover.move_to(at<Dim>(-0.9, 0.2)));
    CHECK_FALSE(mover.move_to(at<Dim>(-0.1, 0.2)));
    CHECK_FALSE(pushes(mover));
    // Once apart, it may close again.
    CHECK_FALSE(mover.move_to(at<Dim>(0.1, 0.2)));
    CHECK(mover.move_to(at<Dim>(-0.1, 0.2)));
    CHECK(mover.contact.report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("an admitted pair stays a contact however deep it is pressed, through rebuilds of the list",
                       "[contact][admission]", ((int Dim), Dim), 2, 3) {
    Mover<Dim> mover(two_tiles<Dim>(), wide_skin());
    mover.search(at<Dim>(0.1, 0.0));
    CHECK(mover.move_to(at<Dim>(-0.5, 0.0)));
    CHECK(mover.move_to(at<Dim>(-1.5, 0.0)));
    mover.search(at<Dim>(-1.5, 0.0));
    CHECK(mover.move_to(at<Dim>(-1.4, 0.1)));
    mover.search(at<Dim>(-1.4, 0.1));
    CHECK(mover.move_to(at<Dim>(-1.4, 0.2)));
    CHECK(pushes(mover));
    CHECK(mover.contact.report().rebuilds == 3);
    CHECK(mover.contact.report().missed_contacts == 0);
    CHECK(mover.contact.report().compression_max == Approx(1.5 / (2.0 * depth)).epsilon(1e-14));
}

TEMPLATE_TEST_CASE_SIG("what sliding adds to a contact is reported: the gap times dA/ds over a face", "[contact][admission]",
                       ((int Dim), Dim), 2, 3) {
    contact::ContactOptions options = wide_skin();
    SECTION("tiles 1 wide that overlap in part: dA/ds = 1, |f| = 1") {
        Mover<Dim> mover(two_tiles<Dim>(), options);
        mover.search(at<Dim>(0.1, 0.25));
        CHECK(mover.move_to(at<Dim>(-0.5, 0.5)));
        CHECK(mover.contact.report().sliding_ratio_max == Approx(0.5).epsilon(1e-14));
    }
    SECTION("tiles that slide diagonally, together or apart: in 3D A = (1 - s)^2, |dA/ds| = sqrt(2) (1 - s)") {
        const auto [from, to] = GENERATE(std::pair(0.2, 0.6), std::pair(0.6, 0.2));
        const auto diagonal = [](double shift) {
            auto where = at<Dim>(-0.5, shift);
            if constexpr (Dim == 3) where[1] += shift * axis<Dim>(1);
            return where;
        };
        Mover<Dim> mover(two_tiles<Dim>(), options);
        mover.search(diagonal(from));
        CHECK(mover.move_to(diagonal(from)));
        CHECK(mover.move_to(diagonal(to)));
        const double slope = Dim == 3 ? std::sqrt(2.0) * 0.8 : 1.0;
        CHECK(mover.contact.report().sliding_ratio_max == Approx(0.5 * slope).epsilon(1e-12));
    }
    SECTION("a frozen overlap has no such force") {
        options.overlap = contact::OverlapMode::frozen;
        Mover<Dim> mover(two_tiles<Dim>(), options);
        mover.search(at<Dim>(0.1, 0.25));
        CHECK(mover.move_to(at<Dim>(-0.5, 0.5)));
        CHECK(mover.contact.report().sliding_ratio_max == 0.0);
    }
}

TEMPLATE_TEST_CASE_SIG(
    "faces that slide off each other while they are pressed in are counted, where nothing carries them on",
    "[contact][admission]", ((int Dim), Dim), 2, 3) {
    contact::ContactOptions options = wide_skin();
    SECTION("off the only partner: |g|/D where the area ends") {
        Mover<Dim> mover(two_tiles<Dim>(), options);
        mover.search(at<Dim>(0.1, 0.5));
        CHECK(mover.move_to(at<Dim>(-0.1, 0.5)));
        CHECK(mover.contact.report().slipped_pairs == 0);
        CHECK(mover.move_to(at<Dim>(-0.3, 1.5)));  // apart at s = 1, half way
        CHECK(mover.contact.report().slipped_pairs == 1);
        CHECK(mover.contact.report().slipped_compression_max == Approx(0.2 / (2.0 * depth)).epsilon(1e-14));
        CHECK_FALSE(mover.move_to(at<Dim>(-0.3, 1.6)));  // it slips once
        CHECK(mover.contact.report().slipped_pairs == 1);
    }
    SECTION("onto the next face: nothing is lost") {
        auto surface = two_tiles<Dim>();
        surface.append(tile<Dim>(axis<Dim>(0), up<Dim>(), 0.5), depth, 1.0, 0);
        const auto where = [](double gap, double shift) {
            auto u = at<Dim>(gap, shift);
            u.push_back(Vector<Dim>::Zero());
            return u;
        };
        Mover<Dim> mover(surface, options);
        mover.search(where(0.1, 0.5));
        CHECK(mover.move_to(where(-0.1, 0.5)));
        CHECK(mover.move_to(where(-0.1, 1.5)));  // leaves the first tile, on the second
        CHECK(mover.contact.report().slipped_pairs == 0);
        CHECK(mover.move_to(where(-0.1, 2.5)));
        CHECK(mover.contact.report().slipped_pairs == 1);
    }
    SECTION("off a face that still carries another one: the one that slid off has no partner, the other has") {
        const bool on_obstacle = GENERATE(false, true);
        CAPTURE(on_obstacle);
        contact::Surface<Dim> surface;
        surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), on_obstacle ? rigid : depth,
                       on_obstacle ? rigid : 1.0, 0);
        for (const int body : {1, 2}) surface.append(tile<Dim>(Vector<Dim>::Zero(), -up<Dim>(), 0.5), depth, 1.0, body);
        const auto where = [](double gap, double shift) {
            auto u = at<Dim>(gap, shift);
            u.push_back(gap * up<Dim>());
            return u;
        };
        Mover<Dim> mover(surface, options);
        mover.search(where(0.1, 0.5));
        CHECK(mover.move_to(where(-0.1, 0.5)));
        CHECK(mover.move_to(where(-0.1, 1.5)));
        // A face of an obstacle may be all of it: it holds many, and carries nothing on.
        CHECK(mover.contact.report().slipped_pairs == (on_obstacle ? 1 : 0));
    }
    SECTION("off, and then lifted") {
        Mover<Dim> mover(two_tiles<Dim>(), options);
        mover.search(at<Dim>(0.1, 0.5));
        CHECK(mover.move_to(at<Dim>(-0.1, 0.5)));
        CHECK(mover.move_to(at<Dim>(0.05, 1.5)));  // apart half way, open at two thirds
        CHECK(mover.contact.report().slipped_pairs == 1);
        CHECK(mover.contact.report().slipped_compression_max == Approx(0.025 / (2.0 * depth)).epsilon(1e-12));
    }
    SECTION("lifted off before the area ends") {
        Mover<Dim> mover(two_tiles<Dim>(), options);
        mover.search(at<Dim>(0.1, 0.5));
        CHECK(mover.move_to(at<Dim>(-0.1, 0.5)));
        CHECK(mover.move_to(at<Dim>(0.3, 1.5)));
        CHECK(mover.contact.report().slipped_pairs == 0);
    }
}

TEMPLATE_TEST_CASE_SIG("an admitted pair stays in the list where its boxes no longer meet", "[contact][admission]",
                       ((int Dim), Dim), 2, 3) {
    contact::ContactOptions options = wide_skin();
    options.search.skin = 0.01;
    Mover<Dim> mover(two_tiles<Dim>(), options);
    mover.search(at<Dim>(-0.5, 0.0));
    CHECK(mover.move_to(at<Dim>(-3.0, 0.0)));
    mover.search(at<Dim>(-3.0, 0.0));
    CHECK(mover.move_to(at<Dim>(-3.0, 0.1)));
}

TEMPLATE_TEST_CASE_SIG("a refused pair stays refused through rebuilds of the list", "[contact][admission]", ((int Dim), Dim),
                       2, 3) {
    Mover<Dim> mover(two_tiles<Dim>(), wide_skin());
    mover.search(at<Dim>(-0.7, 0.0));
    mover.move_to(at<Dim>(-0.2, 0.0));
    mover.search(at<Dim>(-0.2, 0.0));
    CHECK_FALSE(mover.move_to(at<Dim>(-0.1, 0.0)));
    CHECK(mover.contact.report().missed_contacts == 0);
}

TEMPLATE_TEST_CASE_SIG("a pair that is first seen already in contact is counted as lost and not admitted",
                       "[contact][admission]", ((int Dim), Dim), 2, 3) {
    contact::ContactOptions options = wide_skin();
    options.search.skin = 0.01;
    Mover<Dim> mover(two_tiles<Dim>(), options);
    mover.search(at<Dim>(5.0, 0.0));
    REQUIRE(mover.contact.report().candidates == 0);
    const double gap = GENERATE(-0.1, -0.7);  // above and below D
    mover.search(at<Dim>(gap, 0.0));
    REQUIRE(mover.contact.report().candidates == 1);
    CHECK(mover.contact.report().missed_contacts == (gap > -2.0 * depth ? 1 : 0));
    CHECK_FALSE(mover.move_to(at<Dim>(-0.1, 0.1)));
    CHECK_FALSE(pushes(mover));
}

TEMPLATE_TEST_CASE_SIG("a pair that is first seen beside its partner, below the plane, may become a contact",
                       "[contact][admission]", ((int Dim), Dim), 2, 3) {
    contact::ContactOptions options = wide_skin();
    options.search.skin = 0.5;
    Mover<Dim> mover(two_tiles<Dim>(), options);
    mover.search(at<Dim>(5.0, 0.0));
    mover.search(at<Dim>(-0.1, 1.1));  // A = 0
    CHECK(mover.move_to(at<Dim>(-0.1, 0.9)));
    CHECK(mover.contact.report().missed_contacts == 0);
}
