// The chain of Fermi, Pasta and Ulam with stiff and soft springs in turn: fast vibrations that exchange energy slowly.
//
// H = 1/2 sum p_i^2 + omega^2/4 sum (q_2i - q_2i-1)^2 + sum (q_2i+1 - q_2i)^4, six unit masses, q_0 = q_7 = 0, omega = 50
// (Hairer, Lubich and Wanner, Geometric Numerical Integration, I.5.1). Only the first stiff spring vibrates at the start:
// H0 = 2.00120008. I_i = 1/2 (y_i'^2 + omega^2 y_i^2), y_i = (q_2i - q_2i-1)/sqrt2, wander from spring to spring; their sum
// I stays near 1. Expect max |H - H0|/H0 of 1.67 % (leapfrog), 1.68 % (memm) at dt = 0.01, and that memm keeps its own
// energy to 3e-13. omega dt < 2 is the limit of memm and leapfrog: 0.039 runs, 0.041 explodes, and H~ does not tell.
// memm_async with finer steps for the first two masses alone tunes their spring apart from the others, by (omega dt)^2/24 of
// its frequency: exchange needs resonance and all but stops at dt = 0.01.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "abut/dynamics/particles.hpp"
#include "abut/run/options.hpp"
#include "studies/program/entry.hpp"
#include "studies/schemes/comparison.hpp"

namespace abut::studies::fpu_study {
namespace {

using Chain = dynamics::Particles<dynamics::LineSpring>;

const apps::Program program{.name = "fpu",
                            .purpose = "Chain of Fermi, Pasta and Ulam: exchange of fast vibrations, under all integrators.",
                            .footer = "Six unit masses between two walls; stiff linear and soft quartic springs in turn."};

struct FpuOptions {
    SchemeOptions schemes;
    double omega = 50.0;  // [1/s]
    double dt = 0.01;     // [s]
    double time = 200.0;  // [s]
    std::filesystem::path out = "out/" + program.name;
    int interval = 0;
};

void add_options(Flags& flags, FpuOptions& options) {
    const Limits time{.unit = "s", .above = 0.0};
    flags.group("Chain");
    flags.number("--omega", options.omega, "circular frequency of the stiff springs", {.unit = "1/s", .above = 0.0});
    flags.group("Time");
    flags.number("--dt", options.dt, "time step", time);
    flags.number("--time", options.time, "end of the run", time);
    add_integrator(flags, options.schemes);
    add_mean(flags, options.schemes);
    add_gauge(flags, options.schemes);
    add_local_steps(flags, options.schemes);
    add_start(flags, options.schemes);
    flags.out(options.out);
    add_interval_option(flags, options.interval);
}

Chain chain(double omega) {
    std::vector<dynamics::Bond<dynamics::LineSpring>> bonds;
    for (std::int32_t i = 0; i < 3; ++i) {
        bonds.push_back({2 * i - 1, 2 * i, {.quartic = 4.0}});  // q_0 = 0 is Bond::fixed, -1
        bonds.push_back({2 * i, 2 * i + 1, {.stiffness = 0.5 * omega * omega}});
    }
    bonds.push_back({5, dynamics::Bond<dynamics::LineSpring>::fixed, {.quartic = 4.0}});
    return {std::vector<double>(6, 1.0), bonds};
}

/// The energies of the three stiff springs.
class Oscillators : public Watcher {
public:
    explicit Oscillators(double omega) : omega_(omega) {}

    void look(const Node& node) override {
        for (std::size_t i = 0; i < 3; ++i) {
            const double y = (node.q[2 * i + 1] - node.q[2 * i]) / std::sqrt(2.0);
            const double speed = (node.momentum(2 * i + 1) - node.momentum(2 * i)) / std::sqrt(2.0);
            energy_[i] = 0.5 * (speed * speed + omega_ * omega_ * y * y);
            largest_[i] = std::max(largest_[i], energy_[i]);
        }
        if (node.time == 0.0) start_ = total();
        if (!overtaken_ && energy_[1] > energy_[0]) overtaken_ = node.time;
        deviation_ = std::max(deviation_, std::abs(total() - start_));
    }
    std::vector<std::string> columns() const override { return {"I1", "I2", "I3", "I"}; }
    std::vector<double> row() const override { return {energy_[0], energy_[1], energy_[2], total()}; }
    std::vector<run::Finding> findings() const override {
        return {
            {"I_start", "oscillatory energy I at the start [J]", start_},
            {"I_deviation_max", "max |I - I0| [J]", deviation_},
            {"I2_max", "exchange: largest I2 [J]", largest_[1]},
            {"I3_max", "exchange: largest I3 [J]", largest_[2]},
            {"I2_overtakes", "exchange: I2 is first above I1 at [s]", overtaken_ ? run::Value(*overtaken_) : run::Value()},
            {"I_end", "I at the end [J]", total()}};
    }

private:
    double total() const { return energy_[0] + energy_[1] + energy_[2]; }

    double omega_;
    std::array<double, 3> energy_{};
    std::array<double, 3> largest_{};
    double start_ = 0.0;
    double deviation_ = 0.0;
    std::optional<double> overtaken_;
};

/// One panel an integrator.
Picture picture(const std::vector<SchemeRun>& runs, double time) {
    const int n = static_cast<int>(runs.size());
    const double height = 100.0 + 210.0 * n;  // [pixels]
    std::string script = fmt::format(
        "set multiplot layout {},1 margins 0.07,0.98,{},{} spacing 0,{}\n"
        "set key top right horizontal samplen 1.5\nset yrange [0:1.4]\nset ytics 0.5\n"
        "set ylabel \"energy [J]\"\nset xrange [0:{}]\nset format x \"\"\n",
        n, 65.0 / height, 1.0 - 35.0 / height, 30.0 / height, time);
    for (const SchemeRun& run : runs) {
        const char* title = &run == &runs.front() ? "title" : "notitle";
        if (&run == &runs.back()) script += "set xlabel \"time [s]\"\nset format x \"%g\"\n";
        script += fmt::format("set title \"{}{}\" noenhanced offset 0,-0.7\n", run.name,
                              run.broken_off ? fmt::format(", breaks off at {:.3g} s", run.broken_off->time) : "");
        script += fmt::format(
            "plot \"{0}.csv\" using \"time\":\"I1\" with lines lw 1.2 lc rgb \"#2a78d6\" {1} \"I_1\", \\\n"
            "     \"\" using \"time\":\"I2\" with lines lw 1.2 lc rgb \"#eb6834\" {1} \"I_2\", \\\n"
            "     \"\" using \"time\":\"I3\" with lines lw 1.2 lc rgb \"#1f9e6e\" {1} \"I_3\", \\\n"
            "     \"\" using \"time\":\"I\" with lines lw 1.2 lc rgb \"#1b1b1a\" {1} \"I\"\n",
            run.name, title);
    }
    return {.name = program.name,
            .purpose = "Oscillatory energies, from the .csv files beside this file",
            .height = static_cast<int>(height),
            .script = script + "unset multiplot\n"};
}

run::NamedValues named_values(const FpuOptions& options) {
    run::NamedValues values = {{"omega", options.omega}, {"dt", options.dt}, {"time", options.time}};
    apps::append(values, named_values(options.schemes));
    values.push_back({"out", options.out.string()});
    return values;
}

void run_study(const FpuOptions& options) {
    studies::check(options.schemes);
    const run::FolderLock lock = prepare_results(program, options.out);
    const double omega = options.omega, root = std::sqrt(2.0);
    const Start start{.q = {(1.0 - 1.0 / omega) / root, (1.0 + 1.0 / omega) / root, 0.0, 0.0, 0.0, 0.0},
                      .p = {0.0, root, 0.0, 0.0, 0.0, 0.0},
                      .dt = options.dt,
                      .local_steps = local_steps_of_first(options.schemes, 6)};
    Schedule schedule{.steps = run::steps_until(options.time, options.dt),
                      .energy_scale = chain(omega).potential(start.q) + 1.0};
    schedule.interval = rows_interval(options.interval, schedule.steps);
    Comparison comparison{.title = fmt::format("{} steps of {:g} s, omega dt = {:g}, H0 = {:.9g} J", schedule.steps,
                                               options.dt, omega * options.dt, schedule.energy_scale),
                          .options = named_values(options)};
    for (const Scheme scheme : options.schemes.schemes) {
        Chain system = chain(omega);
        Oscillators oscillators(omega);
        comparison.runs.push_back(studies::follow(scheme, system, start, options.schemes, schedule, oscillators));
    }
    comparison.picture = picture(comparison.runs, options.time);
    studies::report(program, options.out, comparison);
}

const bool is_listed = list(entry_of(program, FpuOptions{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::fpu_study
