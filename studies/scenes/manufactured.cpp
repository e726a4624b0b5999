#include "studies/scenes/manufactured.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "abut/base/quadrature.hpp"
#include "studies/scenes/boxes.hpp"

namespace abut::studies {
namespace {

constexpr double amplitude = 0.8, young = 70e3, poisson = 0.3;

double det(const Vector<2>& a, const Vector<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Points and weights of the triangle between a cell's centre and one of its edges.
template <class Visit>
void visit_cone(const mesh::Mesh<2>& mesh, const Vector<2>& apex, std::span<const std::int32_t> edge, const Visit& visit) {
    const auto rule = gauss_legendre(3);
    const Vector<2> a = mesh.vertices[static_cast<std::size_t>(edge[0])] - apex;
    const Vector<2> b = mesh.vertices[static_cast<std::size_t>(edge[1])] - apex;
    const double measure = std::abs(det(a, b));
    for (int i = 0; i < rule.size; ++i)
        for (int j = 0; j < rule.size; ++j) {
            const double r = rule.node[i], s = rule.node[j];
            visit(Vector<2>(apex + r * (a + s * (b - a))), measure * r * rule.weight[i] * rule.weight[j]);
        }
}

/// The same of the pyramid between a cell's centre and one of its faces, a tetrahedron at a time.
template <class Visit>
void visit_cone(const mesh::Mesh<3>& mesh, const Vector<3>& apex, std::span<const std::int32_t> face, const Visit& visit) {
    const auto rule = gauss_legendre(3);
    const auto corner = [&](std::size_t i) { return Vector<3>(mesh.vertices[static_cast<std::size_t>(face[i])] - apex); };
    for (std::size_t v = 1; v + 1 < face.size(); ++v) {
        const Vector<3> a = corner(0), b = corner(v), c = corner(v + 1);
        const double measure = std::abs(a.dot(b.cross(c)));
        for (int i = 0; i < rule.size; ++i)
            for (int j = 0; j < rule.size; ++j)
                for (int k = 0; k < rule.size; ++k) {
                    const double r = rule.node[i], t = rule.node[j], s = rule.node[k];
                    const double weight = r * r * t * rule.weight[i] * rule.weight[j] * rule.weight[k];
                    visit(Vector<3>(apex + r * (a + t * (b - a + s * (c - b)))), measure * weight);
                }
    }
}

/// Integrates over a cell: exact for polynomials of degree 4 (2D) and 3 (3D).
template <int Dim, class Visit>
void visit_cell(const mesh::Mesh<Dim>& mesh, std::int32_t cell, const Visit& visit) {
    for (const std::int32_t face : mesh.cell_faces[cell])
        visit_cone(mesh, mesh.cell_centroid[static_cast<std::size_t>(cell)], mesh.face_vertices[face], visit);
}

/// G:C:G of the symmetric part [Pa].
template <int Dim>
double energy_density(const solid::Material& material, const Matrix<Dim>& gradient) {
    const Matrix<Dim> strain = 0.5 * (gradient + gradient.transpose());
    return material.lambda() * strain.trace() * strain.trace() + 2.0 * material.mu() * strain.squaredNorm();
}

/// Part of V beyond the elastic energy of the cells, twice it being the sum of |f| eta/h_f |[u]_f|^2 [J].
template <int Dim>
double stabilisation_energy(const Manufactured<Dim>& exact, solid::Solid<Dim>& solid, std::span<const double> q) {
    const auto u = as_vectors<Dim>(q);
    double rest = solid.potential(q);
    for (std::int32_t c = 0; c < solid.mesh().n_cells(); ++c) {
        const auto i = static_cast<std::size_t>(c);
        const double load = exact.body_load(solid.mesh().cell_centroid[i]).dot(u[i]);
        const double elastic = 0.5 * energy_density<Dim>(exact.material, solid.ccg().displacement_gradient(c));
        rest += solid.mesh().cell_measure[i] * (load - elastic);
    }
    return std::max(0.0, rest);
}

template <int Dim>
StaticErrors errors(const Manufactured<Dim>& exact, solid::Solid<Dim>& solid, std::span<const double> q) {
    const auto u = as_vectors<Dim>(q);
    double size = 0.0, error = 0.0, energy = 0.0;
    double energy_error = 2.0 * stabilisation_energy(exact, solid, q);
    for (std::int32_t c = 0; c < solid.mesh().n_cells(); ++c) {
        const Matrix<Dim> gradient = solid.ccg().displacement_gradient(c);
        const auto i = static_cast<std::size_t>(c);
        visit_cell(solid.mesh(), c, [&](const Vector<Dim>& x, double weight) {
            const Vector<Dim> computed = u[i] + gradient * (x - solid.mesh().cell_centroid[i]);
            size += weight * exact.displacement(x).squaredNorm();
            error += weight * (computed - exact.displacement(x)).squaredNorm();
            energy += weight * energy_density<Dim>(exact.material, exact.gradient(x));
            energy_error += weight * energy_density<Dim>(exact.material, gradient - exact.gradient(x));
        });
    }
    return {.displacement = std::sqrt(error / size), .energy = std::sqrt(energy_error / energy), .report = {}};
}

}  // namespace

template <int Dim>
Vector<Dim> Manufactured<Dim>::body_load(const Vector<Dim>& x) const {
    const Matrix<Dim> h = curvature(x);
    const double lambda = material.lambda(), mu = material.mu();
    return -amplitude * ((lambda + mu) * (h * direction) + mu * h.trace() * direction);
}

template <>
Manufactured<2> manufactured<2>() {
    return {.formula = "u = (a/2) (x^2 + y^2) (1, 1)",
            .material = {.young = young, .poisson = poisson},
            .amplitude = amplitude,
            .direction = Vector<2>(1.0, 1.0),
            .shape = [](const Vector<2>& x) { return 0.5 * x.squaredNorm(); },
            .slope = [](const Vector<2>& x) { return x; },
            .curvature = [](const Vector<2>&) { return Matrix<2>::Identity(); }};
}

template <>
Manufactured<3> manufactured<3>() {
    const auto phi = [](const Vector<3>& x) { return std::sin(2.0 * x[0]) * std::cos(x[1]) * std::exp(0.5 * x[2]); };
    const auto slope = [phi](const Vector<3>& x) {
        const double e = std::exp(0.5 * x[2]);
        return Vector<3>(2.0 * std::cos(2.0 * x[0]) * std::cos(x[1]) * e, -std::sin(2.0 * x[0]) * std::sin(x[1]) * e,
                         0.5 * phi(x));
    };
    const auto curvature = [phi, slope](const Vector<3>& x) {
        const Vector<3> g = slope(x);
        const double f = phi(x), mixed = -2.0 * std::cos(2.0 * x[0]) * std::sin(x[1]) * std::exp(0.5 * x[2]);
        return Matrix<3>{{-4.0 * f, mixed, 0.5 * g[0]}, {mixed, -f, 0.5 * g[1]}, {0.5 * g[0], 0.5 * g[1], 0.25 * f}};
    };
    return {.formula = "u = (a/2) sin 2x cos y exp(z/2) (1, 2, -1)",
            .material = {.young = young, .poisson = poisson},
            .amplitude = amplitude,
            .direction = Vector<3>(0.5, 1.0, -0.5),
            .shape = phi,
            .slope = slope,
            .curvature = curvature};
}

template <int Dim>
StaticErrors solve_manufactured(const Manufactured<Dim>& exact, const mesh::Mesh<Dim>& box,
                                const solid::StaticOptions& options) {
    solid::SolidOptions<Dim> scene;
    scene.materials = {exact.material};
    scene.boundary.dirichlet = whole_boundary<Dim>([&exact](double, const Vector<Dim>& x) { return exact.displacement(x); });
    scene.body_load = [&exact](const Vector<Dim>& x) { return exact.body_load(x); };
    solid::Solid<Dim> solid(box, scene);
    const auto solution = solid::solve_statics(solid, std::vector<double>(solid.size(), 0.0), options);
    if (!solution.report.converged)
        throw std::runtime_error(fmt::format(
            "{} with {} cells: the residual is {:.2g} after {} evaluations, {:.2g} is allowed: {} Raise the tolerance.",
            box.name, box.n_cells(), solution.report.residual, solution.report.evaluations, options.tolerance,
            solution.report.ending));
    StaticErrors result = errors(exact, solid, solution.q);
    result.report = solution.report;
    return result;
}

template struct Manufactured<2>;
template struct Manufactured<3>;
template StaticErrors solve_manufactured(const Manufactured<2>&, const mesh::Mesh<2>&, const solid::StaticOptions&);
template StaticErrors solve_manufactured(const Manufactured<3>&, const mesh::Mesh<3>&, const solid::StaticOptions&);

}  // namespace abut::studies
