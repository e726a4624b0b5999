#pragma once
// Private to the sources of run.
#include <array>
#include <string>
#include <vector>

namespace abut::run {

/// Points of a plane in colours of a value, logarithmic, and rings around some places.
struct CellMap {
    std::string title;
    std::string subtitle;
    std::string x_label;  ///< with its unit
    std::string y_label;
    std::string value_label;
    std::vector<std::array<double, 2>> position;
    std::vector<double> value;  ///< as many; one that is not finite is taken for the highest
    double lower;               ///< end of the colours, > 0
    double upper;               ///< > lower
    std::vector<std::array<double, 2>> rings;
};

/// The map as the text of an SVG file, equally long along both axes. Points that fall on each other are drawn once, the one
/// with the highest value on top.
[[nodiscard]] std::string drawing_file(const CellMap& map);

}  // namespace abut::run
