#include "apps/two_cylinders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "abut/base/error.hpp"
#include "abut/mesh/io/read_mesh.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "apps/support/command_line.hpp"
#include "apps/support/preset.hpp"
#include "apps/support/run_scene.hpp"

namespace abut::apps {
namespace {

/// After the first touch, in units of (R / sqrt(E / rho)) of the slower body: long enough for impact, slip and release.
constexpr double default_crossings = 10.0;

const Choices<mesh::NonPlanarFaces> non_planar_faces = {{"fail", mesh::NonPlanarFaces::fail},
                                                        {"split", mesh::NonPlanarFaces::split}};

void add_body_options(CLI::App& app, CylinderOptions& options) {
    const Limits length{.unit = "m", .above = 0.0};
    const Limits pressure{.unit = "Pa", .above = 0.0};
    const Limits ratio{
        .above = -1.0, .below = 0.5, .remedy = "An incompressible body has no stable explicit step; take 0.49."};
    const auto grouped = [](CLI::Option* option) { option->group("Bodies"); };
    grouped(add_body_values(app, "--radius", options.radius, "radius", length));
    grouped(add_body_values(app, "--length", options.length, "length along z (3D only)", length));
    grouped(add_body_values(app, "--young", options.young, "Young's modulus E", pressure));
    grouped(add_body_values(app, "--poisson", options.poisson, "Poisson's ratio nu", ratio));
    grouped(add_body_values(app, "--density", options.density, "density rho", {.unit = "kg/m^3", .above = 0.0}));
    grouped(add_body_values(app, "--speed", options.speed, "speed along x towards the other",
                            {.unit = "m/s", .above = 0.0, .zero = true}));
    grouped(
        add_body_values(app, "--size", options.size, "edge length of the cells; by default R/10 in 2D, R/12 in 3D", length));
    auto* refine = add_number(app, "--refine", options.refine,
                              "how many times smaller cells are where the bodies meet first", {.above = 0.0});
    grouped(refine);
    auto* over = add_number(app, "--refine-over", options.refine_over,
                            "part of the radius over which cells grow from there to their own size", {.above = 0.0});
    grouped(over->needs(refine));
    grouped(add_body_values(app, "--eta", options.eta, "stabilisation of jumps between cells; 0: Young's modulus",
                            {.unit = "Pa", .above = 0.0, .zero = true}));
}

void add_place_options(CLI::App& app, CylinderOptions& options, double offset_over_radius) {
    const auto offset_help =
        fmt::format("distance of the two centres along y; by default {} of the mean radius", offset_over_radius);
    auto* offset = add_number(app, "--offset", options.offset, offset_help, {.unit = "m"})->group("Scene");
    auto* gap =
        add_number(app, "--gap", options.gap, "distance of the two surfaces at the start", {.unit = "m"})->group("Scene");
    const char* mesh_help =
        "mesh files (.msh or .vtu) of the two bodies, left and right, in place; needs --time; "
        "by default the program makes the meshes";
    auto* meshes = app.add_option("--mesh", options.meshes, mesh_help)->group("Scene");
    meshes->delimiter(',')->expected(2)->type_name("FILE,FILE");
    meshes->excludes(offset, gap, app.get_option("--radius"), app.get_option("--length"), app.get_option("--size"),
                     app.get_option("--refine"));
    add_choice(app, "--non-planar", options.non_planar,
               "cells of the files with faces that are not planar: refuse them, or split them into tetrahedra",
               non_planar_faces)
        ->needs(meshes)
        ->group("Scene");
}

void check(const CylinderOptions& options, const run::RunOptions& run) {
    if (options.speed[0] + options.speed[1] == 0.0)
        throw BadInput(
            "--speed: 0 m/s for both bodies, they never meet. Give at least one of them a speed above "
            "0 m/s.");
    if (!options.meshes.empty()) {
        if (std::isnan(run.time) && run.steps == 0)
            throw BadInput(
                "--mesh: how long the bodies take to meet is not known from their files. Give the end of "
                "the run with --time, above 0 s, or --steps.");
        return;
    }
    if (options.refine < 1.0)
        throw BadInput(fmt::format(
            "--refine: {} makes cells larger where the bodies meet; 1, for cells of one size, or more is allowed.",
            options.refine));
    for (std::size_t body = 0; body < 2; ++body)
        if (options.size[body] > options.radius[body])
            throw BadInput(fmt::format(
                "--size: {} m for body {}, at most its radius of {} m is allowed. Give a size of about a tenth of it.",
                options.size[body], body + 1, options.radius[body]));
    const double reach = options.radius[0] + options.radius[1];
    if (std::abs(options.offset) >= reach)
        throw BadInput(fmt::format(
            "--offset: {} m, the cylinders pass each other; it must be below the sum of the radii, {} m. Lower it.",
            options.offset, reach));
}

/// Centres so that the circles are `gap` apart, measured between their nearest points; the middle is the origin.
std::array<Vector<2>, 2> centres(const CylinderOptions& options) {
    const double distance = std::max(0.0, options.radius[0] + options.radius[1] + options.gap);
    const double along_x = std::sqrt(std::max(0.0, distance * distance - options.offset * options.offset));
    const Vector<2> half(0.5 * along_x, 0.5 * options.offset);
    return {Vector<2>(-half), half};
}

/// Smaller cells about the point of a body that is nearest to the other one.
template <int Dim>
std::optional<mesh::Refinement<Dim>> refinement(const CylinderOptions& options, std::size_t body) {
    if (options.refine == 1.0) return {};
    const auto centre = centres(options);
    Vector<Dim> nearest = Vector<Dim>::Zero();
    nearest.template head<2>() = centre[body] + options.radius[body] * (centre[1 - body] - centre[body]).normalized();
    return mesh::Refinement<Dim>{nearest, options.size[body] / options.refine, options.refine_over * options.radius[body]};
}

template <int Dim>
mesh::Mesh<Dim> cylinder(const CylinderOptions& options, std::size_t body) {
    static constexpr std::array<const char*, 2> names{"left", "right"};
    const Vector<2> centre = centres(options)[body];
    const int variant = static_cast<int>(body);  // two meshes that never match by accident
    if constexpr (Dim == 2)
        return mesh::disc({.centre = centre,
                           .radius = options.radius[body],
                           .size = options.size[body],
                           .refinement = refinement<2>(options, body),
                           .variant = variant,
                           .name = names[body]});
    else
        return mesh::cylinder({.centre = {centre.x(), centre.y(), 0.0},
                               .radius = options.radius[body],
                               .length = options.length[body],
                               .size = options.size[body],
                               .refinement = refinement<3>(options, body),
                               .variant = variant,
                               .name = names[body]});
}

template <int Dim>
mesh::Mesh<Dim> one_body_of_file(const std::string& path, mesh::NonPlanarFaces non_planar) {
    auto mesh = mesh::read_mesh<Dim>(path, {.non_planar = non_planar});
    if (mesh.n_bodies() != 1)
        throw BadInput(fmt::format("--mesh {}: the file holds {} bodies, 1 is needed. Write each body to a file of its own.",
                                   path, mesh.n_bodies()));
    return mesh;
}

template <int Dim>
mesh::Mesh<Dim> both_bodies(const CylinderOptions& options) {
    std::vector<mesh::Mesh<Dim>> bodies;
    for (std::size_t body = 0; body < 2; ++body)
        bodies.push_back(options.meshes.empty() ? cylinder<Dim>(options, body)
                                                : one_body_of_file<Dim>(options.meshes[body], options.non_planar));
    return mesh::combine<Dim>(bodies);
}

/// Speed of separation over speed of approach, along the line of the two centres where they first touch [-].
template <int Dim>
double restitution(const CylinderOptions& options, const run::RunResult<Dim>& result) {
    const auto middle = centres(options);
    const Vector<2> normal = (middle[1] - middle[0]).normalized();
    const auto separation = [&](const std::vector<solid::BodyMotion<Dim>>& bodies) {
        return (bodies[1].velocity - bodies[0].velocity).template head<2>().dot(normal);
    };
    return -separation(result.end) / separation(result.start);
}

/// Approach, and then some crossings of the slower body.
double default_time(const CylinderOptions& options) {
    const double wave_speed =
        std::sqrt(std::min(options.young[0] / options.density[0], options.young[1] / options.density[1]));
    const auto middle = centres(options);
    const double cosine = (middle[1] - middle[0]).normalized().x();
    const double approach = std::max(0.0, options.gap) / ((options.speed[0] + options.speed[1]) * std::max(cosine, 0.01));
    return approach + default_crossings * std::max(options.radius[0], options.radius[1]) / wave_speed;
}

std::vector<double> both(const BodyValues& values) { return {values.begin(), values.end()}; }

run::NamedValues named_values(const CylinderOptions& options) {
    run::NamedValues values = {{"dim", options.dim},
                               {"young", both(options.young)},
                               {"poisson", both(options.poisson)},
                               {"density", both(options.density)},
                               {"speed", both(options.speed)},
                               {"eta", both(options.eta)}};
    const auto append = [&](const run::NamedValues& more) { values.insert(values.end(), more.begin(), more.end()); };
    if (!options.meshes.empty()) {
        append({{"mesh", options.meshes}, {"non_planar", name_of(non_planar_faces, options.non_planar)}});
        return values;
    }
    append(
        {{"radius", both(options.radius)}, {"size", both(options.size)}, {"offset", options.offset}, {"gap", options.gap}});
    if (options.refine != 1.0) append({{"refine", options.refine}, {"refine_over", options.refine_over}});
    if (options.dim == 3) append({{"length", both(options.length)}});
    return values;
}

}  // namespace

void fill_defaults(CylinderOptions& options, double offset_over_radius) {
    if (std::isnan(options.offset)) options.offset = offset_over_radius * 0.5 * (options.radius[0] + options.radius[1]);
    for (std::size_t body = 0; body < 2; ++body) {
        if (std::isnan(options.size[body])) options.size[body] = options.radius[body] / (options.dim == 2 ? 10.0 : 12.0);
        if (options.eta[body] == 0.0) options.eta[body] = options.young[body];
    }
}

template <int Dim>
run::Scene<Dim> two_cylinders(const CylinderOptions& options) {
    run::Scene<Dim> scene{.mesh = both_bodies<Dim>(options), .options = named_values(options)};
    scene.mesh.name = "scene";
    scene.solid.law = solid::ContactLaw::reconstruction;  // that of the talk
    for (std::size_t body = 0; body < 2; ++body) {
        scene.solid.materials.push_back(
            {options.young[body], options.poisson[body], options.density[body], options.eta[body]});
        scene.velocity.push_back((body == 0 ? 1.0 : -1.0) * options.speed[body] * Vector<Dim>::UnitX());
    }
    scene.time = default_time(options);
    if (options.meshes.empty())
        scene.findings = [options](const run::RunResult<Dim>& result) -> std::vector<run::Finding> {
            return {{"restitution", "restitution along the line of centres", restitution<Dim>(options, result)}};
        };
    scene.remedy_if_overlapping =
        options.meshes.empty() ? fmt::format("Raise --gap, it is {} m.", options.gap) : "Move one of the meshes.";
    return scene;
}

int run_slipping_cylinders(int argc, char** argv) {
    Program program{
        .name = "slipping_cylinders",
        .purpose = "Two elastic cylinders collide off-centre, slip over each other and part.",
        .series = "cylinders",
        .footer =
            "A pair of values, one for the left and one for the right body, is separated by a comma: "
            "--young 1,100. Units are SI. Ctrl-C ends a run after its present step; its files are complete until there.",
        .takes_ranks = true};
    CylinderOptions scene;
    run::RunOptions options{.out = "out/" + program.name};
    const auto add_options = [&](CLI::App& app) {
        add_choice(app, "--dim", scene.dim, "discs in plane strain, or cylinders", Choices<int>{{"2", 2}, {"3", 3}})
            ->group("Scene");
        add_body_options(app, scene);
        add_place_options(app, scene, slipping_offset);
        add_preset_option(app, options);
        add_time_options(app, options, fmt::format("the approach and {:g} R/sqrt(E/rho)", default_crossings));
        add_contact_options(app, options);
        add_output_options(app, options);
        add_message_options(app, program.messages);
    };
    return run_program(program, argc, argv, add_options, [&] {
        fill_defaults(scene, slipping_offset);
        check(scene, options);
        scene.dim == 2 ? run_scene<2>(program, options, [&] { return two_cylinders<2>(scene); })
                       : run_scene<3>(program, options, [&] { return two_cylinders<3>(scene); });
    });
}

template run::Scene<2> two_cylinders<2>(const CylinderOptions&);
template run::Scene<3> two_cylinders<3>(const CylinderOptions&);

}  // namespace abut::apps
