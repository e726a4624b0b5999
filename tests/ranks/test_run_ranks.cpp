// run::simulate on several ranks.
#include <catch2/catch.hpp>

#include <stdexcept>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "ranks/scenes.hpp"
#include "ranks/shared_run.hpp"

using namespace abut;
using test::SharedMesh;
using test::Watch;

namespace {

run::RunOptions options_of(int steps) { return {.steps = steps, .threads = 1, .interval = 5}; }

/// The scene alone, on each rank for itself, and on all of them together: the same.
template <int Dim>
run::RunResult<Dim> check_same_run(const ranks::Communicator& all, const run::Scene<Dim>& scene,
                                   const run::RunOptions& options, const test::Owners& owners) {
    Watch<Dim> alone, together;
    const auto expected = run::simulate<Dim>(scene, options, alone);
    const SharedMesh<Dim> mesh(all, scene.mesh, owners);
    auto found = run::simulate<Dim>(test::of_rank(all, scene), options, together, nullptr, mesh.share());
    test::require_same(all, expected, alone, found, together);
    return found;
}

}  // namespace

TEST_CASE("cells that are shared out again and again change no bit of a run", "[ranks][run][eight]") {
    const ranks::Communicator all = test::world();
    const auto scene = test::meeting_bodies<2>(0.2);
    run::RunOptions options = options_of(60);
    options.integrator = GENERATE(run::SolidIntegrator::memm, run::SolidIntegrator::leapfrog, run::SolidIntegrator::bilbao);
    options.rebalance = 7;
    options.rebalance_above = 1.0;
    const auto found = check_same_run<2>(all, scene, options, test::odd(all, scene.mesh));
    CHECK(found.contact.report.active_pairs_max > 0);
    REQUIRE(found.rebalancing.done.size() == 8);
    CHECK(found.rebalancing.looks == 9);
    CHECK(found.rebalancing.done[0].step == 7);
    if (all.size() > 1)
        CHECK(found.rebalancing.done[0].cells_moved == scene.mesh.n_cells() - 1);  // one was there
    else
        CHECK(found.rebalancing.done[0].cells_moved == 0);
}

TEST_CASE("a run with filter and neutral restarts changes no bit where its cells are shared out again", "[ranks][run]") {
    const ranks::Communicator all = test::world();
    const auto scene = test::meeting_bodies<2>(0.2);
    run::RunOptions options = options_of(60);
    options.filter = true;
    options.restart = 9;
    options.rebalance = GENERATE(0, 7);
    options.rebalance_above = 1.0;
    const auto found = check_same_run<2>(all, scene, options, test::odd(all, scene.mesh));
    CHECK(found.contact.report.active_pairs_max > 0);
    CHECK(found.ledger.entries().back().restarts.restarts == 6);
}

TEST_CASE("cells of loaded bodies that are shared out again change no bit, with ranks that have none", "[ranks][run]") {
    const ranks::Communicator all = test::world();
    const auto scene = test::loaded_strip();
    run::RunOptions options = options_of(40);
    options.integrator = GENERATE(run::SolidIntegrator::memm, run::SolidIntegrator::leapfrog);
    options.rebalance = GENERATE(0, 9);
    options.rebalance_above = 1.0;
    const auto found = check_same_run<2>(all, scene, options, test::odd(all, scene.mesh));
    CHECK(found.contact.report.active_pairs_max > 0);
    CHECK(found.rebalancing.done.size() == (options.rebalance == 0 ? 0 : 4));
}

TEST_CASE("the same in space", "[ranks][run]") {
    const ranks::Communicator all = test::world();
    const auto scene = test::meeting_bodies<3>(0.35);
    run::RunOptions options = options_of(30);
    options.rebalance = 8;
    options.rebalance_above = 1.0;
    const auto found = check_same_run<3>(all, scene, options, test::odd(all, scene.mesh));
    CHECK(found.contact.report.events > 0);
}

TEST_CASE("rigid bodies whose parts change, among others or alone, have the bits of one rank, and go on from a checkpoint",
          "[ranks][run][checkpoint][rigid]") {
    const ranks::Communicator all = test::world();
    auto scene = test::meeting_bodies<2>(0.25);
    using enum solid::Kinematics;
    scene.solid.kinematics = GENERATE(std::vector{rigid, floating}, std::vector{floating, rigid}, std::vector{rigid, rigid});
    scene.solid.springs = {{.first = {.body = 0, .position = {-1.5, 0.2}},
                            .second = {.position = {-4.0, 0.0}},
                            .stiffness = 0.05,
                            .damping = 0.02}};
    run::RunOptions options = options_of(40);
    options.restart = 9;
    options.rebalance = 6;
    options.rebalance_above = 1.0;
    Watch<2> alone(5, 10), together(5, 10);
    const auto expected = run::simulate<2>(scene, options, alone);
    const SharedMesh<2> mesh(all, scene.mesh, test::odd(all, scene.mesh), scene.solid.kinematics);
    const auto found = run::simulate<2>(test::of_rank(all, scene), options, together, nullptr, mesh.share());
    test::require_same(all, expected, alone, found, together);
    CHECK(found.contact.report.active_pairs_max > 0);

    Watch<2> rest;
    const SharedMesh<2> other(all, scene.mesh, test::odd(all, scene.mesh), scene.solid.kinematics);
    const auto on_ranks =
        run::simulate<2>(test::of_rank(all, scene), options, rest, &alone.kept[1], other.share());  // began alone
    Watch<2> later;                                                                                 // of `alone`
    later.seen.assign(alone.seen.end() - static_cast<std::ptrdiff_t>(rest.seen.size()), alone.seen.end());
    test::require_same(all, expected, later, on_ranks, rest);
}

TEST_CASE("cells that cost alike stay where they are, and before the first look nobody looks", "[ranks][run]") {
    const ranks::Communicator all = test::world();
    const auto scene = test::meeting_bodies<2>(0.3);
    run::RunOptions options = options_of(10);
    options.rebalance = GENERATE(3, 1000);
    options.rebalance_above = 1e6;  // no rank costs so much
    const SharedMesh<2> mesh(all, scene.mesh, test::even(all, scene.mesh));
    run::Observer<2> nobody;
    const auto result = run::simulate<2>(scene, options, nobody, nullptr, mesh.share());
    CHECK(mesh.times() == 1);
    CHECK(result.rebalancing.done.empty());
    CHECK(result.rebalancing.looks == (options.rebalance == 3 ? 4 : 1));
}

TEST_CASE("weights of cells are what their rank has cost, over the cells that it has", "[ranks][run]") {
    const ranks::Communicator all = test::world();
    const auto scene = test::meeting_bodies<2>(0.3);
    run::RunOptions options = options_of(3);
    options.rebalance = 2;
    options.rebalance_above = 1.0;
    std::vector<double> last;
    const SharedMesh<2> mesh(all, scene.mesh, [&](int, std::span<const double> weights) {
        last.assign(weights.begin(), weights.end());
        return ranks::partition<2>(all, scene.mesh.cell_centroid);
    });
    const std::vector<int> owner = ranks::partition<2>(all, scene.mesh.cell_centroid);
    run::Observer<2> nobody;
    static_cast<void>(run::simulate<2>(scene, options, nobody, nullptr, mesh.share()));
    REQUIRE(last.size() == owner.size());
    for (std::size_t c = 0; c < owner.size(); ++c) {
        CHECK(last[c] > 0.0);
        for (std::size_t other = c; other < c + 5 && other < owner.size(); ++other)
            if (owner[c] == owner[other]) CHECK(last[c] == last[other]);
    }
    for (const double weight : last) CHECK(all.largest(weight) == weight);  // the same on all ranks
}

TEST_CASE("a run goes on from checkpoints of another number of ranks, with loads that vary and other parts",
          "[ranks][run][checkpoint]") {
    const ranks::Communicator all = test::world();
    auto scene = test::loaded_strip();
    if (GENERATE(false, true)) {  // and warm
        scene.solid.materials[0].expansion.along_1 = 1e-4;
        scene.solid.temperature_rise = {
            {.value = [](double t, const Vector<2>& x) { return 50.0 * (std::sin(4.0 * t) + 0.2 * x[0]); }, .varies = true}};
    }
    run::RunOptions options = options_of(40);
    options.rebalance = 6;
    options.rebalance_above = 1.0;
    Watch<2> alone(5, 10), together(5, 10);
    const auto expected = run::simulate<2>(scene, options, alone);
    const SharedMesh<2> mesh(all, scene.mesh, test::odd(all, scene.mesh));
    static_cast<void>(run::simulate<2>(test::of_rank(all, scene), options, together, nullptr, mesh.share()));
    REQUIRE(alone.kept.size() == 4);
    REQUIRE(test::everywhere(all, all.rank() != 0 || together.kept.size() == 4));

    Watch<2> rest;
    const SharedMesh<2> other(all, scene.mesh, test::odd(all, scene.mesh));
    const auto on_ranks =
        run::simulate<2>(test::of_rank(all, scene), options, rest, &alone.kept[1], other.share());  // began alone
    const std::size_t n_later = rest.seen.size();
    Watch<2> later;  // of `alone`
    later.seen.assign(alone.seen.end() - static_cast<std::ptrdiff_t>(all.rank() == 0 ? n_later : 0), alone.seen.end());
    test::require_same(all, expected, later, on_ranks, rest);
    CHECK(on_ranks.run.resumed_after == 20);

    bool same = true;
    if (all.rank() == 0) {  // began on all ranks, goes on alone
        Watch<2> by_itself;
        const auto result = run::simulate<2>(scene, options, by_itself, &together.kept[1]);
        same = by_itself.seen.back() == alone.seen.back() &&
               test::same_bits(dynamics::ledger_values(result.ledger.entries().back()),
                               dynamics::ledger_values(expected.ledger.entries().back()));
    }
    CHECK(test::everywhere(all, same));
}

TEST_CASE("a run goes on with the same bits from the checkpoint behind a break under pressure, whose sides still touch",
          "[ranks][run][checkpoint][bonds]") {
    const ranks::Communicator all = test::world();
    const auto scene = test::sheared_bars(GENERATE(false, true));
    run::RunOptions options = options_of(55);
    options.interval = 1;
    Watch<2> alone(10, 1);
    const auto expected = run::simulate<2>(scene, options, alone);
    const auto& entries = expected.ledger.entries();
    std::vector<std::size_t> breaks;  // contact takes over where V changes at a split
    for (std::size_t step = 1; step + 1 < entries.size(); ++step)
        if (entries[step].losses.at_splits != entries[step - 1].losses.at_splits) breaks.push_back(step);
    REQUIRE(breaks.size() >= 2);
    for (const std::size_t step : {breaks.front(), breaks.back()}) {
        CAPTURE(step);
        REQUIRE(entries[step + 1].active_pairs > 0);
        const run::Checkpoint& from = alone.kept.at(step - 1);
        REQUIRE(from.motion.steps == static_cast<std::int64_t>(step));
        Watch<2> rest(10);
        const SharedMesh<2> mesh(all, scene.mesh, test::odd(all, scene.mesh), scene.solid.kinematics);
        const auto found = run::simulate<2>(test::of_rank(all, scene), options, rest, &from, mesh.share());
        Watch<2> later;  // of `alone`
        later.seen.assign(alone.seen.end() - static_cast<std::ptrdiff_t>(rest.seen.size()), alone.seen.end());
        test::require_same(all, expected, later, found, rest);
        CHECK(found.run.resumed_after == static_cast<std::int64_t>(step));
    }
}

TEST_CASE("two threads a rank have the bits of one", "[ranks][run]") {
    const ranks::Communicator all = test::world();
    if (all.size() > 2) return;
    const auto scene = test::meeting_bodies<2>(0.07);
    REQUIRE(scene.mesh.n_cells() > 1600);  // several chunks a rank
    run::RunOptions options = options_of(25);
    Watch<2> alone;
    const auto expected = run::simulate<2>(scene, options, alone);
    options.threads = 2;
    const SharedMesh<2> mesh(all, scene.mesh, test::even(all, scene.mesh));
    Watch<2> together;
    const auto found = run::simulate<2>(test::of_rank(all, scene), options, together, nullptr, mesh.share());
    test::require_same(all, expected, alone, found, together);
}

// What a step costs ----------------------------------------------------------------------------------------------------

TEST_CASE("a step that nobody looks at asks rank 0 one question", "[ranks][run]") {
    const ranks::Communicator all = test::world();
    auto scene = test::meeting_bodies<2>(0.3);
    scene.contact = false;
    const auto calls_of = [&](int steps) {
        run::RunOptions options = options_of(steps);
        options.interval = 1000;
        Watch<2> nobody(0);
        const SharedMesh<2> mesh(all, scene.mesh, test::even(all, scene.mesh));
        static_cast<void>(run::simulate<2>(scene, options, nobody, nullptr, mesh.share()));
        return mesh.calls();
    };
    const test::Calls few = calls_of(10), many = calls_of(30);
    CHECK(many.fills - few.fills == 20);          // copies of cells
    CHECK(many.largest - few.largest == 2 * 20);  // does the step begin where the last one ended; what does rank 0 want
    CHECK(many.all() - few.all() == 3 * 20);      // nothing else
}

// What goes wrong ------------------------------------------------------------------------------------------------------

namespace {

/// Throws where it is told to, on the rank that has it.
class Faulty : public Watch<2> {
public:
    explicit Faulty(std::string where) : Watch<2>(5, 10), where_(std::move(where)) {}
    void begin(const run::Scene<2>&, const run::RunResult<2>&) override { fail_in("begin"); }
    void record(const dynamics::LedgerEntry<2>& entry, const run::RunResult<2>&) override {
        if (entry.step > 10) fail_in("record");
    }
    void note(const run::Moment<2>& moment) override {
        if (moment.steps > 10) fail_in("note");
    }
    void see(const run::Sight<2>& sight) override {
        if (sight.moment.steps > 10) fail_in("see");
    }
    void progress(std::int64_t step, double) override {
        if (step > 10) fail_in("progress");
    }
    [[nodiscard]] bool asks_to_stop() const override {
        if (!kept.empty()) fail_in("asks_to_stop");
        return false;
    }
    [[nodiscard]] std::int64_t wants_piece(std::int64_t step) const override {
        return where_ == "piece" && step == 12 ? 0 : -1;
    }
    void piece(const run::FramePiece<2>&) override { fail_in("piece"); }
    void keep(const run::Checkpoint& checkpoint) override {
        if (!kept.empty()) fail_in("keep");
        Watch<2>::keep(checkpoint);
    }

private:
    void fail_in(const std::string& call) const {
        if (call == where_) throw LimitExceeded("no room left in " + call);
    }
    std::string where_;
};

}  // namespace

TEST_CASE("an observer that throws ends the run on all ranks with its error, and checkpoints stay", "[ranks][run][errors]") {
    const ranks::Communicator all = test::world();
    const auto scene = test::meeting_bodies<2>(0.3);
    const std::string where =
        GENERATE(as<std::string>{}, "begin", "record", "note", "see", "progress", "asks_to_stop", "piece", "keep");
    const int guilty = where == "piece" ? all.size() - 1 : 0;
    const SharedMesh<2> mesh(all, scene.mesh, test::even(all, scene.mesh));
    Faulty faulty(where);
    class OnlyPieces : public Watch<2> {
    public:
        [[nodiscard]] std::int64_t wants_piece(std::int64_t step) const override { return step == 12 ? 0 : -1; }
    };
    Watch<2> well(5, 10);
    OnlyPieces pieces;
    run::Observer<2>& mine = all.rank() == guilty ? static_cast<run::Observer<2>&>(faulty)
                             : where == "piece"   ? static_cast<run::Observer<2>&>(pieces)
                                                  : static_cast<run::Observer<2>&>(well);
    CAPTURE(where, all.rank());
    CHECK_THROWS_AS(run::simulate<2>(scene, options_of(30), mine, nullptr, mesh.share()), LimitExceeded);
    if (all.rank() == 0 && guilty == 0) CHECK(faulty.kept.size() == (where == "begin" ? 0 : 1));
}

TEST_CASE("a scene that throws on one rank ends the run on all of them", "[ranks][run][errors]") {
    const ranks::Communicator all = test::world();
    auto scene = test::loaded_strip();
    const bool is_guilty = all.rank() == all.size() - 1;
    SECTION("at the start") {
        scene.displacement = [=](const Vector<2>&) -> Vector<2> {
            if (is_guilty) throw BadInput("no such place");
            return Vector<2>::Zero();
        };
    }
    SECTION("in its midst") {
        scene.solid.boundary.traction = {{.group = "ymax", .history = [=](double t, const Vector<2>&) -> Vector<2> {
                                              if (is_guilty && t > 0.1) throw BadInput("no such place");
                                              return Vector<2>::Zero();
                                          }}};
    }
    const SharedMesh<2> mesh(all, scene.mesh, test::even(all, scene.mesh));
    Watch<2> watch;
    CHECK_THROWS_WITH(run::simulate<2>(scene, options_of(60), watch, nullptr, mesh.share()),
                      Catch::EndsWith("no such place"));
}

TEST_CASE("a run that diverges ends on all ranks with one error, and its checkpoints stay", "[ranks][run][errors]") {
    const ranks::Communicator all = test::world();
    auto scene = test::meeting_bodies<2>(0.3);
    scene.contact = false;
    run::RunOptions options = options_of(2000);
    options.rebalance = 3;  // the last sound state moves with the cells
    options.rebalance_above = 1.0;
    options.dt = 1.0;
    options.allow_unstable = true;
    const SharedMesh<2> mesh(all, scene.mesh, test::odd(all, scene.mesh));
    Watch<2> watch(0, 2);
    Watch<2> alone;
    CHECK_THROWS_AS(run::simulate<2>(scene, options, alone), Diverged);
    CHECK_THROWS_AS(run::simulate<2>(scene, options, watch, nullptr, mesh.share()), Diverged);
    CHECK(test::everywhere(all, all.rank() != 0 || !watch.kept.empty()));
    CHECK(test::everywhere(all, all.rank() != 0 || test::same_bits(watch.sound.q, alone.sound.q)));
}

TEST_CASE("what a run on ranks cannot do is refused by name on all of them", "[ranks][run][errors]") {
    const ranks::Communicator all = test::world();
    auto scene = test::meeting_bodies<2>(0.3);
    run::RunOptions options = options_of(5);
    std::string name;
    SECTION("local steps") {
        options.integrator = run::SolidIntegrator::memm_async, name = "memm_async";
        options.law = solid::ContactLaw::reconstruction;
    }
    SECTION("pilot runs") { options.kinematics = run::BodyKinematics::automatic, name = "a pilot run chooses kinematics"; }
    SECTION("after_step") {
        scene.after_step = [](const solid::Solid<2>&, double) {};
        name = "after_step";
    }
    const SharedMesh<2> mesh(all, scene.mesh, test::even(all, scene.mesh));
    run::Observer<2> nobody;
    CHECK_THROWS_WITH(run::simulate<2>(scene, options, nobody, nullptr, mesh.share()),
                      Catch::Contains(name) && Catch::Contains("not made for a run on several ranks"));
}
