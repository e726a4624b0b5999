#pragma once
#include <memory>

#include "abut/solid/material/stored_energy.hpp"

namespace abut::solid {

/// How a body of Kinematics::finite answers to large strains. At small ones all are isotropic and linear, as other bodies are.
enum class ElasticLaw {
    st_venant_kirchhoff,  ///< linear in Green's strain: up to strains of some 0.1
    neo_hookean,          ///< rubber: it stiffens without end where it is squeezed
    mooney_rivlin,        ///< the same with a share of the second invariant, `second_share`
};

/// Isotropic elasticity; plane strain in 2D. One for each body.
struct Material {
    double young = 1.0;                                ///< E [Pa], > 0
    double poisson = 0.3;                              ///< nu [-], in (-1, 1/2)
    double density = 1.0;                              ///< rho [kg/m^3], > 0
    double eta = 0.0;                                  ///< stabilisation of the jumps between cells [Pa]; 0 means E
    ElasticLaw law = ElasticLaw::st_venant_kirchhoff;  ///< of a body of Kinematics::finite; others have the first
    double second_share =
        0.0;  ///< of ElasticLaw::mooney_rivlin: mu of the second invariant over mu [-], 0 to min(1, lambda/(2 mu))

    /// Lame's first parameter lambda [Pa].
    [[nodiscard]] double lambda() const { return young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); }
    /// Shear modulus mu [Pa].
    [[nodiscard]] double mu() const { return 0.5 * young / (1.0 + poisson); }
    /// lambda + 2 mu, the modulus of a wave of compression [Pa].
    [[nodiscard]] double wave_modulus() const { return lambda() + 2.0 * mu(); }
    /// Shear over normal stiffness of half a cell, mu / (lambda + 2 mu) [-].
    [[nodiscard]] double shear_ratio() const { return mu() / wave_modulus(); }
    /// `eta`, or E where none is given [Pa].
    [[nodiscard]] double stabilisation() const { return eta > 0.0 ? eta : young; }
};

/// Throws BadInput naming the body, the value, the limit and the remedy.
void check(const Material& material, int body);

/// Of its law; null of St. Venant and Kirchhoff's, which the operators know by themselves.
template <int Dim>
[[nodiscard]] std::shared_ptr<const StoredEnergy<Dim>> stored_energy(const Material& material);

}  // namespace abut::solid
