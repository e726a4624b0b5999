// A step of a solid whose times another program dictates (ClockedRun::advance), against the same step without.
//
// A bar of squares vibrates, and a group of its faces is loaded from outside: not at all, by tractions that stay, or by
// tractions that change with each call. One run takes steps (SteppedRun::step), another one goes on by 1, 1.25 and 3 steps per
// call, in turn; where tractions change by 1 alone. Where they do not both have to end in the same state, to the bit. A second
// run by steps (`again`) tells what the machine makes of equal works. A step is one mean force, and two potentials more where
// tractions change. One thread, processor time. Expected: at most 1.02.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/clocked_run.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;
using solid::ClockedRun;
using solid::SteppedRun;

struct Choices {
    int cells = 20000;
    int steps = 100;
    int repetitions = 20;
    int threads = 1;
    std::string json;
};

enum class Load { none, stays, changes };
constexpr const char* name_of(Load load) {
    return load == Load::none ? "no loads" : load == Load::stays ? "loads that stay" : "loads that change";
}

/// A bar, twice as long as high.
mesh::Mesh<2> bar(int cells) {
    const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(cells / 2.0))));
    return mesh::structured_box<2>({0.0, 0.0}, {2.0, 1.0}, {2 * n, n}, mesh::CellShape::quadrangle, "bar");
}

/// A run whose end is loaded.
class Vibration {
public:
    Vibration(const mesh::Mesh<2>& mesh, Load load) : load_(load), n_faces_(mesh.group("xmin").faces.size()) {
        solid::SolidOptions<2> options;
        options.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0}};
        if (load != Load::none) options.boundary.traction = {{.group = "xmin", .value = traction(0), .from_outside = true}};
        auto solid = std::make_unique<solid::Solid<2>>(mesh, options);
        const double dt = 0.9 * dynamics::stable_step(*solid).dt;
        std::vector<double> q(solid->size()), p(solid->size(), 0.0);
        for (std::size_t i = 0; i < q.size(); i += 2) q[i] = 1e-3 * std::cos(3.0 * solid->rest_positions()[i / 2][0]);
        run_.emplace(std::move(solid), q, p, dt, solid::RunRemedies{});
    }

    void steps(int n) {
        for (int i = 0; i < n; ++i) {
            if (load_ == Load::changes) run_->solid().set_traction("xmin", next_tractions());
            run_->step();
        }
    }
    /// The same under a clock, by `d` steps per call.
    void advance(int n, double d) {
        if (!clock_) clock_.emplace(*run_);
        for (int i = 0; i < std::lround(n / d); ++i) {
            if (load_ == Load::changes) clock_->set_traction("xmin", next_tractions());
            clock_->advance(d * run_->memm().dt());
        }
    }
    [[nodiscard]] const dynamics::Memm<solid::Solid<2>>& memm() const { return run_->memm(); }

private:
    [[nodiscard]] static Vector<2> traction(int call) { return {1e-4 * (1.0 + 0.1 * (call % 7)), 0.0}; }
    [[nodiscard]] std::vector<Vector<2>> next_tractions() { return std::vector<Vector<2>>(n_faces_, traction(++calls_)); }

    Load load_;
    std::size_t n_faces_;
    int calls_ = 0;
    std::optional<SteppedRun<2>> run_;
    std::optional<ClockedRun<2>> clock_;
};

void require_same(const Vibration& stepped, const Vibration& dictated) {
    const auto q = stepped.memm().q(), other = dictated.memm().q();
    if (stepped.memm().steps() != dictated.memm().steps() || !std::ranges::equal(q, other))
        throw std::runtime_error("the dictated run is in another state than the stepped one");
}

constexpr double stepped_again = 0.0;  // in the place of the length of a call

/// A run, and the length of its calls over the step.
struct Rival {
    double length;
    std::unique_ptr<Vibration> run;

    void take(int steps) const {
        if (length == stepped_again)
            run->steps(steps);
        else
            run->advance(steps, length);
    }
    [[nodiscard]] std::string name() const { return length == stepped_again ? "again" : fmt::format("d {:g}", length); }
};

std::vector<Rival> rivals_of(const mesh::Mesh<2>& mesh, Load load) {
    std::vector<double> lengths{stepped_again, 1.0};
    if (load != Load::changes) lengths.insert(lengths.end(), {1.25, 3.0});
    std::vector<Rival> rivals;
    for (const double length : lengths) rivals.push_back({length, std::make_unique<Vibration>(mesh, load)});
    return rivals;
}

void measure(const mesh::Mesh<2>& mesh, Load load, const Choices& choices, nlohmann::json& results) {
    const int steps = std::max(1, choices.steps / 15) * 15;
    Vibration stepped(mesh, load);
    const std::vector<Rival> rivals = rivals_of(mesh, load);
    std::vector<std::function<void()>> works{[&] { stepped.steps(steps); }};
    for (const Rival& rival : rivals) works.push_back([&rival, steps] { rival.take(steps); });
    const auto samples = benchmark::time_in_turn(choices.repetitions, benchmark::clock_for(choices.threads), works);
    if (load != Load::changes)
        for (const Rival& rival : rivals) require_same(stepped, *rival.run);
    fmt::print("{:<18} step {:7.1f} us", name_of(load), samples[0].least() / steps * 1e6);
    for (std::size_t i = 0; i < rivals.size(); ++i) {
        const double least = samples[i + 1].least() / samples[0].least(),
                     median = samples[i + 1].median() / samples[0].median();
        fmt::print("  {}: {:.3f} ({:.3f})", rivals[i].name(), least, median);
        results.push_back({{"load", name_of(load)},
                           {"cells", mesh.n_cells()},
                           {"run", rivals[i].name()},
                           {"seconds_per_step", samples[0].least() / steps},
                           {"over_step", least},
                           {"over_step_of_medians", median}});
    }
    fmt::print("\n");
}

int run(int argc, char** argv) {
    Choices choices;
    benchmark::Options options("Steps under times that another program dictates against steps without");
    options.add("--cells", choices.cells, "About how many").positive();
    options.add("--steps", choices.steps, "Of each timing, rounded down to a multiple of 15").positive();
    options.add("--repetitions", choices.repetitions, "Of each timing").positive();
    options.add("--threads", choices.threads, "That Abut may use").positive();
    options.add("--json", choices.json, "File for the results");
    if (const auto code = options.parse(argc, argv)) return *code;
    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(choices.threads));
    const mesh::Mesh<2> mesh = bar(choices.cells);
    fmt::print("{} cells; time of advance over that of step, least of {} (medians)\n", mesh.n_cells(), choices.repetitions);
    nlohmann::json result = benchmark::circumstances(argc, argv);
    for (const Load load : {Load::none, Load::stays, Load::changes}) measure(mesh, load, choices, result["results"]);
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, &run); }
