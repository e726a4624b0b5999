// What the energy-neutral filter and the neutral restart are worth in runs of a million steps: scenes in contact again and
// again, each without a remedy against the alternating mode of MEMM, with the filter, with the restart, and with both.
//
// bar: a chain that bounces on a wall under gravity, in one dimension, at three Courant numbers; strip: the same bar of
// cells. disc: one between two walls. blocks: two, of different meshes, on rollers between two walls. rest: a block that
// begins to rest on a plane. rattle: a net of strings that spins inside a ring of strings; both turn, nothing acts from
// outside, and momentum, J~ and H~ are exact. H~ is exact in every scene that does not explode; what differs is H - H~ and
// |e|/m. docs/filter.md has the table.
#include <fmt/format.h>

#include <cstdio>
#include <functional>

#include "abut/base/error.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/steps/simulation.hpp"
#include "apps/support/program.hpp"
#include "studies/extremes/scenes.hpp"
#include "studies/long_runs/rattle.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/bar_host.hpp"
#include "studies/table/table.hpp"

namespace abut::studies::long_runs {
namespace {

const apps::Program program{
    .name = "long_runs",
    .purpose = "Filter and restart against the alternating mode of MEMM, in long runs of six scenes.",
    .footer = "It prints a table, a line for each scene and remedy, and leaves no files."};

constexpr double gravity = 10.0;  // of bar and strip [m/s^2]

struct Options {
    std::vector<std::string> only;
    int steps = 1'000'000;
    int period = 50;
};

struct LongScene {
    std::string name;
    double value;  ///< c dt/h; of solids and rattle the part of the stable step; of rest its weight over E and the foot
    std::function<Outcome(const Remedy&, std::int64_t steps)> run;
};

/// Keeps the ledger of a run of solids until it ends, or breaks off.
struct Recorder : run::Observer<2> {
    void record(const dynamics::LedgerEntry<2>& entry, const run::RunResult<2>& result) override {
        if (ledger.entries().empty()) scale = result.energy.scale.value;
        ledger.record(entry);
    }
    dynamics::Ledger<2> ledger;
    double scale = 0.0;
};

Outcome run_solid(const run::Scene<2>& scene, run::RunOptions options, const Remedy& remedy, std::int64_t steps) {
    options.steps = static_cast<int>(steps);
    options.interval = record_interval;
    options.filter = remedy.filter;
    options.restart = remedy.restart;
    Recorder recorder;
    const ProcessorTime time;
    std::string ending;
    try {
        static_cast<void>(run::simulate<2>(scene, options, recorder));
    } catch (const Error& error) {
        if (recorder.ledger.entries().empty()) throw;
        ending = fmt::format("ends after step {}: {}", recorder.ledger.entries().back().step, error.what());
    }
    Outcome outcome = outcome_of(recorder.ledger, recorder.scale, steps);
    outcome.seconds = time.seconds();
    outcome.ending = ending;
    return outcome;
}

LongScene bar(double courant) {
    return {"bar", courant, [courant](const Remedy& remedy, std::int64_t steps) {
                constexpr int cells = 100, patch = 2;
                BarHost host({.gap = ExactBounce::height, .gravity = gravity}, cells, patch);
                const Bar bar;
                PointStart start{.q = std::vector<double>(cells, 0.0),
                                 .p = std::vector<double>(cells, 0.0),
                                 .dt = courant * bar.length / cells / bar.wave_speed(),
                                 .scale = bar.mass() * gravity * ExactBounce::height};
                return run_points(host, start, remedy, steps);
            }};
}

LongScene strip(double courant) {
    return {"strip", courant, [courant](const Remedy& remedy, std::int64_t steps) {
                constexpr int cells = 100;
                const Bar bar;
                const auto scene = bar_strip<2>({.bar = bar,
                                                 .gap = ExactBounce::height,
                                                 .gravity = gravity,
                                                 .energy = bar.mass() * gravity * ExactBounce::height},
                                                cells);
                run::RunOptions options{.dt = courant * bar.length / cells / bar.wave_speed(), .allow_unstable = true};
                options.contact.compression_limit = 1000.0;  // H stops a run that explodes
                options.contact.search.skin = 0.1 * bar.length;
                return run_solid(scene, options, remedy, steps);
            }};
}

/// Walls at x = -half and half.
std::vector<contact::RigidObstacle<2>> two_walls(double half) {
    return {contact::plane_obstacle<2>(-half * Vector<2>::UnitX(), Vector<2>::UnitX(), 1e3),
            contact::plane_obstacle<2>(half * Vector<2>::UnitX(), -Vector<2>::UnitX(), 1e3)};
}

LongScene disc(double cfl) {
    return {"disc", cfl, [cfl](const Remedy& remedy, std::int64_t steps) {
                return run_solid(extremes::between_walls(0.05), {.cfl = cfl}, remedy, steps);
            }};
}

/// Two blocks on rollers: discs would turn, which linear strain does not bear for long.
LongScene blocks(double cfl) {
    return {"blocks", cfl, [cfl](const Remedy& remedy, std::int64_t steps) {
                const auto triangles = mesh::CellShape::triangle;
                run::Scene<2> scene;
                scene.mesh = mesh::combine<2>(
                    std::vector{mesh::structured_box<2>({-1.1, 0.0}, {-0.1, 0.8}, {6, 5}, triangles, "left"),
                                mesh::structured_box<2>({0.1, 0.0}, {1.1, 0.6}, {5, 4}, triangles, "right")});
                scene.solid.materials.assign(2, {.young = 1.0, .poisson = 0.3, .density = 1.0});
                for (const char* group : {"left.ymin", "right.ymin"})
                    scene.solid.boundary.dirichlet.push_back({.group = group, .constraint = solid::Constraint::normal});
                scene.solid.obstacles = two_walls(1.15);
                scene.velocity = {0.05 * Vector<2>::UnitX(), -0.02 * Vector<2>::UnitX()};
                return run_solid(scene, {.cfl = cfl}, remedy, steps);
            }};
}

LongScene rest(double load) {
    return {"rest", load, [load](const Remedy& remedy, std::int64_t steps) {
                return run_solid(extremes::resting(load), {}, remedy, steps);
            }};
}

LongScene rattle(double cfl) {
    return {"rattle", cfl, [cfl](const Remedy& remedy, std::int64_t steps) {
                Rattle host;
                PointStart start{.q = std::vector<double>(host.size(), 0.0),
                                 .p = host.momenta({0.4, 0.1}, 0.3),
                                 .dt = cfl * 2.0 / host.highest_frequency(),
                                 .isolated = true};
                start.scale = 0.5 * dynamics::mass_product(start.p, host.inverse_mass(), start.p);
                return run_points(host, start, remedy, steps);
            }};
}

std::vector<LongScene> scenes() {
    return {bar(0.5),  bar(0.85),   bar(0.9),    strip(0.5), strip(0.72), disc(0.5),
            disc(0.9), blocks(0.5), blocks(0.9), rest(0.1),  rattle(0.5), rattle(0.85)};
}

struct Line {
    const LongScene* scene;
    const Remedy* remedy;
    Outcome outcome;
    double seconds_without;  ///< of a step without a remedy
};

const Columns<Line> columns = [] {
    const auto of = [](auto member) { return [=](const Line& line) { return line.outcome.*member; }; };
    const auto percent = [](auto member) { return [=](const Line& line) { return 100.0 * (line.outcome.*member); }; };
    const auto per_step = [](const Line& line) { return line.outcome.seconds / static_cast<double>(line.outcome.steps); };
    return Columns<Line>{
        {"", "scene", -8, [](const Line& line) { return line.scene->name; }},
        {"", "", 7, [](const Line& line) { return line.scene->value; }, "{}"},
        {"", " remedy", -9, [](const Line& line) { return " " + line.remedy->name; }},
        {"", "H-H~[%]", 10, percent(&Outcome::excess)},
        {"", "end[%]", 10, percent(&Outcome::excess_end)},
        {"", "|e|/m", 10, of(&Outcome::parasitic)},
        {"", "H~", 10, of(&Outcome::drift)},
        {"", "momentum", 10, of(&Outcome::momentum)},
        {"", "J~", 10, of(&Outcome::pseudo_angular)},
        {"", "events", 10, of(&Outcome::events)},
        {"", "part", 7, [](const Line& line) { return line.outcome.restarts.shortened; }},
        {"", "skipped", 9, [](const Line& line) { return line.outcome.restarts.skipped; }},
        {"", "paid[%]", 9, [](const Line& line) { return 100.0 * line.outcome.restarts.paid; }},
        {"", "seconds", 9, of(&Outcome::seconds), "{:.2f}"},
        {"", "ratio", 7, [=](const Line& line) { return per_step(line) / line.seconds_without; }, "{:.2f}"}};
}();

void run_study(const Options& options) {
    const std::vector<Remedy> remedies{
        {"off"}, {"filter", true}, {"restart", false, options.period}, {"both", true, options.period}};
    fmt::print("{}\n", heads(columns));
    for (const LongScene& scene : scenes()) {
        if (!asks_for(options.only, scene.name)) continue;
        double without = run::not_given;
        for (const Remedy& remedy : remedies) {
            const Outcome outcome = scene.run(remedy, options.steps);
            if (std::isnan(without)) without = outcome.seconds / static_cast<double>(outcome.steps);
            fmt::print("{} {}\n", line(columns, Line{&scene, &remedy, outcome, without}), outcome.ending);
            std::fflush(stdout);
        }
    }
}

void add_options(Flags& flags, Options& options) {
    flags.group("Scenes");
    flags.names("--only", options.only, "scenes to run", {"bar", "strip", "disc", "blocks", "rest", "rattle"});
    flags.group("Time");
    flags.count("--steps", options.steps, "steps of each run", 1);
    flags.count("--period", options.period, "steps from one neutral restart to the next", 1);
}

const bool is_listed = list(entry_of(program, Options{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::long_runs
