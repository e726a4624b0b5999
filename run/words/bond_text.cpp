#include "abut/run/words/bond_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::run {

template <int Dim>
std::string bonded_text(std::span<const solid::BondCoverage> bonds) {
    if (bonds.empty()) return "";
    double share = 1.0, of_side = 1.0, opposite = 0.0, gap = 0.0;
    for (const solid::BondCoverage& bond : bonds) {
        share = std::min(share, bond.share());
        of_side = std::min(of_side, bond.share_of_side());
        opposite += bond.opposite;
        gap = std::max(gap, bond.largest_gap);
    }
    const double cohesive = cohesive_length(bonds);
    return fmt::format("{:.3g} of {:.4g} {}, {:.3g} of the smaller side, largest gap {:.2g} m{}{}", share, opposite,
                       Dim == 2 ? "m" : "m^2", of_side, gap,
                       std::isfinite(cohesive) ? fmt::format(", cohesive length {:.3g} cells", cohesive) : "",
                       bonds.size() > 1 ? fmt::format("; the least of {} bonds", bonds.size()) : "");
}

double cohesive_length(std::span<const solid::BondCoverage> bonds) {
    double least = std::numeric_limits<double>::infinity();
    for (const solid::BondCoverage& bond : bonds) least = std::min(least, bond.cohesive_length);
    return least;
}

double fracture_error(double in_bonds, double beyond) {
    const double by_law = in_bonds - beyond;
    return by_law > 0.0 ? std::abs(beyond) / by_law : 0.0;
}

template std::string bonded_text<2>(std::span<const solid::BondCoverage>);
template std::string bonded_text<3>(std::span<const solid::BondCoverage>);

}  // namespace abut::run
