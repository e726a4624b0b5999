#pragma once
#include <span>
#include <string>

#include "abut/solid/boundary/bond_places.hpp"

namespace abut::run {

/// How much of some bonds is bonded, in words: "1 of 0.6 m, 0.6 of the smaller side, largest gap 0 m". Of several it
/// has the least shares, the area of all and the largest gap. Empty without bonds.
template <int Dim>
[[nodiscard]] std::string bonded_text(std::span<const solid::BondCoverage> bonds);

}  // namespace abut::run
