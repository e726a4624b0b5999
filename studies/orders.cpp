// Error of the schemes in time over the forces that they take, on five small systems whose motion is known.
//
// Duffing's oscillator, a planet of Kepler, a chain of 16 masses (of Fermi, Pasta and Ulam), a ball that bounces and a bar;
// the error is that of q and p at the end, Euclidean. Expect the order of each scheme, 2, 4 or 6, where forces are smooth.
// The force of the ball has a kink: order 3 at most in the mean there, 4 and 6 where steps end at its contacts. The wave in
// the bar is compared with that of the continuum: the error of the mesh is left, whatever the order in time.
// A force is that of all bonds, or its mean along a path; potentials of bilbao and the decompositions of energy_momentum
// are not counted. pairs have steps of constant length here, so that they are memm with half the step.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <variant>

#include "abut/base/error.hpp"
#include "abut/dynamics/landing.hpp"
#include "abut/dynamics/pairs.hpp"
#include "abut/dynamics/with_scheme.hpp"
#include "studies/orders/problems.hpp"
#include "studies/program/entry.hpp"
#include "studies/schemes/comparison.hpp"
#include "studies/table/study.hpp"

namespace abut::studies::orders_study {
namespace {

using dynamics::Composition;
using dynamics::Scheme;
using orders::Problem;
using orders::Run;

constexpr int fewest_forces = 400;
constexpr int shown_level = 3;       // of the table of errors: 3,200 forces
constexpr double round_off = 3e-12;  // errors below it tell nothing about an order
constexpr int most_halvings = 12;
constexpr double allowed_order = 0.1;    // error of an order, over it
constexpr double implicit_forces = 6.0;  // about as many a step of energy_momentum takes

const apps::Program program{.name = "orders",
                            .purpose = "Error of all schemes over the forces that they take, on five small systems.",
                            .footer = "Files KEPLER.csv and the like have the forces and the error of each scheme."};

struct OrdersOptions {
    int halvings = 6;
    std::filesystem::path out = "out/" + program.name;
};

void add_options(Flags& flags, OrdersOptions& options) {
    flags.group("Steps");
    flags.count("--halvings", options.halvings, "of the step, from about 400 forces on (150 of the bar)", shown_level);
    flags.out(options.out);
}

struct PairsOfSteps {};
struct Landed {
    Composition composition;
};

struct Method {
    const char* name;
    std::variant<Scheme, PairsOfSteps, Composition, Landed> scheme;
    int order;           ///< where forces are smooth
    double forces;       ///< per step
    const char* colour;  ///< of its line
};
const std::vector<Method> smooth_methods = {{"leapfrog", Scheme::leapfrog, 2, 1.0, "#b9b8b4"},
                                            {"memm", Scheme::memm, 2, 1.0, "#2a78d6"},
                                            {"pairs", PairsOfSteps{}, 2, 2.0, "#8fbcf0"},
                                            {"bilbao", Scheme::bilbao, 2, 1.0, "#1f9e6e"},
                                            {"energy_momentum", Scheme::energy_momentum, 2, implicit_forces, "#888888"},
                                            {"suzuki_4", Composition::suzuki_4, 4, 15.0, "#f0b08a"},
                                            {"blanes_moan_4", Composition::blanes_moan_4, 4, 13.0, "#eb6834"},
                                            {"blanes_moan_6", Composition::blanes_moan_6, 6, 21.0, "#1b1b1a"}};
const std::vector<Method> landed_methods = {
    {"blanes_moan_4_landed", Landed{Composition::blanes_moan_4}, 4, 13.0, "#eb6834"},
    {"blanes_moan_6_landed", Landed{Composition::blanes_moan_6}, 6, 21.0, "#1b1b1a"}};

bool lands(const Method& method) { return std::holds_alternative<Landed>(method.scheme); }

/// One run by each kind of method; returns the square of its error.
template <class Law>
class OneRun {
public:
    using System = dynamics::Particles<Law>;
    OneRun(Problem<Law>& problem, const Run& run, int steps)
        : problem_(problem), run_(run), steps_(steps), dt_(problem.time / steps) {}

    double operator()(Scheme scheme) {
        double error = 0.0;
        dynamics::with_scheme<System>(scheme, {.gauge = problem_.gauge}, [&](const auto& make) {
            auto integrator = make(problem_.system, run_.q, run_.p, dt_, {});
            for (int i = 0; i < steps_; ++i) integrator.step();
            error = run_.squared_error(integrator);
        });
        return error;
    }
    double operator()(PairsOfSteps) {
        dynamics::Pairs pairs(problem_.system, run_.q, run_.p, std::numeric_limits<double>::infinity());
        for (int i = 0; i < steps_; ++i) pairs.step(dt_);
        const auto end = pairs.synchronised();
        return run_.squared_error(end.q, end.p_before, end.p_after);
    }
    double operator()(Composition composition) {
        auto integrator = composed(composition);
        for (int i = 0; i < steps_; ++i) {
            integrator.step();
            integrator.project();
        }
        return run_.squared_error(integrator);
    }
    double operator()(Landed landed) {
        auto integrator = composed(landed.composition);
        dynamics::Landing landing(integrator, dynamics::Events({[](auto q) { return q[0]; }}, run_.q));
        while (integrator.time() < problem_.time * (1.0 - 1e-13)) {
            integrator.set_step(std::min(dt_, problem_.time - integrator.time()), dynamics::StepChange::keep);
            landing.step();
            integrator.project();
        }
        return run_.squared_error(integrator);
    }

private:
    auto composed(Composition composition) {
        return dynamics::Composed<System>(problem_.system, run_.q, run_.p, dt_, composition);
    }

    Problem<Law>& problem_;
    const Run& run_;
    int steps_;
    double dt_;
};

/// Steps and forces that a run takes, and the error; NaN where the scheme gives up.
struct Point {
    int steps;
    double forces, error;
};

template <class Law>
Point point_of(Problem<Law>& problem, const Method& method, int forces) {
    const int steps = std::max(1, static_cast<int>(std::lround(forces / method.forces)));
    const auto n = static_cast<double>(problem.runs.size());
    const std::int64_t before = problem.system.evaluations();
    double sum = 0.0;
    try {
        for (const Run& run : problem.runs) sum += std::visit(OneRun<Law>(problem, run, steps), method.scheme);
    } catch (const Diverged&) {
        sum = run::not_given;
    }
    const auto bonds = static_cast<double>(problem.system.evaluations() - before);
    return {steps, bonds / (n * problem.n_bonds), std::sqrt(sum / n)};
}

/// From the longest step on, each half of the one before.
template <class Law>
std::vector<Point> points_of(Problem<Law>& problem, const Method& method, std::size_t n) {
    std::vector<Point> points;
    for (std::size_t k = 0; k < n; ++k) points.push_back(point_of(problem, method, problem.fewest_forces << k));
    return points;
}

void append(apps::Table& table, const std::string& name, const std::vector<Point>& points) {
    table.columns.insert(table.columns.end(), {name + "_forces", name});
    for (std::size_t k = 0; k < points.size(); ++k)
        table.rows[k].insert(table.rows[k].end(), {points[k].forces, points[k].error});
}

/// Order over the finest two of the points whose errors are above round-off.
double order_of(const std::vector<Point>& points) {
    double order = run::not_given;
    for (std::size_t k = 1; k < points.size() && points[k].error > round_off; ++k)
        order = std::log(points[k - 1].error / points[k].error) /
                std::log(static_cast<double>(points[k].steps) / points[k - 1].steps);
    return order;
}

/// All methods on a problem: a level of the table with errors and orders, and the curves.
template <class Law>
void add_problem(Study& study, const std::string& name, Problem<Law> problem, const std::vector<Method>& methods,
                 std::size_t n_steps) {
    Level level{.name = name};
    apps::Table table;
    table.rows.resize(n_steps);
    for (const Method& method : methods) {
        const std::vector<Point> points =
            timed(level.seconds, [&] { return points_of(problem, method, table.rows.size()); });
        append(table, method.name, points);
        const Point& shown = points[shown_level];
        level.quantities.at_most(fmt::format("{}: error at {:.0f} forces", method.name, shown.forces), shown.error);
        level.quantities.near(fmt::format("{}: order", method.name), order_of(points), method.order,
                              problem.is_smooth || lands(method) ? allowed_order : no_target);
    }
    study.levels.push_back(level);
    study.curves.emplace_back(name, table);
}

/// Dashed where steps land at events.
std::string line_of(const Method& method) {
    return fmt::format("with linespoints pt {} ps 0.8 lw 1.6 dt {} lc rgb \"{}\"", lands(method) ? 6 : 7,
                       lands(method) ? 2 : 1, method.colour);
}

std::string panel(const std::string& name, const std::string& title, const std::vector<Method>& methods) {
    std::string script = fmt::format("set title \"{}\" offset 0,-0.7\nplot ", title);
    for (const Method& method : methods)
        script += fmt::format("{}\"{}.csv\" using \"{}_forces\":\"{}\" {}", &method == &methods.front() ? "" : ", \\\n     ",
                              name, method.name, method.name, line_of(method));
    return script + "\n";
}

std::vector<Method> methods_with_landing() {
    std::vector<Method> methods = smooth_methods;
    methods.insert(methods.end(), landed_methods.begin(), landed_methods.end());
    return methods;
}

Picture picture() {
    std::string script =
        "set multiplot layout 2,3 margins 0.06,0.99,0.08,0.95 spacing 0.055,0.12\nset logscale xy\nunset key\n"
        "set format y \"1e%T\"\nset xrange [300:40000]\nset yrange [1e-13:3]\n"
        "set ylabel \"error of q and p\" offset 1,0\nset xlabel \"forces\" offset 0,0.5\n";
    script += panel("kepler", "Kepler, e = 0.5", smooth_methods) + panel("duffing", "Duffing", smooth_methods);
    script += panel("chain", "chain of 16 masses", smooth_methods);
    script += panel("bounce", "a ball that bounces", methods_with_landing());
    script += "set xrange [100:15000]\nset yrange [1e-3:3]\n" + panel("bar", "a wave on a mesh", smooth_methods);
    script +=
        "set key center center noenhanced samplen 2 spacing 1.4\nunset border\nunset tics\nunset xlabel\n"
        "unset ylabel\nunset title\nplot ";
    for (const Method& method : methods_with_landing())
        script += fmt::format("{} title \"{}\", ", "NaN " + line_of(method), method.name);
    return {.name = program.name,
            .purpose = "Error over the number of forces, from the .csv files beside this file",
            .width = 1500,
            .script = script + "NaN notitle\nunset multiplot\n"};
}

void run_study(const OrdersOptions& options) {
    if (options.halvings > most_halvings)
        throw BadInput(fmt::format("--halvings: {}, at most {} are allowed. Take fewer.", options.halvings, most_halvings));
    const auto lock = prepare_study(program, options.out, {"kepler", "duffing", "chain", "bounce", "bar"}, {program.name});
    Study study{.title = "error over the number of forces",
                .reference = "Kepler's equation, parabolas and arcs of cosines, and small steps of Runge and Kutta's rule"};
    const auto n_steps = static_cast<std::size_t>(options.halvings) + 1;
    add_problem(study, "kepler", orders::kepler(), smooth_methods, n_steps);
    add_problem(study, "duffing", orders::duffing(), smooth_methods, n_steps);
    add_problem(study, "chain", orders::chain(), smooth_methods, n_steps);
    add_problem(study, "bounce", orders::bounce(), methods_with_landing(), n_steps);
    add_problem(study, "bar", orders::bar(), smooth_methods, n_steps);
    study.pictures = {picture()};
    study.options = {{"halvings", options.halvings}};
    report(program, options.out, study);
}

const bool is_listed = list(entry_of(program, OrdersOptions{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::orders_study
