#include <algorithm>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/solid/ccg/sweeps.hpp"

// What the sweeps do with the cells of bodies of Kinematics::finite. docs/method.md, Bodies that bend.

namespace abut::solid {

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::load_change(const StepEnds<Dim>& ends) {
    has_change_ = finite_.any() && !ends.start.empty();
    if (!has_change_) return;
    parallel_each(arrays_.n_cells(), [&](std::ptrdiff_t c) {
        store(load_packed<Dim>(ends.end[c]) - load_packed<Dim>(ends.start[c]), u_change_, c);
    });
}

/// Of û_f - u_c; prescribed displacements do not change.
template <int Dim, class Real>
Lanes<Dim, Real> CcgSweeps<Dim, Real>::boundary_change(BoundaryFace face) const {
    const BoundaryReconstruction<Dim>& boundary = arrays_.boundary;
    const Lanes<Dim, Real> origin = load_packed<Dim>(u_change_, arrays_.cell_of(face));
    const std::int32_t b = number_of(face);
    Lanes<Dim, Real> sum;
    for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
        sum += coefficients_.boundary_weights[i] * (load_packed<Dim>(u_change_, boundary.cells[i]) - origin);
    return sum - load_packed<Dim>(Vector<Dim>(boundary.deficit[b] * unload<Dim>(origin)));
}

/// S of the Green strain E, with the free faces where the energy of the cell is least.
template <int Dim, class Real>
LaneTensor<Dim, Real> CcgSweeps<Dim, Real>::finite_stress(std::ptrdiff_t c, const LaneTensor<Dim, Real>& strain) const {
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    const std::int32_t position = finite_.free_position(c);
    if (position < 0) return svk_stress(cell, strain);
    return load_packed<Dim>(condensed_stress(finite_.free()[position], cell.lambda, cell.mu, unload(strain)));
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_finite_displacement_gradient(std::ptrdiff_t c) {
    const LaneTensor<Dim, Real> g =
        element_.gradient_of(u_.data(), c, [&](std::int32_t f) { return load_packed<Dim>(of_face_, f); });
    LaneTensor<Dim, Real> change{};
    if (has_change_)
        change =
            element_.gradient_of(u_change_.data(), c, [&](std::int32_t f) { return load_packed<Dim>(relative_change_, f); });
    store_tensor(g, g_, c);
    store_tensor(change, g_change_, c);
    const FreeCell<Dim>* free = finite_.condensed(c);
    if (!free) return element_.set_traces(c, g);
    CondensedStep<Dim>& step = condensed_[finite_.free_position(c)];
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    step = CondensedStep<Dim>(*free, contraction(cell.lambda, cell.mu), unload(g), unload(change));
    element_.set_traces(c, load_packed<Dim>(step.mean()));
}

/// F S, both means of the ends of the step, and what the jumps add.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_finite_stress(std::ptrdiff_t c) {
    LaneTensor<Dim, Real> sum = element_.sum_jumps(c);
    if (finite_.condensed(c)) sum = load_packed<Dim>(condensed_[finite_.free_position(c)].pull_back(unload(sum)));
    const LaneTensor<Dim, Real> g = load_tensor<Dim>(g_, c);
    const LaneTensor<Dim, Real> stress = finite_stress(c, mean_green_strain(g, load_tensor<Dim>(g_change_, c)));
    for (int j = 0; j < Dim; ++j) sum.col[j] += stress.col[j] + g * stress.col[j];
    store_tensor(sum, s_, c);
}

/// What contact adds: of a cell whose gradient is F_cond a moment on that, less what moves the free face from where the affine
/// one is.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::add_moments(std::int32_t begin, std::int32_t end) {
    moments_.for_each(begin, end, [&](std::int32_t c, const LaneTensor<Dim>& moment, const Matrix<Dim>& normal_push) {
        LaneTensor<Dim, Real> sum = load_tensor<Dim>(s_, c);
        LaneTensor<Dim> added = moment;
        if (finite_.condensed(c)) {
            const CondensedStep<Dim>& step = condensed_[finite_.free_position(c)];
            added = load_packed<Dim>(Matrix<Dim>(step.pull_back(unload(moment) + normal_push) - normal_push));
        }
        for (int j = 0; j < Dim; ++j) sum.col[j] += element_.units.stress(added.col[j]);
        store_tensor(sum, s_, c);
    });
}

/// û_f and G_c of a boundary face and the cell behind it, as contact sees them.
template <int Dim, class Real>
std::pair<Vector<Dim>, Matrix<Dim>> CcgSweeps<Dim, Real>::tilted_face(BoundaryFace face) const {
    const std::int32_t c = arrays_.cell_of(face);
    const Vector<Dim> affine = face_displacement(face);
    const Matrix<Dim> g = displacement_gradient(c);
    const FreeCell<Dim>* free = finite_.condensed(c);
    if (!free) return {affine, g};
    const Matrix<Dim>& condensed = condensed_[finite_.free_position(c)].mean();
    return {affine + free->measure_over * ((condensed - g) * arrays_.normal_of(face)), condensed};
}

/// At the end of the step, or in the state.
template <int Dim, class Real>
CellStretch CcgSweeps<Dim, Real>::end_stretch(std::ptrdiff_t c) const {
    const CellGeometry<Dim, Real>& cell = coefficients_.cells[c];
    LaneTensor<Dim, Real> g = load_tensor<Dim>(g_, c);
    const LaneTensor<Dim, Real> change = load_tensor<Dim>(g_change_, c);
    for (int j = 0; j < Dim; ++j) g.col[j] += 0.5 * change.col[j];
    const FreeCell<Dim>* free = finite_.condensed(c);
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
    };
    std::vector<FiniteExtremes> of_part((cells.size() + parallel_grain - 1) / parallel_grain);
    parallel_parts(cells.size(), parallel_grain, [&](std::size_t begin, std::size_t end) {
        for (const std::int32_t c : cells.subspan(begin, end - begin)) {
            if (!finite_.contains(c)) continue;
            const auto [determinant, strain] = end_stretch(c);
            take(of_part[begin / parallel_grain], {determinant, strain, c});
        }
    });
    FiniteExtremes extremes;
    for (const FiniteExtremes& of : of_part) take(extremes, of);
    return extremes;
}

/// F S F^T/det F.
template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::cauchy_stress(std::int32_t c) const {
    const LaneTensor<Dim, Real> g = load_tensor<Dim>(g_, c);
    const Matrix<Dim> stress = unload(finite_stress(c, mean_green_strain(g, load_tensor<Dim>(g_change_, c))));
    Matrix<Dim> f = Matrix<Dim>::Identity();
    f += finite_.condensed(c) ? condensed_[finite_.free_position(c)].mean() : unload(g);
    return f * stress * f.transpose() / f.determinant();
}

#define ABUT_INSTANTIATE(Dim)                                                                             \
    template void CcgSweeps<Dim>::load_change(const StepEnds<Dim>&);                                      \
    template Lanes<Dim> CcgSweeps<Dim>::boundary_change(BoundaryFace) const;                              \
    template LaneTensor<Dim> CcgSweeps<Dim>::finite_stress(std::ptrdiff_t, const LaneTensor<Dim>&) const; \
    template void CcgSweeps<Dim>::set_finite_displacement_gradient(std::ptrdiff_t);                       \
    template void CcgSweeps<Dim>::set_finite_stress(std::ptrdiff_t);                                      \
    template void CcgSweeps<Dim>::add_moments(std::int32_t, std::int32_t);                                \
    template std::pair<Vector<Dim>, Matrix<Dim>> CcgSweeps<Dim>::tilted_face(BoundaryFace) const;         \
    template FiniteExtremes CcgSweeps<Dim>::finite_extremes(std::span<const std::int32_t>) const;         \
    template Matrix<Dim> CcgSweeps<Dim>::cauchy_stress(std::int32_t) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
template void CcgSweeps<2, float>::add_moments(std::int32_t, std::int32_t);
template void CcgSweeps<3, float>::add_moments(std::int32_t, std::int32_t);

}  // namespace abut::solid
