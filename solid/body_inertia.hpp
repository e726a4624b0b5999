#pragma once
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::solid {

template <int Dim>
class Solid;

/// The moments of inertia of a body about the principal axes through its centre, of which the masses of its points may
/// have less: those of the cells themselves are missing where points are at their centroids (Kinematics::small,
/// Kinematics::finite).
template <int Dim>
struct BodyInertia {
    AxialVector<Dim> exact;  ///< of its cells at rest, increasing [kg m^2]
    AxialVector<Dim> share;  ///< I / I_exact of the points [-]

    [[nodiscard]] double least() const { return share.minCoeff(); }
};

/// Inertia of each body of a solid (n_bodies), whose cells of all ranks are in `whole`. A call of all ranks: rank 0 has the
/// result, the others nothing, and of them `whole` is not looked at.
template <int Dim>
[[nodiscard]] std::vector<BodyInertia<Dim>> inertia_of_bodies(const Solid<Dim>& solid, const mesh::Mesh<Dim>& whole);

}  // namespace abut::solid
