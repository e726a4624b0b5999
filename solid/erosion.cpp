#include "abut/solid/erosion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "abut/base/decompositions.hpp"
#include "abut/base/parallel.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/operator/joined_cells.hpp"
#include "abut/solid/options/made_features.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

template <int Dim>
double largest_eigenvalue(const Matrix<Dim>& symmetric) {
    return symmetric_eigenvalues(symmetric)[Dim - 1];
}

template <int Dim>
double largest_principal_strain(const Matrix<Dim>& g, bool is_finite) {
    if (!is_finite) return largest_eigenvalue<Dim>(0.5 * (g + g.transpose()));
    const Matrix<Dim> f = Matrix<Dim>::Identity() + g;
    return std::sqrt(largest_eigenvalue<Dim>(f.transpose() * f)) - 1.0;
}

template <int Dim>
double largest_principal_stress(const Solid<Dim>& solid, std::int32_t cell) {
    const double in_plane = largest_eigenvalue<Dim>(solid.cells().stress(cell));
    return Dim == 2 ? std::max(in_plane, solid.cells().out_of_plane_stress(cell)) : in_plane;
}

constexpr std::ptrdiff_t cells_of_a_task = 256;
constexpr double every_cell = -1.0;  // a limit that all strains are beyond

/// Norm of a strain below which no stress of the body reaches the limit [-]; `every_cell` where none is known.
template <int Dim>
double harmless_strain(const SolidOptions<Dim>& options, std::size_t body, double stress) {
    constexpr double small = 0.1;             // where laws of large strains differ little from the linear one
    constexpr double of_large_strains = 3.0;  // at most times the stress of the linear law there
    const Material& material = options.materials[body];
    const FeatureSet features = features_of(options, body);
    const bool has_own_law = body < options.finite.stored_energy.size() && options.finite.stored_energy[body];
    if (!material.is_isotropic() || features.has(Feature::flow) || features.has(Feature::temperature) || has_own_law)
        return every_cell;
    const double linear = stress / (2.0 * material.mu() + std::max(0.0, material.lambda()) * std::sqrt(double{Dim}));
    return properties_of(options.kinematics, body).finite_strains ? std::min(small, linear / of_large_strains) : linear;
}

/// By body that deforms: norm of the strain below which no cell need be looked at [-].
template <int Dim>
std::vector<double> harmless_strains(const Solid<Dim>& solid) {
    const SolidOptions<Dim>& options = solid.options();
    const double largest_plastic = solid.cells().finite_extremes().plastic_strain;
    std::vector<double> limits;
    for (std::size_t body = 0; body < options.erosion.size(); ++body) {
        if (!properties_of(options.kinematics, body).deforms) continue;
        const ErosionLimits& of_body = options.erosion[body];
        double limit = of_body.strain;
        if (of_body.stress < ErosionLimits::none) limit = std::min(limit, harmless_strain(options, body, of_body.stress));
        if (largest_plastic >= of_body.plastic_strain) limit = every_cell;
        limits.push_back(limit);
    }
    return limits;
}

template <int Dim>
std::optional<LeavingReason> reason_to_leave(const Solid<Dim>& solid, const ErosionLimits& limits, bool is_finite,
                                             std::int32_t cell, std::int32_t of_operators) {
    if (limits.strain < ErosionLimits::none &&
        largest_principal_strain<Dim>(solid.ccg().displacement_gradient(of_operators), is_finite) >= limits.strain)
        return LeavingReason::strain;
    if (limits.plastic_strain < ErosionLimits::none && solid.cells().plastic_strain(cell) >= limits.plastic_strain)
        return LeavingReason::plastic_strain;
    if (limits.stress < ErosionLimits::none && largest_principal_stress(solid, cell) >= limits.stress)
        return LeavingReason::stress;
    return std::nullopt;
}

/// Whether centroids span a simplex that is not flat, seen from the first of them.
template <int Dim>
bool span_simplex(const mesh::Mesh<Dim>& mesh, std::span<const std::int32_t> cells) {
    constexpr double flat = 0.05;  // of the size of the first cell: heights of the simplex
    const Vector<Dim>& origin = mesh.cell_centroid[static_cast<std::size_t>(cells[0])];
    const double least = flat * std::pow(mesh.cell_measure[static_cast<std::size_t>(cells[0])], 1.0 / Dim);
    std::vector<Vector<Dim>> directions;
    for (int i = 0; i < Dim; ++i) {
        Vector<Dim> farthest = Vector<Dim>::Zero();
        for (const std::int32_t cell : cells) {
            Vector<Dim> arm = mesh.cell_centroid[static_cast<std::size_t>(cell)] - origin;
            for (const Vector<Dim>& direction : directions) arm -= arm.dot(direction) * direction;
            if (arm.norm() > farthest.norm()) farthest = arm;
        }
        if (farthest.norm() < least) return false;
        directions.push_back(farthest.normalized());
    }
    return true;
}

}  // namespace

template <int Dim>
std::vector<LeavingCell> cells_beyond_limits(const Solid<Dim>& solid) {
    const SolidOptions<Dim>& options = solid.options();
    if (!any_erosion(options.erosion)) return {};
    const std::vector<std::int32_t> strained = solid.ccg().strained_beyond(harmless_strains(solid));
    std::vector<std::optional<LeavingReason>> reasons(strained.size());
    parallel_each(
        std::ssize(strained),
        [&](std::ptrdiff_t i) {
            const std::int32_t of_operators = strained[static_cast<std::size_t>(i)],
                               cell = solid.cells().of_mesh(of_operators);
            const auto body = static_cast<std::size_t>(solid.mesh().cell_body[static_cast<std::size_t>(cell)]);
            const bool is_finite = properties_of(options.kinematics, body).finite_strains;
            reasons[static_cast<std::size_t>(i)] =
                reason_to_leave(solid, options.erosion[body], is_finite, cell, of_operators);
        },
        cells_of_a_task);
    std::vector<LeavingCell> leaving;
    for (std::size_t i = 0; i < strained.size(); ++i)
        if (reasons[i]) leaving.push_back({solid.cells().of_mesh(strained[i]), *reasons[i]});
    return leaving;
}

template <int Dim>
std::vector<std::int32_t> remnants(const Solid<Dim>& solid, std::span<const std::int32_t> leaving) {
    const mesh::Mesh<Dim>& mesh = solid.mesh();
    std::vector<char> is_gone(mesh.cell_measure.size(), 0);
    for (const std::int32_t cell : leaving) is_gone[static_cast<std::size_t>(cell)] = 1;
    const auto all = [] { return false; };
    const std::vector<char> none_is_gone;
    JoinedCells<Dim> before(mesh, none_is_gone), joined(mesh, is_gone);
    const auto deforms = [&](std::int32_t cell) {
        return properties_of(solid.options().kinematics,
                             static_cast<std::size_t>(mesh.cell_body[static_cast<std::size_t>(cell)]))
            .deforms;
    };
    std::vector<std::int32_t> remnants, asked(leaving.begin(), leaving.end());
    while (!asked.empty()) {
        std::vector<std::int32_t> near;
        for (const std::int32_t cell : asked)
            for (const std::int32_t other : before.around(cell, all))
                if (is_gone[static_cast<std::size_t>(other)] == 0 && deforms(other)) near.push_back(other);
        std::ranges::sort(near);
        near.erase(std::ranges::unique(near).begin(), near.end());
        std::erase_if(near, [&](std::int32_t cell) { return span_simplex<Dim>(mesh, joined.around(cell, all)); });
        for (const std::int32_t cell : near) is_gone[static_cast<std::size_t>(cell)] = 1;
        remnants.insert(remnants.end(), near.begin(), near.end());
        asked = std::move(near);
    }
    std::ranges::sort(remnants);
    return remnants;
}

#define ABUT_INSTANTIATE(Dim)                                                      \
    template std::vector<LeavingCell> cells_beyond_limits<Dim>(const Solid<Dim>&); \
    template std::vector<std::int32_t> remnants<Dim>(const Solid<Dim>&, std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
