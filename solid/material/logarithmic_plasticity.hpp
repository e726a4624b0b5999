#pragma once
// Private to the sources of this layer.

#include "abut/solid/material/flow_stress.hpp"
#include "abut/solid/material/inelastic.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::solid {

/// J2 plasticity at large strains with kinematic hardening: the rule of small strains, with E = (ln F^T F)/2 in the
/// place of the strain. Per volume a cell stores, p being the plastic part of E, without trace,
///
///     lambda/2 (tr E)^2 + mu |E - p|^2 + H/3 |p|^2
///
/// and flows radially where |2 mu dev(E - p) - 2/3 H p| reaches sqrt(2/3) of FlowStress. z is p and alpha; in 2D, of
/// plane strain, p out of the plane is what the others leave. All of it lies in the axes of the body at rest: how that
/// is turned cannot matter.
///
/// C. Miehe, N. Apel, M. Lambrecht, Comput. Methods Appl. Mech. Eng. 191 (2002) 5383.
template <int Dim>
class LogarithmicPlasticity final : public InelasticLaw<Dim> {
public:
    explicit LogarithmicPlasticity(const Material& material) : material_(material) {}

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
    struct Strain;
    struct Flow;
    [[nodiscard]] static Strain strain_of(const Matrix<Dim>& g);
    [[nodiscard]] Flow flow(const Strain& strain, const Matrix<3>& plastic, const FlowStress& stress) const;
    [[nodiscard]] Matrix<3> stress_of(const Strain& strain, const Matrix<3>& plastic) const;
    [[nodiscard]] Response<Dim> response(const Matrix<Dim>& g, const Strain& strain, const Matrix<3>& plastic) const;
    void change_stress(const Matrix<Dim>& g, const Strain& strain, const Matrix<3>& plastic, const Flow& flow,
                       std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const;

    Material material_;
};

}  // namespace abut::solid
