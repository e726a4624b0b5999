#pragma once
// Private to the sources of this layer.
#include "abut/base/vector.hpp"
#include "abut/solid/material/stored_energy.hpp"

namespace abut::solid {

/// Effect of heat at one position of a body of large strains: F = F_e A with the thermal stretch A = I + a T, T the
/// rise of the temperature and a the tensor of ThermalExpansion. The law of the material answers to F_e = F
/// A^-1, per volume of the warm body that nothing holds:
///
///     W(F, T) = det A W(F_e),    P = det A P(F_e) A^-T
///
/// Cauchy's stress is the one that the law has for F_e. In 2D strain is plane, F is 1 out of the plane and A is not:
/// the law is that of space.
///
/// S. C. H. Lu, K. S. Pister, Int. J. Solids Struct. 11 (1975) 927; L. Vujošević, V. A. Lubarda, Theor. Appl. Mech.
/// 28-29 (2002) 379.
class ThermalStretch {
public:
    /// At T = 0, with a in the axes of space [1/K].
    explicit ThermalStretch(const Matrix<3>& per_kelvin) : per_kelvin_(per_kelvin) {}

    /// T [K].
    void set_rise(double rise);
    [[nodiscard]] double rise() const { return rise_; }
    /// A.
    [[nodiscard]] Matrix<3> tensor() const { return Matrix<3>::Identity() + strain_; }
    /// det A [-].
    [[nodiscard]] double volume() const { return volume_; }
    /// F_e - I of F = I + G: (G - a T) A^-1, so that small strains lose no digits.
    template <int Dim>
    [[nodiscard]] Matrix<3> elastic_gradient(const Matrix<Dim>& g) const {
        return (in_3d<Dim>(g) - strain_) * inverse_;
    }
    /// By how much F_e changes with F.
    template <int Dim>
    [[nodiscard]] Matrix<3> elastic_change(const Matrix<Dim>& change) const {
        return in_3d<Dim>(change) * inverse_;
    }
    /// det A P A^-T, in 2D its part in the plane.
    template <int Dim>
    [[nodiscard]] Matrix<Dim> stress(const Matrix<3>& of_law) const {
        return (volume_ * of_law * inverse_).template topLeftCorner<Dim, Dim>();
    }
    /// W and P of F from those of F_e.
    template <int Dim>
    [[nodiscard]] Response<Dim> response(const Response<3>& of_law) const {
        return {volume_ * of_law.energy, stress<Dim>(of_law.stress)};
    }
    /// Cauchy's stress out of the plane of G from P of F_e [Pa].
    [[nodiscard]] double out_of_plane_stress(const Matrix<2>& g, const Matrix<3>& of_law) const;

private:
    Matrix<3> per_kelvin_;
    double rise_ = 0.0, volume_ = 1.0;
    Matrix<3> strain_ = Matrix<3>::Zero();       // A - I
    Matrix<3> inverse_ = Matrix<3>::Identity();  // A^-1, symmetric as A is
};

}  // namespace abut::solid
