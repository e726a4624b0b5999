// Patch test of the bulk and count of its zero modes, on every kind of mesh and for every Neumann choice.
//
// A displacement A x + b imposed on the whole boundary of a box has to come back in all cells, with its constant stress:
// to 1e-12. The same with the traction of that stress on all sides but two, which the Neumann choice takes part in.
// A step in single precision finds forces of its rounding in the exact field of the second case, 1e-5 of a face's at most.
// A free body has exactly 3 (2D) or 6 (3D) motions without energy: eigenvalues of K that are zero, the next one far above.
// `local_equilibrium` must pass everything; `extrapolate` and `adjacent` are there for comparison, and asked for nothing.
#include <fmt/format.h>

#include "abut/base/stopwatch.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/boxes.hpp"
#include "studies/scenes/patch_test.hpp"
#include "studies/schemes/comparison.hpp"
#include "studies/table/study.hpp"

namespace abut::studies::bulk_patch_study {
namespace {

using solid::FreeFaceRule;

const apps::Program program{
    .name = "bulk_patch",
    .purpose = "Affine displacements and rigid motions: patch test and zero modes on all kinds of mesh.",
    .footer = "The box is 1.4 x 1.1 (x 1.1) m; errors are the largest of all cells, relative."};

constexpr double allowed_error = 1e-12;
constexpr double allowed_single = 1e-5;  // forces in single precision: 128 roundings of 2^-24
constexpr double allowed_zero = 1e-8;    // the largest zero over the next eigenvalue

const apps::Choices<FreeFaceRule> free_face_rules = {{"local_equilibrium", FreeFaceRule::local_equilibrium},
                                                     {"extrapolate", FreeFaceRule::extrapolate},
                                                     {"adjacent", FreeFaceRule::adjacent}};

struct PatchOptions {
    int cells = 5;
    int mode_cells = 3;
    std::filesystem::path out = "out/" + program.name;
};

void add_options(Flags& flags, PatchOptions& options) {
    flags.group("Mesh");
    flags.count("--cells", options.cells, "along an edge of the box of the patch test", 2);
    flags.count("--mode-cells", options.mode_cells, "along an edge of the box whose eigenvalues are taken (dense matrix)",
                2);
    flags.out(options.out);
}

template <int Dim>
mesh::Mesh<Dim> box(BoxCells cells, int along_edge) {
    Vector<Dim> upper = Vector<Dim>::Constant(0.8);
    upper[0] = 1.1;
    return box_of<Dim>(cells, Vector<Dim>::Constant(-0.3), upper, 1.1 / along_edge);
}

double target(FreeFaceRule free_faces, double allowed) {
    return free_faces == FreeFaceRule::local_equilibrium ? allowed : no_target;
}

template <int Dim>
void add_patch(Level& level, const mesh::Mesh<Dim>& mesh, PatchBoundary boundary, const std::string& name,
               FreeFaceRule free_faces, double allowed) {
    const BulkPatchErrors errors = patch_test(mesh, boundary, free_faces);
    level.quantities.at_most("displacement, " + name, errors.displacement, allowed);
    level.quantities.at_most("stress, " + name, errors.stress, allowed);
}

template <int Dim>
void add_modes(Level& level, const mesh::Mesh<Dim>& mesh, const std::string& name, FreeFaceRule free_faces) {
    const double exact = Dim == 2 ? 3 : 6;
    const ZeroModes modes = zero_modes(mesh, free_faces);
    const auto count = static_cast<double>(modes.count);
    level.quantities.near("zero modes, " + name, count, exact, target(free_faces, 0.0));
    level.quantities.at_most("largest zero over next, " + name, modes.largest_zero / modes.next,
                             target(free_faces, allowed_zero));
}

template <int Dim>
Level level(const PatchOptions& options, BoxCells cells) {
    Level result;
    const Stopwatch watch(result.seconds);
    const auto patch = box<Dim>(cells, options.cells), free_body = box<Dim>(cells, options.mode_cells);
    result.name = fmt::format("{}D, {} {}; modes of {}", Dim, patch.n_cells(), name_of(cells), free_body.n_cells());
    result.quantities.at_most("force in single precision",
                              single_precision_force(patch, PatchBoundary::mixed, FreeFaceRule::local_equilibrium),
                              allowed_single);
    add_patch(result, patch, PatchBoundary::displacement, "imposed", FreeFaceRule::local_equilibrium, allowed_error);
    for (const auto& [name, free_faces] : free_face_rules)
        add_patch(result, patch, PatchBoundary::mixed, name, free_faces, target(free_faces, allowed_error));
    for (const auto& [name, free_faces] : free_face_rules) add_modes(result, free_body, name, free_faces);
    return result;
}

/// A row a mesh: errors of the stress, imposed and with tractions by Neumann choice, and zeros over next eigenvalues.
apps::Table curve(const Study& study) {
    apps::Table table{.columns = {"mesh", "imposed"}, .rows = {}};
    for (const char* what : {"stress", "zero"})
        for (const auto& [name, free_faces] : free_face_rules) table.columns.push_back(fmt::format("{}_{}", what, name));
    for (const Level& level : study.levels) {
        std::vector<double> row{static_cast<double>(table.rows.size())};
        for (const char* start : {"stress, ", "largest zero"})
            for (const Quantity& quantity : level.quantities)
                if (quantity.name.starts_with(start)) row.push_back(quantity.value);
        table.rows.push_back(row);
    }
    return table;
}

/// Errors of the stress on each mesh, on a logarithmic axis with the limit.
Picture picture(const Study& study) {
    std::string tics;
    for (std::size_t i = 0; i < study.levels.size(); ++i) {
        const std::string& name = study.levels[i].name;
        const std::string dim = name.substr(0, 2), cells = name.substr(4, name.find(';') - 4);
        tics += fmt::format("{}\"{} {}\" {}", i == 0 ? "" : ", ", dim, cells, i);
    }
    return {.name = "errors",
            .purpose = "Patch test: errors of the stress",
            .width = 1250,
            .height = 750,
            .script = fmt::format(
                "set title \"patch test: largest relative error of the stress\" font \",15\"\n"
                "set key outside right top samplen 1.5\nset logscale y\nset format y \"10^{{%L}}\"\nset yrange [1e-16:10]\n"
                "set ytics 1e-16,100,10\nset xrange [-0.5:{0}]\nset xtics ({1}) rotate by -30 noenhanced\n"
                "set ylabel \"relative error\"\nset rmargin 34\n"
                "plot {2:g} with lines lw 1.5 dt 2 lc rgb \"#444444\" title \"allowed\", \\\n"
                "     \"patch.csv\" using \"mesh\":\"imposed\" with points pt 5 ps 1.5 lc rgb \"#1b1b1a\" "
                "title \"displacement imposed\", \\\n"
                "     \"\" using \"mesh\":\"stress_local_equilibrium\" with points pt 7 ps 1.4 lc rgb \"#2a78d6\" "
                "title \"tractions, local equilibrium\", \\\n"
                "     \"\" using \"mesh\":\"stress_extrapolate\" with points pt 9 ps 1.6 lc rgb \"#2f9e57\" "
                "title \"tractions, extrapolate\", \\\n"
                "     \"\" using \"mesh\":\"stress_adjacent\" with points pt 11 ps 1.6 lc rgb \"#eb6834\" "
                "title \"tractions, adjacent\"\n",
                static_cast<double>(study.levels.size()) - 0.5, tics, allowed_error)};
}

void run_study(const PatchOptions& options) {
    const auto lock = prepare_study(program, options.out, {"patch"}, {"errors"});
    Study study{.title = "patch test and zero modes of the bulk",
                .reference = "affine displacements and rigid motions, exact; relative errors, exact: 0"};
    for (const BoxCells cells : all_box_cells<2>()) study.levels.push_back(level<2>(options, cells));
    for (const BoxCells cells : all_box_cells<3>()) study.levels.push_back(level<3>(options, cells));
    study.curves = {{"patch", curve(study)}};
    study.pictures = {picture(study)};
    study.options = {{"cells", options.cells}, {"mode_cells", options.mode_cells}};
    report(program, options.out, study);
}

const bool is_listed = list(entry_of(program, PatchOptions{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::bulk_patch_study
