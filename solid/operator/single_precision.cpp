#include <algorithm>
#include <cmath>

#include "abut/solid/operator/arrays.hpp"

// The coefficients of the sweeps in single precision.

namespace abut::solid {
namespace {

/// 0 where it is below the rounding of `size`: what is left is far above the least normal float.
float rounded(double value, double size) {
    constexpr double least = 0x1p-40;
    return std::abs(value) < least * size ? 0.0F : static_cast<float>(value);
}

template <int Dim>
std::array<float, Dim> rounded(const std::array<double, Dim>& vector, double per_unit) {
    double size = 0.0;
    for (const double component : vector) size = std::max(size, std::abs(component));
    std::array<float, Dim> result;
    for (int j = 0; j < Dim; ++j) result[j] = rounded(per_unit * vector[j], per_unit * size);
    return result;
}

/// Rounded weight of R, whose weights are about 1.
template <int Dim>
LaneTensor<Dim, float> rounded(const LaneTensor<Dim>& weight) {
    LaneTensor<Dim, float> result{};
    for (int j = 0; j < Dim; ++j)
        for (int i = 0; i < Dim; ++i) result.col[j].r[i] = rounded(weight.col[j][i], 1.0);
    return result;
}

/// Multiples of a power of two that float holds below twice the largest weight; their sum is exactly 1.
template <int Dim>
FaceStencil<Dim, float> rounded(const FaceStencil<Dim>& stencil) {
    constexpr int digits = 24;
    double largest = 0.0;
    for (const double weight : stencil.weights) largest = std::max(largest, std::abs(weight));
    FaceStencil<Dim, float> result{stencil.cells, {}};
    if (largest == 0.0) return result;  // of a boundary face
    const double grid = std::ldexp(1.0, std::ilogb(largest) + 2 - digits);
    double rest = 1.0;
    for (std::size_t j = 1; j <= Dim; ++j) {
        const double weight = grid * std::nearbyint(stencil.weights[j] / grid);
        result.weights[j] = static_cast<float>(weight);
        rest -= weight;
    }
    result.weights[0] = static_cast<float>(rest);
    return result;
}

template <int Dim>
float weight_of(const FaceStencil<Dim, float>& stencil, std::int32_t cell) {
    return stencil.weights[static_cast<std::size_t>(std::ranges::find(stencil.cells, cell) - stencil.cells.begin())];
}

double power_of_two(double near) { return std::exp2(std::round(std::log2(near))); }

/// Units of the largest cell, and the largest modulus.
template <int Dim>
SweepUnits<Dim, float> units_of(const LargeArray<CellGeometry<Dim>>& cells) {
    double measure = 0.0, modulus = 0.0;
    for (const CellGeometry<Dim>& cell : cells) {
        measure = std::max(measure, 1.0 / cell.inverse_measure);
        modulus = std::max(modulus, cell.lambda + 2.0 * cell.mu);
    }
    if (cells.empty()) return {};
    return {power_of_two(std::pow(measure, 1.0 / Dim)), power_of_two(modulus)};
}

}  // namespace

template <int Dim>
CcgCoefficients<Dim, float> in_single_precision(const CcgArrays<Dim>& arrays) {
    CcgCoefficients<Dim, float> single;
    const SweepUnits<Dim, float> units = units_of<Dim>(arrays.cells);
    single.units = units;
    const double volume = units.area * units.length;
    const double per_stiffness = units.per_newtons * units.length;
    for (const FaceStencil<Dim>& stencil : arrays.stencils) single.stencils.push_back(rounded<Dim>(stencil));
    for (const FaceGeometry<Dim>& face : arrays.faces)
        single.faces.push_back(
            {rounded<Dim>(face.area_vector, 1.0 / units.area), static_cast<float>(per_stiffness * face.jump_stiffness)});
    for (const CellGeometry<Dim>& cell : arrays.cells)
        single.cells.push_back({static_cast<float>(volume * cell.inverse_measure),
                                static_cast<float>(units.per_modulus * cell.lambda),
                                static_cast<float>(units.per_modulus * cell.mu)});
    if (!arrays.simplices.all())
        for (const std::array<double, Dim>& arm : arrays.lever_arms)
            single.lever_arms.push_back(rounded<Dim>(arm, units.per_length));
    for (const auto [first, second] : arrays.shares)
        single.shares.push_back({static_cast<float>(first), static_cast<float>(second)});
    for (std::int32_t c = 0; c < arrays.n_cells(); ++c)
        for (std::int32_t i = arrays.of_cell.offsets[c]; i < arrays.of_cell.offsets[c + 1]; ++i)
            single.of_cell_weights.push_back(weight_of<Dim>(single.stencils[arrays.of_cell.rows[i]], c));
    for (const LaneTensor<Dim>& weight : arrays.boundary_weights) single.boundary_weights.push_back(rounded<Dim>(weight));
    for (const LaneTensor<Dim>& weight : arrays.boundary_cell_weights)
        single.boundary_cell_weights.push_back(rounded<Dim>(weight));
    for (const LaneTensor<Dim>& part : arrays.affine_parts) single.affine_parts.push_back(rounded<Dim>(part));
    if (!arrays.affine.faces.empty())
        for (std::size_t position = 0; position < arrays.boundary_cells.size(); ++position)
            for (std::int32_t i = arrays.affine.of_cell.offsets[position]; i < arrays.affine.of_cell.offsets[position + 1];
                 ++i) {
                const BoundaryFace face = arrays.affine.faces[static_cast<std::size_t>(arrays.affine.of_cell.rows[i])];
                single.affine_weights.push_back(
                    weight_of<Dim>(single.stencils[arrays.face_of(face)], arrays.boundary_cells[position]));
            }
    return single;
}

template CcgCoefficients<2, float> in_single_precision(const CcgArrays<2>&);
template CcgCoefficients<3, float> in_single_precision(const CcgArrays<3>&);

}  // namespace abut::solid
