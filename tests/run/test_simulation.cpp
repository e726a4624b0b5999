#include "abut/run/steps/simulation.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/run/words/summary.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;

/// Keeps the order in which it is called.
class Caller : public run::Observer<2> {
public:
    Caller(std::string name, std::vector<std::string>& calls) : name_(std::move(name)), calls_(calls) {}
    void begin(const run::Scene<2>&, const run::RunResult<2>& result) override {
        CHECK(result.run.steps == 2);
        CHECK(result.ledger.entries().empty());
        calls_.push_back("begin " + name_);
    }
    void record(const dynamics::LedgerEntry<2>& entry, const run::RunResult<2>& result) override {
        CHECK(result.ledger.entries().back().step == entry.step);
        calls_.push_back("record " + name_);
    }
    void look(const dynamics::RunView<2>& view, solid::Solid<2>& solid) override {
        CHECK(view.q.size() == solid.size());
        calls_.push_back("look " + name_);
    }

private:
    std::string name_;
    std::vector<std::string>& calls_;
};

/// An octagon, its lowest corner 3 mm above a block at `x`; its faces are tilted by 22.5 degrees.
run::Scene<2> octagon_over_block(double x, double speed) {
    run::Scene<2> scene;
    scene.mesh = mesh::combine<2>(
        std::vector{mesh::structured_box<2>({-3.6, -1.8}, {3.6, 0.0}, {8, 2}, mesh::CellShape::triangle, "block"),
                    mesh::disc({.centre = {x, 1.003}, .radius = 1.0, .size = 0.8, .name = "round"})});
    scene.solid.materials.assign(2, {.young = 1.0, .poisson = 0.0, .density = 1.0});
    scene.velocity = {Vector<2>(0.0, 0.0), Vector<2>(0.0, -speed)};
    scene.time = 2.0;
    return scene;
}

}  // namespace

TEST_CASE("several observers are called in turn, at the start and after each step", "[run]") {
    std::vector<std::string> calls;
    Caller a("a", calls), b("b", calls);
    run::Observers<2> both{a};
    both.add(b);
    static_cast<void>(run::simulate<2>(test::block_on_plane(0.01), {.steps = 2}, both));
    std::vector<std::string> expected{"begin a", "begin b"};
    for (int node = 0; node < 3; ++node) expected.insert(expected.end(), {"record a", "record b", "look a", "look b"});
    CHECK(calls == expected);
}

TEST_CASE("an observer that asks to stop ends the run after the present step, which is recorded whatever the interval",
          "[run]") {
    class Stop : public run::Observer<2> {
    public:
        explicit Stop(int answers) : answers_(answers) {}
        [[nodiscard]] bool asks_to_stop() const override { return asked_++ == answers_; }

    private:
        int answers_;
        mutable int asked_ = 0;
    };
    const int step = GENERATE(0, 1, 3, 4);
    run::Observer<2> nobody;
    Stop stop(step);
    run::Observers<2> both{stop, nobody};
    const run::RunResult<2> result = run::simulate<2>(test::block_on_plane(0.01), {.steps = 20, .interval = 4}, both);
    CHECK_FALSE(result.run.complete);
    CHECK(result.run.steps == step);
    CHECK(result.ledger.entries().back().step == step);
    CHECK(result.ledger.entries().size() == (step == 0 ? 1 : 2));
    CHECK(result.bodies.end.size() == 1);

    Stop at_the_end(20);  // no step is left out
    CHECK(run::simulate<2>(test::block_on_plane(0.01), {.steps = 20}, at_the_end).run.complete);
}

TEST_CASE("a block bounces off a plane with the speed it came with on the mean, and H~ stays", "[run]") {
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.time = 8.0;
    scene.findings = [](const run::RunResult<2>& result) -> std::vector<run::Finding> {
        return {{"n", "records", static_cast<std::int64_t>(result.ledger.entries().size())}};
    };
    const run::RunResult<2> result = run::simulate<2>(scene);
    CHECK(result.ledger.pseudo_energy_drift() < 1e-12 * result.energy.scale.value);
    CHECK(result.bodies.end.front().velocity.y() > 0.005);
    CHECK(std::get<std::int64_t>(result.watch.findings.front().value) == result.run.steps + 1);
    CHECK(result.options.interval == 1);  // filled in
    CHECK(result.options.contact.quadrature == 2);
    CHECK(result.run.threads > 0);
}

TEST_CASE("an error in a step keeps its type, kind and facts, and says at which step it happened", "[run]") {
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.solid.boundary.traction = {{.group = "ymax", .history = [](double time, const Vector<2>&) -> Vector<2> {
                                          if (time > 0.1)
                                              throw LimitExceeded("enough", {.cell = 3, .value = 4.0, .allowed = 2.0});
                                          return Vector<2>::Zero();
                                      }}};
    try {
        static_cast<void>(run::simulate<2>(scene));
        FAIL("the load throws");
    } catch (const LimitExceeded& error) {
        CHECK(error.kind() == ErrorKind::limit_exceeded);
        CHECK(error.facts().cell == 3);
        CHECK(error.facts().value == 4.0);
        CHECK(error.facts().allowed == 2.0);
        const std::string text = error.what();
        CHECK(text.starts_with("step "));
        CHECK(text.find("stable are") != std::string::npos);
        CHECK(text.ends_with("enough"));
    }
}

TEST_CASE("a block that is pressed in deeper than allowed ends the run as too deep", "[run]") {
    run::RunOptions options;
    options.contact.compression_limit = 1e-3;
    CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(test::block_on_plane(0.1), options)), TooDeep);
}

TEST_CASE("where faces that are too deep are tilted, the reconstruction names the law that is the cure", "[run]") {
    const auto text_of = [](const run::Scene<2>& scene, solid::ContactLaw law) -> std::string {
        run::RunOptions options{.law = law};
        options.contact.compression_limit = 1e-2;
        try {
            static_cast<void>(run::simulate<2>(scene, options));
        } catch (const TooDeep& error) {
            return error.what();
        }
        FAIL("it is pressed in deeper than a hundredth of its cells");
        return "";
    };
    using solid::ContactLaw;
    CHECK_THAT(text_of(octagon_over_block(0.45, 0.1), ContactLaw::reconstruction), Catch::Contains("\"pair_potential\""));
    CHECK_THAT(text_of(octagon_over_block(0.45, 0.1), ContactLaw::pair_potential), !Catch::Contains("\"pair_potential\""));
    CHECK_THAT(text_of(test::block_on_plane(0.1), ContactLaw::reconstruction), !Catch::Contains("\"pair_potential\""));
}

TEST_CASE("energy of contact between bodies that are apart at the start is refused by their names", "[run]") {
    // Near the end of a face of the block that is 1.18 times as large as its own: along the mean of both normals their
    // centroids have passed each other.
    const run::Scene<2> scene = octagon_over_block(0.88, 0.01);
    run::RunOptions options{.steps = 1, .law = solid::ContactLaw::reconstruction};
    try {
        static_cast<void>(run::simulate<2>(scene, options));
        FAIL("there is energy in a contact that is none");
    } catch (const BadInput& error) {
        const std::string text = error.what();
        for (const char* part : {"'block'", "'round'", "0.003 m apart", "pair_potential"})
            CHECK_THAT(text, Catch::Contains(part));
        CHECK(error.facts().value > error.facts().allowed);
    }
    options.law = solid::ContactLaw::automatic;
    const auto result = run::simulate<2>(scene, options);
    CHECK(result.options.law == solid::ContactLaw::pair_potential);
    CHECK(result.ledger.entries().front().energy == result.ledger.entries().front().kinetic);
}

TEST_CASE("no option changes the law of contact: what the reconstruction alone has is refused with the line that chooses it",
          "[run]") {
    using solid::ContactLaw;
    const auto law_of = [](const run::RunOptions& options) {
        return run::simulate<2>(test::block_on_plane(0.01), options).options.law;
    };
    const run::RunOptions plain{.steps = 1};
    CHECK(law_of(plain) == ContactLaw::pair_potential);
    const std::vector<std::function<void(run::RunOptions&)>> choices = {
        [](auto& options) { options.contact.overlap = contact::OverlapMode::frozen; },
        [](auto& options) { options.contact.weighting = contact::InterfaceWeighting::half; },
        [](auto& options) { options.contact.quadrature = 1; },
        [](auto& options) { options.contact.search.facing_cosine = -0.5; },
        [](auto& options) { options.integrator = run::SolidIntegrator::memm_async; }};
    for (const auto& choose : choices) {
        run::RunOptions options = plain;
        choose(options);
        CHECK_THROWS_WITH(law_of(options),
                          Catch::Contains("law = \"reconstruction\"") || Catch::Contains("ContactLaw::reconstruction"));
        options.law = ContactLaw::reconstruction;
        CHECK(law_of(options) == ContactLaw::reconstruction);
    }
    run::RunOptions by_itself = plain, rigid = plain;
    by_itself.contact.search.self_contact = true;
    rigid.kinematics = run::BodyKinematics::rigid;
    CHECK(law_of(by_itself) == ContactLaw::pair_potential);
    CHECK(law_of(rigid) == ContactLaw::pair_potential);
}

TEST_CASE("an error thrown again has its type, kind and facts, and another text", "[run]") {
    const ErrorFacts facts{.face_1 = 1, .face_2 = 2, .cell = 3, .value = 4.0, .allowed = 5.0};
    const auto check_kept = [&](const auto& error) {
        try {
            throw_again(error, "here: " + std::string(error.what()));
        } catch (const std::decay_t<decltype(error)>& again) {
            CHECK(again.kind() == error.kind());
            CHECK(again.what() == std::string("here: why"));
            CHECK(again.facts().face_1 == 1);
            CHECK(again.facts().face_2 == 2);
            CHECK(again.facts().cell == 3);
            CHECK(again.facts().value == 4.0);
            CHECK(again.facts().allowed == 5.0);
        }
    };
    check_kept(BadInput("why", facts));
    check_kept(Misuse("why", facts));
    check_kept(Diverged("why", facts));
    check_kept(TooDeep("why", facts));
    check_kept(LimitExceeded("why", facts));
}

TEST_CASE("a run beyond the stable step diverges, and its error says so by its type", "[run]") {
    run::RunOptions options{.steps = 10'000, .allow_unstable = true};
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.contact = false;
    scene.solid.obstacles.clear();
    scene.displacement = [](const Vector<2>& x) { return Vector<2>(1e-3 * x.x(), 0.0); };
    options.dt = 1.5 * run::simulate<2>(scene, {.steps = 1}).run.stable.dt;
    CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(scene, options)), Diverged);
    options.allow_unstable = false;
    try {
        static_cast<void>(run::simulate<2>(scene, options));
        FAIL("the step is too long");
    } catch (const BadInput& error) {
        CHECK(error.facts().value == options.dt);
        CHECK(error.facts().allowed == Approx(options.dt / 1.5));
    }
}

TEST_CASE("options that do not go together are refused before anything is run", "[run]") {
    const run::Scene<2> scene = test::block_on_plane(0.01);
    for (const run::RunOptions& options :
         {run::RunOptions{.integrator = run::SolidIntegrator::leapfrog, .filter = true},
          run::RunOptions{.integrator = run::SolidIntegrator::bilbao, .restart = 50}, run::RunOptions{.restart = -1},
          run::RunOptions{.levels = 3}, run::RunOptions{.gauge = 1.0}})
        CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(scene, options)), BadInput);
}

TEST_CASE("a material that remembers is refused under any scheme but memm as the scene is checked, with the body", "[run]") {
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.solid.materials.front().damping.stiffness = 1e-3;
    using Scheme = run::SolidIntegrator;
    for (const Scheme scheme : {Scheme::leapfrog, Scheme::bilbao, Scheme::memm_async}) {
        run::RunOptions options{.integrator = scheme};
        options.law = solid::ContactLaw::reconstruction;  // under which all schemes run
        CHECK_THROWS_WITH(run::check_features<2>(scene, options, dynamics::one_rank()),
                          Catch::Contains(scene.mesh.body_names.front()) && Catch::Contains("remembers"));
        CHECK_THROWS_WITH(static_cast<void>(run::simulate<2>(scene, options)), Catch::Contains("remembers"));
    }
    CHECK_NOTHROW(run::check_features<2>(scene, {}, dynamics::one_rank()));
    scene.solid.materials.front().damping.stiffness = 0.0;
    CHECK_NOTHROW(run::check_features<2>(scene, {.integrator = Scheme::leapfrog}, dynamics::one_rank()));
}

TEST_CASE("restarts clear the parasitic mode of a block that bounces, at no change of H~, and the result counts them",
          "[run]") {
    run::Scene<2> scene = test::block_on_plane(0.05);
    scene.solid.law = solid::ContactLaw::reconstruction;  // it leaves vibration enough to pay with; the potential hardly any
    scene.time = 12.0;
    const auto plain = run::simulate<2>(scene), restarted = run::simulate<2>(scene, {.restart = 10});
    const auto& last = restarted.ledger.entries().back();
    CHECK(last.restarts.restarts == restarted.run.steps / 10);
    CHECK(last.restarts.paid != 0.0);
    CHECK(plain.ledger.entries().back().restarts.restarts == 0);
    REQUIRE(last.active_pairs == 0);  // it has left the plane: e stays as it is
    CHECK(last.parasitic < 1e-10 * plain.ledger.entries().back().parasitic);
    CHECK(restarted.ledger.pseudo_energy_drift() < 1e-11 * restarted.energy.scale.value);
    const auto json = nlohmann::json::parse(run::summary_json<2>("test", scene, restarted));
    CHECK(json["restarts"] == last.restarts.restarts);
    CHECK(json["restart_paid"] == last.restarts.paid);
    CHECK(json["options"]["restart"] == 10);
}

TEST_CASE("a scene without contact has none, whatever the options of its solid say", "[run]") {
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.time = 4.0;
    scene.solid.contact.emplace();
    scene.contact = false;
    scene.solid.obstacles.clear();
    const auto result = run::simulate<2>(scene);
    CHECK(result.contact.skin == 0.0);
    CHECK(result.bodies.end.front().velocity.y() == Approx(-0.01).epsilon(1e-12));  // it goes on through where the plane was
}

TEST_CASE("a step above the stable one is refused, whether dt or cfl asks for it", "[run]") {
    const run::Scene<2> scene = test::block_on_plane(0.01);
    CHECK_THROWS_WITH(static_cast<void>(run::simulate<2>(scene, {.cfl = 1.2})),
                      Catch::Matchers::StartsWith("run.cfl (--cfl): "));
    CHECK_NOTHROW(static_cast<void>(run::simulate<2>(scene, {.steps = 1, .cfl = 1.2, .allow_unstable = true})));
}

TEST_CASE("a rigid body that touches nothing has no longest step: a run asks for one by dt", "[run]") {
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.contact = false;
    scene.solid.obstacles.clear();
    scene.solid.kinematics = {solid::Kinematics::rigid};
    CHECK_THROWS_WITH(
        static_cast<void>(run::simulate<2>(scene, {.steps = 1})),
        Catch::Matchers::StartsWith("run.cfl (--cfl): ") && Catch::Matchers::Contains("Give one by run.dt (--dt)"));
    CHECK(run::simulate<2>(scene, {.steps = 1, .dt = 100.0}).run.steps == 1);
}

TEST_CASE("a run takes as many steps as reach its end, rounding aside", "[run]") {
    CHECK(run::steps_until(0.07, 0.01) == 7);  // 0.07 / 0.01 is 7.000000000000001 in doubles
    CHECK(run::steps_until(0.0701, 0.01) == 8);
    CHECK(run::steps_until(0.01, 1.0) == 1);
    CHECK_THROWS_AS(run::steps_until(0.0, 0.01), BadInput);
    CHECK_THROWS_AS(run::steps_until(1.0, 1e-300), BadInput);
}

TEST_CASE("energies of a scene are measured by something that has a name", "[run]") {
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.energy_scale.name.clear();
    CHECK_THROWS_AS(static_cast<void>(run::simulate<2>(scene, {.steps = 1})), BadInput);
}

TEST_CASE("a rigid body that starts displaced takes no added velocity: it would take its spin wrongly", "[run]") {
    auto scene = test::block_on_plane(0.1);
    scene.solid.kinematics = {solid::Kinematics::rigid};
    scene.added_velocity = [](const Vector<2>& x) -> Vector<2> { return {-x[1], x[0]}; };
    CHECK_NOTHROW(run::simulate<2>(scene, {.steps = 1}));
    scene.displacement = [](const Vector<2>&) -> Vector<2> { return {0.0, 1.0}; };
    CHECK_THROWS_AS(run::simulate<2>(scene, {.steps = 1}), BadInput);
}

TEST_CASE("a finite body is run with neutral restarts, others are not, and who asks for none gets none", "[run]") {
    // A cantilever under an end moment that turns with its end: a pressure that changes sign across it, and grows at first.
    const double height = 0.1, slope = 0.2;
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, height}, {40, 4}, mesh::CellShape::triangle, "beam");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0}};
    scene.solid.kinematics = {solid::Kinematics::finite};
    scene.solid.boundary.dirichlet = {{.group = "xmin"}};
    scene.solid.boundary.traction = {
        {.group = "xmax",
         .history = [=](double t,
                        const Vector<2>& x) { return Vector<2>(-slope * std::min(1.0, t) * (x[1] - 0.5 * height), 0.0); },
         .follows = true}};
    scene.velocity = {Vector<2>::Zero()};
    scene.contact = false;
    scene.energy_scale = {"E0", 1e-5};
    scene.time = 60.0;
    const auto by_default = run::simulate<2>(scene, {.interval = 7}),
               without = run::simulate<2>(scene, {.restart = 0, .interval = 7});
    CHECK(by_default.options.restart == 50);
    CHECK(without.options.restart == 0);
    const auto& last = by_default.ledger.entries().back();
    CHECK(last.restarts.restarts == by_default.run.steps / 50);
    const double energy = by_default.ledger.largest_energy();
    CAPTURE(energy, without.ledger.energy_excess(), by_default.ledger.energy_excess());
    CHECK(by_default.ledger.pseudo_energy_drift() <= 1e-11 * energy);
    CHECK(by_default.ledger.energy_excess() <= 1e-4 * energy);
    CHECK(without.ledger.entries().back().restarts.restarts == 0);

    scene.solid.boundary.dirichlet.clear();
    CHECK(run::simulate<2>(scene, {.steps = 1, .kinematics = run::BodyKinematics::floating}).options.restart == 0);
    CHECK(run::simulate<2>(scene, {.steps = 1, .integrator = run::SolidIntegrator::leapfrog}).options.restart == 0);
}
