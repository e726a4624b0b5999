// A wave that runs through two media, fast in one and slow in the other: what steps of different length are for.
//
// u_tt = (c^2 u_x)_x on [0, 1], c = 10 left of 1/2 and 1 right of it, u = 0 at both ends; a pulse 0.01 exp(-(20(x - 0.2))^2)
// starts to the right. The exact solution follows from reflections, until T = 0.5, when a wave is near the right end.
// Linear elements with lumped masses, a node on the interface: chain of masses h and springs c^2/h. Expect second order, and
// from memm_async, whose slow half takes a tenth of the steps, at most 1.2 times the error of memm with the fine step
// everywhere, for 0.55 of its force evaluations: one half of the bonds every step, the other every tenth.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/dynamics/particles.hpp"
#include "abut/run/options.hpp"
#include "studies/program/entry.hpp"
#include "studies/schemes/comparison.hpp"

namespace abut::studies::slow_fast_wave_study {
namespace {

using Chain = dynamics::Particles<dynamics::LineSpring>;

constexpr double fast_speed = 10.0, slow_speed = 1.0;  // [m/s]
constexpr double interface = 0.5;                      // [m]
constexpr int most_refinements = 20;
constexpr double longest = 0.5;  // [s], the front reaches x = 1 soon after

const apps::Program program{.name = "slow_fast_wave",
                            .purpose = "Wave in a fast and a slow medium: local steps against fine ones everywhere.",
                            .footer = "The interval [0, 1] m, wave speeds of 10 m/s left of 1/2 and 1 m/s right of it."};

struct WaveOptions {
    SchemeOptions schemes{.schemes = {Scheme::memm, Scheme::memm_async, Scheme::leapfrog}};
    int cells = 4000;
    double cfl = 0.5;       // of the fast half [-]
    int ratio = 10;         // steps of the fast half in one of the slow half
    double time = longest;  // [s]
    int refinements = 2;    // halved meshes before the last one
    std::filesystem::path out = "out/" + program.name;
};

void add_options(Flags& flags, WaveOptions& options) {
    flags.group("Wave");
    flags.count("--cells", options.cells, "cells of the whole interval, an even number", 4);
    flags.number("--time", options.time, "end of the run: the exact solution holds until 0.5",
                 {.unit = "s", .above = 0.0, .below = longest, .closed = true});
    flags.group("Time");
    flags.number("--cfl", options.cfl, "Courant number c dt/h of the fast half",
                 {.above = 0.0, .below = 1.0, .closed = true, .remedy = "Above 1 every scheme here is unstable."});
    add_integrator(flags, options.schemes);
    flags.group("Schemes");
    const apps::Flag ratio =
        flags.count("--ratio", options.ratio, "of memm_async: steps of the fast half in one of the slow half", 1);
    restrict_to(ratio, options.schemes, {Scheme::memm_async});
    flags.group("Wave");
    flags.count("--refinements", options.refinements,
                "how many coarser meshes, each of half the cells, the order is fitted over; 0: none", 0);
    flags.out(options.out);
}

/// The solution by reflections: at the wall the pulse changes its sign, at the interface a part goes back.
struct Exact {
    double displacement(double x, double t) const {
        return sum(x, t, [](double s) { return pulse(s); });
    }
    /// u_t
    double velocity(double x, double t) const {
        return sum(x, t, [](double s) { return fast_speed * 800.0 * (s - 0.2) * pulse(s); });
    }

private:
    static double pulse(double s) { return 0.01 * std::exp(-400.0 * (s - 0.2) * (s - 0.2)); }
    template <class F>
    static double sum(double x, double t, const F& f) {
        const double back = (slow_speed - fast_speed) / (slow_speed + fast_speed);
        const double through = 2.0 * fast_speed / (fast_speed + slow_speed);
        double value = 0.0, weight = 1.0;
        for (int k = 0; k <= static_cast<int>(fast_speed * t) + 2; ++k, weight *= back) {
            const double travelled = k - fast_speed * t;
            value +=
                weight * (x <= interface ? f(travelled + x) - f(travelled - x)
                                         : through * f(fast_speed / slow_speed * (x - interface) + interface + travelled));
        }
        return value;
    }
};

/// The inner nodes of linear elements, a mass each.
struct Mesh {
    explicit Mesh(int n) : cells(n), h(1.0 / n) {}

    int cells;
    double h;

    std::size_t size() const { return static_cast<std::size_t>(cells) - 1; }
    double position(std::size_t i) const { return static_cast<double>(i + 1) * h; }
    Chain chain() const {
        std::vector<dynamics::Bond<dynamics::LineSpring>> bonds;
        for (std::int32_t cell = 0; cell < cells; ++cell) {
            const double speed = 2 * cell < cells ? fast_speed : slow_speed;
            // Node 0, at the wall, is Bond::fixed already: -1.
            bonds.push_back({cell - 1,
                             cell + 1 < cells ? cell : dynamics::Bond<dynamics::LineSpring>::fixed,
                             {.stiffness = speed * speed / h}});
        }
        return {std::vector<double>(size(), 1.0 / h), bonds};
    }
    /// A node goes with the faster of its two cells.
    dynamics::LocalSteps local_steps(int ratio) const {
        dynamics::LocalSteps steps{.parts = {1}, .level = std::vector<std::int32_t>(size(), 0)};
        if (ratio == 1) return steps;
        steps.parts.push_back(ratio);
        std::fill_n(steps.level.begin(), cells / 2, 1);
        return steps;
    }
};

/// Relative errors of a profile.
struct Errors {
    double l2 = 0.0;
    double largest = 0.0;
};

Errors errors(const Mesh& mesh, std::span<const double> q, double time) {
    double wrong = 0.0, all = 0.0, worst = 0.0, highest = 0.0;
    for (std::size_t i = 0; i < q.size(); ++i) {
        const double exact = Exact().displacement(mesh.position(i), time), error = q[i] - exact;
        wrong += error * error;
        all += exact * exact;
        worst = std::max(worst, std::abs(error));
        highest = std::max(highest, std::abs(exact));
    }
    return {std::sqrt(wrong / all), worst / highest};
}

/// One scheme on one mesh, to the very end of the time.
SchemeRun run_on(const Mesh& mesh, Scheme scheme, const WaveOptions& options) {
    const auto long_steps = static_cast<double>(
        run::steps_until(options.time, options.ratio * options.cfl * mesh.h / fast_speed));  // as many for all schemes
    const int parts = scheme == Scheme::memm_async ? 1 : options.ratio;
    Start start{.dt = options.time / (long_steps * parts), .local_steps = mesh.local_steps(options.ratio)};
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        start.q.push_back(Exact().displacement(mesh.position(i), 0.0));
        start.p.push_back(mesh.h * Exact().velocity(mesh.position(i), 0.0));
    }
    Chain chain = mesh.chain();
    const double energy = chain.potential(start.q) + 0.5 * dynamics::mass_product(start.p, chain.inverse_mass(), start.p);
    const Schedule schedule{.steps = static_cast<std::int64_t>(long_steps) * parts, .look = parts, .energy_scale = energy};
    Watcher watcher;
    return studies::follow(scheme, chain, start, options.schemes, schedule, watcher);
}

/// Minus the slope of a straight line through (log cells, log error).
double fitted_order(const std::vector<std::pair<int, double>>& errors) {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const auto& [cells, error] : errors) {
        const double a = std::log(cells), b = std::log(error);
        x += a, y += b, xx += a * a, xy += a * b;
    }
    const auto n = static_cast<double>(errors.size());
    return -(n * xy - x * y) / (n * xx - x * x);
}

/// On all meshes; the run on the finest one, or the first that breaks off.
SchemeRun run_refined(Scheme scheme, const WaveOptions& options) {
    std::vector<std::pair<int, double>> refined;
    SchemeRun run;
    Errors last;
    for (int k = options.refinements; k >= 0 && !run.broken_off; --k) {
        const Mesh mesh(options.cells >> k);
        run = run_on(mesh, scheme, options);
        last = errors(mesh, run.q, options.time);
        refined.emplace_back(mesh.cells, last.l2);
    }
    const auto known = [&](bool is, double value) { return is && !run.broken_off ? run::Value(value) : run::Value(); };
    run.findings = {{"error_l2", "error in L2, relative", known(true, last.l2)},
                    {"error_max", "largest error / largest |u|", known(true, last.largest)},
                    {"order", fmt::format("order in L2 over {} meshes", options.refinements + 1),
                     known(refined.size() > 1, fitted_order(refined))}};
    return run;
}

/// The local steps against the fine ones.
std::vector<run::Finding> ratios(const std::vector<SchemeRun>& runs) {
    const auto find = [&](Scheme scheme) {
        return std::ranges::find_if(runs, [&](const SchemeRun& run) { return run.name == name_of(scheme); });
    };
    const auto fine = find(Scheme::memm), local = find(Scheme::memm_async);
    if (fine == runs.end() || local == runs.end() || fine->broken_off || local->broken_off) return {};
    const double error = std::get<double>(local->findings[0].value) / std::get<double>(fine->findings[0].value);
    const double work = static_cast<double>(local->evaluations) / static_cast<double>(fine->evaluations);
    return {{"error_ratio", "memm_async / memm: error in L2", error},
            {"evaluation_ratio", "memm_async / memm: bonds evaluated", work},
            {"seconds_ratio", "memm_async / memm: time of the steps", local->seconds / fine->seconds}};
}

std::vector<SchemeRun> complete(std::vector<SchemeRun> runs) {
    std::erase_if(runs, [](const SchemeRun& run) { return run.broken_off.has_value(); });
    return runs;
}

apps::Table profile(const Mesh& mesh, const std::vector<SchemeRun>& runs, double time) {
    apps::Table table{.columns = {"x", "exact"}};
    for (const SchemeRun& run : runs) table.columns.push_back(run.name);
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        table.rows.push_back({mesh.position(i), Exact().displacement(mesh.position(i), time)});
        for (const SchemeRun& run : runs) table.rows.back().push_back(run.q[i]);
    }
    return table;
}

/// The profiles, and what is wrong with them.
Picture picture(const std::vector<SchemeRun>& runs, double time) {
    constexpr std::array styles = {"lw 3 lc rgb \"#2a78d6\"", "lw 1.8 lc rgb \"#eb6834\"", "lw 1.8 dt 3 lc rgb \"#1b1b1a\""};
    std::string above = "\"profile.csv\" using \"x\":\"exact\" with lines lw 5 lc rgb \"#b9b8b4\" title \"exact\"",
                below = "0 with lines lc rgb \"#b9b8b4\" notitle";
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::string style = fmt::format("with lines {} title \"{}\"", styles[i], runs[i].name);
        above += fmt::format(", \\\n     \"\" using \"x\":\"{}\" {}", runs[i].name, style);
        below += fmt::format(", \\\n     \"profile.csv\" using \"x\":(1e3*(column(\"{}\")-column(\"exact\"))) {}",
                             runs[i].name, style);
    }
    const std::string script = fmt::format(
        "set multiplot layout 2,1 margins 0.09,0.97,0.07,0.95 spacing 0,0.06\nset key top center noenhanced\n"
        "set xrange [0:1]\nset format x \"\"\nset title \"t = {:g} s; c = 10 m/s left of 1/2, 1 m/s right of it\"\n"
        "set ylabel \"displacement [m]\"\nplot {}\n"
        "unset title\nset format x \"%g\"\nset xlabel \"x [m]\"\nunset key\nset ylabel \"error [mm]\"\nplot {}\nunset "
        "multiplot\n",
        time, above, below);
    return {
        .name = program.name, .purpose = "Profiles of displacement, from profile.csv beside this file", .script = script};
}

void check(const WaveOptions& options) {
    studies::check(options.schemes);
    if (options.refinements > most_refinements)
        throw BadInput(
            fmt::format("--refinements: {}, at most {} are allowed. Take fewer.", options.refinements, most_refinements));
    const int coarsest = options.cells >> options.refinements;
    if (options.cells % 2 != 0 || coarsest % 2 != 0 || coarsest < 4 || coarsest << options.refinements != options.cells)
        throw BadInput(fmt::format(
            "--cells: {} halved {} times must be an even number of at least 4, so that a node lies on the interface. "
            "Take a multiple of {}, or fewer --refinements.",
            options.cells, options.refinements, 4 << options.refinements));
    const double slow = options.ratio * options.cfl * slow_speed / fast_speed;
    if (slow >= 1.0)
        throw BadInput(
            fmt::format("--ratio: {} steps of a Courant number of {:g} make {:g} in the slow half, only below 1 is stable. "
                        "Lower --ratio or --cfl.",
                        options.ratio, options.cfl, slow));
}

run::NamedValues named_values(const WaveOptions& options) {
    run::NamedValues values = {{"cells", options.cells},
                               {"time", options.time},
                               {"cfl", options.cfl},
                               {"ratio", options.ratio},
                               {"refinements", options.refinements}};
    apps::append(values, named_values(options.schemes));
    values.push_back({"out", options.out.string()});
    return values;
}

void run_study(const WaveOptions& options) {
    check(options);
    const run::FolderLock lock = prepare_results(program, options.out, {"profile.csv"});
    Comparison comparison{.options = named_values(options)};
    for (const Scheme scheme : options.schemes.schemes) comparison.runs.push_back(run_refined(scheme, options));
    const double fine =
        comparison.runs.front().dt / (options.schemes.schemes.front() == Scheme::memm_async ? options.ratio : 1);
    comparison.title = fmt::format("{} cells, fine steps of {:.4g} s (c dt/h = {:.4g} and {:.4g})", options.cells, fine,
                                   fine * fast_speed * options.cells, fine * slow_speed * options.cells);
    comparison.findings = ratios(comparison.runs);
    const auto shown = complete(comparison.runs);
    apps::write_csv(options.out / "profile.csv", profile(Mesh(options.cells), shown, options.time));
    comparison.picture = picture(shown, options.time);
    studies::report(program, options.out, comparison);
}

const bool is_listed = list(entry_of(program, WaveOptions{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::slow_fast_wave_study
