// What the sweeps know of single cells after a call.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/solid/ccg/sweeps.hpp"
#include "abut/solid/operator/largest_strain.hpp"

namespace abut::solid {
namespace {

template <int Dim>
double norm_of_strain(const LaneTensor<Dim>& g, bool is_finite) {
    if (is_finite) return std::sqrt(squared_green_strain(g));
    const LaneTensor<Dim> turned = transpose(g);
    LaneTensor<Dim> twice;
    for (int j = 0; j < Dim; ++j) twice.col[j] = g.col[j] + turned.col[j];
    return 0.5 * std::sqrt(squared_norm(twice));
}

/// Takes the extremes of both.
void take(FiniteExtremes& extremes, const FiniteExtremes& other) {
    if (!(other.determinant >= extremes.determinant)) {  // or not a number
        extremes.determinant = other.determinant;
        extremes.cell = other.cell;
    }
    extremes.strain = std::max(extremes.strain, other.strain);
    extremes.plastic_strain = std::max(extremes.plastic_strain, other.plastic_strain);
}

}  // namespace

/// Part of [u] without what lasts.
template <int Dim, class Real>
Lanes<Dim, Real> CcgSweeps<Dim, Real>::elastic_jump(std::int32_t c, std::int32_t half_face) const {
    return state_.finite.contains(c) ? finite_.elastic_jump(c, half_face) : materials_.elastic_jump(c, half_face);
}

/// 1/2 |c| eps:C:eps, and 1/2 k |[u]|^2 of the faces whose first side the cell is.
template <int Dim, class Real>
double CcgSweeps<Dim, Real>::energy(std::int32_t c) const {
    const CcgArrays<Dim>& arrays = state_.arrays;
    const Kind kind = kind_of(c);
    double density = in_pool(*this, kind, [c](const auto& pool) { return pool.twice_energy_density(c); });
    if (kind != Kind::finite) density = materials_.twice_energy_density(c, density);
    double twice = density / state_.coefficients.cells[c].inverse_measure;
    for (std::int32_t i = arrays.half_face_offsets[c]; i < arrays.half_face_offsets[c + 1]; ++i) {
        const HalfFace& half_face = arrays.half_faces[i];
        if (half_face.first != c) continue;
        const Vectors jump = elastic_jump(c, i);
        twice += state_.coefficients.faces[half_face.face].jump_stiffness * dot(jump, jump);
    }
    return 0.5 * twice;
}

template <int Dim, class Real>
Matrix<Dim> CcgSweeps<Dim, Real>::stress(std::int32_t c) const {
    if constexpr (is_double) {
        return state_.finite.contains(c) ? finite_.cauchy_stress(c) : materials_.stress(c);
    } else {
        const LaneTensor<Dim, Real> g = state_.element.present_gradient(c);
        return state_.element.units.in_pascals(unload(elastic_stress(state_.coefficients.cells[c], g)));
    }
}

template <int Dim, class Real>
double CcgSweeps<Dim, Real>::directed_out_of_plane_stress(std::int32_t c) const {
    Matrix<Dim> strain = displacement_gradient(c);
    double volume = 1.0;
    if (state_.finite.contains(c)) {
        if (finite_.bears_nothing(c)) return 0.0;
        const Matrix<Dim> g = finite_.law_gradient(c);
        strain = g + 0.5 * g.transpose() * g;
        volume = (Matrix<Dim>::Identity() + g).determinant();
    }
    const double elastic = state_.coefficients.cells[c].lambda * strain.trace();
    return (elastic + state_.arrays.directed[c].out_of_plane_stress(strain)) / volume;
}

/// û_f and G_c of a boundary face and the cell behind it, as contact sees them.
template <int Dim, class Real>
std::pair<Vector<Dim>, Matrix<Dim>> CcgSweeps<Dim, Real>::tilted_face(BoundaryFace face) const {
    const std::int32_t c = state_.arrays.cell_of(face);
    const Vector<Dim> affine = face_displacement(face);
    const Matrix<Dim> g = unload(state_.element.region_gradient(c));
    const PlasticCells<Dim>& metal = materials_.metal();
    if (metal.moves_faces(c)) return {affine + metal.moved(c, face), g + metal.tilted(c)};
    return finite_.tilted_face(face, affine, g);
}

template <int Dim, class Real>
FiniteExtremes CcgSweeps<Dim, Real>::finite_extremes(std::span<const std::int32_t> cells) const {
    std::vector<FiniteExtremes> of_part((cells.size() + parallel_grain - 1) / parallel_grain);
    parallel_parts(cells.size(), parallel_grain, [&](std::size_t begin, std::size_t end) {
        FiniteExtremes& extremes = of_part[begin / parallel_grain];
        for (const std::int32_t c : cells.subspan(begin, end - begin)) {
            if (materials_.metal().contains(c)) take(extremes, {1.0, 0.0, -1, materials_.metal().end_plastic_strain(c)});
            if (!state_.finite.contains(c)) continue;
            const auto [determinant, strain] = finite_.end_stretch(c);
            take(extremes,
                 {determinant, state_.finite.is_linear_in_strain(c) ? strain : 0.0, c, finite_.end_plastic_strain(c)});
        }
    });
    FiniteExtremes extremes;
    for (const FiniteExtremes& of : of_part) take(extremes, of);
    return extremes;
}

template <int Dim, class Real>
std::vector<std::int32_t> CcgSweeps<Dim, Real>::strained_beyond(std::span<const double> limit_of_body) const {
    std::vector<std::int32_t> cells;
    std::size_t body = 0;
    for (std::size_t k = 0; k < strain_bounds_.size(); ++k) {
        while (chunks_[k].cell >= state_.arrays.body_begin[body + 1]) ++body;
        const double limit = limit_of_body[body];
        if (strain_bounds_[k] < limit) continue;
        for (std::int32_t c = chunks_[k].cell; c < chunks_[k + 1].cell; ++c) {
            const LaneTensor<Dim> g = state_.element.present_gradient(c);
            const bool is_below = norm_of_strain<Dim>(g, state_.finite.contains(c)) < limit;
            if (!is_below) cells.push_back(c);
        }
    }
    return cells;
}

template Matrix<2> CcgSweeps<2, float>::stress(std::int32_t) const;
template Matrix<3> CcgSweeps<3, float>::stress(std::int32_t) const;
#define ABUT_INSTANTIATE(Dim)                                                                     \
    template double CcgSweeps<Dim>::energy(std::int32_t) const;                                   \
    template Matrix<Dim> CcgSweeps<Dim>::stress(std::int32_t) const;                              \
    template double CcgSweeps<Dim>::directed_out_of_plane_stress(std::int32_t) const;             \
    template std::pair<Vector<Dim>, Matrix<Dim>> CcgSweeps<Dim>::tilted_face(BoundaryFace) const; \
    template FiniteExtremes CcgSweeps<Dim>::finite_extremes(std::span<const std::int32_t>) const; \
    template std::vector<std::int32_t> CcgSweeps<Dim>::strained_beyond(std::span<const double>) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
