#pragma once
#include <cstdint>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::dynamics {
template <int Dim>
class RunView;
}

namespace abut::solid {

template <int Dim>
class Solid;

/// Bodies that bonds hold together, directly or through others, or one that has lost all of its bonds.
template <int Dim>
struct Fragment {
    std::vector<std::int32_t> bodies{};                ///< increasing
    std::int64_t n_cells = 0;                          ///< of its bodies
    double mass = 0.0;                                 ///< [kg]
    Vector<Dim> centre = Vector<Dim>::Zero();          ///< of mass [m]
    Vector<Dim> velocity = Vector<Dim>::Zero();        ///< of the centre of mass, from p = (p^- + p^+)/2 [m/s]
    AxialVector<Dim> spin = AxialVector<Dim>::Zero();  ///< as of a rigid body with its angular momentum [rad/s]
};

/// Fragment of each body, from 0 on in the order of their first bodies; -1 of a body that never had a bond (n_bodies). A
/// bond holds two bodies as long as one of its places has a share of its pull left.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> fragment_of_bodies(const Solid<Dim>& solid);

/// The fragments at the node of `run`, by the numbers of `fragment_of_bodies`; `solid` is that of the run. A call of all
/// ranks: rank 0 has the result, the others nothing.
template <int Dim>
[[nodiscard]] std::vector<Fragment<Dim>> fragments(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid);

}  // namespace abut::solid
