#pragma once
// Private to the sources of this layer.
#include "abut/solid/material/flow_stress.hpp"
#include "abut/solid/material/inelastic.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::solid {

/// J2 plasticity at large strains: F = F_e F_p, an energy that is quadratic in Hencky's elastic strain (ln b_e)/2, and
/// the radial return of von Mises with isotropic hardening, exact in volume. With kinematic hardening a material is a
/// LogarithmicPlasticity. Kirchhoff's stress flows at FlowStress. z is C_p^-1 - I and alpha; in 2D, of plane strain,
/// with the part of C_p^-1 out of the plane. Written in differences to the undeformed state: small strains lose no
/// digits.
///
/// J. C. Simo, T. J. R. Hughes, Computational Inelasticity, 1998, chapter 9; M. Ortiz, L. Stainier, Comput. Methods
/// Appl. Mech. Eng. 171 (1999) for the energy of a step.
template <int Dim>
class J2Plasticity final : public InelasticLaw<Dim> {
public:
    explicit J2Plasticity(const Material& material) : material_(material) {}

    [[nodiscard]] std::vector<double> initial_memory() const override;
    [[nodiscard]] Response<Dim> at(const Matrix<Dim>& g, std::span<const double> memory) const override;
    [[nodiscard]] Advance<Dim> advance(const Matrix<Dim>& g, double dt, std::span<double> memory) const override;
    [[nodiscard]] bool stress_changes(const Matrix<Dim>& g, std::span<const double> memory,
                                      std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const override;
    [[nodiscard]] bool advanced_changes(const Matrix<Dim>& g, double dt, std::span<const double> memory,
                                        std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const override;
    [[nodiscard]] std::optional<double> out_of_plane_stress(const Matrix<Dim>& g,
                                                            std::span<const double> memory) const override;
    [[nodiscard]] double plastic_strain(std::span<const double> memory) const override { return memory.back(); }

private:
    struct Elastic;
    [[nodiscard]] Elastic elastic_part(const Matrix<Dim>& g, std::span<const double> memory) const;
    [[nodiscard]] Response<Dim> response(const Matrix<Dim>& g, const Elastic& elastic) const;
    [[nodiscard]] double flow(double size, const FlowStress& stress) const;
    [[nodiscard]] Matrix<3> elastic_moduli() const;
    void change_stress(const Matrix<Dim>& g, std::span<const double> memory, const Elastic& elastic, const Vector<3>& strain,
                       const Matrix<3>& moduli, std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const;

    Material material_;
};

}  // namespace abut::solid
