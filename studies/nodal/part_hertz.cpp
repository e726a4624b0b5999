#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "abut/base/stopwatch.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "studies/nodal/rows.hpp"
#include "studies/nodal/statics.hpp"
#include "studies/scenes/hertz.hpp"

/// Two equal discs, or a sphere on a rigid plane, pressed onto each other by the weight of the upper one.
namespace abut::studies::turning {
namespace {

constexpr double cap = 0.7;  // part of the radius beyond which the upper body is guided and the lower one held

template <int Dim>
HertzOptions press_of(double faces) {
    return {.support = Dim == 2 ? HertzSupport::equal : HertzSupport::rigid_plane, .faces = faces};
}

/// Which faces make the k of a body: cells are six times larger far from the contact.
enum class Skin { of_contact, of_all_faces };

/// The upper body first. `ratio`: size of the lower one's faces over that of the upper ones.
template <int Dim>
P1Bodies<Dim> bodies_of(const HertzOptions& options, double ratio, Skin skin) {
    const double a = hertz_solution<Dim>(options).contact_radius, size = a / options.faces;
    std::vector<mesh::Mesh<Dim>> meshes{round_body<Dim>(options, options.radius, size, 0, "upper")};
    if (Dim == 2) meshes.push_back(round_body<Dim>(options, -options.radius, ratio * size, 1, "lower"));
    Case<Dim> one = case_of<Dim>("Hertz", meshes, Kinematics::small);
    for (solid::Material& material : one.scene.solid.materials)
        material = {.young = options.young[0], .poisson = options.poisson[0]};
    if constexpr (Dim == 3) {
        const double far = 4.0 * options.radius;  // one triangle, so that a face is a facet
        one.scene.solid.obstacles = {
            {.faces = {{Vector<3>(-far, -far, 0.0), Vector<3>(far, -far, 0.0), Vector<3>(0.0, far, 0.0)}}, .path = {}}};
    }
    if (skin == Skin::of_contact) one.on_nodes.touches = [a](const Vector<Dim>& x) { return x.norm() < hertz_uniform * a; };
    return P1Bodies<Dim>(one.scene, one.on_nodes);
}

template <int Dim>
StaticLoad load_of(const P1Bodies<Dim>& bodies, const HertzOptions& options) {
    StaticLoad load{std::vector<double>(bodies.size(), 0.0), std::vector<char>(bodies.size(), 0)};
    double upper_mass = 0.0;
    for (std::size_t i = 0; i < bodies.masses().size(); ++i)
        if (bodies.body_of_points()[i] == 0) upper_mass += bodies.masses()[i];
    for (std::size_t i = 0; i < bodies.masses().size(); ++i) {
        const double height = bodies.rest_positions()[i][Dim - 1] / options.radius;
        if (bodies.body_of_points()[i] == 0) load.force[i * Dim + Dim - 1] = -options.load * bodies.masses()[i] / upper_mass;
        for (std::size_t d = 0; d < Dim; ++d)
            load.held[i * Dim + d] = height < -(1.0 + cap) || (height > 1.0 + cap && d + 1 < Dim) ? 1 : 0;
    }
    return load;
}

/// The upper body moved down by so much that rigid bodies would share half of the contact.
template <int Dim>
std::vector<double> start(const P1Bodies<Dim>& bodies, const HertzOptions& options) {
    const double a = hertz_solution<Dim>(options).contact_radius;
    const double radius = Dim == 2 ? 0.5 * options.radius : options.radius;
    std::vector<double> q(bodies.size(), 0.0);
    for (std::size_t i = 0; i < bodies.masses().size(); ++i)
        if (bodies.body_of_points()[i] == 0) q[i * Dim + Dim - 1] = -0.25 * a * a / (2.0 * radius);
    return q;
}

/// Mean over a face.
template <int Dim>
double exact_pressure(const HertzSolution& exact, const mesh::Mesh<Dim>& mesh, std::int32_t face) {
    const auto corners = mesh.face_vertices[face];
    const Vector<Dim>&a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]];
    if constexpr (Dim == 2) {
        return exact.mean_pressure(a.x(), b.x());
    } else {
        constexpr int parts = 12;
        const Vector<3>& c = mesh.vertices[corners[2]];
        double sum = 0.0;
        for (int i = 0; i < parts; ++i)
            for (int j = 0; i + j < parts; ++j)
                for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
                    if (third > 0.5 && i + j + 2 > parts) continue;  // upside down, not beyond the last row
                    const Vector<3> x = a + (i + third) / parts * (b - a) + (j + third) / parts * (c - a);
                    sum += exact.pressure(x.head<2>().norm());
                }
        return sum / (parts * parts);
    }
}

/// Error of the pressure on one body, relative in L2.
template <int Dim>
double pressure_error(const P1Bodies<Dim>& bodies, const HertzSolution& exact, std::int32_t body) {
    const mesh::Mesh<Dim>& mesh = bodies.mesh();
    const auto pressure = bodies.contact_pressure();
    double error = 0.0, norm = 0.0;
    for (std::size_t i = 0; i < pressure.size(); ++i) {
        const std::int32_t face = mesh.boundary_faces[i];
        const Vector<Dim>& x = mesh.face_centroid[face];
        const double towards = body == 0 ? -mesh.face_normal[face][Dim - 1] : mesh.face_normal[face][Dim - 1];
        if (mesh.cell_body[mesh.face_cells[face][0]] != body || towards < 0.0 ||
            x.template head<Dim - 1>().norm() > 1.5 * exact.contact_radius)
            continue;
        const double wanted = exact_pressure<Dim>(exact, mesh, face);
        error += mesh.face_measure[face] * std::pow(pressure[i] - wanted, 2);
        norm += mesh.face_measure[face] * wanted * wanted;
    }
    return std::sqrt(error / norm);
}

/// By the upper body, along its way down [N].
template <int Dim>
double carried(const P1Bodies<Dim>& bodies) {
    double sum = 0.0;
    for (const auto& pair : bodies.contact().last().pairs) sum += std::abs(pair.force[Dim - 1]);
    return sum;
}

template <int Dim>
Row solve(double faces, double ratio, double allowed, Skin skin = Skin::of_contact) {
    Row row{.scene = "Hertz",
            .setting = Dim == 2 ? fmt::format("discs, a/h = {:g}, 1:{:g}", faces, ratio)
                                : fmt::format("sphere on plane, a/h = {:g}", faces)};
    if (skin == Skin::of_all_faces) row.setting += ", k of all";
    const Stopwatch clock(row.seconds);
    const HertzOptions options = press_of<Dim>(faces);
    P1Bodies<Dim> bodies = bodies_of<Dim>(options, ratio, skin);
    const StaticState state = solve_at_rest<Dim>(bodies, load_of<Dim>(bodies, options), start<Dim>(bodies, options), 1e-9);
    row.remark = fmt::format("{} triangles or tetrahedra, {} steps of Newton, {:.2g} of the load not in balance",
                             bodies.mesh().n_cells(), state.iterations, state.residual);
    const HertzSolution exact = hertz_solution<Dim>(options);
    const auto off = [&](std::int32_t body) { return pressure_error<Dim>(bodies, exact, body); };
    row.quantities.at_most("pressure on the upper body, off in L2", off(0), allowed);
    if (Dim == 2) row.quantities.at_most("pressure on the lower body, off in L2", off(1), allowed);
    row.quantities.at_most("load not in balance", state.residual, 1e-7);
    row.quantities.near("load that the contact carries", carried<Dim>(bodies), options.load, no_target, "N");
    return row;
}

}  // namespace

void solve_hertz(const Options& options, const Sink& sink) {
    for (const double faces : options.quick ? std::vector{5.0} : std::vector{5.0, 10.0})
        for (const double ratio : options.quick ? std::vector{1.0} : std::vector{1.0, 3.0})
            sink(solve<2>(faces, ratio, faces < 10.0 ? 0.03 : 0.02));
    if (options.quick) return;
    sink(solve<2>(5.0, 1.0, no_target, Skin::of_all_faces));
    sink(solve<3>(5.0, 1.0, 0.05));
}

}  // namespace abut::studies::turning
