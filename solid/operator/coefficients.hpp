#pragma once
// Private to the sources of this layer.
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "abut/base/large_array.hpp"
#include "abut/solid/operator/lanes.hpp"
#include "abut/solid/operator/stencil.hpp"

namespace abut::solid {

/// A boundary face has no stiffness.
template <int Dim, class Real = double>
struct FaceGeometry {
    std::array<Real, Dim> area_vector;  // |f| n_f, out of the first side
    Real jump_stiffness;                // k_f = |f| eta / h_f
};

template <int Dim, class Real = double>
struct CellGeometry {
    Real inverse_measure;  // 1/|c|
    Real lambda;
    Real mu;
};

/// Units in which the sweeps measure: in double the units of the user, at no cost.
template <int Dim, class Real>
struct SweepUnits {
    static_assert(std::is_same_v<Real, double>);

    template <class V>
    [[nodiscard, gnu::always_inline]] static ABUT_HOST_DEVICE V displacement(V metres) {
        return metres;
    }
    template <class V>
    [[nodiscard, gnu::always_inline]] static ABUT_HOST_DEVICE V force(V newtons) {
        return newtons;
    }
    [[nodiscard, gnu::always_inline]] static Lanes<Dim> stress(Lanes<Dim> pascals) { return pascals; }
    template <class V>
    [[nodiscard, gnu::always_inline]] static ABUT_HOST_DEVICE V in_newtons(const V& force) {
        return force;
    }
    [[nodiscard]] static Matrix<Dim> in_pascals(const Matrix<Dim>& stress) { return stress; }
};

/// In single precision a length and a modulus of the scene, powers of two: no unit of the user is too large or too small for
/// the range of float, and scaling rounds nothing.
template <int Dim>
struct SweepUnits<Dim, float> {
    double length = 1.0, area = 1.0, modulus = 1.0, newtons = 1.0;
    double per_length = 1.0, per_modulus = 1.0, per_newtons = 1.0;

    SweepUnits() = default;
    SweepUnits(double a_length, double a_modulus)
        : length(a_length),
          area(Dim == 2 ? length : length * length),
          modulus(a_modulus),
          newtons(modulus * area),
          per_length(1.0 / length),
          per_modulus(1.0 / modulus),
          per_newtons(1.0 / newtons) {}

    [[nodiscard, gnu::always_inline]] Lanes<Dim, float> displacement(Lanes<Dim> metres) const {
        return rounded(per_length * metres);
    }
    [[nodiscard, gnu::always_inline]] Lanes<Dim, float> force(Lanes<Dim> given) const {
        return rounded(per_newtons * given);
    }
    [[nodiscard, gnu::always_inline]] Lanes<Dim, float> stress(Lanes<Dim> pascals) const {
        return rounded(per_modulus * pascals);
    }
    [[nodiscard, gnu::always_inline]] Lanes<Dim> in_newtons(const Lanes<Dim>& force) const { return newtons * force; }
    [[nodiscard]] Matrix<Dim> in_pascals(const Matrix<Dim>& stress) const { return modulus * stress; }

private:
    /// Rounds values below 2^-60 to 0: they are far below the rounding of anything that a body does, and the products
    /// of what is left are numbers that processors multiply at full speed.
    [[nodiscard, gnu::always_inline]] static Lanes<Dim, float> rounded(Lanes<Dim> a) {
        constexpr double least = 0x1p-60;
        const typename Lanes<Dim>::Register zero{};
        return converted<float>(Lanes<Dim>{a.r > least || a.r < -least ? a.r : zero});
    }
};

/// The numbers that the operators of CcgArrays are made of, by the scalar that the sweeps compute in.
template <int Dim, class Real>
struct CcgCoefficients {
    [[no_unique_address]] SweepUnits<Dim, Real> units;
    LargeArray<FaceStencil<Dim, Real>> stencils;
    LargeArray<FaceGeometry<Dim, Real>> faces;
    LargeArray<CellGeometry<Dim, Real>> cells;
    LargeArray<std::array<Real, Dim>> lever_arms;         // x_f - x_c, by half-face
    LargeArray<std::array<Real, 2>> shares;               // of u_f in u at x_c as simplices at both sides take it, by face
    LargeArray<Real> of_cell_weights;                     // by entry of CcgArrays::of_cell
    std::vector<LaneTensor<Dim, Real>> boundary_weights;  // as CcgArrays::boundary.weights
    LargeArray<LaneTensor<Dim, Real>> boundary_cell_weights;  // by entry of CcgArrays::of_boundary_cell
    std::vector<LaneTensor<Dim, Real>> affine_parts;          // AffineFace::free_part, by index of AffineTraces::faces
    LargeArray<Real> affine_weights;                          // by entry of AffineTraces::of_cell
};

template <int Dim>
struct CcgArrays;

/// Coefficients in single precision: areas, moduli and stiffness rounded one by one; the weights of a stencil to multiples
/// of one power of two, so that they still sum to exactly 1.
template <int Dim>
[[nodiscard]] CcgCoefficients<Dim, float> in_single_precision(const CcgArrays<Dim>& arrays);

}  // namespace abut::solid
