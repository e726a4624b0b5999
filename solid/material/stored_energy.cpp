#include "abut/solid/material/stored_energy.hpp"

namespace abut::solid {
namespace {

constexpr double difference = 1e-5;  // of F: its square and the rounding over it are alike small

}  // namespace

template <int Dim>
Matrix<Dim> StoredEnergy<Dim>::stress_change(const Matrix<Dim>& g, const Matrix<Dim>& change) const {
    const double size = change.norm();
    if (size == 0.0) return Matrix<Dim>::Zero();
    const Matrix<Dim> step = (difference / size) * change;
    return (size / (2.0 * difference)) * (at(g + step).stress - at(g - step).stress);
}

template class StoredEnergy<2>;
template class StoredEnergy<3>;

}  // namespace abut::solid
