#pragma once
// Private to the sources of run.
#include <string>
#include <vector>

namespace abut::run {

struct Tick {
    double at;          ///< in the unit of the axis; a power of ten where it is logarithmic
    std::string label;  ///< "0.25", "1e-12"
};

/// The ends of an axis and its ticks; both ends are finite, lower < upper.
struct Axis {
    double lower;
    double upper;
    std::vector<Tick> ticks;  ///< in order, within the ends
    bool logarithmic = false;

    /// 0 at the lower end, 1 at the upper one; on a logarithmic axis what lies below it, 0 too, is at its lower end.
    [[nodiscard]] double share(double value) const;
};

/// Ends and ticks for values from `least` to `greatest`, finite: ticks are 1, 2 or 5 times a power of ten apart, `most` of
/// them at most. Where all values are equal the axis reaches to both sides of them.
[[nodiscard]] Axis linear_axis(double least, double greatest, int most);

/// Whole decades, from at least `floor` > 0. Where nothing is above it, three decades from there.
[[nodiscard]] Axis logarithmic_axis(double least, double greatest, double floor, int most);

}  // namespace abut::run
