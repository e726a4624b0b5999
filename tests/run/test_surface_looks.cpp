#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/verdict.hpp"
#include "abut/run/words/warnings.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;
using run::WarningKind;

/// Two boxes of 1 m of cells of 0.5 m, of which the second one is at rest `offset` from the first.
template <int Dim>
run::Scene<Dim> two_boxes(const Vector<Dim>& offset) {
    const auto at = [](const Vector<Dim>& lower, const char* name) {
        std::array<int, Dim> counts;
        counts.fill(2);
        return mesh::structured_box<Dim>(lower, lower + Vector<Dim>::Ones(), counts,
                                         Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron, name);
    };
    run::Scene<Dim> scene;
    const std::array bodies{at(Vector<Dim>::Zero(), "a"), at(offset, "b")};
    scene.mesh = mesh::combine<Dim>(bodies);
    scene.solid.materials.assign(2, {.young = 1.0, .poisson = 0.0, .density = 1.0});
    scene.velocity.assign(2, Vector<Dim>::Zero());
    return scene;
}

template <int Dim>
bool warns_of(WarningKind kind, const run::RunResult<Dim>& result) {
    return std::ranges::any_of(run::warnings_after(result), [kind](const auto& w) { return w.kind == kind; });
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a run in which nothing touched names the two bodies that are nearest, and their distance",
                       "[run][looks]", ((int Dim), Dim), 2, 3) {
    Vector<Dim> offset = Vector<Dim>::Constant(1.3);
    offset[0] = 1.4;
    run::Scene<Dim> scene = two_boxes<Dim>(offset);
    scene.velocity[1][0] = -0.1;
    scene.solid.obstacles = {contact::plane_obstacle<Dim>(-3.0 * Vector<Dim>::UnitX(), Vector<Dim>::UnitX(), 9.0)};
    const run::RunResult<Dim> result = run::simulate<Dim>(scene, {.steps = 3});
    Vector<Dim> gap = offset - Vector<Dim>::Ones();
    gap[0] -= 0.1 * 3.0 * result.run.dt;
    const run::Encounter& nearest = result.watch.looks.nearest;
    CHECK(nearest.body_1 == "'a'");
    CHECK(nearest.body_2 == "'b'");
    CHECK(nearest.distance == Approx(gap.norm()).epsilon(1e-5));  // corner to corner
    CHECK(warns_of(WarningKind::nothing_touched, result));
    CHECK_FALSE(run::verdict(scene, result).good);
}

TEMPLATE_TEST_CASE_SIG("bodies that are inside each other are told of with their depth, whatever contact makes of it",
                       "[run][looks]", ((int Dim), Dim), 2, 3) {
    const double depth = GENERATE(0.1, 0.3);
    run::Scene<Dim> scene = two_boxes<Dim>(1.2 * Vector<Dim>::UnitX());
    scene.displacement = [=](const Vector<Dim>& x) -> Vector<Dim> {
        return x[0] < 1.1 ? (0.2 + depth) * Vector<Dim>::UnitX() : 0.0 * Vector<Dim>::UnitX();
    };
    // Contact parts them from there on, and under the reconstruction their faces are where it has moved them.
    const run::RunOptions one_short_step{.steps = 1, .dt = 1e-6, .law = solid::ContactLaw::pair_potential};
    const run::RunResult<Dim> result = run::simulate<Dim>(scene, one_short_step);
    const run::Encounter& deepest = result.watch.looks.deepest;
    CHECK(result.watch.looks.looks >= 1);
    CHECK(deepest.distance == Approx(depth).epsilon(1e-6));
    CHECK(deepest.ratio == Approx(depth / 0.5).epsilon(1e-6));
    CHECK(warns_of(WarningKind::interpenetration, result) == (depth / 0.5 > run::deep_interpenetration));
    scene.solid.ignored_pairs = {{1, 0}};
    CHECK(run::simulate<Dim>(scene, one_short_step).watch.looks.deepest.distance == 0.0);
}

TEST_CASE("records are 200 to 2,000, and do not all come right after a restart", "[run]") {
    CHECK(run::records_interval<2>(100, 0) == 1);
    CHECK(run::records_interval<2>(399, 0) == 1);
    CHECK(run::records_interval<2>(400, 0) == 2);
    CHECK(run::records_interval<2>(2000, 0) == 10);
    CHECK(run::records_interval<2>(20000, 0) == 10);
    CHECK(run::records_interval<2>(20001, 0) == 11);
    CHECK(run::records_interval<3>(100, 0) == 10);
    for (const int restart : {0, 1, 7, 50, 60})
        for (const std::int64_t steps : {std::int64_t{100'000}, std::int64_t{123'456}, std::int64_t{1'000'000'000'000}}) {
            const int interval = run::records_interval<2>(steps, restart);
            if (restart > 0) CHECK(std::gcd(interval, restart) == 1);
            CHECK(interval <= 2'000'000'000);
            if (steps > 1'000'000) continue;
            CHECK(steps / interval <= 2000);
            CHECK(steps / interval >= 1700);
        }
    run::Scene<2> scene = test::block_on_plane(0.01);
    const auto result = run::simulate<2>(scene, {.steps = 5000});
    CHECK(result.options.interval == 10);
    CHECK(result.ledger.entries().size() == 1 + 5000 / 10);
}

TEST_CASE("H - H~ above 2 % of the energy in play warns, and what is not conserved is not called a drift",
          "[run][warnings]") {
    run::RunResult<2> result;
    dynamics::LedgerEntry<2> entry{};
    entry.kinetic = entry.energy = entry.pseudo_energy = 1.0;
    const auto record = [&](double excess) {
        entry.energy = 1.0 + excess;
        result.ledger.record(entry);
        result.energy.accounts.record(entry, 1.0, Vector<2>::Zero());
    };
    record(0.0);
    record(0.0199);
    CHECK_FALSE(warns_of(WarningKind::energy_excess, result));
    record(0.03);
    CHECK(warns_of(WarningKind::energy_excess, result));
    CHECK(result.energy.accounts.energy_in_play == 1.0);  // H - H~ is no part of it
    result.energy.forces_from_outside = {"supports", "gravity"};
    CHECK(run::momentum_note(result) == "not conserved: supports, gravity");
    CHECK(std::isnan(run::momentum_drift(result)));
}
