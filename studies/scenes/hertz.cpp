#include "studies/scenes/hertz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "abut/base/stopwatch.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"

namespace abut::studies {
namespace {

using std::numbers::pi;

constexpr double cap = 0.7;  // part of the radius above which a round body is kept upright, or below which it is held
constexpr double block_half_width = 1.5;  // over the radius
constexpr double press = 1e-3;            // of a face, how deep the bodies begin in each other
constexpr const char* guided_group = "guided";
constexpr const char* held_group = "held";

template <int Dim>
Vector<Dim> up() {
    return Vector<Dim>::Unit(Dim - 1);
}

template <int Dim>
std::optional<mesh::Refinement<Dim>> refinement(const HertzOptions& options, double size) {
    const double a = hertz_solution<Dim>(options).contact_radius;
    return mesh::Refinement<Dim>{Vector<Dim>::Zero(), size, options.radius, hertz_uniform * a};
}

/// A boundary group of the faces on which `is_in` holds.
template <int Dim, class IsIn>
void add_group(mesh::Mesh<Dim>& mesh, const std::string& name, const IsIn& is_in) {
    mesh::BoundaryGroup group{name, {}};
    for (const std::int32_t face : mesh.boundary_faces)
        if (is_in(mesh.face_centroid[face])) group.faces.push_back(face);
    mesh.groups.push_back(std::move(group));
}

/// Upper body first.
template <int Dim>
mesh::Mesh<Dim> touching_bodies(const HertzOptions& options) {
    const double r = options.radius;
    const double size = hertz_solution<Dim>(options).contact_radius / options.faces;
    std::vector<mesh::Mesh<Dim>> parts{round_body<Dim>(options, r, size, 0, "upper")};
    if (options.support == HertzSupport::equal) {
        parts.push_back(round_body<Dim>(options, -r, options.ratio * size, 1, "lower"));
    } else if (options.support == HertzSupport::block) {
        const double lower_size = options.ratio * size;
        mesh::BoxOptions<Dim> box{.lower = Vector<Dim>::Constant(-block_half_width * r),
                                  .upper = Vector<Dim>::Constant(block_half_width * r),
                                  .size = std::max(lower_size, options.coarse * r),
                                  .refinement = refinement<Dim>(options, lower_size),
                                  .name = "lower"};
        box.upper[Dim - 1] = 0.0;
        parts.push_back(mesh::box<Dim>(box));
    }
    mesh::Mesh<Dim> mesh = mesh::combine<Dim>(parts);
    add_group(mesh, guided_group, [&](const Vector<Dim>& x) { return x[Dim - 1] > (1.0 + cap) * r; });
    if (options.support == HertzSupport::equal)
        add_group(mesh, held_group, [&](const Vector<Dim>& x) { return x[Dim - 1] < -(1.0 + cap) * r; });
    else if (options.support == HertzSupport::block)
        add_group(mesh, held_group, [&](const Vector<Dim>& x) { return x[Dim - 1] < -0.99 * block_half_width * r; });
    return mesh;
}

/// Volume of the upper body.
template <int Dim>
double volume(const mesh::Mesh<Dim>& mesh) {
    double sum = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells() && mesh.cell_body[c] == 0; ++c) sum += mesh.cell_measure[c];
    return sum;
}

template <int Dim>
solid::SolidOptions<Dim> solid_options(const HertzOptions& options, const mesh::Mesh<Dim>& mesh) {
    solid::SolidOptions<Dim> solid;
    for (std::size_t body = 0; body < static_cast<std::size_t>(mesh.n_bodies()); ++body)
        solid.materials.push_back({.young = options.young[body], .poisson = options.poisson[body]});
    solid::DirichletCondition<Dim> guided{.group = guided_group, .constraint = solid::Constraint::components};
    guided.components.fill(true);
    guided.components[Dim - 1] = false;
    solid.boundary.dirichlet = {guided};
    if (options.support == HertzSupport::rigid_plane)
        solid.obstacles = {contact::plane_obstacle<Dim>(Vector<Dim>::Zero(), up<Dim>(), 2.0 * options.radius)};
    else
        solid.boundary.dirichlet.push_back({.group = held_group});
    const double density = solid.materials.front().density;
    solid.acceleration.assign(solid.materials.size(), Vector<Dim>::Zero());
    solid.acceleration.front() = -options.load / (density * volume(mesh)) * up<Dim>();
    solid.boundary.free_face_rule = options.free_faces;
    solid.boundary.corner_rule = options.corners;
    solid.contact = options.contact;
    solid.law = solid::ContactLaw::reconstruction;  // figures of docs/validation.md
    return solid;
}

/// The upper body moved down until it just touches, and a little on.
template <int Dim>
std::vector<double> touching(solid::Solid<Dim>& solid, double depth) {
    std::vector<double> q(solid.size(), 0.0);
    const auto gap = solid.contact_at(q).field().gap;
    const double moved = *std::ranges::min_element(gap) + depth;
    for (std::int32_t c = 0; c < solid.mesh().n_cells(); ++c)
        if (solid.mesh().cell_body[c] == 0) q[static_cast<std::size_t>(c) * Dim + Dim - 1] = -moved;
    return q;
}

template <int Dim>
double distance_from_axis(const Vector<Dim>& x) {
    return x.template head<Dim - 1>().norm();
}

/// Mean over a face of the upper body: exact in 2D, of many equal small triangles in 3D [Pa].
template <int Dim>
double exact_pressure(const HertzSolution& exact, const mesh::Mesh<Dim>& mesh, std::int32_t face) {
    const auto corners = mesh.face_vertices[face];
    const auto corner = [&](std::size_t i) { return mesh.vertices[corners[i]]; };
    if constexpr (Dim == 2) {
        return exact.mean_pressure(corner(0).x(), corner(1).x());
    } else {
        constexpr int parts = 8;
        const Vector<3> a = (corner(1) - corner(0)) / parts, b = (corner(2) - corner(0)) / parts;
        double sum = 0.0;
        for (int i = 0; i < parts; ++i)
            for (int j = 0; j < 2 * (parts - i) - 1; ++j) {  // triangles of a row, every other one upside down
                const double third = j % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
                sum += exact.pressure(distance_from_axis<3>(corner(0) + (i + third) * a + (j / 2 + third) * b));
            }
        return sum / (parts * parts);
    }
}

template <int Dim>
void read_faces(solid::Solid<Dim>& solid, const std::vector<double>& q, HertzResult<Dim>& result) {
    const mesh::Mesh<Dim>& mesh = solid.mesh();
    const auto field = solid.contact_at(q).field();
    std::vector<double> force(solid.size());
    solid.force(q, force);  // sets the stresses
    for (std::size_t b = 0; b < field.pressure.size(); ++b) {
        const std::int32_t face = mesh.boundary_faces[b];
        const std::int32_t cell = mesh.face_cells[face][0];
        const Vector<Dim>& n = mesh.face_normal[face];
        const bool below = n[Dim - 1] < 0.0;
        if (mesh.cell_body[cell] != 0 || !below ||
            distance_from_axis<Dim>(mesh.face_centroid[face]) > 1.5 * result.exact.contact_radius)
            continue;
        result.faces.push_back({.position = mesh.face_centroid[face],
                                .measure = mesh.face_measure[face],
                                .pressure = field.pressure[b],
                                .traction = -n.dot(solid.ccg().stress(cell) * n),
                                .exact = exact_pressure<Dim>(result.exact, mesh, face)});
    }
    std::ranges::sort(result.faces, {}, [](const HertzFace<Dim>& face) { return face.position[0]; });
}

/// Figures of the faces together.
template <int Dim>
void sum_up(HertzResult<Dim>& result) {
    double norm = 0.0, pressure = 0.0, traction = 0.0, area = 0.0;
    int n_pressed = 0;
    for (const auto& face : result.faces) {
        norm += face.measure * face.exact * face.exact;
        pressure += face.measure * std::pow(face.pressure - face.exact, 2);
        traction += face.measure * std::pow(face.traction - face.exact, 2);
        result.load += face.measure * face.pressure;
        result.peak_pressure = std::max(result.peak_pressure, face.pressure);
        if (!(face.pressure > 0.0)) continue;
        area += face.measure;
        ++n_pressed;
    }
    result.pressure_error = std::sqrt(pressure / norm);
    result.traction_error = std::sqrt(traction / norm);
    result.contact_radius = Dim == 2 ? 0.5 * area : std::sqrt(area / pi);
    // A triangle of side h has the area sqrt(3)/4 h^2.
    result.face_size = Dim == 2 ? area / n_pressed : std::sqrt(area / n_pressed * 4.0 / std::sqrt(3.0));
}

}  // namespace

double HertzSolution::pressure(double distance) const {
    const double ratio = distance / contact_radius;
    return peak_pressure * std::sqrt(std::max(0.0, 1.0 - ratio * ratio));
}

double HertzSolution::mean_pressure(double begin, double end) const {
    const auto integral = [&](double distance) {
        const double x = std::clamp(distance / contact_radius, -1.0, 1.0);
        return 0.5 * peak_pressure * contact_radius * (x * std::sqrt(1.0 - x * x) + std::asin(x));
    };
    return (integral(end) - integral(begin)) / (end - begin);
}

template <int Dim>
HertzSolution hertz_solution(const HertzOptions& options) {
    const auto compliance = [&](std::size_t body) {
        return (1.0 - options.poisson[body] * options.poisson[body]) / options.young[body];
    };
    const double modulus = 1.0 / (compliance(0) + (options.support == HertzSupport::rigid_plane ? 0.0 : compliance(1)));
    const double radius = options.support == HertzSupport::equal ? 0.5 * options.radius : options.radius;
    if constexpr (Dim == 2) {
        const double a = 2.0 * std::sqrt(options.load * radius / (pi * modulus));
        return {a, 2.0 * options.load / (pi * a)};
    } else {
        const double a = std::cbrt(0.75 * options.load * radius / modulus);
        return {a, 1.5 * options.load / (pi * a * a)};
    }
}

template <int Dim>
mesh::Mesh<Dim> round_body(const HertzOptions& options, double height, double size, int variant, const std::string& name) {
    const auto smaller = refinement<Dim>(options, size);
    const double coarse = std::max(size, options.coarse * options.radius);
    const Vector<Dim> centre = height * up<Dim>();
    if constexpr (Dim == 2)
        return mesh::disc({centre, options.radius, coarse, smaller, variant, name});
    else
        return mesh::sphere({centre, options.radius, coarse, smaller, variant, name});
}

template <int Dim>
HertzResult<Dim> solve_hertz(const HertzOptions& options) {
    const mesh::Mesh<Dim> mesh = touching_bodies<Dim>(options);
    solid::Solid<Dim> solid(mesh, solid_options<Dim>(options, mesh));
    HertzResult<Dim> result{.exact = hertz_solution<Dim>(options), .n_cells = mesh.n_cells()};
    auto solution = [&] {
        const Stopwatch watch(result.seconds);
        return solve_statics(solid, touching(solid, press * result.exact.contact_radius / options.faces), options.statics);
    }();
    result.report = std::move(solution.report);
    if (!result.report.converged)
        throw std::runtime_error(
            fmt::format("the bodies do not come to rest: {:.2g} of the largest stress is left, {:.2g} is allowed. {}",
                        result.report.residual, options.statics.tolerance, result.report.ending));
    read_faces(solid, solution.q, result);
    sum_up(result);
    return result;
}

template HertzSolution hertz_solution<2>(const HertzOptions&);
template HertzSolution hertz_solution<3>(const HertzOptions&);
template mesh::Mesh<2> round_body<2>(const HertzOptions&, double, double, int, const std::string&);
template mesh::Mesh<3> round_body<3>(const HertzOptions&, double, double, int, const std::string&);
template HertzResult<2> solve_hertz<2>(const HertzOptions&);
template HertzResult<3> solve_hertz<3>(const HertzOptions&);

}  // namespace abut::studies
