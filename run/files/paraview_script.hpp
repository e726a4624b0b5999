#pragma once
#include <string>

namespace abut::run {

/// A Python script for ParaView 5.9 or later that opens the series beside it, whose lists have this extension (".pvd" or
/// ".xmf"), with views to begin with: bodies as they have moved, coloured by the von Mises stress, and their boundary
/// coloured by the contact pressure, one scale for all times.
///
///     paraview --script=out/mine/view_in_paraview.py
[[nodiscard]] std::string paraview_script(const std::string& series, const std::string& extension);

/// File name of the script, which lies beside the series.
inline constexpr const char* paraview_script_name = "view_in_paraview.py";

}  // namespace abut::run
