// Frames at times that a scene gives: on the path of a step, which stays as it is.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/values/checkpoint.hpp"
#include "abut/solid/contact_view.hpp"
#include "run/folder.hpp"
#include "run/scenes.hpp"

namespace {

using namespace abut;

/// Two blocks of other materials and kinematics that meet, rub and part.
run::Scene<2> two_blocks(solid::Kinematics kinematics, bool flows) {
    run::Scene<2> scene;
    const std::vector<mesh::Mesh<2>> meshes{
        mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {4, 4}, mesh::CellShape::quadrangle, "left"),
        mesh::structured_box<2>({1.01, 0.2}, {2.01, 1.2}, {5, 5}, mesh::CellShape::quadrangle, "right")};
    scene.mesh = mesh::combine<2>(meshes);
    scene.solid.materials.assign(2, {.young = 1.0, .poisson = 0.3, .density = 1.0});
    if (flows) {
        scene.solid.materials[0].law = solid::MaterialLaw::j2;
        scene.solid.materials[0].flow.yield_stress = 0.02;
    }
    scene.solid.kinematics.assign(2, kinematics);
    scene.velocity = {Vector<2>(0.1, 0.02), Vector<2>::Zero()};
    scene.time = 1.5;
    return scene;
}

/// What it sees at the nodes, and at times between.
struct Seen : run::Observer<2> {
    void look(const dynamics::RunView<2>& run, solid::Solid<2>&) override {
        nodes.push_back(run.time);
        q_of_nodes.emplace_back(run.q.begin(), run.q.end());
    }
    void look_at_time(const dynamics::RunView<2>& run, solid::Solid<2>& solid) override {
        static_cast<void>(solid.potential(run.q));  // as files do
        static_cast<void>(solid.contact_at(run.q).field());
        times.push_back(run.time);
        q.emplace_back(run.q.begin(), run.q.end());
        p.emplace_back(run.p_before.begin(), run.p_before.end());
    }
    std::vector<double> nodes, times;
    std::vector<std::vector<double>> q_of_nodes, q, p;
};

Seen seen(const run::Scene<2>& scene, std::vector<double> times, run::RunOptions options = {}) {
    options.times = std::move(times);
    Seen seen;
    static_cast<void>(run::simulate<2>(scene, options, seen));
    return seen;
}

const std::vector<double> some_times{0.0, 1e-3, 0.1, 0.2, 0.21, 0.215, 0.5, 0.77, 0.9, 1.2, 1.5};

}  // namespace

TEST_CASE("times between steps change no bit of the nodes, whatever bodies and schemes", "[run][output_times]") {
    struct Case {
        solid::Kinematics kinematics;
        bool flows;
        run::RunOptions options;
    };
    const Case one = GENERATE(Case{solid::Kinematics::small, false, {}}, Case{solid::Kinematics::small, true, {}},
                              Case{solid::Kinematics::floating, false, {.friction = {.coefficient = 0.3}}},
                              Case{solid::Kinematics::finite, false, {.friction = {.coefficient = 0.3}}},
                              Case{solid::Kinematics::rigid, false, {}},
                              Case{solid::Kinematics::small, false, {.integrator = run::SolidIntegrator::leapfrog}},
                              Case{solid::Kinematics::small, false, {.law = solid::ContactLaw::reconstruction}});
    const run::Scene<2> scene = two_blocks(one.kinematics, one.flows);
    const Seen without = seen(scene, {}, one.options), with = seen(scene, some_times, one.options);
    CHECK(with.times == some_times);
    CHECK(with.nodes == without.nodes);
    CHECK(with.q_of_nodes == without.q_of_nodes);
}

TEST_CASE("between two nodes bodies are on the line between them, with its velocity", "[run][output_times]") {
    const run::Scene<2> scene = two_blocks(solid::Kinematics::small, false);
    const Seen found = seen(scene, some_times);
    const double mass = 1.0 / 16.0;  // of the cells of the left block
    REQUIRE(found.q.size() == some_times.size());
    for (std::size_t k = 1; k < some_times.size(); ++k) {
        CAPTURE(some_times[k]);
        std::size_t n = 0;
        while (found.nodes[n + 1] < some_times[k] && n + 2 < found.nodes.size()) ++n;
        const double dt = found.nodes[n + 1] - found.nodes[n], share = (some_times[k] - found.nodes[n]) / dt;
        for (const std::size_t i : {std::size_t{0}, std::size_t{21}}) {
            const double from = found.q_of_nodes[n][i], to = found.q_of_nodes[n + 1][i];
            CHECK(found.q[k][i] == Approx((1.0 - share) * from + share * to).margin(1e-15));
            CHECK(found.p[k][i] == Approx(mass * (to - from) / dt).margin(1e-13));
        }
    }
}

TEST_CASE("at a press that moves at constant speed gap and pressure are those of the time, inside of steps as well",
          "[run][output_times]") {
    constexpr double speed = 0.02;
    struct Press : Seen {
        void look_at_time(const dynamics::RunView<2>& run, solid::Solid<2>& solid) override {
            Seen::look_at_time(run, solid);
            field.push_back(solid.contact_at(run.q).field());
        }
        std::vector<solid::ContactField> field;
    };
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 0.5}, {4, 2}, mesh::CellShape::quadrangle, "block");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.0, .density = 1.0}};
    scene.solid.kinematics = {solid::Kinematics::rigid};
    const auto path = [](double t) { return Vector<2>(-speed * t, 0.0); };
    scene.solid.obstacles = {contact::plane_obstacle<2>({1.01, 0.25}, -Vector<2>::UnitX(), 2.0, path)};
    scene.velocity = {Vector<2>::Zero()};
    scene.time = 1.5;
    run::RunOptions options{.integrator = GENERATE(run::SolidIntegrator::memm, run::SolidIntegrator::leapfrog)};
    for (int k = 1; k < 97; ++k) options.times.push_back(0.0155 * k);
    Press press;
    static_cast<void>(run::simulate<2>(scene, options, press));
    REQUIRE(press.times == options.times);
    double stiffness = 0.0;
    for (std::size_t k = 0; k < press.times.size(); ++k) {
        CAPTURE(press.times[k]);
        double moved = 0.0;  // of the three points of the block, along x
        for (std::size_t point = 0; point < 3; ++point) moved += press.q[k][2 * point] / 3.0;
        const double gap = 0.01 - speed * press.times[k] - moved;
        const double found = std::ranges::min(press.field[k].gap), pressure = std::ranges::max(press.field[k].pressure);
        const bool is_known = gap < 0.0 || std::isfinite(found);  // to no face that is apart and was not touched before
        if (is_known) CHECK(found == Approx(gap).margin(1e-13));
        CHECK((pressure > 0.0) == (gap < 0.0));
        if (gap > -1e-6) continue;
        if (stiffness == 0.0) stiffness = pressure / -gap;
        CHECK(pressure == Approx(stiffness * -gap).epsilon(1e-9));
    }
    CHECK(stiffness > 0.0);
}

TEST_CASE("a last time at the end of a run is shown, though the sum of many steps falls short of it",
          "[run][output_times]") {
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {2, 2}, mesh::CellShape::quadrangle, "block");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.0, .density = 1.0}};
    scene.solid.kinematics = {solid::Kinematics::rigid};
    scene.velocity = {Vector<2>(1.0, 0.0)};
    scene.contact = false;
    scene.time = 1.0;
    struct AtTimes : Seen {
        [[nodiscard]] bool wants_look(std::int64_t step) const override { return step == 100000; }
    } found;
    const run::RunOptions options{.dt = 1e-5, .times = {0.5, 1.0}};
    static_cast<void>(run::simulate<2>(scene, options, found));
    REQUIRE(found.nodes.size() == 1);
    CHECK(found.nodes[0] < 1.0 - 1e-12);
    CHECK(found.times == options.times);
    CHECK(found.q.back() == found.q_of_nodes[0]);
}

TEST_CASE("a run that goes on from a checkpoint shows the times after it, as the whole run does", "[run][output_times]") {
    struct Keeping : Seen {
        [[nodiscard]] bool wants_checkpoint(std::int64_t step, bool) const override { return step == 5; }
        void keep(const run::Checkpoint& checkpoint) override { kept = checkpoint; }
        run::Checkpoint kept;
    } whole;
    const run::Scene<2> scene = two_blocks(solid::Kinematics::small, false);
    const run::RunOptions options{.times = some_times};
    static_cast<void>(run::simulate<2>(scene, options, whole));
    Seen rest;
    static_cast<void>(run::simulate<2>(scene, options, rest, &whole.kept));
    const auto n = static_cast<std::ptrdiff_t>(rest.times.size());
    REQUIRE(n > 0);
    REQUIRE(rest.times.front() > whole.kept.motion.time);
    CHECK(rest.times == std::vector<double>(whole.times.end() - n, whole.times.end()));
    CHECK(rest.q == std::vector<std::vector<double>>(whole.q.end() - n, whole.q.end()));
    CHECK(*(whole.times.end() - n - 1) <= whole.kept.motion.time);
}

TEST_CASE("a frame is written for each time, in place of those that are equally far apart", "[run][output_times]") {
    const run::Scene<2> scene = two_blocks(solid::Kinematics::small, false);
    const auto format = GENERATE(run::FrameFormat::vtu, run::FrameFormat::xdmf);
    const test::Folder folder;
    const run::RunOptions options{
        .out = folder.path(), .frames = GENERATE(0, 21), .times = {0.0, 0.123, 1.0}, .format = format};
    run::ResultFiles<2> files(options, "mine", "bodies");
    run::RunResult<2> result = run::simulate<2>(scene, options, files);
    files.finish(scene, result);
    const std::string list =
        test::read_text(folder.path() / (format == run::FrameFormat::vtu ? "bodies.pvd" : "bodies.xmf"));
    for (const char* time : {"\"0\"", "\"0.123\"", "\"1\""}) CHECK(list.find(time) != std::string::npos);
    std::size_t n = 0;
    for (std::size_t at = 0;
         (at = list.find(format == run::FrameFormat::vtu ? "timestep=" : "<Time", at)) != std::string::npos; ++at)
        ++n;
    CHECK(n == 3);
}

TEST_CASE("times that a run cannot show are refused before it begins", "[run][output_times]") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const run::Scene<2> scene = two_blocks(solid::Kinematics::small, false);
    const auto [times, options, words] = GENERATE(table<std::vector<double>, run::RunOptions, std::string>(
        {{{0.2, 0.1}, {}, "number 2 is 0.1 s, after 0.2 s"},
         {{0.2, 0.2}, {}, "each once"},
         {{-0.1}, {}, "number 1 is -0.1 s"},
         {{0.1, nan}, {}, "number 2 is nan s"},
         {{infinity}, {}, "number 1 is inf s"},
         {{0.1, 2.0}, {}, "number 2 is 2 s, and the run ends at 1.5"},
         {{0.1}, {.law = solid::ContactLaw::reconstruction, .integrator = run::SolidIntegrator::memm_async}, "memm_async"},
         {{0.1}, {.pieces = true}, "output.pieces"}}));
    CHECK_THROWS_WITH(seen(scene, times, options), Catch::Contains("output.times") && Catch::Contains(words));
}
