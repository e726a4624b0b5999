#include "studies/scenes/bars.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/option_table.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/solid/contact_view.hpp"
#include "apps/support/log.hpp"
#include "apps/support/run_options.hpp"
#include "studies/program/flags.hpp"
#include "studies/schemes/comparison.hpp"

namespace abut::studies {
namespace {

const apps::Choices<BarBody> bodies = {
    {"chain", BarBody::chain}, {"strip2d", BarBody::strip2d}, {"strip3d", BarBody::strip3d}};

std::string with_body(const BarOptions& options, int cells) {
    return fmt::format("{}, {} cells", options.body_name(), cells);
}

/// Steps of at most cfl h/c that end exactly at the time.
int steps_of(double time, double h, const Bar& bar, double cfl) {
    return static_cast<int>(std::ceil(time * bar.wave_speed() / (cfl * h) * (1.0 - 1e-12)));
}

/// Nodes nearest to the times.
std::vector<std::int64_t> nodes_at(const std::vector<double>& times, double dt) {
    std::vector<std::int64_t> nodes;
    for (const double time : times) nodes.push_back(std::llround(time / dt));
    return nodes;
}

/// Keeps what a run of the chain shows.
class ChainKeeper : public Watcher {
public:
    ChainKeeper(const BarOnWall& scene, int cells, std::vector<std::int64_t> nodes, BarRun& run)
        : scene_(scene), cells_(cells), nodes_(std::move(nodes)), run_(run) {}

    void look(const Node& node) override {
        double momentum = 0.0;
        for (std::size_t i = 0; i < node.q.size(); ++i) momentum += node.momentum(i);
        ContactHistory& history = run_.history;
        const double gap = node.q[0] + scene_.gap;
        if (!history.time.empty()) history.pressure.push_back(-foot().mean_tension(last_gap_, Vector<1>(gap))[0]);
        if (std::ranges::count(nodes_, static_cast<std::int64_t>(history.time.size())) > 0) keep_profile(node);
        history.time.push_back(node.time);
        history.gap.push_back(gap);
        history.speed.push_back({momentum / scene_.bar.mass(), 0.0});
        last_gap_[0] = gap;
    }

private:
    [[nodiscard]] dynamics::LineSpring foot() const {
        return {.stiffness = 2.0 * scene_.bar.young * cells_ / scene_.bar.length, .one_sided = true};
    }
    void keep_profile(const Node& node) {
        const double h = scene_.bar.length / cells_, share = 1.0 / cells_;
        run_.profiles.push_back({node.time, {}});
        for (int i = 0; i < cells_; ++i)
            run_.profiles.back().cells.push_back({scene_.gap + (i + 0.5) * h, node.q[static_cast<std::size_t>(i)], share});
    }

    const BarOnWall& scene_;
    int cells_;
    std::vector<std::int64_t> nodes_;
    BarRun& run_;
    Vector<1> last_gap_ = Vector<1>::Zero();
};

/// Keeps what a run of strips shows.
template <int Dim>
class StripKeeper : public run::Observer<Dim> {
public:
    StripKeeper(double area, std::vector<std::int64_t> nodes, BarRun& run)
        : area_(area), nodes_(std::move(nodes)), run_(run) {}

    void look(const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) override {
        ContactHistory& history = run_.history;
        std::array<double, 2> speed{}, momentum{};
        const auto motions = solid::body_motions<Dim>(view, solid);
        for (std::size_t body = 0; body < motions.size(); ++body) {
            speed[body] = motions[body].velocity[bar_axis<Dim>];
            momentum[body] = speed[body] * motions[body].mass;
        }
        if (view.steps > 0) history.pressure.push_back(force(solid, momentum, view.time - history.time.back()) / area_);
        if (std::ranges::count(nodes_, view.steps) > 0) keep_profile(view, solid);
        momentum_ = momentum;
        history.time.push_back(view.time);
        history.gap.push_back(std::ranges::min(solid.contact_at(view.q).field().gap));
        history.speed.push_back(speed);
    }

private:
    /// Force of the wall, or of the lower bar on the upper one: with nothing else acting on it, the change of its momentum.
    double force(const solid::Solid<Dim>& solid, const std::array<double, 2>& momentum, double dt) const {
        if (!solid.options().obstacles.empty()) return -solid.contact().obstacle_force(0)[bar_axis<Dim>];
        return (momentum[1] - momentum_[1]) / dt;
    }
    void keep_profile(const dynamics::RunView<Dim>& view, const solid::Solid<Dim>& solid) {
        const mesh::Mesh<Dim>& mesh = solid.mesh();
        const auto u = as_vectors<Dim>(view.q);
        double volume = 0.0;
        for (const double measure : mesh.cell_measure) volume += measure;
        run_.profiles.push_back({view.time, {}});
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            run_.profiles.back().cells.push_back(
                {mesh.cell_centroid[c][bar_axis<Dim>], u[c][bar_axis<Dim>], mesh.cell_measure[c] / volume});
    }

    double area_;
    std::vector<std::int64_t> nodes_;
    BarRun& run_;
    std::array<double, 2> momentum_{};
};

/// Times at which a gap changes its sign.
std::int64_t count_roots(const ContactHistory& history) {
    std::int64_t roots = 0;
    for (std::size_t n = 0; n + 1 < history.gap.size(); ++n) roots += (history.gap[n] < 0.0) != (history.gap[n + 1] < 0.0);
    return roots;
}

BarRun run_chain(const BarOnWall& scene, int cells, double dt, int steps, const std::vector<double>& profile_times) {
    const auto n = static_cast<std::size_t>(cells);
    const double h = scene.bar.length / cells;
    Start start{
        .q = std::vector<double>(n, 0.0), .p = std::vector<double>(n, -scene.bar.density * h * scene.speed), .dt = dt};
    if (scene.displacement)
        for (int i = 0; i < cells; ++i) start.q[static_cast<std::size_t>(i)] = scene.displacement(scene.gap + (i + 0.5) * h);
    BarRun run;
    ChainKeeper keeper(scene, cells, nodes_at(profile_times, dt), run);
    BarChain chain = bar_chain(scene, cells);
    const Schedule schedule{.steps = steps, .interval = 1, .energy_scale = scene.energy};
    const SchemeRun result = studies::follow(Scheme::memm, chain, start, SchemeOptions{}, schedule, keeper);
    if (result.broken_off)
        throw std::runtime_error(fmt::format("chain of {} masses, step {}, t = {:.4g} s: {}", cells, result.broken_off->step,
                                             result.broken_off->time, result.broken_off->why));
    run.energy_start = result.series.rows.front()[1];
    run.energy_end = result.series.rows.back()[1];
    run.energies = {.scale = {"H0", scene.energy},
                    .drift = result.drift / scene.energy,
                    .excess = result.excess / scene.energy,
                    .parasitic = result.parasitic,
                    .events = count_roots(run.history)};
    return run;
}

template <int Dim>
BarRun run_strips(const run::Scene<Dim>& scene, const BarOptions& options, double area, double dt, int steps,
                  const std::vector<double>& profile_times = {}) {
    run::RunOptions run_options = options.run;
    run_options.dt = dt;
    run_options.steps = steps;
    run_options.interval = 1;
    BarRun run;
    StripKeeper<Dim> keeper(area, nodes_at(profile_times, dt), run);
    const run::RunResult<Dim> result = [&] {
        try {
            return run::simulate<Dim>(scene, run_options, keeper);
        } catch (const std::exception& error) {
            throw std::runtime_error(fmt::format("{}: {} Here the time step is --cfl h/c, --cfl is {:g}.",
                                                 with_body(options, scene.mesh.n_cells()), error.what(), options.cfl));
        }
    }();
    apps::log_warnings(apps::only(run::warnings_after(result), {run::WarningKind::stiff_sliding, run::WarningKind::deep_slip,
                                                                run::WarningKind::missed_contacts}),
                       with_body(options, scene.mesh.n_cells()));
    run.energies = figures_of(result);
    run.energies.scale.value /= area;
    run.energy_start = result.ledger.entries().front().energy / area;
    run.energy_end = result.ledger.entries().back().energy / area;
    return run;
}

void append_history(apps::Table& table, const ContactHistory& history, int cells) {
    for (std::size_t n = 0; n < history.pressure.size(); ++n)
        table.rows.push_back({static_cast<double>(cells), history.time[n + 1], history.gap[n + 1], history.speed[n + 1][0],
                              history.speed[n + 1][1], 0.5 * (history.time[n] + history.time[n + 1]), history.pressure[n]});
}

}  // namespace

std::string BarOptions::body_name() const { return apps::name_of(bodies, body); }

void BarOptions::check() const {
    if (body != BarBody::chain) return;
    for (const apps::Flag& option : of_solver)
        if (option.is_given())
            throw BadInput(fmt::format("{}: a chain does not know it. Take --body strip2d or strip3d, or leave it out.",
                                       option.name()));
}

BarOptions default_bar_options(const apps::Program& program, std::vector<int> cells, double length) {
    BarOptions options{.cells = std::move(cells), .run = {.out = "out/" + program.name}, .of_solver = {}};
    options.run.contact.compression_limit = 10.0;
    options.run.contact.search.skin = 0.1 * length;  // few faces face a wall: a thick skin costs nothing and lasts long
    return options;
}

void add_bar_options(Flags& flags, BarOptions& options, const std::vector<BarBody>& offered) {
    apps::Choices<BarBody> choices;
    for (const BarBody body : offered) choices.emplace_back(apps::name_of(bodies, body), body);
    flags.group("Bar");
    flags.choice("--body", options.body, "masses and springs, or the full solver: strips two cells wide on rollers",
                 choices);
    flags.counts("--cells", options.cells, "cells along the bar, a run for each number", 8);
    flags.group("Time");
    flags.number("--cfl", options.cfl, "Courant number c dt/h; strips are stable below about 0.6 in 2D and 0.5 in 3D",
                 {.above = 0.0, .below = 1.0, .closed = true, .remedy = "Above 1 the scheme is unstable."});
    options.of_solver = {flags.choice("--filter", options.run.filter,
                                      "energy-neutral filter of the parasitic mode, after each step in contact",
                                      apps::Choices<bool>{{"none", false}, {"neutral", true}})};
    apps::add_contact_options(flags, options.run);
    for (const apps::Flag& option : flags.of_group("Contact")) options.of_solver.push_back(option);
    flags.out(options.run.out);
}

run::NamedValues named_values(const BarOptions& options) {
    run::NamedValues values = {{"body", options.body_name()}, {"cells", counts(options.cells)}};
    if (options.body != BarBody::chain) {
        apps::append(values, run::named_values(options.run));
        std::erase_if(values, [](const run::NamedValue& one) { return one.name == "interval" || one.name == "frames"; });
    }
    apps::append(values, {{"cfl", options.cfl}, {"out", options.run.out.string()}});
    return values;
}

BarRun run_bar(const BarOnWall& scene, const BarOptions& options, int cells, const std::vector<double>& profile_times) {
    const int steps = steps_of(scene.time, scene.bar.length / cells, scene.bar, options.cfl);
    const double dt = scene.time / steps, width = strip_width(scene.bar, cells);
    const auto run_strip = [&]<int Dim>() {
        return run_strips<Dim>(bar_strip<Dim>(scene, cells), options, cross_section<Dim>(width), dt, steps, profile_times);
    };
    double seconds = 0.0;
    BarRun run = timed(seconds, [&] {
        if (options.body == BarBody::chain) return run_chain(scene, cells, dt, steps, profile_times);
        return options.body == BarBody::strip2d ? run_strip.template operator()<2>() : run_strip.template operator()<3>();
    });
    run.seconds = seconds;
    return run;
}

BarRun run_two_bars(const TwoBars& scene, const BarOptions& options, std::array<int, 2> cells) {
    const int steps = steps_of(scene.time, scene.bar.length / std::ranges::max(cells), scene.bar, options.cfl);
    const double dt = scene.time / steps, width = two_strips_width(scene.bar, cells);
    const auto run_both = [&]<int Dim>() {
        return run_strips<Dim>(two_bar_strips<Dim>(scene, cells), options, cross_section<Dim>(width), dt, steps);
    };
    double seconds = 0.0;
    BarRun run = timed(seconds, [&] {
        return options.body == BarBody::strip2d ? run_both.template operator()<2>() : run_both.template operator()<3>();
    });
    run.seconds = seconds;
    return run;
}

std::string history_lines(const std::vector<int>& cells, const std::string& time, const std::string& value) {
    constexpr std::array colours = {"#eb6834", "#c2a100", "#1f9e6e", "#2a78d6", "#8a4fc7"};
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < cells.size(); ++i)
        lines.push_back(
            fmt::format("\"history.csv\" using (column(\"cells\")=={0}?column(\"{1}\"):NaN):({2}) "
                        "with lines lw 1.2 lc rgb \"{3}\" title \"{0} cells\"",
                        cells[i], time, value, colours[i % colours.size()]));
    return fmt::format("{}", fmt::join(lines, ", \\\n     "));
}

void run_study(const apps::Program& program, const BarOptions& options, const BarStudy& bars) {
    options.check();
    std::vector<std::string> curves{"history", "exact"};
    curves.insert(curves.end(), bars.more_curves.begin(), bars.more_curves.end());
    const auto lock = prepare_study(program, options.run.out, curves, {bars.picture.name});
    Study study{.title = bars.title, .reference = bars.reference};
    apps::Table history{.columns = {"cells", "time", "gap", "speed_1", "speed_2", "middle", "pressure"}, .rows = {}};
    for (std::size_t i = 0; i < options.cells.size(); ++i) {
        const BarRun run = bars.run(i);
        study.levels.push_back(bars.level(run, i));
        append_history(history, run.history, options.cells[i]);
    }
    study.curves = {{"history", std::move(history)}, {"exact", bars.exact}};
    study.pictures = {bars.picture};
    study.options = named_values(options);
    if (bars.complete) bars.complete(study);
    report(program, options.run.out, study);
}

}  // namespace abut::studies
