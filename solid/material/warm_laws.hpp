#pragma once
// Private to the sources of this layer.
#include <memory>
#include <utility>

#include "abut/solid/material/inelastic.hpp"
#include "abut/solid/material/stored_energy.hpp"
#include "abut/solid/material/thermal_stretch.hpp"

namespace abut::solid {

/// An elastic material of large strains where it is warm: its law of space behind a ThermalStretch. Each cell has one
/// of its own, a copy of that of its body.
template <int Dim>
class WarmEnergy final : public StoredEnergy<Dim> {
public:
    WarmEnergy(std::shared_ptr<const StoredEnergy<3>> law, const ThermalStretch& stretch);
    [[nodiscard]] std::unique_ptr<WarmEnergy> copy() const { return std::make_unique<WarmEnergy>(law_, stretch_); }

    [[nodiscard]] ThermalStretch& stretch() { return stretch_; }
    /// Whether its law is St. Venant and Kirchhoff's, of isotropic constants or others.
    [[nodiscard]] bool is_linear_in_strain() const { return is_linear_; }
    [[nodiscard]] Response<Dim> at(const Matrix<Dim>& g) const override;
    [[nodiscard]] Matrix<Dim> stress_change(const Matrix<Dim>& g, const Matrix<Dim>& change) const override;
    /// In the plane: Cauchy's stress out of it [Pa].
    [[nodiscard]] double out_of_plane_stress(const Matrix<Dim>& g) const;

private:
    std::shared_ptr<const StoredEnergy<3>> law_;
    bool is_linear_;
    ThermalStretch stretch_;
};

/// Warm law of a material that remembers; z is that of its law of space.
template <int Dim>
class WarmInelastic final : public InelasticLaw<Dim> {
public:
    WarmInelastic(std::shared_ptr<const InelasticLaw<3>> law, const ThermalStretch& stretch)
        : law_(std::move(law)), stretch_(stretch) {}
    [[nodiscard]] std::unique_ptr<WarmInelastic> copy() const { return std::make_unique<WarmInelastic>(law_, stretch_); }

    [[nodiscard]] ThermalStretch& stretch() { return stretch_; }
    [[nodiscard]] const InelasticLaw<3>& law() const { return *law_; }
    [[nodiscard]] std::vector<double> initial_memory() const override { return law_->initial_memory(); }
    [[nodiscard]] Response<Dim> at(const Matrix<Dim>& g, std::span<const double> memory) const override;
    [[nodiscard]] Advance<Dim> advance(const Matrix<Dim>& g, double dt, std::span<double> memory) const override;
    [[nodiscard]] bool stress_changes(const Matrix<Dim>& g, std::span<const double> memory,
                                      std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const override;
    [[nodiscard]] bool advanced_changes(const Matrix<Dim>& g, double dt, std::span<const double> memory,
                                        std::span<const Matrix<Dim>> changes, std::span<Matrix<Dim>> results) const override;
    [[nodiscard]] std::optional<double> out_of_plane_stress(const Matrix<Dim>& g,
                                                            std::span<const double> memory) const override;
    [[nodiscard]] double plastic_strain(std::span<const double> memory) const override {
        return law_->plastic_strain(memory);
    }

private:
    std::shared_ptr<const InelasticLaw<3>> law_;
    ThermalStretch stretch_;
};

}  // namespace abut::solid
