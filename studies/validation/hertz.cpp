// Hertz contact at rest: a cylinder (plane strain) or a sphere on a block, on its equal and on a rigid plane.
//
// The exact pressure is an ellipse over the contact: p = p0 sqrt(1 - (r/a)^2). A cylinder R = 8 on a block, E = 200,
// nu = 0.3, P = 10 has a = 0.9628 and p0 = 6.612. Levels are the number of faces in a. Errors of the pressure are those of
// its mean over each face; the traction is that of the cells at the contact, which know nothing of pair forces.
// docs/validation.md has the tables.
#include "studies/scenes/hertz.hpp"
#include "abut/base/error.hpp"

#include <fmt/format.h>

#include <string>

#include "abut/run/option_table.hpp"
#include "studies/program/entry.hpp"
#include "studies/schemes/comparison.hpp"
#include "studies/table/study.hpp"

namespace abut::studies::hertz_study {
namespace {

const apps::Program program{.name = "hertz",
                            .purpose = "Hertz contact of cylinders and spheres at rest: pressure against the exact ellipse.",
                            .footer = "Targets hold for the default bodies with 5 and 10 faces in a."};

const apps::Choices<HertzSupport> supports = {
    {"block", HertzSupport::block}, {"equal", HertzSupport::equal}, {"rigid_plane", HertzSupport::rigid_plane}};

struct Options {
    int dim = 2;
    HertzOptions hertz;
    std::vector<double> faces;
    run::RunOptions run{.out = "out/" + program.name};
};

void add_options(Flags& flags, Options& options) {
    flags.group("Scene");
    flags.choice("--dim", options.dim, "cylinder or sphere", apps::Choices<int>{{"2", 2}, {"3", 3}});
    flags.choice("--support", options.hertz.support, "what it lies on", supports);
    flags.number("--load", options.hertz.load, "P, in 3D F", {.unit = "N/m, N", .above = 0.0});
    flags.number("--radius", options.hertz.radius, "of each round body", {.unit = "m", .above = 0.0});
    flags.body_values("--young", options.hertz.young, "Young's modulus, upper and lower", {.unit = "Pa", .above = 0.0});
    flags.body_values("--poisson", options.hertz.poisson, "Poisson's ratio, upper and lower", {.above = -1.0, .below = 0.5});
    flags.number("--ratio", options.hertz.ratio, "size of the lower faces over that of the upper ones", {.above = 0.0});
    flags.number("--coarse", options.hertz.coarse, "size of cells far from the contact over the radius",
                 {.above = 0.0, .below = 1.0});
    flags.numbers("--faces", options.faces,
                  "faces in the contact radius, a number a level; by default 2.5,5,10, in 3D 2.5,5", {.above = 0.0});
    flags.group("Statics");
    flags.number("--tolerance", options.hertz.statics.tolerance, "largest force left, over the largest stress",
                 {.above = 0.0});
    apps::add_model_options(flags, options.run);
    flags.out(options.run.out);
}

/// Targets of the reference case, for 5 faces in a and for 10.
struct Targets {
    double pressure = no_target;
    double traction = no_target;
    double peak = no_target;
    double radius = no_target;
};
Targets targets(int dim, double faces) {
    if (faces != 5.0 && faces != 10.0) return {};
    if (dim == 3) return {.peak = 0.03, .radius = 1.0 / faces};
    if (faces == 5.0) return {.pressure = 0.045, .traction = 0.05, .peak = 0.015};
    return {.pressure = 0.025, .traction = 0.03, .peak = 0.015};
}

template <int Dim>
Level level(const HertzOptions& options, const HertzResult<Dim>& result, double seconds) {
    const Targets target = targets(Dim, options.faces);
    const auto& exact = result.exact;
    return {.name = fmt::format("a/h = {:g}: {} cells, {} iterations, {:.2g} of the largest stress out of balance",
                                options.faces, result.n_cells, result.report.iterations.size(), result.report.residual),
            .size = exact.contact_radius / options.faces,
            .quantities = {{"pressure, error in L2", "", result.pressure_error, 0.0, 1.0, target.pressure},
                           {"traction of the cells, error in L2", "", result.traction_error, 0.0, 1.0, target.traction},
                           {"peak pressure", "Pa", result.peak_pressure, exact.peak_pressure, 0.0, target.peak},
                           {"contact radius", "m", result.contact_radius, exact.contact_radius, 0.0, target.radius},
                           {"load carried", Dim == 2 ? "N/m" : "N", result.load, options.load}},
            .seconds = seconds};
}

template <int Dim>
apps::Table curve(const HertzResult<Dim>& result) {
    apps::Table table{
        .columns = {"distance", "pressure", "traction", "exact", "distance_over_a", "pressure_over_p0", "traction_over_p0"}};
    const auto& [a, p0] = result.exact;
    for (const auto& face : result.faces) {
        const double distance = Dim == 2 ? face.position[0] : face.position.template head<Dim - 1>().norm();
        table.rows.push_back(
            {distance, face.pressure, face.traction, face.exact, distance / a, face.pressure / p0, face.traction / p0});
    }
    return table;
}

std::string curve_name(double faces) { return fmt::format("pressure_{:g}", faces); }

Picture picture(const Options& options, const std::string& title) {
    std::string script = fmt::format(R"gp(set title "{}" font ",15" noenhanced
set xlabel "{}"
set ylabel "pressure / p_0"
set key top right samplen 2 opaque
set samples 2000
set yrange [0:1.2]
set xrange [{}:1.5]
plot sqrt(x**2 < 1 ? 1 - x**2 : 0) with lines lw 2 lc rgb "#1b1b1a" title "Hertz")gp",
                                     title, options.dim == 2 ? "x / a" : "r / a", options.dim == 2 ? -1.5 : 0);
    static constexpr std::array<const char*, 4> colours{"#b9b8b4", "#2a78d6", "#eb6834", "#3c9d5b"};
    for (std::size_t i = 0; i < options.faces.size(); ++i) {
        const char* colour = colours[i % colours.size()];
        script += fmt::format(
            ", \\\n     \"{0}.csv\" using \"distance_over_a\":\"pressure_over_p0\" with points pt 7 ps 0.9 lc rgb \"{1}\" "
            "title \"pressure, a/h = {2:g}\"",
            curve_name(options.faces[i]), colour, options.faces[i]);
    }
    return {.name = "pressure",
            .purpose = "Contact pressure, from the .csv files beside this file",
            .height = 800,
            .script = script + "\n"};
}

/// "cylinder on a block"
template <int Dim>
std::string title(HertzSupport support) {
    const std::string round = Dim == 2 ? "cylinder" : "sphere", on = round + " on ";
    switch (support) {
        case HertzSupport::block:
            return on + "a block";
        case HertzSupport::equal:
            return on + "an equal " + round;
        case HertzSupport::rigid_plane:
            return on + "a rigid plane";
    }
    throw BadInput("not a HertzSupport");
}

template <int Dim>
Study solve(const Options& options) {
    Study study{.title = title<Dim>(options.hertz.support) + (Dim == 2 ? ", plane strain" : ""),
                .reference = "Hertz: an ellipse of pressure, p0 and a from the load"};
    for (const double faces : options.faces) {
        HertzOptions hertz = options.hertz;
        hertz.faces = faces;
        hertz.contact = options.run.contact;
        hertz.free_faces = options.run.free_faces;
        hertz.corners = options.run.corners;
        double seconds = 0.0;
        const HertzResult<Dim> result = timed(seconds, [&] { return solve_hertz<Dim>(hertz); });
        study.levels.push_back(level<Dim>(hertz, result, seconds));
        study.curves.emplace_back(curve_name(faces), curve(result));
    }
    study.pictures = {picture(options, study.title)};
    return study;
}

run::NamedValues named_values(const Options& options) {
    const HertzOptions& hertz = options.hertz;
    const auto of_bodies = [](const apps::BodyValues& values) { return std::vector(values.begin(), values.end()); };
    run::NamedValues values{{"dim", options.dim},
                            {"support", apps::name_of(supports, hertz.support)},
                            {"load", hertz.load},
                            {"radius", hertz.radius},
                            {"young", of_bodies(hertz.young)},
                            {"poisson", of_bodies(hertz.poisson)},
                            {"faces", options.faces},
                            {"ratio", hertz.ratio},
                            {"coarse", hertz.coarse},
                            {"tolerance", hertz.statics.tolerance}};
    apps::append(values, run::model_values(options.run));
    return values;
}

void check(Options& options) {
    if (options.faces.empty()) options.faces = options.dim == 2 ? std::vector{2.5, 5.0, 10.0} : std::vector{2.5, 5.0};
    for (const double faces : options.faces)
        if (!(faces >= 1.0 && faces <= 1000.0))
            throw BadInput(fmt::format(
                "--faces: {:g} faces in the contact radius, 1 to 1000 are allowed. 5 and 10 have targets.", faces));
}

void run_study(Options& options) {
    check(options);
    std::vector<std::string> curves;
    for (const double faces : options.faces) curves.push_back(curve_name(faces));
    const auto lock = prepare_study(program, options.run.out, curves, {"pressure"});
    Study study = options.dim == 2 ? solve<2>(options) : solve<3>(options);
    study.options = named_values(options);
    report(program, options.run.out, study);
}

const bool is_listed = list(entry_of(program, Options{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::hertz_study
