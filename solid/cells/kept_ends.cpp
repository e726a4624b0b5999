#include "abut/solid/cells/kept_ends.hpp"

#include <algorithm>
#include <limits>

#include "abut/solid/cells/edge_step.hpp"

namespace abut::solid {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <int Dim>
double product(const Matrix<Dim>& a, const Matrix<Dim>& b) {
    return a.cwiseProduct(b).sum();
}

/// Moment of dV/dF in F: sum of F_k × T_k over the columns.
template <int Dim>
AxialVector<Dim> moment_of(const Matrix<Dim>& f, const Matrix<Dim>& gradient) {
    AxialVector<Dim> sum = AxialVector<Dim>::Zero();
    for (int k = 0; k < Dim; ++k) sum += moment<Dim>(f.col(k), gradient.col(k));
    return sum;
}

}  // namespace

template <int Dim>
CellMemory<Dim>::CellMemory(const FiniteCells<Dim>& finite)
    : finite_(finite), values_(finite.initial_memory()), laws_(finite.n_inelastic()) {
    for (std::size_t i = 0; i < laws_.size(); ++i) {
        const auto index = static_cast<std::int32_t>(i);
        laws_[i].set(*finite.inelastic_cell(index).law, of(index));
    }
}

template <int Dim>
void KeptEnd<Dim>::resize(std::size_t n_cells, const FiniteCells<Dim>& finite) {
    constexpr std::size_t width = lane_width<Dim>;
    for (LargeArray<double>* vectors : {&u, &direct}) vectors->resize(width * n_cells);
    for (LargeArray<double>* tensors : {&g, &s}) tensors->resize(width * Dim * n_cells);
    free.resize(finite.free().size());
    if (!finite.any_law()) return;
    energy.resize(n_cells);
    stress.resize(width * Dim * n_cells);
}

template <int Dim>
KeptEnds<Dim>::KeptEnds(const CcgCoefficients<Dim, double>& coefficients, const FiniteCells<Dim>& finite)
    : start(finite), end(finite), coefficients_(coefficients), finite_(finite) {
    if (!finite.takes_ends()) return;
    for (KeptEnd<Dim>* kept : {&start, &end}) kept->resize(coefficients.cells.size(), finite);
    defects_.resize(n_of_defect * coefficients.cells.size());
    if (finite.any_law()) of_contact_.resize(finite.free().size());
    losses_.resize(finite.n_inelastic());
    flows_.resize(finite.n_inelastic());
    clear_contact();
}

template <int Dim>
std::pair<Matrix<Dim>, Matrix<Dim>> KeptEnds<Dim>::gradients(std::int32_t c) const {
    return {unload(load_tensor<Dim>(start.g, c)), unload(load_tensor<Dim>(end.g, c))};
}

/// Step of a cell with one normal whose material is St. Venant and Kirchhoff's.
template <int Dim>
CondensedStep<Dim> KeptEnds<Dim>::step_of(std::int32_t c, const Matrix<Dim>& g_0, const Matrix<Dim>& g_1) const {
    const CellGeometry<Dim>& cell = coefficients_.cells[c];
    return {*finite_.of_one_normal(c), contraction(cell.lambda, cell.mu), 0.5 * (g_0 + g_1), g_1 - g_0};
}

/// (P_0 + P_1)/2 : Delta F - Delta W. Where W is quadratic in E this is Delta S : (Delta F^T Delta F)/4, without a
/// difference of large numbers: what a body at rest lacks is 0, and not rounding over a motion that is nearly none.
template <int Dim>
double KeptEnds<Dim>::elastic_defect(std::int32_t c, const Matrix<Dim>& g_0, const Matrix<Dim>& g_1) const {
    const Matrix<Dim> change = g_1 - g_0;
    if (finite_.has_law(c)) {
        const Matrix<Dim> mean =
            0.5 * unload(load_tensor<Dim>(start.stress, c)) + 0.5 * unload(load_tensor<Dim>(end.stress, c));
        return product<Dim>(mean, change) - (end.energy[c] - start.energy[c]);
    }
    const CellGeometry<Dim>& cell = coefficients_.cells[c];
    const Matrix<Dim> turned = change + 0.5 * (g_0 + g_1).transpose() * change;
    const Matrix<Dim> of_strain = 0.5 * (turned + turned.transpose());
    const std::int32_t position = finite_.free_position(c);
    const Matrix<Dim> of_stress =
        position < 0 ? Matrix<Dim>(2.0 * cell.mu * of_strain + cell.lambda * of_strain.trace() * Matrix<Dim>::Identity())
                     : condensed_stress(finite_.free()[static_cast<std::size_t>(position)], cell.lambda, cell.mu, of_strain);
    return 0.25 * product<Dim>(of_stress, change.transpose() * change);
}

/// dV/du . change of the body, and its moment, are sums over cells of direct . change + |c| S : change of G, as all that is
/// reconstructed is linear, and exact for affine motions. Jumps are quadratic in u and what the traces take for F, and lack
/// nothing where that is F itself.
///
/// Where a material dissipates, the first part is what it takes, except where it is negative by what the step is too
/// long. The part of the jumps is then that of faces which flow along with their cell, and has no sign.
template <int Dim>
void KeptEnds<Dim>::set_defect(std::int32_t c, bool flows, double of_capped_jumps) {
    const auto [g_0, g_1] = gradients(c);
    const Matrix<Dim> s = 0.5 * (unload(load_tensor<Dim>(start.s, c)) + unload(load_tensor<Dim>(end.s, c)));
    const double measure = 1.0 / coefficients_.cells[c].inverse_measure;
    double energy = elastic_defect(c, g_0, g_1);
    const std::int32_t inelastic = finite_.inelastic(c);
    dynamics::Losses loss;
    if (flows) {
        loss.in_cells = measure * std::max(0.0, energy);
        energy = std::min(0.0, energy);
    }
    if (finite_.has_condensed_traces(c)) {
        const auto position = static_cast<std::size_t>(finite_.free_position(c));
        const FreeEnd<Dim>&free_0 = start.free[position], &free_1 = end.free[position];
        const Matrix<Dim> jumps = 0.5 * (free_0.jumps + free_1.jumps);
        const Matrix<Dim> pulled = 0.5 * (free_0.pulled_jumps + free_1.pulled_jumps);
        const double of_jumps =
            finite_.has_law(c) ? product<Dim>(pulled, g_1 - g_0) - product<Dim>(jumps, free_1.gradient() - free_0.gradient())
                               : product<Dim>(pulled - step_of(c, g_0, g_1).pull_back(jumps), g_1 - g_0);
        if (flows)
            loss.on_faces = measure * of_jumps;
        else
            energy += of_jumps;
    }
    if (inelastic >= 0) {
        losses_[static_cast<std::size_t>(inelastic)] = loss;
        flows_[static_cast<std::size_t>(inelastic)] = flows ? 1 : 0;
    }
    const AxialVector<Dim> moment = measure * moment_of<Dim>(Matrix<Dim>::Identity() + 0.5 * (g_0 + g_1), s);
    double* defect = defects_.data() + n_of_defect * c;
    defect[0] = measure * energy + of_capped_jumps;
    for (int k = 0; k < n_axial; ++k) defect[1 + k] = moment[k];
}

template <int Dim>
StepDefect<Dim> KeptEnds<Dim>::defect(std::int32_t c) const {
    const double* of_cell = defects_.data() + n_of_defect * c;
    StepDefect<Dim> defect{.energy = of_cell[0], .rounding = 0.0, .moment = AxialVector<Dim>(of_cell + 1)};
    if (!finite_.has_law(c)) return defect;
    const double measure = 1.0 / coefficients_.cells[c].inverse_measure;
    double size = start.energy[c] + end.energy[c];
    if (finite_.free_cell(c)) {
        const auto position = static_cast<std::size_t>(finite_.free_position(c));
        size += 0.5 * (start.free[position].jumps + end.free[position].jumps).norm();
        if (!flows(c)) defect.energy += measure * of_contact_[position].energy;
        defect.moment += measure * of_contact_[position].moment;
    }
    defect.rounding = epsilon * measure * size;
    return defect;
}

template <int Dim>
bool KeptEnds<Dim>::flows(std::int32_t c) const {
    const std::int32_t inelastic = finite_.inelastic(c);
    return inelastic >= 0 && flows_[static_cast<std::size_t>(inelastic)] != 0;
}

template <int Dim>
dynamics::Losses KeptEnds<Dim>::loss(std::int32_t c) const {
    if (!flows(c)) return {};
    dynamics::Losses loss = losses_[static_cast<std::size_t>(finite_.inelastic(c))];
    if (finite_.free_cell(c))
        loss.on_faces +=
            of_contact_[static_cast<std::size_t>(finite_.free_position(c))].energy / coefficients_.cells[c].inverse_measure;
    return loss;
}

template <int Dim>
void KeptEnds<Dim>::clear_contact() {
    for (StepDefect<Dim>& defect : of_contact_) defect = {0.0, 0.0, AxialVector<Dim>::Zero()};
}

/// CondensedStep is exact along the step; with a StoredEnergy the mean of what holds at both ends is taken, and what it
/// lacks is one more part of the defect.
template <int Dim>
Matrix<Dim> KeptEnds<Dim>::pull_back_contact(std::int32_t c, const Matrix<Dim>& gradient) {
    const auto [g_0, g_1] = gradients(c);
    const auto position = static_cast<std::size_t>(finite_.free_position(c));
    if (const FreeCell<Dim>& free = *finite_.free_cell(c); !free.has_one_normal()) {
        const CellGeometry<Dim>& cell = coefficients_.cells[c];
        const EdgeStep<Dim> step(free, poisson_ratio(cell.lambda, cell.mu),
                                 {start.free[position].swelling, end.free[position].swelling}, 0.5 * (g_0 + g_1), g_1 - g_0);
        const Matrix<Dim> pulled = step.pull_back(gradient);
        if (finite_.has_law(c))
            of_contact_[position].energy = product<Dim>(pulled, g_1 - g_0) - product<Dim>(gradient, step.change());
        return pulled;
    }
    if (!finite_.has_law(c)) return step_of(c, g_0, g_1).pull_back(gradient);
    const FreeEnd<Dim>&free_0 = start.free[position], &free_1 = end.free[position];
    const Matrix<Dim> pulled = 0.5 * (free_0.pull_back(gradient) + free_1.pull_back(gradient));
    const Matrix<Dim> mean = Matrix<Dim>::Identity() + 0.5 * (g_0 + g_1);
    const Matrix<Dim> free_mean = Matrix<Dim>::Identity() + 0.5 * (free_0.gradient() + free_1.gradient());
    of_contact_[position] = {
        .energy = product<Dim>(pulled, g_1 - g_0) - product<Dim>(gradient, free_1.gradient() - free_0.gradient()),
        .rounding = 0.0,
        .moment = moment_of<Dim>(mean, pulled) - moment_of<Dim>(free_mean, gradient)};
    return pulled;
}

template class CellMemory<2>;
template class CellMemory<3>;
template struct KeptEnd<2>;
template struct KeptEnd<3>;
template class KeptEnds<2>;
template class KeptEnds<3>;

}  // namespace abut::solid
