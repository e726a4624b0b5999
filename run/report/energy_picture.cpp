#include "abut/run/report/energy_picture.hpp"

#include "abut/run/files/files.hpp"
#include "abut/run/report/curves.hpp"

namespace abut::run {

template <int Dim>
void write_energy_picture(const std::filesystem::path& directory, const std::string& title,
                          std::span<const dynamics::LedgerEntry<Dim>> entries, const EnergyScale& scale) {
    write_whole(directory / "energy.svg", drawing_file(title, energy_plots<Dim>(entries, scale)));
}

template void write_energy_picture<2>(const std::filesystem::path&, const std::string&,
                                      std::span<const dynamics::LedgerEntry<2>>, const EnergyScale&);
template void write_energy_picture<3>(const std::filesystem::path&, const std::string&,
                                      std::span<const dynamics::LedgerEntry<3>>, const EnergyScale&);

}  // namespace abut::run
