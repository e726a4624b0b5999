#include "abut/solid/material/thermal_stretch.hpp"

namespace abut::solid {

void ThermalStretch::set_rise(double rise) {
    if (rise == rise_) return;
    rise_ = rise;
    strain_ = rise * per_kelvin_;
    inverse_ = tensor().inverse();
    volume_ = tensor().determinant();
}

/// (P F_e^T)_33/det F_e, where F_e has no shears out of the plane.
double ThermalStretch::out_of_plane_stress(const Matrix<2>& g, const Matrix<3>& of_law) const {
    const Matrix<3> f = Matrix<3>::Identity() + elastic_gradient<2>(g);
    return of_law(2, 2) * f(2, 2) / f.determinant();
}

}  // namespace abut::solid
