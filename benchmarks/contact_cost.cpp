// What contact adds to a step: two cylinders collide off-centre, slip and rebound. It is the very scene of
// scenes/slipping_cylinders_3d.toml, 50,000 tetrahedra together.
//
// The same scene steps with and without contact (`options.contact` empty: the bodies pass through each other), once more
// with the bodies far apart (the price of looking), and once more without contact (what the machine makes of two equal
// runs), in turn, a few steps each, through the whole impact. Expected: contact and search add at most 20 % to the run, at
// most 2 % while the bodies are apart.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <numeric>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/contact_view.hpp"
#include "studies/scenes/two_cylinders.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;

struct Choices {
    studies::TwoCylinders cylinders{.size = 1.0 / 12.0};
    double time = 0.0;
    double skin = 0.0;
    int threads = 1;
    int block = 20;
    std::string json;
};

/// How the scenes differ.
struct Variant {
    const char* name;
    bool contact = true;
    double gap_more = 0.0;  // [m]
};

run::Scene<3> make_scene(studies::TwoCylinders cylinders, double gap_more) {
    cylinders.gap += gap_more;
    return studies::two_cylinders<3>(cylinders);
}

/// A scene with all that it needs to step.
class Scene {
public:
    /// `dt` 0: as the example by default; of all scenes that with contact decides.
    Scene(const Variant& variant, const Choices& choices, double dt = 0.0)
        : name_(variant.name),
          clock_(benchmark::clock_for(choices.threads)),
          scene_(make_scene(choices.cylinders, variant.gap_more)),
          solid_(scene_.mesh, options(variant, choices)),
          dt_(dt > 0.0 ? dt : run::RunOptions{}.cfl * dynamics::stable_step(solid_).dt),
          integrator_(solid_, std::vector<double>(solid_.size(), 0.0), solid::uniform_momentum<3>(solid_, scene_.velocity),
                      dt_) {}
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    void run(int steps) {
        seconds_.push_back(benchmark::seconds_of(
            [&] {
                for (int i = 0; i < steps; ++i) integrator_.step();
            },
            clock_));
        active_.push_back(solid_.contact().report().active_pairs);
    }

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] double dt() const { return dt_; }
    [[nodiscard]] double time() const { return scene_.time; }
    [[nodiscard]] int n_cells() const { return scene_.mesh.n_cells(); }
    [[nodiscard]] const solid::Solid<3>& solid() const { return solid_; }
    [[nodiscard]] dynamics::LedgerEntry<3> measure() { return dynamics::measure(integrator_, solid_); }
    [[nodiscard]] const std::vector<double>& seconds() const { return seconds_; }
    [[nodiscard]] const std::vector<std::int64_t>& active() const { return active_; }
    [[nodiscard]] double total() const { return std::accumulate(seconds_.begin(), seconds_.end(), 0.0); }

private:
    [[nodiscard]] solid::SolidOptions<3> options(const Variant& variant, const Choices& choices) const {
        solid::SolidOptions<3> result = scene_.solid;
        if (variant.contact) result.contact.emplace().search.skin = choices.skin;
        return result;
    }

    std::string name_;
    benchmark::Clock clock_;
    run::Scene<3> scene_;
    solid::Solid<3> solid_;
    double dt_;
    dynamics::Memm<solid::Solid<3>> integrator_;
    std::vector<double> seconds_;       // a block of steps
    std::vector<std::int64_t> active_;  // pairs at the end of the block
};

/// Median of the ratios of simultaneous blocks: what else the machine does meets both.
double median_ratio(const Scene& scene, const Scene& reference, bool only_active) {
    benchmark::Samples ratios;
    for (std::size_t i = 0; i < scene.seconds().size(); ++i)
        if (!only_active || scene.active()[i] > 0) ratios.seconds.push_back(scene.seconds()[i] / reference.seconds()[i]);
    return ratios.seconds.empty() ? 1.0 : ratios.median();
}

nlohmann::json to_json(const Scene& scene, const Scene& reference, std::int64_t steps) {
    const auto report = scene.solid().contact().report();
    const auto& times = scene.solid().times();
    const double all = times.bulk + times.contact + times.search;
    const auto share = [&](double seconds) { return seconds / all; };
    return {{"scene", scene.name()},
            {"ms_a_step", 1e3 * scene.total() / static_cast<double>(steps)},
            {"over_no_contact",
             {{"total", scene.total() / reference.total()},
              {"median", median_ratio(scene, reference, false)},
              {"median_while_touching", median_ratio(scene, reference, true)}}},
            {"share", {{"bulk", share(times.bulk)}, {"contact", share(times.contact)}, {"search", share(times.search)}}},
            {"active_pairs_max", report.active_pairs_max},
            {"events", report.events},
            {"candidates", report.candidates},
            {"rebuilds", report.rebuilds}};
}

void print(const nlohmann::json& r) {
    fmt::print(
        "{:<13} {:8.3f} ms a step, {:.3f} times no contact (median of blocks {:.3f}, while touching {:.3f}); bulk {:.1f} %, "
        "contact {:.1f} %, search {:.1f} %; pairs {}, events {}, rebuilds {}\n",
        r["scene"].get<std::string>(), r["ms_a_step"].get<double>(), r["over_no_contact"]["total"].get<double>(),
        r["over_no_contact"]["median"].get<double>(), r["over_no_contact"]["median_while_touching"].get<double>(),
        100.0 * r["share"]["bulk"].get<double>(), 100.0 * r["share"]["contact"].get<double>(),
        100.0 * r["share"]["search"].get<double>(), r["active_pairs_max"].get<std::int64_t>(),
        r["events"].get<std::int64_t>(), r["rebuilds"].get<std::int64_t>());
}

/// Whether energy and momentum hold from `first` on, no contact was lost, and the bodies did touch.
void check(Scene& scene, const dynamics::LedgerEntry<3>& first) {
    const auto last = scene.measure();
    const double kinetic = first.kinetic;
    const double mass = std::accumulate(scene.solid().masses().begin(), scene.solid().masses().end(), 0.0);
    const double momentum = std::sqrt(2.0 * kinetic * mass);  // m v of bodies as heavy and as fast as each other
    const auto report = scene.solid().contact().report();
    benchmark::require_small("pseudo-energy over its value, at the end against the start",
                             std::abs(last.pseudo_energy - first.pseudo_energy) / kinetic, 1e-11);
    benchmark::require_small("momentum over m v, at the end against the start",
                             (last.linear_momentum - first.linear_momentum).norm() / momentum, 1e-12);
    benchmark::require_small("missed contacts", static_cast<double>(report.missed_contacts), 0.0);
    if (report.events == 0)
        throw std::runtime_error("the bodies never touched: nothing is measured. Raise --time or --speed.");
}

/// The answer first, of the same impact with cells three times as large: at a hundredth of the cost.
void check_coarse(Choices choices) {
    choices.cylinders.size *= 3.0;
    Scene coarse({.name = "coarse"}, choices);
    const auto first = coarse.measure();
    coarse.run(static_cast<int>(std::ceil(choices.time / coarse.dt())));
    check(coarse, first);
}

int run_benchmark(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("What contact adds to a step of two colliding cylinders.");
    auto& cylinders = choices.cylinders;
    options.add("--size", cylinders.size, "edge length of the cells of two cylinders of radius and length 1 [m]").positive();
    options.add("--speed", cylinders.speed, "of each body [m/s]").positive();
    options.add("--offset", cylinders.offset, "between the two lines of motion [m]").between(0.0, 1.9);
    options.add("--gap", cylinders.gap, "at the start [m]").positive();
    options.add("--time", choices.time, "to run [s]; 0: as long as the scene does").not_negative();
    options.add("--skin", choices.skin,
                "how far faces move before the candidate list is rebuilt; 0: the library's choice [m]");
    options.add("--threads", choices.threads).positive();
    options.add("--block", choices.block, "steps of one scene before it is the next one's turn").positive();
    options.add("--json", choices.json, "file for the result");
    if (const auto status = options.parse(argc, argv)) return *status;

    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(choices.threads));
    Scene contact({.name = "contact"}, choices);
    if (choices.time == 0.0) choices.time = contact.time();
    check_coarse(choices);
    Scene without({.name = "no contact", .contact = false}, choices, contact.dt());
    Scene again({.name = "again without", .contact = false}, choices, contact.dt());
    Scene apart({.name = "far apart", .gap_more = 1e3}, choices, contact.dt());
    const auto first = contact.measure();
    const auto blocks = static_cast<int>(std::ceil(choices.time / (choices.block * contact.dt())));
    fmt::print("{} cells, {} steps of {:.4g} s, {} thread(s)\n", contact.n_cells(), blocks * choices.block, contact.dt(),
               choices.threads);
    for (int i = 0; i < blocks; ++i)
        for (Scene* scene : {&without, &contact, &again, &apart}) scene->run(choices.block);
    check(contact, first);  // of what was timed, too: no figure of a wrong answer is shown

    nlohmann::json result = benchmark::circumstances(argc, argv);
    result["cells"] = contact.n_cells();
    result["steps"] = blocks * choices.block;
    for (const Scene* scene : {&without, &contact, &again, &apart}) {
        result["results"].push_back(to_json(*scene, without, blocks * choices.block));
        print(result["results"].back());
    }
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, run_benchmark); }
