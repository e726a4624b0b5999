// How places share what they lose in a step, so that it is what their laws take.
#include <catch2/catch.hpp>

#include "abut/solid/bond/fit_to_law.hpp"

namespace abut::test {
namespace {

using solid::BondOpening;

/// The opening that was asked for last, of an excess of this form: alone + slope middle + rise (extent - 1).
struct Asked {
    double alone, slope, rise = 0.0;
    BondOpening last{};
    int trials = 0;

    double operator()(const BondOpening& opening) {
        last = opening;
        ++trials;
        return alone + slope * opening.middle + rise * (opening.extent - 1.0);
    }
    void fit(double guess) {
        solid::fit_to_law([this](const BondOpening& opening) { return (*this)(opening); }, {guess, guess});
    }
};

}  // namespace

TEST_CASE("places that lose what their laws take by themselves are left alone", "[solid][bonds]") {
    Asked excess{.alone = 5e-4, .slope = 1.0};
    excess.fit(1.0);
    CHECK(excess.trials == 1);
    CHECK(excess.last.middle == 0.0);
    CHECK(excess.last.extent == 1.0);
}

TEST_CASE("the share of the mean force moves to where the loss is that of the laws, from any guess", "[solid][bonds]") {
    const double alone = GENERATE(0.3, -0.3), guess = GENERATE(0.35, 1.0, 5.0, 0.0);
    Asked excess{.alone = alone, .slope = 1.0};
    excess.fit(guess);
    CAPTURE(alone, guess);
    CHECK(excess.last.middle == Approx(-alone).margin(1e-3));
    CHECK(excess.last.extent == 1.0);
}

TEST_CASE("places open less where no share of the mean force takes enough, an eighth at least", "[solid][bonds]") {
    // With all of the middle the excess is -0.5; opening less raises it by 2 (1 - extent).
    Asked excess{.alone = -0.6, .slope = 0.1, .rise = -2.0};
    excess.fit(0.1);
    CHECK(excess.last.middle == 1.0);
    CHECK(excess.last.extent == Approx(0.75).margin(1e-3));
    Asked never{.alone = -6.0, .slope = 0.1, .rise = -2.0};
    never.fit(0.1);
    CHECK(never.last.extent == 0.125);
}

TEST_CASE("places that lose too much with any share keep that with which they lose least", "[solid][bonds]") {
    Asked excess{.alone = 0.6, .slope = 0.1};
    excess.fit(0.1);
    CHECK(excess.last.middle == -1.0);
    CHECK(excess.last.extent == 1.0);
}

}  // namespace abut::test
