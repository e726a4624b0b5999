// Contact patch test: two blocks under a uniform pressure carry one uniform stress, whatever their materials and meshes.
//
// Exact to round-off is asked of meshes that match, with `stiffness` weights and local equilibrium, where the sides stand on
// rollers or nu = 0. Everything else is measured: the table has the largest error of each choice.
#include <fmt/format.h>

#include <algorithm>

#include "abut/geometry/stopwatch.hpp"
#include "scenes/contact_patch.hpp"
#include "support/choices.hpp"
#include "support/comparison.hpp"
#include "validation/study.hpp"

namespace abut::examples {
namespace {

const Program program{
    .name = "contact_patch",
    .purpose = "Contact patch test: errors of stress and displacement for each mesh, weight and Neumann choice.",
    .footer = "Blocks: unit squares or cubes, E = 1 and 7 Pa, nu = 0.3 and 0.2 unless nu is 0."};

struct Options {
    int dim = 2;
    double strain = PatchOptions{}.strain;
    std::vector<std::string> meshes;  // by name; empty: all
    std::filesystem::path out = "out/" + program.name;
};

const Choices<PatchMesh> meshes = {
    {"matching", PatchMesh::matching}, {"non-matching", PatchMesh::non_matching}, {"unstructured", PatchMesh::unstructured}};
const Choices<contact::Weights> weights = {{"stiffness", contact::Weights::stiffness}, {"half", contact::Weights::half}};
const Choices<dynamics::Neumann> neumanns = {{"local_equilibrium", dynamics::Neumann::local_equilibrium},
                                             {"extrapolate", dynamics::Neumann::extrapolate},
                                             {"adjacent", dynamics::Neumann::adjacent}};
struct Sides {
    std::string name;
    bool free;
    bool zero_poisson;
};
const std::vector<Sides> all_sides = {{"rollers", false, false}, {"free, nu = 0", true, true}, {"free", true, false}};

constexpr double exact = 1e-10;

/// Where the method is exact.
double target(const PatchOptions& options, const Sides& sides) {
    const bool is_exact = options.mesh == PatchMesh::matching && options.contact.weights == contact::Weights::stiffness &&
                          options.neumann == dynamics::Neumann::local_equilibrium && (!sides.free || sides.zero_poisson);
    return is_exact ? exact : std::numeric_limits<double>::infinity();
}

template <int Dim>
Level level(const PatchOptions& options, const Sides& sides) {
    double seconds = 0.0;
    PatchErrors errors;
    {
        const Stopwatch watch(seconds);
        errors = solve_patch<Dim>(options);
    }
    const double allowed = target(options, sides);
    return {.name = fmt::format("{}, {}, {}, sides {} ({:.1g} out of balance)", name_of(meshes, options.mesh),
                                name_of(weights, options.contact.weights), name_of(neumanns, options.neumann), sides.name,
                                errors.report.residual),
            .quantities = {{"stress, largest error", "", errors.stress, 0.0, 1.0, allowed},
                           {"displacement, largest error", "", errors.displacement, 0.0, 1.0, allowed},
                           {"contact pressure, largest error", "", errors.pressure, 0.0, 1.0, allowed}},
            .seconds = seconds};
}

template <int Dim>
Study solve(const Options& options) {
    Study study{.title = fmt::format("two blocks under uniform pressure, {}D, strain {:g}", Dim, options.strain),
                .reference = "uniform stress",
                .options = {{"dim", Dim}, {"strain", options.strain}}};
    for (const auto& [mesh_name, mesh] : meshes) {
        if (!options.meshes.empty() && std::ranges::find(options.meshes, mesh_name) == options.meshes.end()) continue;
        for (const auto& [weight_name, weight] : weights)
            for (const auto& [neumann_name, neumann] : neumanns)
                for (const Sides& sides : all_sides) {
                    PatchOptions patch{.mesh = mesh, .free_sides = sides.free, .strain = options.strain};
                    if (sides.zero_poisson) patch.poisson = {0.0, 0.0};
                    patch.contact.weights = weight;
                    patch.neumann = neumann;
                    study.levels.push_back(level<Dim>(patch, sides));
                }
    }
    return study;
}

}  // namespace
}  // namespace abut::examples

int main(int argc, char** argv) {
    using namespace abut::examples;
    Options options;
    const auto add_options = [&](CLI::App& app) {
        add_choice(app, "--dim", options.dim, "squares in plane strain, or cubes", Choices<int>{{"2", 2}, {"3", 3}})
            ->group("Scene");
        app.add_option("--mesh", options.meshes, "meshes of the two blocks; by default all")
            ->delimiter(',')
            ->check(one_of({"matching", "non-matching", "unstructured"}))
            ->type_name("NAME[,NAME...]")
            ->group("Scene");
        add_number(app, "--strain", options.strain, "pressure over the wave modulus of the lower block", {.above = 0.0})
            ->group("Scene");
        add_out_option(app, options.out);
    };
    return run_program(program, argc, argv, add_options, [&] {
        prepare_study(options.out, {}, {});
        report(program, options.out, options.dim == 2 ? solve<2>(options) : solve<3>(options));
    });
}
