#include "studies/scenes/bars.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/simulation.hpp"
#include "apps/support/choices.hpp"
#include "apps/support/comparison.hpp"
#include "apps/support/log.hpp"

namespace abut::studies {
namespace {

using Json = nlohmann::ordered_json;

const apps::Choices<BarBody> bodies = {
    {"chain", BarBody::chain}, {"strip2d", BarBody::strip2d}, {"strip3d", BarBody::strip3d}};

template <int Dim>
constexpr int axis = Dim - 1;
template <int Dim>
constexpr mesh::CellShape brick = Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron;

/// A box of square cross-section along the axis, its middle at the origin of the others.
template <int Dim>
mesh::Mesh<Dim> strip(double bottom, double top, double width, int across, int along, const std::string& name) {
    Vector<Dim> lower = Vector<Dim>::Constant(-0.5 * width), upper = -lower;
    lower[axis<Dim>] = bottom;
    upper[axis<Dim>] = top;
    std::array<int, Dim> counts;
    counts.fill(across);
    counts[axis<Dim>] = along;
    return mesh::structured_box<Dim>(lower, upper, counts, brick<Dim>, name);
}

/// Names of the sides of a box, all but its ends.
template <int Dim>
std::vector<std::string> side_names() {
    if constexpr (Dim == 2)
        return {"xmin", "xmax"};
    else
        return {"xmin", "xmax", "ymin", "ymax"};
}

template <int Dim>
void add_rollers(solid::SolidOptions<Dim>& solid, const std::string& prefix = "") {
    for (const std::string& side : side_names<Dim>())
        solid.boundary.dirichlet.push_back({.group = prefix + side, .constraint = solid::Constraint::normal});
}

template <int Dim>
double cross_section(double width) {
    return Dim == 2 ? width : width * width;
}

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

/// Time after the node at which a gap that is linear in between vanishes. A gap that was not known begins at the node.
double root_after(const ContactHistory& history, std::size_t node) {
    const double from = history.gap[node], to = history.gap[node + 1];
    const double dt = history.time[node + 1] - history.time[node];
    return std::isfinite(from) && std::isfinite(to) ? history.time[node] + dt * from / (from - to) : history.time[node];
}

/// Keeps what a run of the chain shows.
class ChainKeeper : public apps::Watcher {
public:
    ChainKeeper(const BarOnWall& scene, int cells, std::vector<std::int64_t> nodes, BarRun& run)
        : scene_(scene), cells_(cells), nodes_(std::move(nodes)), run_(run) {}

    void look(const apps::Node& node) override {
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
    void keep_profile(const apps::Node& node) {
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
            speed[body] = motions[body].velocity[axis<Dim>];
            momentum[body] = speed[body] * motions[body].mass;
        }
        if (view.steps > 0) history.pressure.push_back(force(solid, momentum, view.time - history.time.back()) / area_);
        if (std::ranges::count(nodes_, view.steps) > 0) keep_profile(view, solid);
        momentum_ = momentum;
        history.time.push_back(view.time);
        history.gap.push_back(std::ranges::min(solid.contact_field(view.q).gap));
        history.speed.push_back(speed);
    }

private:
    /// Of the wall, or of the lower bar on the upper one: with nothing else acting on it, the change of its momentum.
    double force(const solid::Solid<Dim>& solid, const std::array<double, 2>& momentum, double dt) const {
        if (!solid.options().obstacles.empty()) return -solid.obstacle_force(0)[axis<Dim>];
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
                {mesh.cell_centroid[c][axis<Dim>], u[c][axis<Dim>], mesh.cell_measure[c] / volume});
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
    apps::Start start{
        .q = std::vector<double>(n, 0.0), .p = std::vector<double>(n, -scene.bar.density * h * scene.speed), .dt = dt};
    if (scene.displacement)
        for (int i = 0; i < cells; ++i) start.q[static_cast<std::size_t>(i)] = scene.displacement(scene.gap + (i + 0.5) * h);
    BarRun run;
    ChainKeeper keeper(scene, cells, nodes_at(profile_times, dt), run);
    BarChain chain = bar_chain(scene, cells);
    const apps::Schedule schedule{.steps = steps, .interval = 1, .energy_scale = scene.energy};
    const apps::SchemeRun result = apps::follow(apps::Scheme::memm, chain, start, apps::SchemeOptions{}, schedule, keeper);
    if (result.broken_off)
        throw std::runtime_error(fmt::format("chain of {} masses, step {}, t = {:.4g} s: {}", cells, result.broken_off->step,
                                             result.broken_off->time, result.broken_off->why));
    run.energy_start = result.series.rows.front()[1];
    run.energy_end = result.series.rows.back()[1];
    run.energies = {.drift = result.drift / scene.energy,
                    .excess = result.excess / scene.energy,
                    .parasitic = result.parasitic,
                    .events = count_roots(run.history),
                    .scale = scene.energy,
                    .scale_name = "H0"};
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
    run.energies = energy_figures(result);
    run.energies.scale /= area;
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

BarChain bar_chain(const BarOnWall& scene, int cells) {
    using Bond = dynamics::Bond<dynamics::LineSpring>;
    const double h = scene.bar.length / cells, stiffness = scene.bar.young / h, mass = scene.bar.density * h;
    std::vector<Bond> bonds = {{Bond::fixed, 0, {.stiffness = 2.0 * stiffness, .one_sided = true}, Vector<1>(scene.gap)}};
    for (std::int32_t i = 0; i + 1 < cells; ++i) bonds.push_back({i, i + 1, {.stiffness = stiffness}});
    if (scene.held) bonds.push_back({cells - 1, Bond::fixed, {.stiffness = 2.0 * stiffness}});
    const auto n = static_cast<std::size_t>(cells);
    return {std::vector<double>(n, 1.0 / mass), bonds, std::vector<double>(n, -mass * scene.gravity)};
}

double strip_width(const Bar& bar, int cells) { return 2.0 * bar.length / cells; }

template <int Dim>
run::Scene<Dim> bar_strip(const BarOnWall& scene, int cells) {
    const Bar& bar = scene.bar;
    const Vector<Dim> up = Vector<Dim>::Unit(axis<Dim>);
    const double width = strip_width(bar, cells), eta = scene.eta == 0.0 ? bar.young : scene.eta;
    run::Scene<Dim> result;
    result.mesh = strip<Dim>(scene.gap, scene.gap + bar.length, width, 2, cells, "bar");
    result.solid.materials = {{.young = bar.young, .poisson = 0.0, .density = bar.density, .eta = eta}};
    if (scene.gravity != 0.0) result.solid.acceleration = {Vector<Dim>(-scene.gravity * up)};
    add_rollers(result.solid);
    if (scene.held) result.solid.boundary.dirichlet.push_back({.group = Dim == 2 ? "ymax" : "zmax"});
    result.solid.obstacles = {contact::plane_obstacle<Dim>(Vector<Dim>::Zero(), up, bar.length)};
    result.velocity = {Vector<Dim>(-scene.speed * up)};
    if (scene.displacement)
        result.displacement = [u = scene.displacement, up](const Vector<Dim>& x) { return Vector<Dim>(u(x.dot(up)) * up); };
    result.time = scene.time;
    result.energy_scale = {"H0", scene.energy * cross_section<Dim>(width)};
    result.remedy_if_overlapping = "The bar is one body.";
    result.options = {{"cells", cells}, {"eta", eta}};
    return result;
}

double two_strips_width(const Bar& bar, std::array<int, 2> cells) { return strip_width(bar, std::ranges::min(cells)); }

template <int Dim>
run::Scene<Dim> two_bar_strips(const TwoBars& scene, std::array<int, 2> cells) {
    const Bar& bar = scene.bar;
    const double width = two_strips_width(bar, cells), near = 0.5 * scene.gap;
    const auto across = [&](int along) { return static_cast<int>(std::lround(width * along / bar.length)); };
    run::Scene<Dim> result;
    const std::vector<mesh::Mesh<Dim>> strips = {
        strip<Dim>(-near - bar.length, -near, width, across(cells[0]), cells[0], "lower"),
        strip<Dim>(near, near + bar.length, width, across(cells[1]), cells[1], "upper")};
    result.mesh = mesh::combine<Dim>(strips);
    result.mesh.name = "bars";
    const Vector<Dim> up = Vector<Dim>::Unit(axis<Dim>);
    for (std::size_t body = 0; body < 2; ++body) {
        result.solid.materials.push_back({.young = bar.young, .poisson = 0.0, .density = bar.density, .eta = bar.young});
        result.velocity.push_back((body == 0 ? 1.0 : -1.0) * scene.speed[body] * up);
        add_rollers(result.solid, result.mesh.body_names[body] + ".");
    }
    result.time = scene.time;
    result.remedy_if_overlapping = fmt::format("Raise the gap, it is {} m.", scene.gap);
    result.options = {{"cells", cells}, {"speed", scene.speed}};
    return result;
}

double ExactBounce::hit(int impact) const {
    return gravity_ == 0.0 ? height / speed : speed / gravity_ + 0.5 * impact * period;
}

double ExactBounce::pressure_at(double time) const {
    double t = time;
    if (gravity_ != 0.0) {
        t = std::fmod(time, period);
        t = std::min(t, period - t);
    }
    return t <= hit() || t >= hit() + bar_.contact_time() ? 0.0 : pressure(t - hit());
}

double ExactBounce::height_at(double time) const {
    const double release = hit() + bar_.contact_time();
    if (gravity_ == 0.0) return std::max({0.0, height - speed * time, speed * (time - release)});
    // There and back about the middle of the period, when the bar is as high as it gets between two impacts.
    double t = std::fmod(time, period);
    t = std::min(t, period - t);
    if (t <= hit()) return height - 0.5 * gravity_ * t * t;
    return t <= release ? 0.0 : flight(t - release);
}

double ExactBounce::velocity_at(double time) const {
    double t = time, sign = 1.0;
    if (gravity_ != 0.0) {
        t = std::fmod(time, period);
        if (t > 0.5 * period) t = period - t, sign = -1.0;
    }
    const double since = std::clamp(t - hit(), 0.0, bar_.contact_time());
    const double from_wall = bar_.impedance() * since * (speed + 0.5 * gravity_ * since) / bar_.mass();
    return sign * ((gravity_ == 0.0 ? -speed : 0.0) - gravity_ * t + from_wall);
}

double ExactBounce::impulse() const { return 2.0 * bar_.mass() * (speed + gravity_ * bar_.length / bar_.wave_speed()); }

/// Between the impacts the bar vibrates: under its own weight it was pressed by 2 rho g (L - x) when it was released.
double ExactBounce::flight(double since) const {
    const double c = bar_.wave_speed(), length = bar_.length;
    const double way = std::fmod(c * since, 2.0 * length), x = std::min(way, 2.0 * length - way);
    const double vibration = -2.0 * gravity_ / (c * c) * (length * x - 0.5 * x * x);
    return speed * since - 0.5 * gravity_ * since * since + vibration;
}

DispersedImpact dispersed_impact(const Bar& bar, BarBody body, int cells, double courant) {
    // With F(y) = integral of Ai over (-y, infinity), F(0) = 1/3: F = 1/2 at y = 0.409603 =: r, and what is missing of the
    // impulse is the integral of 2 F over (-infinity, 0) less that of 1 - 2 F over (0, r): -2 Ai'(0) - 0.071116 = 0.446523.
    constexpr double late = 0.409603, missing = 0.446523;
    const double h = bar.length / cells, beta = ((body == BarBody::chain ? 1.0 : 4.0) - courant * courant) / 24.0;
    const double spread = std::cbrt(6.0 * beta * h * h * bar.length);
    return {.delay = late * spread / bar.wave_speed(), .loss = missing * spread / bar.length};
}

std::vector<Impact> impacts(const ContactHistory& history, double pause) {
    std::vector<Impact> found;
    for (std::size_t n = 0; n + 1 < history.time.size(); ++n) {
        const bool before = history.gap[n] < 0.0, after = history.gap[n + 1] < 0.0;
        if (!before && !after) continue;
        const double begin = before ? history.time[n] : root_after(history, n);
        if (found.empty() || begin - found.back().end > pause) found.push_back({.begin = begin});
        Impact& present = found.back();
        present.end = after ? history.time[n + 1] : root_after(history, n);
        present.impulse += history.pressure[n] * (history.time[n + 1] - history.time[n]);
        present.speed = history.speed[n + 1];
    }
    if (!found.empty() && history.time.back() - found.back().end < pause) found.pop_back();
    return found;
}

MiddlePressure middle_pressure(const ContactHistory& history, double begin, double duration,
                               const std::function<double(double)>& exact) {
    double whole = 0.0, sum = 0.0, square = 0.0, moment = 0.0, inertia = 0.0;
    const double middle = begin + 0.5 * duration;
    for (std::size_t n = 0; n + 1 < history.time.size(); ++n) {
        const double dt = history.time[n + 1] - history.time[n], t = history.time[n] + 0.5 * dt, p = history.pressure[n];
        if (std::abs(t - middle) > 0.4 * duration) continue;
        whole += dt;
        sum += p * dt;
        square += (p - exact(t)) * (p - exact(t)) * dt;
        moment += p * (t - middle) * dt;
        inertia += (t - middle) * (t - middle) * dt;
    }
    const double mean = sum / whole, rise = 0.5 * duration * moment / inertia;
    return {.mean = mean, .rms = std::sqrt(square / whole), .at_begin = mean - rise, .at_end = mean + rise};
}

std::string BarOptions::body_name() const { return apps::name_of(bodies, body); }

void BarOptions::check() const {
    if (body != BarBody::chain) return;
    for (const CLI::Option* option : of_solver)
        if (option->count() > 0)
            throw BadInput(fmt::format("{}: a chain does not know it. Take --body strip2d or strip3d, or leave it out.",
                                       option->get_name()));
}

BarOptions default_bar_options(const apps::Program& program, std::vector<int> cells, double length) {
    BarOptions options{.cells = std::move(cells), .run = {.out = "out/" + program.name}, .of_solver = {}};
    options.run.contact.compression_limit = 10.0;
    options.run.contact.search.skin = 0.1 * length;  // few faces face a wall: a thick skin costs nothing and lasts long
    return options;
}

void add_bar_options(CLI::App& app, BarOptions& options, const std::vector<BarBody>& offered) {
    apps::Choices<BarBody> choices;
    for (const BarBody body : offered) choices.emplace_back(apps::name_of(bodies, body), body);
    apps::add_choice(app, "--body", options.body, "masses and springs, or the full solver: strips two cells wide on rollers",
                     choices)
        ->group("Bar");
    apps::add_counts(app, "--cells", options.cells, "cells along the bar, a run for each number", 8)->group("Bar");
    apps::add_number(app, "--cfl", options.cfl,
                     "Courant number c dt/h; strips are stable below about 0.6 in 2D and 0.5 in 3D",
                     {.above = 0.0, .below = 1.0, .closed = true, .remedy = "Above 1 the scheme is unstable."})
        ->group("Time");
    options.of_solver = {apps::add_choice(app, "--filter", options.run.filter,
                                          "energy-neutral filter of the parasitic mode, after each step in contact",
                                          apps::Choices<bool>{{"none", false}, {"neutral", true}})
                             ->group("Time")};
    apps::add_contact_options(app, options.run);
    for (CLI::Option* option : app.get_options())
        if (option->get_group() == "Contact") options.of_solver.push_back(option);
    app.add_option("--out", options.run.out, "folder of all results; made if it is not there")
        ->type_name("DIR")
        ->capture_default_str()
        ->group("Output");
}

nlohmann::ordered_json to_json(const BarOptions& options) {
    Json json = {{"body", options.body_name()}, {"cells", options.cells}};
    if (options.body != BarBody::chain) {
        json.update(apps::to_json(options.run));
        for (const char* name : {"interval", "frames"}) json.erase(name);
    }
    json["cfl"] = options.cfl;
    json["out"] = options.run.out.string();
    return json;
}

BarRun run_bar(const BarOnWall& scene, const BarOptions& options, int cells, const std::vector<double>& profile_times) {
    BarRun run;
    double seconds = 0.0;
    {
        const Stopwatch watch(seconds);
        const int steps = steps_of(scene.time, scene.bar.length / cells, scene.bar, options.cfl);
        const double dt = scene.time / steps, width = strip_width(scene.bar, cells);
        const auto run_strip = [&]<int Dim>() {
            return run_strips<Dim>(bar_strip<Dim>(scene, cells), options, cross_section<Dim>(width), dt, steps,
                                   profile_times);
        };
        switch (options.body) {
            case BarBody::chain:
                run = run_chain(scene, cells, dt, steps, profile_times);
                break;
            case BarBody::strip2d:
                run = run_strip.template operator()<2>();
                break;
            case BarBody::strip3d:
                run = run_strip.template operator()<3>();
                break;
        }
    }
    run.seconds = seconds;
    return run;
}

BarRun run_two_bars(const TwoBars& scene, const BarOptions& options, std::array<int, 2> cells) {
    BarRun run;
    double seconds = 0.0;
    {
        const Stopwatch watch(seconds);
        const int steps = steps_of(scene.time, scene.bar.length / std::ranges::max(cells), scene.bar, options.cfl);
        const double dt = scene.time / steps, width = two_strips_width(scene.bar, cells);
        const auto run_both = [&]<int Dim>() {
            return run_strips<Dim>(two_bar_strips<Dim>(scene, cells), options, cross_section<Dim>(width), dt, steps);
        };
        run = options.body == BarBody::strip2d ? run_both.template operator()<2>() : run_both.template operator()<3>();
    }
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
    prepare_study(options.run.out, curves, {bars.picture.name});
    Study study{.title = bars.title, .reference = bars.reference};
    apps::Table history{.columns = {"cells", "time", "gap", "speed_1", "speed_2", "middle", "pressure"}, .rows = {}};
    for (std::size_t i = 0; i < options.cells.size(); ++i) {
        const BarRun run = bars.run(i);
        study.levels.push_back(bars.level(run, i));
        append_history(history, run.history, options.cells[i]);
    }
    study.curves = {{"history", std::move(history)}, {"exact", bars.exact}};
    study.pictures = {bars.picture};
    study.options = to_json(options);
    if (bars.complete) bars.complete(study);
    report(program, options.run.out, study);
}

template run::Scene<2> bar_strip<2>(const BarOnWall&, int);
template run::Scene<3> bar_strip<3>(const BarOnWall&, int);
template run::Scene<2> two_bar_strips<2>(const TwoBars&, std::array<int, 2>);
template run::Scene<3> two_bar_strips<3>(const TwoBars&, std::array<int, 2>);

}  // namespace abut::studies
