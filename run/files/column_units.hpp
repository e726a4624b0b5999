#pragma once
// Private to the layer.
#include <string>
#include <vector>

namespace abut::run {

/// Names of columns as heads of tables have them, with the unit behind those that have one: "time [s]". In 2D all is by
/// thickness: energies are in J/m, forces in N/m. The names are those of energy.csv, probes.csv and forces.csv.
template <int Dim>
[[nodiscard]] std::vector<std::string> with_units(std::vector<std::string> columns);

}  // namespace abut::run
