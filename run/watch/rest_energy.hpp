#pragma once
// Private to the layer.
#include <cstdint>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::run {

/// Energy that rounding alone makes of bodies at rest in so many steps [J], in any units and wherever they stand: a run
/// with no more has not moved. Positions X + u are rounded to r = eps max |X|; a cell that is moved by r within a step
/// dt has the energy m (r/dt)^2 / 2, which is also that of its stiffest mode in a stable step, and what single steps
/// give adds up, since their signs are by chance. Measured on bodies of all kinematics it is a thousandth of that. `dt`
/// [s]: of the finest cells; `materials` by body of the mesh.
template <int Dim>
[[nodiscard]] double rest_energy(const mesh::Mesh<Dim>& mesh, const std::vector<solid::Material>& materials, double dt,
                                 std::int64_t steps);

}  // namespace abut::run
