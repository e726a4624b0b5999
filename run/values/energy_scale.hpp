#pragma once
#include <string>

namespace abut::run {

/// Scale of the energies of a run.
struct EnergyScale {
    std::string name = "K0";  ///< a letter and its index
    /// [J]; 0: the largest of kinetic energy, V and work from outside so far (Accounts::energy_in_play), which is K0 as
    /// long as nothing acts from outside and nothing is strained at the start, and is called E where it is more;
    /// RunEnergy::at_rest and less count as nothing
    double value = 0.0;

    /// An energy over the scale [-]; 0 as long as nothing has moved.
    [[nodiscard]] double over(double energy) const { return value > 0.0 ? energy / value : 0.0; }
};

}  // namespace abut::run
