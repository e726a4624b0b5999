#include "two_cylinders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "abut/mesh/read_mesh.hpp"
#include "abut/mesh/shapes.hpp"
#include "support/choices.hpp"
#include "support/run.hpp"

namespace abut::examples {
namespace {

/// After the first touch, in units of (R / sqrt(E / rho)) of the slower body: long enough for impact, slip and release.
constexpr double default_crossings = 10.0;

struct CylinderOptions {
    int dim = 2;
    BodyValues radius{1.0, 1.0};
    BodyValues length{1.0, 1.0};
    BodyValues young{1.0, 1.0};
    BodyValues poisson{0.3, 0.3};
    BodyValues density{1.0, 1.0};
    BodyValues speed{0.05, 0.05};
    BodyValues size{not_given, not_given};
    BodyValues eta{0.0, 0.0};
    double offset = not_given;
    double gap = 0.02;
    std::vector<std::string> meshes;
    RunOptions run;
};

void add_body_options(CLI::App& app, CylinderOptions& options) {
    const Limits length{.unit = "m", .above = 0.0};
    const Limits pressure{.unit = "Pa", .above = 0.0};
    add_body_values(app, "--radius", options.radius, "radius", length)->group("Bodies");
    add_body_values(app, "--length", options.length, "length along z (3D only)", length)->group("Bodies");
    add_body_values(app, "--young", options.young, "Young's modulus E", pressure)->group("Bodies");
    add_body_values(app, "--poisson", options.poisson, "Poisson's ratio nu",
                    {.above = -1.0, .below = 0.5, .remedy = "An incompressible body has no stable explicit step; take 0.49."})
        ->group("Bodies");
    add_body_values(app, "--density", options.density, "density rho", {.unit = "kg/m^3", .above = 0.0})->group("Bodies");
    add_body_values(app, "--speed", options.speed, "speed along x towards the other", {.unit = "m/s", .above = 0.0, .zero = true})->group("Bodies");
    add_body_values(app, "--size", options.size, "edge length of the cells; by default R/10 in 2D, R/12 in 3D", length)->group("Bodies");
    add_body_values(app, "--eta", options.eta, "stabilisation of jumps between cells; 0: Young's modulus", {.unit = "Pa", .above = 0.0, .zero = true})
        ->group("Bodies");
}

void add_place_options(CLI::App& app, CylinderOptions& options, const TwoCylinders& scene) {
    const std::string default_offset = fmt::format("distance of the two centres along y; by default {} of the mean radius", scene.offset_over_radius);
    auto* offset = add_number(app, "--offset", options.offset, default_offset, {.unit = "m"})->group("Scene");
    auto* gap = add_number(app, "--gap", options.gap, "distance of the two surfaces at the start", {.unit = "m"})->group("Scene");
    auto* meshes = app.add_option("--mesh", options.meshes, "mesh files (.msh or .vtu) of the two bodies, left and right, in place")->group("Scene");
    meshes->delimiter(',')->expected(2)->type_name("FILE,FILE")->excludes(offset, gap, app.get_option("--radius"), app.get_option("--length"),
                                                                         app.get_option("--size"));
}

void fill_defaults(CylinderOptions& options, const TwoCylinders& scene) {
    if (std::isnan(options.offset)) options.offset = scene.offset_over_radius * 0.5 * (options.radius[0] + options.radius[1]);
    for (std::size_t body = 0; body < 2; ++body)
        if (std::isnan(options.size[body])) options.size[body] = options.radius[body] / (options.dim == 2 ? 10.0 : 12.0);
    if (options.run.interval == 0) options.run.interval = options.dim == 2 ? 1 : 10;
}

void check(const CylinderOptions& options) {
    if (options.speed[0] + options.speed[1] == 0.0)
        throw std::invalid_argument("--speed: 0 m/s for both bodies, they never meet. Give at least one of them a speed above 0 m/s.");
    if (!options.meshes.empty()) return;
    for (std::size_t body = 0; body < 2; ++body)
        if (options.size[body] > options.radius[body])
            throw std::invalid_argument(fmt::format("--size: {} m for body {}, at most its radius of {} m is allowed. Give a size of about a tenth of it.",
                                                    options.size[body], body + 1, options.radius[body]));
    const double reach = options.radius[0] + options.radius[1];
    if (std::abs(options.offset) >= reach)
        throw std::invalid_argument(fmt::format("--offset: {} m, the cylinders pass each other; it must be below the sum of the radii, {} m. Lower it.",
                                                options.offset, reach));
}

/// Centres so that the circles are `gap` apart, measured between their nearest points; the middle is the origin.
std::array<Vector<2>, 2> centres(const CylinderOptions& options) {
    const double distance = options.radius[0] + options.radius[1] + options.gap;
    const double along_x = std::sqrt(std::max(0.0, distance * distance - options.offset * options.offset));
    const Vector<2> half(0.5 * along_x, 0.5 * options.offset);
    return {Vector<2>(-half), half};
}

template <int Dim>
mesh::Mesh<Dim> cylinder(const CylinderOptions& options, std::size_t body) {
    static constexpr std::array<const char*, 2> names{"left", "right"};
    const Vector<2> centre = centres(options)[body];
    const int variant = static_cast<int>(body);  // two meshes that never match by accident
    if constexpr (Dim == 2)
        return mesh::disc({.centre = centre, .radius = options.radius[body], .size = options.size[body], .variant = variant, .name = names[body]});
    else
        return mesh::cylinder({.centre = {centre.x(), centre.y(), 0.0}, .radius = options.radius[body], .length = options.length[body],
                               .size = options.size[body], .variant = variant, .name = names[body]});
}

template <int Dim>
mesh::Mesh<Dim> one_body_of_file(const std::string& path) {
    auto mesh = mesh::read_mesh<Dim>(path);
    if (mesh.n_bodies() != 1)
        throw std::invalid_argument(fmt::format("--mesh {}: the file holds {} bodies, 1 is needed. Write each body to a file of its own.", path, mesh.n_bodies()));
    return mesh;
}

template <int Dim>
mesh::Mesh<Dim> both_bodies(const CylinderOptions& options) {
    std::vector<mesh::Mesh<Dim>> bodies;
    for (std::size_t body = 0; body < 2; ++body)
        bodies.push_back(options.meshes.empty() ? cylinder<Dim>(options, body) : one_body_of_file<Dim>(options.meshes[body]));
    return mesh::combine<Dim>(bodies);
}

/// Half the longest side of a box around each body; the radius of a cylinder [m].
template <int Dim>
double largest_radius(const mesh::Mesh<Dim>& mesh) {
    Vector<Dim> lower = mesh.vertices.front(), upper = lower;
    double radius = 0.0;
    std::int32_t body = 0;
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        const auto& x = mesh.vertices[static_cast<std::size_t>(mesh.cell_vertices[cell].front())];
        if (mesh.cell_body[static_cast<std::size_t>(cell)] != body) lower = upper = x;
        body = mesh.cell_body[static_cast<std::size_t>(cell)];
        for (const std::int32_t vertex : mesh.cell_vertices[cell]) {
            lower = lower.cwiseMin(mesh.vertices[static_cast<std::size_t>(vertex)]);
            upper = upper.cwiseMax(mesh.vertices[static_cast<std::size_t>(vertex)]);
        }
        radius = std::max(radius, 0.5 * (upper - lower).template head<2>().maxCoeff());
    }
    return radius;
}

/// Approach, and then some crossings of the slower body.
double default_time(const CylinderOptions& options, double radius) {
    const double wave_speed = std::sqrt(std::min(options.young[0] / options.density[0], options.young[1] / options.density[1]));
    const auto middle = centres(options);
    const double cosine = options.meshes.empty() ? (middle[1] - middle[0]).normalized().x() : 1.0;
    const double approach = std::max(0.0, options.gap) / ((options.speed[0] + options.speed[1]) * std::max(cosine, 0.01));
    return approach + default_crossings * radius / wave_speed;
}

nlohmann::ordered_json to_json(const CylinderOptions& options) {
    return {{"dim", options.dim},         {"radius", options.radius},   {"length", options.length}, {"young", options.young},
            {"poisson", options.poisson}, {"density", options.density}, {"speed", options.speed},   {"size", options.size},
            {"eta", options.eta},         {"offset", options.offset},   {"gap", options.gap},       {"mesh", options.meshes}};
}

template <int Dim>
Scene<Dim> make_scene(const CylinderOptions& options, const TwoCylinders& cylinders) {
    const auto start = std::chrono::steady_clock::now();
    Scene<Dim> scene{.program = cylinders.program, .mesh = both_bodies<Dim>(options), .options = to_json(options)};
    scene.mesh_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    scene.mesh.name = "scene";
    for (std::size_t body = 0; body < 2; ++body) {
        scene.materials.push_back({options.young[body], options.poisson[body], options.density[body], options.eta[body]});
        scene.velocity.push_back((body == 0 ? 1.0 : -1.0) * options.speed[body] * Vector<Dim>::UnitX());
    }
    scene.time = std::isnan(options.run.time) ? default_time(options, largest_radius(scene.mesh)) : options.run.time;
    scene.remedy_if_overlapping = options.meshes.empty() ? fmt::format("Raise --gap, it is {} m.", options.gap) : "Move one of the meshes.";
    return scene;
}

std::string message_of(const CLI::App* app, const CLI::Error& error) {
    return fmt::format("{}: error: {} ({} --help lists all options.)\n", app->get_name(), error.what(), app->get_name());
}

}  // namespace

int run_two_cylinders(int argc, char** argv, const TwoCylinders& scene) {
    CylinderOptions options;
    options.run.out = "out/" + scene.program;
    CLI::App app(scene.purpose, scene.program);
    app.formatter(std::make_shared<HelpFormatter>());
    app.failure_message(message_of);
    app.footer("A pair of values, one for the left and one for the right body, is separated by a comma: --young 1,100. Units are SI.");
    add_choice(app, "--dim", options.dim, "discs in plane strain, or cylinders", Choices<int>{{"2", 2}, {"3", 3}})->group("Scene");
    add_body_options(app, options);
    add_place_options(app, options, scene);
    add_run_options(app, options.run, fmt::format("the approach and {:g} R/sqrt(E/rho)", default_crossings));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 1;
    }
    return report_errors(scene.program, [&] {
        fill_defaults(options, scene);
        check(options);
        options.dim == 2 ? run(make_scene<2>(options, scene), options.run) : run(make_scene<3>(options, scene), options.run);
    });
}

}  // namespace abut::examples
