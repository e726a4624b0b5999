#pragma once
// Private to the sources of this layer.
#include "abut/solid/material/stored_energy.hpp"

namespace abut::solid {

/// The compressible material of Mooney and Rivlin, with Lame's constants lambda and mu at small strains. With I_1, I_2
/// of C = F^T F and J = det F, all of space, and s the share of the second invariant,
///
///     W = mu (1 - s)/2 (I_1 - 3 - 2 ln J) + mu s/2 (I_2 - 3 - 4 ln J) + (lambda - 2 mu s)/2 (ln J)^2
///
/// s = 0 is the neo-Hookean one. Written in Green's strain E, so that small strains lose no digits.
template <int Dim>
class MooneyRivlin final : public StoredEnergy<Dim> {
public:
    /// lambda - 2 mu s >= 0 and 0 <= s <= 1 are left to `check(Material)`.
    MooneyRivlin(double lambda, double mu, double second_share)
        : mu_(mu), share_(second_share), of_volume_(lambda - 2.0 * mu * second_share) {}

    [[nodiscard]] Response<Dim> at(const Matrix<Dim>& g) const override;
    [[nodiscard]] Matrix<Dim> stress_change(const Matrix<Dim>& g, const Matrix<Dim>& change) const override;

private:
    double mu_, share_, of_volume_;
};

}  // namespace abut::solid
