#pragma once
#include <array>
#include <memory>

#include "abut/solid/material/inelastic.hpp"
#include "abut/solid/material/metal_flow.hpp"
#include "abut/solid/material/stored_energy.hpp"

namespace abut::solid {

/// How a body answers to strain. At small strains, and below the yield stress, all are linear, and all but one
/// isotropic; large ones, and with them rubber, are for bodies of Kinematics::finite.
enum class MaterialLaw {
    st_venant_kirchhoff,  ///< linear in Green's strain: up to strains of some 0.1
    neo_hookean,          ///< rubber: it stiffens without end where it is squeezed
    mooney_rivlin,        ///< the same with a share of the second invariant, `second_share`
    j2,  ///< metal: it yields by von Mises's rule at `yield_stress`, hardens, and remembers; of all bodies that deform
    orthotropic,  ///< other moduli along each of three axes of its own; at large strains linear in Green's strain
};

/// Constants of MaterialLaw::orthotropic beside E_1 and nu_12, along axes 1, 2 and 3 of the material. Under tension along
/// i a stretch along i comes with a contraction nu_ij times as large along j; nu_ji = nu_ij E_j/E_i.
struct Orthotropy {
    double young_2 = 0.0;                         ///< E_2 [Pa], > 0
    double young_3 = 0.0;                         ///< E_3 [Pa], > 0
    double poisson_13 = 0.0;                      ///< nu_13 [-]
    double poisson_23 = 0.0;                      ///< nu_23 [-]
    double shear_12 = 0.0;                        ///< G_12 [Pa], > 0
    double shear_13 = 0.0;                        ///< G_13 [Pa], > 0
    double shear_23 = 0.0;                        ///< G_23 [Pa], > 0
    double axis_angle = 0.0;                      ///< in 2D: from x to axis 1 [rad]; axis 3 is out of the plane
    std::array<double, 3> axis_1{1.0, 0.0, 0.0};  ///< in 3D: along axis 1, of any length, at rest
    std::array<double, 3> axis_2{0.0, 1.0, 0.0};  ///< the same for axis 2, at a right angle; axis 3 completes both
};

/// Thermal expansion of a body that deforms and whose temperature is given (SolidOptions::temperature_rise).
struct ThermalExpansion {
    double along_1 = 0.0;  ///< alpha [1/K]; of MaterialLaw::orthotropic along axis 1
    double along_2 = 0.0;  ///< of MaterialLaw::orthotropic along axis 2 [1/K]
    double along_3 = 0.0;  ///< the same along axis 3, in 2D out of the plane

    [[nodiscard]] bool any() const { return along_1 != 0.0 || along_2 != 0.0 || along_3 != 0.0; }
};

/// Damping of a body that deforms, with schemes that take mean forces.
struct Damping {
    double mass = 0.0;                 ///< Rayleigh's alpha: a force alpha M v against the motion [1/s], >= 0
    double stiffness = 0.0;            ///< Rayleigh's beta: a stress beta C : (rate of strain) [s], >= 0
    double linear_viscosity = 0.0;     ///< of shocks: a pressure b rho c h (rate of compression) [-], >= 0
    double quadratic_viscosity = 0.0;  ///< the same, b^2 rho h^2 (rate of compression)^2 [-], >= 0

    [[nodiscard]] bool any() const {
        return mass > 0.0 || stiffness > 0.0 || linear_viscosity > 0.0 || quadratic_viscosity > 0.0;
    }
};

/// Elasticity, and what a law has beside it; plane strain in 2D. One for each body.
struct Material {
    double young = 1.0;    ///< E [Pa], > 0; of MaterialLaw::orthotropic E_1
    double poisson = 0.3;  ///< nu [-], in (-1, 1/2); of MaterialLaw::orthotropic nu_12
    double density = 1.0;  ///< rho [kg/m^3], > 0
    double eta = 0.0;      ///< stabilisation of the jumps between cells [Pa]; 0 means E, or its mean
    MaterialLaw law = MaterialLaw::st_venant_kirchhoff;  ///< of a body of Kinematics::finite; others have the first
    /// Ratio for MaterialLaw::mooney_rivlin: mu of the second invariant over mu [-], 0 to min(1, lambda/(2 mu)).
    double second_share = 0.0;
    Orthotropy orthotropic{};  ///< of MaterialLaw::orthotropic
    MetalFlow flow{};          ///< of MaterialLaw::j2
    ThermalExpansion expansion{};
    Damping damping{};

    /// Whether its cells remember what happened to them: only schemes that take mean forces run it.
    [[nodiscard]] bool remembers() const { return law == MaterialLaw::j2 || damping.any(); }
    /// Damping over what is critical of a mode with this frequency [rad/s] in cells of this size [m], at most [-]: by
    /// it the stable step is shorter.
    [[nodiscard]] double damping_ratio(double omega, double size) const;
    /// Lame's first parameter lambda [Pa]; of MaterialLaw::orthotropic its mean over all directions.
    [[nodiscard]] double lambda() const {
        return is_isotropic() ? young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)) : mean_lambda();
    }
    /// Shear modulus mu [Pa]; of MaterialLaw::orthotropic its mean over all directions.
    [[nodiscard]] double mu() const { return is_isotropic() ? 0.5 * young / (1.0 + poisson) : mean_mu(); }
    /// lambda + 2 mu, the modulus of a wave of compression [Pa]; of MaterialLaw::orthotropic the largest of a wave
    /// along an axis.
    [[nodiscard]] double wave_modulus() const { return is_isotropic() ? lambda() + 2.0 * mu() : largest_of_axes(); }
    /// E [Pa]; of MaterialLaw::orthotropic that of its mean lambda and mu.
    [[nodiscard]] double mean_young() const {
        return is_isotropic() ? young : mu() * (3.0 * lambda() + 2.0 * mu()) / (lambda() + mu());
    }
    [[nodiscard]] bool is_isotropic() const { return law != MaterialLaw::orthotropic; }
    /// Shear over normal stiffness of half a cell, mu / (lambda + 2 mu) [-].
    [[nodiscard]] double shear_ratio() const { return mu() / wave_modulus(); }
    /// `eta`, or `mean_young` where none is given [Pa].
    [[nodiscard]] double stabilisation() const { return eta > 0.0 ? eta : mean_young(); }

private:
    [[nodiscard]] double mean_lambda() const;
    [[nodiscard]] double mean_mu() const;
    [[nodiscard]] double largest_of_axes() const;
};

/// Throws BadInput naming the body, the value, the limit and the remedy.
void check(const Material& material, int body);

/// Makes the stored energy of a material at large strains; null for St. Venant and Kirchhoff's, which the operators
/// know by themselves, and for inelastic ones.
template <int Dim>
[[nodiscard]] std::shared_ptr<const StoredEnergy<Dim>> stored_energy(const Material& material);
/// Makes the law of an inelastic material; null for an elastic one.
template <int Dim>
[[nodiscard]] std::shared_ptr<const InelasticLaw<Dim>> inelastic_law(const Material& material);

}  // namespace abut::solid
