#pragma once

namespace abut::solid {

/// Isotropic linear elasticity; plane strain in 2D. One for each body.
struct Material {
    double young = 1.0;    ///< E [Pa], > 0
    double poisson = 0.3;  ///< nu [-], in (-1, 1/2)
    double density = 1.0;  ///< rho [kg/m^3], > 0
    double eta = 0.0;      ///< stabilisation of the jumps between cells [Pa]; 0 means E

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

}  // namespace abut::solid
