#include <fmt/format.h>

#include <cmath>

#include "abut/base/stopwatch.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "studies/nodal/rows.hpp"
#include "studies/nodal/statics.hpp"

/// Two unit blocks on each other, on rollers, pressed from above: the stress is -p everywhere.
namespace abut::studies::turning {
namespace {

constexpr double error_allowed = 1e-4;  // at p/E = 1e-2
constexpr double young = 1.0, poisson = 0.3;

template <int Dim>
mesh::Mesh<Dim> blocks(bool is_structured, int cells) {
    std::vector<mesh::Mesh<Dim>> meshes;
    for (int body = 0; body < 2; ++body) {
        Vector<Dim> lower = Vector<Dim>::Zero(), upper = Vector<Dim>::Ones();
        lower[Dim - 1] += body;
        upper[Dim - 1] += body;
        const std::string name = body == 0 ? "lower" : "upper";
        std::array<int, Dim> counts;
        counts.fill(cells - body);
        if (is_structured)
            meshes.push_back(mesh::structured_box<Dim>(
                lower, upper, counts, Dim == 2 ? mesh::CellShape::triangle : mesh::CellShape::tetrahedron, name));
        else
            meshes.push_back(
                mesh::box<Dim>({.lower = lower, .upper = upper, .size = 1.0 / cells, .variant = body, .name = name}));
    }
    return mesh::combine<Dim>(meshes);
}

/// The pressure on the top; rollers on the sides and below.
template <int Dim>
StaticLoad load_of(const mesh::Mesh<Dim>& mesh, double p) {
    StaticLoad load{std::vector<double>(mesh.vertices.size() * Dim, 0.0), std::vector<char>(mesh.vertices.size() * Dim, 0)};
    for (const std::int32_t face : mesh.boundary_faces)
        if (mesh.face_centroid[face][Dim - 1] > 2.0 - 1e-9)
            for (const std::int32_t node : mesh.face_vertices[face])
                load.force[static_cast<std::size_t>(node * Dim + Dim - 1)] -= p * mesh.face_measure[face] / Dim;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        for (std::size_t d = 0; d < Dim; ++d) {
            const double x = mesh.vertices[i][static_cast<int>(d)];
            const bool is_side = d + 1 < Dim && (x < 1e-9 || x > 1.0 - 1e-9), is_bottom = d + 1 == Dim && x < 1e-9;
            load.held[i * Dim + d] = is_side || is_bottom ? 1 : 0;
        }
    return load;
}

/// Displacements expected of linear elasticity and the springs of the contact for equal strains.
template <int Dim>
std::vector<double> expected(const P1Bodies<Dim>& bodies, double p) {
    const double modulus = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    std::vector<double> q(bodies.size(), 0.0);
    for (std::size_t i = 0; i < bodies.masses().size(); ++i) {
        const double jump = bodies.body_of_points()[i] == 1 ? p / pair_stiffness(bodies, 0, 1) : 0.0;
        q[i * Dim + Dim - 1] = -p / modulus * bodies.rest_positions()[i][Dim - 1] - jump;
    }
    return q;
}

template <int Dim>
double solve(const mesh::Mesh<Dim>& mesh, double p, Row& row) {
    const solid::Material material{.young = young, .poisson = poisson};
    P1Bodies<Dim> bodies({.mesh = mesh, .solid = {.materials = {material, material}}});
    const StaticState state = solve_at_rest<Dim>(bodies, load_of<Dim>(mesh, p), expected<Dim>(bodies, 0.9 * p), 1e-12);
    if (state.residual > 1e-10)
        row.remark += fmt::format("p/E = {:g}: {:.2g} of the load is not in balance after {} steps. ", p, state.residual,
                                  state.iterations);
    double error = 0.0;
    for (const Matrix<Dim>& stress : bodies.stresses(state.q))
        error = std::max(error, std::abs(stress(Dim - 1, Dim - 1) + p));
    return error / p;
}

template <int Dim>
void solve_one(bool is_structured, int cells, const Options& options, const Sink& sink) {
    Row row{.scene = "patch test",
            .setting = fmt::format("{}D {} 1/{}, 1/{}", Dim, is_structured ? "structured" : "uneven", cells, cells - 1)};
    {
        const Stopwatch clock(row.seconds);
        const auto mesh = blocks<Dim>(is_structured, cells);
        double before = 0.0;
        for (const double p : options.quick ? std::vector{1e-2, 1e-3} : std::vector{1e-2, 1e-3, 1e-4}) {
            const double error = solve<Dim>(mesh, p, row);
            const double allowed = before == 0.0 ? error_allowed : 0.11 * before;  // falls at least like p
            row.quantities.at_most(fmt::format("max |sigma + p|/p at p/E = {:g}", p), error, std::max(allowed, 1e-9));
            row.quantities.at_most(fmt::format("the same over (p/E)^2 at {:g}", p), error / (p * p));
            before = error;
        }
    }
    sink(row);
}

}  // namespace

void solve_patches(const Options& options, const Sink& sink) {
    const int plane = options.quick ? 4 : 10, space = options.quick ? 3 : 5;
    for (const bool is_structured : {true, false}) {
        solve_one<2>(is_structured, plane, options, sink);
        solve_one<3>(is_structured, space, options, sink);
    }
}

}  // namespace abut::studies::turning
