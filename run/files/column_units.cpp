#include "abut/run/files/column_units.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "abut/dynamics/losses.hpp"

namespace abut::run {
namespace {

struct ColumnUnit {
    std::string_view name;  ///< of the column, without axis or component
    std::string_view in_plane, in_space;
};
constexpr std::array units_of_columns = {ColumnUnit{"time", "s", "s"},
                                         ColumnUnit{"pseudo_energy", "J/m", "J"},
                                         ColumnUnit{"energy", "J/m", "J"},
                                         ColumnUnit{"kinetic", "J/m", "J"},
                                         ColumnUnit{"potential", "J/m", "J"},
                                         ColumnUnit{"work", "J/m", "J"},
                                         ColumnUnit{"linear_momentum", "kg/s", "kg m/s"},
                                         ColumnUnit{"angular_momentum", "kg m/s", "kg m^2/s"},
                                         ColumnUnit{"rest_angular_momentum", "kg m/s", "kg m^2/s"},
                                         ColumnUnit{"pseudo_angular_momentum", "kg m/s", "kg m^2/s"},
                                         ColumnUnit{"parasitic", "m/s", "m/s"},
                                         ColumnUnit{"restart_jumps", "J/m", "J"},
                                         ColumnUnit{"restart_paid", "J/m", "J"},
                                         ColumnUnit{"rotation", "rad", "rad"},
                                         ColumnUnit{"dissipated", "J/m", "J"},
                                         ColumnUnit{"friction_energy", "J/m", "J"},
                                         ColumnUnit{"eroded_mass", "kg/m", "kg"},
                                         ColumnUnit{"eroded_kinetic", "J/m", "J"},
                                         ColumnUnit{"eroded_potential", "J/m", "J"},
                                         ColumnUnit{"eroded_momentum", "kg/s", "kg m/s"},
                                         ColumnUnit{"eroded_rest_angular_momentum", "kg m/s", "kg m^2/s"},
                                         ColumnUnit{"eroded_pseudo_angular_momentum", "kg m/s", "kg m^2/s"},
                                         ColumnUnit{"displacement", "m", "m"},
                                         ColumnUnit{"velocity", "m/s", "m/s"},
                                         ColumnUnit{"stress", "Pa", "Pa"},
                                         ColumnUnit{"von_mises", "Pa", "Pa"},
                                         ColumnUnit{"force_on_2", "N/m", "N"},
                                         ColumnUnit{"friction_on_2", "N/m", "N"},
                                         ColumnUnit{"rubbing_force", "N/m", "N"},
                                         ColumnUnit{"slip_velocity_of_2", "m/s", "m/s"},
                                         ColumnUnit{"contact_normal", "N/m", "N"},
                                         ColumnUnit{"friction", "N/m", "N"},
                                         ColumnUnit{"slip_velocity", "m/s", "m/s"},
                                         ColumnUnit{"normal_force", "N/m", "N"}};

/// "top.stress_xx" -> "stress"
std::string_view without_probe_and_axis(std::string_view column) {
    column = column.substr(column.rfind('.') + 1);
    for (const std::string_view end : {"_x", "_y", "_z", "_xx", "_yy", "_zz", "_yz", "_xz", "_xy"})
        if (column.ends_with(end)) return column.substr(0, column.size() - end.size());
    return column;
}

}  // namespace

template <int Dim>
std::vector<std::string> with_units(std::vector<std::string> columns) {
    for (std::string& column : columns) {
        std::string_view name = without_probe_and_axis(column);
        if (std::ranges::find(dynamics::all_losses, name, &dynamics::Loss::name) != dynamics::all_losses.end())
            name = "dissipated";
        const auto known = std::ranges::find(units_of_columns, name, &ColumnUnit::name);
        if (known != units_of_columns.end())
            column += " [" + std::string(Dim == 2 ? known->in_plane : known->in_space) + "]";
    }
    return columns;
}

template std::vector<std::string> with_units<2>(std::vector<std::string>);
template std::vector<std::string> with_units<3>(std::vector<std::string>);

}  // namespace abut::run
