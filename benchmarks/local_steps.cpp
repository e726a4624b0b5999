// What local time steps save: two bodies collide head-on, with cells `--refine` times smaller where they touch.
//
// The same scene under memm, every cell with the step that the smallest one needs, and under memm_async, each cell with a
// power of two of it. Both step in turn, from one common node to the next, through the impact.
// Expected: as few forces of cells as the levels allow, time in proportion to them, and the same drift of the pseudo-energy.
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <optional>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/local_steps.hpp"
#include "studies/scenes/two_cylinders.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;

struct Choices {
    int dim = 2;
    studies::TwoCylinders cylinders{.offset = 0.0, .refine = 10.0};
    double size = 0.0;
    double time = 0.0;
    double cfl = 0.9;
    int contact_levels = 0;
    int threads = 1;
    int block = 20;
    std::string json;
};

template <int Dim>
solid::SolidOptions<Dim> with_contact(const run::Scene<Dim>& scene) {
    solid::SolidOptions<Dim> options = scene.solid;
    options.contact.emplace();
    return options;
}

/// A solid under a scheme, with what it cost and kept.
template <int Dim>
struct Record {
    const char* name;
    double seconds = 0.0;
    std::int64_t evaluations = 0;
    dynamics::Ledger<Dim> ledger{};
    contact::ContactReport contact{};
    solid::SolidTimes times{};
    double speed = 0.0;  ///< of the left body at the end [m/s]
};

template <int Dim, class Scheme>
void step(Scheme& scheme, solid::Solid<Dim>& solid, int steps, benchmark::Clock clock, Record<Dim>& record) {
    record.seconds += benchmark::seconds_of(
        [&] {
            for (int i = 0; i < steps; ++i) scheme.step();
        },
        clock);
    record.ledger.record(dynamics::measure(scheme, solid));
}

template <int Dim, class Scheme>
void close(const Scheme& scheme, const solid::Solid<Dim>& solid, Record<Dim>& record) {
    record.evaluations = solid.evaluations();
    record.contact = solid.contact().report();
    record.times = solid.times();
    record.speed = solid::body_motions<Dim>(scheme, solid)[0].velocity.x();
    const double kinetic = record.ledger.entries().front().kinetic;
    benchmark::require_small("drift of the pseudo-energy over K0", record.ledger.pseudo_energy_drift() / kinetic, 1e-11);
    benchmark::require_small("missed contacts", static_cast<double>(record.contact.missed_contacts), 0.0);
    if (record.contact.events == 0) throw std::runtime_error("the bodies never touched: nothing is measured. Raise --time.");
}

template <int Dim>
nlohmann::json to_json(const Record<Dim>& record) {
    const double kinetic = record.ledger.entries().front().kinetic;
    return {{"scheme", record.name},
            {"seconds", record.seconds},
            {"force_evaluations", record.evaluations},
            {"ns_an_evaluation", 1e9 * record.seconds / static_cast<double>(record.evaluations)},
            {"bulk_s", record.times.bulk},
            {"contact_s", record.times.contact},
            {"search_s", record.times.search},
            {"drift_over_K0", record.ledger.pseudo_energy_drift() / kinetic},
            {"energy_excess_over_K0", record.ledger.energy_excess() / kinetic},
            {"parasitic", record.ledger.parasitic()},
            {"events", record.contact.events},
            {"speed_at_end", record.speed}};
}

void print(const nlohmann::json& r) {
    fmt::print(
        "{:<11} {:8.3f} s (bulk {:.3f}, contact {:.3f}, search {:.3f}), {:.4g} forces of cells, {:.0f} ns each; drift/K0 "
        "{:.1e}, (H-H~)/K0 {:.1e}, |e|/m {:.1e}, events {}, speed at the end {:+.6f}\n",
        r["scheme"].get<std::string>(), r["seconds"].get<double>(), r["bulk_s"].get<double>(), r["contact_s"].get<double>(),
        r["search_s"].get<double>(), r["force_evaluations"].get<double>(), r["ns_an_evaluation"].get<double>(),
        r["drift_over_K0"].get<double>(), r["energy_excess_over_K0"].get<double>(), r["parasitic"].get<double>(),
        r["events"].get<std::int64_t>(), r["speed_at_end"].get<double>());
}

template <int Dim>
nlohmann::json compare(const Choices& choices) {
    const auto clock = benchmark::clock_for(choices.threads);
    const run::Scene<Dim> scene = studies::two_cylinders<Dim>(choices.cylinders);
    solid::Solid<Dim> uniform_solid(scene.mesh, with_contact(scene));
    solid::Solid<Dim> local_solid(scene.mesh, with_contact(scene));
    const auto stable = dynamics::stable_step(uniform_solid);
    std::optional<solid::SolidLocalSteps> local;
    const double setup = benchmark::seconds_of(
        [&] { local = solid::local_steps(local_solid, stable, {.contact_levels = choices.contact_levels}); }, clock);
    const std::vector<double> rest(uniform_solid.size(), 0.0);
    const auto p = solid::uniform_momentum<Dim>(uniform_solid, scene.velocity);
    dynamics::Memm uniform(uniform_solid, rest, p, choices.cfl * stable.dt);
    dynamics::MemmAsync async(local_solid, rest, p, choices.cfl * local->dt, local->steps);

    Record<Dim> uniform_record{"memm"}, local_record{"memm_async"};
    const int parts = static_cast<int>(std::lround(local->dt / stable.dt));
    const double time = choices.time > 0.0 ? choices.time : scene.time;
    const int steps = choices.block * static_cast<int>(std::ceil(time / (choices.block * async.dt())));
    fmt::print("{} cells, {} with dt, dt/2, ...; {} steps of {:.4g} s; sorting cells into levels took {:.2f} s\n",
               scene.mesh.n_cells(), fmt::join(local->cells, ", "), steps, async.dt(), setup);
    uniform_record.ledger.record(dynamics::measure(uniform, uniform_solid));
    local_record.ledger.record(dynamics::measure(async, local_solid));
    const std::int64_t evaluated = uniform_solid.evaluations();
    for (int i = 0; i < steps; i += choices.block) {
        step<Dim>(uniform, uniform_solid, choices.block * parts, clock, uniform_record);
        step<Dim>(async, local_solid, choices.block, clock, local_record);
    }
    close<Dim>(uniform, uniform_solid, uniform_record);
    close<Dim>(async, local_solid, local_record);
    uniform_record.evaluations -= evaluated;
    const double forces = static_cast<double>(uniform_record.evaluations) / static_cast<double>(local_record.evaluations);
    nlohmann::json result = {{"dim", Dim},
                             {"cells", scene.mesh.n_cells()},
                             {"level_cells", local->cells},
                             {"steps", steps},
                             {"setup_s", setup},
                             {"fewer_forces", forces},
                             {"faster", uniform_record.seconds / local_record.seconds},
                             {"results", {to_json(uniform_record), to_json(local_record)}}};
    for (const auto& record : result["results"]) print(record);
    fmt::print("{:.2f} times fewer forces of cells, {:.2f} times faster\n", forces, result["faster"].get<double>());
    return result;
}

int run_benchmark(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("Local time steps against one step for all cells, of two bodies refined where they touch.");
    auto& cylinders = choices.cylinders;
    options.add("--dim", choices.dim).between(2, 3);
    options.add("--size", choices.size, "edge length of the large cells [m]; 0: 0.03 in 2D, 0.15 in 3D").not_negative();
    options.add("--refine", cylinders.refine, "how many times smaller cells are where the bodies touch")
        .between(1.0, 1000.0);
    options.add("--refine-over", cylinders.refine_over, "part of the radius over which they grow from there")
        .between(0.01, 2.0);
    options.add("--time", choices.time, "to run [s]; 0: as long as the scene does").not_negative();
    options.add("--cfl", choices.cfl, "step over the stable step").between(0.01, 1.0);
    options.add("--contact-levels", choices.contact_levels, "levels that cells in contact are finer than all others")
        .between(0, 6);
    options.add("--threads", choices.threads).positive();
    options.add("--block", choices.block, "common steps of one scheme before it is the other's turn").positive();
    options.add("--json", choices.json, "file for the result");
    if (const auto status = options.parse(argc, argv)) return *status;
    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(choices.threads));
    if (choices.size == 0.0) choices.size = choices.dim == 2 ? 0.03 : 0.15;
    cylinders.size = choices.size;
    nlohmann::json result = benchmark::circumstances(argc, argv);
    result.update(choices.dim == 2 ? compare<2>(choices) : compare<3>(choices));
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return benchmark::main(argc, argv, run_benchmark); }
