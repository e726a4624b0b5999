// Statics of the bulk against manufactured solutions: order of convergence on every kind of mesh.
//
// The box [-1, 1]^Dim, E = 70e3, nu = 0.3, is loaded so that a displacement chosen beforehand is the solution, and that
// displacement is imposed on its boundary. 2D: u = (a/2)(x^2 + y^2)(1, 1), a = 0.8, load -a(lambda + 3 mu)(1, 1).
// 3D: u = (a/2) sin 2x cos y exp(z/2) (1, 2, -1). Expect order 2 in L2 and 1 in energy; 1.8 and 0.95 are asked for.
#include <fmt/format.h>

#include <algorithm>

#include "abut/base/stopwatch.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/boxes.hpp"
#include "studies/scenes/manufactured.hpp"
#include "studies/schemes/comparison.hpp"
#include "studies/table/study.hpp"

namespace abut::studies::manufactured_study {
namespace {

const apps::Program program{
    .name = "manufactured",
    .purpose = "Manufactured solutions of statics: errors and orders of convergence on all kinds of mesh.",
    .footer = "Errors are relative: in L2, and in the energy norm with the stabilisation."};

constexpr double least_order_l2 = 1.8, least_order_energy = 0.95;

struct ManufacturedOptions {
    int dim = 2;
    int cells = 0;
    int levels = 0;
    double tolerance = 1e-9;
    std::filesystem::path out = "out/" + program.name;
};

void add_options(Flags& flags, ManufacturedOptions& options) {
    flags.group("Mesh");
    flags.choice("--dim", options.dim, "dimensions", apps::Choices<int>{{"2", 2}, {"3", 3}});
    flags.count("--cells", options.cells, "along an edge of the coarsest box; 0: 8 in 2D, 4 in 3D", 0);
    flags.count("--levels", options.levels, "meshes, each of half the size of the one before; 0: 4 in 2D, 3 in 3D", 0);
    flags.group("Solution");
    flags.number("--tolerance", options.tolerance, "of the static solution, over the largest stress", {.above = 0.0});
    flags.out(options.out);
}

void fill_defaults(ManufacturedOptions& options) {
    if (options.cells == 0) options.cells = options.dim == 2 ? 8 : 4;
    if (options.levels == 0) options.levels = options.dim == 2 ? 4 : 3;
}

std::string l2_name(BoxCells cells) { return "L2 error, " + name_of(cells); }
std::string energy_name(BoxCells cells) { return "energy error, " + name_of(cells); }

template <int Dim>
Level level(const ManufacturedOptions& options, BoxCells cells, int refinement) {
    Level result;
    const Stopwatch watch(result.seconds);
    const double size = 2.0 / (options.cells << refinement);
    const auto box = box_of<Dim>(cells, Vector<Dim>::Constant(-1.0), Vector<Dim>::Ones(), size);
    const StaticErrors errors = solve_manufactured(manufactured<Dim>(), box, {.tolerance = options.tolerance});
    result.name =
        fmt::format("{} {}, {} evaluations of the force", box.n_cells(), name_of(cells), errors.report.evaluations);
    result.size = mean_cell_size(box);
    for (const auto& [name, error] :
         {std::pair(l2_name(cells), errors.displacement), std::pair(energy_name(cells), errors.energy)})
        result.quantities.at_most(name, error);
    return result;
}

/// Columns size, L2 error, energy error.
apps::Table curve(std::span<const Level> levels) {
    apps::Table table{.columns = {"size", "l2", "energy"}, .rows = {}};
    for (const Level& level : levels)
        table.rows.push_back({level.size, level.quantities[0].value, level.quantities[1].value});
    return table;
}

/// Errors over the size of the cells, with the slopes 2 and 1 through the last points of the first mesh.
Picture picture(const Study& study, const std::string& title) {
    static constexpr std::array<const char*, 5> colours{"#2a78d6", "#eb6834", "#2f9e57", "#8a4fd3", "#b58900"};
    const auto& last = study.curves.front().second.rows.back();
    double smallest = last[0], largest = last[0];
    for (const Level& level : study.levels) {
        smallest = std::min(smallest, level.size);
        largest = std::max(largest, level.size);
    }
    std::string script = fmt::format(
        "set title \"{}\" font \",15\" noenhanced\nset logscale xy\nset key outside right top samplen 2\n"
        "set xlabel \"mean size of the cells, (|box|/number)^{{1/d}} [m]\"\nset ylabel \"relative error\"\n"
        "set format y \"10^{{%L}}\"\nset mxtics 10\nset xrange [{:.17g}:{:.17g}]\nset xtics (0.005, 0.01, 0.02, 0.05, 0.1, "
        "0.2, 0.5, 1)\n"
        "set rmargin 30\nplot ",
        title, smallest / 1.3, largest * 1.3);
    for (std::size_t i = 0; i < study.curves.size(); ++i) {
        const auto& name = study.curves[i].first;
        script += fmt::format(
            "\"{0}.csv\" using \"size\":\"l2\" with linespoints pt 7 ps 1.1 lw 1.5 lc rgb \"{1}\" title \"L2, {0}\", \\\n"
            "     \"\" using \"size\":\"energy\" with linespoints pt 4 ps 1.2 lw 1.5 dt 4 lc rgb \"{1}\" title \"energy, "
            "{0}\", \\\n     ",
            name, colours[i % colours.size()]);
    }
    script += fmt::format(
        "{0}*(x/{1})**2 with lines lw 1 lc rgb \"#888888\" title \"slope 2\", \\\n"
        "     {2}*(x/{1}) with lines lw 1 dt 2 lc rgb \"#888888\" title \"slope 1\"\n",
        0.6 * last[1], last[0], 1.25 * last[2]);
    return {.name = "errors", .purpose = "Errors of manufactured solutions", .width = 1250, .height = 800, .script = script};
}

template <int Dim>
Study study(const ManufacturedOptions& options) {
    Study study{.title = fmt::format("manufactured solution in {}D, {}", Dim, manufactured<Dim>().formula),
                .reference = "the exact displacement, imposed on the boundary; relative errors, exact: 0"};
    for (const BoxCells cells : all_box_cells<Dim>()) {
        const auto begin = static_cast<std::ptrdiff_t>(study.levels.size());
        for (int refinement = 0; refinement < options.levels; ++refinement)
            study.levels.push_back(level<Dim>(options, cells, refinement));
        study.curves.emplace_back(name_of(cells), curve(std::span(study.levels.begin() + begin, study.levels.end())));
        study.orders.push_back({l2_name(cells), least_order_l2});
        study.orders.push_back({energy_name(cells), least_order_energy});
    }
    study.pictures = {picture(study, study.title)};
    study.options = {{"dim", Dim}, {"cells", options.cells}, {"levels", options.levels}, {"tolerance", options.tolerance}};
    return study;
}

void run_study(ManufacturedOptions options) {
    fill_defaults(options);
    std::vector<std::string> curves;
    for (const BoxCells cells : all_box_cells<2>()) curves.push_back(name_of(cells));
    for (const BoxCells cells : all_box_cells<3>()) curves.push_back(name_of(cells));
    const auto lock = prepare_study(program, options.out, curves, {"errors"});
    report(program, options.out, options.dim == 2 ? study<2>(options) : study<3>(options));
}

const bool is_listed = list(entry_of(program, ManufacturedOptions{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::manufactured_study
