#pragma once
#include <functional>
#include <string>

#include "abut/solid/solid.hpp"
#include "abut/solid/statics.hpp"

/// Solutions of statics that are chosen first: the body load that belongs to them follows by hand.
namespace abut::studies {

/// u = a phi(x) d in an isotropic body. With H the second derivatives of phi,
///     div sigma = a ((lambda + mu) H d + mu tr(H) d),    and the body load is its opposite.
template <int Dim>
struct Manufactured {
    std::string formula;
    solid::Material material;
    double amplitude;       ///< a [m]
    Vector<Dim> direction;  ///< d [-]
    std::function<double(const Vector<Dim>& x)> shape;
    std::function<Vector<Dim>(const Vector<Dim>& x)> slope;      ///< gradient of phi [1/m]
    std::function<Matrix<Dim>(const Vector<Dim>& x)> curvature;  ///< H [1/m^2]

    [[nodiscard]] Vector<Dim> displacement(const Vector<Dim>& x) const { return amplitude * shape(x) * direction; }
    [[nodiscard]] Matrix<Dim> gradient(const Vector<Dim>& x) const { return amplitude * direction * slope(x).transpose(); }
    [[nodiscard]] Vector<Dim> body_load(const Vector<Dim>& x) const;  ///< [N/m^3]
};

/// On [-1, 1]^Dim, E = 70e3, nu = 0.3, a = 0.8.
/// 2D: phi = (x^2 + y^2)/2, d = (1, 1), load -a (lambda + 3 mu) (1, 1). 3D: phi = sin 2x cos y exp(z/2), d = (1, 2, -1)/2.
template <int Dim>
[[nodiscard]] Manufactured<Dim> manufactured();
template <>
Manufactured<2> manufactured<2>();
template <>
Manufactured<3> manufactured<3>();

/// How far a static solution is from the exact one.
struct StaticErrors {
    /// Error of u_c + G_c (x - x_c) in L2, over the L2 norm of the exact displacement [-]
    double displacement;
    /// sqrt(integral of e:C:e + stabilisation), e being the error of the strain, over the same of the exact one [-]
    double energy;
    solid::StaticReport report;
};

/// Solves with the exact displacement on the whole boundary of a box. Throws as solid::solve_statics, and
/// std::runtime_error if it does not reach its tolerance.
template <int Dim>
[[nodiscard]] StaticErrors solve_manufactured(const Manufactured<Dim>& exact, const mesh::Mesh<Dim>& box,
                                              const solid::StaticOptions& options);

}  // namespace abut::studies
