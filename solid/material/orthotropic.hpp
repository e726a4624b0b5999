#pragma once
// Private to the sources of this layer.
#include "abut/solid/material/material.hpp"
#include "abut/solid/material/stored_energy.hpp"

namespace abut::solid {

/// Isotropic moduli.
struct Lame {
    double lambda, mu;  ///< [Pa]
};

/// Mean moduli for MaterialLaw::orthotropic: the isotropic stiffness that is nearest to that of the material, which is
/// Voigt's mean over all directions. What an isotropic material has is what is returned of its constants, up to
/// rounding.
[[nodiscard]] Lame mean_moduli(const Material& material);
/// For MaterialLaw::orthotropic: the largest modulus of a plane wave along one of the axes of the material [Pa].
[[nodiscard]] double largest_wave_modulus(const Material& material);
/// Thermal strain per kelvin of any material, in the axes of space [1/K].
[[nodiscard]] Matrix<3> thermal_strain(const Material& material);
/// Throws BadInput naming the body where constants of MaterialLaw::orthotropic have no positive energy, or axes are not
/// at right angles.
void check_orthotropic(const Material& material, int body);

/// Stiffness of a material beyond lambda and mu of Material, in the axes of space: nothing where it is isotropic. In 2D
/// of plane strain.
template <int Dim>
class DirectedStiffness {
public:
    explicit DirectedStiffness(const Material& material);

    /// Whether the material is not isotropic.
    [[nodiscard]] bool any() const { return any_; }
    /// C : sym g, beyond the isotropic part [Pa].
    [[nodiscard]] Matrix<Dim> stress(const Matrix<Dim>& g) const;
    /// In the plane: the stress out of it of the same.
    [[nodiscard]] double out_of_plane_stress(const Matrix<Dim>& g) const;
    /// b -> C : sym (b (x) second) first for vectors b: how the force on an area `first` answers to what moves an area
    /// `second`.
    [[nodiscard]] Matrix<Dim> between(const Vector<Dim>& first, const Vector<Dim>& second) const;

private:
    static constexpr int n_components = Dim * (Dim + 1) / 2;
    using Packed = SmallMatrix<n_components, 1>;
    [[nodiscard]] static Packed packed(const Matrix<Dim>& tensor);

    bool any_;
    SmallMatrix<n_components, n_components> stiffness_;  // of symmetric tensors with shears times sqrt 2
    Packed out_of_plane_;                                // the row of the stress out of the plane
};

/// lambda + 2 mu, or of a material with directions the modulus of a wave along the unit vector n whose motion is along
/// n [Pa].
template <int Dim>
[[nodiscard]] double wave_modulus_along(const Material& material, const DirectedStiffness<Dim>& directed,
                                        const Vector<Dim>& n);

/// MaterialLaw::orthotropic at large strains: St. Venant and Kirchhoff's energy 1/2 E : C : E of Green's strain E.
/// Infinite where det F is not positive.
template <int Dim>
class OrthotropicEnergy final : public StoredEnergy<Dim> {
public:
    explicit OrthotropicEnergy(const Material& material)
        : lambda_(material.lambda()), mu_(material.mu()), directed_(material) {}

    [[nodiscard]] Response<Dim> at(const Matrix<Dim>& g) const override;
    [[nodiscard]] Matrix<Dim> stress_change(const Matrix<Dim>& g, const Matrix<Dim>& change) const override;

private:
    [[nodiscard]] Matrix<Dim> stress_of(const Matrix<Dim>& strain) const;

    double lambda_, mu_;
    DirectedStiffness<Dim> directed_;
};

}  // namespace abut::solid
