// Contact patch test: two blocks under a uniform pressure carry one uniform stress, whatever their materials and meshes.
//
// Exact to round-off is asked of meshes that match, with `stiffness` weights, local equilibrium and relaxed corners, where
// no cell is pressed on two sides. Everything else is measured: the table has the largest error of each choice.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "studies/program/entry.hpp"
#include "studies/scenes/contact_patch.hpp"
#include "studies/schemes/comparison.hpp"
#include "studies/table/study.hpp"

namespace abut::studies::contact_patch_study {
namespace {

const apps::Program program{
    .name = "contact_patch",
    .purpose = "Contact patch test: errors of stress and displacement for each mesh, weight and Neumann choice.",
    .footer = "Blocks: unit squares or cubes, E = 1 and 7 Pa, nu = 0.3 and 0.2 unless nu is 0."};

struct Options {
    int dim = 2;
    double strain = PatchOptions{}.strain;
    std::vector<std::string> meshes;  // by name; empty: all
    std::filesystem::path out = "out/" + program.name;
};

const apps::Choices<PatchMesh> meshes = {
    {"matching", PatchMesh::matching}, {"non-matching", PatchMesh::non_matching}, {"unstructured", PatchMesh::unstructured}};
const apps::Choices<contact::InterfaceWeighting> weights = {{"stiffness", contact::InterfaceWeighting::stiffness},
                                                            {"half", contact::InterfaceWeighting::half}};
const apps::Choices<solid::FreeFaceRule> free_face_rules = {{"local_equilibrium", solid::FreeFaceRule::local_equilibrium},
                                                            {"extrapolate", solid::FreeFaceRule::extrapolate},
                                                            {"adjacent", solid::FreeFaceRule::adjacent}};
struct Sides {
    std::string name;
    PatchSides sides;
    bool zero_poisson = false;
    solid::CornerRule corners = solid::CornerRule::relaxed;
    bool is_exact = true;  // with the other choices that are exact
};
const std::vector<Sides> all_sides = {
    {"rollers", PatchSides::rollers},
    {"free, nu = 0", PatchSides::free, true},
    {"free", PatchSides::free},
    {"free, fixed corners", PatchSides::free, false, solid::CornerRule::fixed, false},
    {"walls", PatchSides::walls, false, solid::CornerRule::relaxed, false},
    {"walls, fixed corners", PatchSides::walls, false, solid::CornerRule::fixed, false},
};

constexpr double exact = 1e-10;

/// Target of the error where the method is exact; none elsewhere.
double target(const PatchOptions& options, const Sides& sides) {
    const bool is_exact = options.mesh == PatchMesh::matching &&
                          options.contact.weighting == contact::InterfaceWeighting::stiffness &&
                          options.free_faces == solid::FreeFaceRule::local_equilibrium && sides.is_exact;
    return is_exact ? exact : no_target;
}

template <int Dim>
Level level(const PatchOptions& options, const Sides& sides) {
    double seconds = 0.0;
    const ContactPatchErrors errors = timed(seconds, [&] { return solve_patch<Dim>(options); });
    const double allowed = target(options, sides);
    return {.name = fmt::format("{}, {}, {}, sides {} ({:.1g} out of balance)", apps::name_of(meshes, options.mesh),
                                apps::name_of(weights, options.contact.weighting),
                                apps::name_of(free_face_rules, options.free_faces), sides.name, errors.report.residual),
            .quantities = {{"stress, largest error", "", errors.stress, 0.0, 1.0, allowed},
                           {"displacement, largest error", "", errors.displacement, 0.0, 1.0, allowed},
                           {"contact pressure, largest error", "", errors.pressure, 0.0, 1.0, allowed}},
            .seconds = seconds};
}

/// Levels of one choice of mesh, weights and Neumann, one for all kinds of sides, and a row with their errors of the stress.
template <int Dim>
void add_levels(Study& study, apps::Table& stress, PatchOptions options) {
    std::vector<double> row{static_cast<double>(stress.rows.size())};
    for (const Sides& sides : all_sides) {
        options.sides = sides.sides;
        options.corners = sides.corners;
        options.poisson = sides.zero_poisson ? std::array{0.0, 0.0} : PatchOptions{}.poisson;
        study.levels.push_back(level<Dim>(options, sides));
        row.push_back(study.levels.back().quantities.front().value);
    }
    stress.rows.push_back(std::move(row));
}

/// Weights and Neumann choice below the axis for each mesh, the name of the mesh above, lines between meshes.
std::string axis(const std::vector<std::string>& mesh_names) {
    std::string tics, script;
    double place = 0.0;
    for (const std::string& name : mesh_names) {
        const double width = static_cast<double>(weights.size() * free_face_rules.size());
        script += fmt::format(
            "set label \"{0}\" at {1},graph 1.03 center font \",14\"\n"
            "set arrow from {2},graph 0 to {2},graph 1.06 nohead lc rgb \"#404040\"\n",
            name, place + 0.5 * (width - 1.0), place - 0.5);
        for (const auto& [weight_name, weight] : weights)
            for (const auto& [rule_name, free_faces] : free_face_rules)
                tics += fmt::format("{}\"{}, {}\" {}", tics.empty() ? "" : ", ", weight_name, rule_name, place++);
    }
    return script + fmt::format("set xtics ({}) rotate by -40 noenhanced\nset xrange [-0.5:{}]\n", tics, place - 0.5);
}

Picture picture(const std::string& title, const std::vector<std::string>& mesh_names) {
    static constexpr std::array<const char*, 6> points{"pt 7 ps 1.5 lc rgb \"#2a78d6\"",  "pt 5 ps 1.4 lc rgb \"#2f9e57\"",
                                                       "pt 9 ps 1.7 lc rgb \"#eb6834\"",  "pt 8 ps 1.7 lc rgb \"#eb6834\"",
                                                       "pt 13 ps 1.7 lc rgb \"#7a4fbf\"", "pt 12 ps 1.7 lc rgb \"#7a4fbf\""};
    std::string script = fmt::format(
        "set title \"{}\" font \",15\" offset 0,1.6\nset tmargin 5\nset rmargin 12\n"
        "set key outside bottom center horizontal samplen 1.5 width 2\nset logscale y\nset format y \"10^{{%L}}\"\nset "
        "yrange [*:10]\nset ytics 1e-16,100,10\n"
        "set ylabel \"largest error of the stress over the pressure [-]\"\n{}"
        "plot {:g} with lines lw 1.5 dt 2 lc rgb \"#444444\" title \"target (matching, stiffness, local equilibrium)\"",
        title, axis(mesh_names), exact);
    for (std::size_t i = 0; i < all_sides.size(); ++i)
        script +=
            fmt::format(", \\\n     \"stress.csv\" using (column(\"choice\")+{:g}):{} with points {} title \"sides: {}\"",
                        0.12 * (static_cast<double>(i) - 2.5), i + 2, points[i], all_sides[i].name);
    return {.name = "stress",
            .purpose = "Contact patch test: errors of the stress",
            .width = 1400,
            .height = 850,
            .script = script + "\n"};
}

template <int Dim>
Study solve(const Options& options) {
    Study study{.title = fmt::format("two blocks under uniform pressure, {}D, strain {:g}", Dim, options.strain),
                .reference = "uniform stress",
                .options = {{"dim", Dim}, {"strain", options.strain}}};
    apps::Table stress{
        .columns = {"choice", "rollers", "free_zero_poisson", "free", "free_fixed_corners", "walls", "walls_fixed_corners"},
        .rows = {}};
    std::vector<std::string> mesh_names;
    for (const auto& [mesh_name, mesh] : meshes) {
        if (!options.meshes.empty() && std::ranges::find(options.meshes, mesh_name) == options.meshes.end()) continue;
        mesh_names.push_back(mesh_name);
        for (const auto& [weight_name, weight] : weights)
            for (const auto& [rule_name, free_faces] : free_face_rules) {
                PatchOptions patch{.mesh = mesh, .strain = options.strain, .free_faces = free_faces};
                patch.contact.weighting = weight;
                add_levels<Dim>(study, stress, patch);
            }
    }
    study.curves = {{"stress", std::move(stress)}};
    study.pictures = {picture(study.title, mesh_names)};
    return study;
}

void add_options(Flags& flags, Options& options) {
    flags.group("Scene");
    flags.choice("--dim", options.dim, "squares in plane strain, or cubes", apps::Choices<int>{{"2", 2}, {"3", 3}});
    flags.names("--mesh", options.meshes, "meshes of the two blocks", {"matching", "non-matching", "unstructured"});
    flags.number("--strain", options.strain, "pressure over the wave modulus of the lower block", {.above = 0.0});
    flags.out(options.out);
}

void run_study(const Options& options) {
    const auto lock = prepare_study(program, options.out, {"stress"}, {"stress"});
    report(program, options.out, options.dim == 2 ? solve<2>(options) : solve<3>(options));
}

const bool is_listed = list(entry_of(program, Options{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::contact_patch_study
