// What contact and memory take and give of finite bodies, and what is shown of them. docs/method.md, Bodies that bend.
#include <algorithm>

#include "abut/solid/cells/edge_step.hpp"
#include "abut/solid/cells/finite_pool.hpp"
#include "abut/solid/operator/largest_strain.hpp"

namespace abut::solid {

// Contact ------------------------------------------------------------------------------------------------------------

template <int Dim>
Matrix<Dim> FinitePool<Dim>::pull_back_contact(std::int32_t c, const Matrix<Dim>& gradient) {
    return kept_.fills_end() ? kept_.pull_back_contact(c, gradient) : pull_back(c, gradient);
}

/// dV/dF of a cell with free faces from dV/dF_cond, in the state or along the step that was evaluated last.
template <int Dim>
Matrix<Dim> FinitePool<Dim>::pull_back(std::int32_t c, const Matrix<Dim>& gradient) const {
    const FreeCell<Dim>& free = *cells_.free_cell(c);
    const FreeEnd<Dim>& state = free_[static_cast<std::size_t>(cells_.free_position(c))];
    if (free.has_one_normal()) return state.pull_back(gradient);
    const Matrix<Dim> g = unload(load_tensor<Dim>(state_.work.g, c));
    const Matrix<Dim> change = unload(state_.change.gradient_of_finite(c));
    return EdgeStep<Dim>(free, poisson(c), {state.swelling, state.swelling}, g, change).pull_back(gradient);
}

template <int Dim>
double FinitePool<Dim>::poisson(std::int32_t c) const {
    return poisson_ratio(state_.coefficients.cells[c].lambda, state_.coefficients.cells[c].mu);
}

template <int Dim>
std::pair<Vector<Dim>, Matrix<Dim>> FinitePool<Dim>::tilted_face(BoundaryFace face, const Vector<Dim>& affine,
                                                                 const Matrix<Dim>& g) const {
    const std::int32_t c = state_.arrays.cell_of(face);
    const FreeCell<Dim>* free = cells_.condensed_behind(face, c);
    if (!free) return {affine, g};
    const FreeEnd<Dim>& state = free_[static_cast<std::size_t>(cells_.free_position(c))];
    const Matrix<Dim> condensed =
        free->has_one_normal() ? state.gradient() : edge_gradient<Dim>(*free, poisson(c), state.swelling, g);
    if (!cells_.is_free(face)) return {affine, condensed};
    return {affine + (condensed - g) * (free->to_faces * state_.arrays.normal_of(face)), condensed};
}

// Memory -------------------------------------------------------------------------------------------------------------

template <int Dim>
std::int32_t FinitePool<Dim>::memory_size(std::ptrdiff_t c) const {
    const std::int32_t inelastic = cells_.inelastic(c);
    if (inelastic < 0) return 0;
    const auto& cell = cells_.inelastic_cell(inelastic);
    return static_cast<std::int32_t>(cell.end - cell.begin);
}

template <int Dim>
void FinitePool<Dim>::put_memory(std::ptrdiff_t c, std::vector<double>& values) const {
    const std::int32_t inelastic = cells_.inelastic(c);
    if (inelastic < 0) return;
    const auto& cell = cells_.inelastic_cell(inelastic);
    const std::span<const double> all = kept_.here().memory->values();
    values.insert(values.end(), all.begin() + cell.begin, all.begin() + cell.end);
}

/// A cell that has gained or lost free faces lacks its shape on one side: only the numbers that both sides have are taken.
template <int Dim>
void FinitePool<Dim>::set_memory(std::ptrdiff_t c, std::span<const double> values) {
    const std::int32_t inelastic = cells_.inelastic(c);
    if (inelastic < 0) return;
    const auto& cell = cells_.inelastic_cell(inelastic);
    const std::ptrdiff_t size = std::min(cell.end - cell.begin, std::ssize(values));
    for (KeptEnd<Dim>* kept : {&kept_.start, &kept_.end})
        std::copy_n(values.begin(), size, kept->memory->values().begin() + cell.begin);
}

template <int Dim>
bool FinitePool<Dim>::remembers_as(std::ptrdiff_t c, const FinitePool& other, std::ptrdiff_t other_cell) const {
    const std::int32_t own = cells_.inelastic(c), of_other = other.cells_.inelastic(other_cell);
    if (own < 0 || of_other < 0) return own < 0 && of_other < 0;
    return *cells_.inelastic_cell(own).kind == *other.cells_.inelastic_cell(of_other).kind;
}

template <int Dim>
void FinitePool<Dim>::forget_ends() {
    kept_.start.is_set = kept_.end.is_set = false;
    kept_.drop();
}

// Results ------------------------------------------------------------------------------------------------------------

template <int Dim>
double FinitePool<Dim>::largest_strain(std::int32_t begin, std::int32_t end) const {
    return largest_root<Dim>(state_.work.g, begin, end, [](const auto& g) { return squared_green_strain<Dim>(g); });
}

template <int Dim>
double FinitePool<Dim>::twice_energy_density(std::int32_t c) const {
    const Tensor g = load_tensor<Dim>(state_.work.g, c);
    if (cells_.has_law(c)) return 2.0 * law_response(c, unload(g)).energy;
    const Tensor strain = green_strain(g), stress = elastic_stress_of(c, strain);
    double density = 0.0;
    for (int j = 0; j < Dim; ++j) density += dot(stress.col[j], strain.col[j]);
    return density;
}

template <int Dim>
Matrix<Dim> FinitePool<Dim>::law_gradient(std::int32_t c) const {
    const std::int32_t position = cells_.free_position(c);
    return position < 0 ? unload(load_tensor<Dim>(state_.work.g, c))
                        : free_[static_cast<std::size_t>(position)].least.gradient();
}

template <int Dim>
CellStretch FinitePool<Dim>::end_stretch(std::int32_t c) const {
    const CellGeometry<Dim>& cell = state_.coefficients.cells[c];
    if (const ThermalStretch* stretch = cells_.stretch(c))
        return cell_stretch<3>(stretch->elastic_gradient<Dim>(law_gradient(c)));
    if (cells_.has_law(c)) return cell_stretch<Dim>(law_gradient(c));
    Tensor g = load_tensor<Dim>(state_.work.g, c);
    const Tensor change = state_.change.gradient_of_finite(c);
    for (int j = 0; j < Dim; ++j) g.col[j] += 0.5 * change.col[j];
    const FreeCell<Dim>* free = cells_.of_one_normal(c);
    return free ? condensed_stretch<Dim>(*free, contraction(cell.lambda, cell.mu), unload(g)) : cell_stretch<Dim>(unload(g));
}

template <int Dim>
double FinitePool<Dim>::end_plastic_strain(std::int32_t c) const {
    const std::int32_t inelastic = cells_.inelastic(c);
    if (inelastic < 0) return 0.0;
    return cells_.inelastic_cell(inelastic).law->plastic_strain(kept_.end.memory->of(inelastic));
}

/// F S F^T/det F.
template <int Dim>
Matrix<Dim> FinitePool<Dim>::cauchy_stress(std::int32_t c) const {
    if (cells_.has_law(c)) {
        const Matrix<Dim> f = Matrix<Dim>::Identity() + law_gradient(c);
        return law_response(c, law_gradient(c)).stress * f.transpose() / f.determinant();
    }
    const Tensor g = load_tensor<Dim>(state_.work.g, c);
    const Matrix<Dim> stress = unload(elastic_stress_of(c, mean_green_strain(g, state_.change.gradient_of_finite(c))));
    Matrix<Dim> f = Matrix<Dim>::Identity();
    f += cells_.of_one_normal(c) ? free_[static_cast<std::size_t>(cells_.free_position(c))].gradient() : unload(g);
    return f * stress * f.transpose() / f.determinant();
}

#define ABUT_INSTANTIATE(Dim)                                                                                   \
    template Matrix<Dim> FinitePool<Dim>::pull_back_contact(std::int32_t, const Matrix<Dim>&);                  \
    template std::pair<Vector<Dim>, Matrix<Dim>> FinitePool<Dim>::tilted_face(BoundaryFace, const Vector<Dim>&, \
                                                                              const Matrix<Dim>&) const;        \
    template std::int32_t FinitePool<Dim>::memory_size(std::ptrdiff_t) const;                                   \
    template void FinitePool<Dim>::put_memory(std::ptrdiff_t, std::vector<double>&) const;                      \
    template void FinitePool<Dim>::set_memory(std::ptrdiff_t, std::span<const double>);                         \
    template bool FinitePool<Dim>::remembers_as(std::ptrdiff_t, const FinitePool&, std::ptrdiff_t) const;       \
    template void FinitePool<Dim>::forget_ends();                                                               \
    template double FinitePool<Dim>::largest_strain(std::int32_t, std::int32_t) const;                          \
    template double FinitePool<Dim>::twice_energy_density(std::int32_t) const;                                  \
    template Matrix<Dim> FinitePool<Dim>::law_gradient(std::int32_t) const;                                     \
    template CellStretch FinitePool<Dim>::end_stretch(std::int32_t) const;                                      \
    template double FinitePool<Dim>::end_plastic_strain(std::int32_t) const;                                    \
    template Matrix<Dim> FinitePool<Dim>::cauchy_stress(std::int32_t) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
