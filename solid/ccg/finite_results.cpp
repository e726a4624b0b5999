// What contact adds to cells of bodies of Kinematics::finite, and what is shown of them. docs/method.md, Bodies that bend.
#include <algorithm>
#include <utility>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/solid/ccg/edge_step.hpp"
#include "abut/solid/ccg/sweeps.hpp"

namespace abut::solid {

/// Adds what contact adds: of a cell with free faces a moment on F_cond, less what moves these from where affine ones are.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::add_moments(std::int32_t begin, std::int32_t end) {
    moments_.for_each(begin, end, [&](std::int32_t c, const CellPush<Dim>& push) {
        Matrix<Dim> added = push.affine;
        if (finite_.shows_condensed(c)) {
            const Matrix<Dim> gradient = push.condensed + push.of_moved_faces;
            added +=
                (kept_.fills_end() ? kept_.pull_back_contact(c, gradient) : pull_back(c, gradient)) - push.of_moved_faces;
        }
        LaneTensor<Dim, Real> sum = load_tensor<Dim>(work_.s, c);
        const LaneTensor<Dim> packed = load_packed<Dim>(added);
        for (int j = 0; j < Dim; ++j) sum.col[j] += element_.units.stress(packed.col[j]);
        store_tensor(sum, work_.s, c);
    });
}

/// dV/dF of a cell with free faces from dV/dF_cond, in the state or along the step that was evaluated last.
template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::pull_back(std::int32_t c, const Matrix<Dim>& gradient) const {
    const FreeCell<Dim>& free = *finite_.free_cell(c);
    const FreeEnd<Dim>& state = free_[finite_.free_position(c)];
    if (free.has_one_normal()) return state.pull_back(gradient);
    const Matrix<Dim> g = unload(load_tensor<Dim>(work_.g, c)), change = unload(change_.gradient_of_finite(c));
    return EdgeStep<Dim>(free, poisson(c), {state.swelling, state.swelling}, g, change).pull_back(gradient);
}

template <int Dim, class Real>
double CcgSweeps<Dim, Real>::poisson(std::int32_t c) const {
    return poisson_ratio(coefficients_.cells[c].lambda, coefficients_.cells[c].mu);
}

/// û_f and G_c of a boundary face and the cell behind it, as contact sees them.
template <int Dim, class Real>
std::pair<Vector<Dim>, Matrix<Dim>> CcgSweeps<Dim, Real>::tilted_face(BoundaryFace face) const {
    const std::int32_t c = arrays_.cell_of(face);
    const Vector<Dim> affine = face_displacement(face);
    const Matrix<Dim> g = unload(region_gradient(c));
    if (plastic_ && plastic_->moves_faces(c)) return {affine + plastic_->moved(c, face), g + plastic_->tilted(c)};
    const FreeCell<Dim>* free = finite_.condensed_behind(face, c);
    if (!free) return {affine, g};
    const FreeEnd<Dim>& state = free_[finite_.free_position(c)];
    const Matrix<Dim> condensed =
        free->has_one_normal() ? state.gradient() : edge_gradient<Dim>(*free, poisson(c), state.swelling, g);
    if (!finite_.is_free(face)) return {affine, condensed};
    return {affine + (condensed - g) * (free->to_faces * arrays_.normal_of(face)), condensed};
}

template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::law_gradient(std::int32_t c) const {
    const std::int32_t position = finite_.free_position(c);
    return position < 0 ? unload(load_tensor<Dim>(work_.g, c)) : free_[position].least.gradient();
}

/// At the end of the step, or in the state.
template <int Dim, class Real>
CellStretch CcgSweeps<Dim, Real>::end_stretch(std::int32_t c) const {
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    if (const ThermalStretch* stretch = finite_.stretch(c))
        return cell_stretch<3>(stretch->elastic_gradient<Dim>(law_gradient(c)));
    if (finite_.has_law(c)) return cell_stretch<Dim>(law_gradient(c));
    LaneTensor<Dim, Real> g = load_tensor<Dim>(work_.g, c);
    const LaneTensor<Dim, Real> change = change_.gradient_of_finite(c);
    for (int j = 0; j < Dim; ++j) g.col[j] += 0.5 * change.col[j];
    const FreeCell<Dim>* free = finite_.of_one_normal(c);
    return free ? condensed_stretch<Dim>(*free, contraction(cell.lambda, cell.mu), unload(g)) : cell_stretch<Dim>(unload(g));
}

template <int Dim, class Real>
FiniteExtremes CcgSweeps<Dim, Real>::finite_extremes(std::span<const std::int32_t> cells) const {
    const auto take = [](FiniteExtremes& extremes, const FiniteExtremes& other) {
        if (!(other.determinant >= extremes.determinant)) {  // or not a number
            extremes.determinant = other.determinant;
            extremes.cell = other.cell;
        }
        extremes.strain = std::max(extremes.strain, other.strain);
        extremes.plastic_strain = std::max(extremes.plastic_strain, other.plastic_strain);
    };
    std::vector<FiniteExtremes> of_part((cells.size() + parallel_grain - 1) / parallel_grain);
    parallel_parts(cells.size(), parallel_grain, [&](std::size_t begin, std::size_t end) {
        for (const std::int32_t c : cells.subspan(begin, end - begin)) {
            if (plastic_ && plastic_->contains(c))
                take(of_part[begin / parallel_grain], {1.0, 0.0, -1, plastic_->end_plastic_strain(c)});
            if (!finite_.contains(c)) continue;
            const auto [determinant, strain] = end_stretch(c);
            const std::int32_t inelastic = finite_.inelastic(c);
            const double plastic =
                inelastic < 0 ? 0.0 : finite_.inelastic_cell(inelastic).law->plastic_strain(kept_.end.memory->of(inelastic));
            take(of_part[begin / parallel_grain], {determinant, finite_.is_linear_in_strain(c) ? strain : 0.0, c, plastic});
        }
    });
    FiniteExtremes extremes;
    for (const FiniteExtremes& of : of_part) take(extremes, of);
    return extremes;
}

/// F S F^T/det F.
template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::cauchy_stress(std::int32_t c) const {
    if (finite_.has_law(c)) {
        const Matrix<Dim> f = Matrix<Dim>::Identity() + law_gradient(c);
        return law_response(c, law_gradient(c)).stress * f.transpose() / f.determinant();
    }
    const LaneTensor<Dim, Real> g = load_tensor<Dim>(work_.g, c);
    const Matrix<Dim> stress = unload(finite_stress(c, mean_green_strain(g, change_.gradient_of_finite(c))));
    Matrix<Dim> f = Matrix<Dim>::Identity();
    f += finite_.of_one_normal(c) ? free_[finite_.free_position(c)].gradient() : unload(g);
    return f * stress * f.transpose() / f.determinant();
}

template <int Dim, class Real>
double CcgSweeps<Dim, Real>::directed_out_of_plane_stress(std::int32_t c) const {
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    Matrix<Dim> strain = displacement_gradient(c);
    double volume = 1.0;
    if (finite_.contains(c)) {
        if (bears_nothing(c)) return 0.0;
        const Matrix<Dim> g = law_gradient(c);
        strain = g + 0.5 * g.transpose() * g;
        volume = (Matrix<Dim>::Identity() + g).determinant();
    }
    return (cell.lambda * strain.trace() + arrays_.directed[c].out_of_plane_stress(strain)) / volume;
}

#define ABUT_INSTANTIATE(Dim)                                                                     \
    template void CcgSweeps<Dim>::add_moments(std::int32_t, std::int32_t);                        \
    template std::pair<Vector<Dim>, Matrix<Dim>> CcgSweeps<Dim>::tilted_face(BoundaryFace) const; \
    template FiniteExtremes CcgSweeps<Dim>::finite_extremes(std::span<const std::int32_t>) const; \
    template Matrix<Dim> CcgSweeps<Dim>::law_gradient(std::int32_t) const;                        \
    template Matrix<Dim> CcgSweeps<Dim>::cauchy_stress(std::int32_t) const;                       \
    template double CcgSweeps<Dim>::directed_out_of_plane_stress(std::int32_t) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
template void CcgSweeps<2, float>::add_moments(std::int32_t, std::int32_t);
template void CcgSweeps<3, float>::add_moments(std::int32_t, std::int32_t);

}  // namespace abut::solid
