// Which schemes run bodies that turn, and what each keeps.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "abut/dynamics/bilbao.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/memm_async.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/turning_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

/// Two discs that spin and collide.
struct Discs {
    mesh::Mesh<2> mesh = two_discs(0.8);
    solid::Solid<2> solid;
    std::vector<double> q, p;
    double stable;

    explicit Discs(std::vector<Kinematics> kinematics)
        : solid(mesh, with(std::move(kinematics))),
          q(solid.size(), 0.0),
          p(momentum_of<2>(solid, {{{0.05, 0.0}, some_spin<2>(0.1)}, {{-0.05, 0.0}, some_spin<2>(0.05)}})),
          stable(dynamics::stable_step(solid).dt) {}
    Discs(const Discs&) = delete;
    static solid::SolidOptions<2> with(std::vector<Kinematics> kinematics) {
        auto options = bodies<2>(2);
        options.kinematics = std::move(kinematics);
        return options;
    }
    template <class Scheme>
    dynamics::Ledger<2> run(Scheme& scheme, double time) {
        dynamics::Ledger<2> ledger;
        ledger.record(dynamics::measure(scheme, solid));
        while (scheme.time() < time) {
            scheme.step();
            ledger.record(dynamics::measure(scheme, solid));
        }
        CHECK(solid.contact().report().active_pairs_max > 0);
        CHECK(solid.contact().report().missed_contacts == 0);
        return ledger;
    }
};

const auto floating = std::vector{Kinematics::floating, Kinematics::floating};
const auto bending = std::vector{Kinematics::finite, Kinematics::finite};
const auto mixed = std::vector{Kinematics::rigid, Kinematics::floating};

}  // namespace

TEST_CASE("leapfrog searches candidates no more often than MEMM", "[solid][kinematics]") {
    const auto kinematics = GENERATE(floating, bending, mixed);
    Discs one(kinematics), other(kinematics);
    dynamics::Memm memm(one.solid, one.q, one.p, 0.3 * one.stable);
    dynamics::Leapfrog leapfrog(other.solid, other.q, other.p, 0.3 * one.stable);
    static_cast<void>(one.run(memm, 20.0));
    static_cast<void>(other.run(leapfrog, 20.0));
    CHECK(other.solid.contact().report().rebuilds <= 2 * one.solid.contact().report().rebuilds);
}

// The force of a pair jumps where a face passes the end of another one, by g^2: less than order 2 where bodies touch.
TEST_CASE("leapfrog keeps the energy of bodies that turn, with order 2 while they fly", "[solid][kinematics]") {
    const auto kinematics = GENERATE(floating, bending, mixed);
    const auto drift = [&](double part, double time) {
        Discs discs(kinematics);
        dynamics::Leapfrog leapfrog(discs.solid, discs.q, discs.p, part * discs.stable);
        dynamics::Ledger<2> ledger;
        while (leapfrog.time() < time) {
            ledger.record(dynamics::measure(leapfrog, discs.solid));
            leapfrog.step();
        }
        return ledger.energy_drift() / ledger.largest_energy();
    };
    CHECK(std::log2(drift(0.4, 0.15) / drift(0.1, 0.15)) / 2.0 == Approx(2.0).margin(0.3));
    // The ends that faces pass differ from step to step, so that only a long range of steps shows the order: 2/3 at least.
    const double coarse = drift(0.2, 20.0), fine = drift(0.025, 20.0);
    CAPTURE(coarse, fine);
    CHECK(drift(0.05, 20.0) < 1e-4);
    CHECK(coarse / fine > 4.0);
}

TEST_CASE("Bilbao keeps its energy where bodies that turn collide", "[solid][kinematics]") {
    Discs discs(GENERATE(floating, bending));
    dynamics::Bilbao bilbao(discs.solid, discs.q, discs.p, 0.3 * discs.stable, 1.0);
    const auto ledger = discs.run(bilbao, 20.0);
    CHECK(ledger.pseudo_energy_drift() <= 1e-11 * (1.0 + ledger.largest_energy()));
}

TEST_CASE("schemes that know no rigid bodies say so, and local steps name floating ones", "[solid][kinematics]") {
    using Catch::Contains;
    Discs rigid(mixed), turning(floating);
    CHECK_THROWS_WITH(dynamics::Bilbao(rigid.solid, rigid.q, rigid.p, 0.1 * rigid.stable, 1.0),
                      Contains("rigid") && Contains("Memm"));
    const dynamics::LocalSteps steps{.parts = {1, 2}, .level = std::vector<std::int32_t>(turning.solid.size(), 0)};
    CHECK_THROWS_WITH(dynamics::MemmAsync(turning.solid, turning.q, turning.p, 0.1 * turning.stable, steps),
                      Contains("local steps") && Contains("small"));
    const dynamics::LocalSteps of_rigid{.parts = {1, 2}, .level = std::vector<std::int32_t>(rigid.solid.size(), 0)};
    CHECK_THROWS_WITH(dynamics::MemmAsync(rigid.solid, rigid.q, rigid.p, 0.1 * rigid.stable, of_rigid),
                      Contains("rigid") || Contains("small"));
}
