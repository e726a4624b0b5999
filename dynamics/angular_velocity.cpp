#include "abut/dynamics/angular_velocity.hpp"

#include "abut/base/decompositions.hpp"

namespace abut::dynamics {
namespace {

constexpr double no_inertia = 1e-12;  // over the largest: points on a line have none about it

}  // namespace

template <>
AngularMomentum<1> angular_velocity<1>(const Inertia<1>&, const AngularMomentum<1>& carried) {
    return carried;
}

template <>
AngularMomentum<2> angular_velocity<2>(const Inertia<2>& inertia, const AngularMomentum<2>& carried) {
    if (inertia(0, 0) == 0.0) return AngularMomentum<2>::Zero();
    return carried / inertia(0, 0);
}

template <>
AngularMomentum<3> angular_velocity<3>(const Inertia<3>& inertia, const AngularMomentum<3>& carried) {
    const SymmetricEigen<3> eigen = symmetric_eigen(inertia);
    const double cut = no_inertia * eigen.values.maxCoeff();
    const Vector<3> inverse = eigen.values.unaryExpr([&](double value) { return value > cut ? 1.0 / value : 0.0; });
    return eigen.vectors * inverse.cwiseProduct(eigen.vectors.transpose() * carried);
}

}  // namespace abut::dynamics
