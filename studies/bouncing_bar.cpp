// An elastic bar in one dimension bounces on a rigid wall: impact, contact and release under all integrators.
//
// Length 10, E = 900, rho = 1, so c = 30: masses rho h at the centres of cells, springs E/h between them, and a spring
// 2E/h, half a cell, between the lowest mass and the wall where it is pressed. From rest 5 above the wall under gravity 10
// it hits at t = 1 with speed 10; contact lasts 2L/c = 2/3, the pressure rises from 300 to 500, impulse 266.667, and the
// motion has the period 16/3: two impacts. Without gravity (--gravity 0, at 10 towards the wall 5 away) contact lasts from
// 0.5 to 1.16667 at the pressure 300, and the bar rebounds at 10. --steps 1000000 tests stability: docs/filter.md.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <type_traits>

#include "abut/base/error.hpp"
#include "abut/dynamics/remedies.hpp"
#include "abut/run/options.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/bar_host.hpp"
#include "studies/scenes/bars.hpp"
#include "studies/schemes/comparison.hpp"

namespace abut::studies::bouncing_bar_study {
namespace {

const Bar the_bar;
constexpr double height = ExactBounce::height, impact_speed = ExactBounce::speed, period = ExactBounce::period;  // SI
const double contact_time = the_bar.contact_time();                                                              // [s]
const double impact_energy = 0.5 * the_bar.mass() * impact_speed * impact_speed;

const apps::Program program{
    .name = "bouncing_bar",
    .purpose = "Chain of masses that bounces on a rigid wall, under all integrators.",
    .footer = "The bar: L = 10 m, E = 900 Pa, rho = 1 kg/m^3; it hits the wall, 5 m away, at 10 m/s."};

struct BounceOptions {
    SchemeOptions schemes{.gauge = 2.0 * impact_energy, .fast = 4, .parts = 4};  // V sinks by H0 as the bar falls
    int cells = 100;
    double gravity = 10.0;  // [m/s^2]
    double cfl = 0.5;       // c dt/h [-]
    int steps = 0;
    bool filter = false;
    int patch = 2;    // masses
    int restart = 0;  // steps; 0: none
    std::filesystem::path out = "out/" + program.name;
    int interval = 0;
};

void add_options(Flags& flags, BounceOptions& options) {
    flags.group("Bar");
    flags.count("--cells", options.cells, "cells of the bar, a mass each", 4);
    flags.choice("--gravity", options.gravity, "towards the wall, in m/s^2: what closed forms are known for",
                 apps::Choices<double>{{"0", 0.0}, {"10", 10.0}});
    flags.group("Time");
    flags.number("--cfl", options.cfl, "Courant number c dt/h",
                 {.above = 0.0, .below = 1.0, .closed = true, .remedy = "Above 1 the explicit schemes are unstable."});
    flags.count("--steps", options.steps, "steps of the run; 0: three periods (16 s) with gravity, 2 s without", 0);
    add_integrator(flags, options.schemes);
    add_gauge(flags, options.schemes);
    add_local_steps(flags, options.schemes);
    flags.group("Schemes");
    const apps::Flag filter = flags.choice(
        "--filter", options.filter, "of memm: energy-neutral filter of the parasitic mode, after each step in contact",
        apps::Choices<bool>{{"none", false}, {"neutral", true}});
    apps::Flag patch = flags.count("--patch", options.patch, "of the filter: masses, from the wall on, that it changes", 2);
    patch.needs(filter);
    const apps::Flag restart =
        flags.count("--restart", options.restart,
                    "of memm: steps between neutral restarts, which clear that mode everywhere; 0: none", 0);
    for (const apps::Flag& option : {filter, patch, restart}) restrict_to(option, options.schemes, {Scheme::memm});
    flags.out(options.out);
    add_interval_option(flags, options.interval);
}

/// Watches what happens at the wall.
class Impacts : public Watcher {
public:
    explicit Impacts(double gravity) : exact_(gravity), weight_(the_bar.mass() * gravity) {}

    void look(const Node& node) override {
        double momentum = 0.0;
        for (std::size_t i = 0; i < node.q.size(); ++i) momentum += node.momentum(i);
        const bool pressed = node.q[0] + height < 0.0;  // the lowest mass on the wall
        if (node.time > time_) step(node.time - time_, momentum, pressed);
        time_ = node.time;
        momentum_ = momentum;
        pressed_ = pressed;
        foot_ = node.q[0] + height;
        gone_wrong_ = std::max(gone_wrong_, time_ <= period ? std::abs(foot_ - exact_.height_at(time_)) : 0.0);
    }
    std::vector<std::string> columns() const override { return {"foot", "foot_exact", "pressure"}; }
    std::vector<double> row() const override { return {foot_, exact_.height_at(time_), pressure_}; }
    std::vector<run::Finding> findings() const override {
        const auto known = [](bool is, double value) { return is ? run::Value(value) : run::Value(); };
        const bool one = complete_ > 0, two = complete_ > 1;
        const double lasted = first_.end - first_.begin;
        return {{"contact_first", "first impact: contact from [s]", known(one, first_.begin)},
                {"release_first", "first impact: released at [s]", known(one, first_.end)},
                {"contact_time_first", "first impact: in contact for [s]", known(one, lasted)},
                {"pressure_mean", "middle 80 %: mean pressure [Pa]", known(one, middle_.pressure / middle_.time)},
                {"pressure_rms", "middle 80 %: rms of pressure - exact [Pa]",
                 known(one, std::sqrt(middle_.square / middle_.time))},
                {"impulse_first", "first impact: impulse [N s]", known(one, first_.impulse)},
                {"rebound_speed", "first impact: rebound at [m/s]", known(one, first_.speed)},
                {"impulse_second", "second impact: impulse [N s]", known(two, second_impulse_)},
                {"impacts", "impacts that are over", complete_},
                {"foot_error_max", "end against exact bounce, first 16/3 s [m]", gone_wrong_},
                {"events", "contact begins or ends, times", events_}};
    }

private:
    struct Impact {
        double begin = 0.0, end = 0.0;  // [s]
        double impulse = 0.0;
        double speed = 0.0;  // of the centre of mass when it ends
    };

    /// The pressure is what gravity leaves unexplained of the change of momentum, whatever scheme made it.
    void step(double dt, double momentum, bool pressed) {
        pressure_ = pressed || pressed_ ? (momentum - momentum_) / dt + weight_ : 0.0;
        events_ += pressed != pressed_ ? 1 : 0;
        compare_pressure(dt);
        if (pressed || pressed_) {
            if (!open_) present_ = {.begin = time_};
            open_ = true;
            present_.end = time_ + dt;
            present_.impulse += pressure_ * dt;
            present_.speed = momentum / the_bar.mass();
        } else if (open_ && time_ + dt - present_.end > 0.5 * contact_time) {
            close();
        }
    }
    /// In the middle 80 % of the exact first contact, away from the jumps at both ends.
    void compare_pressure(double dt) {
        const double since = time_ + dt - exact_.hit();
        if (since <= 0.1 * contact_time || since > 0.9 * contact_time) return;
        const double error = pressure_ - exact_.pressure(since - 0.5 * dt);
        middle_.time += dt;
        middle_.pressure += pressure_ * dt;
        middle_.square += error * error * dt;
    }
    /// Contacts belong together that are apart by less than a wave takes through the bar.
    void close() {
        open_ = false;
        ++complete_;
        if (complete_ == 1) first_ = present_;
        if (complete_ == 2) second_impulse_ = present_.impulse;
    }

    struct Integrals {
        double time = 0.0, pressure = 0.0, square = 0.0;
    };

    ExactBounce exact_;
    Integrals middle_;
    double weight_;  // of the whole bar [N]
    double time_ = 0.0;
    double momentum_ = 0.0;
    bool pressed_ = false;
    double foot_ = height;
    double pressure_ = 0.0;
    double gone_wrong_ = 0.0;
    bool open_ = false;  // an impact is going on
    Impact present_;
    Impact first_;
    double second_impulse_ = 0.0;
    std::int64_t complete_ = 0;
    std::int64_t events_ = 0;
};

/// The end of the bar, energies and drifts over time.
Picture picture(const std::vector<SchemeRun>& runs, double end) {
    constexpr std::array colours = {"#2a78d6", "#eb6834", "#1f9e6e", "#8a4fc7", "#c2a100"};
    const auto lines = [&](const std::string& what, const std::string& style) {
        std::string plots;
        for (std::size_t i = 0; i < runs.size(); ++i)
            plots += fmt::format("{}\"{}.csv\" using \"time\":({}) with {} lc rgb \"{}\" title \"{}\"",
                                 i == 0 ? "" : ", \\\n     ", runs[i].name, what, style, colours[i], runs[i].name);
        return plots;
    };
    const std::string script = fmt::format(
        "H0 = {:.17g}\n"
        "shown(x) = x < 1e-17 ? 1e-17 : x  # an exact zero has no logarithm\n"
        "set multiplot\nset autoscale xfix\nset key outside top center horizontal maxcols 6 font \",10\" samplen 1.2 "
        "noenhanced\n"
        "set origin 0,0.73\nset size 1,0.27\nset ylabel \"lower end [m]\"\nset xrange [0:{}]\nset yrange [-0.3:*]\n"
        "plot \"{}.csv\" using \"time\":\"foot_exact\" with lines lw 5 lc rgb \"#b9b8b4\" title \"exact\", \\\n     {}\n"
        "set origin 0,0.49\nset size 1,0.24\nunset key\nset xrange [0:{}]\nset yrange [*:*]\nset ylabel \"H / H0\"\nplot "
        "{}\n"
        "set origin 0,0.26\nset logscale y\nset format y \"10^{{%L}}\"\nset ylabel \"(H − H̃) / H0\"\n"
        "set yrange [1e-8:1e4]\nset ytics 1e-8,1e3,1e4\nunset mytics\nplot {}\n"
        "set origin 0,0\nset size 1,0.26\nset ylabel \"drift of its own energy / H0\"\nset xlabel \"time [s]\"\n"
        "set yrange [1e-17:10]\nset ytics 1e-16,1e4,1\nplot {}\n"
        "unset multiplot\n",
        impact_energy, std::min(end, 3.0 * period), runs.front().name, lines("column(\"foot\")", "lines lw 1.5"), end,
        lines("column(\"energy\")/H0", "lines lw 1.5"), lines("shown(column(\"excess\")/H0)", "lines lw 1.5"),
        lines("shown(abs(column(\"drift\"))/H0)", "points pt 7 ps 0.3"));
    return {
        .name = program.name, .purpose = "The bar, from the .csv files beside this file", .height = 1500, .script = script};
}

run::NamedValues named_values(const BounceOptions& options, std::int64_t steps) {
    run::NamedValues values = {
        {"cells", options.cells}, {"gravity", options.gravity}, {"cfl", options.cfl}, {"steps", steps}};
    apps::append(values, named_values(options.schemes));
    values.push_back({"filter", options.filter ? "neutral" : "none"});
    if (options.filter) values.push_back({"patch", options.patch});
    apps::append(values, {{"restart", options.restart}, {"out", options.out.string()}});
    return values;
}

void check(const BounceOptions& options) {
    studies::check(options.schemes);
    if (options.patch > options.cells)
        throw BadInput(
            fmt::format("--patch: {} masses, the bar has {}. Give at most that many.", options.patch, options.cells));
}

SchemeRun run_scheme(Scheme scheme, const BounceOptions& options, const Start& start, const Schedule& schedule) {
    BarHost bar({.gap = height, .gravity = options.gravity}, options.cells, options.patch);
    dynamics::Remedies remedies(bar, options.filter, options.restart);
    Impacts impacts(options.gravity);
    SchemeRun run = studies::follow(scheme, bar, start, options.schemes, schedule, impacts, [&](auto& integrator) {
        using Integrator = std::remove_reference_t<decltype(integrator)>;
        if constexpr (Integrator::takes_node_restart) remedies.prepare(integrator);
    });
    const auto& [restarts, shortened, skipped, paid] = remedies.report();
    if (restarts > 0)
        run.findings.insert(run.findings.end(), {{"restarts", "neutral restarts", restarts},
                                                 {"restarts_shortened", "of these shortened", shortened},
                                                 {"restarts_skipped", "of these skipped", skipped},
                                                 {"restart_paid", "restarts: paid by the vibration [J]", paid}});
    return run;
}

void run_study(const BounceOptions& options) {
    check(options);
    const run::FolderLock lock = prepare_results(program, options.out);
    const auto n = static_cast<std::size_t>(options.cells);
    const double h = the_bar.length / options.cells, dt = options.cfl * h / the_bar.wave_speed();
    const double speed = options.gravity > 0.0 ? 0.0 : -impact_speed;
    const Start start{.q = std::vector<double>(n, 0.0),
                      .p = std::vector<double>(n, the_bar.density * h * speed),
                      .dt = dt,
                      .local_steps = local_steps_of_first(options.schemes, n)};
    Schedule schedule{.steps = options.steps, .energy_scale = impact_energy};
    if (options.steps == 0) schedule.steps = run::steps_until(options.gravity > 0.0 ? 3.0 * period : 2.0, dt);
    schedule.interval = rows_interval(options.interval, schedule.steps);
    Comparison comparison{
        .title = fmt::format("{} masses, {} steps of {:.6g} s (c dt/h = {:g}), gravity {:g} m/s^2, H0 = {:g} J", n,
                             schedule.steps, dt, options.cfl, options.gravity, impact_energy),
        .options = named_values(options, schedule.steps)};
    for (const Scheme scheme : options.schemes.schemes)
        comparison.runs.push_back(run_scheme(scheme, options, start, schedule));
    comparison.picture = picture(comparison.runs, static_cast<double>(schedule.steps) * dt);
    studies::report(program, options.out, comparison);
}

const bool is_listed = list(entry_of(program, BounceOptions{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::bouncing_bar_study
