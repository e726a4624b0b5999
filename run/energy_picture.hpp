#pragma once
#include <filesystem>
#include <string>

namespace abut::run {

/// What the picture of the energies of a run is drawn from and scaled by.
struct EnergyPicture {
    std::string title;
    double pseudo_energy;    ///< H~ at the start [J]
    double scale;            ///< what drifts are divided by [J]
    std::string scale_name;  ///< "K0": a letter and its index
};

/// energy.gp beside energy.csv, and energy.png, which gnuplot makes of it: above kinetic and potential energy, H and H~;
/// below |H~ - H~0 - work| and H - H~ over the scale, logarithmic. Says why there is no picture; empty if there is one.
/// Throws BadInput if the script cannot be written.
[[nodiscard]] std::string draw_energy(const std::filesystem::path& directory, const EnergyPicture& picture);

}  // namespace abut::run
