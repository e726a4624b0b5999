// What contact adds to a step: two cylinders collide off-centre, slip and rebound, as by default in
// examples/slipping_cylinders --dim 3: 50,000 tetrahedra together.
//
// The same scene steps with and without contact (`options.contact` empty: the bodies pass through each other), and once
// more with the bodies far apart (the price of looking), in turn, a few steps each, through the whole impact.
// Expected: contact and search add at most 20 % to the run, next to nothing while the bodies are apart.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes.hpp"
#include "support/measure.hpp"

namespace {

using namespace abut;

struct Choices {
    double size = 1.0 / 12.0;
    double speed = 0.05;
    double offset = 0.8;
    double gap = 0.02;
    double time = 10.2;
    double skin = 0.0;
    int threads = 1;
    int block = 20;
    std::string json;
};

constexpr double contact_margin = 0.85;  // of the stable step, with contact; all scenes take the same

mesh::Mesh<3> two_cylinders(const Choices& choices, double gap) {
    const double across = std::sqrt(4.0 - choices.offset * choices.offset) + gap;
    const std::array<mesh::Mesh<3>, 2> bodies{
        mesh::cylinder({.radius = 1.0, .length = 1.0, .size = choices.size, .name = "left"}),
        mesh::cylinder({.centre = {across, choices.offset, 0.0}, .radius = 1.0, .length = 1.0, .size = choices.size, .variant = 1, .name = "right"})};
    return mesh::combine<3>(bodies);
}

/// A scene with all that it needs to step.
class Scene {
public:
    Scene(std::string name, const Choices& choices, double gap, bool with_contact)
        : name_(std::move(name)), clock_(benchmark::clock_for(choices.threads)), mesh_(two_cylinders(choices, gap)), solid_(mesh_, options(choices, with_contact)) {
        dt_ = 0.9 * contact_margin * 2.0 / stable_step(solid_).omega_max;
        const std::array<Vector<3>, 2> velocity{Vector<3>(choices.speed, 0.0, 0.0), Vector<3>(-choices.speed, 0.0, 0.0)};
        const auto momentum = dynamics::uniform_momentum<3>(solid_, velocity);
        integrator_ = std::make_unique<dynamics::Memm<dynamics::Solid<3>>>(solid_, std::vector<double>(solid_.size(), 0.0), momentum, dt_);
    }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    void run(int steps) {
        seconds_.push_back(benchmark::seconds_of([&] {
            for (int i = 0; i < steps; ++i) integrator_->step();
        }, clock_));
        active_.push_back(solid_.contact_report().active_pairs);
    }

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] double dt() const { return dt_; }
    [[nodiscard]] int n_cells() const { return mesh_.n_cells(); }
    [[nodiscard]] const dynamics::Solid<3>& solid() const { return solid_; }
    [[nodiscard]] const std::vector<double>& seconds() const { return seconds_; }
    [[nodiscard]] const std::vector<std::int64_t>& active() const { return active_; }
    [[nodiscard]] double total() const { return std::accumulate(seconds_.begin(), seconds_.end(), 0.0); }

private:
    static dynamics::SolidOptions<3> options(const Choices& choices, bool with_contact) {
        dynamics::SolidOptions<3> result;
        result.materials.assign(2, {.young = 1.0, .poisson = 0.3, .density = 1.0});
        if (with_contact) result.contact.emplace().skin = choices.skin;
        return result;
    }

    std::string name_;
    benchmark::Clock clock_;
    mesh::Mesh<3> mesh_;
    dynamics::Solid<3> solid_;
    double dt_ = 0.0;
    std::unique_ptr<dynamics::Memm<dynamics::Solid<3>>> integrator_;
    std::vector<double> seconds_;      // a block of steps
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
    const auto report = scene.solid().contact_report();
    const auto& times = scene.solid().times();
    const double all = times.bulk + times.contact + times.search;
    const auto share = [&](double seconds) { return seconds / all; };
    return {{"scene", scene.name()},
            {"ms_a_step", 1e3 * scene.total() / static_cast<double>(steps)},
            {"over_no_contact", {{"total", scene.total() / reference.total()},
                                 {"median", median_ratio(scene, reference, false)},
                                 {"median_while_touching", median_ratio(scene, reference, true)}}},
            {"share", {{"bulk", share(times.bulk)}, {"contact", share(times.contact)}, {"search", share(times.search)}}},
            {"active_pairs_max", report.active_pairs_max},
            {"events", report.events},
            {"candidates", report.candidates},
            {"rebuilds", report.rebuilds}};
}

void print(const nlohmann::json& r) {
    fmt::print("{:<12} {:8.3f} ms a step, {:.3f} times no contact (median of blocks {:.3f}, while touching {:.3f}); bulk {:.1f} %, contact {:.1f} %,"
               " search {:.1f} %; pairs {}, events {}, rebuilds {}\n",
               r["scene"].get<std::string>(), r["ms_a_step"].get<double>(), r["over_no_contact"]["total"].get<double>(),
               r["over_no_contact"]["median"].get<double>(), r["over_no_contact"]["median_while_touching"].get<double>(),
               100.0 * r["share"]["bulk"].get<double>(), 100.0 * r["share"]["contact"].get<double>(), 100.0 * r["share"]["search"].get<double>(),
               r["active_pairs_max"].get<std::int64_t>(), r["events"].get<std::int64_t>(), r["rebuilds"].get<std::int64_t>());
}

/// The answer first: momentum is kept, and the bodies did touch.
void check(const Scene& contact) {
    if (contact.solid().contact_report().events == 0)
        throw std::runtime_error("the bodies never touched: nothing is measured. Raise --time or --speed.");
    if (const auto lost = contact.solid().contact_report().lost_contacts; lost != 0)
        throw std::runtime_error(fmt::format("{} contacts were lost, 0 are allowed: nothing is measured.", lost));
}

int run(int argc, char** argv) {
    Choices choices;
    CLI::App app{"What contact adds to a step of two colliding cylinders."};
    app.option_defaults()->always_capture_default();
    app.add_option("--size", choices.size, "edge length of the cells of two cylinders of radius and length 1 [m]")->check(CLI::PositiveNumber);
    app.add_option("--speed", choices.speed, "of each body [m/s]")->check(CLI::PositiveNumber);
    app.add_option("--offset", choices.offset, "between the two lines of motion [m]")->check(CLI::Range(0.0, 1.9));
    app.add_option("--gap", choices.gap, "at the start [m]")->check(CLI::PositiveNumber);
    app.add_option("--time", choices.time, "to run [s]")->check(CLI::PositiveNumber);
    app.add_option("--skin", choices.skin, "how far faces move before the candidate list is made anew; 0: the library's choice [m]");
    app.add_option("--threads", choices.threads)->check(CLI::PositiveNumber);
    app.add_option("--block", choices.block, "steps of one scene before it is the next one's turn")->check(CLI::PositiveNumber);
    app.add_option("--json", choices.json, "file for the result");
    CLI11_PARSE(app, argc, argv);

    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(choices.threads));
    Scene without("no contact", choices, choices.gap, false), contact("contact", choices, choices.gap, true), apart("far apart", choices, 1e3, true);
    const auto blocks = static_cast<int>(std::ceil(choices.time / (choices.block * contact.dt())));
    fmt::print("{} cells, {} steps of {:.4g} s, {} thread(s)\n", contact.n_cells(), blocks * choices.block, contact.dt(), choices.threads);
    for (int i = 0; i < blocks; ++i)
        for (Scene* scene : {&without, &contact, &apart}) scene->run(choices.block);
    check(contact);

    nlohmann::json result = benchmark::circumstances(argc, argv);
    result["cells"] = contact.n_cells();
    result["steps"] = blocks * choices.block;
    for (const Scene* scene : {&without, &contact, &apart}) {
        result["results"].push_back(to_json(*scene, without, blocks * choices.block));
        print(result["results"].back());
    }
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "benchmark_contact_cost: {}\n", error.what());
        return 1;
    }
}
