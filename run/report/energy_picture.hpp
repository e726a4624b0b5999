#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "abut/run/values/forward.hpp"

namespace abut::run {

/// Writes energy.svg, the two pictures of energies of a report, to a folder: above kinetic and potential energy, H and H~;
/// below |H~ - H~0 - work| and H - H~ over the scale, logarithmic. Throws BadInput if the file cannot be written.
template <int Dim>
void write_energy_picture(const std::filesystem::path& directory, const std::string& title,
                          std::span<const dynamics::LedgerEntry<Dim>> entries, const EnergyScale& scale);

}  // namespace abut::run
