#include "studies/scenes/patch_test.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "studies/scenes/boxes.hpp"
#include "studies/scenes/dense_stiffness.hpp"

namespace abut::studies {
namespace {

constexpr double zero_limit = 1e-11;  // of the highest eigenvalue: far above rounding, far below any real mode
constexpr double tolerance = 1e-15;   // below what rounding leaves: the solution goes on until it cannot get better
constexpr int most_iterations = 20'000;

/// A x + b with A_ij = (1 + 3 i - 2 j + i j) / 100 and b_i = (i + 1) / 50.
template <int Dim>
struct AffineField {
    Matrix<Dim> gradient;
    Vector<Dim> shift;

    AffineField() {
        for (int i = 0; i < Dim; ++i) {
            shift[i] = 0.02 * (i + 1);
            for (int j = 0; j < Dim; ++j) gradient(i, j) = 0.01 * (1.0 + 3.0 * i - 2.0 * j + i * j);
        }
    }
    Vector<Dim> operator()(const Vector<Dim>& x) const { return gradient * x + shift; }
    Matrix<Dim> stress(const solid::Material& material) const {
        const Matrix<Dim> strain = 0.5 * (gradient + gradient.transpose());
        return material.lambda() * strain.trace() * Matrix<Dim>::Identity() + 2.0 * material.mu() * strain;
    }
};

/// Outward normal of a side of box_sides.
template <int Dim>
Vector<Dim> side_normal(std::size_t side) {
    return (side % 2 == 0 ? -1.0 : 1.0) * Vector<Dim>::Unit(static_cast<int>(side / 2));
}

template <int Dim>
solid::SolidOptions<Dim> patch(const AffineField<Dim>& field, PatchBoundary boundary, solid::FreeFaceRule free_faces) {
    solid::SolidOptions<Dim> options;
    options.materials = {{.young = 70e3, .poisson = 0.3}};
    options.boundary.free_face_rule = free_faces;
    options.boundary.dirichlet = whole_boundary<Dim>([field](double, const Vector<Dim>& x) { return field(x); });
    if (boundary == PatchBoundary::displacement) return options;
    options.boundary.dirichlet.resize(2);
    const auto sides = box_sides<Dim>();
    for (std::size_t side = 2; side < sides.size(); ++side)
        options.boundary.traction.push_back(
            {.group = sides[side], .value = field.stress(options.materials[0]) * side_normal<Dim>(side)});
    return options;
}

template <int Dim>
BulkPatchErrors errors(const AffineField<Dim>& field, solid::Solid<Dim>& solid, std::span<const double> q) {
    const auto u = as_vectors<Dim>(q);
    const Matrix<Dim> stress = field.stress(solid.options().materials[0]);
    static_cast<void>(solid.potential(q));  // fills the stress of the cells
    double size = 0.0, displacement = 0.0, worst_stress = 0.0;
    for (std::int32_t c = 0; c < solid.mesh().n_cells(); ++c) {
        const Vector<Dim> exact = field(solid.mesh().cell_centroid[static_cast<std::size_t>(c)]);
        size = std::max(size, exact.norm());
        displacement = std::max(displacement, (u[static_cast<std::size_t>(c)] - exact).norm());
        worst_stress = std::max(worst_stress, (solid.ccg().stress(c) - stress).norm());
    }
    return {.displacement = displacement / size, .stress = worst_stress / stress.norm(), .report = {}};
}

}  // namespace

template <int Dim>
BulkPatchErrors patch_test(const mesh::Mesh<Dim>& box, PatchBoundary boundary, solid::FreeFaceRule free_faces) {
    const AffineField<Dim> field;
    solid::Solid<Dim> solid(box, patch(field, boundary, free_faces));
    const auto solution = solid::solve_statics(solid, std::vector<double>(solid.size(), 0.0),
                                               {.tolerance = tolerance, .iterations = most_iterations});
    BulkPatchErrors result = errors(field, solid, solution.q);
    result.report = solution.report;
    return result;
}

template <int Dim>
double single_precision_force(const mesh::Mesh<Dim>& box, PatchBoundary boundary, solid::FreeFaceRule free_faces) {
    const AffineField<Dim> field;
    solid::SolidOptions<Dim> options = patch(field, boundary, free_faces);
    options.precision = solid::Precision::single_precision;
    const double stress = field.stress(options.materials[0]).norm();
    solid::Solid<Dim> solid(box, std::move(options));
    std::vector<Vector<Dim>> u, force(box.cell_centroid.size());
    for (const Vector<Dim>& x : box.cell_centroid) u.push_back(field(x));
    solid.ccg().step_gradient(u, solid.ccg().load_at(0.0, 0.0), {}, force);
    double worst = 0.0;
    for (const Vector<Dim>& of_cell : force) worst = std::max(worst, of_cell.norm());
    return worst / (stress * std::ranges::max(box.face_measure));
}

template <int Dim>
ZeroModes zero_modes(const mesh::Mesh<Dim>& mesh, solid::FreeFaceRule free_faces) {
    solid::SolidOptions<Dim> options;
    options.materials = {{.young = 1.0, .poisson = 0.3}};
    options.boundary.free_face_rule = free_faces;
    solid::Solid<Dim> solid(mesh, options);
    const Eigen::MatrixXd k = dense_stiffness(solid);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (k + k.transpose()), Eigen::EigenvaluesOnly);
    if (solver.info() != Eigen::Success)
        throw std::runtime_error(mesh.name + ": the eigenvalues of the stiffness were not found. Take another mesh.");
    std::vector<double> sizes;
    for (const double value : solver.eigenvalues()) sizes.push_back(std::abs(value));
    std::sort(sizes.begin(), sizes.end());
    const double highest = sizes.back();
    const auto next = std::upper_bound(sizes.begin(), sizes.end(), zero_limit * highest);
    return {.count = static_cast<int>(next - sizes.begin()),
            .largest_zero = next == sizes.begin() ? 0.0 : *(next - 1) / highest,
            .next = *next / highest};
}

template BulkPatchErrors patch_test(const mesh::Mesh<2>&, PatchBoundary, solid::FreeFaceRule);
template BulkPatchErrors patch_test(const mesh::Mesh<3>&, PatchBoundary, solid::FreeFaceRule);
template double single_precision_force(const mesh::Mesh<2>&, PatchBoundary, solid::FreeFaceRule);
template double single_precision_force(const mesh::Mesh<3>&, PatchBoundary, solid::FreeFaceRule);
template ZeroModes zero_modes(const mesh::Mesh<2>&, solid::FreeFaceRule);
template ZeroModes zero_modes(const mesh::Mesh<3>&, solid::FreeFaceRule);

}  // namespace abut::studies
