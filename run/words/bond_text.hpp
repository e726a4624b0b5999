#pragma once
#include <span>
#include <string>

#include "abut/solid/boundary/bond_places.hpp"

namespace abut::run {

/// How much of some bonds is bonded, in words: "1 of 0.6 m, 0.6 of the smaller side, largest gap 0 m", and the
/// cohesive length of those that take a fracture energy. Of several it has the least shares and the least cohesive
/// length, the area of all and the largest gap. Empty without bonds.
template <int Dim>
[[nodiscard]] std::string bonded_text(std::span<const solid::BondCoverage> bonds);

/// Least BondCoverage::cohesive_length of some bonds [-]; infinity where none takes a fracture energy.
[[nodiscard]] double cohesive_length(std::span<const solid::BondCoverage> bonds);
/// Size of what bonds dissipated beyond their fracture energy, over what they should have [-]: of Losses::in_bonds and
/// BondView::beyond_fracture_energy, in a unit of both.
[[nodiscard]] double fracture_error(double in_bonds, double beyond);

}  // namespace abut::run
